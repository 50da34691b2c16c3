"""A stacker crane as numbers: its masses, where the carriage is, what pushes it, what pulls the column down or along.

`Stacker` is either type; what only one has is asked for by `isinstance`.
"""

import math
from dataclasses import dataclass
from typing import Literal, TypeVar

import numpy as np
from numpy.typing import NDArray

from ptmcalc.components.motor import ConverterMotor
from ptmcalc.components.motor_torque import torques_up_to
from ptmcalc.laws import carriage, inertia, reeving
from ptmcalc.machines.crane.stacking.machine.keys.drives import Rotation, Travel
from ptmcalc.machines.crane.stacking.machine.overhead import OverheadStacker
from ptmcalc.machines.crane.stacking.machine.rack import RackStacker
from ptmcalc.machines.crane.stacking.machine.scenes import ObstacleScene, StackerScene, Start
from ptmcalc.machines.crane.stacking.machine.spec import Stacker

FloatArray = NDArray[np.float64]
Torque = TypeVar("Torque", float, FloatArray)

_EVEN = 1e-9
"""Share of the mean torque by which a curve that is even may change, by rounding."""

Direction = Literal["along", "across"]
"""Along the travel of bridge or base; across it: along the girders, across the aisle."""


def filled(value: float | None) -> float:
    """A value the file or an assumption has given by now."""
    assert value is not None, "assumptions are filled in before anything is computed"
    return value


# -- which mechanism ------------------------------------------------------------------------------------------------


def mechanism(spec: Stacker, scene: StackerScene) -> str:
    """The word for what moves in a scene."""
    named = getattr(scene, "mechanism", None)
    return str(named) if named else ("travel" if isinstance(spec, RackStacker) else "bridge")


def moving(spec: Stacker, scene: StackerScene) -> Travel | Rotation:
    """What the file says of the mechanism of a scene."""
    word = mechanism(spec, scene)
    if isinstance(spec, RackStacker):
        return spec.travel
    assert isinstance(spec, OverheadStacker)
    block = {"bridge": spec.bridge_travel, "trolley": spec.trolley_travel, "rotation": spec.rotation}[word]
    assert block is not None, "a scene has its mechanism"
    return block


def travel(spec: Stacker, scene: StackerScene) -> Travel:
    """The mechanism of a scene that travels."""
    block = moving(spec, scene)
    assert isinstance(block, Travel), "the scene is not one of a rotation"
    return block


def speed(spec: Stacker, scene: StackerScene) -> float:
    """Of travel, before the event of a scene [m/s]."""
    return float(getattr(scene, "speed_share", 1.0)) * travel(spec, scene).speed


def direction(spec: Stacker, scene: StackerScene) -> Direction:
    """Which way the column bends: across for a trolley, along for all else."""
    return "across" if mechanism(spec, scene) == "trolley" else "along"


def window_factor(scene: StackerScene) -> float:
    """Length of the window of a scene, over the usual one."""
    return float(getattr(scene, "window_factor", 1.0))


# -- masses and places ----------------------------------------------------------------------------------------------


def payload(spec: Stacker, scene: StackerScene) -> float:
    """On the fork [kg]."""
    return spec.load if scene.load == "full" else 0.0


def climbing_mass(spec: Stacker, scene: StackerScene) -> float:
    """Carriage, cab and load [kg]."""
    return spec.carriage.mass + (spec.cab.mass if spec.cab else 0.0) + payload(spec, scene)


def carrying_mass(spec: Stacker, scene: StackerScene) -> float:
    """Of what holds the column and travels with it in a scene, without rotors [kg].

    The bridge travels with the trolley; the trolley alone on the bridge.
    """
    if isinstance(spec, RackStacker):
        return spec.base.mass
    assert isinstance(spec, OverheadStacker)
    return spec.trolley.mass + (spec.bridge.mass if mechanism(spec, scene) == "bridge" else 0.0)


def total_mass(spec: Stacker, scene: StackerScene) -> float:
    """Of the whole crane with its load [kg]."""
    whole = spec.column.mass + climbing_mass(spec, scene)
    if isinstance(spec, RackStacker):
        return whole + spec.base.mass
    assert isinstance(spec, OverheadStacker)
    return whole + spec.trolley.mass + spec.bridge.mass


def ends(spec: Stacker) -> tuple[float, float]:
    """Heights of the lower and upper end of the column above the floor [m]."""
    foot = spec.column.foot or 0.0
    return foot, foot + spec.column.length


