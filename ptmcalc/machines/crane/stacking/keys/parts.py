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
from ptmcalc.spec.optional import Absent, Assumed, Limit, OneOf

SecondMoment = Annotated[float, Measure(units.SECOND_MOMENT, above=0)]
SectionModulus = Annotated[float, Measure(units.SECTION_MODULUS, above=0)]
RootStiffness = Annotated[float, Measure(units.TORSIONAL_STIFFNESS, above=0)]
Decrement = Annotated[float, Measure(units.RATIO, above=0, at_most=3)]
STEEL = 210e9
"""Modulus of elasticity of structural steel [Pa], EN 1993-1-1. It is the default of `elasticity` for masts and girders.
Their stiffness is proportional to it, their frequencies to its square root."""
_STEEL = Absent("structural steel, modulus 210 GPa by EN 1993-1-1")
_BASE_HEIGHT = Assumed(0.0, 0.0, 0.6, "the centre of gravity of a base is up to 0.6 m above the rail")
_GUIDE_PLAY = Assumed(0.0, 0.0, 0.002, "guide rollers are set with a clearance of up to 2 mm to each side")
_PIN_FRICTION = Assumed(0.015, 0.01, 0.1, "rolling bearings 0.01 to 0.02, plain bearings 0.08 to 0.1")
_LEVER_ARM = Assumed(0.0005, 0.0003, 0.0006, "0.3 to 0.6 mm for steel rollers on steel")
_LOAD_ARM = Assumed(0.0, -0.1, 0.1, "the load is eccentric on its pallet by up to a tenth of its length")
_OWN_ARM = Assumed(0.0, -0.05, 0.05, "the centre of gravity of a carriage is within a few centimetres of its ropes")
_CAB_ARM = Assumed(0.0, -1.0, 1.0, "the cab is mounted at the side of the mast: up to 1 m from the ropes")


class Bridge(Fragment):
    """The bridge of an overhead stacker: two equal girders on end carriages."""

    mass: PositiveMass
    """without the trolley"""
    span: PositiveSpan
    """from rail to rail"""
    girder_vertical: Annotated[SecondMoment | None, OneOf("the `stiffness` of the column")] = None
    """second moment of area of ONE girder, for bending in the vertical plane"""
    girder_horizontal: Annotated[SecondMoment | None, OneOf("the `stiffness` of the column")] = None
    """second moment of area of ONE girder, for bending in the horizontal plane"""
    ends: Literal["supported", "clamped"] = "supported"
    """how the end carriages hold the girders: they let them turn, or clamp them wholly"""
    elasticity: Annotated[PositiveStress, _STEEL] = STEEL
    """modulus of elasticity; 210 GPa when left out"""
    section_modulus_vertical: Annotated[
        SectionModulus | None, Absent("without it the check of the girder stress is reported as not made")
    ] = None
    """of ONE girder, for bending in the vertical plane; needed for its stress"""
    section_modulus_horizontal: Annotated[
        SectionModulus | None, Absent("without it the check of the girder stress is reported as not made")
    ] = None
    """of ONE girder, for bending in the horizontal plane; needed for its stress"""


class Trolley(Fragment):
    """The trolley the column hangs from."""

    mass: PositiveMass
    """with hoist and slewing gear of the column, without column, carriage and cab"""
    gauge: PositiveLength
    """from girder to girder"""
    position: Annotated[Span | None, Absent("in the middle, deflection and stress of the girders are largest")] = None
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
    column: Annotated[Span | None, Assumed()] = None
    """of the column from the rear wheel; in the middle when left out"""
    centre: Annotated[Span | None, Assumed()] = None
    """of its centre of mass from the rear wheel; in the middle when left out"""
    height: Annotated[Span, _BASE_HEIGHT] = 0.0
    """of its centre of mass above the rail"""
    gauge: Annotated[
        PositiveLength | None, Absent("a single rail gives no lateral stability; only the top guide does")
    ] = None
    """between its two rails, of a machine that stands across the aisle by itself; one rail when left out"""


class TopGuide(Fragment):
    """What holds the head of the column of a rack stacker along the aisle or across it."""

    stiffness: Annotated[PositiveStiffness | None, Absent("a free head has a larger deflection than a guided head")] = (
        None
    )
    """along the aisle, of the guide at the head; the head is free when left out"""
    gap: Annotated[Length, _GUIDE_PLAY] = 0.0
    """clearance to each side before it holds"""
    rating: Annotated[PositiveForce | None, Limit()] = None
    """largest force of the guide across the aisle; needed to see whether it keeps the machine upright"""


