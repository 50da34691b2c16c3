"""How far what a rigid crane leaves out can move the loads of a rotation: intervals that hold whatever happens."""

import itertools
import math
from collections.abc import Iterable, Mapping

from ptmcalc.base.estimate import ANYTHING, Estimate, Interval
from ptmcalc.laws import duty, slewing
from ptmcalc.machines.crane.slewing import chain, model, ring
from ptmcalc.machines.crane.slewing.solvers.consistent import start_of
from ptmcalc.machines.crane.slewing.spec import SlewingCrane, SlewingScene

Loads = Mapping[str, Estimate]
Offsets = Mapping[str, Interval]
_OF_TIMES = (
    "start_time", "start_angle", "steady_time", "steady_angle", "brake_time", "brake_angle", "cycle_time",
    "share_start", "share_steady", "share_brake", "torque_equivalent", "torque_pinion", "torque_worm", "power_gearbox",
    "rotation_used", "torque_motor_rms", "heating_utilisation",
)  # fmt: skip


def unknown(loads: Loads, names: Iterable[str] = ()) -> dict[str, Interval]:
    """Nothing is known of start, stop and ring, nor of some loads more."""
    return {name: ANYTHING for name in (*_OF_TIMES, *_RING, *names) if name in loads}


def _beyond(known: Estimate, low: float, high: float) -> Interval:
    """The offset that takes a bar to an interval, as far as that is wider."""
    if math.isnan(low) or math.isnan(high):
        return ANYTHING
    below = -math.inf if low == -math.inf else min(low - known.low, 0.0)
    above = math.inf if high == math.inf else max(high - known.high, 0.0)
    return Interval(below, above)


def of_times(
    spec: SlewingCrane,
    scene: SlewingScene,
    loads: Loads,
    start: Interval,
    stop: tuple[Interval, Interval] | None,
    start_angle: Interval | None = None,
) -> dict[str, Interval]:
    """What a start time known to an interval, and a stop known by time and angle, leave of everything that follows."""
    if "start_time" not in loads or "cycle_time" not in loads:
        return {}
    speed, rotation = spec.speed, spec.cycle.rotation
    planned = (model.stop(spec, scene) or chain.allowed_stop(spec))[1]
    if not (math.isfinite(start.low) and math.isfinite(start.high)):
        return {name: ANYTHING for name in _OF_TIMES if name in loads}
    turned = start_angle or Interval(0.0, speed * start.high)
    steady = Interval(max(rotation - turned.high - planned, 0.0), max(rotation - turned.low - planned, 0.0))
    steady_time = Interval(steady.low / speed, steady.high / speed)
    time, angle = stop or (_bar(loads["brake_time"]), _bar(loads["brake_angle"]))
    times = (start, steady_time, time)
    found = {
        "start_time": start,
        "start_angle": turned,
        "steady_angle": steady,
        "steady_time": steady_time,
        "brake_time": time,
        "brake_angle": angle,
        "cycle_time": Interval(sum(one.low for one in times), sum(one.high for one in times)),
        "rotation_used": Interval((turned.low + angle.low) / rotation, (turned.high + angle.high) / rotation),
    }
    for index, name in enumerate(("share_start", "share_steady", "share_brake")):
        found[name] = _share(times, index)
    found |= _torques(spec, scene, times, found["cycle_time"], steady_time)
    return {name: _beyond(loads[name], one.low, one.high) for name, one in found.items() if name in loads}


def _bar(known: Estimate) -> Interval:
    return Interval(known.low, known.high)


def _share(times: tuple[Interval, ...], index: int) -> Interval:
    """Share of one phase, each phase anywhere in its interval."""
    own = times[index]
    others = [one for k, one in enumerate(times) if k != index]
    most, least = sum(one.high for one in others), sum(one.low for one in others)
    low = own.low / (own.low + most) if own.low > 0 else 0.0
    high = own.high / (own.high + least) if math.isfinite(own.high) and own.high > 0 else 1.0 if own.high > 0 else 0.0
    return Interval(low, high)