def way(spec: Stacker) -> tuple[float, float]:
    """Lowest and highest place of the carriage above the floor [m]."""
    foot, head = ends(spec)
    low, high = spec.carriage.lowest, spec.carriage.highest
    return (foot if low is None else low), (head if high is None else high)


def hangs(spec: Stacker) -> bool:
    """Whether the column hangs from above, or stands."""
    return isinstance(spec, OverheadStacker)


def carriage_height(spec: Stacker, scene: StackerScene) -> float:
    """Of the carriage above the floor; as far from the column's root as it comes, where the scene is silent [m]."""
    if scene.height is not None:
        return scene.height
    low, high = way(spec)
    return low if hangs(spec) else high


def carriage_place(spec: Stacker, scene: StackerScene) -> float:
    """Distance of the carriage from the root of the column, along it [m]."""
    foot, head = ends(spec)
    height = carriage_height(spec, scene)
    place = head - height if hangs(spec) else height - foot
    return min(max(place, 0.0), spec.column.length)  # far above the floor a short column is not known better


def trolley_place(spec: OverheadStacker) -> float:
    """Of the column from the nearer end of the bridge; in the middle when the file is silent [m]."""
    span = spec.bridge.span
    place = spec.trolley.position if spec.trolley.position is not None else span / 2
    return min(place, span - place)


def weight(spec: Stacker, scene: StackerScene) -> float:
    """Of carriage, cab and load [N]."""
    return climbing_mass(spec, scene) * spec.gravity


def eccentric_moment(spec: Stacker, scene: StackerScene, way: Direction) -> float:
    """Of the weights of carriage, cab and load about the line of the ropes, with the sign of their arms [N*m]."""
    across = way == "across"
    climbs, cab = spec.carriage, spec.cab
    moment = payload(spec, scene) * (climbs.load_arm_across if across else climbs.load_arm)
    moment += climbs.mass * (climbs.own_arm_across if across else climbs.own_arm)
    if cab is not None:
        moment += cab.mass * (cab.arm_across if across else cab.arm)
    return moment * spec.gravity


# -- what drives and what brakes ------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Push:
    """What starts or stops a mechanism that travels.

    `force`: a force `size` [N] at the rims that comes up in `rise` seconds after `delay`, in a straight line; what it
    moves has the mass of the rotors [kg] besides. Towards the standstill the resistance is in it already.
    `ramp`: the base keeps to an acceleration `size` [m/s^2], which comes up and goes down in `rise` seconds.
    """

    kind: Literal["force", "ramp"]
    size: float
    rise: float
    delay: float = 0.0
    rotors: float = 0.0


def stopping(spec: Stacker, scene: StackerScene) -> Push:
    """What brings the mechanism of a scene to rest: brake and resistance together, or a ramp of speed."""
    block = travel(spec, scene)
    if block.drive is not None:
        if block.drive.deceleration is not None:
            return Push("ramp", block.drive.deceleration, block.ramp_rise)
        brake = block.drive.brake
        assert brake is not None, "something stops the machine"
        rim = block.drive.rim_per_torque(filled(block.wheel_diameter) / 2)
        force = brake.torque * rim / block.drive.reverse_efficiency
        return Push(
            "force", force + (block.resistance or 0.0), brake.rise_time, brake.delay, rotors(block, braking=True)
        )
    if block.deceleration is not None:
        return Push("ramp", block.deceleration, block.ramp_rise)
    return Push(
        "force", filled(block.braking_force) + (block.resistance or 0.0), block.braking_rise, block.braking_delay or 0.0
    )


def driving(spec: Stacker, scene: StackerScene) -> Push:
    """What brings the mechanism of a scene to speed: the drive less the resistance, or a ramp of speed."""
    block = travel(spec, scene)
    if block.drive is not None:
        slope = block.drive.ramp(block.speed)
        if slope is not None:
            return Push("ramp", slope, block.ramp_rise)
        torque = block.drive.torque
        if block.drive.motor.curve is not None and not isinstance(scene, Start):
            torque = float(np.max(_torques(block)))  # what goes on driving gives no more at any speed
        return Push("force", _net(block, torque), 0.0, 0.0, rotors(block, braking=False))
    if block.acceleration is not None:
        return Push("ramp", block.acceleration, block.ramp_rise)
    return Push("force", filled(block.driving_force) - (block.resistance or 0.0), block.driving_rise)


def pushed(spec: Stacker, scene: ObstacleScene) -> float:
    """Force that drives the base on through the collision; below 0 where it is braked [N]."""
    if scene.drive == "on":
        push = driving(spec, scene)
        return push.size if push.kind == "force" else math.inf
    if scene.brake == "on":
        brake = stopping(spec, scene)
        return -brake.size if brake.kind == "force" else -math.inf
    return -(travel(spec, scene).resistance or 0.0)


