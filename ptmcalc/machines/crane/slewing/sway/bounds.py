"""How far a load that swings as it likes can move start, stop and ring: intervals that hold whatever happens."""

import math

from ptmcalc.base.estimate import ANYTHING, Interval
from ptmcalc.laws import slewing
from ptmcalc.machines.crane.slewing.machine import model
from ptmcalc.machines.crane.slewing.machine.spec import SlewingCrane, SlewingScene
from ptmcalc.machines.crane.slewing.ring import forces
from ptmcalc.machines.crane.slewing.ring.loads import RING_LOADS
from ptmcalc.machines.crane.slewing.rotation.bounds import Loads, Offsets, bar, of_times, unknown


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
    known = bar(loads["start_time"])
    start_torque = model.start_of(spec, scene)[1]
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
    if model.torque_range(spec, scene) is None and math.isinf(model.start_of(spec, scene)[0]):
        proved.add("start_time")
    if math.isinf((model.stop(spec, scene) or model.allowed_stop(spec))[0]):
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


def _ring(spec: SlewingCrane, scene: SlewingScene, loads: Loads, pull: float, angle: float) -> dict[str, Interval]:
    """What the rope's pull adds to the ring: its size goes by the speed of the load and the jerk of the jib."""
    load = spec.load
    if load is None or "ring_moment" not in loads:
        return {}
    mass, radius = model.hanging_mass(spec, scene), load.radius
    crane, sine = model.structure_inertia(spec), math.sin(min(angle, math.pi / 2))
    free = 1 - mass * radius**2 * sine**2 / crane
    if free <= 0 or spec.gear.back <= 0:
        return {name: ANYTHING for name in RING_LOADS[:3] if name in loads}
    brake = spec.brake
    held = 0.0 if brake is None else brake.torque * (spec.gear.ratio if brake.shaft == "motor" else 1.0)
    even = crane * spec.speed / model.allowed_stop(spec)[0] if brake is None else 0.0
    driven = max(model.start_of(spec, scene)[1], held / spec.gear.back, even)
    torque = driven + spec.friction + model.driving_wind(spec, scene)
    torque += spec.wind.gust_torque
    largest = (pull + mass * radius * sine * torque / crane) / free
    jerk = (torque + radius * largest * sine) / crane
    dragged = abs(forces.moment_above(spec)) / spec.gravity * (jerk + 2 * spec.speed**2)
    more, sideways = max(largest - mass * spec.gravity, 0.0), largest * sine
    head = spec.ring.head_height or 0.0
    return {
        "ring_force_axial": Interval(0.0, more),
        "ring_force_radial": Interval(-mass * radius * spec.speed**2 - dragged, sideways + dragged),
        "ring_moment": Interval(-mass * radius * spec.speed**2 * head, radius * more + sideways * head),
    }
