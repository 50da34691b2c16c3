"""The whole belt in cells: any route and load, several drives, brakes, jams, idlers that stick and slide.

Bars come from three grids, each with twice the cells of the one before (`cell_bars`).
"""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Failure, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.conveyor.machine.keys.converter import leaders
from ptmcalc.machines.conveyor.machine.load_sharing import steady_motor_speeds
from ptmcalc.machines.conveyor.machine.loads import DRIVE, DRIVE_OF_STOP, OF_NETWORK, PER_DRIVE
from ptmcalc.machines.conveyor.machine.model import belt_line, turns
from ptmcalc.machines.conveyor.machine.motion import MOST_ROUNDS, Moving, moving
from ptmcalc.machines.conveyor.machine.plain_start import delay_lines_do
from ptmcalc.machines.conveyor.machine.scenes import IN_MOTION, ConveyorScene, Start
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.machine.start_case import start_case
from ptmcalc.machines.conveyor.waves import (
    deep_sag,
    start_enclosure,
    start_intervals,
    tail_pulley,
    takeup_stops,
    torque_limits,
)
from ptmcalc.machines.conveyor.waves.after_start import MODES, Ending, ending, still_to_come
from ptmcalc.machines.conveyor.waves.cell_histories import events_of, findings_of, histories
from ptmcalc.machines.conveyor.waves.cell_runs import (
    CellRun,
    GripLostError,
    grid_loads,
    grids_of,
    predicted_seconds,
    slips_on,
    spent_seconds,
)
from ptmcalc.machines.conveyor.waves.effects.moving_belt import belt_travel
from ptmcalc.machines.conveyor.waves.unfinished_stop import failures_of, loads_so_far, open_end, unfinished

_SHORTER = 6
"""Attempts to end a window before a pulley loses its belt, each at 3/4 of the one before; a numerical choice. Six reach
18 % of that time. More attempts cost a run each; fewer report NUM102 more often."""
_WORTH = 0.015
"""Belt speed relative to that of its slowest wave [1] from which on a plain start is simulated in cells. A numerical
choice: below it the bound of convection is narrower than the error bar of the cells. A smaller value takes longer
without a gain."""


def run(spec: Conveyor, scene: ConveyorScene, carried: frozenset[str], level: int) -> Result:
    """Loads of a scene in which the belt moves, from three grids.

    **Range** any scene in motion of a taut belt; the result reports a belt whose tension falls below 0. If the belt
    sags too far, only the results before that moment are reported (`deep_sag`).
    **Error** as described in the module: an estimate from three grids, verified by the seeded sample of the coverage
    tests.
    **Source** method of characteristics with lumped idlers; derived in `numerics.belt`.
    """
    case = moving(spec, scene)
    try:
        loads, runs = grid_loads(case, carried, level)
    except GripLostError as lost:
        return _before(case, carried, level, lost)
    drawn, ready = runs[-1].drawn, runs[-1].ready
    loads = tail_pulley.widened(case, drawn, loads)
    slipping = slips_on(case, drawn)
    findings, slack = list(findings_of(case, drawn)), list[Failure]()
    if "sag" in carried and deep_sag.too_deep(case, drawn):
        slack = list(deep_sag.slack(case, [one.drawn for one in runs]))
        window = deep_sag.trusted_window(case, drawn)
        early, more = grid_loads(replace(case, window=window), carried, level, whole=False) if window else ({}, [])
        runs = more + runs
        loads = deep_sag.certain(case, loads, early, window)
        findings = [deep_sag.finding(case, drawn, window)]
    failures = (
        *failures_of(case, drawn, ready),
        *slack,
        *takeup_stops.failures(case, drawn, loads),
        *torque_limits.failures(case, [one.loads.traces for one in runs[-3:]]),
    )
    end = _ending(case, runs, slipping)
    if unfinished(case, drawn):
        loads = loads_so_far(case, loads, [one.drawn for one in runs])
    later = still_to_come(spec, case.line, end, loads) if end else {}
    stopped, at_stop = takeup_stops.contact(case, drawn, loads, later)
    return Result(
        loads,
        work=sum(part.work for part in runs),
        spent=spent_seconds(case, carried, runs),
        window=(0.0, float(drawn.times[-1])),
        health={"energy_residual": drawn.energy_residual, "cells": ready.course.cells},
        findings=tuple(findings),
        events=tuple(events_of(drawn, ready)),
        histories=lambda: histories(case, drawn, ready),
        failures=failures,
        beyond=later | stopped,
        open_end=at_stop or (end.state if end else open_end(case, drawn)),
    )


