"""Belt, idlers and load as a designer writes them."""

import math
from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from ptmcalc.base import units
from ptmcalc.machines.conveyor.machine.keys.damping import Damping
from ptmcalc.machines.conveyor.machine.keys.loading import MOST_POINTS, LoadingPoint, contradictory_points
from ptmcalc.spec.fields import (
    FactorFromOne,
    Length,
    LineMass,
    Mass,
    MassFlow,
    Measure,
    PositiveAngularSpeed,
    PositiveDensity,
    PositiveForce,
    PositiveFraction,
    PositiveLength,
    PositiveLineForce,
    PositiveLineMass,
    PositiveLineStiffness,
    PositiveSpan,
)
from ptmcalc.spec.fragment import Conflict, Fragment, Given, at_most_one, exactly_one, names_of_parts, together
from ptmcalc.spec.optional import Absent, Assumed, Checked, Limit, OneOf
from ptmcalc.spec.shape import Also

TroughAngle = Annotated[float, Measure(units.SLOPE, at_least=0, at_most=math.radians(75))]
SurchargeAngle = Annotated[float, Measure(units.SLOPE, at_least=0, at_most=math.radians(45))]


class Splice(Fragment):
    """The splices of the belt, by DIN 22101:2011."""

    reference_strength: Annotated[PositiveFraction | None, Assumed()] = None
    """k_t,rel, reference fatigue strength of the splice / rated strength of the belt (DIN 22110-3); assumed when left
    out: 0.45 for steel cord, 0.325 for textile"""
    conditions: Literal["normal", "good", "poor"]
    """splicing conditions: S_0 of 1.1, 1.0 or 1.2"""
    life: Literal["normal", "short", "long"]
    """expected life and consequences of a failure: S_1 of 1.7, 1.5 or 1.9"""


class Belt(Fragment):
    """The belt itself."""

    mass: PositiveLineMass
    """mass per length of the bare belt"""
    width: Annotated[PositiveLength | None, OneOf("stiffness, breaking_force")] = None
    """belt width; needed with `modulus` or `strength`"""
    stiffness: Annotated[PositiveForce | None, OneOf("modulus")] = None
    """tensile stiffness EA of the whole belt, or give `modulus` and `width`"""
    modulus: Annotated[PositiveLineStiffness | None, OneOf("stiffness")] = None
    """tensile modulus per width, e.g. `72000 N/mm`"""
    breaking_force: Annotated[PositiveForce | None, Checked()] = None
    """breaking force of the whole belt, or give `strength` and `width`"""
    strength: Annotated[PositiveLineForce | None, Checked()] = None
    """rated strength per width, e.g. `1600 N/mm` for an ST 1600"""
    carcass: Literal["textile", "steel_cord"] | None = None
    """carcass type; determines the default safety factors"""
    splice: Splice | None = None
    """splices; with them the strength is also verified by DIN 22101:2011"""
    damping: Damping | None = None
    """internal damping; an undamped belt when left out, with the longest oscillation"""
    minimum_drum_diameter: Annotated[PositiveLength | None, Limit(), Also("minimum_pulley_diameter")] = None
    """minimum drive pulley diameter of the belt manufacturer; or give `carcass_thickness` and `warp`"""
    carcass_thickness: Annotated[PositiveLength | None, Limit()] = None
    """of the plies without the covers, or of the cords of a steel-cord belt"""
    warp: Literal["cotton", "polyamide", "polyester", "aramid", "steel_cord"] | None = None
    """material that carries the tension; with `carcass_thickness` it determines the minimum pulley diameter"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Stiffness and strength are of the whole belt, or per width with the width."""
        yield from exactly_one(given, "stiffness", "modulus")
        yield from at_most_one(given, "breaking_force", "strength")
        per_width = " and ".join(f"`{key}`" for key in ("modulus", "strength") if key in given)
        if per_width and "width" not in given:
            yield given.missing("width", f"{per_width} per width: `width` is missing")
        yield from at_most_one(given, "minimum_drum_diameter", "carcass_thickness")
        yield from together(
            given, "carcass_thickness", "warp", "the minimum pulley diameter also depends on the material"
        )
        carcass, warp = given.word("carcass"), given.word("warp")
        if carcass is not None and warp is not None and (carcass == "steel_cord") != (warp == "steel_cord"):
            reason = f"a `{carcass}` carcass has no warp of `{warp}`"
            yield Conflict(("warp",), reason, "delete `warp`, or correct `carcass`")


