"""Motors and other torques on the inertias of a train."""

import math
from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from ptmcalc.base import units
from ptmcalc.components.motor import AnyMotor
from ptmcalc.machines.drivetrain.machine.keys.quantities import AngularFrequency, AnySpeed, Torque, Turn, either, rising
from ptmcalc.spec.fields import Measure, PositiveFrequency, PositiveTime, Time
from ptmcalc.spec.fragment import Conflict, Fragment, Given, exactly_one
from ptmcalc.spec.optional import Absent, OneOf


class OnInertia(Fragment):
    """What acts on one inertia."""

    at: str
    """the inertia it acts on"""
    acts: Literal["always", "when_running"] = "always"
    """`when_running`: not in scenes of the type `stop`"""


class ConstantTorque(OnInertia):
    """A constant torque or force: a weight, a suspended load."""

    type: Literal["constant"]
    torque: Torque
    """positive in the direction of motion"""
    delay: Annotated[Time, Absent("it acts from the start")] = 0.0
    """start of the torque"""


class RisingTorque(OnInertia):
    """A torque that changes linearly with time."""

    type: Literal["ramp"]
    torque: Torque
    """at the end of the ramp, and after it"""
    first: Annotated[Torque, Absent("it starts from zero")] = 0.0
    """at the start of the scene"""
    time: PositiveTime
    """duration of the ramp"""


class SineTorque(OnInertia):
    """A harmonic torque: mean + amplitude sin(w t + phase)."""

    type: Literal["sine"]
    amplitude: Torque
    """amplitude of the torque"""
    frequency: Annotated[PositiveFrequency | None, OneOf("angular_frequency")] = None
    """cycles per second"""
    angular_frequency: Annotated[AngularFrequency | None, OneOf("frequency")] = None
    """w itself, instead of `frequency`"""
    mean: Annotated[Torque, Absent("it has no mean")] = 0.0
    """mean torque"""
    phase: Annotated[Annotated[float, Measure(units.ANGLE)], Absent("it starts at 0")] = 0.0
    """of the sine at the start of the scene"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The frequency is given in one way."""
        yield from exactly_one(given, "frequency", "angular_frequency")

    @property
    def omega(self) -> float:
        """Angular frequency [rad/s]."""
        return self.angular_frequency or 2 * math.pi * (self.frequency or 0.0)


class TimePoint(Fragment):
    """A torque at a time."""

    time: Time
    """since the start of the scene"""
    torque: Torque
    """at that point"""


class SpeedPoint(Fragment):
    """A torque at a speed."""

    speed: AnySpeed
    """of the inertia"""
    torque: Torque
    """at that point"""


class PositionPoint(Fragment):
    """A torque at an angle or position."""

    position: Turn
    """of the inertia"""
    torque: Torque
    """at that point"""


class OverTime(OnInertia):
    """A torque over time, linear between points; the last value remains constant."""

    type: Literal["over_time"]
    points: Annotated[tuple[TimePoint, ...], Field(min_length=2, max_length=2000)]
    """in ascending order"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Times increase."""
        yield from rising(given, "time")


class OverSpeed(OnInertia):
    """A torque over the speed of its inertia; the end values apply outside."""

    type: Literal["over_speed"]
    points: Annotated[tuple[SpeedPoint, ...], Field(min_length=2, max_length=500)]
    """in ascending order"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Speeds increase."""
        yield from rising(given, "speed")


class OverPosition(OnInertia):
    """A torque over the angle or position of its inertia."""

    type: Literal["over_position"]
    points: Annotated[tuple[PositionPoint, ...], Field(min_length=2, max_length=500)]
    """in ascending order"""
    period: Annotated[
        Annotated[float, either(units.ANGLE, units.LENGTH, above=0)] | None, Absent("it is not periodic")
    ] = None
    """period of the table; its last point is one period after the first"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Positions increase; a table that repeats spans its period."""
        yield from rising(given, "position")
        period = given.number("period")
        points = given.blocks("points")
        places = [point.number("position") if point else None for point in points]
        known = [place for place in places if place is not None]
        if period is not None and 1 < len(known) == len(places) and abs(known[-1] - known[0] - period) > 1e-9 * period:
            yield Conflict(("period",), "the points do not span one period", "give the first point again at the end")


AnyTorque = Annotated[
    ConstantTorque | RisingTorque | SineTorque | OverTime | OverSpeed | OverPosition, Field(discriminator="type")
]


class MotorOn(Fragment):
    """A motor on an inertia; it is off in scenes of the type `stop`."""

    at: str
    """the inertia it acts on"""
    motor: AnyMotor
    """torque of the motor"""
    count: Annotated[Annotated[int, Field(ge=1, le=64, strict=True)], Absent("one motor drives the inertia")] = 1
    """number of equal motors"""
    off_after: Annotated[PositiveTime | None, Absent("it stays on")] = None
    """time of the switch-off"""
    off_delay: Annotated[Time, Absent("it is off at the start of a stop")] = 0.0
    """in a `stop`: delay of the switch-off"""
