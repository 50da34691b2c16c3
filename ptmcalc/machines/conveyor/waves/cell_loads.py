"""Loads of a belt in cells that marched on one grid, and the traces whose largest values most of them are."""

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ptmcalc.contract.result import of
from ptmcalc.laws import capstan
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor.curves.loads import bend_names
from ptmcalc.machines.conveyor.machine import tension_loads
from ptmcalc.machines.conveyor.machine.brakes import brakes_of, braking_at_shaft
from ptmcalc.machines.conveyor.machine.keys.route import Curve
from ptmcalc.machines.conveyor.machine.loads import (
    BELT_SPEED,
    BRAKE_HEAT,
    BRAKING_FORCE,
    BRAKING_POWER,
    BRAKING_RESERVE,
    MOTOR_SPEED,
    RUN_BACK_DISTANCE,
    RUN_BACK_SPEED,
    may_run_back,
)
from ptmcalc.machines.conveyor.machine.model import BeltLine, FloatArray, braking_force, starting_force, turns
from ptmcalc.machines.conveyor.machine.motion import Moving
from ptmcalc.machines.conveyor.machine.resistances import filled
from ptmcalc.machines.conveyor.machine.scenes import ControlledStop, Start
from ptmcalc.machines.conveyor.stopping.brake_heat import with_power
from ptmcalc.machines.conveyor.takeup.travel import moved
from ptmcalc.machines.conveyor.waves import torque_limits
from ptmcalc.machines.conveyor.waves.cells import Set
from ptmcalc.machines.conveyor.waves.takeup_stops import sinking
from ptmcalc.numerics import peaks
from ptmcalc.numerics.belt.compiled import forces
from ptmcalc.numerics.belt.march import Drawn
from ptmcalc.numerics.belt.station import Station, Track

Values = dict[str, tuple[float, dict[str, float]]]
"""Loads of one grid: the value, and where and when."""
LOW_RETURN, LOW_CARRY = "tension_min[return]", "tension_min[carry]"
"""Traces that are no loads themselves: the lowest tension of each strand."""
LOW_PLACES = "tension_min[places]"
"""Another one: the lowest tension over the way round the loop."""


@dataclass(frozen=True, slots=True)
class Trace:
    """Something that moves, shape (n,), in steps of a quantity: its largest value is a load, or `sense` -1 its
    smallest."""

    values: FloatArray
    step: float
    sense: int = 1

    @property
    def at_end(self) -> float:
        """What it changes by in its last step, if its extreme is there."""
        signed = self.sense * self.values
        return float(signed[-1] - signed[-2]) if len(signed) > 1 and signed[-1] > signed[:-1].max() else 0.0

    def extreme(self) -> tuple[float, float]:
        """The load and where it comes; of values of which some are infinite the first of these."""
        signed = self.sense * self.values
        if np.isfinite(signed).all():
            value, at = peaks.largest(signed, self.step)
        else:
            first = int(np.argmax(signed))
            value, at = float(signed[first]), first * self.step
        return self.sense * value, at


@dataclass(frozen=True, slots=True)
class OneGrid:
    """Loads of a march on one grid, and what they come from.

    `traces` by load: over time tensions at the drums, the lowest of the belt, the force that an imposed speed asks for
    and, of drums that never slip, the ratios that grip is judged by (that of the reserve without the centrifugal
    tension); over the way round the loop the highest tension. `slid` is the way of the fastest slip in one step [m], by
    drive.
    """

    values: Values
    traces: dict[str, Trace] = field(default_factory=dict)
    slid: dict[str, float] = field(default_factory=dict)