def _ending(case: Moving, runs: Sequence[CellRun], slipping: bool) -> Ending | None:
    """The end of a start that goes on to even running."""
    if not isinstance(case.scene, Start):
        return None
    run = next((one for one in reversed(runs) if one.ready.course.cells <= MODES), runs[0])
    course, line, row = run.ready.course, case.line, run.drawn.row
    middles = course.middles[: course.tail], course.middles[course.tail :] - line.back.length
    statics = [line.static(which, at / line.strand(which).length) for which, at in zip((0, 1), middles, strict=True)]
    slowest = min(run.drawn.head[-1].belt, *run.drawn.head[-1].drums)
    end = ending(_goal(case), slowest, slipping, replace(row, pulls=row.pulls - np.concatenate(statics)), course.tail)
    if not end.state and _floats(case):
        state = f"belt at {slowest:.3g} m/s, the head pulley follows the torque of a drive at the tail"
        return replace(end, row=None, state=state)
    if end.state or run.ready.travel is None or not (run.ready.head.imposes and run.ready.tail.imposes):
        return end
    shifts = f"belt at {slowest:.3g} m/s, the load share of the drives at head and tail still changes"
    return replace(end, drifts=True, state=shifts)


def _floats(case: Moving) -> bool:
    """Whether the drives at the head follow the torque of drives at the tail: nothing then holds their speed, and no
    bound is known of what follows a start."""
    drives = case.spec.all_drives
    followed = leaders(drives)
    at_head = [followed.get(name, name) for name, drive in drives.items() if drive.at == "head"]
    return bool(case.curves) and all(drives[name].at == "tail" for name in at_head)


def _goal(case: Moving) -> float:
    """Speed of the belt at which its start is over [m/s]: that of steady running, which slip may keep below the rated
    speed."""
    if not case.curves:
        return case.line.speed
    drives = case.spec.all_drives
    steady = steady_motor_speeds(case.spec, case.line)
    return min(case.line.speed, *(speed / turns(drives[name]) for name, speed in steady.items()))


def _before(case: Moving, carried: frozenset[str], level: int, lost: GripLostError) -> Result:
    """What came before a slipping drum lost its belt."""
    window = lost.time
    for _ in range(_SHORTER):
        window *= 0.75
        try:
            early, runs = grid_loads(replace(case, window=window), carried, level, whole=False)
        except GripLostError:
            continue
        drawn, ready = runs[-1].drawn, runs[-1].ready
        return Result(
            deep_sag.certain(case, early, early, window),
            work=sum(part.work for part in runs),
            window=(0.0, window),
            health={"energy_residual": drawn.energy_residual, "cells": ready.course.cells},
            findings=(deep_sag.taut(f"loses its tension on a slipping pulley at {lost.time:.3g} s", window),),
            events=tuple(events_of(drawn, ready)),
        )
    raise NumericsError("NUM102", f"the belt loses its tension on a slipping pulley at {lost.time:.3g} s")


def cost(spec: Conveyor, scene: ConveyorScene, carried: frozenset[str], level: int) -> float:
    """Seconds predicted from steps and cells of the three grids; a finer setting adds one to those before it."""
    case = moving(spec, scene)
    grids = grids_of(scene, level)[-1 if level else 0 :]
    return 1e-3 + sum(predicted_seconds(case.window, case, carried, cells) for cells in grids)


def valid(spec: Conveyor, scene: ConveyorScene) -> Criterion | None:
    """Whether there is a motion to simulate that the cheaper and sharper delay lines do not carry.

        W/F, static resistance over available force: at 1 the belt stays at rest;   1 for a plain start
        n, rounds of a wave in the time of the scene: at 1000 simulating it takes a minute
        rho v^2/S_off, centrifugal over run-off tension: at 1 the belt lifts off its drums

    **Range** any scene in motion.
    **Error** exact.
    **Source** the belt moves when the drives' force exceeds the static resistance; `solvers.characteristics` is exact
    between drum and tail where a start is plain.
    """
    if _plain(spec, scene):
        return Criterion("plain", 1.0, 1.0, "a plain start, simulated by the delay lines", "solvers.characteristics")
    return _simulable(spec, scene)


