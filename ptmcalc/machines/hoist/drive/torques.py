"""The drive of a hoist as numbers: torques of even motion, the brake that holds, starts, heat over the duty."""

import math
from dataclasses import dataclass

import numpy as np

from ptmcalc.components.duty_motor import DutyMotor
from ptmcalc.components.motor_torque import carrying_speed, overhauling_reserve
from ptmcalc.laws import brake, duty, hoisting, inertia, start_profile
from ptmcalc.machines.hoist.machine import model
from ptmcalc.machines.hoist.machine.keys.drive import Gearbox
from ptmcalc.machines.hoist.machine.model import filled
from ptmcalc.machines.hoist.machine.spec import Hoist, Start

MOTOR_SHAFT = "motor"


def gearbox_of(spec: Hoist) -> Gearbox:
    """The gearbox; without one the motor sits on the drum shaft."""
    return spec.gearbox if spec.gearbox is not None else Gearbox(ratio=1.0, efficiency=1.0)


def motor_speed(spec: Hoist) -> float:
    """With the drum at its main speed [rad/s]."""
    return model.drum_speed(spec) * gearbox_of(spec).ratio


def torque_up(spec: Hoist, mass: float, hook_height: float | None) -> float:
    """Of all motors, hoisting evenly [N*m]."""
    on_drum = model.drum_torque(spec, mass, hook_height, hauling=True)
    return hoisting.hoisting_torque(on_drum, gearbox_of(spec).ratio, model.efficiency(spec))


def torque_down(spec: Hoist, mass: float, hook_height: float | None) -> float:
    """Of all motors, lowering evenly: positive where it holds the load back [N*m]."""
    on_drum = model.drum_torque(spec, mass, hook_height, hauling=False)
    return hoisting.lowering_torque(on_drum, gearbox_of(spec).ratio, model.reverse_efficiency(spec))


def starting_torque(motor: DutyMotor) -> float:
    """Mean starting torque of all motors [N*m]."""
    return motor.count * motor.mean_torque


_UP_TO = 0.9
"""Share of the steady hoisting speed up to which the motor must exceed the load [1]. An engineering choice: above it
the torque curve falls to the load. A larger value reports stalls of hoists that reach their speed."""
_SPEEDS = 181
"""Speeds at which a torque curve is evaluated: steps of half a percent of the speed. A numerical choice: more find a
narrow minimum more closely."""


def starting_reserve(spec: Hoist, motor: DutyMotor, mass: float, hook_height: float | None) -> float:
    """Starting torque relative to that of the hanging load, losses against it.

        M_mean/M_load;   min M(n)/M_load where the curve of the motor is below the load at any speed on the way up

    **Range** any hanging load; a mean proves nothing where the motor stalls on its curve.
    **Error** the minimum over 181 speeds.
    **Source** power balance of the gearbox.
    """
    up = torque_up(spec, mass, hook_height)
    if up <= 0:
        return math.inf
    mean = starting_torque(motor) / up
    if motor.curve is None:
        return mean
    speeds = np.linspace(0.0, _UP_TO * motor_speed(spec), _SPEEDS)
    least = motor.count * float(motor.curve.torque(speeds).min()) / up
    return least if least < 1 else mean


def braking_reserve(spec: Hoist, motor: DutyMotor, mass: float, hook_height: float | None) -> float | None:
    """Largest braking torque of the motors over that of the lowered load; None where the file gives no curve.

        reserve = n M_b/(M_d eta_r/u)

    **Range** steady lowering; infinite where the gear locks itself.
    **Error** exact for the curve.
    **Source** balance of torques on the motor shaft (`components.motor.overhauling_reserve`).
    """
    if motor.curve is None:
        return None
    return overhauling_reserve(motor.curve, motor.count, torque_down(spec, mass, hook_height))


