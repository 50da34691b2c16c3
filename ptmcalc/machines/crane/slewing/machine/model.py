"""What a slewing crane's file comes to: inertias and torques about the slewing axis, and the phases of its rotation."""

import math
from dataclasses import dataclass

import numpy as np

from ptmcalc.components.motor import ConverterMotor
from ptmcalc.components.motor_torque import range_up_to
from ptmcalc.laws import bodies, brake, inertia, slewing
from ptmcalc.machines.crane.slewing.machine.spec import SlewingCrane, SlewingScene

_FLOWS = {"eta": "drive", "one": "energy", "inverse": "brake"}


def hanging_mass(spec: SlewingCrane, scene: SlewingScene) -> float:
    """Load and hook block on the rope [kg]."""
    if spec.load is None:
        return 0.0
    return (spec.load.hook_block or 0.0) + (spec.load.mass if scene.load == "full" else 0.0)


def structure_inertia(spec: SlewingCrane) -> float:
    """All that slews without what hangs, about the slewing axis [kg*m^2]."""
    load = spec.load
    if spec.inertia is not None:
        return spec.inertia - ((load.mass + (load.hook_block or 0.0)) * load.radius**2 if load is not None else 0.0)
    total = 0.0
    for body in (spec.slewing_part, spec.counterweight):
        if body is not None:
            total += bodies.parallel_axis(body.inertia or 0.0, body.mass, body.radius)
    if spec.jib is not None:
        total += bodies.rod_radial(spec.jib.mass, spec.jib.length, spec.jib.foot_radius)
    return total


def slew_inertia(spec: SlewingCrane, scene: SlewingScene) -> float:
    """All that slews, the load at the radius of its rope [kg*m^2]."""
    if spec.load is None:
        return structure_inertia(spec)
    return structure_inertia(spec) + bodies.point_mass(hanging_mass(spec, scene), spec.load.radius)


def rotor_inertia(spec: SlewingCrane) -> float:
    """All rotating parts of the drive, on the motor shaft [kg*m^2]."""
    return spec.gear.rotating_factor * spec.motor.rotating_inertia


def rotor_at_column(spec: SlewingCrane, rule: str = "eta") -> float:
    """The rotating parts of the drive about the slewing axis [kg*m^2]."""
    return inertia.inertia_on_slow_shaft(rotor_inertia(spec), spec.gear.ratio, spec.gear.efficiency, _FLOWS[rule])


def unbalance(spec: SlewingCrane, scene: SlewingScene) -> float:
    """Mass times radius of all parts, towards the load [kg*m]."""
    total = hanging_mass(spec, scene) * spec.load.radius if spec.load is not None else 0.0
    return total + structure_unbalance(spec)


def structure_unbalance(spec: SlewingCrane) -> float:
    """Mass times radius of the parts without what hangs, towards the load [kg*m]."""
    total = 0.0
    if spec.slewing_part is not None:
        total += spec.slewing_part.mass * spec.slewing_part.radius
    if spec.counterweight is not None:
        total -= spec.counterweight.mass * spec.counterweight.radius
    if spec.jib is not None:
        total += spec.jib.mass * (spec.jib.foot_radius + spec.jib.length / 2)
    return total


def slope_torque(spec: SlewingCrane, scene: SlewingScene) -> float:
    """Largest torque of the weights about a slewing axis that is not vertical [N*m]."""
    return abs(unbalance(spec, scene)) * spec.gravity * math.sin(spec.slope)


def steady_torque(spec: SlewingCrane, scene: SlewingScene) -> float:
    """What steady slewing takes at the slewing axis: friction, steady wind, slope [N*m]."""
    return spec.friction + spec.wind.steady_torque + slope_torque(spec, scene)


def driving_wind(spec: SlewingCrane, scene: SlewingScene) -> float:
    """What drives a crane that is to be stopped or held: the largest wind, slope [N*m]."""
    return spec.wind.maximum_torque + slope_torque(spec, scene)


