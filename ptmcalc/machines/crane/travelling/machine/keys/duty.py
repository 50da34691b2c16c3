"""Duty of a travelling crane, its classes and declared dynamic factors."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from ptmcalc.base import units
from ptmcalc.spec.fields import Fraction, HourlyRate, Measure, PositiveShare, RunningTime, Share
from ptmcalc.spec.fragment import Conflict, Fragment, Given
from ptmcalc.spec.optional import Absent, Assumed, Limit

Phi = Annotated[float, Measure(units.RATIO, above=0, at_most=10)]


class SpectrumPoint(Fragment):
    """A part of the load spectrum."""

    share: PositiveShare
    """of all cycles"""
    load: Share
    """relative to the rated load"""


class Duty(Fragment):
    """Duty of the mechanism."""

    type: Literal["S1", "S3", "S4", "S5"] = "S3"
    """duty type of IEC 60034-1; S4 and S5 count the starts"""
    factor: Annotated[PositiveShare | None, Assumed()] = None
    """cyclic duration factor of the motor; 40 % is assumed when it is left out"""
    starts_per_hour: Annotated[HourlyRate | None, Absent("S1 and S3 have no starts; S4 and S5 require them")] = None
    """of the motor"""
    load_spectrum: Annotated[tuple[SpectrumPoint, ...], Field(min_length=1, max_length=20)] | None = None
    """load spectrum of the service life; default: always the rated load"""
    cycles: Annotated[
        Annotated[float, Measure(units.FACTOR, above=0)] | None, Absent("the group is checked only if it is given")
    ] = None
    """working cycles in the service life; with the spectrum they determine the crane group"""
    hours: Annotated[RunningTime | None, Absent("the group is computed only if it is given")] = None
    """operating time in the service life; with the spectrum it determines the mechanism group"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The shares of a spectrum are a whole; what counts starts has some."""
        points = given.blocks("load_spectrum")
        shares = [point.number("share") if point else None for point in points]
        known = [share for share in shares if share is not None]
        if known and len(known) == len(shares) and abs(sum(known) - 1) > 1e-6:
            reason = f"the shares add up to {sum(known):.3g}"
            yield Conflict(("load_spectrum",), reason, "correct them to a sum of 1, so that every cycle has a load")
        kind = given.word("type")
        if kind in ("S4", "S5") and "starts_per_hour" not in given:
            yield given.missing("starts_per_hour", f"the starts heat the motor in {kind}")
        if kind == "S1" and "factor" in given:
            yield Conflict(("factor",), "S1 has no rest", "delete `factor`, or write `type: S3`")


class Classes(Fragment):
    """Classification of the crane, and edition of its dynamic factors."""

    hoisting: Literal["HC1", "HC2", "HC3", "HC4"] | None = None
    """stiffness class of the hoist, for phi2"""
    drive: Literal["HD1", "HD2", "HD3", "HD4", "HD5"] = "HD1"
    """hoist drive class (control of the hoisting speed), for phi2"""
    crane: Literal["A1", "A2", "A3", "A4", "A5", "A6", "A7", "A8"] | None = None
    """group of the crane, ISO 4301-1"""
    edition: Literal["by_class", "by_drive", "raised"] = "by_class"
    """minimum phi2 by the hoisting class alone, 1.05 for HD3 and HD5 (newer EN 13001-2), or raised for HD1"""
    lifting_share: Annotated[
        Annotated[float, Measure(units.RATIO, at_least=0, at_most=0.1)], Absent("the maximum value of the standard")
    ] = 0.1
    """deviation of phi1 from 1"""
    release: Literal["none", "slow", "quick"] = "none"
    """release of a part of the load: by a grab, or by a magnet; for phi3"""
    released_share: Annotated[Fraction, Absent("the full load is released: the worst case of a `release`")] = 1.0
    """released part of the load"""
    drive_change: Literal["centrifugal", "smooth", "sudden"] | None = None
    """change of the drive forces, for phi5; default: smooth for a drive on a ramp, otherwise sudden"""
    play: Literal["small", "large"] = "small"
    """backlash of the travel drive, for phi5"""
    stability: Literal["en_13001_2", "fem_1_001"] = "en_13001_2"
    """standard of the partial factors for the proof of stability"""
    buffer_edition: Literal["line", "two_values"] = "line"
    """phi7 as a linear function of the buffer curve shape (EN 13001-2, ISO 8686-1), or one of two values"""


class Declared(Fragment):
    """Declared dynamic factors of the structure: upper limits of the computed factors."""

    phi1: Annotated[Phi | None, Limit()] = None
    """weight of the crane during lifting"""
    phi2: Annotated[Phi | None, Limit()] = None
    """lifting a grounded load"""
    phi3: Annotated[Annotated[float, Measure(units.RATIO, at_least=-1, at_most=1)] | None, Limit()] = None
    """release of a part of the load; lower limit of the computed factor"""
    phi4: Annotated[Phi | None, Limit()] = None
    """travelling over rail steps and gaps"""
    phi5: Annotated[Phi | None, Limit()] = None
    """changes of the drive forces"""
    phi6: Annotated[Phi | None, Limit()] = None
    """dynamic test load"""
    phi7: Annotated[Phi | None, Limit()] = None
    """buffers"""
