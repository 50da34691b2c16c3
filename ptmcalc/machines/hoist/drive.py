"""The drive of a hoist as numbers: torques of even motion, the brake that holds, starts, heat over the duty."""

import math
from dataclasses import dataclass

from ptmcalc.components.duty_motor import DutyMotor
from ptmcalc.laws import brake, duty, hoisting, inertia
from ptmcalc.machines.hoist import model
from ptmcalc.machines.hoist.drive_data import Gearbox
from ptmcalc.machines.hoist.model import filled
from ptmcalc.machines.hoist.spec import Hoist

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


def field_speed(motor: DutyMotor) -> float | None:
    """Speed of the motor without load, for induction motors that of the field; None where it is not known [rad/s]."""
    if motor.no_load_speed is not None or motor.curve is None:
        return motor.no_load_speed
    return motor.curve.no_load_speed


def start_heat(spec: Hoist, motor: DutyMotor, field: float, mass: float, hook_height: float | None) -> float:
    """In the rotor of one motor in a start upwards, everything rigid; infinite where it does not lift [J]."""
    gear, efficiency = gearbox_of(spec), model.efficiency(spec)
    share = torque_up(spec, mass, hook_height) / starting_torque(motor)
    if share >= 1:
        return math.inf
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


def held(spec: Hoist, mass: float, hook_height: float | None) -> Held | None:
    """The brake with a mass on the hook; None without a brake."""
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
    hook = sinking / gear.ratio * model.layer_radius(spec, 1) / model.falls_of_a_rope(spec)
    return Held(torque, reserve, way, hoisting.speed_after_drop(hook, way))


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
