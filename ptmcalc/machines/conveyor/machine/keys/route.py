"""The route as a designer writes it: sections from the tail to the head, vertical and horizontal curves."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import accumulate, pairwise
from typing import Annotated, Literal

from pydantic import Field

from ptmcalc.base import units
from ptmcalc.base.memory import kept_for
from ptmcalc.numerics import lanes
from ptmcalc.spec.fields import Measure, PositiveLength, PositiveSpan, SignedSpan
from ptmcalc.spec.fragment import Conflict, Fragment, Given, exactly_one
from ptmcalc.spec.optional import Absent, OneOf

Banking = Annotated[float, Measure(units.TILT, at_least=0, at_most=math.radians(15))]


class HorizontalCurve(Fragment):
    """A horizontal curve: its idlers stand on an arc, and their inner side is lifted."""

    radius: PositiveSpan
    """of the arc, at the middle of the belt"""
    banking: Annotated[Banking, Absent("idlers without banking stand level")] = 0.0
    """angle by which the inner side of the carrying idlers is lifted; up to 8 deg is usual"""
    banking_return: Annotated[Banking, Absent("idlers without banking stand level")] = 0.0
    """the same of the return idlers"""


class Section(Fragment):
    """A part of the route with one slope."""

    length: PositiveSpan
    """along the belt"""
    lift: Annotated[SignedSpan, Absent("a section without a lift is level")] = 0.0
    """lifting height of the load; negative when it is lowered"""
    carry_pitch: Annotated[PositiveLength | None, OneOf("idlers.carry.pitch")] = None
    """carrying idler pitch of the section, instead of that of `idlers.carry`"""
    curve_radius: Annotated[
        PositiveSpan | None, Absent("no curve is described: its lift-off and edge tension are not checked")
    ] = None
    """radius of the vertical curve between the section before and this one"""
    horizontal_curve: HorizontalCurve | None = None
    """horizontal curve over the whole section"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The belt cannot rise further than it is long, nor turn by more than a circle."""
        yield from _too_steep(given)
        bend, length = given.block("horizontal_curve"), given.number("length")
        radius = bend.number("radius") if bend else None
        if radius is not None and length is not None and length > 2 * math.pi * radius:
            reason = f"a section of {units.show(length, units.SPAN)} goes round this curve more than once"
            yield Conflict(("horizontal_curve", "radius"), reason, "write `radius: 1200 m`, or correct `length`")

    @property
    def slope(self) -> float:
        """Uphill positive [rad]."""
        return lanes.asin(self.lift / self.length)

    @property
    def cosine(self) -> float:
        """Cosine of the slope [1]."""
        return lanes.sqrt(1 - (self.lift / self.length) ** 2)


@dataclass(frozen=True, slots=True)
class Curve:
    """A vertical curve between two sections: the number of the one it leads into, counted from 1, its radius [m], the
    place of the break it rounds, along the carry strand from the tail [m], the slopes before and after it [rad]."""

    number: int
    radius: float
    place: float
    before: float
    after: float

    @property
    def hollow(self) -> bool:
        """Whether its centre is above the belt (concave)."""
        return self.after > self.before

    @property
    def steepest_cosine(self) -> float:
        """Cosine of the steepest slope in it [1]."""
        return lanes.cos(max(abs(self.before), abs(self.after)))

    @property
    def tangent(self) -> float:
        """How far it reaches to either side of the break [m]."""
        return self.radius * lanes.tan(abs(self.after - self.before) / 2)


@dataclass(frozen=True, slots=True)
class Bend:
    """A section in a horizontal curve: its number, counted from 1, its ends along the carrying strand from the tail
    [m], the cosine of its slope [1]."""

    number: int
    curve: HorizontalCurve
    start: float
    end: float
    cosine: float

    def banking(self, strand: str) -> float:
        """Banking of the idlers of a strand [rad]."""
        return self.curve.banking if strand == "carry" else self.curve.banking_return


class Route(Fragment):
    """The route of the belt from the tail pulley to the head pulley."""

    length: Annotated[PositiveSpan | None, OneOf("sections")] = None
    """distance between tail and head pulley, along the belt; or give `sections`"""
    lift: Annotated[SignedSpan, Absent("a section without a lift is level")] = 0.0
    """lifting height of the load; negative when it is lowered"""
    sections: Annotated[tuple[Section, ...], Field(min_length=1, max_length=200)] | None = None
    """parts of different slope from the tail to the head, instead of `length` and `lift`"""
    inclination: Literal["exact", "small_angle"] = "exact"
    """`small_angle` sets the cosine of the slope to 1, as ISO 5048 allows below 18 degrees"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The route is one slope or several; the belt cannot rise further than it is long."""
        yield from exactly_one(given, "length", "sections")
        if "lift" in given and "sections" in given:
            yield Conflict(("lift",), "the `sections` define the lift of the belt", "delete `lift`")
        yield from _too_steep(given)
        first = next(iter(given.blocks("sections")), None)
        if first is not None and "curve_radius" in first:
            reason = "a curve connects a section with the section before it: the first section has none"
            yield Conflict(("sections", 0, "curve_radius"), reason, "write it under the section after the curve")

    @property
    def parts(self) -> tuple[Section, ...]:
        """The sections from the tail to the head, one where the slope is even."""
        return self.sections if self.sections is not None else _one_slope(self)

    @property
    def span(self) -> float:
        """Distance between tail and head along the belt [m]."""
        return sum(part.length for part in self.parts)

    @property
    def climb(self) -> float:
        """Height from tail to head [m]."""
        return sum(part.lift for part in self.parts)

    @property
    def curves(self) -> tuple[Curve, ...]:
        """The vertical curves whose radius is given, between sections of different slopes."""
        places = accumulate(part.length for part in self.parts)
        return tuple(
            Curve(number, part.curve_radius, place, before.slope, part.slope)
            for number, (place, (before, part)) in enumerate(zip(places, pairwise(self.parts), strict=False), 2)
            if part.curve_radius is not None and part.slope != before.slope
        )

    @property
    def bends(self) -> tuple[Bend, ...]:
        """The horizontal curves."""
        ends = list(accumulate((part.length for part in self.parts), initial=0.0))
        return tuple(
            Bend(number, part.horizontal_curve, ends[number - 1], ends[number], part.cosine)
            for number, part in enumerate(self.sections or (), 1)
            if part.horizontal_curve is not None
        )

    @property
    def hollows(self) -> list[Curve]:
        """The concave curves whose radius is given."""
        return [curve for curve in self.curves if curve.hollow]


@kept_for(64)
def _one_slope(route: Route) -> tuple[Section, ...]:
    assert route.length is not None
    return (Section.model_construct(length=route.length, lift=route.lift),)


def _too_steep(given: Given) -> Iterator[Conflict]:
    lift, length = given.number("lift"), given.number("length")
    if lift is not None and length is not None and abs(lift) >= length:
        yield Conflict(("lift",), "the lift is not smaller than the length along the belt", "check both values")