def _net(block: Travel, torque: Torque) -> Torque:
    """Force at the rims from a torque of all motors, less the resistance [N]."""
    assert block.drive is not None
    rim = block.drive.rim_per_torque(filled(block.wheel_diameter) / 2)
    return torque * rim * block.drive.efficiency - (block.resistance or 0.0)


def _torques(block: Travel) -> FloatArray:
    """Of all motors over even steps of the speed from rest to full speed, shape (n,) [N*m]."""
    assert block.drive is not None
    motor = block.drive.motor
    if motor.curve is None:
        return np.array([block.drive.torque])
    full = block.speed * block.drive.rim_per_torque(filled(block.wheel_diameter) / 2)
    return np.asarray(motor.count * torques_up_to(motor.curve, full))


def surplus(spec: Stacker, scene: StackerScene) -> FloatArray:
    """Force of a start by torque over even steps of the speed, less the resistance [N]; one number without a curve.

    Of a motor whose starting torque swings between two values, the smaller one where it does not overcome the
    resistance.
    """
    block = travel(spec, scene)
    assert block.drive is not None
    motor = block.drive.motor
    smallest = motor.smallest_starting_torque
    if motor.curve is None and smallest is not None and _net(block, motor.count * smallest) <= 0:
        return np.array([_net(block, motor.count * smallest)])
    return np.asarray(_net(block, _torques(block)))


def uneven(spec: Stacker, scene: StackerScene) -> bool:
    """Whether a scene is a start along a motor's curve whose torque changes with speed or time."""
    if not isinstance(scene, Start):
        return False
    block = moving(spec, scene)
    if not isinstance(block, Travel) or block.drive is None:
        return False
    curve = block.drive.motor.curve
    if curve is None or block.drive.ramp(block.speed) is not None:
        return False
    return isinstance(curve, ConverterMotor) or float(np.ptp(_torques(block))) > _EVEN * block.drive.torque


def rotors(block: Travel, *, braking: bool) -> float:
    """Mass at the rims that stands for what turns before them [kg]."""
    if block.drive is None:
        return 0.0
    loss = 1 / block.drive.reverse_efficiency if braking else block.drive.efficiency
    radius = filled(block.wheel_diameter) / 2
    return inertia.reduced_drive_mass(block.drive.inertia, block.drive.gear.ratio, loss, 0.0, radius)


def base_mass(spec: Stacker, scene: StackerScene, rotor_mass: float = 0.0) -> float:
    """m1: what holds the column and moves with it, with the rotors, without any part of the column [kg]."""
    return carrying_mass(spec, scene) + rotor_mass


# -- the hoist ------------------------------------------------------------------------------------------------------


def rope_stiffness(spec: Stacker) -> float:
    """Of all falls together, at the carriage; the file has it or area and length [N/m]."""
    rope = spec.hoisting.rope
    if rope.stiffness is not None:
        return rope.stiffness
    per_rope = rope.falls / rope.ropes
    return rope.ropes * per_rope**2 * filled(rope.modulus) * filled(rope.area) / filled(rope.length)


def tackle_efficiency(spec: Stacker) -> float:
    """Of the tackle while it hauls [1]."""
    rope = spec.hoisting.rope
    if rope.efficiency is not None:
        return rope.efficiency
    return reeving.tackle_efficiency(rope.falls // rope.ropes, filled(rope.sheave_efficiency))


def lowering_efficiency(spec: Stacker) -> float:
    """Of the tackle while it lowers [1]."""
    rope = spec.hoisting.rope
    falls = rope.falls // rope.ropes
    if rope.efficiency is None:
        return reeving.lowering_tackle_efficiency(falls, filled(rope.sheave_efficiency))
    if falls == 1:
        return rope.efficiency
    return reeving.lowering_tackle_efficiency(falls, carriage.sheave_of_tackle(falls, rope.efficiency))


def hoist_mass(spec: Stacker) -> float:
    """Of the hoist's drive, reduced to the carriage while the motor drives [kg]."""
    drive = spec.hoisting.drive
    assert drive is not None, "the scene has a drive"
    if drive.reduced_mass is not None:
        return drive.reduced_mass
    rope = spec.hoisting.rope
    travel_per_angle = filled(drive.drum_diameter) / 2 / (filled(drive.ratio) * rope.falls / rope.ropes)
    efficiency = filled(drive.gear_efficiency) * tackle_efficiency(spec)
    return filled(drive.inertia) * efficiency / travel_per_angle**2
