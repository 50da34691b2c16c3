"""The chain, its sprockets and its wear, as a designer writes them."""

import math
from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from ptmcalc.base import units
from ptmcalc.base.words import quote
from ptmcalc.catalogue.chains import RollerChain, nearest, roller_chain
from ptmcalc.laws import sprocket
from ptmcalc.numerics.harmonic.parts import HYSTERETIC, KELVIN_VOIGT, ZENER
from ptmcalc.spec.fields import (
    FactorFromOne,
    Fraction,
    Inertia,
    Measure,
    PositiveArea,
    PositiveForce,
    PositiveInertia,
    PositiveLength,
    PositiveLineMass,
    PositivePressure,
    PositiveRatio,
    PositiveStress,
    PositiveTime,
)
from ptmcalc.spec.fragment import Conflict, Fragment, Given, at_most_one, exactly_one, together
from ptmcalc.spec.optional import Absent, Assumed, Limit, OneOf, Setting

PositiveWearRate = Annotated[float, Measure(units.WEAR_RATE, above=0, smallest=1e-24)]
PositiveWearDepth = Annotated[float, Measure(units.WEAR_DEPTH, above=0, smallest=1e-30)]

LEAST_TEETH, MOST_TEETH = 4, 300
"""Numbers of teeth that a file may state; engineering choices. `LEAST_TEETH`: fewer do not turn a chain; the check of
the teeth starts at 6. `MOST_TEETH`: rejects misprints. Wider limits accept wrong entries, narrower ones refuse valid
sprockets."""
_SAME_SIZE = 0.02
"""Difference of a pitch diameter from p/sin(180 deg/z) from which on it is rejected [1]. An engineering choice: a
smaller value rejects rounded diameters, a larger one accepts outer diameters and a wrong number of teeth."""


class Damping(Fragment):
    """Internal damping of the chain."""

    law: Literal["kelvin_voigt", "hysteretic", "zener"] = "kelvin_voigt"
    """`kelvin_voigt`: increases with frequency; `hysteretic`: constant; `zener`: maximum at one frequency"""
    ratio: Annotated[Fraction | None, Assumed()] = None
    """damping ratio of the first natural frequency; 0.05 is assumed when it is left out"""
    time: Annotated[PositiveTime | None, OneOf("ratio")] = None
    """retardation time (kelvin_voigt, instead of `ratio`) or relaxation time (zener)"""
    stiffening: Annotated[PositiveRatio | None, OneOf("a law without this key")] = None
    """zener: relative increase of the stiffness under rapid loading"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Every law has its own numbers."""
        law = given.word("law")
        if law == ZENER:
            for key in ("time", "stiffening"):
                if key not in given:
                    yield given.missing(key, f"`zener` needs its `{key}`")
            if "ratio" in given:
                yield Conflict(("ratio",), "`zener` damps by `time` and `stiffening`", "delete `ratio`")
            return
        if "stiffening" in given:
            yield Conflict(
                ("stiffening",), "only `zener` has a stiffening", "delete `stiffening`, or write `law: zener`"
            )
        if law == KELVIN_VOIGT:
            yield from at_most_one(given, "ratio", "time")
        elif law == HYSTERETIC and "time" in given:
            yield Conflict(("time",), "hysteretic damping has no time", "write `ratio: 0.05`")


