"""Proofs of the rope, as a designer writes them: number of bendings with its constants, proof by EN 13001-3-2."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from ptmcalc.base import units
from ptmcalc.spec.fields import (
    FactorFromOne,
    Measure,
    PositiveAngle,
    PositiveForce,
    PositiveFraction,
    PositiveRatio,
    PositiveSpan,
    PositiveStress,
    Ratio,
)
from ptmcalc.spec.fragment import Conflict, Fragment, Given, exactly_one
from ptmcalc.spec.optional import Absent, Assumed, Checked, Limit, OneOf, Setting

Count = Annotated[float, Measure(units.FACTOR, above=0)]


class BendingConstants(Fragment):
    """Constants of the number of bendings of a rope (Feyrer, Wire Ropes, eq. 3.55)."""

    b0: Ratio
    """constant of the rope and of the number, N_A10 or another"""
    b1: Ratio
    """exponent of the rope force"""
    b2: Ratio
    """exponent of D/d"""
    b3: Ratio
    """exponent of the rope force, times lg(D/d)"""


class Reversal(Fragment):
    """Bendings in alternating directions relative to simple ones, N_rev = a1 N^a2."""

    a1: PositiveRatio
    """factor"""
    a2: PositiveRatio
    """exponent"""


class WireBreaks(Fragment):
    """Wire breaks that an inspection is to find before the rope breaks."""

    rope: Literal["FC-8x19", "WRC-8x19", "FC-8x36", "WRC-8x36", "18x7", "34x7"]
    """group of ropes"""
    count: Count
    """visible breaks on 30 rope diameters, 8 to 10"""


class RopeLife(Fragment):
    """Number of bendings of the rope until it is discarded or breaks (Feyrer, Wire Ropes, chapter 3.4)."""

    source: Annotated[str, Field(min_length=1, max_length=200)]
    """title, edition and table of the constants"""
    discarding: BendingConstants
    """constants of the discarding number, such as N_A10"""
    breaking: BendingConstants | None = None
    """constants of the breaking number; without them only the discarding number is computed"""
    wire_strength: PositiveStress
    """nominal strength of the wires"""
    core: Literal["FC", "IWRC", "PWRC", "ESWRC", "EFWRC"] | None = None
    """core of the rope, with `strands`: fibre, independent or parallel steel core, steel core covered by plastic or
    fibre"""
    strands: Annotated[Literal[6, 8] | None, Field(examples=["6"])] = None
    """number of outer strands"""
    core_factor: Annotated[PositiveRatio | None, OneOf("core")] = None
    """endurance factor of another rope, instead of `core` and `strands`"""
    bending_length: Annotated[PositiveSpan | None, Setting("the rope travel of the whole lift, the longest")] = None
    """length of rope that runs over a sheave; default: the rope travel of the whole lift, on the safe side"""
    reverse_sheaves: Annotated[
        int, Field(ge=0, le=100, strict=True), Absent("coaxial sheaves bend the rope to one side")
    ] = 0
    """sheaves that bend the rope to the other side than their neighbour, with `reversal`"""
    reversal: Reversal | None = None
    """constants of the number of reverse bendings"""
    force_factor: Annotated[
        float,
        Measure(units.FACTOR, at_least=1),
        Assumed(1.05, 1.0, 1.15, "starts and stops raise the rope force in use by up to 15 %"),
    ] = 1.05
    """rope force in use / steady rope pull"""
    lifts: Annotated[Count | None, Limit()] = None
    """required lifts until the rope is discarded"""
    lifts_per_year: Annotated[Count | None, Checked()] = None
    """working cycles per year; needed for the life in years"""
    years: Annotated[Count | None, Limit()] = None
    """required years until the rope is discarded"""
    wire_breaks: WireBreaks | None = None
    """to check that the rope shows enough wire breaks before it breaks"""
    donandt_force: Annotated[PositiveForce | None, Limit()] = None
    """Donandt force of the rope on its smallest sheave, above which the number of bendings is not valid"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The core is given in one way; reverse bendings have constants of their own."""
        yield from exactly_one(given, "core", "core_factor")
        if "core" in given and "strands" not in given:
            yield given.missing("strands", "the factor of a core depends on the number of strands")
        if "core_factor" in given and "strands" in given and "core" not in given:
            yield Conflict(("strands",), "`core_factor` includes the strands", "delete `strands`")
        if given.raw.get("reverse_sheaves") and "reversal" not in given:
            reason = "reverse bendings require constants of their own: `reversal` is missing"
            yield Conflict((), reason, "add `reversal: {a1: 9.026, a2: 0.618}`, or the constants of your source")