class Column(Fragment):
    """The column: it hangs from the trolley, or stands on the base. Sections are of ONE mast."""

    length: PositiveSpan
    """from where it is held to its far end; of an overhead stacker from the neutral axis of the girders"""
    foot: Annotated[Span | None, Assumed()] = None
    """of its lower end, above the floor"""
    mass: PositiveMass
    """of all masts, with the head"""
    count: Annotated[Annotated[int, Field(ge=1, le=2, strict=True)], Absent("a single mast carries the whole load")] = 1
    """masts"""
    elasticity: Annotated[PositiveStress, _STEEL] = STEEL
    """modulus of elasticity; 210 GPa when left out"""
    second_moment: Annotated[SecondMoment | None, OneOf("stiffness")] = None
    """of area, for bending along the travel of bridge or base; or give `stiffness`"""
    second_moment_across: Annotated[SecondMoment | None, Assumed()] = None
    """of area, for bending across it: along the girders, across the aisle; as along when left out"""
    stiffness: Annotated[PositiveStiffness | None, OneOf("second_moment")] = None
    """at the far end, along every travel, of column and what holds it; instead of the sections of column and girders"""
    root_stiffness: Annotated[
        RootStiffness | None,
        Absent("the mast is welded or bolted to a stiff frame; a rotating joint is a separate part"),
    ] = None
    """of the joint that holds the column, against turning; rigid when left out"""
    log_decrement: Annotated[
        Decrement | None,
        Absent("without damping, the mast oscillation is largest and the settling time is not checked"),
    ] = None
    """of its free swing, from a measurement; needed for the time in which it settles"""
    top_guide: TopGuide | None = None
    """at the head of a rack stacker"""
    section_modulus: Annotated[
        SectionModulus | None, Absent("without it the check of the mast stress is reported as not made")
    ] = None
    """for bending along the travel of bridge or base; needed for the stress of the column"""
    section_modulus_across: Annotated[SectionModulus | None, Assumed()] = None
    """for bending across it; as along when left out"""
    area: Annotated[Annotated[float, Measure(units.AREA, above=0)] | None, Assumed()] = None
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
    pin_friction: Annotated[Fraction, _PIN_FRICTION] = 0.015
    """of its bearing; 0.015 rolling, 0.08 to 0.1 plain"""
    lever_arm: Annotated[Length, _LEVER_ARM] = 0.0005
    """of rolling, a length; 0.3 to 0.6 mm on steel"""
    per_set: Annotated[
        Annotated[int, Field(ge=1, le=8, strict=True)], Absent("a single roller carries the whole reaction of its set")
    ] = 1
    """rollers that share the reaction of a set"""
    planes: Literal["separate", "joint"] | None = None
    """whether each plane has rollers of its own, or one set carries both: between the two when left out"""
    rating: Annotated[PositiveForce | None, Limit()] = None
    """largest load of one roller; needed to check it"""


class Carriage(Fragment):
    """The carriage that climbs the column with the load."""

    mass: PositiveMass
    """without load and cab, with its fork"""
    load_arm: Annotated[SignedSpan, _LOAD_ARM] = 0.0
    """of the load, from the line of the ropes, along the travel of bridge or base"""
    own_arm: Annotated[SignedSpan, _OWN_ARM] = 0.0
    """of the carriage's own centre of mass"""
    load_arm_across: Annotated[SignedSpan, _LOAD_ARM] = 0.0
    """of the load, from the line of the ropes across it: with the fork out"""
    own_arm_across: Annotated[SignedSpan, _OWN_ARM] = 0.0
    """of the carriage's own centre of mass"""
    lowest: Annotated[
        Span | None, Absent("the carriage path is the whole mast, which includes the worst position of any path")
    ] = None
    """place of the carriage above the floor, at least; at the lower end of the column when left out"""
    highest: Annotated[
        Span | None, Absent("the carriage path is the whole mast, which includes the worst position of any path")
    ] = None
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
    arm: Annotated[SignedSpan, _CAB_ARM] = 0.0
    """of its centre of mass, from the line of the ropes, along the travel of bridge or base"""
    arm_across: Annotated[SignedSpan, _CAB_ARM] = 0.0
    """of its centre of mass across it"""