class ChainData(Fragment):
    """The chain; parallel chains together are one strand."""

    number: Annotated[str | None, Field(max_length=40, examples=["16B-1"])] = None
    """number of a roller chain of ISO 606, such as 16B-1, 16A-2 or ANSI 80; fills in what the keys below leave out"""
    given_pitch: Annotated[PositiveLength | None, Assumed()] = Field(default=None, alias="pitch")
    """chain pitch"""
    given_mass: Annotated[PositiveLineMass | None, Assumed()] = Field(default=None, alias="mass")
    """of one strand with its plates, flights or slats, without load"""
    count: Annotated[int, Field(ge=1, le=64, strict=True), Absent("one chain, as the file describes one")] = 1
    """parallel chains, or rows of a multiplex roller chain, in a strand"""
    unevenness: Annotated[FactorFromOne | None, Assumed()] = None
    """load of the most loaded parallel chain / mean load; 1.2 is assumed when left out, 1 for one chain"""
    given_breaking_load: Annotated[PositiveForce | None, Assumed()] = Field(default=None, alias="breaking_load")
    """of one chain"""
    stiffness: Annotated[PositiveForce | None, Assumed()] = None
    """tensile stiffness EA of one chain (force over strain), or give `section`"""
    section: Annotated[PositiveArea | None, OneOf("stiffness")] = None
    """minimum plate section of one chain; determines the stiffness with `modulus`, and the stresses"""
    modulus: Annotated[PositiveStress | None, Assumed()] = None
    """effective modulus of the built-up chain on `section`; 0.65 times that of steel is assumed when left out"""
    damping: Damping = Damping()
    """internal damping"""
    pin_diameter: Annotated[PositiveLength | None, Assumed()] = None
    """pin diameter; needed for pressure and wear"""
    bush_length: Annotated[PositiveLength | None, Assumed()] = None
    """bearing length of pin and bush, of all rows of a multiplex chain; needed for pressure"""
    strength: Annotated[PositiveStress | None, Limit()] = None
    """tensile strength of the plates; accounts for the mean stress in the fatigue check"""
    fatigue_limit: Annotated[PositiveStress | None, Limit()] = None
    """permissible stress amplitude of the plates for the required life; needed to check fatigue"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The chain has a number or its own sizes; the stiffness is given, or follows from the section."""
        if "number" in given:
            yield from _unknown_number(given)
        else:
            for key in ("pitch", "mass", "breaking_load"):
                if key not in given:
                    yield given.missing(key, f"`{key}` is missing, and no `number` of a standard chain states it")
            if "stiffness" not in given:
                yield from exactly_one(given, "stiffness", "section")
        yield from at_most_one(given, "stiffness", "modulus")
        yield from together(given, "modulus", "section", "the modulus needs the section")

    @property
    def pitch(self) -> float:
        """Chain pitch [m]."""
        return _filled(self.given_pitch)

    @property
    def mass(self) -> float:
        """Of one strand, without load [kg/m]."""
        return _filled(self.given_mass)

    @property
    def breaking_load(self) -> float:
        """Of one chain [N]."""
        return _filled(self.given_breaking_load)

    @property
    def standard(self) -> RollerChain | None:
        """The chain of the number; None without one."""
        return roller_chain(self.number) if self.number is not None else None

    @property
    def rows(self) -> int:
        """Rows of all parallel chains of a strand [1]."""
        return self.count * (self.standard.rows if self.standard is not None else 1)


def _filled(value: float | None) -> float:
    """A value that the file, or the number of the chain, has given by now."""
    assert value is not None, "the number of the chain is looked up before anything is computed"
    return value


def _unknown_number(given: Given) -> Iterator[Conflict]:
    """A number that the table of roller chains does not have."""
    named = given.raw.get("number")
    if not isinstance(named, str) or roller_chain(named) is not None:
        return
    offered = nearest(named)
    reason = f"no roller chain of ISO 606 has the number {quote(named)}; nearest: {', '.join(offered)}"
    yield Conflict(("number",), reason, f"write `number: {offered[0]}`, or delete it and give the sizes of the chain")


def pitch_of(chain: Given | None) -> float | None:
    """Pitch of a chain as the file describes it, by its own key or by its number."""
    if chain is None:
        return None
    own, named = chain.number("pitch"), chain.raw.get("number")
    found = roller_chain(named) if isinstance(named, str) else None
    return found.pitch if own is None and "pitch" not in chain and found is not None else own


