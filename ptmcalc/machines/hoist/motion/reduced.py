"""A hoist in motion as two masses at the hook, with what moves it and what brakes it."""

import math
from dataclasses import dataclass

from ptmcalc.laws import brake as braking
from ptmcalc.laws import reeving
from ptmcalc.machines.hoist.machine import model
from ptmcalc.machines.hoist.machine.model import filled
from ptmcalc.machines.hoist.machine.spec import Hoist, HoistScene, Lift, LowerBrake, Stop


@dataclass(frozen=True, slots=True)
class Reduced:
    """A hoist as two masses at the hook: what the closed forms work with.

    `drive_mass` is m_1 with the power flowing to the load, `drive_force` P of the mean starting torque, `weight` Q.
    """

    drive_mass: float
    load_mass: float
    stiffness: float
    drive_force: float
    weight: float
    speed: float


def travel(spec: Hoist, scene: HoistScene) -> float:
    """Of the hook for a radian of the drum [m]."""
    return model.wound(spec, model.hook_height(scene)).radius / model.falls_of_a_rope(spec)


def hauling_efficiency(spec: Hoist) -> float:
    """Of tackle and deflection sheaves while the drum hauls [1]."""
    tackle = reeving.tackle_efficiency(model.falls_of_a_rope(spec), filled(spec.reeving.sheave_efficiency))
    return tackle * model.deflection_efficiency(spec)


def lowering_efficiency(spec: Hoist) -> float:
    """Of tackle and deflection sheaves while the load turns the drum [1]."""
    tackle = reeving.lowering_tackle_efficiency(model.falls_of_a_rope(spec), filled(spec.reeving.sheave_efficiency))
    return tackle * model.deflection_efficiency(spec)


def ratio(spec: Hoist) -> float:
    """Motor speed over drum speed [1]."""
    return spec.gearbox.ratio if spec.gearbox is not None else 1.0


def motor_torque(spec: Hoist) -> float:
    """Mean starting torque of all motors, 0 where their curve brakes in the mean up to the rated speed [N*m]."""
    return spec.motor.count * max(spec.motor.mean_torque, 0.0) if spec.motor is not None else 0.0


def hook_force(spec: Hoist, scene: HoistScene, torque: float) -> float:
    """Force at the hook of a torque of all motors while they haul [N]."""
    return torque * ratio(spec) * model.efficiency(spec) * hauling_efficiency(spec) / travel(spec, scene)


def hook_speed(spec: Hoist, scene: HoistScene) -> float:
    """Of the hook in a scene, the rope on the layer it is on there [m/s]; 0 where the load hangs still."""
    which = getattr(scene, "speed", "main")
    return model.drum_speed(spec, which) * travel(spec, scene)


def rope_mass(spec: Hoist, scene: HoistScene) -> float:
    """Of the falls that hang [kg]."""
    falls = model.fall_length(spec, model.hook_height(scene)) * spec.reeving.falls
    return filled(spec.rope.mass) * falls


def reduced(spec: Hoist, scene: HoistScene) -> Reduced:
    """The hoist as two masses at the hook while it hauls."""
    arm, gear, tackle = travel(spec, scene), model.efficiency(spec), hauling_efficiency(spec)
    mass = model.hook_mass(spec, scene)
    rotor = model.motor_side_inertia(spec) * (ratio(spec) / arm) ** 2 * gear * tackle
    drum = (spec.drum.inertia or 0.0) / arm**2 * tackle
    return Reduced(
        rotor + drum,
        mass,
        model.hook_stiffness(spec, model.hook_height(scene)),
        hook_force(spec, scene, motor_torque(spec)),
        mass * spec.gravity,
        hook_speed(spec, scene),
    )


def start_hook_speed(spec: Hoist, scene: Lift) -> float:
    """Of the drive as the rope comes taut, at the hook [m/s]: its set speed, or what its mean torque brings it to."""
    if scene.rope == "taut":
        return 0.0
    if scene.slack is None:
        return hook_speed(spec, scene)
    one = reduced(spec, scene)
    return min(hook_speed(spec, scene), math.sqrt(2 * scene.slack * one.drive_force / one.drive_mass))


def brake_torque(spec: Hoist) -> float:
    """Of the closed brake, on the motor shaft [N*m]; 0 without one."""
    given = spec.brake
    if given is None:
        return 0.0
    return given.torque if given.shaft == "motor" else given.torque / ratio(spec)


def hook_brake_force(spec: Hoist, scene: HoistScene) -> float:
    """Force at the hook against which the closed brake slips while the load drives it [N]."""
    losses = losses_to_the_brake(spec)
    return brake_torque(spec) * ratio(spec) / (travel(spec, scene) * losses) if losses > 0 else math.inf


def losses_to_the_brake(spec: Hoist) -> float:
    """Part of the sinking load's torque that comes to the brake [1]: behind the tackle, on the motor shaft behind the
    gear too; 0 where that locks itself."""
    on_drum = spec.brake is not None and spec.brake.shaft == "drum"
    return lowering_efficiency(spec) * (1.0 if on_drum else max(model.reverse_efficiency(spec), 0.0))


def moving_inertia(spec: Hoist, scene: HoistScene) -> float:
    """All that moves, on the motor shaft [kg*m^2]."""
    drum = (spec.drum.inertia or 0.0) + model.hook_mass(spec, scene) * travel(spec, scene) ** 2
    return model.motor_side_inertia(spec) + drum / ratio(spec) ** 2


def braked_way(spec: Hoist, scene: LowerBrake | Stop) -> tuple[float, float]:
    """Time [s] and way of the hook [m] of the rigid hoist until the brake has stopped it, losses of gear and tackle
    helping while it is lowered; infinite where the brake is the weaker."""
    arm, speed = travel(spec, scene), model.drum_speed(spec, scene.speed) * ratio(spec)
    load = model.hook_mass(spec, scene) * spec.gravity * arm / ratio(spec)
    lowers = scene.type == "lower_brake" or scene.direction == "down"
    losses = losses_to_the_brake(spec)
    given = spec.brake
    assert given is not None
    time, angle = braking.brake_stop(
        moving_inertia(spec, scene),
        speed,
        brake_torque(spec),
        load * losses if lowers else -load,
        given.delay,
        given.rise_time,
        given.rise,
    )
    return time, angle / ratio(spec) * arm
