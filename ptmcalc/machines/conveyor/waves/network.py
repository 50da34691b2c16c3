"""The whole belt in cells: any route and load, several drives, brakes, jams, idlers that stick and slide.

Bars come from three grids, each with twice the cells of the one before (`cell_bars`).
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ptmcalc.base import units
from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Event, Failure, Finding, Found, History, Result, family, of
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import capstan
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor.brakes import brakes_of, braking
from ptmcalc.machines.conveyor.drives import moving_mass
from ptmcalc.machines.conveyor.loads import DRIVE, OF_NETWORK, PER_DRIVE, SLIPS, ways_of
from ptmcalc.machines.conveyor.model import (
    FloatArray,
    belt_line,
    belt_travel,
    delay_lines_do,
    start_case,
)
from ptmcalc.machines.conveyor.motion import MOST_ROUNDS, Moving, moving
from ptmcalc.machines.conveyor.spec import IN_MOTION, Conveyor, ConveyorScene, Jam, Start
from ptmcalc.machines.conveyor.waves import bounds, cell_bars, deep_sag
from ptmcalc.machines.conveyor.waves.after_start import MODES, Ending, ending, still_to_come
from ptmcalc.machines.conveyor.waves.cell_loads import OneGrid, Values, loads_of
from ptmcalc.machines.conveyor.waves.cells import Set, rubber_of, set_up
from ptmcalc.machines.conveyor.waves.last_motions import Kept
from ptmcalc.numerics.belt.march import Drawn, march
from ptmcalc.numerics.belt.station import Seen

_CELLS, _CELLS_OF_JUMP = 60, 240
"""Cells of the whole belt on the coarsest of three grids at the first level; numerical choices. `_CELLS_OF_JUMP`: for a
pulley that stops at once, whose window is short and whose fronts are steps. `_CELLS`: for any other scene. Time grows
with the square; the error bar falls with the order 0.6 or more."""
_SHORTER = 6
"""Attempts to end a window before a pulley loses its belt, each at 3/4 of the one before; a numerical choice. Six reach
18 % of that time. More attempts cost a run each; fewer report NUM102 more often."""
_LONGEST = 8.0
"""Windows of a start in which a slipping pulley may stick again [1]. A numerical choice: the run ends as soon as no
pulley slips. A larger value follows longer slip and takes longer."""
_MORE = 1.25
"""Minimum growth of a window that was too short [1]. A numerical choice: a larger value takes fewer but longer runs."""
_CONTOURS_AT_REST = 3.0
"""Contour times after the predicted standstill [1]: the run ends two after it, and the prediction is a mean over one. A
larger value takes longer; a smaller one repeats more runs."""
_HOUR = 3600.0
"""Time in which a belt must come to standstill to count as stopped [s], as in the check of the stopping time; an
engineering choice. A smaller value reports slow stops as endless."""
_MOST_SECONDS = 2.5
"""Predicted seconds of the finest grid up to which a window is made longer; a numerical choice. A larger value follows
longer stops and takes longer; a smaller one leaves more loads without an error bar."""
_WORTH = 0.015
"""Belt speed relative to that of its slowest wave [1] from which on a plain start is simulated in cells. A numerical
choice: below it the bound of convection is narrower than the error bar of the cells. A smaller value takes longer
without a gain."""
_SECONDS = {"straight": (4e-5, 1.2e-8), "giving": (1.6e-4, 1.6e-7)}
"""Predicted seconds per step, and per step and cell, without and with sag or damping; rates of a measurement of which
no record is kept. Wrong values change the order of the solvers and the length of windows."""


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
        loads, runs = _computed(case, carried, level)
    except _GripLostError as lost:
        return _before(case, carried, level, lost)
    drawn, ready = runs[-1].drawn, runs[-1].ready
    slipping = _slips_on(case, drawn)
    findings, slack = list(_findings(case, drawn)), list[Failure]()
    if "sag" in carried and deep_sag.too_deep(case, drawn):
        slack = list(deep_sag.slack(case, [one.drawn for one in runs]))
        window = deep_sag.trusted_window(case, drawn)
        early, more = _computed(replace(case, window=window), carried, level, whole=False) if window else ({}, [])
        runs = more + runs
        loads = deep_sag.certain(case, loads, early, window)
        findings = [deep_sag.finding(case, drawn, window)]
    failures, end = (*_failures(case, drawn, ready), *slack), _ending(case, runs, slipping)
    if _unfinished(case, drawn):
        loads = _so_far(case, loads, runs)
    return Result(
        loads,
        work=sum(part.work for part in runs),
        window=(0.0, float(drawn.times[-1])),
        health={"energy_residual": drawn.energy_residual, "cells": ready.course.cells},
        findings=tuple(findings),
        events=tuple(_events(drawn, ready)),
        histories=lambda: _histories(case, drawn, ready),
        failures=failures,
        beyond=still_to_come(spec, case.line, end, loads) if end else {},
        open_end=end.state if end else _open_end(case, drawn),
    )


def _ending(case: Moving, runs: "Sequence[_March]", slipping: bool) -> Ending | None:
    """The end of a start that goes on to even running."""
    if not isinstance(case.scene, Start):
        return None
    run = next((one for one in reversed(runs) if one.ready.course.cells <= MODES), runs[0])
    course, line, row = run.ready.course, case.line, run.drawn.row
    middles = course.middles[: course.tail], course.middles[course.tail :] - line.back.length
    statics = [line.static(which, at / line.strand(which).length) for which, at in zip((0, 1), middles, strict=True)]
    slowest = min(run.drawn.head[-1].belt, *run.drawn.head[-1].drums)
    end = ending(line, slowest, slipping, replace(row, pulls=row.pulls - np.concatenate(statics)), course.tail)
    if end.state or run.ready.travel is None or run.ready.head.imposed is None or run.ready.tail.imposed is None:
        return end
    shifts = f"belt at {slowest:.3g} m/s, the load share of the drives at head and tail still changes"
    return replace(end, drifts=True, state=shifts)


def _grids(scene: ConveyorScene, level: int) -> tuple[int, int, int]:
    """Cells of the three grids; a jam is short, and its steps ask for more."""
    coarsest = (_CELLS_OF_JUMP if _jumps(scene) else _CELLS) << level
    return coarsest, 2 * coarsest, 4 * coarsest


def _jumps(scene: ConveyorScene) -> bool:
    """Whether a drum stops from one moment to the next."""
    return isinstance(scene, Jam) and not scene.time


class _GripLostError(Exception):
    """A drum slips under a belt that presses on it no more: friction has no meaning there."""

    def __init__(self, time: float) -> None:
        super().__init__(time)
        self.time = time


def _before(case: Moving, carried: frozenset[str], level: int, lost: _GripLostError) -> Result:
    """What came before a slipping drum lost its belt."""
    window = lost.time
    for _ in range(_SHORTER):
        window *= 0.75
        try:
            early, runs = _computed(replace(case, window=window), carried, level, whole=False)
        except _GripLostError:
            continue
        drawn, ready = runs[-1].drawn, runs[-1].ready
        return Result(
            deep_sag.certain(case, early, early, window),
            work=sum(part.work for part in runs),
            window=(0.0, window),
            health={"energy_residual": drawn.energy_residual, "cells": ready.course.cells},
            findings=(deep_sag.taut(f"loses its tension on a slipping pulley at {lost.time:.3g} s", window),),
            events=tuple(_events(drawn, ready)),
        )
    raise NumericsError("NUM102", f"the belt loses its tension on a slipping pulley at {lost.time:.3g} s")


@dataclass(frozen=True, slots=True)
class _March:
    """A march on one grid: its loads, what the belt did, and how many cells that took."""

    loads: OneGrid
    drawn: Drawn
    ready: Set
    work: int

    @property
    def values(self) -> Values:
        return self.loads.values


_KEPT = Kept[tuple[Drawn, Set, int]](lambda made: len(made[0].times))


def _causes(case: Moving) -> tuple[object, ...]:
    """All that the motion of a belt depends on."""
    spec, line = case.spec, replace(case.line, breaking_force=None, slack_sag=0.0)
    parts = spec.all_drives, spec.brakes, spec.backstop, spec.takeup, spec.tail_drum, spec.belt.damping
    return line, case.scene, case.speed, case.window, *parts


def _computed(
    case: Moving, carried: frozenset[str], level: int, whole: bool = True
) -> tuple[dict[str, Found], list[_March]]:
    """Loads from three grids with their bars, and what the belt did on each."""
    few, some, many = _grids(case.scene, level)
    coarsest = _marched(case, carried, few, whole, many)
    if whole and _unfinished(case, coarsest.drawn):
        case, whole = replace(case, window=float(coarsest.drawn.times[-1])), False
    coarse, fine = (_marched(case, carried, cells, whole, many) for cells in (some, many))
    runs = [coarsest, coarse, fine]
    front = cell_bars.front_at(fine.drawn) if _jumps(case.scene) else 0.0
    bars = cell_bars.bars(case, (coarsest.loads, coarse.loads, fine.loads), front)
    found = {name: Found(_estimate(name, value, bars[name]), place) for name, (value, place) in fine.values.items()}
    return found, runs


def _marched(case: Moving, carried: frozenset[str], cells: int, whole: bool, most: int) -> _March:
    """The march on one grid, made now or kept from before; the finest grid of its kind has `most` cells."""
    causes = cells, carried, whole, *_causes(case)
    drawn, ready, work = _KEPT.of(causes, lambda: _once(case, carried, cells, whole, most))
    return _March(loads_of(case, drawn, ready), drawn, ready, work)


def _once(case: Moving, carried: frozenset[str], cells: int, whole: bool, most: int) -> tuple[Drawn, Set, int]:
    """A march on one grid; of the `whole` scene until a belt that comes to rest has done so, whatever slips, until it
    is known that it never does, or until the finest grid would take more work than a scene may cost."""
    work = 0
    starts = isinstance(case.scene, Start) and case.imposed is None and "slip" in carried
    usual = case.window
    if starts and whole:
        case = replace(case, window=_LONGEST * usual)  # ends when no drum slips any more
    while True:
        ready = set_up(case, carried, cells)
        still = _until_it_grips(case, usual) if starts and whole else _still(case)
        parts = ready.course, ready.head, ready.tail, ready.tension
        drawn = march(*parts, case.speed, case.window, still, ready.give, ready.travel)
        work += drawn.updates
        if not whole or not _unfinished(case, drawn):
            return drawn, ready, work
        left = _time_to_rest(case, drawn)
        longer = max(_MORE * case.window, case.window + left + _CONTOURS_AT_REST * case.line.contour_time)
        if math.isinf(longer) or _seconds(longer, case, carried, most) > _MOST_SECONDS:
            return drawn, ready, work
        case = replace(case, window=longer)


def _unfinished(case: Moving, drawn: Drawn) -> bool:
    """Whether the belt of a stop that comes to an end as a rigid body still runs at the end of a march."""
    rests = case.brings_to_rest and math.isfinite(case.rigid_time)
    return rests and not any(seen.belt <= 0 for seen in drawn.head)


def _mean_speed(case: Moving, drawn: Drawn, until: float = 1.0) -> float:
    """Mean speed of the belt at the head over a contour time that ends at a part of the window [m/s]: waves that go
    round have that period."""
    belt = np.array([seen.belt for seen in drawn.head])
    end = max(round(until * len(belt)), 1)
    many = max(round(case.line.contour_time / float(drawn.times[1])), 1)
    return float(belt[max(end - many, 0) : end].mean())


def _time_to_rest(case: Moving, drawn: Drawn) -> float:
    """Time that a belt which still runs at the end of a march takes to come to rest [s]; infinite where it never does.

        t = M v/(W + T_2 (1 - exp(-mu alpha)) + B_tail)     a pulley that slips, T_2 kept by the take-up
        t = v_2 (t_2 - t_1)/(v_1 - v_2)                      otherwise, by the means in mid-window and at its end

    **Range** a stop whose brakes act fully: what is left is a constant force.
    **Error** that of the mean speeds; centrifugal tension at the present speed.
    **Source** Newton's law for the whole belt; Euler-Eytelwein.
    """
    speed = _mean_speed(case, drawn)
    force = _force_of_grip(case, drawn, speed)
    if force is not None:
        mass = moving_mass(case.line) - case.line.drive_mass  # the braked pulley stands
        return mass * speed / force if force > 0 else math.inf
    slows = _mean_speed(case, drawn, 0.5) - speed
    return speed * float(drawn.times[-1]) / 2 / slows if slows > 0 else math.inf


def _force_of_grip(case: Moving, drawn: Drawn, speed: float) -> float | None:
    """Force that slows a belt down which slips on the only pulley at the head [N]; None where that is not known."""
    line, slips = case.line, drawn.head[-1].slips
    if line.fixed_length or line.grip_exponent is None or len(slips) != 1 or not slips[0]:
        return None
    tight = line.takeup_tension - line.belt_line_mass * speed**2
    acting = brakes_of(case.spec, case.scene).values()
    at_tail = sum(braking(case.spec, brake).force for brake in acting if brake.at == "tail")
    return line.static_resistance + line.tail_pull - tight * math.expm1(-line.grip_exponent) + at_tail


def _never_rests(case: Moving, drawn: Drawn) -> bool:
    """Whether a belt slips on its braked pulley until an hour is over: grip does not exceed the pull of the load."""
    force = _force_of_grip(case, drawn, _mean_speed(case, drawn))
    return force is not None and _time_to_rest(case, drawn) > _HOUR


def _so_far(case: Moving, loads: Mapping[str, Found], runs: Sequence[_March]) -> dict[str, Found]:
    """Loads of a stop that is simulated up to a time at which the belt still runs: at least as bad as by then."""
    drawn = runs[-1].drawn
    window = float(drawn.times[-1])
    found = deep_sag.certain(case, loads, loads, window)
    least = min(_way_so_far(run.drawn) for run in runs)
    left = math.inf if _never_rests(case, drawn) else _time_to_rest(case, drawn)
    rest = {"stop_time": (window, window + left)} | dict.fromkeys(
        ways_of(case.scene), (least, least + _mean_speed(case, drawn) * left / 2)
    )
    for name, (low, value) in rest.items():
        endless = Estimate.exact(math.inf)
        found[name] = Found(endless if math.isinf(left) else Estimate(value, low, math.inf, numerical=math.inf))
    return found


def _way_so_far(drawn: Drawn) -> float:
    """Distance of the belt at the head in the window [m]."""
    belt = np.array([seen.belt for seen in drawn.head])
    return float((belt[1:] + belt[:-1]).sum()) / 2 * float(drawn.times[1])


def _open_end(case: Moving, drawn: Drawn) -> str:
    """How a stop stands whose window ends before its motion does."""
    if not _unfinished(case, drawn):
        return ""
    how = ", a pulley slips" if any(drawn.head[-1].slips) else ""
    return f"belt at {drawn.head[-1].belt:.3g} of {case.line.speed:.3g} m/s{how}"


def _failures(case: Moving, drawn: Drawn, ready: Set) -> Iterator[Failure]:
    """A stop that never comes to an end: the grip of the braked pulley does not exceed the pull of the load."""
    if not _unfinished(case, drawn) or not _never_rests(case, drawn):
        return
    belt, time = drawn.head[-1].belt, float(drawn.times[-1])
    (drum,) = ready.head.drums
    reason = f"the belt slips on the braked pulley `{drum.name}` and does not stop: {belt:.3g} m/s after {time:.3g} s"
    for code in ("CNV101", "CNV106", "CNV107"):
        yield Failure(
            code, reason, ("takeup", "tension"), "increase the take-up tension, or add a brake on a second pulley"
        )


def _until_it_grips(case: Moving, usual: float) -> Callable[[float, Seen], bool]:
    """Ends the march of a start after its usual window [s], when no drum at the head slips."""
    kept = _keeps_its_grip(case)

    def ends(time: float, head: Seen) -> bool:
        kept(time, head)
        return time >= usual and not _slides(head)

    return ends


def _slips_on(case: Moving, drawn: Drawn) -> bool:
    """Whether a start ends with a drum that slips."""
    return isinstance(case.scene, Start) and _slides(drawn.head[-1])


def _slides(seen: Seen) -> bool:
    """Whether a drum turns at another speed than the belt; one that gives all its grip at the belt's speed does not."""
    return any(sense and drum != seen.belt for sense, drum in zip(seen.slips, seen.drums, strict=True))


