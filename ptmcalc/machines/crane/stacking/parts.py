"""The structure of a stacker crane, as a designer writes it: bridge and trolley or base, column, carriage, cab."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from ptmcalc.base import units
from ptmcalc.spec.fields import (
    Fraction,
    Length,
    Mass,
    Measure,
    PositiveForce,
    PositiveLength,
    PositiveMass,
    PositiveSpan,
    PositiveStiffness,
    PositiveStress,
    SignedSpan,
    Span,
)
from ptmcalc.spec.fragment import Conflict, Fragment, Given, at_most_one

SecondMoment = Annotated[float, Measure(units.SECOND_MOMENT, above=0)]
SectionModulus = Annotated[float, Measure(units.SECTION_MODULUS, above=0)]
RootStiffness = Annotated[float, Measure(units.TORSIONAL_STIFFNESS, above=0)]
Decrement = Annotated[float, Measure(units.RATIO, above=0, at_most=3)]
STEEL = 210e9


class Bridge(Fragment):
    """The bridge of an overhead stacker: two equal girders on end carriages."""

    mass: PositiveMass
    """without the trolley"""
    span: PositiveSpan
    """from rail to rail"""
    girder_vertical: SecondMoment | None = None
    """second moment of area of ONE girder, for bending in the vertical plane"""
    girder_horizontal: SecondMoment | None = None
    """second moment of area of ONE girder, for bending in the horizontal plane"""
    ends: Literal["supported", "clamped"] = "supported"
    """how the end carriages hold the girders: they let them turn, or clamp them wholly"""
    elasticity: PositiveStress = STEEL
    """modulus of elasticity; 210 GPa when left out"""
    section_modulus_vertical: SectionModulus | None = None
    """of ONE girder, for bending in the vertical plane; needed for its stress"""
    section_modulus_horizontal: SectionModulus | None = None
    """of ONE girder, for bending in the horizontal plane; needed for its stress"""


class Trolley(Fragment):
    """The trolley the column hangs from."""

    mass: PositiveMass
    """with hoist and slewing gear of the column, without column, carriage and cab"""
    gauge: PositiveLength
    """from girder to girder"""
    position: Span | None = None
    """of the column, from the nearer end of the bridge; in the middle when left out"""
    wheels: Literal["free", "braked"] = "free"
    """whether the wheels roll along the girders as these bend; a braked trolley is a little stiffer"""


class Base(Fragment):
    """The bottom carriage of a rack stacker."""

    mass: PositiveMass
    """with its drive and all that stands on it, without the column"""
    wheel_base: PositiveSpan
    """from the front to the rear wheel"""
    wheel_diameter: PositiveLength
    """at the tread"""
    column: Span | None = None
    """of the column from the rear wheel; in the middle when left out"""
    centre: Span | None = None
    """of its centre of mass from the rear wheel; in the middle when left out"""
    height: Span = 0.0
    """of its centre of mass above the rail"""
    gauge: PositiveLength | None = None
    """between its two rails, of a machine that stands across the aisle by itself; one rail when left out"""


class TopGuide(Fragment):
    """What holds the head of the column of a rack stacker along the aisle or across it."""

    stiffness: PositiveStiffness | None = None
    """along the aisle, of the guide at the head; the head is free when left out"""
    gap: Length = 0.0
    """play to each side before it holds"""
    rating: PositiveForce | None = None
    """largest force of the guide across the aisle; needed to see whether it keeps the machine upright"""


class Column(Fragment):
    """The column: it hangs from the trolley, or stands on the base. Sections are of ONE mast."""

    length: PositiveSpan
    """from where it is held to its far end; of an overhead stacker from the neutral axis of the girders"""
    foot: Span = 0.0
    """of its lower end, above the floor"""
    mass: PositiveMass
    """of all masts, with the head"""
    count: Annotated[int, Field(ge=1, le=2, strict=True)] = 1
    """masts"""
    elasticity: PositiveStress = STEEL
    """modulus of elasticity; 210 GPa when left out"""
    second_moment: SecondMoment | None = None
    """of area, for bending along the travel of bridge or base; or give `stiffness`"""
    second_moment_across: SecondMoment | None = None
    """of area, for bending across it: along the girders, across the aisle; as along when left out"""
    stiffness: PositiveStiffness | None = None
    """at the far end, along every travel, of column and what holds it; instead of the sections of column and girders"""
    root_stiffness: RootStiffness | None = None
    """of the joint that holds the column, against turning; rigid when left out"""
    log_decrement: Decrement | None = None
    """of its free swing, from a measurement; needed for the time in which it settles"""
    top_guide: TopGuide | None = None
    """at the head of a rack stacker"""
    section_modulus: SectionModulus | None = None
    """for bending along the travel of bridge or base; needed for the stress of the column"""
    section_modulus_across: SectionModulus | None = None
    """for bending across it; as along when left out"""
    area: Annotated[float, Measure(units.AREA, above=0)] | None = None
    """of the section of one mast; the stress of pull or push is left out without it"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Its stiffness is given in one way."""
        yield from at_most_one(given, "stiffness", "second_moment")
        if "stiffness" in given:
            for key in ("second_moment_across", "root_stiffness"):
                if key in given:
                    yield Conflict((key,), "it is part of the `stiffness`", f"delete `{key}`")
        elif "second_moment" not in given:
            yield given.missing("second_moment", "give `second_moment`, or the whole `stiffness`")


class Rollers(Fragment):
    """The guide rollers of the carriage: an upper and a lower set for each plane."""

    distance: PositiveLength
    """from the upper to the lower rollers"""
    diameter: PositiveLength
    """of a roller"""
    axle_diameter: PositiveLength
    """of its axle"""
    pin_friction: Fraction = 0.015
    """of its bearing; 0.015 rolling, 0.08 to 0.1 plain"""
    lever_arm: Length = 0.0005
    """of rolling, a length; 0.3 to 0.6 mm on steel"""
    per_set: Annotated[int, Field(ge=1, le=8, strict=True)] = 1
    """rollers that share the reaction of a set"""
    planes: Literal["separate", "joint"] | None = None
    """whether each plane has rollers of its own, or one set bears both: between the two when left out"""
    rating: PositiveForce | None = None
    """largest load of one roller; needed to check it"""


class Carriage(Fragment):
    """The carriage that climbs the column with the load."""

    mass: PositiveMass
    """without load and cab, with its fork"""
    load_arm: SignedSpan = 0.0
    """of the load, from the line of the ropes, along the travel of bridge or base"""
    own_arm: SignedSpan = 0.0
    """of the carriage's own centre of mass"""
    load_arm_across: SignedSpan = 0.0
    """of the load, from the line of the ropes across it: with the fork out"""
    own_arm_across: SignedSpan = 0.0
    """of the carriage's own centre of mass"""
    lowest: Span | None = None
    """place of the carriage above the floor, at least; at the lower end of the column when left out"""
    highest: Span | None = None
    """place of the carriage above the floor, at most; at the upper end of the column when left out"""
    rollers: Rollers
    """its guide rollers"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """It goes up, not down."""
        low, high = given.number("lowest"), given.number("highest")
        if low is not None and high is not None and high <= low:
            yield Conflict(("highest",), "it is not above `lowest`", "swap them")


class Cab(Fragment):
    """A cab that climbs with the carriage."""

    mass: Mass
    """with the driver"""
    arm: SignedSpan = 0.0
    """of its centre of mass, from the line of the ropes, along the travel of bridge or base"""
    arm_across: SignedSpan = 0.0
    """of its centre of mass across it"""
