"""What moves a stacker crane, as a designer writes it: travel, rotation of the column, hoisting."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from ptmcalc.base import units
from ptmcalc.components.buffer import Buffer
from ptmcalc.components.travel_drive import TravelDrive
from ptmcalc.spec.fields import (
    Efficiency,
    Force,
    HourlyRate,
    Inertia,
    Measure,
    PositiveAcceleration,
    PositiveAngularSpeed,
    PositiveArea,
    PositiveForce,
    PositiveInertia,
    PositiveLength,
    PositiveMass,
    PositiveRatio,
    PositiveSpan,
    PositiveSpeed,
    PositiveStiffness,
    PositiveStress,
    PositiveTorque,
    Time,
    Torque,
)
from ptmcalc.spec.fragment import Conflict, Fragment, Given, at_most_one, together
from ptmcalc.spec.optional import Absent, Assumed, Checked, Limit, OneOf

Slope = Annotated[float, Measure(units.DAMPING, above=0)]
ROPE_MODULUS = 105e9
"""Of six-strand ropes on their metallic area [Pa]."""
Falls = Annotated[int, Field(ge=1, le=64, strict=True)]
Group = Literal["M1", "M2", "M3", "M4", "M5", "M6", "M7", "M8"]


class Travel(Fragment):
    """A mechanism that travels: how fast, and what starts and stops it.

    It keeps to a ramp of speed (`acceleration`, `deceleration`), or a force acts at its wheel treads
    (`driving_force`, `braking_force`, or those of a `drive`).
    """

    speed: PositiveSpeed
    """at full"""
    acceleration: Annotated[PositiveAcceleration | None, OneOf("ramps, forces or a `drive`")] = None
    """of a start along a ramp of speed"""
    deceleration: Annotated[PositiveAcceleration | None, OneOf("ramps, forces or a `drive`")] = None
    """of a stop along a ramp of speed"""
    ramp_rise: Annotated[Time, Absent("a sudden acceleration causes the largest mast deflection")] = 0.0
    """in which the acceleration of a ramp rises and falls linearly"""
    driving_force: Annotated[PositiveForce | None, OneOf("ramps, forces or a `drive`")] = None
    """at the wheel treads, of a start by force"""
    driving_rise: Annotated[Time, Absent("a sudden force causes the largest mast deflection")] = 0.0
    """in which it rises linearly"""
    braking_force: Annotated[PositiveForce | None, OneOf("ramps, forces or a `drive`")] = None
    """at the wheel treads, of a stop by force, without the resistance"""
    braking_delay: Annotated[Time | None, Assumed()] = None
    """from switching off until it begins"""
    braking_rise: Annotated[Time, Absent("the interval of the assumed `braking_delay` includes the rise")] = 0.0
    """in which it rises linearly"""
    resistance: Annotated[Force | None, Assumed()] = None
    """to travel, at the wheel treads"""
    drive: TravelDrive | None = None
    """motors, gear and brakes, instead of forces and ramps"""
    wheel_diameter: Annotated[PositiveLength | None, OneOf("forces and ramps at the wheel treads")] = None
    """of the driven wheels; with a `drive`"""
    starts_per_hour: Annotated[HourlyRate | None, Checked()] = None
    """what the mechanism does all day; needed to check its starts"""
    permitted_starts_per_hour: Annotated[HourlyRate | None, Limit()] = None
    """what motor and brake allow; that of the drive's motor when left out"""
    buffers: Buffer | None = None
    """at the ends of its path; needed for a `buffer`"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """What starts and what stops it is given in one way."""
        yield from at_most_one(given, "acceleration", "driving_force")
        yield from at_most_one(given, "deceleration", "braking_force")
        if "drive" in given:
            for key in ("acceleration", "driving_force", "deceleration", "braking_force"):
                if key in given:
                    yield Conflict((key,), "the `drive` defines start and stop", f"delete `{key}`, or the drive")
            yield from together(given, "drive", "wheel_diameter", "its torques act at the wheel treads")
        elif not any(key in given for key in ("deceleration", "braking_force")):
            yield given.missing(
                "braking_force", "the mechanism has no brake: give `deceleration`, `braking_force` or a `drive`"
            )
        for key, force in (("driving_rise", "driving_force"), ("braking_rise", "braking_force")):
            if given.number(key) and force not in given:
                yield Conflict((key,), f"there is no `{force}` with a rise time", f"delete `{key}`")
        if given.number("ramp_rise") and not ({"acceleration", "deceleration"} & set(given.raw)):
            yield Conflict(
                ("ramp_rise",), "there is no ramp with a rise time of the acceleration", "delete `ramp_rise`"
            )

    @property
    def starts(self) -> bool:
        """Whether the file says what starts it."""
        return any(one is not None for one in (self.acceleration, self.driving_force, self.drive))


class Rotation(Fragment):
    """The mechanism that turns the column about its own axis."""

    speed: PositiveAngularSpeed
    """at full"""
    inertia: PositiveInertia
    """of column, carriage, cab and load about the axis, the rotor reduced to it included"""
    driving_torque: PositiveTorque
    """at the column"""
    braking_torque: PositiveTorque
    """at the column"""
    resistance: Annotated[Torque | None, Assumed()] = None
    """of its bearings, at the column"""
    starts_per_hour: Annotated[HourlyRate | None, Checked()] = None
    """what the mechanism does all day; needed to check its starts"""
    permitted_starts_per_hour: Annotated[HourlyRate | None, Limit()] = None
    """what motor and brake allow; needed to check the starts"""


class HoistRope(Fragment):
    """The ropes the carriage hangs on."""

    falls: Falls
    """parts of rope the carriage hangs on, all together"""
    ropes: Literal[1, 2] = 1
    """parts of rope that run onto the drum"""
    sheave_efficiency: Annotated[Efficiency | None, Assumed()] = None
    """of a sheave; 0.98 is assumed when neither it nor `efficiency` is given"""
    efficiency: Annotated[Efficiency | None, OneOf("sheave_efficiency")] = None
    """of the whole tackle while it hauls, instead of that of a sheave"""
    diameter: Annotated[PositiveLength | None, Limit()] = None
    """nominal"""
    breaking_force: Annotated[PositiveForce | None, Checked()] = None
    """of one part of rope; needed to check its safety"""
    stiffness: Annotated[
        PositiveStiffness | None, OneOf("`stiffness`, or `area` and `length`; without both no `fork_caught`")
    ] = None
    """of all falls at the carriage; or give `area` and `length`"""
    area: Annotated[
        PositiveArea | None, OneOf("`stiffness`, or `area` and `length`; without both no `fork_caught`")
    ] = None
    """metallic, of one part of rope"""
    modulus: Annotated[PositiveStress | None, Assumed()] = None
    """of the rope on its metallic area, not of its wire; 105 GPa when left out"""
    length: Annotated[
        PositiveSpan | None, OneOf("`stiffness`, or `area` and `length`; without both no `fork_caught`")
    ] = None
    """of one rope between the drum and its end"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Losses and stiffness are given in one way; two ropes share out evenly."""
        yield from at_most_one(given, "sheave_efficiency", "efficiency")
        for key in ("area", "length"):
            yield from at_most_one(given, "stiffness", key)
        yield from together(given, "area", "length", "the stiffness of the rope depends on both")
        yield from together(given, "length", "area", "the stiffness of the rope depends on both")
        falls, ropes = given.raw.get("falls"), given.raw.get("ropes", 1)
        if isinstance(falls, int) and ropes == 2 and falls % 2:
            reason = f"{falls} falls cannot be divided between two ropes"
            yield Conflict(("falls",), reason, f"write `falls: {falls + 1}`, or `ropes: 1`")


