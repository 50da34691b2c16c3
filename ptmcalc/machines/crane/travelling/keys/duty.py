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
    """A part of the crane's working life."""

    share: PositiveShare
    """of all cycles"""
    load: Share
    """over the rated load"""


class Duty(Fragment):
    """What the mechanism does all day."""

    type: Literal["S1", "S3", "S4", "S5"] = "S3"
    """duty type of IEC 60034-1; S4 and S5 count the starts"""
    factor: Annotated[PositiveShare | None, Assumed()] = None
    """share of a cycle in which the motor is on; 40 % is assumed when it is left out"""
    starts_per_hour: Annotated[HourlyRate | None, Absent("S1 and S3 count no starts; S4 and S5 require them")] = None
    """of the motor"""
    load_spectrum: Annotated[tuple[SpectrumPoint, ...], Field(min_length=1, max_length=20)] | None = None
    """loads over the life; the rated load always, when left out"""
    cycles: Annotated[
        Annotated[float, Measure(units.FACTOR, above=0)] | None, Absent("the group is checked only where it is given")
    ] = None
    """hoisting cycles in the life, which with the spectrum give the group of the crane"""
    hours: Annotated[RunningTime | None, Absent("the group is computed only where it is given")] = None
    """time in motion in the life, which with the spectrum gives the group of the mechanism"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The shares of a spectrum are a whole; what counts starts has some."""
        points = given.blocks("load_spectrum")
        shares = [point.number("share") if point else None for point in points]
        known = [share for share in shares if share is not None]
        if known and len(known) == len(shares) and abs(sum(known) - 1) > 1e-6:
            reason = f"the shares add up to {sum(known):.3g}"
            yield Conflict(("load_spectrum",), reason, "make them add up to 1: the rest of the cycles has a load too")
        kind = given.word("type")
        if kind in ("S4", "S5") and "starts_per_hour" not in given:
            yield given.missing("starts_per_hour", f"the starts heat the motor in {kind}")
        if kind == "S1" and "factor" in given:
            yield Conflict(("factor",), "S1 has no rest", "delete `factor`, or write `type: S3`")


class Classes(Fragment):
    """What the crane is classed as, and by which edition its factors are taken."""

    hoisting: Literal["HC1", "HC2", "HC3", "HC4"] | None = None
    """stiffness class of the hoist, for phi2"""
    drive: Literal["HD1", "HD2", "HD3", "HD4", "HD5"] = "HD1"
    """how the hoisting speed is controlled, for phi2"""
    crane: Literal["A1", "A2", "A3", "A4", "A5", "A6", "A7", "A8"] | None = None
    """group of the crane, ISO 4301-1"""
    edition: Literal["by_class", "by_drive", "raised"] = "by_class"
    """smallest phi2 by the hoisting class alone, 1.05 for HD3 and HD5 (newer EN 13001-2), or raised for HD1"""
    lifting_share: Annotated[
        Annotated[float, Measure(units.RATIO, at_least=0, at_most=0.1)], Absent("the largest of the standard")
    ] = 0.1
    """the part by which phi1 differs from 1"""
    release: Literal["none", "slow", "quick"] = "none"
    """how a part of the load comes off: by a grab, or by a magnet; for phi3"""
    released_share: Annotated[Fraction, Absent("all of the load comes off: the worst case of a `release`")] = 1.0
    """part of the load that comes off"""
    drive_change: Literal["centrifugal", "smooth", "sudden"] | None = None
    """how the drive forces change, for phi5; smooth for a drive that keeps to a ramp, else sudden, when left out"""
    play: Literal["small", "large"] = "small"
    """of the travel drive, for phi5"""
    stability: Literal["en_13001_2", "fem_1_001"] = "en_13001_2"
    """by which standard's partial factors it is proved that the crane does not tip"""
    buffer_edition: Literal["line", "two_values"] = "line"
    """phi7 along a line by the shape of the buffer's curve (EN 13001-2, ISO 8686-1), or one of two values"""


class Declared(Fragment):
    """Dynamic factors with which the structure has been calculated: what is found must not be above them."""

    phi1: Annotated[Phi | None, Limit()] = None
    """weight of the crane as a load is lifted"""
    phi2: Annotated[Phi | None, Limit()] = None
    """lifting a load off the ground"""
    phi3: Annotated[Annotated[float, Measure(units.RATIO, at_least=-1, at_most=1)] | None, Limit()] = None
    """a part of the load comes off; what is found must not be below it"""
    phi4: Annotated[Phi | None, Limit()] = None
    """running over steps and gaps"""
    phi5: Annotated[Phi | None, Limit()] = None
    """changes of the drive forces"""
    phi6: Annotated[Phi | None, Limit()] = None
    """dynamic test load"""
    phi7: Annotated[Phi | None, Limit()] = None
    """buffers"""
