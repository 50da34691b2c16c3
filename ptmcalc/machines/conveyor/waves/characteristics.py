"""A start by the method of characteristics: waves on both strands, tail, take-up, slip and sag in one run."""

import math
from dataclasses import replace

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Result, of
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor.machine.loads import DRIVE, OF_BELT, PER_DRIVE
from ptmcalc.machines.conveyor.machine.motion import AFTER_START
from ptmcalc.machines.conveyor.machine.plain_start import delay_lines_do, plainness, slides_at_rest
from ptmcalc.machines.conveyor.machine.scenes import Start
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.machine.start_case import StartCase, start_case
from ptmcalc.machines.conveyor.traction.slip import slip_loads
from ptmcalc.machines.conveyor.waves.after_start import MODES, ending, still_to_come
from ptmcalc.machines.conveyor.waves.last_motions import Kept
from ptmcalc.machines.conveyor.waves.strand_bars import sagging_bars, straight_bars
from ptmcalc.machines.conveyor.waves.strand_loads import belt_loads, beyond_range, findings_of, histories, surely_as_low
from ptmcalc.numerics import loop, sagging, strand

_FEWEST, _MOST_CELLS, _MOST_SAGGING_CELLS = 16, 450, 50
"""Cells of the carrying strand at the first level; numerical choices. `_FEWEST`: minimum; fewer do not resolve a wave.
`_MOST_CELLS` and `_MOST_SAGGING_CELLS`: maximum without and with sag; time grows with the square of the cells. More
cells narrow the error bars of short rises, which the error estimate covers otherwise."""
_LONGER = 4
"""Doublings of the window in which a slipping pulley may stick again; a numerical choice. More follow longer slip and
take longer."""
_STICKS = 1e-6
"""Difference of pulley and belt speed relative to the rated speed [1] that counts as rounding. A numerical choice. A
larger value ends slip too early; a smaller one reports rounding as slip."""
_TAIL_SHARE = 5.0
"""Weight of the time constant of the tail pulley in the choice of the step [1]. A numerical choice: the tail acts more
weakly and needs a fifth of the steps. A smaller value takes more cells for heavy tail pulleys."""
_STEPS_PER_SCALE = 20
"""Steps in the shortest time in which the waves change [1]. A numerical choice: the time grows with its square, the
error falls with it. The error bar is estimated from two or three grids at any value."""
_SECONDS = {"delays": (1.0e-6, 6.6e-10), "grip": (3.6e-6, 8.7e-10), "sag": (4.0e-5, 2.0e-8)}
"""Seconds per step, and per step and cell, without slip, with slip and with sag. Measured once; only their ratios to
those of other solvers matter. Wrong values change the order of the solvers and the predicted time, no load."""
_OVERHEAD = 3e-3
"""Predicted seconds of a run in addition to its steps; measured once. It decides between fast solvers only."""