class Sprocket(Fragment):
    """A sprocket."""

    teeth: Annotated[int, Field(strict=True, examples=[8])]
    """number of teeth"""
    diameter: Annotated[PositiveLength | None, OneOf("teeth and pitch")] = None
    """pitch diameter, through the pins; default: p/sin(pi/z), compared with it when given"""
    inertia: Annotated[Inertia | None, Assumed()] = None
    """on its own shaft, shaft included; 0 when left out"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """A sprocket has enough teeth to be turned round by."""
        yield from wrong_teeth(given)


def wrong_teeth(given: Given) -> Iterator[Conflict]:
    """Too few teeth to carry a chain round a shaft, or more than anybody cuts."""
    teeth = given.raw.get("teeth")
    number = int(teeth) if isinstance(teeth, str) and teeth.lstrip("-").isdigit() else teeth
    if isinstance(number, bool) or not isinstance(number, int):
        return
    if number < LEAST_TEETH:
        reason = (
            f"a sprocket cannot have {number} teeth: the chain would turn by {360 / max(number, 1):.0f} deg per tooth"
        )
        yield Conflict(("teeth",), reason, "write `teeth: 8`; traction chains run on 6 and more, roller chains on 17")
    elif number > MOST_TEETH:
        yield Conflict(("teeth",), f"no sprocket has {number} teeth", f"write at most `teeth: {MOST_TEETH}`")


def teeth_of(given: Given) -> int | None:
    """The teeth of a sprocket, where it has as many as a sprocket can have."""
    teeth = given.raw.get("teeth")
    sound = isinstance(teeth, int) and not isinstance(teeth, bool) and LEAST_TEETH <= teeth <= MOST_TEETH
    return teeth if sound else None


def wrong_size(given: Given, pitch: float | None, path: tuple[str, ...]) -> Iterator[Conflict]:
    """A pitch diameter that the chain does not fit."""
    diameter, teeth = given.number("diameter"), teeth_of(given)
    if diameter is None or pitch is None:
        return
    where = (*path, "diameter")
    if diameter <= pitch:
        size, step = units.show(diameter, units.LENGTH), units.show(pitch, units.LENGTH)
        reason = f"a pitch of {step} is not smaller than the sprocket diameter, {size}"
        yield Conflict(where, reason, "correct the pitch or the diameter")
    elif teeth is not None:
        fits = 2 * sprocket.pitch_radius(pitch, teeth)
        if abs(diameter / fits - 1) > _SAME_SIZE:
            right = units.show(fits, units.LENGTH)
            reason = f"{teeth} teeth of this pitch have a pitch diameter of {right}, p/sin(180 deg/z)"
            yield Conflict(where, reason, f"write `diameter: {right}`, or delete it; or correct the teeth")


class TailSprocket(Fragment):
    """The sprocket at the other end of a conveyor."""

    teeth: Annotated[Annotated[int, Field(strict=True)] | None, Setting("as many as the drive sprocket")] = None
    """number of teeth; default: those of the drive sprocket"""
    diameter: Annotated[PositiveLength | None, OneOf("teeth and pitch")] = None
    """pitch diameter, through the pins; default: p/sin(pi/z), compared with it when given"""
    inertia: Annotated[Inertia | None, Assumed()] = None
    """on its own shaft, shaft included; 0 when left out"""
    driven: Literal["on", "off"] = "off"
    """`on`: a second drive turns it; `drive` and `brake` are those of both together"""
    share: Annotated[Fraction | None, Assumed()] = None
    """share of the effective chain pull that a driven one takes in steady motion; assumed when left out: 0.5, from 0 to
    1, or by the slip lines of equal motors"""
    synchronised: Literal["on", "off"] = "off"
    """`on`: a shaft or a control keeps both sprockets at one speed under any torque, in stops too; needed for the
    tensions of starts by torque or on a motor curve, and of stops"""
    phase: Annotated[Fraction | None, Setting("the worst phase when left out")] = None
    """phase of the link joints of a driven one, relative to the drive; the worst phase when left out"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """A sprocket has enough teeth; only a driven one has a phase, takes a share, and keeps a speed."""
        yield from wrong_teeth(given)
        if given.word("driven") == "on":
            return
        if "phase" in given:
            yield Conflict(("phase",), "only a driven tail has a phase of its own", "delete `phase`, or `driven: on`")
        if "share" in given:
            yield Conflict(("share",), "only a driven tail takes a share", "delete `share`, or write `driven: on`")
        if given.word("synchronised") == "on":
            hint = "delete `synchronised`, or write `driven: on`"
            yield Conflict(("synchronised",), "only a driven tail is synchronised", hint)


class DrivenSprocket(Sprocket):
    """The driven sprocket with the machine behind it."""

    inertia: PositiveInertia
    """of sprocket and driven machine, on this shaft"""
    phase: Annotated[Fraction | None, Setting("the worst phase when left out")] = None
    """phase of its link joints relative to the driver; the worst phase when left out"""


class Archard(Fragment):
    """Wear by pressure and sliding path."""

    coefficient: PositiveWearDepth
    """wear depth per pressure and sliding path, at the reference pressure"""
    reference_pressure: PositivePressure
    """of the test it comes from"""
    exponent: Annotated[float, Measure(units.RATIO, at_least=1, at_most=4), Setting("the linear law of Archard")] = 1.0
    """of the pressure: 1 (Archard), 1.5 with poor and 3 with good lubrication (Reshetov)"""


class Wear(Fragment):
    """Wear of the link joints."""

    coefficient: Annotated[PositiveWearRate | None, OneOf("archard")] = None
    """textbook coefficient: wear per force, time and path, from tests at the speed of the machine; or give `archard`"""
    archard: Archard | None = None
    """another model, by pressure and sliding path"""
    tensions: Literal["sum", "mean"] = "sum"
    """textbook: `sum` or `mean` of entering and leaving tension of a sprocket (mean: twice the
    life)"""
    elongation: Annotated[PositiveRatio | None, Assumed()] = None
    """permissible wear elongation of the chain; 4 % is assumed when left out, 3 to 6 % is usual"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """One model at a time."""
        yield from exactly_one(given, "coefficient", "archard")
        if "archard" in given and "tensions" in given:
            yield Conflict(("tensions",), "`archard` takes both tensions", "delete `tensions`")


def even(pitches: float) -> int:
    """The next even number [1]."""
    return 2 * math.ceil(pitches / 2)
