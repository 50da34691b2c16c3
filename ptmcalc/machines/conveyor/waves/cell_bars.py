"""Bars of what a belt in cells gives, from three grids, each with twice the cells of the one before.

A load is the largest value of a trace, and the largest values of two grids may agree by chance. So three readings tell
what halving the cells still changes of it: the last difference d2, half of the one before it, d1, and half of the
largest gap g between the whole traces of the last two grids (a front that comes a coarse step later is no gap):

    D = d2 + d1/2 + g/2

Where errors go as the cells, the first order of a front of sticking or slipping, a half of the last difference and a
half of the gap are each still to come. Peaks between fronts that cells smear come more slowly: an extreme that halving
the cells brings to r = 2/3 of its error only, the order 0.6, has still to come

    bar = D (r + r^2 + ...) = 2 D

A scene ends up to a step after its window: what comes to its extreme at its end is known to its last step besides.

In a scene in which a drum stops from one moment to the next, fronts are steps, and between two of them that meet almost
together stands a pulse that no grid sees, differing from what was before or is after it by the height F of one of them:
there no tension is known better than F.

What is computed of tensions has the bar that its law makes of theirs. A drum begins and ceases to slip from a step to a
step: to its way of slip come two of the longest ways in a step, and to its heat what it heats on them; to time and
distance of a stop in which it slips come two steps and the uncertainty of its first standstill (`rest_of`).

The order is taken from the seeded samples of `tests/coverage/test_network_intervals.py`: of 2800 extremes in 290
scenes without such a stop, none took more than 0.8 of its bar; of 500 in 65 scenes with one, none more than 0.6.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ptmcalc.base.estimate import ANYTHING, NOTHING, Estimate, Interval
from ptmcalc.contract.result import family, of
from ptmcalc.laws import capstan
from ptmcalc.machines.conveyor.machine.loads import (
    BRAKING_FORCE,
    BRAKING_RESERVE,
    GRIP,
    OF_BRAKES,
    OF_STOP,
    SLIPS,
    TENSIONS,
)
from ptmcalc.machines.conveyor.machine.model import grips
from ptmcalc.machines.conveyor.machine.motion import Moving
from ptmcalc.machines.conveyor.machine.rigid_stop import deceleration
from ptmcalc.machines.conveyor.stopping.brake_heat import moved_heat
from ptmcalc.machines.conveyor.waves import load_errors
from ptmcalc.machines.conveyor.waves.cell_loads import LOW_CARRY, LOW_PLACES, LOW_RETURN, OneGrid, Values
from ptmcalc.numerics import peaks
from ptmcalc.numerics.belt.march import Drawn

Grids = tuple[OneGrid, OneGrid, OneGrid]

_SLOWEST = 2 / 3
"""Part r of the error that halving the cells leaves [1], of the order 0.6. Calibrated on the samples of
`tests/coverage/test_network_intervals.py`: no extreme took more than 0.8 of its bar. The bar is proportional to r/(1 -
r), here 2."""
_SHIFT_STEPS = 1
"""Coarse steps by which a front may come later on the finer grid without a gap [1]. Derived: a front moves by at most
one step. A larger value hides real gaps; 0 reports the height of every front as an error."""
_STEPS_OF_SLIP = 2
"""Longest slip distances of one step that the error bar of a slip distance includes [1]. Derived: a pulley begins and
ends to slip at a step each. A smaller value omits one end."""
_FEWEST = 4
"""Minimum number of steps of a stop of which a mean speed is known [1]; a numerical choice. A larger value leaves very
short stops without an error bar."""
_ROUNDING = 1e-11
"""Rounding of sums and differences of tensions, relative to the largest [1]. A numerical choice above the resolution
2e-16 of the floating point times the number of additions. A larger value widens bars that are otherwise 0."""
_SLIPPING = (math.nextafter(1, 2), math.nextafter(1, 0))
"""Grip used and reserve of a drum that slips [1], as `cell_loads` sets them."""
_MOVES = frozenset({*TENSIONS, "tension_run_off_min", "starting_force_needed", BRAKING_FORCE})
"""Families of forces whose traces tell what is still to come of them."""


_TRACES = {
    "tension_dynamic_run_on_max": "tension_run_on_max",
    "tension_curve_max": "tension_max",
    "tension_bend_max": "tension_max",
    "tension_bend_min": LOW_PLACES,
}
"""Traces of loads that have none of their own."""


@dataclass(frozen=True, slots=True)
class Rest:
    """How uncertain the first standstill of the belt at the head is, to either side: time [s] and distance [m]."""

    time: Interval
    distance: Interval


CERTAIN = Rest(NOTHING, NOTHING)
"""Of a scene that does not bring the belt to rest."""


def bars(case: Moving, grids: Grids, front: float, rest: Rest) -> dict[str, Interval]:
    """Bars of all loads of the finest grid, to either side: a drum that transmits little may have any reserve above its
    least. `front` is the height F of the module [N], 0 where nothing jumps; `rest`, how uncertain the first standstill
    of a stop is in which a pulley slips."""
    fine = grids[-1].values
    found: dict[str, Interval] = {}
    for name in fine:
        if family(name) in _MOVES:
            bar = _still_to_come(grids, name)
            found[name] = _either(max(bar, front) if bar else 0.0)
    change = max(one.high for name, one in found.items() if family(name) in TENSIONS)
    moved = _moved(case, fine, change)
    found |= _of_laws(case, grids, found, front)
    found |= _of_slip(grids)
    found |= _of_slipping_stop(case, grids, rest)
    found |= _of_grip(case, grids, found, moved)
    for name, (value, _) in fine.items():
        if family(name) in SLIPS and value == 0 and not _holds(fine, found, name):
            found[name] = load_errors.anything(name, Estimate.exact(value))
        elif name not in found:
            found[name] = _either(max(_still_to_come(grids, name), moved.get(name, NOTHING).high))
    return {name: _rounded(one, name, fine) for name, one in found.items()}


def rest_of(drawn: Drawn) -> Rest:
    """Uncertainty of the first standstill of a belt whose speed at the head swings by s about a falling mean.

        -(s - u)/a <= dt <= u/a,   -(s^2 - u^2)/(2 a) <= ds <= u^2/(2 a)

    a: deceleration of the mean; u: mean speed when the head first stands still on this grid, between 0 and s as it is
    in truth. If a pulley slips, the mean falls slowly and a small change makes it one swing earlier or later.

    **Range** any stop; infinite where the belt does not slow down, 0 where it does not come to rest.
    **Error** the mean is a straight line over the second half of the stop.
    **Source** kinematics; verified by `tests/machines/conveyor/test_slipping_stops.py`.
    """
    belt, times = drawn.head.belt, drawn.times
    stands = belt <= 0
    if not stands.any():
        return CERTAIN
    last = int(stands.argmax()) + 1
    part = slice(last // 2, last)
    slope, level = np.polyfit(times[part], belt[part], 1) if last >= _FEWEST else (0.0, 0.0)
    if slope >= 0:
        return Rest(ANYTHING, ANYTHING)
    about = belt[part] - slope * times[part] - level
    swing, slows = float(np.ptp(about)), -float(slope)
    mean = min(max(float(level + slope * times[last - 1]), 0.0), swing)
    return Rest(
        Interval(-(swing - mean) / slows, mean / slows),
        Interval(-(swing**2 - mean**2) / (2 * slows), mean**2 / (2 * slows)),
    )


def front_at(drawn: Drawn) -> float:
    """The highest front at head and tail: the most that a tension there changes by within one step [N]."""
    return max(
        float(np.abs(np.diff(history.tensions[:, end])).max(initial=0.0))
        for history in (drawn.head, drawn.tail)
        for end in (0, -1)
    )


def _either(bar: float) -> Interval:
    return Interval(-bar, bar)


def _still_to_come(grids: Grids, name: str) -> float:
    """What all finer grids together may change of a load."""
    extremes = [one.values[name][0] if name in one.values else math.inf for one in grids]
    return _to_come(grids, _TRACES.get(family(name), name), extremes)


def _of_trace(grids: Grids, name: str) -> float:
    """The same of the extreme of a trace that all grids have."""
    return _to_come(grids, name, [one.traces[name].extreme()[0] for one in grids])


def _to_come(grids: Grids, trace: str, extremes: Sequence[float]) -> float:
    one, two, three = extremes
    if one == two == three:
        return 0.0
    if not all(map(math.isfinite, extremes)):
        return math.inf
    gap, at_end = _gap(grids, trace), grids[-1].traces[trace].at_end if trace in grids[-1].traces else 0.0
    return _SLOWEST / (1 - _SLOWEST) * (abs(three - two) + abs(two - one) / 2 + gap / 2) + at_end


def _gap(grids: Grids, name: str) -> float:
    """Largest gap between the traces of the last two grids, either of which may have what the other has not: how far
    any value of the one is from all values of the other within a coarse step; 0 of what has no trace."""
    _, coarse, fine = grids
    if name not in coarse.traces or name not in fine.traces:
        return 0.0
    one, other = coarse.traces[name], fine.traces[name]
    reach = math.ceil(_SHIFT_STEPS * one.step / other.step)
    at = np.arange(len(other.values)) * other.step
    at = at[at <= (len(one.values) - 1) * one.step]
    again, values = np.interp(at, np.arange(len(one.values)) * one.step, one.values), other.values[: len(at)]
    if not (np.isfinite(again).all() and np.isfinite(values).all()):
        return math.inf
    return max(peaks.gap(values, again, reach), peaks.gap(again, values, reach))


def _moved(case: Moving, fine: Values, change: float) -> dict[str, Interval]:
    """What the largest error of any tension [N] makes of the loads that are no tensions."""
    loads = {name: Estimate.exact(value) for name, (value, _) in fine.items()}
    held = case.imposed is not None and case.brings_to_rest  # the head comes to rest on time
    slowing = math.inf if held else deceleration(case.spec, case.scene, case.line)
    heavy = case.spec.takeup_weight > 0
    parts = load_errors.Change.any_time(change)
    return load_errors.moved(case.spec, case.line, loads, parts, slowing, off=heavy)


def _of_laws(case: Moving, grids: Grids, found: Mapping[str, Interval], front: float) -> dict[str, Interval]:
    """Bars of what is computed of one tension."""
    line, fine = case.line, grids[-1].values
    loads = {name: Estimate.exact(value) for name, (value, _) in fine.items()}
    made: dict[str, Interval] = {}
    if "belt_safety_min" in fine:
        made |= load_errors.moved_safety(line, loads, found["tension_max"].high)
    if "sag_relative_max" in fine:
        names = (LOW_RETURN, LOW_CARRY, LOW_PLACES) if line.by_length else (LOW_RETURN, LOW_CARRY)
        strands = max(_of_trace(grids, name) for name in names)
        made["sag_relative_max"] = load_errors.moved_sag(line, loads, max(strands, front))
    if "starting_reserve" in fine:
        made["starting_reserve"] = load_errors.moved_drive(loads, found["starting_force_needed"].high)[
            "starting_reserve"
        ]
    if BRAKING_RESERVE in fine:
        braked = load_errors.moved_braking(line, loads, found[BRAKING_FORCE].high)
        made[BRAKING_RESERVE] = braked[BRAKING_RESERVE]
    return made


def _of_slip(grids: Grids) -> dict[str, Interval]:
    """Bars of the way and the heat of drums that slip."""
    fine = grids[-1]
    found = {}
    for drum, step in fine.slid.items():
        way, heat = of("slip_distance", drum), of("slip_heat", drum)
        ends, slid = _STEPS_OF_SLIP * step, fine.values[way][0]
        found[way] = _either(_still_to_come(grids, way) + ends)
        heats = fine.values[heat][0] / slid if slid else 0.0
        found[heat] = _either(_still_to_come(grids, heat) + ends * heats)
    return found


def _of_slipping_stop(case: Moving, grids: Grids, rest: Rest) -> dict[str, Interval]:
    """Error bars of time and distances of a stop in which a pulley slips on every grid; empty for other scenes."""
    fine = grids[-1]
    if not all(any(one.slid.values()) for one in grids):
        return {}
    ends = _STEPS_OF_SLIP * fine.traces["tension_run_on_max"].step
    found = {}
    for name, (value, _) in fine.values.items():
        if name in OF_STOP and math.isfinite(value):
            timed = name == "stop_time"
            bar = _still_to_come(grids, name) + ends * (1.0 if timed else case.speed)
            sides = rest.time if timed else rest.distance
            found[name] = Interval(sides.low - bar, sides.high + bar)
        elif family(name) in OF_BRAKES:
            found[name] = _either(_still_to_come(grids, name) + moved_heat(case.spec, name, ends * case.speed).high)
    return found


def _of_grip(
    case: Moving, grids: Grids, found: Mapping[str, Interval], moved: Mapping[str, Interval]
) -> dict[str, Interval]:
    """Bars of the grip of every drum, and of the worst of them: by the traces of one that slips on no grid; none of one
    that surely slips; what the largest error of any tension makes of one that slips on some grids, or so little that it
    may not slip at all."""
    fine, exponents = grids[-1].values, grips(case.spec)
    made: dict[str, Interval] = {}
    for name in fine:
        kind, _, drum = name.partition("[")
        if kind not in GRIP or not drum:
            continue
        drum = drum[:-1]
        way = of("slip_distance", drum)
        if all(name in one.traces for one in grids):
            made[name] = _of_ratio(grids, name, exponents[drum])
        elif all(drum in one.slid for one in grids) and fine[way][0] + found[way].low > 0:
            made[name] = NOTHING
        else:
            made[name] = moved[name]
    for kind in GRIP:
        ends = [(fine[name][0] + one.low, fine[name][0] + one.high) for name, one in made.items()
                if family(name) == kind]  # fmt: skip
        if kind in fine and ends:
            worst = max if kind == "slip_utilisation_max" else min
            low, high = (worst(end) for end in zip(*ends, strict=True))
            made[kind] = load_errors.around(fine[kind][0], [low, high])
    return made


def _of_ratio(grids: Grids, name: str, exponent: float) -> Interval:
    """The bar of the grip used, which is a ratio of tensions, or of the reserve that a ratio leaves."""
    bar, ratio = _of_trace(grids, name), grids[-1].traces[name].extreme()[0]
    if family(name) == "slip_utilisation_max" or not math.isfinite(ratio):
        return _either(bar)
    ends = [capstan.slip_reserve_ratio(ratio + part, exponent) for part in (bar, -bar)]
    return load_errors.around(grids[-1].values[name][0], ends)


def _holds(fine: Values, found: Mapping[str, Interval], name: str) -> bool:
    """Whether a drum surely keeps its grip."""
    used = name.replace(family(name), "slip_utilisation_max", 1)
    return used not in fine or fine[used][0] + found[used].high < 1


def _rounded(one: Interval, name: str, fine: Values) -> Interval:
    """A bar with rounding: of the largest tension, of which all tensions are sums and differences, or of the load; a
    drum that surely slips has no bar, since its grip is exactly in use."""
    if family(name) in GRIP and one == NOTHING and fine[name][0] in _SLIPPING:
        return one
    size = fine["tension_max" if family(name) in {*TENSIONS, "tension_run_off_min"} else name][0]
    rounding = _ROUNDING * abs(size) if math.isfinite(size) else 0.0
    return Interval(one.low - rounding, one.high + rounding)
