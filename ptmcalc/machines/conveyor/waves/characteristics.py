"""A start by the method of characteristics: waves on both strands, tail, take-up, slip and sag in one run."""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base import units
from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Finding, Found, History, Result, family, of
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import capstan, sag
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor.loads import DRIVE, OF_BELT, PER_DRIVE, SLIPS
from ptmcalc.machines.conveyor.model import StartCase, delay_lines_do, plainness, slides_at_rest, start_case
from ptmcalc.machines.conveyor.motion import AFTER_START
from ptmcalc.machines.conveyor.spec import Conveyor, Start
from ptmcalc.machines.conveyor.traction.slip import slip_loads
from ptmcalc.machines.conveyor.waves import bounds
from ptmcalc.machines.conveyor.waves.after_start import MODES, ending, still_to_come
from ptmcalc.machines.conveyor.waves.last_motions import Kept
from ptmcalc.numerics import loop, peaks, sagging, strand

FloatArray = NDArray[np.float64]

_FEWEST, _MOST_CELLS, _MOST_SAGGING_CELLS = 16, 450, 50
"""Cells of the carrying strand at the first level; numerical choices. `_FEWEST`: minimum; fewer do not resolve a wave.
`_MOST_CELLS` and `_MOST_SAGGING_CELLS`: maximum without and with sag; time grows with the square of the cells. More
cells narrow the error bars of short rises, which the error estimate covers otherwise."""
_MARGIN, _SLIP_MARGIN, _SAGGING_MARGIN = 1.5, 2.0, 3.0
"""Safety factors on errors estimated from grids [1]; numerical choices. `_MARGIN`: at second order. `_SLIP_MARGIN`:
with slip, where the order is lost. `_SAGGING_MARGIN`: with sag, whose fronts are steep. Smaller values lose the safety
of the bar; larger ones widen it."""
_SHIFT_STEPS = 2
"""Coarse steps by which a steep front may be displaced between two grids without a gap [1]. A numerical choice. A
larger value hides real gaps; a smaller one reports the height of a displaced front as an error."""
_LONGER = 4
"""Doublings of the window in which a slipping pulley may stick again; a numerical choice. More follow longer slip and
take longer."""
_STICKS = 1e-6
"""Difference of pulley and belt speed relative to the rated speed [1] that counts as rounding. A numerical choice. A
larger value ends slip too early; a smaller one reports rounding as slip."""
_SECOND_ORDER, _SLOWEST = 0.25, 0.9
"""Limits of the ratio of the differences of three grids [1]; numerical choices. `_SECOND_ORDER`: minimum, 1/4 at second
order, as two grids may agree by chance. `_SLOWEST`: maximum, of grids that converge slowly. Larger values widen the
error bar."""
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

    **Range** linear belt, idler resistance as if the whole belt slid forward; the result reports a belt that goes slack
    or runs backward.
    **Error** estimated from the differences of grids of halved step, two without sag and three with it; second order
    without slip and sag, otherwise first order. The error bars are derived in `_straight_bars` and `_sagging_bars`.
    **Source** method of characteristics; pulley and tail by the exponential step; derived in `numerics.strand`.
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
    bars = _sagging_bars(case, *motions) if "sag" in carried else _straight_bars(case, *motions)
    fine = motions[-1]
    loads = _loads(case, fine, bars)
    (only,) = spec.all_drives
    loads |= {of(name, only): loads[name] for name in PER_DRIVE & loads.keys()}
    belt, drum = float(fine.belt_speed[-1]), float(fine.drum_speed[-1])
    slips = fine.slipped and abs(drum - belt) > _STICKS * case.line.speed
    known = next((one for one in reversed(motions) if len(one.ending.pulls) <= MODES), motions[0])
    end = ending(case.line, min(belt, drum), slips, known.ending, known.tail)
    if case.line.grip_exponent is not None:
        loads |= slip_loads(case, only, case.line.grip_exponent, motions, (bars.on, bars.off))
    findings = _findings(case, fine, "sag" in carried)
    if any(finding.code == "NUM102" for finding in findings):
        sure = _surely_as_low(case, motions)
        loads = {name: _beyond_range(name, found, sure) for name, found in loads.items()}
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
        histories=lambda: _histories(case, only, fine, "sag" in carried),
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


def _surely_as_low(case: StartCase, motions: list[loop.Motion]) -> dict[str, float]:
    """Smallest tensions that a belt surely came down to before it left the range of its run [N]: the highest that any
    of the grids finds, and as much above it as they differ."""
    off = [motion.smallest(motion.run_off)[0] for motion in motions]
    lows = [[min(low, motion.back_min.value) for low, motion in zip(off, motions, strict=True)]]
    lows.append([motion.carry_min.value for motion in motions])
    back, carry = (2 * max(values) - min(values) for values in lows)
    return {"tension_min": min(back, carry)} | bounds.derived_loads(case.line, math.inf, (back, carry))