def loads_of(case: Moving, drawn: Drawn, ready: Set) -> OneGrid:
    """All loads of a march."""
    line, step = case.line, ready.course.step
    head, belt = drawn.head, drawn.head.belt
    found = OneGrid({})
    for station, history in ((ready.head, head), (ready.tail, drawn.tail)):
        _of_drives(found, case, station, history, step)
    values, traces = found.values, found.traces
    traces["tension_run_on_max"] = on = Trace(head.tensions[:, 0], step)
    traces["tension_run_off_min"] = off = Trace(head.tensions[:, -1], step, -1)
    top, top_at = on.extreme()
    low, low_at = off.extreme()
    values["tension_run_on_max"] = top, {"time": top_at}
    values["tension_dynamic_run_on_max"] = top - line.run_on, {"time": top_at}
    values["tension_run_off_min"] = low, {"time": low_at}
    _of_belt(found, case, drawn, ready)
    used = [(value, at) for name, (value, at) in values.items() if name.startswith("slip_utilisation_max[")]
    left = [(value, at) for name, (value, at) in values.items() if name.startswith("slip_reserve_min[")]
    if used and len(left) == len(used):
        values["slip_utilisation_max"] = max(used, key=lambda one: one[0])
        values["slip_reserve_min"] = min(left, key=lambda one: one[0])
    if not line.fixed_length:
        way = sinking(case, drawn)
        values["takeup_movement"] = float(way.max() - way.min()), {}
        values |= {name: (value, {}) for name, value in moved(case.spec, way).items()}
    _speeds(found, case, drawn, ready)
    if case.brings_to_rest:
        values |= _rest(case, belt, drawn.times)
        values |= _longest_way(case, drawn, values)
    if isinstance(case.scene, Start) and may_run_back(case.spec, case.scene):
        _run_back(found, case, drawn, step)
    if isinstance(case.scene, Start) and case.scene.profile.imposes_speed:
        _asked(found, case, drawn, ready)
    _of_brakes(found, case, drawn)
    if isinstance(case.scene, ControlledStop):
        _held_back(found, case, drawn, ready)
    return found


def _of_belt(found: OneGrid, case: Moving, drawn: Drawn, ready: Set) -> None:
    """Tensions anywhere on the belt, and what follows from them."""
    line, step, values = case.line, ready.course.step, found.values
    highs, lows = zip(*(_of_strand(drawn, ready, strand) for strand in (RETURN, CARRY)), strict=True)
    high, lowest = max(highs), min(lows)
    values["tension_max"] = high[0], {"time": high[1], "position": high[2]}
    values["tension_min"] = lowest[0], {"time": lowest[1], "position": lowest[2]}
    for curve in case.spec.route.hollows:
        values[of("tension_curve_max", str(curve.number))] = _in_curve(line, drawn, ready, curve), {}
    for least, most, strand, bend in bend_names(case.spec, case.scene):
        cells = _cells_between(line, ready, strand, bend.start, bend.end)
        values[least], values[most] = (float(drawn.lowest[cells].min()), {}), (float(drawn.highest[cells].max()), {})
    lengths = tension_loads.spans_at(line, _lowest_along(line, drawn, ready))
    for name, value in tension_loads.derived_loads(line, high[0], tuple(one[0] for one in lows), lengths).items():
        values[name] = value, {}
    traces = found.traces
    traces |= {
        "tension_max": Trace(drawn.highest, 1 / len(drawn.highest)),
        "tension_min": Trace(drawn.lows.min(axis=1), step, -1),
        "slack_margin_min": Trace((drawn.lows - tension_loads.slack_limits(line)).min(axis=1), step, -1),
        LOW_RETURN: Trace(drawn.lows[:, RETURN], step, -1),
        LOW_CARRY: Trace(drawn.lows[:, CARRY], step, -1),
        LOW_PLACES: Trace(drawn.lowest, 1 / len(drawn.lowest), -1),
    }


def _lowest_along(line: BeltLine, drawn: Drawn, ready: Set) -> tuple[tuple[FloatArray, FloatArray], ...]:
    """Places along the return and the carrying strand, from their upstream ends, and the lowest tensions there."""
    tail, middles, head, low = ready.course.tail, ready.course.middles, drawn.head.tensions, drawn.tail.tensions
    ends = (head[:, -1], low[:, 0]), (low[:, -1], head[:, 0])
    parts = (drawn.lowest[:tail], middles[:tail]), (drawn.lowest[tail:], middles[tail:] - line.back.length)
    return tuple(
        (
            np.concatenate([[0.0], places, [line.strand(which).length]]),
            np.concatenate([[first.min()], lowest, [last.min()]]),
        )
        for which, ((lowest, places), (first, last)) in enumerate(zip(parts, ends, strict=True))
    )


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
    histories = [(behind.tensions[:, -1], start), *((row, end) for row in before.tensions.T[:-1])]
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