def curve_speed(spec: Hoist, mass: float, hook_height: float | None, up: bool) -> float | None:
    """Speed of the motors on their curve while they hoist or lower a mass steadily; None where no curve gives it.

    M(w) = M_L/(u eta) up,   M(w) = -M_L eta_r/u down [rad/s]
    """
    motor = spec.motor
    if motor is None or motor.curve is None:
        return None
    torque = torque_up(spec, mass, hook_height) if up else -torque_down(spec, mass, hook_height)
    return carrying_speed(motor.curve, torque / motor.count)


def rated_speed(spec: Hoist) -> float:
    """Rated speed of the motor, of its curve where the file gives it there; that of the main speed without either."""
    motor = spec.motor
    own = motor.speed if motor is not None else None
    of_curve = getattr(motor.curve, "speed", None) if motor is not None else None
    return own or of_curve or motor_speed(spec)


def start_time(spec: Hoist, motor: DutyMotor, mass: float, hook_height: float | None, up: bool) -> float:
    """Of a hanging load by the mean starting torque, everything rigid; infinite where it does not move [s]."""
    return hoisting.hoist_start_time(
        starting_torque(motor),
        model.drum_torque(spec, mass, hook_height, hauling=up),
        model.motor_side_inertia(spec),
        model.load_inertia(spec, mass),
        motor_speed(spec),
        gearbox_of(spec).ratio,
        model.efficiency(spec),
        model.reverse_efficiency(spec),
        up,
    )


def profiled(spec: Hoist, motor: DutyMotor, scene: Start, mass: float, at_once: float) -> float:
    """Duration of a start whose torque or speed follows a profile, everything rigid [s].

        an imposed speed: that of the profile;   a torque: when the impulse of M_mean r(t) - M_load is that of the start

    Args:
        spec: the hoist.
        motor: its motors.
        scene: the start.
        mass: on the hook [kg].
        at_once: duration with the whole torque from the first moment [s].

    **Range** a start upwards; one downwards takes no longer than its profile.
    **Error** exact for a rigid drive.
    **Source** Newton's law; `laws.start_profile`.
    """
    profile, rise = scene.profile, scene.profile.rise_time
    if profile.imposes_speed or not math.isfinite(at_once) or rise <= 0:
        return rise if profile.imposes_speed else at_once
    if scene.direction == "down":
        return max(at_once, rise)
    mean, load = starting_torque(motor), torque_up(spec, mass, scene.hook_height)
    held = float(start_profile.time_of_share(profile.rise, rise, load / mean))
    momentum = (mean - load) * at_once
    return held + float(start_profile.time_to_momentum(profile.rise, rise, mean, load, held, momentum))


def field_speed(motor: DutyMotor) -> float | None:
    """Speed of the motor without load, for induction motors that of the field; None where it is not known [rad/s]."""
    if motor.no_load_speed is not None or motor.curve is None:
        return motor.no_load_speed
    return motor.curve.no_load_speed


def start_heat(spec: Hoist, motor: DutyMotor, field: float, mass: float, hook_height: float | None) -> float:
    """In the rotor of one motor in a start upwards, everything rigid; infinite where it does not lift [J]."""
    gear, efficiency = gearbox_of(spec), model.efficiency(spec)
    mean, up = starting_torque(motor), torque_up(spec, mass, hook_height)
    if mean <= 0 or up >= mean:
        return math.inf
    share = up / mean
    load = inertia.inertia_on_motor_shaft(model.load_inertia(spec, mass), gear.ratio, efficiency, inertia.DRIVE)
    moved = model.motor_side_inertia(spec) + load
    return duty.switching_heat(moved, field, 1.0, 0.0, load_share=share) / motor.count


# -- brake ----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Held:
    """What the brake holds, and what a brake too weak lets happen."""

    torque: float
    """of the lowering load on the shaft of the brake [N*m]"""
    reserve: float
    """brake torque over that; infinite where the gear locks itself"""
    drop: float
    """way of the hook until the load is on the ground, 0 where the brake holds [m]"""
    speed: float
    """of the hook at its end [m/s]"""