def _beyond_range(name: str, found: Found, sure: dict[str, float]) -> Found:
    """A load of a run that left its range: not known any more, but that the belt came so low is certain."""
    estimate = found.estimate
    if name in ("tension_min", "slack_margin_min"):
        high = max(estimate.value, min(estimate.high, sure[name]))
        return Found(Estimate(estimate.value, -math.inf, high, estimate.numerical, math.inf), found.at)
    if family(name) in SLIPS:
        return Found(Estimate(estimate.value, 0.0, math.inf, estimate.numerical, math.inf), found.at)
    return Found(Estimate.unknown(estimate.value), found.at)


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


@dataclass(frozen=True, slots=True)
class _Bars:
    """Numerical error of tensions at the drum's run-on and run-off [N], and of the extremes inside the strands in the
    order of `_inside`."""

    on: float
    off: float
    inside: tuple[float, ...]


def _straight_bars(case: StartCase, coarse: loop.Motion, fine: loop.Motion) -> _Bars:
    """Bars of a grid and its refinement, from the waves all tensions are sums of and from the extremes themselves.

    Histories that differ by at most d have extremes that differ by at most d, and every tension is half a sum of the
    waves that leave drum, tail and take-up. With d the largest difference of those waves on both grids, a third of it
    is the error of the finer grid at second order, and 1.5 times that is the bar. Where slip begins between grid
    lines the order is lost: the bar is twice d, and what corners between samples may hide inside the strands
    (`Extreme.missed`). No bar is below the difference of the extreme itself on both grids. The mismatch of the travel
    times shifts every echo by at most that part of the elapsed time: that shift times the steepest slope is added.
    """
    waves = _wave_error(coarse, fine) * (_SLIP_MARGIN if fine.slipped else _MARGIN / 3)
    waves += _shift_error(fine, case.window)
    on, off = (max(waves, *_end_errors(coarse, fine, end)) for end in ("run_on", "run_off"))
    apart = _inside_errors(coarse, fine)
    missed = [waves + extreme.missed * fine.slipped for extreme in _inside(fine)]
    inside = tuple(max(on, off, *both) for both in zip(apart, missed, strict=True))
    return _Bars(on, off if case.line.fixed_length else 0.0, inside)


def _end_errors(coarse: loop.Motion, fine: loop.Motion, end: str) -> list[float]:
    """Differences of the extremes at one end of the drum as they are reported, on both grids [N]."""
    one, other = getattr(coarse, end), getattr(fine, end)
    top, bottom = coarse.largest(one)[0] - fine.largest(other)[0], coarse.smallest(one)[0] - fine.smallest(other)[0]
    return [abs(top), abs(bottom)]


def _inside_errors(coarse: loop.Motion, fine: loop.Motion) -> list[float]:
    """Differences of the extremes inside the strands on both grids [N]."""
    return [abs(one.value - other.value) for one, other in zip(_inside(coarse), _inside(fine), strict=True)]


def _sagging_bars(case: StartCase, coarsest: loop.Motion, coarse: loop.Motion, fine: loop.Motion) -> _Bars:
    """Bars of a grid and its refinements where fronts are steep.

    The extremes of all three grids are compared: with d the last difference and r its ratio to the one before, the
    differences still to come sum up to d r/(1 - r). The bar of an extreme is three times that, with r not taken below
    1/4 (second order; two grids may agree by chance) nor above 0.9, and inside the strands no less than at the drum.

    At the drum, whose history decides about slip at every moment, two more hold. A steep front that moves a little
    differs by its whole height, which no extreme does: every value of one history is looked for among the values of
    the other within a few steps, and one and a half times the largest gap is the bar. It is never below what the
    history bends between two samples at its extremes.
    """
    reach = math.ceil(_SHIFT_STEPS * coarse.grid.step / fine.grid.step)

    def still_to_come(before: float, last: float) -> float:
        last = max(last, _SECOND_ORDER * before)
        ratio = min(last / before, _SLOWEST) if before > 0 else _SECOND_ORDER
        return _SAGGING_MARGIN * last * ratio / (1 - ratio)

    def end(name: str) -> float:
        one, other = getattr(coarse, name), getattr(fine, name)
        again = np.interp(fine.times, coarse.times, one)
        apart = max(peaks.gap(other, again, reach), peaks.gap(again, other, reach))
        errors = map(still_to_come, _end_errors(coarsest, coarse, name), _end_errors(coarse, fine, name))
        return max(_MARGIN * apart, *errors)

    least = _bend(fine.run_on)
    on, off = max(end("run_on"), least), end("run_off")
    off = max(off, least) if case.line.fixed_length else 0.0
    inside = map(still_to_come, _inside_errors(coarsest, coarse), _inside_errors(coarse, fine))
    return _Bars(on, off, tuple(max(error, on, off) for error in inside))