def _still(case: Moving) -> Callable[[float, Seen], bool]:
    """Ends the march of a stop: so long after the first drum at the head came to rest."""
    rested: list[float] = []
    kept = _keeps_its_grip(case)

    def still(time: float, head: Seen) -> bool:
        kept(time, head)
        if case.brings_to_rest and not rested and head.belt <= 0:
            rested.append(time)
        return bool(rested) and time >= rested[0] + 2 * case.line.contour_time

    return still


def _keeps_its_grip(case: Moving) -> Callable[[float, Seen], None]:
    """Stops the march of a belt that its slipping drum has lost.

    Raises:
        _GripLostError: a drum at the head slips and its belt pushes harder than it ever pulled while it ran evenly:
            grip below 0 would drive it, faster and faster.
    """
    lowest = -max(map(abs, (*case.line.static_ends(RETURN), *case.line.static_ends(CARRY))))

    def kept(time: float, head: Seen) -> None:
        if any(head.slips) and min(head.tensions) < lowest:
            raise _GripLostError(time)

    return kept


def _histories(case: Moving, drawn: Drawn, ready: Set) -> dict[str, History]:
    """Tensions and grip of every drive over time, and the extreme tensions over the way round the loop."""
    times = drawn.times.tolist()

    def over_time(values: FloatArray, quantity: units.Quantity = units.FORCE) -> History:
        return History(quantity, times, np.asarray(values, float).tolist())

    found = {
        "tension_run_on_max": over_time(np.array([seen.tensions[0] for seen in drawn.head])),
        "tension_run_off_min": over_time(np.array([seen.tensions[-1] for seen in drawn.head])),
    }
    names, grips = case.spec.all_drives, []
    for station, history in ((ready.head, drawn.head), (ready.tail, drawn.tail)):
        belt = np.array([seen.belt for seen in history])
        for index, drum in enumerate(station.drums):
            if drum.name not in names:
                continue
            on, off = (np.array([seen.tensions[index + end] for seen in history]) for end in (0, 1))
            found[of("tension_run_on_max", drum.name)] = over_time(on)
            found[of("tension_run_off_min", drum.name)] = over_time(off)
            given = names[drum.name].drum
            if given.friction is not None:
                lift = case.line.belt_line_mass * belt**2
                used = capstan.slip_utilisation(
                    np.maximum(on, off), np.minimum(on, off), lift, given.friction * given.wrap
                )
                slips = np.array([bool(seen.slips[index]) for seen in history])
                used = np.where(slips, np.maximum(used, 1.0), used)
                found[of("slip_utilisation_max", drum.name)] = over_time(used, units.RATIO)
                grips.append(used)
    if grips:
        found["slip_utilisation_max"] = over_time(np.max(grips, axis=0), units.RATIO)
    middle = (ready.course.places[1:] + ready.course.places[:-1]) / 2
    found["tension_max"] = History(units.FORCE, middle.tolist(), drawn.highest.tolist(), units.SPAN)
    found["tension_min"] = History(units.FORCE, middle.tolist(), drawn.lowest.tolist(), units.SPAN)
    return found