def motor_torque(spec: SlewingCrane, scene: SlewingScene) -> float | None:
    """Mean starting torque of all motors on their shaft, None where the file does not say [N*m].

    A converter gives what its ramp takes, up to its limit.
    """
    curve = spec.motor.curve
    if isinstance(curve, ConverterMotor):
        total = slew_inertia(spec, scene) + rotor_at_column(spec)
        limit = spec.motor.count * curve.torque_limit
        if curve.ramp_time == 0:
            return limit
        wanted = slewing.torque_for_start(total, spec.speed, curve.ramp_time, steady_torque(spec, scene))
        return min(float(wanted) / (spec.gear.ratio * spec.gear.efficiency), limit)
    return spec.motor.mean_torque(spec.speed * spec.gear.ratio)


def motor_follows(spec: SlewingCrane) -> bool:
    """Whether the drive follows a ramp of speed, with whatever torque that takes up to a limit."""
    return isinstance(spec.motor.curve, ConverterMotor)


def ramp(spec: SlewingCrane) -> float | None:
    """Time of a start that the file gives, for the drive to follow: by no calculation is it another one [s]."""
    if isinstance(spec.motor.curve, ConverterMotor):
        return spec.motor.curve.ramp_time or None
    return start_time_of(spec.cycle.start_time, spec.cycle.start_angle, spec.speed)


def torque_range(spec: SlewingCrane, scene: SlewingScene) -> tuple[float, float, float] | None:
    """Smallest, largest and mean torque of a motor curve up to the speed of the crane, None without one [N*m]."""
    curve, mean = spec.motor.curve, motor_torque(spec, scene)
    if curve is None or mean is None or motor_follows(spec):
        return None
    least, most = range_up_to(curve, spec.speed * spec.gear.ratio)
    return spec.motor.count * least, spec.motor.count * most, mean


def least_torque(spec: SlewingCrane, scene: SlewingScene) -> float | None:
    """Smallest torque of a motor curve up to the speed of the crane, None without one [N*m]."""
    curve = spec.motor.curve
    if curve is None or motor_follows(spec):
        return None
    torques = curve.torque(np.linspace(0.0, spec.speed * spec.gear.ratio, 4001), np.inf)
    return spec.motor.count * float(np.min(torques))


def largest_torque(spec: SlewingCrane) -> float:
    """Largest torque of all motors up to the speed of the crane, of a motor's curve [N*m]."""
    curve = spec.motor.curve
    assert curve is not None
    return spec.motor.count * float(np.max(curve.torque(np.linspace(0.0, spec.speed * spec.gear.ratio, 4001), np.inf)))


def rotor_at_axis(spec: SlewingCrane) -> float:
    """The rotating parts of the drive, brought to the slewing axis by the ratio alone [kg*m^2]."""
    return rotor_inertia(spec) * spec.gear.ratio**2


def stop(spec: SlewingCrane, scene: SlewingScene) -> tuple[float, float] | None:
    """Time [s] and angle [rad] of a stop of the rigid crane by its brake, None without a brake."""
    brake = spec.brake
    if brake is None:
        return None
    on_motor = brake.shaft == "motor"
    return slewing.geared_stop(
        slew_inertia(spec, scene),
        rotor_at_axis(spec),
        spec.gear.efficiency,
        spec.gear.back,
        spec.speed,
        brake.torque * spec.gear.ratio if on_motor else 0.0,
        0.0 if on_motor else brake.torque,
        spec.friction - driving_wind(spec, scene),
        brake.delay,
        brake.rise_time,
    )


def at_column(spec: SlewingCrane, motor_torque: float) -> float:
    """A torque of the motors, carried to the slewing axis [N*m]."""
    return motor_torque * spec.gear.ratio * spec.gear.efficiency


def start_time_of(time: float | None, angle: float | None, speed: float) -> float | None:
    """A start as its time, be it given by its time or its angle [s]."""
    return time if time is not None else 2 * angle / speed if angle is not None else None