def _bend(history: FloatArray) -> float:
    """What a history does between the samples next to its extremes: an eighth of the second difference."""
    second = np.abs(np.diff(history, 2)) / 8
    near = [abs(second[max(top - 2, 0) : top + 2]).max(initial=0.0) for top in (history.argmax(), history.argmin())]
    return float(max(near))


def _inside(motion: loop.Motion) -> tuple[loop.Extreme, ...]:
    return motion.carry_max, motion.carry_min, motion.back_max, motion.back_min


def _wave_error(coarse: loop.Motion, fine: loop.Motion) -> float:
    """Largest difference of a tension on a grid and on its refinement [N]."""
    n = min(coarse.waves.shape[1], (fine.waves.shape[1] + 1) // 2)
    both = np.abs(fine.waves[:, : 2 * n - 1 : 2] - coarse.waves[:, :n]).max(axis=1)
    pairs = (both[0] + both[1], both[2] + both[3])  # a tension is half the sum of the two waves of its strand
    return float(max(pairs)) / 2


def _shift_error(motion: loop.Motion, window: float) -> float:
    """Mismatch of the travel times, as a time shift of all echoes, times the steepest slope of the waves [N]."""
    slope = np.abs(np.diff(motion.waves, axis=1)).max(axis=1) / motion.grid.step
    return float(max(slope[0] + slope[1], slope[2] + slope[3])) / 2 * motion.grid.mismatch * window


def _loads(case: StartCase, motion: loop.Motion, bars: _Bars) -> dict[str, Found]:
    line = case.line
    on, on_at = motion.largest(motion.run_on)
    off, off_at = motion.smallest(motion.run_off)
    carry_max, carry_min, back_max, back_min = zip(_inside(motion), bars.inside, strict=True)
    run_on = loop.Extreme(on, on_at, line.back.length + line.carry.length), bars.on
    run_off = loop.Extreme(off, off_at, 0.0), bars.off
    high, largest = _highest([run_on, carry_max, back_max])
    low, smallest = _lowest([run_off, back_min, carry_min])
    lows = _lowest([run_off, back_min])[1], _lowest([carry_min])[1]

    def at(time: float) -> dict[str, float]:
        return {"time": time + case.held}

    top = at(high.time) | {"position": high.position}
    bottom = at(low.time) | {"position": low.position}
    floor = 1e-12 * abs(high.value)  # rounding
    loads = {
        "tension_run_on_max": Found(Estimate.within(on, bars.on + floor), at(on_at)),
        "tension_dynamic_run_on_max": Found(Estimate.within(on - line.run_on, bars.on + floor), at(on_at)),
        "tension_run_off_min": Found(Estimate.within(off, bars.off), at(off_at)),
        "tension_max": Found(largest, top),
        "tension_min": Found(smallest, bottom),
    }
    states = (
        bounds.derived_loads(line, largest.value, tuple(part.value for part in lows)),
        bounds.derived_loads(line, largest.high, tuple(part.low for part in lows)),
        bounds.derived_loads(line, largest.low, tuple(part.high for part in lows)),
    )
    for name in states[0]:
        where = top if name == "belt_safety_min" else bottom
        loads[name] = Found(_spread(*(state[name] for state in states)), where)
    if line.grip_exponent is not None:
        loads |= _slip(case, line.grip_exponent, motion, bars)
    if case.imposed_speed:
        loads |= _drive_force(case, motion, bars.on + bars.off)
    return loads


def _highest(candidates: list[tuple[loop.Extreme, float]]) -> tuple[loop.Extreme, Estimate]:
    """The largest of several extremes, each with its bar, and what the largest can be."""
    top = max((extreme for extreme, _ in candidates), key=lambda extreme: extreme.value)
    ends = (max(extreme.value + sign * bar for extreme, bar in candidates) for sign in (1, -1))
    return top, _spread(top.value, *ends)


def _lowest(candidates: list[tuple[loop.Extreme, float]]) -> tuple[loop.Extreme, Estimate]:
    """The smallest of several extremes, each with its bar, and what the smallest can be."""
    bottom = min((extreme for extreme, _ in candidates), key=lambda extreme: extreme.value)
    ends = (min(extreme.value + sign * bar for extreme, bar in candidates) for sign in (1, -1))
    return bottom, _spread(bottom.value, *ends)


def _slip(case: StartCase, exponent: float, motion: loop.Motion, bars: _Bars) -> dict[str, Found]:
    """Worst grip over time, with the bars of both tensions carried through the formulas."""
    lift = case.line.belt_line_mass * motion.belt_speed**2
    driving = motion.run_on >= motion.run_off
    tight, slack = np.maximum(motion.run_on, motion.run_off), np.minimum(motion.run_on, motion.run_off)
    tight_bar, slack_bar = np.where(driving, bars.on, bars.off), np.where(driving, bars.off, bars.on)
    sides = [(tight + side * tight_bar, slack - side * slack_bar) for side in (0, -1, 1)]
    worst = [_largest(capstan.slip_utilisation(*pair, lift, exponent), motion) for pair in sides]
    used = [value for value, _ in worst]
    ratios = [_largest(capstan.slip_utilisation(*pair, 0.0, exponent), motion)[0] for pair in sides]
    left = [capstan.slip_reserve_ratio(ratio, exponent) for ratio in ratios]
    at = {"time": worst[0][1] + case.held}
    found = {"slip_utilisation_max": Found(_spread(*used), at), "slip_reserve_min": Found(_spread(*left), at)}
    if motion.slipped:
        found = _used_up(found, float((slack - lift - slack_bar).min()) > 0)
    return found


def _largest(history: FloatArray, motion: loop.Motion) -> tuple[float, float]:
    """Largest value of a history and its time; the first infinite sample where there is one."""
    if np.isfinite(history).all():
        return motion.largest(history)
    at = int(np.argmax(history))
    return float(history[at]), float(motion.times[at])


def _used_up(found: dict[str, Found], held: bool) -> dict[str, Found]:
    """Grip of a belt that slipped: exactly all of it in use as long as some tension is left, else perhaps lost."""
    used, left = math.nextafter(1, 2), math.nextafter(1, 0)
    states = {
        "slip_utilisation_max": Estimate.exact(used) if held else Estimate(used, used, math.inf),
        "slip_reserve_min": Estimate.exact(left) if held else Estimate(left, 0.0, left),
    }
    return {name: Found(states[name], found[name].at) for name in states}


def _histories(case: StartCase, drive: str, motion: loop.Motion, sagging_spans: bool) -> dict[str, History]:
    """Tensions at the drum and the grip in use over time, and, of waves that keep their shape, the largest and smallest
    tension over the way round the loop from the head's run-off."""
    times = (motion.times + case.held).tolist()
    found = {
        "tension_run_on_max": History(units.FORCE, times, motion.run_on.tolist()),
        "tension_run_off_min": History(units.FORCE, times, motion.run_off.tolist()),
    }
    if case.line.grip_exponent is not None:
        lift = case.line.belt_line_mass * motion.belt_speed**2
        tight, slack = np.maximum(motion.run_on, motion.run_off), np.minimum(motion.run_on, motion.run_off)
        used = capstan.slip_utilisation(tight, slack, lift, case.line.grip_exponent)
        found["slip_utilisation_max"] = History(units.RATIO, times, np.asarray(used).tolist())
    found |= {of(name, drive): history for name, history in found.items()}
    if not sagging_spans:
        places, highest, lowest = strand.envelopes(_loop(case, frozenset({"belt_wave"})), motion, case.window)
        found["tension_max"] = History(units.FORCE, places.tolist(), highest.tolist(), units.SPAN)
        found["tension_min"] = History(units.FORCE, places.tolist(), lowest.tolist(), units.SPAN)
    return found


def _drive_force(case: StartCase, motion: loop.Motion, bar: float) -> dict[str, Found]:
    """Force that the imposed speed asks of the drive, m v' + S_on - S_off."""
    force, when = motion.largest(
        case.line.drive_mass * case.drum_acceleration(motion.times) + motion.run_on - motion.run_off
    )
    spread = [bounds.drive_loads(case, force + side * bar) for side in (0, -1, 1)]
    return {name: Found(_spread(*(part[name] for part in spread)), {"time": when}) for name in spread[0]}


def _spread(value: float, one: float, other: float) -> Estimate:
    """A value with the interval of what it becomes at both ends of the bars it rests on."""
    ends = (value, one, other)
    if not all(map(math.isfinite, ends)):
        return Estimate(value, min(ends), max(ends))
    return Estimate(value, min(ends), max(ends), numerical=max(abs(one - value), abs(other - value)))


def _findings(case: StartCase, motion: loop.Motion, sagging: bool) -> list[Finding]:
    found = []
    for which, low in ((RETURN, motion.back_min), (CARRY, motion.carry_min)):
        span = case.line.strand(which).span_weight
        slack = sag.tension_at_sag(span, sag.DEEPEST) if sagging and span else 0.0
        if low.value < slack:
            found.append(
                Finding(
                    "NUM102",
                    f"the belt goes slack at {low.time + case.held:.3g} s, {low.position:.4g} m behind the drive"
                    " pulley; the results of the time after that are not reliable",
                    ("takeup", "tension"),
                    "a higher `tension` keeps the belt taut",
                )
            )
    if motion.reversed:
        found.append(
            Finding(
                "NUM104",
                "a part of the belt runs backward briefly; its idler resistance is that of forward motion",
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