_Factor = Annotated[PositiveRatio | None, Setting("1; the report lists the factors that are not given")]


class FatigueFactors(Fragment):
    """Factors f_f1 to f_f7 of the fatigue strength of a rope (EN 13001-3-2)."""

    bending: _Factor = None
    """f_f1, of D/d relative to its reference"""
    strength: _Factor = None
    """f_f2, of the wire strength; 1 up to 1770 N/mm^2"""
    fleet_angle: _Factor = None
    """f_f3, of the fleet angles"""
    lubrication: _Factor = None
    """f_f4, of the lubrication"""
    layers: _Factor = None
    """f_f5, of a drum with several layers"""
    groove: _Factor = None
    """f_f6, of the groove"""
    rope: _Factor = None
    """f_f7, of the type of rope"""


class RopeProof(Fragment):
    """Proof of competence of the rope by EN 13001-3-2."""

    edition: Literal["EN 13001-3-2:2014"]
    """edition of the standard"""
    combination: Literal["A", "B", "C"] = "A"
    """load combination of EN 13001-2 of the static proof"""
    load_factor: Annotated[FactorFromOne | None, Checked()] = None
    """phi, dynamic factor of the hoist load; default: phi_2 of the hoisting class"""
    fatigue_load_factor: Annotated[FactorFromOne | None, Setting("(1 + phi)/2 of the load factor")] = None
    """phi of the fatigue proof; default: (1 + phi)/2"""
    partial_factor: Annotated[FactorFromOne | None, Setting("that of the combination, to be compared")] = None
    """gamma_p; default: 1.34, 1.22 or 1.10 of the combination"""
    risk_factor: Annotated[FactorFromOne, Absent("no increased risk")] = 1.0
    """gamma_n"""
    static_resistance: Annotated[FactorFromOne | None, Setting("by D/d, to be compared with the edition")] = None
    """gamma_rb; default: by the smallest D/d, at least 2.07"""
    fatigue_resistance: Annotated[FactorFromOne | None, Setting("7 of the edition, to be compared")] = None
    """gamma_rf; default: 7"""
    reference_bendings: Annotated[Count | None, Setting("500 000 of the edition, to be compared")] = None
    """w_D; default: 500 000"""
    termination: Literal["socket", "ferrule", "wedge"] | None = None
    """termination of the rope; it keeps 100, 90 or 80 % of the breaking force"""
    termination_factor: Annotated[PositiveFraction | None, OneOf("termination")] = None
    """strength of the termination relative to the rope, instead of `termination`"""
    fall_angle: Annotated[float, Measure(units.ANGLE, at_least=0, at_most=1.2), Absent("the falls are parallel")] = 0.0
    """largest angle of the falls to the vertical, hook at its highest"""
    acceleration_factor: Annotated[FactorFromOne, Absent("no horizontal acceleration of the hanging load")] = 1.0
    """f_S3, of the horizontal acceleration"""
    cycles: Annotated[Count | None, Checked()] = None
    """working cycles of the crane in its life; default: `duty.cycles`"""
    ropes: Annotated[Annotated[float, Measure(units.FACTOR, at_least=1)] | None, Limit()] = None
    """l_r, number of ropes used in the life of the crane; needed for the fatigue proof"""
    reverse_sheaves: Annotated[
        int, Field(ge=0, le=100, strict=True), Absent("coaxial sheaves bend the rope to one side")
    ] = 0
    """sheaves that bend the rope to the other side than their neighbour"""
    bendings: Annotated[
        Count | None, Setting("counted from the reeving: 2 for a sheave, 4 for a reverse one, 1 for the drum")
    ] = None
    """w, bendings that a lift counts for the worst piece of rope; default: counted from the reeving. State it where the
    edition counts small wrap angles differently"""
    factors: FatigueFactors = FatigueFactors()
    """factors of the fatigue strength"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The termination is given in one way."""
        yield from exactly_one(given, "termination", "termination_factor")


class Fleet(Fragment):
    """Fleet angles at the drum, to check them at the top hook position and at the flanges."""

    edition: Literal["ISO 16625:2013"]
    """edition of the limits"""
    lay: Literal["ordinary", "lang"] = "ordinary"
    """lay of the rope"""
    strict: Literal["yes", "no"] = "no"
    """1.5 deg instead of 2 deg where rope or drum require a small angle"""
    limit: Annotated[PositiveAngle | None, Limit()] = None
    """largest fleet angle; default: by rope and drum"""
    least: Annotated[PositiveAngle | None, Limit()] = None
    """least fleet angle at a flange, several layers; default: 0.5 deg"""