# -- the phases of a rotation ---------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Phases:
    """Times [s] and angles [rad] of start, steady slewing and stop."""

    start: tuple[float, float]
    steady: tuple[float, float]
    brake: tuple[float, float]

    @property
    def whole(self) -> float:
        """Time of the rotation [s]."""
        return self.start[0] + self.steady[0] + self.brake[0]


@dataclass(frozen=True, slots=True)
class PhaseTorques:
    """At the slewing axis, and on the fast shaft of the gearbox [N*m]."""

    start: float
    steady: float
    inertia_brake: float
    brake: float
    fast: tuple[float, float, float]
    """of start, steady slewing and stop"""


def start_time(spec: SlewingCrane, scene: SlewingScene, rule: str = "eta") -> float:
    """Time of a start with the motor's mean torque; infinite where it stalls [s]."""
    torque = motor_torque(spec, scene)
    assert torque is not None
    total = slew_inertia(spec, scene) + rotor_at_column(spec, rule)
    driving, resistance = at_column(spec, torque), steady_torque(spec, scene)
    return float(slewing.uniform_start_time(total, spec.speed, driving, resistance))


def start_torque(spec: SlewingCrane, scene: SlewingScene, time: float, rule: str = "eta") -> float:
    """Torque at the column that a start of a given time takes [N*m]."""
    total = slew_inertia(spec, scene) + rotor_at_column(spec, rule)
    return float(slewing.torque_for_start(total, spec.speed, time, steady_torque(spec, scene)))


def phases(spec: SlewingCrane, start: tuple[float, float], stop: tuple[float, float]) -> Phases:
    """A rotation whose start and stop are known: steady slewing fills what is left of the angle."""
    steady = max(spec.cycle.rotation - start[1] - stop[1], 0.0)
    return Phases(start, (steady / spec.speed, steady), stop)


def allowed_stop(spec: SlewingCrane) -> tuple[float, float]:
    """An even stop over the allowed angle: time [s] and angle [rad]."""
    return brake.uniform_stop_time(spec.cycle.brake_angle, spec.speed), spec.cycle.brake_angle


def phase_torques(
    spec: SlewingCrane, scene: SlewingScene, torque_start: float, rule: str = "eta", *, by_direction: bool
) -> PhaseTorques:
    """Torques of the phases: as the handbook carries rotor and losses, or `by_direction` of the power in the gear.

    In an even stop over the allowed angle a brake on the motor shaft holds the rotor, so that the gear carries what the
    crane alone needs, and its losses help the brake; one on the slewing axis has the rotor driving through the gear.
    """
    gear, steady = spec.gear, steady_torque(spec, scene)
    braked = slew_inertia(spec, scene)
    on_axis = spec.brake is not None and spec.brake.shaft == "crane"
    if on_axis or not by_direction:
        braked += rotor_at_column(spec, rule)
    inertia = float(slewing.torque_for_start(braked, spec.speed, allowed_stop(spec)[0], 0.0))
    stop = inertia + driving_wind(spec, scene) - spec.friction
    forward = gear.ratio * gear.efficiency
    fast = stop / forward
    if by_direction and on_axis:
        fast = rotor_at_column(spec, rule) * spec.speed / allowed_stop(spec)[0] / forward
    elif by_direction and stop > 0:
        fast = stop * gear.back / gear.ratio
    return PhaseTorques(torque_start, steady, inertia, stop, (torque_start / forward, steady / forward, fast))


def start_of(spec: SlewingCrane, scene: SlewingScene) -> tuple[float, float, str]:
    """Time of the start [s], its torque at the column [N*m], and the name of the load that was derived."""
    torque = motor_torque(spec, scene)
    if torque is not None:
        return start_time(spec, scene), at_column(spec, torque), "start_time"
    given = start_time_of(spec.cycle.start_time, spec.cycle.start_angle, spec.speed)
    assert given is not None
    return given, start_torque(spec, scene, given), "torque_start"
