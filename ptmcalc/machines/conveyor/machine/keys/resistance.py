"""Resistance to motion as a designer writes it: ISO 5048 and DIN 22101, or CEMA, and forces by name."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from ptmcalc.spec.fields import (
    FactorFromOne,
    Force,
    Fraction,
    PositiveForce,
    PositiveLength,
    PositivePressure,
    PositiveRatio,
    PositiveSpan,
    SignedSpeed,
)
from ptmcalc.spec.fragment import Conflict, Fragment, Given, at_most_one, exactly_one
from ptmcalc.spec.optional import Absent, Assumed, OneOf

_OF_THE_STREAM = ("skirt", "loading")


class Skirt(Fragment):
    """Skirt plates along the load."""

    width: PositiveLength
    """between the plates"""
    length: PositiveSpan
    """of the plates along the belt"""
    friction: Annotated[PositiveRatio | None, Assumed()] = None
    """between material and plates; 0.6 is assumed when it is left out"""


class Scraper(Fragment):
    """Belt scrapers of one kind."""

    count: Annotated[int, Field(ge=1, le=64, strict=True), Absent("one entry is one scraper")] = 1
    """how many"""
    width: PositiveLength
    """of the blade across the belt"""
    thickness: PositiveLength
    """of the blade along the belt"""
    pressure: PositivePressure
    """of the blade on the belt; 30 to 100 kPa is usual"""
    friction: Annotated[PositiveRatio | None, Assumed()] = None
    """between blade and belt; 0.6 is assumed when it is left out"""


class Loading(Fragment):
    """Acceleration of the material to belt speed."""

    speed: Annotated[SignedSpeed, Absent("material without speed along the belt requires the largest force")] = 0.0
    """speed component of the material along the belt at loading"""


class ExtraForce(Fragment):
    """A special resistance: skirt plates, belt scrapers, a loading point, a tripper."""

    force: Annotated[PositiveForce | None, OneOf("skirt, scraper, loading")] = None
    """force against the motion; or one of `skirt`, `scraper`, `loading`"""
    skirt: Skirt | None = None
    """friction of the load at skirt plates"""
    scraper: Scraper | None = None
    """friction of belt scrapers"""
    loading: Loading | None = None
    """force that accelerates the material to belt speed; already included in the factor C"""
    at: Literal["tail", "carry", "return"] = "tail"
    """position: at the loading point near the tail, or uniformly along a strand"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """A force is given, or follows from one thing; nothing is conveyed on the return strand."""
        yield from exactly_one(given, "force", "skirt", "scraper", "loading")
        if given.word("at") == "return" and (of_stream := [key for key in _OF_THE_STREAM if key in given]):
            reason = f"the return strand carries no material on which `{of_stream[0]}` could act"
            yield Conflict(("at",), reason, "write `at: tail`, or `at: carry`")


_COLD = Assumed(1.0, 1.0, 1.2, "CEMA: K_t is 1 above freezing and 1.2 at -10 deg C")


class Cema(Fragment):
    """The historical CEMA method: L K_t (K_x + K_y w_B + 0.015 w_B) + w_M (L K_y + H) + forces."""

    idler_drag: Annotated[PositiveForce | None, OneOf("roll")] = None
    """A_i, drag of one carrying idler set; or give `roll`"""
    roll: Literal["4in", "5in", "6in", "7in"] | None = None
    """roll diameter, from which A_i follows: 2.3, 1.8, 1.5 or 2.4 lbf"""
    flexure: Annotated[PositiveRatio | None, Assumed()] = None
    """K_y of CEMA's table over length, slope and weights; 0.03 is assumed when it is left out"""
    temperature: Annotated[FactorFromOne, _COLD] = 1.0
    """K_t; 1 above freezing"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The drag is given, or that of a roll."""
        yield from exactly_one(given, "idler_drag", "roll")


class Resistance(Fragment):
    """Resistance to motion: ISO 5048 and DIN 22101, or CEMA where `cema` is given."""

    coefficient: Annotated[PositiveRatio | None, Assumed()] = None
    """fictitious friction coefficient f of the whole conveyor; 0.020 is assumed when it is left out"""
    conditions: Literal["good", "normal", "poor"] | None = None
    """operating conditions, from which f is assumed when `coefficient` is left out; good: light idlers, well aligned"""
    secondary: Annotated[FactorFromOne | None, Assumed()] = None
    """length factor C: all resistances / main resistances; default: table C(L), from 80 m"""
    secondary_force: Annotated[Force | None, OneOf("secondary")] = None
    """secondary resistances as a force at the loading point, instead of `secondary`"""
    cema: Cema | None = None
    """the CEMA method, instead of `coefficient` and `secondary`; pulleys and loading go to `secondary_force`"""
    speed_share: Annotated[Fraction, Absent("the resistance is independent of the speed, as in ISO 5048")] = 0.0
    """speed-proportional part of the idler resistance at rated speed"""
    forces: dict[str, ExtraForce] = Field(default_factory=dict, max_length=50)
    """special resistances by name, in addition to main and secondary ones"""
    start_factor: Annotated[FactorFromOne | None, Assumed()] = None
    """resistance at the start / resistance in motion; 1.2 is assumed when it is left out"""
    stop_factor: Annotated[PositiveRatio | None, Assumed()] = None
    """resistance during a stop relative to the resistance in motion; 1 is assumed, down to 0.6 of it"""
    rest_factor: Annotated[PositiveRatio | None, Assumed()] = None
    """idler resistance at standstill / idler resistance in motion; 0.5 is assumed when left out"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The secondary resistances are given in one way, and one method is used."""
        yield from at_most_one(given, "secondary", "secondary_force")
        yield from at_most_one(given, "coefficient", "conditions")
        for key in ("coefficient", "conditions", "secondary"):
            if "cema" in given and key in given:
                reason = "it is a key of ISO 5048 and DIN 22101; `cema` is another method, and the two are not combined"
                yield Conflict((key,), reason, f"delete `{key}`, or `cema`")
        if "secondary_force" in given or "cema" in given:
            return
        for name, force in given.raw.get("forces", {}).items() if isinstance(given.raw.get("forces"), dict) else ():
            if isinstance(force, dict) and "loading" in force:
                reason = "the length factor C already includes the resistance at the loading point"
                yield Conflict(("forces", name, "loading"), reason, "give `secondary_force` instead of C")
