"""The drive that makes a crane, a trolley or a stacker travel: motors, gear, brakes, and how it is controlled."""

from collections.abc import Iterator
from typing import Annotated, Literal

from ptmcalc.components.drive import Gear
from ptmcalc.components.duty_motor import DutyMotor
from ptmcalc.laws import gearing
from ptmcalc.spec.fields import (
    Efficiency,
    PositiveAcceleration,
    PositiveTime,
    PositiveTorque,
    Time,
)
from ptmcalc.spec.fragment import Conflict, Fragment, Given, at_most_one
from ptmcalc.spec.optional import Absent, Assumed

_SELF_LOCKING = 0.5


class TravelGear(Gear):
    """The gear between motors and driven wheels, the last stage included."""

    reverse_efficiency: Annotated[Efficiency | None, Assumed()] = None
    """from wheel to motor; 2 - 1/efficiency when left out"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """A gear that locks itself would let the wheels slide at every stop."""
        yield from super().conflicts(given)
        forward = given.number("efficiency")
        locks = forward is not None and forward <= _SELF_LOCKING
        if locks and "efficiency" in given and "reverse_efficiency" not in given:
            reason = "a gear with an efficiency of 50 % or less is self-locking: the wheels slip at every stop"
            yield Conflict(("efficiency",), reason, "write more, or give its `reverse_efficiency: 0.1`")


class TravelBrake(Fragment):
    """The travel brakes, on the motor shafts."""

    torque: PositiveTorque
    """of all brakes together, fully applied"""
    delay: Annotated[Time, Assumed(0.0, 0.0, 0.3, "travel brakes close 0.1 to 0.3 s after they are switched off")] = 0.0
    """from switch-off to the start of the braking torque"""
    rise_time: Annotated[Time, Absent("the interval of the assumed `delay` includes the rise")] = 0.0
    """from then to full torque, linear rise"""


class TravelDrive(Fragment):
    """Motors, gear, brakes and their control."""

    motor: DutyMotor
    """the travel motors"""
    gear: TravelGear
    """between motor shafts and driven wheels"""
    brake: TravelBrake | None = None
    """the brakes; without them the machine stops by `deceleration`"""
    acceleration: Annotated[PositiveAcceleration | None, Absent("the motors start with their torque")] = None
    """of a drive on a speed ramp (converter); or give `ramp_time`; without either the motors start with
    their mean starting torque"""
    ramp_time: Annotated[PositiveTime | None, Absent("the motors start with their torque")] = None
    """from standstill to full speed, instead of `acceleration`"""
    deceleration: Annotated[PositiveAcceleration | None, Absent("the brakes stop the machine")] = None
    """of a service stop on a speed ramp; without it the brakes stop the machine"""
    wheels: Literal["separate", "coupled"] = "separate"
    """independent drive of every driven wheel, or all wheels coupled to one shaft"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The ramp is given in one way; something stops the machine."""
        yield from at_most_one(given, "acceleration", "ramp_time")
        if "brake" not in given and "deceleration" not in given:
            yield given.missing("brake", "the machine has no brake: give `brake` or `deceleration`")

    @property
    def torque(self) -> float:
        """Mean starting torque of all motors [N*m]."""
        return self.motor.count * self.motor.mean_torque

    @property
    def inertia(self) -> float:
        """Rotors and couplings of all motors on the motor shaft [kg*m^2]."""
        return self.motor.count * (self.motor.inertia + (self.motor.coupling_inertia or 0.0))

    @property
    def efficiency(self) -> float:
        """From motor to wheel [1]."""
        return self.gear.efficiency if self.gear.efficiency is not None else 1.0

    @property
    def reverse_range(self) -> tuple[float, float]:
        """Least and largest efficiency from wheel to motor that a gear of this efficiency has [1].

        With the same loss both ways it is 2 - 1/efficiency; losses that grow with the torque alone make it as large as
        the efficiency, with which the brakes have most of the crane to stop.
        """
        return gearing.reverse_efficiency(self.efficiency), self.efficiency

    @property
    def reverse_efficiency(self) -> float:
        """From wheel to motor [1]."""
        if self.gear.reverse_efficiency is not None:
            return self.gear.reverse_efficiency
        return gearing.reverse_efficiency(self.efficiency)

    def rim_per_torque(self, radius: float) -> float:
        """Force at the rims of the wheels per torque of the motors without losses: ratio over radius [1/m]."""
        return self.gear.ratio / radius

    def ramp(self, speed: float) -> float | None:
        """Acceleration of a drive that keeps to a ramp of speed; None of one that gives a torque [m/s^2]."""
        return speed / self.ramp_time if self.ramp_time is not None else self.acceleration