def _torques(
    spec: SlewingCrane, scene: SlewingScene, times: tuple[Interval, ...], whole: Interval, steady: Interval
) -> dict[str, Interval]:
    """Means of torques over the phases: a ratio of linear functions of each time, largest and smallest at corners."""
    at_column = start_of(spec, scene)[1]
    found: dict[str, Interval] = {}
    for by in (False, True):
        at = chain.torques(spec, scene, at_column, by_direction=by)
        more = chain.worth(spec, scene, spec.cycle.exponent)
        equivalent = _mean(times, (more * at.start, at.steady, at.brake), spec.cycle.exponent)
        worm = _mean(times, (more * at.fast[0], *at.fast[1:]), spec.cycle.exponent)
        one = {
            "torque_equivalent": equivalent,
            "torque_worm": worm,
            "power_gearbox": _times(worm, spec.gear.ratio * spec.speed),
        }
        if spec.gear.open is not None:
            one["torque_pinion"] = _times(equivalent, 1 / (spec.gear.open.ratio * spec.gear.open.efficiency))
        found = {
            name: one[name] if name not in found
            else Interval(min(found[name].low, one[name].low), max(found[name].high, one[name].high))
            for name in one
        }  # fmt: skip
    motors = spec.motor.count
    hot = chain.worth(spec, scene, 2.0) * at.fast[0]
    heating = _mean(times[:2], (hot / motors, at.fast[1] / motors), 2.0)
    found["torque_motor_rms"] = heating
    if spec.motor.rated is not None:
        on = (times[0].low + steady.low, times[0].high + steady.high)
        off = (times[2].low + spec.cycle.pause, times[2].high + spec.cycle.pause)
        most = _allowed(spec, on[0] / (on[0] + off[1]) if on[0] > 0 else 0.0)
        least = _allowed(spec, on[1] / (on[1] + off[0]))
        found["heating_utilisation"] = Interval(heating.low / most, heating.high / least)
    return found


def _allowed(spec: SlewingCrane, share: float) -> float:
    """Torque that a motor bears which is on for so much of the time; any where it is never on [N*m]."""
    motor, cooling = spec.motor, duty.REST_COOLING["self_ventilated"]
    assert motor.rated is not None
    if share == 0:
        return math.inf
    return duty.permissible_torque(motor.rated, motor.rated_duty, share, rest_cooling=cooling)


def _times(one: Interval, factor: float) -> Interval:
    return Interval(one.low * factor, one.high * factor)


def _mean(times: tuple[Interval, ...], torques: tuple[float, ...], exponent: float) -> Interval:
    sizes = [abs(torque) for torque in torques]
    if not all(math.isfinite(one.high) for one in times):
        return Interval(min(sizes), max(sizes))
    values = []
    for corner in itertools.product(*((one.low, one.high) for one in times)):
        whole = sum(corner)
        if whole > 0:
            values.append(slewing.fatigue_torque([time / whole for time in corner], sizes, exponent))
    return Interval(min(values, default=min(sizes)), max(values, default=max(sizes)))


# -- a load that swings ---------------------------------------------------------------------------------------------


def of_swing(spec: SlewingCrane, scene: SlewingScene, loads: Loads) -> Offsets:
    """Start, stop and ring of a crane whose load swings as it likes."""
    if "cycle_time" not in loads:
        return _unmoved(spec, scene, loads)
    assert spec.load is not None
    assert spec.load.rope_length is not None
    mass, radius, rope = model.hanging_mass(spec, scene), spec.load.radius, spec.load.rope_length
    speed, gravity = spec.speed, spec.gravity
    crane = model.structure_inertia(spec)
    driven = crane + model.rotor_at_column(spec)
    reach, angle = slewing.swing_reach(driven, mass, radius, rope, speed, gravity)
    least, most = slewing.momentum_range(driven, mass, reach, speed)
    rigid = (driven + mass * radius**2) * speed
    known = _bar(loads["start_time"])
    start_torque = start_of(spec, scene)[1]
    spread = model.torque_range(spec, scene)
    if spread is not None:  # the load may keep the motor at any part of its curve
        left = [model.at_column(spec, torque) - model.steady_torque(spec, scene) for torque in spread[:2]]
        slowest, fastest = (rigid / one if one > 0 else math.inf for one in left)
        known = Interval(min(known.low, fastest), max(known.high, slowest))
        start_torque = model.at_column(spec, spread[1])
    free = rigid / known.low if known.low > 0 else math.inf
    beside = speed * (math.sqrt(reach**2 + driven / mass) + reach + radius)
    pull = mass * (gravity + beside**2 / rope + radius * speed**2)
    jerk = (free + pull * radius * math.sin(min(angle, math.pi / 2))) / driven
    drives = model.rotor_at_column(spec) * jerk < start_torque and known.low > 0
    if not drives or model.motor_follows(spec):
        start, turned = ANYTHING, None
    else:
        start = Interval(known.low * (driven * speed + least) / rigid, known.high * (driven * speed + most) / rigid)
        steady = spread is None and known.high - known.low <= 1e-12 * known.high
        lowest = driven * speed / (2 * rigid) * known.low * speed if steady else -speed * start.high
        turned = Interval(lowest, speed * start.high)
    stop, end_angle = _stop(spec, scene, driven, reach, most)
    found = of_times(spec, scene, loads, start, stop, turned)
    return found | _ring(spec, scene, loads, pull, end_angle)


