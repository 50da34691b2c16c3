"""The drive of a slewing crane: motor, gear with its open stage, and brake."""

from collections.abc import Iterator
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from ptmcalc.base import units
from ptmcalc.base.span import KeyPath
from ptmcalc.components.motor import AnyMotor
from ptmcalc.components.motor_rating import rated_torque_of, rating_key, ratings_that_differ
from ptmcalc.laws import gearing, motor
from ptmcalc.spec.fields import (
    Efficiency,
    Inertia,
    Measure,
    PositiveAngularSpeed,
    PositiveInertia,
    PositivePower,
    PositiveRatio,
    PositiveShare,
    PositiveTorque,
    ReverseEfficiency,
    Time,
)
from ptmcalc.spec.fragment import Conflict, Fragment, Given, at_most_one, together
from ptmcalc.spec.optional import Absent, Assumed, Limit, OneOf

PartsFactor = Annotated[float, Measure(units.FACTOR, at_least=1, at_most=3)]


class SlewMotor(Fragment):
    """The slewing motors, one of several equal ones."""

    count: Annotated[int, Field(ge=1, le=16, strict=True), Absent("one motor, the least torque")] = 1
    """number of equal motors"""
    inertia: PositiveInertia
    """rotor of one motor"""
    coupling_inertia: Annotated[Inertia | None, OneOf("coupling_factor")] = None
    """coupling and brake disc of one motor, on the motor shaft, or give `coupling_factor`"""
    coupling_factor: Annotated[PartsFactor | None, Assumed()] = None
    """rotor with coupling / rotor alone, 1.4 to 2; 1.7 is assumed when neither is given"""
    mean_starting_torque: Annotated[PositiveTorque | None, OneOf("largest_starting_torque, curve")] = None
    """mean starting torque of one motor, or give the largest and the smallest, or a `curve`"""
    largest_starting_torque: Annotated[PositiveTorque | None, OneOf("mean_starting_torque, curve")] = None
    """torque after each step of a rheostat start, one motor"""
    smallest_starting_torque: Annotated[PositiveTorque | None, OneOf("mean_starting_torque, curve")] = None
    """torque before each step of a rheostat start, one motor"""
    curve: AnyMotor | None = None
    """torque over speed of one motor"""
    speed: Annotated[PositiveAngularSpeed | None, Absent("only compared with that of the crane")] = None
    """rated speed; compared with that of the crane and the ratio"""
    rated_torque: Annotated[PositiveTorque | None, Limit()] = None
    """of one motor, or give `power` and `speed`; needed to check its heating"""
    power: Annotated[PositivePower | None, Limit()] = None
    """rated power of one motor"""
    rated_duty: Annotated[
        PositiveShare, Absent("continuous duty: the smallest design torque of a motor of this rating")
    ] = 1.0
    """duty factor of the rating, e.g. `40 %`; continuous when left out"""
    largest_torque: Annotated[PositiveTorque | None, Limit()] = None
    """permissible short-time torque of one motor"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The starting torque, the rating and the coupling are given in one way each."""
        mean, largest, smallest = (f"{size}_starting_torque" for size in ("mean", "largest", "smallest"))
        yield from at_most_one(given, mean, largest, "curve")
        yield from together(given, largest, smallest, "the largest and the smallest starting torque are given together")
        yield from together(given, smallest, largest, "the largest and the smallest starting torque are given together")
        high, low = given.number(largest), given.number(smallest)
        if high is not None and low is not None and low > high:
            yield Conflict((smallest,), "the smallest starting torque is above the largest", "swap them")
        yield from at_most_one(given, "coupling_inertia", "coupling_factor")
        yield from at_most_one(given, "rated_torque", "power")
        yield from together(given, "power", "speed", "the rated torque is power over speed")
        yield from ratings_that_differ(given)

    @property
    def rated(self) -> float | None:
        """Rated torque of one motor [N*m], of its `curve` where the file does not give it besides."""
        if self.power is not None and self.speed is not None:
            return motor.rated_torque(self.power, self.speed)
        return rated_torque_of(self.rated_torque, self.curve)

    @property
    def rating_key(self) -> KeyPath:
        """The key that states its rating."""
        return rating_key(self.power, self.rated_torque, self.curve)

    @property
    def rotating_inertia(self) -> float:
        """Rotors with couplings of all motors [kg*m^2]."""
        if self.coupling_inertia is not None:
            return self.count * (self.inertia + self.coupling_inertia)
        return self.count * self.inertia * (self.coupling_factor or 1.0)

    def mean_torque(self, speed: float) -> float | None:
        """Mean starting torque of all motors up to a speed of the motor shaft, None where the file has none [N*m]."""
        if self.mean_starting_torque is not None:
            return self.count * self.mean_starting_torque
        if self.largest_starting_torque is not None and self.smallest_starting_torque is not None:
            return self.count * motor.mean_starting_torque(self.largest_starting_torque, self.smallest_starting_torque)
        if self.curve is None:
            return None
        return self.count * float(np.mean(self.curve.torque(np.linspace(0.0, speed, 401), np.inf)))

    @property
    def torque_key(self) -> str:
        """The key that says how strongly it starts."""
        if self.curve is not None:
            return "curve"
        return "largest_starting_torque" if self.largest_starting_torque is not None else "mean_starting_torque"