def _estimate(name: str, value: float, sides: Interval) -> Estimate:
    least = 0.0 if family(name) in SLIPS else -math.inf
    bar = max(-sides.low, sides.high)
    if not math.isfinite(value):
        return Estimate.exact(value) if math.isfinite(bar) else Estimate(value, least, math.inf, numerical=math.inf)
    return Estimate(value, max(value + sides.low, least), value + sides.high, numerical=bar)


# -- what is said besides -------------------------------------------------------------------------------------------


def _findings(case: Moving, drawn: Drawn) -> Iterator[Finding]:
    """A belt without idler pitches that goes slack; of one with them, the run with its spans tells more."""
    sags = case.spec.effects.get("sag") != "off"
    for low, strand in ((drawn.back_min, case.line.back), (drawn.carry_min, case.line.carry)):
        if low.value < 0 and not (sags and strand.span_weight):
            yield Finding(
                "NUM102",
                f"the belt goes slack at {low.time:.3g} s, {low.place:.4g} m after the drive pulley; the results of"
                " the time after that are not reliable",
                ("takeup", "tension"),
                "a higher `tension` keeps the belt taut",
            )


def _events(drawn: Drawn, ready: Set) -> Iterator[Event]:
    words = {0: "sticks", 1: "slips, faster than the belt", -1: "slips, slower than the belt"}
    found = []
    for station, history in ((ready.head, drawn.head), (ready.tail, drawn.tail)):
        for index, drum in enumerate(station.drums):
            before = 0
            for k, seen in enumerate(history):
                if seen.slips[index] != before:
                    found.append(Event(float(drawn.times[k]), drum.name, words[before], words[seen.slips[index]]))
                    before = seen.slips[index]
    yield from sorted(found, key=lambda event: event.time)


def cost(spec: Conveyor, scene: ConveyorScene, carried: frozenset[str], level: int) -> float:
    """Seconds predicted from steps and cells of the three grids; a finer setting adds one to those before it."""
    case = moving(spec, scene)
    grids = _grids(scene, level)[-1 if level else 0 :]
    return 1e-3 + sum(_seconds(case.window, case, carried, cells) for cells in grids)


def _seconds(window: float, case: Moving, carried: frozenset[str], cells: int) -> float:
    """Seconds predicted of a march on one grid."""
    gives = "sag" in carried or ("belt_damping" in carried and case.spec.belt.damping is not None)
    per_step, per_cell = _SECONDS["giving" if gives else "straight"]
    rubber = rubber_of(case, cells) if "belt_damping" in carried else None
    steps = window / case.line.contour_time * cells * math.sqrt(1 + (rubber.stiffer if rubber else 0.0))
    return steps * (per_step + cells * per_cell)


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


def valid_witness(spec: Conveyor, scene: ConveyorScene) -> Criterion | None:
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
    used = bounds.enclosed_loads(case, bounds.enclose(case, 0.0)).get("slip_utilisation_max")
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
    gives=OF_NETWORK.union(PER_DRIVE, DRIVE),
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
    valid=valid_witness,
)
