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
    girder_vertical: Annotated[SecondMoment | None, OneOf("the `stiffness` of the mast")] = None
    """second moment of area of ONE girder, for bending in the vertical plane"""
    girder_horizontal: Annotated[SecondMoment | None, OneOf("the `stiffness` of the mast")] = None
    """second moment of area of ONE girder, for bending in the horizontal plane"""
    ends: Literal["supported", "clamped"] = "supported"
    """girder ends at the end carriages: simply supported or clamped"""
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
    """The trolley of the suspended mast."""

    mass: PositiveMass
    """with hoist and slewing gear, without mast, carriage and cab"""
    gauge: PositiveLength
    """from girder to girder"""
    position: Annotated[Span | None, Absent("in the middle, deflection and stress of the girders are largest")] = None
    """mast position from the nearer end of the bridge; default: middle"""
    wheels: Literal["free", "braked"] = "free"
    """whether the wheels roll freely on the bending girders; a braked trolley is slightly stiffer"""


class Base(Fragment):
    """The base (bottom frame) of a rack stacker."""

    mass: PositiveMass
    """with its drive and equipment, without the mast"""
    wheel_base: PositiveSpan
    """from the front to the rear wheel"""
    wheel_diameter: PositiveLength
    """at the tread"""
    column: Annotated[Span | None, Assumed()] = None
    """mast position from the rear wheel; default: middle"""
    centre: Annotated[Span | None, Assumed()] = None
    """of its centre of mass from the rear wheel; in the middle when left out"""
    height: Annotated[Span, _BASE_HEIGHT] = 0.0
    """of its centre of mass above the rail"""
    gauge: Annotated[
        PositiveLength | None, Absent("a single rail gives no lateral stability; only the top guide does")
    ] = None
    """between its two rails, of a machine without a top guide across the aisle; one rail when left out"""


class TopGuide(Fragment):
    """The top guide of a rack stacker mast, along the aisle or across it."""

    stiffness: Annotated[PositiveStiffness | None, Absent("a free head has a larger deflection than a guided head")] = (
        None
    )
    """stiffness of the top guide along the aisle; a free head when left out"""
    gap: Annotated[Length, _GUIDE_PLAY] = 0.0
    """clearance to each side"""
    rating: Annotated[PositiveForce | None, Limit()] = None
    """permissible force of the guide across the aisle; needed for the stability check"""


class Column(Fragment):
    """The mast, suspended from the trolley or mounted on the base. Section values refer to ONE mast."""

    length: PositiveSpan
    """from its support to its tip; of an overhead stacker from the neutral axis of the girders"""
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
    """at the tip, along every travel, of mast and support; instead of the sections of mast and girders"""
    root_stiffness: Annotated[
        RootStiffness | None,
        Absent("the mast is welded or bolted to a stiff frame; a rotating joint is a separate part"),
    ] = None
    """rotational stiffness of the mast support; rigid when left out"""
    log_decrement: Annotated[
        Decrement | None,
        Absent("without damping, the mast oscillation is largest and the settling time is not checked"),
    ] = None
    """of its free oscillation, from a measurement; needed for the settling time"""
    top_guide: TopGuide | None = None
    """at the head of a rack stacker"""
    section_modulus: Annotated[
        SectionModulus | None, Absent("without it the check of the mast stress is reported as not made")
    ] = None
    """for bending along the travel of bridge or base; needed for the mast stress"""
    section_modulus_across: Annotated[SectionModulus | None, Assumed()] = None
    """for bending across it; as along when left out"""
    area: Annotated[Annotated[float, Measure(units.AREA, above=0)] | None, Assumed()] = None
    """section area of one mast; without it the axial stress is neglected"""

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
    """of its bearing; rolling bearings 0.015, plain bearings 0.08 to 0.1"""
    lever_arm: Annotated[Length, _LEVER_ARM] = 0.0005
    """lever arm of rolling friction; 0.3 to 0.6 mm on steel"""
    per_set: Annotated[
        Annotated[int, Field(ge=1, le=8, strict=True)], Absent("a single roller carries the whole reaction of its set")
    ] = 1
    """rollers that share the reaction of a set"""
    planes: Literal["separate", "joint"] | None = None
    """separate rollers per plane, or one set for both planes; an interval of both when left out"""
    rating: Annotated[PositiveForce | None, Limit()] = None
    """rated load of one roller; needed to check it"""


class Carriage(Fragment):
    """The hoist carriage with the load on the mast."""

    mass: PositiveMass
    """without load and cab, with its fork"""
    load_arm: Annotated[SignedSpan, _LOAD_ARM] = 0.0
    """of the load, from the line of the ropes, along the travel of bridge or base"""
    own_arm: Annotated[SignedSpan, _OWN_ARM] = 0.0
    """of the carriage's own centre of mass"""
    load_arm_across: Annotated[SignedSpan, _LOAD_ARM] = 0.0
    """of the load across it, with the fork extended, from the line of the ropes"""
    own_arm_across: Annotated[SignedSpan, _OWN_ARM] = 0.0
    """of the carriage's own centre of mass"""
    lowest: Annotated[
        Span | None, Absent("the carriage path is the whole mast, which includes the worst position of any path")
    ] = None
    """lowest carriage height above the floor; default: lower end of the mast"""
    highest: Annotated[
        Span | None, Absent("the carriage path is the whole mast, which includes the worst position of any path")
    ] = None
    """highest carriage height above the floor; default: upper end of the mast"""
    rollers: Rollers
    """its guide rollers"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """It goes up, not down."""
        low, high = given.number("lowest"), given.number("highest")
        if low is not None and high is not None and high <= low:
            yield Conflict(("highest",), "it is not above `lowest`", "swap them")


class Cab(Fragment):
    """A cab that moves with the carriage."""

    mass: Mass
    """with the driver"""
    arm: Annotated[SignedSpan, _CAB_ARM] = 0.0
    """of its centre of mass, from the line of the ropes, along the travel of bridge or base"""
    arm_across: Annotated[SignedSpan, _CAB_ARM] = 0.0
    """of its centre of mass across it"""