class OpenGear(Fragment):
    """The open stage at the slewing axis: pinion and ring gear, or lantern gear."""

    ratio: PositiveRatio
    """pinion speed / slewing speed"""
    efficiency: Annotated[Efficiency, Assumed(0.95, 0.92, 0.97, "open stages with grease 0.92 to 0.97")] = 0.95
    """of this stage"""


class SlewGear(Fragment):
    """The whole gear between motor and slewing axis."""

    ratio: PositiveRatio
    """motor speed / slewing speed, open stage included"""
    efficiency: Efficiency
    """from motor to crane, open stage included"""
    reverse_efficiency: Annotated[ReverseEfficiency | None, Assumed()] = None
    """from crane to motor; 2 - 1/efficiency when left out, negative for a self-locking worm"""
    open: OpenGear | None = None
    """the open stage; needed for the torque of the pinion"""
    rotating_factor: Annotated[
        PartsFactor, Assumed(1.15, 1.1, 1.2, "the rotating parts of the gear add 10 to 20 %")
    ] = 1.15
    """inertia of all rotating drive parts / inertia on the motor shaft, 1.1 to 1.2"""
    rated_torque: Annotated[PositiveTorque | None, Limit()] = None
    """rated input torque of the gearbox in its mechanism group; needed to check it"""
    pinion_torque: Annotated[PositiveTorque | None, Limit()] = None
    """permissible torque for the service life of the open pinion; needed to check it"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The open stage is a part of the whole."""
        stage, whole, loss = given.block("open"), given.number("ratio"), given.number("efficiency")
        if stage is None or "open" not in given:
            return
        ratio, efficiency = stage.number("ratio"), stage.number("efficiency")
        if ratio is not None and whole is not None and ratio > whole:
            reason = f"the whole ratio is {whole:g} only, and the open stage is a part of it"
            yield Conflict(("open", "ratio"), reason, "give the total `ratio` of all stages, from motor to crane")
        if efficiency is not None and loss is not None and efficiency < loss:
            reason = f"the whole efficiency is {loss:g}, and the open stage is a part of it"
            yield Conflict(
                ("open", "efficiency"), reason, "give the total `efficiency` of all stages, from motor to crane"
            )

    @property
    def back(self) -> float:
        """Efficiency from crane to motor; negative for a self-locking gear."""
        if self.reverse_efficiency is not None:
            return self.reverse_efficiency
        return gearing.reverse_efficiency(self.efficiency)


class SlewBrake(Fragment):
    """The brake of the slewing drive."""

    torque: PositiveTorque
    """of all brakes together, fully applied"""
    shaft: Literal["motor", "crane"] = "motor"
    """shaft of the brake: motor shaft or slewing axis"""
    delay: Annotated[Time, Assumed(0.0, 0.0, 0.3, "slewing brakes close 0.1 to 0.3 s after they are switched off")] = (
        0.0
    )
    """from switch-off to the start of the braking torque"""
    rise_time: Annotated[Time, Absent("the interval of the assumed `delay` includes the rise")] = 0.0
    """from then to full torque, linear rise"""
