"""What a travelling crane runs on and with: wheels, their resistance, rails and guides."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from ptmcalc.base import units
from ptmcalc.spec.fields import Fraction, Inertia, Length, Measure, PositiveForce, PositiveLength, PositiveSpan
from ptmcalc.spec.fragment import Conflict, Fragment, Given, at_most_one
from ptmcalc.spec.optional import Absent, Assumed, Limit, OneOf

Slope = Annotated[float, Measure(units.RATIO, at_least=0, at_most=0.2)]
Corner = Literal["A1", "A2", "B1", "B2"]


class Wheels(Fragment):
    """The wheels at the four corners: A1 and A2 on rail A, front and rear, B1 and B2 on rail B."""

    diameter: PositiveLength
    """at the tread"""
    base: PositiveSpan
    """from the front to the rear corners, along the rail"""
    per_corner: Annotated[int, Field(ge=1, le=16, strict=True), Absent("one wheel has the largest load of all")] = 1
    """wheels of a corner, in equalising bogies"""
    driven: Annotated[tuple[Corner, ...], Field(min_length=1, max_length=4)]
    """corners with driven wheels, e.g. `[A1, B1]`"""
    driven_per_corner: Annotated[
        Annotated[int, Field(ge=1, le=16, strict=True)] | None, Absent("all wheels of a named corner are driven")
    ] = None
    """driven wheels of such a corner; all when left out"""
    frame: Literal["hinged", "rigid"] = "hinged"
    """load distribution on the corners: girders hinged to the end carriages, or a torsionally rigid frame"""
    inertia: Annotated[Inertia | None, Assumed()] = None
    """of one wheel"""
    rating: Annotated[PositiveForce | None, Limit()] = None
    """rated load of one wheel, or of the rail under it; needed to check it"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """No corner twice, no more driven wheels than wheels."""
        driven = given.raw.get("driven")
        if isinstance(driven, list):
            for index, corner in enumerate(driven):
                if corner in driven[:index]:
                    yield Conflict(("driven", index), f"corner `{corner}` is named twice", "name each corner once")
        many = given.raw.get("per_corner", 1)
        some = given.raw.get("driven_per_corner")
        if isinstance(many, int) and isinstance(some, int) and some > many:
            reason = f"a corner has {many} wheel{'s' if many != 1 else ''} only"
            yield Conflict(("driven_per_corner",), reason, f"write `driven_per_corner: {max(many, 1)}` or less")


class Rolling(Fragment):
    """Rolling resistance of the wheels."""

    coefficient: Annotated[Fraction | None, OneOf("lever_arm")] = None
    """total resistance / weight, or give `lever_arm`"""
    lever_arm: Annotated[Length | None, OneOf("coefficient")] = None
    """lever arm of rolling friction; steel on steel 0.3 to 1 mm, depending on the diameter"""
    bearing_friction: Annotated[Fraction | None, Assumed()] = None
    """of the wheel bearings; rolling bearings 0.015, plain bearings 0.08 to 0.1"""
    axle_diameter: Annotated[PositiveLength | None, Assumed()] = None
    """at the middle of the bearings; a quarter of the wheel when left out"""
    flange_factor: Annotated[Annotated[float, Measure(units.RATIO, at_least=1, at_most=10)] | None, Assumed()] = None
    """factor of flange friction, 1.5 to 2.5; 1 with guide rollers"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The resistance is given in one way."""
        yield from at_most_one(given, "coefficient", "lever_arm")
        if "coefficient" not in given and "lever_arm" not in given:
            yield given.missing("lever_arm", "give `lever_arm` or `coefficient`")
        if "coefficient" in given:
            for key in ("bearing_friction", "axle_diameter", "flange_factor"):
                if key in given:
                    yield Conflict((key,), "it is part of the `coefficient`", f"delete `{key}`")


class Rail(Fragment):
    """The runway rail."""

    slope: Annotated[
        Slope, Assumed(0.0, 0.0, 0.001, "tolerance of the runway slope: 0.001 along the length (ISO 12488-1)")
    ] = 0.0
    """slope: rise / length"""
    adhesion: Annotated[Annotated[float, Measure(units.RATIO, above=0, at_most=1)] | None, Assumed()] = None
    """between wheel and rail: 0.2 indoors, 0.12 outdoors, 0.25 with sand; 0.14 is assumed when left out"""
    step: Annotated[Length, Absent("used only in the scene `rail_step`, with a step or gap")] = 0.0
    """height of the maximum step"""
    gap: Annotated[Length, Absent("used only in the scene `rail_step`, with a step or gap")] = 0.0
    """width of the maximum gap"""
    head: Annotated[PositiveLength | None, OneOf("guide.wear")] = None
    """rail head width, for the guide wear; 50 mm is assumed when left out"""
    frequency: Annotated[Annotated[float, Measure(units.FREQUENCY, above=0)] | None, Assumed()] = None
    """vertical natural frequency of the crane on its wheels; 10 Hz is assumed for a `rail_step`"""


class Guide(Fragment):
    """Lateral guides of the crane."""

    type: Literal["flanges", "rollers"] = "flanges"
    """flanges of the wheels, or guide rollers"""
    clearance: Length
    """clearance between guide and rail, both sides together"""
    wear: Annotated[Length | None, Assumed()] = None
    """wear of guide and rail; 0.1 of the rail head width is assumed with flanges, 0.03 with rollers"""
    base: Annotated[
        PositiveSpan | None, Absent("flanges guide at the wheels; guide rollers ahead of them have smaller forces")
    ] = None
    """from the front to the rear guide; default: the wheel base"""
    rail_two: Literal["fixed", "movable"] = "fixed"
    """whether the wheels or legs of the other rail are laterally fixed"""
    adhesion: Annotated[
        Annotated[float, Measure(units.RATIO, above=0, at_most=1)],
        Absent("the maximum friction of the standards, for a clean rail"),
    ] = 0.3
    """of wheels that slip across the rail; usually 0.3, 0.2 on uncleaned rails"""
    tolerance: Annotated[
        Annotated[float, Measure(units.ANGLE, at_least=0)],
        Assumed(0.001, 0.001, 0.002, "EN 13001-2, EN 1991-3: 0.001 rad for wheels and rails of usual tolerances"),
    ] = 0.001
    """skewing angle due to tolerances of wheels and rails"""
    edition: Literal["en_13001_2", "en_1991_3", "full"] = "en_13001_2"
    """standard for the skewing angle due to clearance"""
    rating: Annotated[PositiveForce | None, Limit()] = None
    """permissible force of a guide; needed to check it"""