def _speeds(found: OneGrid, case: Moving, drawn: Drawn, ready: Set) -> None:
    """Largest speed of the belt at head and tail, and of the motors of each drive."""
    for name, speeds in speeds_of(case, drawn, ready).items():
        found.traces[name] = trace = Trace(speeds, ready.course.step)
        value, at = trace.extreme()
        found.values[name] = value, {"time": at}


def speeds_of(case: Moving, drawn: Drawn, ready: Set) -> dict[str, FloatArray]:
    """Speed of the belt at head and tail [m/s] and of the motors of each drive [rad/s] over time."""
    drives, found = case.spec.all_drives, {}
    for place, station, history in (("head", ready.head, drawn.head), ("tail", ready.tail, drawn.tail)):
        found[of(BELT_SPEED, place)] = history.belt
        for drum, speeds in zip(station.drums, history.drums.T, strict=True):
            if drum.name in drives:
                found[of(MOTOR_SPEED, drum.name)] = speeds * turns(drives[drum.name])
    return found


def _cells_between(line: BeltLine, ready: Set, strand: str, start: float, end: float) -> NDArray[np.bool_]:
    """The cells of a strand that a part of the route touches, which is given from the tail [m]."""
    places, tail = ready.course.places, ready.course.tail
    at = places - line.back.length if strand == "carry" else line.back.length - places
    touched = (np.minimum(at[:-1], at[1:]) < end) & (np.maximum(at[:-1], at[1:]) > start)
    touched[slice(0, tail) if strand == "carry" else slice(tail, None)] = False
    return np.asarray(touched)


def _run_back(found: OneGrid, case: Moving, drawn: Drawn, step: float) -> None:
    """How far and how fast the belt at the drives runs back."""
    lost, speed = np.zeros(len(drawn.times)), np.zeros(len(drawn.times))
    places = {drive.at for drive in case.spec.all_drives.values()}
    for history in (drawn.head, drawn.tail) if "tail" in places else (drawn.head,):
        gone = np.concatenate([[0.0], np.cumsum((history.belt[1:] + history.belt[:-1]) / 2)]) * step
        lost, speed = np.maximum(lost, np.maximum.accumulate(gone) - gone), np.maximum(speed, -history.belt)
    for name, values in ((RUN_BACK_DISTANCE, lost), (RUN_BACK_SPEED, speed)):
        found.traces[name] = trace = Trace(values, step)
        value, at = trace.extreme()
        found.values[name] = value, {"time": at}


def _asked(found: OneGrid, case: Moving, drawn: Drawn, ready: Set) -> None:
    """Force that a start on converters asks of the drives together, over the available one."""
    force = sum((one for one, _ in _of_converters(case, drawn, ready).values()), np.zeros(len(drawn.times)))
    found.traces["starting_force_needed"] = trace = Trace(force, ready.course.step)
    most, at = trace.extreme()
    needed = torque_limits.required(case, force, most)
    available = starting_force(case.spec)
    reserve = available / needed if needed > 0 else math.inf
    values = found.values
    values |= {"starting_force_needed": (needed, {"time": at}), "starting_reserve": (reserve, {})}


def _of_brakes(found: OneGrid, case: Moving, drawn: Drawn) -> None:
    """Heat of each brake: its torque times the speed of its shaft."""
    spec, heats = case.spec, {}
    for name, brake in brakes_of(spec, case.scene).items():
        drums = (drawn.head if brake.at == "head" else drawn.tail).drums
        force = braking_at_shaft(spec, brake).over(drawn.times)
        heats[of(BRAKE_HEAT, name)] = float(np.trapezoid(force * np.abs(drums[:, -1]), drawn.times))
    found.values.update({name: (heat, {}) for name, heat in with_power(spec, heats).items()})


def _held_back(found: OneGrid, case: Moving, drawn: Drawn, ready: Set) -> None:
    """Force with which the drives of a controlled stop hold the belt back together, over the available one, and the
    power that the motors which brake take back through their gears."""
    at_drives, step = _of_converters(case, drawn, ready), ready.course.step
    force, power = np.zeros(len(drawn.times)), np.zeros(len(drawn.times))
    for name, (pull, speed) in at_drives.items():
        force -= pull
        power += np.maximum(-pull * speed, 0.0) * filled(case.spec.all_drives[name].gear.efficiency)
    traces, values = found.traces, found.values
    traces[BRAKING_FORCE], traces[BRAKING_POWER] = Trace(force, step), Trace(power, step)
    for name in (BRAKING_FORCE, BRAKING_POWER):
        value, at = traces[name].extreme()
        values[name] = value, {"time": at}
    needed = torque_limits.required(case, force, values[BRAKING_FORCE][0])
    values[BRAKING_FORCE] = needed, values[BRAKING_FORCE][1]
    values[BRAKING_RESERVE] = braking_force(case.spec) / needed if needed > 0 else math.inf, {}


