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
    """A travel mechanism: speed, starting and braking.

    It follows a speed ramp (`acceleration`, `deceleration`), or a force acts at its wheel treads
    (`driving_force`, `braking_force`, or those of a `drive`).
    """

    speed: PositiveSpeed
    """full speed"""
    acceleration: Annotated[PositiveAcceleration | None, OneOf("ramps, forces or a `drive`")] = None
    """of a start on a speed ramp"""
    deceleration: Annotated[PositiveAcceleration | None, OneOf("ramps, forces or a `drive`")] = None
    """of a stop on a speed ramp"""
    ramp_rise: Annotated[Time, Absent("a sudden acceleration causes the largest mast deflection")] = 0.0
    """linear rise and fall time of the ramp acceleration"""
    driving_force: Annotated[PositiveForce | None, OneOf("ramps, forces or a `drive`")] = None
    """at the wheel treads, of a start by force"""
    driving_rise: Annotated[Time, Absent("a sudden force causes the largest mast deflection")] = 0.0
    """linear rise time"""
    braking_force: Annotated[PositiveForce | None, OneOf("ramps, forces or a `drive`")] = None
    """at the wheel treads, of a stop by force, without the resistance"""
    braking_delay: Annotated[Time | None, Assumed()] = None
    """from switch-off to the start of the braking force"""
    braking_rise: Annotated[Time, Absent("the interval of the assumed `braking_delay` includes the rise")] = 0.0
    """linear rise time"""
    resistance: Annotated[Force | None, Assumed()] = None
    """to travel, at the wheel treads"""
    drive: TravelDrive | None = None
    """motors, gear and brakes, instead of forces and ramps"""
    wheel_diameter: Annotated[PositiveLength | None, OneOf("forces and ramps at the wheel treads")] = None
    """of the driven wheels; with a `drive`"""
    starts_per_hour: Annotated[HourlyRate | None, Checked()] = None
    """starts per hour of the mechanism; needed to check them"""
    permitted_starts_per_hour: Annotated[HourlyRate | None, Limit()] = None
    """permitted by motor and brake; default: that of the motor of the drive"""
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
    """The mechanism that rotates the mast about its own axis."""

    speed: PositiveAngularSpeed
    """full speed"""
    inertia: PositiveInertia
    """of mast, carriage, cab and load about the axis, reduced rotor included"""
    driving_torque: PositiveTorque
    """at the mast"""
    braking_torque: PositiveTorque
    """at the mast"""
    resistance: Annotated[Torque | None, Assumed()] = None
    """of its bearings, at the mast"""
    starts_per_hour: Annotated[HourlyRate | None, Checked()] = None
    """starts per hour of the mechanism; needed to check them"""
    permitted_starts_per_hour: Annotated[HourlyRate | None, Limit()] = None
    """permitted by motor and brake; needed to check the starts"""


class HoistRope(Fragment):
    """The hoist ropes of the carriage."""

    falls: Falls
    """total number of rope falls at the carriage"""
    ropes: Literal[1, 2] = 1
    """number of ropes on the drum"""
    sheave_efficiency: Annotated[Efficiency | None, Assumed()] = None
    """of a sheave; 0.98 is assumed when neither it nor `efficiency` is given"""
    efficiency: Annotated[Efficiency | None, OneOf("sheave_efficiency")] = None
    """of the whole reeving while hoisting, instead of that of a sheave"""
    diameter: Annotated[PositiveLength | None, Limit()] = None
    """nominal"""
    breaking_force: Annotated[PositiveForce | None, Checked()] = None
    """of one rope; needed to check its safety factor"""
    stiffness: Annotated[
        PositiveStiffness | None, OneOf("`stiffness`, or `area` and `length`; without both no `fork_caught`")
    ] = None
    """of all falls at the carriage; or give `area` and `length`"""
    area: Annotated[
        PositiveArea | None, OneOf("`stiffness`, or `area` and `length`; without both no `fork_caught`")
    ] = None
    """metallic area of one rope"""
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
    """The load limiter, which switches off the hoist."""

    force: PositiveForce
    """trip force, at the carriage"""
    reaction: Time
    """from tripping until the motor is off and the brake acts"""
    braking_force: Annotated[
        PositiveForce | None, Absent("a brake that holds the carriage has at least the force of its weight")
    ] = None
    """of the brake, at the carriage; default: that of the motor in steady hoisting"""


class HoistDrive(Fragment):
    """Motor, gear and drum of the hoist, reduced to the carriage."""

    reduced_mass: Annotated[PositiveMass | None, OneOf("`reduced_mass`, or `inertia`, `ratio` and `drum_diameter`")] = (
        None
    )
    """of all rotating parts, at the carriage, while the motor drives; or give `inertia`, `ratio` and `drum_diameter`"""
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
    """maximum motor force, at the carriage; default: the weight"""
    slope: Annotated[Slope | None, Absent("a constant motor force results in the largest rope force")] = None
    """decrease of the motor force per speed, at the carriage; a constant force when left out"""

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
    """The hoist of the carriage."""

    speed: PositiveSpeed
    """of the carriage"""
    acceleration: PositiveAcceleration
    """of the carriage, at a start upwards or a stop while lowering"""
    rope: HoistRope
    """hoist ropes"""
    drive: HoistDrive | None = None
    """hoist drive; needed for a `fork_caught`"""
    limiter: Limiter | None = None
    """load limiter"""
    group: Group | None = None
    """mechanism group (ISO 4301-1); it determines the rope safety factor by ISO 4308-1"""
    starts_per_hour: Annotated[HourlyRate | None, Checked()] = None
    """starts per hour of the hoist; needed to check them"""
    permitted_starts_per_hour: Annotated[HourlyRate | None, Limit()] = None
    """permitted by motor and brake; needed to check the starts"""

    @property
    def catches(self) -> bool:
        """Whether the file says enough to see the fork caught by the rack."""
        return self.drive is not None and (self.rope.stiffness is not None or self.rope.area is not None)