def run(spec: Conveyor, scene: Start, carried: frozenset[str], level: int) -> Result:
    """Loads of a start from the waves of both strands, with exact wave transport (`numerics.strand`).

    Simulated effects: `belt_wave` always; `tail_jump` (without it the return strand has the impedance of the carrying
    strand), `tail_mass`, `slip`, `sag`. Refinement `level` halves the cells of both of its grids.

    **Range** linear belt, idler resistance as if the whole belt slid forward; a belt that goes slack or runs
    backward leaves it, which the result says.
    **Error** estimated from the differences of grids of halved step, two without sag and three with it; of second
    order without slip and sag, else of first. The bars are derived in `strand_bars`.
    **Source** method of characteristics; drum and tail by the exponential step; derived in `numerics.strand`.
    """
    case = start_case(spec, scene)
    if not case.moves:
        raise NumericsError("NUM102", "the drive does not move the belt: there is no motion to simulate")
    grid = _grid(case, carried, level)
    case = replace(case, window=_window(case, carried, grid) * scene.window_factor)
    grids = [grid, loop.refined(grid)]
    if "sag" in carried:
        grids.append(loop.refined(grids[-1]))
    motions = [_motion(case, carried, one) for one in grids]
    bars = sagging_bars(case, *motions) if "sag" in carried else straight_bars(case, *motions)
    fine = motions[-1]
    loads = belt_loads(case, fine, bars)
    (only,) = spec.all_drives
    loads |= {of(name, only): loads[name] for name in PER_DRIVE & loads.keys()}
    belt, drum = float(fine.belt_speed[-1]), float(fine.drum_speed[-1])
    slips = fine.slipped and abs(drum - belt) > _STICKS * case.line.speed
    known = next((one for one in reversed(motions) if len(one.ending.pulls) <= MODES), motions[0])
    end = ending(case.line.speed, min(belt, drum), slips, known.ending, known.tail)
    if case.line.grip_exponent is not None:
        loads |= slip_loads(case, only, case.line.grip_exponent, motions, (bars.on, bars.off))
    findings = findings_of(case, fine, "sag" in carried)
    if any(finding.code == "NUM102" for finding in findings):
        sure = surely_as_low(case, motions)
        loads = {name: beyond_range(name, found, sure) for name, found in loads.items()}
    return Result(
        loads,
        work=sum(motion.cell_updates for motion in motions),
        window=(0.0, case.held + case.window),
        health={
            "energy_residual": fine.energy_residual,
            "steps": float(len(fine.times) - 1),
            "grid_mismatch": fine.grid.mismatch,
        },
        findings=tuple(findings),
        histories=lambda: histories(
            case, only, fine, None if "sag" in carried else _loop(case, frozenset({"belt_wave"}))
        ),
        beyond=still_to_come(spec, case.line, end, loads),
        open_end=end.state,
    )


def _window(case: StartCase, carried: frozenset[str], grid: loop.Grid) -> float:
    """The usual window [s]; of a drum that slips at its end, until it has gripped, up to some windows."""
    if case.imposed_speed:
        return case.window
    case = replace(case, window=case.window + AFTER_START * case.line.contour_time)
    if "slip" not in carried or case.line.grip_exponent is None:
        return case.window
    whole = case
    for _ in range(_LONGER):
        try:
            motion = _motion(whole, carried, grid)
        except NumericsError:  # stick and slip alternate without end later: what was seen before counts
            if whole.window == case.window:
                raise
            break
        apart = np.abs(motion.drum_speed - motion.belt_speed) > _STICKS * case.line.speed
        if not apart[-1]:
            last = np.flatnonzero(apart)
            return max(case.window, float(motion.times[last[-1]]) + 2 * grid.step) if len(last) else case.window
        whole = replace(whole, window=2 * whole.window)
    return whole.window / 2


_KEPT = Kept[loop.Motion](lambda motion: len(motion.times))


def _motion(case: StartCase, carried: frozenset[str], grid: loop.Grid) -> loop.Motion:
    """The motion on one grid, made now or kept from before."""
    march = sagging.march if "sag" in carried else strand.march
    causes = replace(case, line=replace(case.line, breaking_force=None, slack_sag=0.0)), carried, grid
    return _KEPT.of(causes, lambda: march(_loop(case, carried), _drive(case), case.window, grid))


def _loop(case: StartCase, carried: frozenset[str]) -> loop.Loop:
    line = case.line

    def one(which: int) -> loop.Strand:
        part, (start, end) = line.strand(which), line.static_ends(which)
        span = part.span_weight if "sag" in carried else None
        return loop.Strand(part.length, part.line_mass, line.stiffness, start, end, span or 0.0)

    grip = None
    if "slip" in carried and line.grip_exponent is not None:
        grip = loop.Grip(line.grip_exponent, line.belt_line_mass)
    return loop.Loop(
        carry=one(CARRY),
        back=one(RETURN),
        drum_mass=line.drive_mass,
        tail_mass=line.tail_mass if "tail_mass" in carried else 0.0,
        fixed_length=line.fixed_length,
        grip=grip,
        impedance_jump="tail_jump" in carried,
    )


