"""A start by the method of characteristics: waves on both strands, tail, take-up, slip and sag in one run."""

import math

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Finding, Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import capstan
from ptmcalc.laws.loop import CARRY, RETURN
from ptmcalc.laws.sag import tension_at_sag
from ptmcalc.machines.conveyor import bounds
from ptmcalc.machines.conveyor.model import StartCase, start_case
from ptmcalc.machines.conveyor.spec import Conveyor, Start
from ptmcalc.numerics import strand

FloatArray = NDArray[np.float64]

_FEWEST, _MOST_CELLS = 16, 400
_STEPS_PER_SCALE = 20
_SECONDS = {"delays": (2.5e-6, 2.0e-9), "grip": (4.5e-6, 2.0e-9), "sag": (9e-5, 1.1e-7)}


def run(spec: Conveyor, scene: Start, carried: frozenset[str], level: int) -> Result:
    """Loads of a start from the waves of both strands, exact in transport (`numerics.strand`).

    Carried effects: `belt_wave` always; `tail_jump` (without it the return strand has the impedance of the carry
    strand), `tail_mass`, `slip`, `sag`. Refinement `level` halves the cells of both of its grids.

    **Range** linear belt, idler resistance as if the whole belt slid forward; a belt that goes slack or runs
    backward leaves it, which the result says.
    **Error** the run is made on a grid and on its refinement. Two histories that differ by at most d have extremes
    that differ by at most d, so the bar of a tension is the largest difference of the waves leaving drum, tail and
    take-up between both grids, over 3 (the error of the finer grid at second order) or over 1 where slip or sag
    make corners between grid lines. The mismatch of the travel times shifts every echo by at most that part of the
    elapsed time; its share of the bar is that shift times the steepest slope.
    **Source** method of characteristics; drum and tail by the exponential step; derived in `numerics.strand`.
    """
    case = start_case(spec, scene)
    if not case.moves:
        raise NumericsError("NUM102", "the drive does not move the belt: there is no motion to simulate")
    grid = _grid(case, carried, level)
    loop, drive = _loop(case, carried), _drive(case)
    coarse = strand.march(loop, drive, case.window, grid)
    fine = strand.march(loop, drive, case.window, strand.refined(grid))
    rough = fine.slipped or "sag" in carried
    bar = _wave_error(coarse, fine, 1.0 if rough else 3.0) + _shift_error(fine, case.window)
    loads = _loads(case, fine, bar)
    findings = _findings(case, fine, "sag" in carried)
    if any(finding.code == "NUM102" for finding in findings):
        loads = {name: _beyond_range(name, found) for name, found in loads.items()}
    return Result(
        loads,
        work=coarse.cell_updates + fine.cell_updates,
        window=(0.0, case.held + case.window),
        health={
            "energy_residual": fine.energy_residual,
            "steps": float(len(fine.times) - 1),
            "grid_mismatch": fine.grid.mismatch,
        },
        findings=tuple(findings),
    )


def _beyond_range(name: str, found: Found) -> Found:
    """A load of a run that left its range: not known any more, but that the belt came so low is certain."""
    estimate = found.estimate
    if name in ("tension_min", "slack_margin_min"):
        return Found(Estimate(estimate.value, -math.inf, estimate.high, estimate.numerical, math.inf), found.at)
    return Found(Estimate.unknown(estimate.value), found.at)


def _loop(case: StartCase, carried: frozenset[str]) -> strand.Loop:
    line = case.line

    def one(which: int) -> strand.Strand:
        part, (start, end) = line.strand(which), line.static_ends(which)
        span = part.span_weight if "sag" in carried else None
        return strand.Strand(part.length, part.line_mass, line.stiffness, start, end, span or 0.0)

    grip = None
    if "slip" in carried and line.grip_exponent is not None:
        grip = strand.Grip(line.grip_exponent, line.belt_line_mass)
    return strand.Loop(
        carry=one(CARRY),
        back=one(RETURN),
        drum_mass=line.drive_mass,
        tail_mass=line.tail_mass if "tail_mass" in carried else 0.0,
        fixed_length=line.fixed_length,
        grip=grip,
        impedance_jump="tail_jump" in carried,
    )


def _drive(case: StartCase) -> strand.Drive:
    return strand.Drive(speed=case.drum_speed) if case.imposed_speed else strand.Drive(force=case.force)


def _time_scale(case: StartCase) -> float:
    """Shortest time in which the waves at the drum change: the drum's own time constant, or the rise [s]."""
    line = case.line
    if case.imposed_speed:
        return case.rise_time
    impedance = line.impedance(CARRY) + (line.impedance(RETURN) if line.fixed_length else 0.0)
    return max(line.drive_mass / impedance, case.rise / 4)


