"""The whole belt in cells: any route and load, several drives, brakes, jams, idlers that stick and slide.

Bars come from three grids, each with twice the cells of the one before, load by load. With d the last difference of a
load, not taken below a quarter of the one before (two grids may agree by chance), and r the ratio of both, the
differences still to come sum up to d r/(1 - r); the bar is three times that, with r not taken below 1/2, the first
order of a front of sticking or slipping, nor above 0.9. All tensions are sums of the same waves: the largest of their
bars is that of each, and what it makes of any other load (`bounds.moved`) is the least bar of that one.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from ptmcalc.base import units
from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import NOTHING, Estimate, Interval
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Event, Finding, Found, History, Result, family, of
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import capstan
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor import bounds, deep_sag
from ptmcalc.machines.conveyor.braking import deceleration
from ptmcalc.machines.conveyor.cells import Set, rubber_of, set_up
from ptmcalc.machines.conveyor.kept import Kept
from ptmcalc.machines.conveyor.loads import DRIVE, GRIP, OF_NETWORK, PER_DRIVE, SLIPS
from ptmcalc.machines.conveyor.model import (
    BeltLine,
    FloatArray,
    belt_line,
    belt_travel,
    delay_lines_do,
    grips,
    start_case,
    starting_force,
)
from ptmcalc.machines.conveyor.moving import MOST_ROUNDS, Moving, moving
from ptmcalc.machines.conveyor.sections import Curve
from ptmcalc.machines.conveyor.spec import IN_MOTION, Conveyor, ConveyorScene, Jam, Start
from ptmcalc.machines.conveyor.static_loads import hollows
from ptmcalc.numerics import peaks
from ptmcalc.numerics.belt.march import Drawn, march
from ptmcalc.numerics.belt.station import Seen, Station

_CELLS, _CELLS_OF_JUMP = 60, 240
_MARGIN, _SECOND_ORDER, _FIRST_ORDER, _SLOWEST = 3.0, 0.25, 0.5, 0.9
_ROUNDING = 1e-11
_SHIFT_STEPS = 3
_SHORTER, _LONGER = 6, 4
_SHARING = frozenset(
    {
        "tension_run_on_max",
        "tension_dynamic_run_on_max",
        "tension_run_off_min",
        "tension_max",
        "tension_min",
        "tension_curve_max",
    }
)
"""Tensions, which are sums of the same waves."""
_WORTH = 0.015
"""Belt speed over that of its slowest wave from which on a plain start is worth simulating in cells."""
_SECONDS = {"straight": (4e-5, 1.2e-8), "giving": (1.6e-4, 1.6e-7)}
"""For a step, and for a cell of it, with and without sag or damping."""

Values = dict[str, tuple[float, dict[str, float]]]
"""Loads of one grid: the value, and where and when."""


def run(spec: Conveyor, scene: ConveyorScene, carried: frozenset[str], level: int) -> Result:
    """Loads of a scene in which the belt moves, from three grids.

    **Range** any scene in motion; a belt whose tension falls below 0 is not what this computes, and says so. Of a belt
    that sags too deep on the way only what came before is told (`deep_sag`).
    **Error** as the module says: an estimate from three grids, held on the seeded sample of the coverage tests.
    **Source** method of characteristics with lumped idlers; derived in `numerics.belt`.
    """
    case = moving(spec, scene)
    try:
        loads, runs = _computed(case, carried, level)
    except _GripLostError as lost:
        return _before(case, carried, level, lost)
    drawn, ready = runs[-1].drawn, runs[-1].ready
    findings = list(_findings(case, drawn))
    if "sag" in carried and deep_sag.too_deep(case, drawn):
        window = deep_sag.trusted_window(case, drawn)
        early, more = _computed(replace(case, window=window), carried, level, whole=False) if window else ({}, [])
        runs = more + runs
        loads = deep_sag.certain(case, loads, early, window)
        findings = [deep_sag.finding(case, drawn, window)]
    return Result(
        loads,
        work=sum(part.work for part in runs),
        window=(0.0, float(drawn.times[-1])),
        health={"energy_residual": drawn.energy_residual, "cells": ready.course.cells},
        findings=tuple(findings),
        events=tuple(_events(drawn, ready)),
        histories=lambda: _histories(case, drawn, ready),
    )


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
            findings=(deep_sag.taut(f"loses its tension on a slipping drum at {lost.time:.3g} s", window),),
            events=tuple(_events(drawn, ready)),
        )
    raise NumericsError("NUM102", f"the belt loses its tension on a slipping drum at {lost.time:.3g} s")


@dataclass(frozen=True, slots=True)
class _March:
    """A march on one grid: its loads, what the belt did, and how many cells that took."""

    values: Values
    drawn: Drawn
    ready: Set
    work: int


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
    coarsest, coarse, fine = runs = [_marched(case, carried, cells, whole) for cells in _grids(case.scene, level)]
    apart = _apart(coarse.drawn, fine.drawn, not _jumps(case.scene))
    bars = _bars(case, (coarsest.values, coarse.values, fine.values), apart, fine.ready.course.step)
    found = {name: Found(_estimate(name, value, bars[name]), place) for name, (value, place) in fine.values.items()}
    return found, runs


def _marched(case: Moving, carried: frozenset[str], cells: int, whole: bool) -> _March:
    """The march on one grid, made now or kept from before."""
    causes = cells, carried, whole, *_causes(case)
    drawn, ready, work = _KEPT.of(causes, lambda: _once(case, carried, cells, whole))
    return _March(_loads(case, drawn, ready), drawn, ready, work)


def _once(case: Moving, carried: frozenset[str], cells: int, whole: bool) -> tuple[Drawn, Set, int]:
    """A march on one grid; of the `whole` scene until a belt that comes to rest has done so, whatever slips."""
    work = 0
    for _ in range(_LONGER):
        ready = set_up(case, carried, cells)
        still = _still(case)
        parts = ready.course, ready.head, ready.tail, ready.tension
        drawn = march(*parts, case.speed, case.window, still, ready.give, ready.travel)
        work += drawn.updates
        rests = case.brings_to_rest and math.isfinite(case.rigid_time)
        if not (whole and rests) or any(seen.belt <= 0 for seen in drawn.head):
            return drawn, ready, work
        case = replace(case, window=2 * case.window)
    raise NumericsError("NUM101", f"the belt still runs after {case.window / 2:.3g} s")


def _still(case: Moving) -> Callable[[float, Seen], bool]:
    """Ends the march of a stop: so long after the first drum at the head came to rest.

    Raises:
        _GripLostError: a drum at the head slips and its belt pushes harder than it ever pulled while it ran evenly:
            grip below 0 would drive it, faster and faster.
    """
    rested: list[float] = []
    lowest = -max(map(abs, (*case.line.static_ends(RETURN), *case.line.static_ends(CARRY))))

    def still(time: float, head: Seen) -> bool:
        if any(head.slips) and min(head.tensions) < lowest:
            raise _GripLostError(time)
        if case.brings_to_rest and not rested and head.belt <= 0:
            rested.append(time)
        return bool(rested) and time >= rested[0] + 2 * case.line.contour_time

    return still


# -- loads of one grid ----------------------------------------------------------------------------------------------


def _loads(case: Moving, drawn: Drawn, ready: Set) -> Values:
    line, step = case.line, ready.course.step
    head, belt = drawn.head, np.array([seen.belt for seen in drawn.head])
    values: Values = {}
    for station, history in ((ready.head, head), (ready.tail, drawn.tail)):
        values |= _of_drives(case, station, history, step)
    on = np.array([seen.tensions[0] for seen in head])
    off = np.array([seen.tensions[-1] for seen in head])
    top, top_at = peaks.largest(on, step)
    low, low_at = peaks.smallest(off, step)
    values["tension_run_on_max"] = top, {"time": top_at}
    values["tension_dynamic_run_on_max"] = top - line.run_on, {"time": top_at}
    values["tension_run_off_min"] = low, {"time": low_at}
    highs, lows = zip(*(_of_strand(drawn, ready, strand) for strand in (RETURN, CARRY)), strict=True)
    high, lowest = max(highs), min(lows)
    values["tension_max"] = high[0], {"time": high[1], "position": high[2]}
    values["tension_min"] = lowest[0], {"time": lowest[1], "position": lowest[2]}
    for curve in hollows(case.spec):
        values[of("tension_curve_max", str(curve.number))] = _in_curve(line, drawn, ready, curve), {}
    for name, value in bounds.derived_loads(line, high[0], tuple(one[0] for one in lows)).items():
        values[name] = value, {}
    used = [(value, at) for name, (value, at) in values.items() if name.startswith("slip_utilisation_max[")]
    left = [(value, at) for name, (value, at) in values.items() if name.startswith("slip_reserve_min[")]
    if used and len(left) == len(used):
        values["slip_utilisation_max"] = max(used, key=lambda one: one[0])
        values["slip_reserve_min"] = min(left, key=lambda one: one[0])
    if not line.fixed_length:
        apart = belt - np.array([seen.behind - seen.creep for seen in head])
        way = np.concatenate([[0.0], np.cumsum((apart[1:] + apart[:-1]) / 2)]) * step / 2
        values["takeup_movement"] = float(way.max() - way.min()), {}
    if case.brings_to_rest:
        values |= _rest(case, belt, drawn.times)
    if case.imposed is not None and isinstance(case.scene, Start):
        values |= _asked(case, drawn, ready)
    return values


Placed = tuple[float, float, float]
"""A tension [N], its time [s] and place [m]."""


def _of_strand(drawn: Drawn, ready: Set, strand: int) -> tuple[Placed, Placed]:
    """Largest and smallest tension of a strand: in its cells, and before, between or behind the drums at its ends (what
    is between drums counts to the strand before them)."""
    step, places = ready.course.step, ready.course.places
    inside = (drawn.back_max, drawn.back_min) if strand == RETURN else (drawn.carry_max, drawn.carry_min)
    behind, before = (drawn.head, drawn.tail) if strand == RETURN else (drawn.tail, drawn.head)
    middle, whole = float(places[ready.course.tail]), float(places[-1])
    start, end = (0.0, middle) if strand == RETURN else (middle, whole)
    histories = [(np.array([seen.tensions[-1] for seen in behind]), start)]
    rows = list(zip(*(seen.tensions for seen in before), strict=True))
    histories += [(np.array(row), end) for row in rows[:-1]]
    highs = [(*peaks.largest(history, step), place) for history, place in histories]
    lows = [(*peaks.smallest(history, step), place) for history, place in histories]
    high, low = ((one.value, one.time, one.place) for one in inside)
    return max([high, *highs]), min([low, *lows])


def _in_curve(line: BeltLine, drawn: Drawn, ready: Set, curve: Curve) -> float:
    """Largest tension of the cells that a curve touches [N]."""
    places = ready.course.places - line.back.length - curve.place
    touched = (places[:-1] <= curve.tangent) & (places[1:] >= -curve.tangent)
    touched[: ready.course.tail] = False
    return float(drawn.highest[touched].max())


def _asked(case: Moving, drawn: Drawn, ready: Set) -> Values:
    """Force that an imposed speed asks of the drives together, sum (m v' + S_on - S_off), over the available one."""
    step = ready.course.step
    force = np.zeros(len(drawn.times))
    for station, history in ((ready.head, drawn.head), (ready.tail, drawn.tail)):
        if station.imposed is None:
            continue
        speed = np.array([seen.belt for seen in history])
        mass = sum(drum.mass for drum in station.drums)
        force += np.array([seen.tensions[0] - seen.tensions[-1] for seen in history]) + mass * np.gradient(speed, step)
    needed, at = peaks.largest(force, step)
    available = starting_force(case.spec)
    reserve = available / needed if needed > 0 else math.inf
    return {"starting_force_needed": (needed, {"time": at}), "starting_reserve": (reserve, {})}


def _rest(case: Moving, belt: FloatArray, times: FloatArray) -> Values:
    """When and where the belt at the head comes to rest for the first time."""
    name = "coast_distance" if case.scene.type == "coast" else "stop_distance"
    stopped = np.flatnonzero(belt <= 0)
    if not len(stopped):
        return {"stop_time": (math.inf, {}), name: (math.inf, {})}
    last = int(stopped[0])
    step = float(times[1])
    way = float((belt[1:last] + belt[: last - 1]).sum()) / 2 * step if last > 1 else 0.0
    before = float(belt[last - 1])
    slope = (float(belt[last - 2]) - before) / step if last > 1 else 0.0
    part = min(before / slope, step) if slope > 0 else step
    return {"stop_time": (float(times[last - 1]) + part, {}), name: (way + before * part / 2, {})}


def _of_drives(case: Moving, station: Station, history: tuple[Seen, ...], step: float) -> Values:
    """Loads of the drums that have a drive."""
    values: Values = {}
    names = case.spec.all_drives
    for index, drum in enumerate(station.drums):
        if drum.name not in names:
            continue
        on = np.array([seen.tensions[index] for seen in history])
        off = np.array([seen.tensions[index + 1] for seen in history])
        top, top_at = peaks.largest(on, step)
        low, low_at = peaks.smallest(off, step)
        values[of("tension_run_on_max", drum.name)] = top, {"time": top_at}
        values[of("tension_run_off_min", drum.name)] = low, {"time": low_at}
        given = names[drum.name].drum
        if given.friction is None:
            continue
        belt = np.array([seen.belt for seen in history])
        tight, slack = np.maximum(on, off), np.minimum(on, off)
        lift = case.line.belt_line_mass * belt**2
        exponent = given.friction * given.wrap
        slipped = any(seen.slips[index] for seen in history)
        if slipped:
            first = next(k for k, seen in enumerate(history) if seen.slips[index])
            used, at = math.nextafter(1, 2), first * step
            reserve = math.nextafter(1, 0)
        else:
            used, at = _largest(capstan.slip_utilisation(tight, slack, lift, exponent), step)
            ratio, _ = _largest(capstan.slip_utilisation(tight, slack, 0.0, exponent), step)
            reserve = capstan.slip_reserve_ratio(ratio, exponent)
        values[of("slip_utilisation_max", drum.name)] = used, {"time": at}
        values[of("slip_reserve_min", drum.name)] = reserve, {"time": at}
        values[of("slip_distance", drum.name)] = float(station.slid[index]), {}
        values[of("slip_heat", drum.name)] = float(station.heat[index]), {}
    return values


def _histories(case: Moving, drawn: Drawn, ready: Set) -> dict[str, History]:
    """Tensions and grip of every drive over time, and the largest tension over the way round the loop."""
    times = drawn.times.tolist()

    def over_time(values: FloatArray, quantity: units.Quantity = units.FORCE) -> History:
        return History(quantity, times, np.asarray(values, float).tolist())

    found = {
        "tension_run_on_max": over_time(np.array([seen.tensions[0] for seen in drawn.head])),
        "tension_run_off_min": over_time(np.array([seen.tensions[-1] for seen in drawn.head])),
    }
    names = case.spec.all_drives
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
    middle = (ready.course.places[1:] + ready.course.places[:-1]) / 2
    found["tension_max"] = History(units.FORCE, middle.tolist(), drawn.highest.tolist(), units.SPAN)
    return found


def _largest(history: FloatArray, step: float) -> tuple[float, float]:
    """Largest value of a history and its time; the first infinite sample where there is one."""
    if np.isfinite(history).all():
        return peaks.largest(history, step)
    at = int(np.argmax(history))
    return float(history[at]), at * step


# -- bars -----------------------------------------------------------------------------------------------------------


def _bars(case: Moving, grids: tuple[Values, Values, Values], moved_most: float, step: float) -> dict[str, Interval]:
    """Bars of all loads of the finest grid: what is still to come of the load itself, and what the largest error of any
    tension makes of it, to either side: a drum that transmits little may have any reserve above its least.

    Slip comes and goes in phases that join and part as the grid is refined, each known to a step of the belt's way: of
    slip the larger of both differences counts, and no less than such a step.
    """
    coarsest, coarse, fine = grids
    bars: dict[str, float] = {}
    for name, (value, _) in fine.items():
        known = [grid[name][0] if name in grid else math.inf for grid in (coarsest, coarse)]
        slid = family(name) in SLIPS and value > 0
        bars[name] = _still_to_come(known[0], known[1], value, 1.0 if slid else _SECOND_ORDER)
        if slid:
            way = fine[name.replace("slip_heat", "slip_distance")][0]
            bars[name] = max(bars[name], value / way * case.line.speed * step)
    change = max(*(bars[name] for name in fine if family(name) in _SHARING), _MARGIN / 2 * moved_most)
    line, slowing = case.line, deceleration(case.spec, case.scene, case.line)
    values = {name: Estimate.exact(value) for name, (value, _) in fine.items()}
    asked = len({drive.at for drive in case.spec.all_drives.values()}) if case.imposed is not None else 0
    off = case.spec.takeup.mass is not None
    moved = bounds.moved(line, values, change, slowing, grips(case.spec), off, asked)
    sides = {}
    for name, (value, _) in fine.items():
        slid = family(name) in SLIPS and value > 0
        offsets = NOTHING if slid else moved.get(name, NOTHING)
        size = fine["tension_max"][0] if family(name) in _SHARING else value
        rounding = _ROUNDING * abs(size) if math.isfinite(size) else 0.0
        down, up = max(bars[name], -offsets.low) + rounding, max(bars[name], offsets.high) + rounding
        if family(name) not in GRIP:
            down = up = max(down, up)
        sides[name] = Interval(-down, up)
    return sides


def _apart(coarse: Drawn, fine: Drawn, smooth: bool) -> float:
    """Largest gap between the tensions at head and tail on both grids [N]: how far any value of one history is from all
    values of the other within a few coarse steps; and the highest front, the change within one step. A front that comes
    a little later is no gap, but where it meets another one, they add up for a moment that only a finer grid sees. The
    steps of a drum that stops at once, which is not `smooth`, are sharp on every grid and count as gaps only."""
    reach = math.ceil(_SHIFT_STEPS * coarse.times[1] / fine.times[1])
    most = 0.0
    for side in ("head", "tail"):
        for end in (0, -1):
            one, other = (np.array([seen.tensions[end] for seen in getattr(drawn, side)]) for drawn in (coarse, fine))
            until = min(coarse.times[-1], fine.times[-1])
            again = np.interp(fine.times, coarse.times, one)[fine.times <= until]
            front = float(np.abs(np.diff(other)).max(initial=0.0)) if smooth else 0.0
            most = max(most, peaks.gap(other[fine.times <= until], again, reach), front)
    return most


def _still_to_come(one: float, two: float, three: float, least: float) -> float:
    if one == two == three:
        return 0.0
    if not all(map(math.isfinite, (one, two, three))):
        return math.inf
    before, last = abs(two - one), abs(three - two)
    last = max(last, least * before)
    ratio = min(max(last / before, _FIRST_ORDER), _SLOWEST) if before > 0 else _FIRST_ORDER
    return _MARGIN * last * ratio / (1 - ratio)


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
                f"the belt goes slack at {low.time:.3g} s, {low.place:.4g} m behind the drive's run-off; what the"
                " simulation says of the time after that is not trusted",
                ("takeup", "tension"),
                "a higher `tension` keeps the belt taut",
            )


