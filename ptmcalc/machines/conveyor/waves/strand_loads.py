"""Loads, histories and findings of a start by characteristics, with the error bars of its tensions."""

import math

import numpy as np

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Finding, Found, History, family, of
from ptmcalc.laws import capstan, sag
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor.machine import tension_loads
from ptmcalc.machines.conveyor.machine.loads import SLIPS
from ptmcalc.machines.conveyor.machine.model import FloatArray
from ptmcalc.machines.conveyor.machine.start_case import StartCase, drive_loads
from ptmcalc.machines.conveyor.waves.strand_bars import Bars, inside_extremes
from ptmcalc.numerics import loop, strand_envelopes


def surely_as_low(case: StartCase, motions: list[loop.Motion]) -> dict[str, float]:
    """Smallest tensions that a belt surely came down to before it left the range of its run [N]: the highest that any
    of the grids finds, and as much above it as they differ."""
    off = [motion.smallest(motion.run_off)[0] for motion in motions]
    lows = [[min(low, motion.back_min.value) for low, motion in zip(off, motions, strict=True)]]
    lows.append([motion.carry_min.value for motion in motions])
    back, carry = (2 * max(values) - min(values) for values in lows)
    return {"tension_min": min(back, carry)} | tension_loads.derived_loads(case.line, math.inf, (back, carry))


def beyond_range(name: str, found: Found, sure: dict[str, float]) -> Found:
    """A load of a run that left its range: not known any more, but that the belt came so low is certain."""
    estimate = found.estimate
    if name in ("tension_min", "slack_margin_min"):
        high = max(estimate.value, min(estimate.high, sure[name]))
        return Found(Estimate(estimate.value, -math.inf, high, estimate.numerical, math.inf), found.at)
    if family(name) in SLIPS:
        return Found(Estimate(estimate.value, 0.0, math.inf, estimate.numerical, math.inf), found.at)
    return Found(Estimate.unknown(estimate.value), found.at)


def belt_loads(case: StartCase, motion: loop.Motion, bars: Bars) -> dict[str, Found]:
    """Tensions of a motion with their bars, and what follows from them."""
    line = case.line
    on, on_at = motion.largest(motion.run_on)
    off, off_at = motion.smallest(motion.run_off)
    carry_max, carry_min, back_max, back_min = zip(inside_extremes(motion), bars.inside, strict=True)
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
        tension_loads.derived_loads(line, largest.value, tuple(part.value for part in lows)),
        tension_loads.derived_loads(line, largest.high, tuple(part.low for part in lows)),
        tension_loads.derived_loads(line, largest.low, tuple(part.high for part in lows)),
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


def _slip(case: StartCase, exponent: float, motion: loop.Motion, bars: Bars) -> dict[str, Found]:
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


def histories(case: StartCase, drive: str, motion: loop.Motion, waves: loop.Loop | None) -> dict[str, History]:
    """Tensions at the drum and the grip in use over time, and, of `waves` that keep their shape, the largest and
    smallest tension over the way round the loop from the head's run-off."""
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
    if waves is not None:
        places, highest, lowest = strand_envelopes.envelopes(waves, motion, case.window)
        found["tension_max"] = History(units.FORCE, places.tolist(), highest.tolist(), units.SPAN)
        found["tension_min"] = History(units.FORCE, places.tolist(), lowest.tolist(), units.SPAN)
    return found


def _drive_force(case: StartCase, motion: loop.Motion, bar: float) -> dict[str, Found]:
    """Force that the imposed speed asks of the drive, m v' + S_on - S_off."""
    force, when = motion.largest(
        case.line.drive_mass * case.drum_acceleration(motion.times) + motion.run_on - motion.run_off
    )
    spread = [drive_loads(case, force + side * bar) for side in (0, -1, 1)]
    return {name: Found(_spread(*(part[name] for part in spread)), {"time": when}) for name in spread[0]}


def _spread(value: float, one: float, other: float) -> Estimate:
    """A value with the interval of what it becomes at both ends of the bars it rests on."""
    ends = (value, one, other)
    if not all(map(math.isfinite, ends)):
        return Estimate(value, min(ends), max(ends))
    return Estimate(value, min(ends), max(ends), numerical=max(abs(one - value), abs(other - value)))


def findings_of(case: StartCase, motion: loop.Motion, sagging: bool) -> list[Finding]:
    """A belt that goes slack, or of which a part runs backward."""
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