class Limiter(Fragment):
    """What switches the hoist off at too large a force."""

    force: PositiveForce
    """at the carriage, at which it trips"""
    reaction: Time
    """from then until the motor is off and the brake acts"""
    braking_force: Annotated[
        PositiveForce | None, Absent("a brake that holds the carriage has at least the force of its weight")
    ] = None
    """of the brake, at the carriage; that of the motor in even hoisting when left out"""


class HoistDrive(Fragment):
    """Motor, gear and drum of the hoist, as the carriage feels them."""

    reduced_mass: Annotated[PositiveMass | None, OneOf("`reduced_mass`, or `inertia`, `ratio` and `drum_diameter`")] = (
        None
    )
    """of all that turns, at the carriage, while the motor drives; or give `inertia`, `ratio` and `drum_diameter`"""
    inertia: Annotated[Inertia | None, OneOf("`reduced_mass`, or `inertia`, `ratio` and `drum_diameter`")] = None
    """of rotor, coupling and brake, on the motor shaft"""
    ratio: Annotated[PositiveRatio | None, OneOf("`reduced_mass`, or `inertia`, `ratio` and `drum_diameter`")] = None
    """of the gear"""
    gear_efficiency: Annotated[Efficiency | None, Assumed()] = None
    """from motor to drum"""
    drum_diameter: Annotated[
        PositiveLength | None, OneOf("`reduced_mass`, or `inertia`, `ratio` and `drum_diameter`")
    ] = None
    """to the middle of the rope"""
    largest_force: Annotated[PositiveForce | None, Assumed()] = None
    """of the motor that goes on pulling, at the carriage; the weight when left out"""
    slope: Annotated[Slope | None, Absent("a constant motor force results in the largest rope force")] = None
    """by which the motor's force falls with the speed, at the carriage; a constant force when left out"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The mass is given in one way."""
        parts = ("inertia", "ratio", "drum_diameter")
        for key in parts:
            yield from at_most_one(given, "reduced_mass", key)
        if not any(key in given for key in ("reduced_mass", *parts)):
            yield given.missing("reduced_mass", "give `reduced_mass`, or `inertia`, `ratio` and `drum_diameter`")
        for key in parts:
            for other in parts:
                if key in given and other not in given:
                    yield given.missing(other, f"the mass at the carriage depends on it: `{other}` is missing")
                    return


class Hoisting(Fragment):
    """The hoist that lifts the carriage."""

    speed: PositiveSpeed
    """of the carriage"""
    acceleration: PositiveAcceleration
    """of the carriage, starting up and stopping down"""
    rope: HoistRope
    """on which it hangs"""
    drive: HoistDrive | None = None
    """what turns; needed for a `fork_caught`"""
    limiter: Limiter | None = None
    """what switches it off at too large a force"""
    group: Group | None = None
    """of the mechanism (ISO 4301-1); with it the rope has to keep the safety of ISO 4308-1"""
    starts_per_hour: Annotated[HourlyRate | None, Checked()] = None
    """what the hoist does all day; needed to check its starts"""
    permitted_starts_per_hour: Annotated[HourlyRate | None, Limit()] = None
    """what motor and brake allow; needed to check the starts"""

    @property
    def catches(self) -> bool:
        """Whether the file says enough to see the fork caught by the rack."""
        return self.drive is not None and (self.rope.stiffness is not None or self.rope.area is not None)