def _drive(case: StartCase) -> loop.Drive:
    return (
        loop.Drive(speed=case.drum_speed) if case.imposed_speed else loop.Drive(force=case.force, hold=case.line.speed)
    )


def _time_scale(case: StartCase, carried: frozenset[str]) -> float:
    """Shortest time in which the waves change: the time constant of drum or tail (which acts more weakly, and needs
    a fifth of the steps), or the rise [s]."""
    line = case.line
    both = line.impedance(CARRY) + line.impedance(RETURN)
    tail = _TAIL_SHARE * line.tail_mass / both if "tail_mass" in carried and line.tail_mass > 0 else math.inf
    if case.imposed_speed:
        return min(case.rise_time, tail)
    impedance = line.impedance(CARRY) + (line.impedance(RETURN) if line.fixed_length else 0.0)
    return min(max(line.drive_mass / impedance, case.rise / 4), tail)


def _grid(case: StartCase, carried: frozenset[str], level: int) -> loop.Grid:
    """Cells so that a step is a small part of the time scale; travel times matched as closely as the window asks."""
    scale = _time_scale(case, carried)
    transit, other = case.line.transit(CARRY), case.line.transit(RETURN)
    cells = min(max(math.ceil(_STEPS_PER_SCALE * transit / scale), _FEWEST), _MOST_CELLS)
    if "sag" in carried:
        grid = sagging.grid_of(_loop(case, carried), min(cells // 2, _MOST_SAGGING_CELLS))
        for _ in range(level):
            grid = loop.refined(grid)
        return grid
    tolerance = min(max(4e-4 * scale / case.window / 4**level, 2e-7), 1e-3)
    return loop.match(transit, other, cells << level, tolerance, at_most=max(16 * cells, 1024) << level)


def cost(spec: Conveyor, scene: Start, carried: frozenset[str], level: int) -> float:
    """Seconds predicted from steps and cells of both grids; the rates were measured once and only their ratios
    to those of other solvers matter."""
    case = start_case(spec, scene)
    if not case.moves:
        return 0.0
    per_step, per_cell = _SECONDS["sag" if "sag" in carried else "grip" if "slip" in carried else "delays"]
    grid = _grid(case, carried, level)
    steps, cells = math.ceil(case.window / grid.step), grid.carry + grid.back
    times, squares = (7, 21) if "sag" in carried else (3, 5)  # every finer grid has twice the steps and cells
    return _OVERHEAD + times * steps * per_step + squares * steps * cells * per_cell


def valid(spec: Conveyor, scene: Start) -> Criterion:
    """Whether there is a motion to simulate.

        W/F, static resistance over available force; 0 for an imposed speed
        U_0, grip used at rest: at 1 the belt slides back before it starts, which `solvers.network` carries where it can

    **Range** any start.
    **Error** exact.
    **Source** the belt moves when the drive's force exceeds the static resistance.
    """
    plain, slides = plainness(spec, scene), slides_at_rest(spec, scene)
    if plain.exceeded:
        return plain
    if slides.exceeded and not delay_lines_do(spec, scene):
        return slides
    case = start_case(spec, scene)
    return Criterion(
        "W/F",
        0.0 if case.moves else max(case.line.static_resistance / case.available_force, 1.0),
        1.0,
        "static resistance / drive force: at 1 the belt does not move",
        "Newton's law",
    )


CHARACTERISTICS: Solver[Conveyor, Start] = Solver(
    name="characteristics",
    title="method of characteristics, carrying and return strand",
    fidelity=Fidelity.TRANSIENT,
    scenes=frozenset({Start}),
    represents=frozenset({"belt_wave", "tail_jump", "tail_mass", "slip", "sag"}),
    gives=OF_BELT.union(DRIVE, PER_DRIVE),
    run=run,
    cost=cost,
    source="method of characteristics; derived in ptmcalc.numerics.strand",
    valid=valid,
    always=frozenset({"belt_wave"}),
    levels=3,
)