class IdlerRoll(Fragment):
    """A roll of an idler set."""

    diameter: PositiveLength
    """outer diameter of the roll"""
    rated_speed: Annotated[PositiveAngularSpeed | None, Limit()] = None
    """maximum rotational speed by the manufacturer; 600 to 750 rpm is usual"""
    dynamic_load_rating: Annotated[PositiveForce | None, Checked()] = None
    """C of one of its two bearings; needed to check the bearing life"""
    load_share: Annotated[PositiveFraction | None, Assumed()] = None
    """share of the set load on the most loaded roll; assumed 0.675 of three rolls, 0.5 of two; 1 of a single one"""
    dynamic_factor: Annotated[FactorFromOne | None, Assumed()] = None
    """dynamic factor of belt and load that pass the idler; 1.2 is assumed when left out"""


class Trough(Fragment):
    """The trough of a strand, on three rolls or on two."""

    angle: TroughAngle
    """troughing angle of the wing rolls"""
    middle_roll: Length
    """length of the centre roll; 0 mm for two rolls"""


class IdlerRow(Fragment):
    """The idlers of one strand."""

    pitch: Annotated[
        PositiveLength | None, Absent("sag is `not checked`, and the wave speed is that of a taut belt without sag")
    ] = None
    """idler spacing; needed for sag and with `set_mass`"""
    set_mass: Annotated[Mass | None, OneOf("line_mass")] = None
    """rotating mass of one idler set, reduced to the roll surface"""
    line_mass: Annotated[LineMass | None, OneOf("set_mass")] = None
    """rotating mass per length, or give `set_mass` and `pitch`"""
    roll: IdlerRoll | None = None
    """its rolls; for roll speed, roll load and bearing life"""
    trough: Trough | None = None
    """shape of the idlers in a V or a trough; needed for horizontal curves, where flat idlers do not guide the belt"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The mass is per length, or per set with the pitch."""
        yield from exactly_one(given, "set_mass", "line_mass")
        yield from together(given, "set_mass", "pitch", "`set_mass` is per idler set")

    @property
    def rotating_line_mass(self) -> float:
        """Rotating mass per length [kg/m]."""
        return self.mass_at(self.pitch)

    def mass_at(self, pitch: float | None) -> float:
        """Rotating mass per length where the sets stand so far apart [kg/m]."""
        if self.line_mass is not None:
            return self.line_mass
        assert self.set_mass is not None
        assert pitch is not None
        return self.set_mass / pitch


class CarryRow(IdlerRow):
    """The idlers of the carrying strand."""

    trough: Trough | None = None
    """trough shape; needed for the load cross-section, transitions, horizontal curves and edge tension in curves"""


class Idlers(Fragment):
    """Idlers of both strands."""

    carry: CarryRow
    """under the carrying strand"""
    back: IdlerRow = Field(alias="return")
    """under the return strand"""


class Load(Fragment):
    """The conveyed material."""

    mass: Annotated[PositiveLineMass | None, OneOf("capacity")] = None
    """load per length of the carrying strand, or give `capacity`"""
    capacity: Annotated[MassFlow | None, OneOf("mass")] = None
    """mass flow; the load per length is capacity over belt speed"""
    loading_points: Annotated[dict[str, LoadingPoint], Field(min_length=1, max_length=MOST_POINTS)] | None = None
    """several loading points by name, instead of `capacity`"""
    density: Annotated[
        PositiveDensity | None, Absent("the check of the cross-section requires it and is not applied")
    ] = None
    """bulk density; with it the cross-section of the load is checked"""
    surcharge_angle: Annotated[SurchargeAngle | None, Assumed()] = None
    """slope of the moving material at the edges of its bed; 15 deg is assumed when it is left out"""
    section_edition: Literal["iso_5048", "din_22101", "cema"] = "iso_5048"
    """cross-section: parabola (`iso_5048`), equivalent slope (`din_22101`), arc and standard edge distance (`cema`)"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The load is given in one way."""
        if "loading_points" in given:
            yield from names_of_parts(given, "loading_points")
            yield from contradictory_points(given)
        else:
            yield from exactly_one(given, "mass", "capacity")
        if "surcharge_angle" in given and "density" not in given:
            reason = "the capacity of the cross-section is checked: `density` is missing"
            yield Conflict((), reason, "add `density: 1600 kg/m^3`")


class Transition(Fragment):
    """The distance between a pulley and the first full trough."""

    length: PositiveSpan
    """from the pulley axis to the first full trough"""
    pulley_lift: Annotated[
        Length, Absent("the edge strain is largest for a pulley at the height of the centre roll")
    ] = 0.0
    """height of the pulley surface above the centre roll; a third of the trough depth is usual"""


class Transitions(Fragment):
    """Transitions of the carrying strand from trough to flat belt."""

    head: Transition | None = None
    """before the head pulley"""
    tail: Transition | None = None
    """after the tail pulley"""