def _grid(case: StartCase, carried: frozenset[str], level: int) -> strand.Grid:
    """Cells so that a step is a small part of the time scale; travel times matched as closely as the window asks."""
    scale = _time_scale(case)
    transit, other = case.line.transit(CARRY), case.line.transit(RETURN)
    cells = min(max(math.ceil(_STEPS_PER_SCALE * transit / scale), _FEWEST), _MOST_CELLS)
    if "sag" in carried:
        cells = min(cells, 100)
    tolerance = min(max(4e-4 * scale / case.window / 4**level, 2e-7), 1e-3) * (10 if "sag" in carried else 1)
    return strand.match(transit, other, cells << level, tolerance, at_most=max(16 * cells, 1024) << level)


def _wave_error(coarse: strand.Motion, fine: strand.Motion, order_factor: float) -> float:
    """Largest difference of the waves of both grids over the factor of their order [N]."""
    n = min(coarse.waves.shape[1], (fine.waves.shape[1] + 1) // 2)
    both = np.abs(fine.waves[:, : 2 * n - 1 : 2] - coarse.waves[:, :n]).max(axis=1)
    pairs = (both[0] + both[1], both[2] + both[3])  # a tension is half the sum of the two waves of its strand
    return float(max(pairs)) / 2 / order_factor


def _shift_error(motion: strand.Motion, window: float) -> float:
    """Mismatch of the travel times, as a time shift of all echoes, times the steepest slope of the waves [N]."""
    slope = np.abs(np.diff(motion.waves, axis=1)).max(axis=1) / motion.grid.step
    return float(max(slope[0] + slope[1], slope[2] + slope[3])) / 2 * motion.grid.mismatch * window


def _loads(case: StartCase, motion: strand.Motion, bar: float) -> dict[str, Found]:
    line = case.line
    on, on_at = motion.largest(motion.run_on)
    off, off_at = motion.smallest(motion.run_off)
    high = max(motion.carry_max, motion.back_max, key=lambda extreme: extreme.value)
    if on > high.value:
        high = strand.Extreme(on, on_at, line.back.length + line.carry.length)
    low = min(motion.carry_min, motion.back_min, key=lambda extreme: extreme.value)
    if off < low.value:
        low = strand.Extreme(off, off_at, 0.0)
    carry_low, back_low = motion.carry_min.value, min(motion.back_min.value, off)
    off_bar = bar if line.fixed_length else 0.0
    floor = 1e-12 * abs(high.value)

    def at(time: float) -> dict[str, float]:
        return {"time": time + case.held}

    loads = {
        "tension_run_on_max": Found(Estimate.within(on, bar + floor), at(on_at)),
        "tension_dynamic_run_on_max": Found(Estimate.within(on - line.run_on, bar + floor), at(on_at)),
        "tension_run_off_min": Found(Estimate.within(off, off_bar), at(off_at)),
        "tension_max": Found(Estimate.within(high.value, bar + floor), at(high.time) | {"position": high.position}),
        "tension_min": Found(Estimate.within(low.value, bar + floor), at(low.time) | {"position": low.position}),
    }
    spread = [
        bounds.derived_loads(line, high.value + sign * bar, (back_low - sign * bar, carry_low - sign * bar))
        for sign in (0, -1, 1)
    ]
    for name in spread[0]:
        extreme = loads["tension_max" if name == "belt_safety_min" else "tension_min"]  # where it occurs
        loads[name] = Found(_spread(*(part[name] for part in spread)), extreme.at)
    if line.grip_exponent is not None:
        loads |= _slip(case, line.grip_exponent, motion, bar, off_bar)
    if case.imposed_speed:
        loads |= _drive_force(case, motion, bar + off_bar)
    return loads


def _slip(case: StartCase, exponent: float, motion: strand.Motion, bar: float, off_bar: float) -> dict[str, Found]:
    """Worst grip over time, with the bars of both tensions carried through the formulas."""
    lift = case.line.belt_line_mass * motion.belt_speed**2
    found = {}
    for name, law, worst, sign in (
        ("slip_utilisation_max", capstan.slip_utilisation, motion.largest, 1),
        ("slip_reserve_min", capstan.slip_reserve_force, motion.smallest, -1),
    ):
        values = []
        for side in (0, -1, 1):
            tight = np.maximum(motion.run_on, motion.run_off) + side * bar
            slack = np.minimum(motion.run_on, motion.run_off) - side * (
                off_bar or (bar * (motion.run_on < motion.run_off))
            )
            history = law(tight, slack, lift, exponent)
            values.append(worst(history) if np.isfinite(history).all() else _plain(history, motion, sign))
        (value, when), (less, _), (more, _) = values
        found[name] = Found(_spread(value, less, more), {"time": when + case.held})
    if motion.slipped:  # the grip was used up: at least 1 in use, less than 1 in reserve
        used, left = found["slip_utilisation_max"], found["slip_reserve_min"]
        found["slip_utilisation_max"] = Found(_clipped(used.estimate, math.nextafter(1, 2), math.inf), used.at)
        found["slip_reserve_min"] = Found(_clipped(left.estimate, 0.0, math.nextafter(1, 0)), left.at)
    return found


def _clipped(estimate: Estimate, low: float, high: float) -> Estimate:
    value, a, b = (min(max(number, low), high) for number in (estimate.value, estimate.low, estimate.high))
    return Estimate(value, a, b, estimate.numerical, estimate.model)


def _plain(history: FloatArray, motion: strand.Motion, sign: int) -> tuple[float, float]:
    at = int(np.argmax(sign * history))
    return float(history[at]), float(motion.times[at])


def _drive_force(case: StartCase, motion: strand.Motion, bar: float) -> dict[str, Found]:
    """Force that the imposed speed asks of the drive, m v' + S_on - S_off."""
    step = motion.grid.step
    rate = np.gradient(case.drum_speed(motion.times), step)
    if case.shape == "ramp":
        rate = np.where(motion.times <= case.rise_time, case.acceleration, 0.0)
    force, when = motion.largest(case.line.drive_mass * rate + motion.run_on - motion.run_off)
    spread = [bounds.drive_loads(case, force + side * bar) for side in (0, -1, 1)]
    return {name: Found(_spread(*(part[name] for part in spread)), {"time": when}) for name in spread[0]}


def _spread(value: float, one: float, other: float) -> Estimate:
    """A value with the interval of what it becomes at both ends of the bars it rests on."""
    ends = (value, one, other)
    if not all(map(math.isfinite, ends)):
        return Estimate(value, min(ends), max(ends))
    return Estimate(value, min(ends), max(ends), numerical=max(abs(one - value), abs(other - value)))


def _findings(case: StartCase, motion: strand.Motion, sagging: bool) -> list[Finding]:
    found = []
    for which, low in ((RETURN, motion.back_min), (CARRY, motion.carry_min)):
        span = case.line.strand(which).span_weight
        slack = tension_at_sag(span, case.line.slack_sag) if sagging and span else 0.0
        if low.value < slack:
            found.append(
                Finding(
                    "NUM102",
                    f"the belt goes slack at {low.time + case.held:.3g} s, {low.position:.4g} m behind the drive's"
                    " run-off; what the simulation says of the time after that is not trusted",
                )
            )
    if motion.reversed:
        found.append(
            Finding(
                "NUM104",
                "a part of the belt runs backward for a moment; its idler resistance is taken as if it ran forward",
            )
        )
    return found


def cost(spec: Conveyor, scene: Start, carried: frozenset[str], level: int) -> float:
    """Seconds predicted from steps and cells of both grids; the rates were measured once and only their ratios
    to those of other solvers matter."""
    case = start_case(spec, scene)
    if not case.moves:
        return 0.0
    per_step, per_cell = _SECONDS["sag" if "sag" in carried else "grip" if "slip" in carried else "delays"]
    grid = _grid(case, carried, level)
    steps, cells = math.ceil(case.window / grid.step), grid.carry + grid.back
    return 3 * steps * per_step + 5 * steps * cells * per_cell  # the finer grid has twice the steps and cells


def valid(spec: Conveyor, scene: Start) -> Criterion:
    """Whether there is a motion to simulate.

        W/F, static resistance over available force; 0 for an imposed speed

    **Range** any start.
    **Error** exact.
    **Source** the belt moves when the drive's force exceeds the static resistance.
    """
    case = start_case(spec, scene)
    return Criterion(
        "W/F",
        0.0 if case.moves else max(case.line.static_resistance / case.available_force, 1.0),
        1.0,
        "static resistance over the drive's force: at 1 the belt stays at rest",
        "Newton's law",
    )


CHARACTERISTICS: Solver[Conveyor, Start] = Solver(
    name="characteristics",
    title="waves on both strands, all effects in one run",
    fidelity=Fidelity.TRANSIENT,
    scenes=frozenset({Start}),
    represents=frozenset({"belt_wave", "tail_jump", "tail_mass", "slip", "sag"}),
    gives=frozenset(
        {
            "tension_run_on_max",
            "tension_dynamic_run_on_max",
            "tension_run_off_min",
            "tension_max",
            "tension_min",
            "slack_margin_min",
            "slip_utilisation_max",
            "slip_reserve_min",
            "belt_safety_min",
            "sag_relative_max",
            "starting_force_needed",
            "starting_reserve",
        }
    ),
    run=run,
    cost=cost,
    source="method of characteristics; derived in ptmcalc.numerics.strand",
    valid=valid,
    levels=3,
)
