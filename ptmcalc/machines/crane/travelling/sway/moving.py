"""What moves a travelling crane in a start or a stop, as a reference of small or of finite angles reads it."""

import math
from dataclasses import dataclass

from ptmcalc.components.motor import ConverterMotor
from ptmcalc.machines.crane.travelling.machine import model
from ptmcalc.machines.crane.travelling.machine.scenes import HoistWhileTravelling, Moving
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.machines.crane.travelling.statics import resisting


@dataclass(frozen=True, slots=True)
class Motion:
    """The numbers of a start or a stop; along the rails positive in the direction of travel."""

    starts: bool
    speed: float
    """full speed [m/s]"""
    gravity: float
    load: float
    """mass on the ropes [kg]"""
    body: float
    """mass that travels besides it [kg]"""
    rolling: float
    """resistance of the wheels, against the motion [N]"""
    outside: float
    """wind and slope, against the travel, on the load too [N]"""
    wind: float
    """and slope, on what travels, against the travel [N]"""
    wind_on_body: float
    """the wind alone on what travels, against the travel [N]"""
    on_load: float
    """wind and slope on the load, against the travel [N]"""
    wind_on_load: float
    """the wind alone: a load hangs plumb on a slope [N]"""
    slope: float
    """angle of the rails, positive where they rise in the direction of travel [rad]"""
    length: float
    """of the ropes at the beginning [m]"""
    hoisting: float
    """speed at which they get shorter [m/s]"""
    asked_time: float | None
    """how long the file hoists [s]"""
    ramp: float | None
    """size of a commanded acceleration; None of a torque [m/s^2]"""
    force: float
    """of drive or brake at the rims, its size [N]"""
    least_force: float
    """of a motor's curve between rest and full speed, at the rims; else `force` [N]"""
    delay: float
    """of the brake [s]"""
    rise: float
    """of the brake [s]"""
    rising: float
    """time in which a converter's reference rises, where it starts the crane up to a limit of torque [s]"""
    looks: float
    """length of the window of time that is looked at, over the usual one [1]"""
    rotor: float
    """mass at the rims of what turns before them, while the motors drive or a rotor runs on freely [kg]"""
    rotor_braked: float
    """the same while the brakes act [kg]"""
    reacts: bool = True
    """whether the pull of the swinging load moves a crane that a torque drives; else its mass does, as if it were
    rigid"""

    @property
    def carried(self) -> float:
        """Mass of a load that travels as if it were part of a crane driven by torque [kg]."""
        return 0.0 if self.reacts else self.load

    @property
    def rigid_time(self) -> float:
        """Of a ramp, or of a start or stop by torque with a load that does not swing [s]."""
        if self.ramp is not None:
            return self.speed / self.ramp
        net = self.force + (-1 if self.starts else 1) * (self.rolling + self.outside)
        whole = self.body + (self.rotor if self.starts else self.rotor_braked) + self.load
        return self.speed * whole / net if net > 0 else math.inf

    @property
    def hoist_time(self) -> float:
        """How long the load is hoisted; without a time in the file as long as a start whose load does not swing [s]."""
        if not self.hoisting:
            return 0.0
        return self.asked_time if self.asked_time is not None else self.rigid_time

    @property
    def lean(self) -> float:
        """Angle from the plumb line by which the wind, which blows along the rails, holds the load, in the direction of
        travel [rad]."""
        weight = self.load * self.gravity + self.wind_on_load * math.sin(self.slope)
        return -math.atan(self.wind_on_load * math.cos(self.slope) / weight) if self.load else 0.0


def motion_of(spec: Travelling, scene: Moving) -> Motion:
    """The numbers of a scene."""
    forces = model.outside(spec, scene)
    starts = model.starts(scene)
    brake = spec.drive.brake
    if starts:
        force = model.driving_force(spec, spec.drive.torque)
    else:
        force = model.braking_force(spec, brake.torque) if brake is not None else 0.0
    return Motion(
        starts=starts,
        speed=spec.speed,
        gravity=spec.gravity,
        load=model.hanging(spec, scene),
        body=model.travelling_mass(spec),
        rolling=resisting.rolling(spec, scene),
        outside=forces.total,
        wind=forces.wind + forces.slope,
        wind_on_body=forces.wind,
        on_load=forces.wind_on_load + forces.slope_on_load,
        wind_on_load=forces.wind_on_load,
        slope=model.slope(spec, scene),
        length=model.rope_length(spec, scene),
        hoisting=model.hoisting_speed(spec, scene),
        asked_time=scene.time if isinstance(scene, HoistWhileTravelling) else None,
        ramp=model.commanded(spec, scene),
        force=force,
        least_force=_least_force(spec, force) if starts else force,
        delay=brake.delay if brake is not None else 0.0,
        rise=brake.rise_time if brake is not None else 0.0,
        rising=_rising(spec) if starts else 0.0,
        looks=scene.window_factor,
        rotor=model.rotor_mass(spec, braking=False),
        rotor_braked=model.rotor_mass(spec, braking=True),
        reacts=spec.effects.get("drive_reaction") != "off",
    )


def _rising(spec: Travelling) -> float:
    """Of the reference of a converter that is given as a motor's curve [s]."""
    curve = spec.drive.motor.curve
    return curve.ramp_time if isinstance(curve, ConverterMotor) else 0.0


def _least_force(spec: Travelling, force: float) -> float:
    """Of a motor's curve on its way to full speed [N]."""
    curve = spec.drive.motor.curve
    if curve is None or isinstance(curve, ConverterMotor):
        return force
    return model.driving_force(spec, model.least_torque(spec))


def stalls(motion: Motion) -> bool:
    """Whether a torque does not get it going, or does not stop it.

    A motor's curve that falls below the resistance stalls too. A simulation shows how far it comes; of a load that is
    hoisted as long as the start lasts no rope would be left for one.
    """
    if motion.ramp is not None:
        return False
    resistance = motion.rolling + motion.outside
    if motion.starts:
        return motion.force <= resistance or (motion.least_force <= resistance and _out_of_rope(motion))
    return motion.force + resistance <= 0


def _out_of_rope(motion: Motion) -> bool:
    """Whether a load that is hoisted as long as the start by the mean torque lasts has no rope left."""
    return motion.asked_time is None and motion.hoisting * motion.rigid_time >= motion.length