def valid_running(spec: Conveyor, scene: ConveyorScene) -> Criterion | None:
    """The same for a plain start, of which only what the running belt carries along is left to the cells.

        v/c, belt speed / speed of the slowest wave, read from the other side: below 0.015 the bound of that effect is
        narrower than the bars of the cells, unless a drum may slip: it has no bound of how far;
        1 for anything but a plain start;   else as `valid`

    **Range** any scene in motion.
    **Error** exact; the limit of 0.015 is an engineering choice, and none for a file that asks for `moving_belt: on`.
    **Source** as `valid`.
    """
    if not _plain(spec, scene):
        return Criterion("plain", 1.0, 1.0, "not a plain start: simulated by the network", "solvers.network")
    speed = belt_travel(belt_line(spec, scene))
    if speed < _WORTH and spec.effects.get("moving_belt") != "on" and not _may_slip(spec, scene):
        meaning = "the bound of wave convection is narrower than the error of the cells"
        return Criterion("0.015 c/v", _WORTH / speed, 1.0, meaning, "effects.travel_bound")
    return _simulable(spec, scene)


def valid_reference(spec: Conveyor, scene: ConveyorScene) -> Criterion | None:
    """The same for a plain start whatever its speed: no plan offers the cells there, but they know what it comes to.

        1 for anything but a plain start;   else as `valid`

    **Range** any scene in motion.
    **Error** exact.
    **Source** as `valid`.
    """
    if not _plain(spec, scene):
        return Criterion("plain", 1.0, 1.0, "not a plain start: the network itself is planned", "solvers.network")
    return _simulable(spec, scene)


def _may_slip(spec: Conveyor, scene: ConveyorScene) -> bool:
    """Whether the drive of a plain start may come to the limit of its grip."""
    assert isinstance(scene, Start)
    case = start_case(spec, scene)
    used = start_intervals.enclosed_loads(case, start_enclosure.enclose(case, 0.0)).get("slip_utilisation_max")
    return used is not None and used.high >= 1


def _plain(spec: Conveyor, scene: ConveyorScene) -> bool:
    return isinstance(scene, Start) and delay_lines_do(spec, scene)


def _simulable(spec: Conveyor, scene: ConveyorScene) -> Criterion | None:
    case = moving(spec, scene)
    if isinstance(scene, Start) and case.imposed is None and case.window <= 0:
        return Criterion("W/F", 1.0, 1.0, "static resistance / drive force: the belt does not move", "Newton")
    line = case.line
    lift = line.centrifugal_at_speed / line.run_off if line.run_off > 0 else math.inf
    if lift >= 1:
        return Criterion("rho v^2/S", lift, 1.0, "centrifugal tension relative to the leaving tension", "laws.capstan")
    count = case.window / line.contour_time
    if count >= MOST_ROUNDS:
        return Criterion("n", count, MOST_ROUNDS, "wave circuits during the scene: too much work", "cost")
    return None


NETWORK: Solver[Conveyor, ConveyorScene] = Solver(
    name="network",
    title="method of characteristics with lumped idlers, whole belt",
    fidelity=Fidelity.TRANSIENT,
    scenes=IN_MOTION,
    represents=frozenset(
        {
            "belt_wave",
            "tail_jump",
            "tail_mass",
            "sag",
            "slip",
            "coulomb_idlers",
            "takeup_mass",
            "viscous_idlers",
            "belt_damping",
            "moving_belt",
        }
    ),
    gives=OF_NETWORK.union(PER_DRIVE, DRIVE, DRIVE_OF_STOP),
    run=run,
    cost=cost,
    source="method of characteristics with lumped idlers; derived in ptmcalc.numerics.belt",
    valid=valid,
    always=frozenset({"belt_wave", "tail_jump", "tail_mass", "coulomb_idlers"}),
    levels=3,
    method="belt in cells",
)

RUNNING_NETWORK: Solver[Conveyor, ConveyorScene] = replace(
    NETWORK,
    name="running_network",
    title="method of characteristics with lumped idlers, plain start of a moving belt",
    always=NETWORK.always | {"moving_belt"},
    valid=valid_running,
)

CELLS: Solver[Conveyor, ConveyorScene] = replace(
    NETWORK,
    name="cells",
    title="method of characteristics with lumped idlers, plain start (reference)",
    valid=valid_reference,
)