def _unmoved(spec: SlewingCrane, scene: SlewingScene, loads: Loads) -> Offsets:
    """Of a crane that stalls or that no brake stops: a load that hangs at rest does not help a motor that stalls, and
    no swing lets a brake hold a wind that is stronger than it can hold."""
    proved: set[str] = set()
    if model.torque_range(spec, scene) is None and math.isinf(start_of(spec, scene)[0]):
        proved.add("start_time")
    if math.isinf((model.stop(spec, scene) or chain.allowed_stop(spec))[0]):
        proved |= {"brake_time", "brake_angle"}
    return {name: offset for name, offset in unknown(loads).items() if name not in proved}


def _stop(
    spec: SlewingCrane, scene: SlewingScene, driven: float, reach: float, most: float
) -> tuple[tuple[Interval, Interval] | None, float]:
    """Time and angle of the stop, and the largest angle of the rope in it."""
    assert spec.load is not None
    assert spec.load.rope_length is not None
    mass, radius, rope = model.hanging_mass(spec, scene), spec.load.radius, spec.load.rope_length
    speed, gravity, brake = spec.speed, spec.gravity, spec.brake
    swinging = driven * speed**2 / 2 + speed * most
    if brake is None:
        return None, _angle_of(swinging / (mass * gravity * rope))
    whole = model.structure_inertia(spec) + model.rotor_at_axis(spec)
    energy = whole * speed**2 / 2 + swinging
    resistance = spec.friction - model.driving_wind(spec, scene)
    blown = max(-resistance, 0.0)
    closing = brake.delay + brake.rise_time
    fastest = (blown * closing + math.sqrt((blown * closing) ** 2 + 2 * whole * energy)) / whole
    turned = fastest * closing
    energy += blown * turned
    held = brake.torque * (spec.gear.ratio if brake.shaft == "motor" else 1.0)
    through = held * (spec.gear.efficiency if brake.shaft == "motor" else 1.0)
    angle = _angle_of(energy / (mass * gravity * rope))
    ahead = radius + rope * (math.sin(angle) if angle < math.pi / 2 else 1.0)
    back = mass * ahead * math.sqrt(2 * energy / mass)
    if held + resistance <= 0 or through + resistance <= 0 or spec.gear.back <= 0:
        return (Interval(0.0, math.inf), Interval(0.0, math.inf)), angle
    over = turned + energy / (held + resistance)
    momentum = driven * speed + most + blown * closing + back
    return (Interval(0.0, closing + momentum / (through + resistance)), Interval(0.0, over)), angle


def _angle_of(share: float) -> float:
    """Angle of a rope at which a load has risen by a share of the rope's length [rad]."""
    return math.pi if share >= 2 else math.acos(1 - share)


_RING = ("ring_force_axial", "ring_force_radial", "ring_moment", "ring_utilisation")


def _ring(spec: SlewingCrane, scene: SlewingScene, loads: Loads, pull: float, angle: float) -> dict[str, Interval]:
    """What the rope's pull adds to the ring: its size goes by the speed of the load and the jerk of the jib."""
    load = spec.load
    if load is None or "ring_moment" not in loads:
        return {}
    mass, radius = model.hanging_mass(spec, scene), load.radius
    crane, sine = model.structure_inertia(spec), math.sin(min(angle, math.pi / 2))
    free = 1 - mass * radius**2 * sine**2 / crane
    if free <= 0 or spec.gear.back <= 0:
        return {name: ANYTHING for name in _RING[:3] if name in loads}
    brake = spec.brake
    held = 0.0 if brake is None else brake.torque * (spec.gear.ratio if brake.shaft == "motor" else 1.0)
    even = crane * spec.speed / chain.allowed_stop(spec)[0] if brake is None else 0.0
    driven = max(start_of(spec, scene)[1], held / spec.gear.back, even)
    torque = driven + spec.friction + model.driving_wind(spec, scene)
    torque += spec.wind.gust_torque
    largest = (pull + mass * radius * sine * torque / crane) / free
    jerk = (torque + radius * largest * sine) / crane
    dragged = abs(ring.moment_above(spec)) / spec.gravity * (jerk + 2 * spec.speed**2)
    more, sideways = max(largest - mass * spec.gravity, 0.0), largest * sine
    head = spec.ring.head_height or 0.0
    return {
        "ring_force_axial": Interval(0.0, more),
        "ring_force_radial": Interval(-mass * radius * spec.speed**2 - dragged, sideways + dragged),
        "ring_moment": Interval(-mass * radius * spec.speed**2 * head, radius * more + sideways * head),
    }