def held(spec: Hoist, mass: float, hook_height: float | None, speed: float = 0.0) -> Held | None:
    """The brake with a mass on the hook that is lowered at a speed [m/s]; None without a brake.

        v_1 = v_0 + a_0 (t_d + t_r/2),   v^2 = v_1^2 + 2 a (h - s_1)

    with a_0 without the brake and a with it: the load can only get faster.
    """
    if spec.brake is None:
        return None
    gear, on_motor = gearbox_of(spec), spec.brake.shaft == MOTOR_SHAFT
    load = model.drum_torque(spec, mass, hook_height, hauling=False)
    if on_motor:
        torque = hoisting.lowering_torque(load, gear.ratio, model.reverse_efficiency(spec))
    else:
        torque = load
    reserve = brake.brake_reserve(spec.brake.torque, torque)
    if reserve >= 1:
        return Held(torque, reserve, 0.0, 0.0)
    sinking = _sinking(spec, mass, load, spec.brake.torque if on_motor else 0.0, 0.0 if on_motor else spec.brake.torque)
    way = spec.height if hook_height is None else hook_height
    to_hook = model.layer_radius(spec, 1) / model.falls_of_a_rope(spec) / gear.ratio
    if not speed:
        return Held(torque, reserve, way, hoisting.speed_after_drop(sinking * to_hook, way))
    late = spec.brake.delay + spec.brake.rise_time / 2
    free = _sinking(spec, mass, load, 0.0, 0.0) * to_hook
    first = speed * late + free * late**2 / 2
    if first >= way:
        return Held(torque, reserve, way, math.hypot(speed, hoisting.speed_after_drop(free, way)))
    faster = speed + free * late
    return Held(torque, reserve, way, math.hypot(faster, hoisting.speed_after_drop(sinking * to_hook, way - first)))


def _sinking(spec: Hoist, mass: float, load: float, on_motor: float, on_drum: float) -> float:
    """Acceleration of the motor shaft by what the brake on either shaft leaves of the load [rad/s^2]."""
    return hoisting.sinking_acceleration(
        load - on_drum,
        on_motor,
        model.motor_side_inertia(spec),
        model.load_inertia(spec, mass),
        gearbox_of(spec).ratio,
        model.efficiency(spec),
        model.reverse_efficiency(spec),
    )


# -- duty -----------------------------------------------------------------------------------------------------------


def spectrum(spec: Hoist) -> list[tuple[float, float]]:
    """Share of the cycles and load over the rated one; the rated load always, where the file has no spectrum."""
    points = spec.duty.load_spectrum if spec.duty is not None else None
    return [(point.share, point.load) for point in points] if points is not None else [(1.0, 1.0)]


def duty_factor(spec: Hoist) -> float:
    """Share of a cycle in which the motor is on [1]."""
    assert spec.duty is not None
    return filled(spec.duty.factor) if duty.DUTY_TYPES[spec.duty.type].at_rest else 1.0


def rms_torque(spec: Hoist, motor: DutyMotor) -> float:
    """Torque that heats the motors as much as hoisting and lowering the spectrum, over the time they are on [N*m].

    Where the duty type counts starts, each of them is the mean starting torque for the time of a rigid start.
    """
    assert spec.duty is not None
    starting = duty.DUTY_TYPES[spec.duty.type].counts_starts
    on = 3600 * duty_factor(spec) / filled(spec.duty.starts_per_hour) if starting else 1.0
    torques: list[float] = []
    times: list[float] = []
    for share, load in spectrum(spec):
        mass = spec.hook_block + load * spec.load
        for up in (True, False):
            begin = min(start_time(spec, motor, mass, None, up), on) if starting else 0.0
            torques += [starting_torque(motor), (torque_up if up else torque_down)(spec, mass, None)]
            times += [share * begin, share * (on - begin)]
    return duty.rms_torque(torques, times)


def permissible_torque(spec: Hoist, motor: DutyMotor) -> float | None:
    """Torque all motors bear at the duty factor of the file; None where their rating is not known [N*m]."""
    if motor.rated is None:
        return None
    cooling = duty.REST_COOLING[motor.cooling]
    return motor.count * duty.permissible_torque(motor.rated, motor.rated_duty, duty_factor(spec), rest_cooling=cooling)
