"""A travelling crane as numbers: masses and where they are, what resists and drives it, its state at an instant."""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ptmcalc.components.motor_torque import torques_up_to
from ptmcalc.laws import gearing, inertia
from ptmcalc.machines.crane.travelling.machine.scenes import Brake, HoistWhileTravelling, Moving, Start, TravelScene
from ptmcalc.machines.crane.travelling.machine.spec import Travelling

FloatArray = NDArray[np.float64]

CORNERS = ("A1", "A2", "B1", "B2")
"""On rail A or B, front or rear."""


def filled(value: float | None) -> float:
    """A value the file or an assumption has given by now."""
    assert value is not None, "assumptions are filled in before anything is computed"
    return value


class State(NamedTuple):
    """The crane at some instants, numbers or arrays alike; along the rails positive in the direction of travel."""

    acceleration: float | FloatArray
    """of the crane [m/s^2]"""
    pull: float | FloatArray
    """of the load on the crane, against the travel [N]"""
    weight: float | FloatArray
    """of the load on the crane, downwards [N]"""
    traction: float | FloatArray
    """of the driven wheels on the crane, in the direction of travel [N]"""
    wind: float | FloatArray
    """on what travels, against the travel [N]"""


# -- masses ---------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Body:
    """A part that travels: its mass, and its centre of gravity across the rails from rail A and above them."""

    mass: float
    across: float
    height: float


def hanging(spec: Travelling, scene: TravelScene) -> float:
    """What hangs on the ropes, the hook block in it [kg]."""
    return filled(spec.hook_block) + (spec.load if scene.load == "full" else 0.0)


def bodies(spec: Travelling, hook: float) -> tuple[Body, ...]:
    """What travels besides the load, with the hook so far from rail A."""
    trolley = spec.trolley
    if spec.bridge is None:
        return (Body(trolley.mass, spec.gauge / 2, filled(trolley.height)),)
    bridge = spec.bridge
    centre = bridge.centre if bridge.centre is not None else bridge.span / 2
    return Body(bridge.mass, centre, filled(bridge.height)), Body(trolley.mass, hook, filled(trolley.height))


def travelling_mass(spec: Travelling) -> float:
    """What travels besides the load, the wheels that are not driven with what turns in them [kg]."""
    free = wheel_count(spec) - driven_wheels(spec)
    return sum(body.mass for body in bodies(spec, 0.0)) + free * filled(spec.wheels.inertia) / radius(spec) ** 2


def weight(spec: Travelling, scene: TravelScene) -> float:
    """On the rails [N]."""
    return (sum(body.mass for body in bodies(spec, 0.0)) + hanging(spec, scene)) * spec.gravity


def hook_places(spec: Travelling, scene: TravelScene) -> tuple[float, ...]:
    """Distances of the hook from rail A that a scene is about [m]."""
    trolley, gauge = spec.trolley, spec.gauge
    if spec.bridge is None:
        return (trolley.hook if trolley.hook is not None else gauge / 2,)
    near = filled(trolley.nearest)
    far = trolley.farthest if trolley.farthest is not None else gauge - near
    named = {"near": (near,), "far": (far,), "middle": ((near + far) / 2,)}
    return named.get(scene.trolley, (near, far))


def rope_height(spec: Travelling) -> float:
    """Of the place where the ropes are held, above the rails of the wheels [m]."""
    held = spec.suspension.height
    return held if held is not None else filled(spec.trolley.height)


# -- wheels ---------------------------------------------------------------------------------------------------------


def radius(spec: Travelling) -> float:
    """Of a wheel [m]."""
    return spec.wheels.diameter / 2


def wheel_count(spec: Travelling) -> int:
    """Of all corners."""
    return 4 * spec.wheels.per_corner


def driven_at(spec: Travelling, corner: str) -> int:
    """Driven wheels of a corner."""
    wheels = spec.wheels
    if corner not in wheels.driven:
        return 0
    return wheels.driven_per_corner if wheels.driven_per_corner is not None else wheels.per_corner


def driven_wheels(spec: Travelling) -> int:
    """Of all corners."""
    return sum(driven_at(spec, corner) for corner in CORNERS)


# -- what resists ---------------------------------------------------------------------------------------------------


def wind_force(spec: Travelling, pressure: float | None) -> float:
    """Of a wind along the rails on what travels, without the load [N]."""
    if spec.wind is None or pressure is None:
        return 0.0
    return pressure * spec.wind.shape * spec.wind.area


def wind_on_load(spec: Travelling, scene: TravelScene, pressure: float | None) -> float:
    """Of a wind along the rails on the load; nothing hangs there in an empty scene [N]."""
    if spec.wind is None or pressure is None or scene.load == "empty":
        return 0.0
    return pressure * spec.wind.load_shape * filled(spec.wind.load_area)


def working_pressure(spec: Travelling) -> float | None:
    """Of the wind in which it starts and stops [Pa]."""
    return spec.wind.pressure if spec.wind is not None else None


def largest_pressure(spec: Travelling) -> float | None:
    """Of the wind in service [Pa]."""
    if spec.wind is None:
        return None
    return spec.wind.pressure_max if spec.wind.pressure_max is not None else spec.wind.pressure


def wind_height(spec: Travelling) -> float:
    """Of the middle of the area in the wind, above the rails [m]."""
    if spec.wind is not None and spec.wind.height is not None:
        return spec.wind.height
    return filled(spec.bridge.height) if spec.bridge is not None else filled(spec.trolley.height)