def _events(drawn: Drawn, ready: Set) -> Iterator[Event]:
    words = {0: "sticks", 1: "slips, ahead of the belt", -1: "slips, behind the belt"}
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
    gives = "sag" in carried or ("belt_damping" in carried and spec.belt.damping is not None)
    per_step, per_cell = _SECONDS["giving" if gives else "straight"]
    seconds = 1e-3
    for cells in _grids(scene, level)[-1 if level else 0 :]:
        rubber = rubber_of(case, cells) if "belt_damping" in carried else None
        steps = case.window / case.line.contour_time * cells * math.sqrt(1 + (rubber.stiffer if rubber else 0.0))
        seconds += steps * (per_step + cells * per_cell)
    return seconds


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
        return Criterion("plain", 1.0, 1.0, "a plain start, which the delay lines carry", "solvers.characteristics")
    return _simulable(spec, scene)


def valid_running(spec: Conveyor, scene: ConveyorScene) -> Criterion | None:
    """The same for a plain start, of which only what the running belt carries along is left to the cells.

        v/c, belt speed over that of its slowest wave, read from the other side: below 0.015 the bound of that effect is
        narrower than the bars of the cells, unless a drum may slip: it has no bound of how far;
        1 for anything but a plain start;   else as `valid`

    **Range** any scene in motion.
    **Error** exact; the limit of 0.015 is an engineering choice, and none for a file that asks for `moving_belt: on`.
    **Source** as `valid`.
    """
    if not _plain(spec, scene):
        return Criterion("plain", 1.0, 1.0, "no plain start: the network carries it", "solvers.network")
    speed = belt_travel(belt_line(spec, scene))
    if speed < _WORTH and spec.effects.get("moving_belt") != "on" and not _may_slip(spec, scene):
        meaning = "what the belt carries along is bounded closer than the cells know it"
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
        return Criterion("plain", 1.0, 1.0, "no plain start: the network itself is planned", "solvers.network")
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
        return Criterion("W/F", 1.0, 1.0, "static resistance over the drives' force: the belt stays at rest", "Newton")
    line = case.line
    lift = line.centrifugal_at_speed / line.run_off if line.run_off > 0 else math.inf
    if lift >= 1:
        return Criterion("rho v^2/S", lift, 1.0, "centrifugal tension over that at the run-off", "laws.capstan")
    count = case.window / line.contour_time
    if count >= MOST_ROUNDS:
        return Criterion("n", count, MOST_ROUNDS, "rounds of a wave in the time of the scene: too much work", "cost")
    return None


NETWORK: Solver[Conveyor, ConveyorScene] = Solver(
    name="network",
    title="the whole belt in cells: drives, brakes, idlers that stick and slide",
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
    title="the whole belt in cells, in a plain start: what the running belt carries along",
    always=NETWORK.always | {"moving_belt"},
    valid=valid_running,
)

CELLS: Solver[Conveyor, ConveyorScene] = replace(
    NETWORK,
    name="cells",
    title="the whole belt in cells, as a witness of what the delay lines find in a plain start",
    valid=valid_witness,
)
