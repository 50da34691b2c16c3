"""Bodies whose inertia is computed from their dimensions."""

from collections.abc import Iterator
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from ptmcalc.base import units
from ptmcalc.laws import bodies
from ptmcalc.spec.fields import Length, Measure, PositiveDensity, PositiveFraction, PositiveLength, PositiveMass
from ptmcalc.spec.fragment import Conflict, Fragment, Given
from ptmcalc.spec.optional import Absent, Assumed, OneOf

STEEL = 7850.0
"""Density of steel [kg/m^3], a handbook value and the default of a body. Inertia and mass are proportional to it; the
assumed interval is 7000 to 7900."""


class Solid(Fragment):
    """A solid cylinder about its axis."""

    type: Literal["solid"]
    mass: PositiveMass
    """mass of the whole body"""
    diameter: PositiveLength
    """outer diameter"""

    @property
    def inertia(self) -> float:
        return bodies.solid_cylinder(self.mass, self.diameter)


class Hollow(Fragment):
    """A hollow cylinder about its axis."""

    type: Literal["hollow"]
    mass: PositiveMass
    """mass of the whole body"""
    outer_diameter: PositiveLength
    """outer diameter"""
    inner_diameter: PositiveLength
    """diameter of the hole"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The hole is smaller than the cylinder."""
        outer, inner = given.number("outer_diameter"), given.number("inner_diameter")
        if outer is not None and inner is not None and inner >= outer:
            yield Conflict(("inner_diameter",), "it is not below the outer diameter", "check both diameters")

    @property
    def inertia(self) -> float:
        return bodies.hollow_cylinder(self.mass, self.outer_diameter, self.inner_diameter)


class Ring(Fragment):
    """A thin ring about its axis."""

    type: Literal["ring"]
    mass: PositiveMass
    """mass of the whole body"""
    mean_diameter: PositiveLength
    """of the middle of the ring"""

    @property
    def inertia(self) -> float:
        return bodies.thin_ring(self.mass, self.mean_diameter)


class Drum(Fragment):
    """A drum: shell, two end discs and a shaft through them."""

    type: Literal["drum"]
    outer_diameter: PositiveLength
    """outer diameter"""
    inner_diameter: PositiveLength
    """diameter of the hole"""
    length: PositiveLength
    """along its axis"""
    disc_thickness: Length
    """of each end disc"""
    shaft_diameter: Length
    """of the shaft through both discs"""
    density: Annotated[PositiveDensity, Assumed(STEEL, 7000.0, 7900.0, "cast iron to steel")] = STEEL
    """7850 kg/m^3 when left out"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Shell and shaft fit into each other."""
        outer, inner, shaft = (given.number(f"{part}_diameter") for part in ("outer", "inner", "shaft"))
        if outer is not None and inner is not None and inner >= outer:
            yield Conflict(("inner_diameter",), "it is not below the outer diameter", "check both diameters")
        if inner is not None and shaft is not None and shaft >= inner:
            yield Conflict(("shaft_diameter",), "the shaft does not fit into the drum", "check both diameters")
        length, disc = given.number("length"), given.number("disc_thickness")
        if length is not None and disc is not None and 2 * disc > length:
            yield Conflict(("disc_thickness",), "the two discs do not fit into the drum", "check it and `length`")

    @property
    def inertia(self) -> float:
        _, inertia = bodies.drum(
            self.density,
            self.outer_diameter,
            self.inner_diameter,
            self.length,
            self.disc_thickness,
            self.shaft_diameter,
        )
        return inertia


class RingPart(Fragment):
    """One ring of a sheave: rim, web or hub."""

    outer_radius: PositiveLength
    """of this ring"""
    inner_radius: Length
    """of its hole"""
    width: PositiveLength
    """along the axis"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The hole is smaller than the ring."""
        outer, inner = given.number("outer_radius"), given.number("inner_radius")
        if outer is not None and inner is not None and inner >= outer:
            yield Conflict(("inner_radius",), "it is not below the outer radius", "check both radii")


class Sheave(Fragment):
    """A sheave, pulley or gear wheel made of rings."""

    type: Literal["sheave"]
    rings: Annotated[tuple[RingPart, ...], Field(min_length=1, max_length=20)]
    """rim, web and hub"""
    density: Annotated[PositiveDensity, Assumed(STEEL, 7000.0, 7900.0, "cast iron to steel")] = STEEL
    """7850 kg/m^3 when left out"""

    @property
    def inertia(self) -> float:
        parts = [(ring.outer_radius, ring.inner_radius, ring.width) for ring in self.rings]
        outer, inner, widths = np.array(parts).T
        return bodies.rings(self.density, outer, inner, widths)[1]


class Coupling(Fragment):
    """A coupling, estimated from mass and outer diameter."""

    type: Literal["coupling"]
    mass: PositiveMass
    """mass of the whole body"""
    diameter: PositiveLength
    """outer diameter"""
    shape: Annotated[
        PositiveFraction,
        Assumed(0.5, 0.4, 0.6, "share of the moment of inertia of a cylinder of the same size: 0.40 to 0.60 of m R^2"),
    ] = 0.5
    """k in k m R^2: 0.4 to 0.6, a ring is 1"""

    @property
    def inertia(self) -> float:
        return bodies.estimated_body(self.mass, self.diameter / 2, self.shape)


class Rod(Fragment):
    """A straight rod about an axis."""

    type: Literal["rod"]
    mass: PositiveMass
    """mass of the whole body"""
    length: PositiveLength
    """along its axis"""
    position: Literal["end", "centre", "radial", "parallel", "inclined"]
    """axis across through its end or centre; radial with its near end at `distance`; parallel to it at `distance`;
    inclined at `angle` to the axis with its end on it"""
    distance: Annotated[Length, Absent("the rod ends at the axis")] = 0.0
    """of the near end, or of the rod, from the axis"""
    radius: Annotated[Length, Absent("a thin rod")] = 0.0
    """of the rod itself (`parallel`)"""
    angle: Annotated[Annotated[float, Measure(units.ANGLE)] | None, OneOf("position")] = None
    """angle of an inclined rod to the axis"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """An inclined rod has an angle, and each position only the dimensions that place it."""
        position = given.word("position")
        if position == "inclined" and "angle" not in given:
            yield given.missing("angle", "an inclined rod needs its `angle` to the axis")
        if "angle" in given and position not in ("inclined", None):
            yield Conflict(("angle",), "only an inclined rod has an angle", "delete it, or write `position: inclined`")
        if "distance" in given and position not in ("radial", "parallel", None):
            yield Conflict(("distance",), "it places a rod that is `radial` or `parallel`", "delete it")
        if "radius" in given and position not in ("parallel", None):
            yield Conflict(("radius",), "only that of a `parallel` rod counts", "delete it")

    @property
    def inertia(self) -> float:
        if self.position == "end":
            return bodies.rod_about_end(self.mass, self.length)
        if self.position == "centre":
            return bodies.rod_about_centre(self.mass, self.length)
        if self.position == "radial":
            return bodies.rod_radial(self.mass, self.length, self.distance)
        if self.position == "parallel":
            return bodies.rod_parallel(self.mass, self.distance, self.radius)
        assert self.angle is not None
        return bodies.rod_inclined(self.mass, self.length, self.angle)


AnyBody = Annotated[
    Solid | Hollow | Ring | Drum | Sheave | Coupling | Rod,
    Field(discriminator="type"),
]