@dataclass(frozen=True, slots=True)
class Outside:
    """Forces along the rails in a scene, positive against the travel [N]."""

    wind: float
    """on what travels"""
    wind_on_load: float
    slope: float
    """on what travels, without the load"""
    slope_on_load: float

    @property
    def total(self) -> float:
        return self.wind + self.wind_on_load + self.slope + self.slope_on_load


def _sign(word: str | None, scene: Moving) -> float:
    """+1 against the travel, -1 with it: against a start, with a stop."""
    default = "with" if isinstance(scene, Brake) else "against"
    return {"against": 1.0, "with": -1.0, "none": 0.0}[word or default]


def slope(spec: Travelling, scene: Moving) -> float:
    """Angle of the rails, positive where they rise in the direction of travel [rad]."""
    return math.atan(spec.rail.slope) * _sign(scene.slope, scene)


def outside(spec: Travelling, scene: Moving) -> Outside:
    """Wind and slope of a start or a stop; none where the file leaves that effect out."""
    if spec.effects.get("travel_wind") == "off":
        return Outside(0.0, 0.0, 0.0, 0.0)
    blows = _sign(scene.wind, scene)
    pressure = working_pressure(spec)
    own = sum(body.mass for body in bodies(spec, 0.0))
    climb = spec.gravity * math.sin(slope(spec, scene))
    return Outside(
        blows * wind_force(spec, pressure),
        blows * wind_on_load(spec, scene, pressure),
        own * climb,
        hanging(spec, scene) * climb,
    )


# -- drive ----------------------------------------------------------------------------------------------------------


def rim_ratio(spec: Travelling) -> float:
    """Angle of the motors per way of travel [1/m]."""
    return spec.drive.gear.ratio / radius(spec)


def motor_speed(spec: Travelling) -> float:
    """At full speed [rad/s]."""
    return spec.speed * rim_ratio(spec)


def least_torque(spec: Travelling) -> float:
    """Smallest torque of all motors on the way to full speed: of their curve, or before a step of a rheostat [N*m]."""
    motor = spec.drive.motor
    if motor.mean_starting_torque is not None:
        return spec.drive.torque
    if motor.smallest_starting_torque is not None:
        return motor.count * motor.smallest_starting_torque
    curve = motor.curve
    assert curve is not None
    return motor.count * float(np.min(torques_up_to(curve, motor_speed(spec))))


def driving_force(spec: Travelling, torque: float) -> float:
    """At the rims of the driven wheels from a torque of the motors at even speed [N]."""
    return torque * rim_ratio(spec) * spec.drive.efficiency


def braking_force(spec: Travelling, torque: float) -> float:
    """At the rims of the braked wheels from a torque of the brakes at even speed [N]."""
    return torque * rim_ratio(spec) / spec.drive.reverse_efficiency


def rotor_mass(spec: Travelling, braking: bool) -> float:
    """Mass at the rims that stands for what turns before them: rotors, couplings, driven wheels [kg]."""
    loss = 1 / spec.drive.reverse_efficiency if braking else spec.drive.efficiency
    wheels = driven_wheels(spec) * filled(spec.wheels.inertia)
    return inertia.reduced_drive_mass(spec.drive.inertia, spec.drive.gear.ratio, loss, wheels, radius(spec))


def motor_torque(spec: Travelling, force: ArrayLike, acceleration: ArrayLike) -> FloatArray:
    """Of all motors, for a force of the driven wheels on the rails and an acceleration of travel [N*m]."""
    a = np.asarray(acceleration, float)
    on_wheels = (
        np.asarray(force, float) * radius(spec) + driven_wheels(spec) * filled(spec.wheels.inertia) / radius(spec) * a
    )
    through = gearing.input_torque(
        on_wheels, 1.0, spec.drive.gear.ratio, spec.drive.efficiency, spec.drive.reverse_efficiency
    )
    return np.asarray(spec.drive.inertia * rim_ratio(spec) * a + through)


def even_motor_torque(spec: Travelling, force: float) -> float:
    """Of all motors in even travel, for a force of the driven wheels on the rails [N*m]."""
    return float(motor_torque(spec, force, 0.0))


def rope_length(spec: Travelling, scene: Moving) -> float:
    """At the beginning of a scene [m]."""
    return scene.length if scene.length is not None else spec.suspension.length


def hoisting_speed(spec: Travelling, scene: Moving) -> float:
    """By which the ropes get shorter, negative where the load is lowered [m/s]."""
    if not isinstance(scene, HoistWhileTravelling) or spec.effects.get("hoisting_sway") == "off":
        return 0.0
    speed = filled(spec.suspension.hoist_speed)
    return speed if scene.hoist == "up" else -speed


def commanded(spec: Travelling, scene: Moving) -> float | None:
    """Acceleration of a drive that keeps to a ramp, positive in a start and in a stop; None of a torque [m/s^2]."""
    if isinstance(scene, Brake):
        by_brake = scene.by == "brake" or spec.drive.deceleration is None
        return None if by_brake else spec.drive.deceleration
    return spec.drive.ramp(spec.speed)


def starts(scene: TravelScene) -> bool:
    """Whether it is brought to speed."""
    return isinstance(scene, Start | HoistWhileTravelling)