def _of_converters(case: Moving, drawn: Drawn, ready: Set) -> dict[str, tuple[FloatArray, FloatArray]]:
    """Force [N] and speed [m/s] of each drive on a converter over time: its share of m v' + S_on - S_off of an imposed
    speed, F(v, t) of motors on their slip lines."""
    found, both = {}, ((ready.head, drawn.head), (ready.tail, drawn.tail))
    turning = {drum.name: track.drums[:, index] for one, track in both for index, drum in enumerate(one.drums)}
    for station, history in both:
        whole = history.tensions[:, 0] - history.tensions[:, -1]
        if station.imposes:
            masses = [drum.mass for drum in station.drums]
            whole += np.gradient(history.drums, ready.course.step, axis=0) @ masses
        for index, drum in enumerate(station.drums):
            curve, speeds = case.curves.get(drum.name), history.drums[:, index]
            if curve is not None:
                followed = turning[drum.leader] if drum.leader else speeds
                found[drum.name] = forces(curve, drawn.times, followed), speeds
            elif station.imposes and drum.name in case.spec.all_drives:
                found[drum.name] = station.shares[index] * whole, speeds
    return found


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


def _longest_way(case: Moving, drawn: Drawn, values: Values) -> Values:
    """The longest way of any point of the belt to its rest: at the head, at the tail or between them."""
    if case.scene.type == "coast":
        return {}
    head = values["stop_distance"][0]
    if not math.isfinite(head):
        return {"stop_distance_max": (head, {})}
    step = float(drawn.times[1])
    speeds = drawn.tail.belt
    tail = np.concatenate([[0.0], np.cumsum((speeds[1:] + speeds[:-1]) / 2)]) * step
    inside, length = drawn.longest_way, case.line.back.length
    ways = (head, 0.0), (float(tail.max()), length), (inside.value, inside.place)
    way, place = max(ways, key=lambda one: one[0])
    return {"stop_distance_max": (way, {"position": place})}


def _of_drives(found: OneGrid, case: Moving, station: Station, history: Track, step: float) -> None:
    """Loads of the drums that have a drive."""
    values, traces, names = found.values, found.traces, case.spec.all_drives
    for index, drum in enumerate(station.drums):
        if drum.name not in names:
            continue
        on, off = history.tensions[:, index], history.tensions[:, index + 1]
        for name, trace in (("tension_run_on_max", Trace(on, step)), ("tension_run_off_min", Trace(off, step, -1))):
            value, at = trace.extreme()
            traces[of(name, drum.name)] = trace
            values[of(name, drum.name)] = value, {"time": at}
        given = names[drum.name].drum
        if given.friction is None:
            continue
        belt, slips = history.belt, history.slips[:, index] != 0
        tight, slack = np.maximum(on, off), np.minimum(on, off)
        lift = case.line.belt_line_mass * belt**2
        exponent = given.friction * given.wrap
        if slips.any():
            used, at = math.nextafter(1, 2), int(slips.argmax()) * step
            reserve = math.nextafter(1, 0)
            found.slid[drum.name] = float(np.abs(history.drums[:, index] - belt).max()) * step
        else:
            with_lift = Trace(capstan.slip_utilisation(tight, slack, lift, exponent), step)
            without = Trace(capstan.slip_utilisation(tight, slack, 0.0, exponent), step)
            traces[of("slip_utilisation_max", drum.name)] = with_lift
            traces[of("slip_reserve_min", drum.name)] = without
            used, at = with_lift.extreme()
            reserve = capstan.slip_reserve_ratio(without.extreme()[0], exponent)
        values[of("slip_utilisation_max", drum.name)] = used, {"time": at}
        values[of("slip_reserve_min", drum.name)] = reserve, {"time": at}
        values[of("slip_distance", drum.name)] = float(station.slid[index]), {}
        values[of("slip_heat", drum.name)] = float(station.heat[index]), {}
