"""The motors of a continuous drive, and the gear between them and the drive shaft."""

from collections.abc import Iterator
from typing import Annotated, ClassVar

import numpy as np
from pydantic import Field

from ptmcalc.components.motor import AnyMotor
from ptmcalc.components.motor_rating import ratings_that_differ
from ptmcalc.laws import motor
from ptmcalc.spec.fields import (
    Efficiency,
    PositiveAngularSpeed,
    PositiveEnergy,
    PositiveInertia,
    PositiveRatio,
    PositiveTorque,
)
from ptmcalc.spec.fragment import Conflict, Fragment, Given, at_most_one, exactly_one, together
from ptmcalc.spec.optional import Absent, Assumed, Limit, OneOf


class MotorBase(Fragment):
    """Starting torque and heat of the drive motors, one of several equal ones."""

    CURVE_KEYS: ClassVar[tuple[str, ...]] = ("curve",)
    """keys of which one is enough for a start: it gives the torque over the speed"""

    count: Annotated[int, Field(ge=1, le=64, strict=True), Absent("one motor, as the file describes one")] = 1
    """number of equal motors on the drive shaft"""
    speed: Annotated[PositiveAngularSpeed | None, Limit()] = None
    """rated speed; compared with machine speed, ratio and pulley, drum or sprocket"""
    mean_starting_torque: Annotated[PositiveTorque | None, OneOf("curve, largest_starting_torque")] = None
    """mean starting torque of one motor, or give the largest and the smallest"""
    largest_starting_torque: Annotated[PositiveTorque | None, OneOf("mean_starting_torque")] = None
    """torque after each step of a rheostat start, one motor"""
    smallest_starting_torque: Annotated[PositiveTorque | None, OneOf("mean_starting_torque")] = None
    """torque before each step of a rheostat start, one motor"""
    curve: AnyMotor | None = None
    """torque-speed curve of one motor, for a start of the shape `curve`; also determines the mean torque"""
    start_heat: Annotated[PositiveEnergy | None, Limit()] = None
    """permissible rotor heat of one motor per start, from its data sheet; needed to check the start"""
    no_load_speed: Annotated[PositiveAngularSpeed | None, Limit()] = None
    """no-load speed, for an induction motor the synchronous speed; default: that of the `curve`"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The starting torque is a mean one, or swings between a largest and a smallest; a motor has one rating."""
        yield from ratings_that_differ(given)
        rated, most = given.number("speed"), given.number("no_load_speed")
        if rated is not None and most is not None and most < rated:
            yield Conflict(
                ("no_load_speed",), "a motor runs more slowly with load than without load", "check both speeds"
            )
        mean, largest, smallest = (f"{size}_starting_torque" for size in ("mean", "largest", "smallest"))
        if largest not in given and smallest not in given:
            if not any(key in given for key in cls.CURVE_KEYS):
                yield from exactly_one(given, mean, largest)
        elif mean in given:
            for key in (largest, smallest):
                yield from at_most_one(given, mean, key)
        else:
            yield from together(
                given, largest, smallest, "the largest and the smallest starting torque are given together"
            )
            yield from together(
                given, smallest, largest, "the largest and the smallest starting torque are given together"
            )
            high, low = given.number(largest), given.number(smallest)
            if high is not None and low is not None and low > high:
                yield Conflict((smallest,), "the smallest starting torque is above the largest", "swap them")

    @property
    def mean_torque(self) -> float:
        """Mean starting torque of one motor [N*m]: as given, between its steps, or of its curve up to rated speed."""
        if self.mean_starting_torque is not None:
            return self.mean_starting_torque
        if self.largest_starting_torque is not None and self.smallest_starting_torque is not None:
            return motor.mean_starting_torque(self.largest_starting_torque, self.smallest_starting_torque)
        assert self.curve is not None
        return self.mean_of(self.curve)

    def mean_of(self, curve: AnyMotor) -> float:
        """Mean torque of a curve up to rated speed [N*m]."""
        top = self.speed or curve.no_load_speed or 1.0
        return float(np.mean(curve.torque(np.linspace(0.0, top, 401), np.inf)))


class Motor(MotorBase):
    """The drive motors, one of several equal ones."""

    inertia: PositiveInertia
    """rotor of one motor"""


class Gear(Fragment):
    """The gear between motor and drive shaft."""

    ratio: PositiveRatio
    """motor speed / drive shaft speed"""
    efficiency: Annotated[Efficiency | None, Assumed()] = None
    """from motor to drive shaft; 0.94 is assumed when it is left out"""
