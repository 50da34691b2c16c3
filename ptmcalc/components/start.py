"""How a drive comes up to speed or torque."""

import itertools
from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from ptmcalc.laws import start_profile
from ptmcalc.spec.fields import (
    Fraction,
    PositiveFrequency,
    PositiveTime,
    Time,
)
from ptmcalc.spec.fragment import Conflict, Fragment, Given
from ptmcalc.spec.optional import Absent, OneOf


class ProfilePoint(Fragment):
    """One point of a start profile."""

    time: Time
    """from switching on"""
    share: Fraction
    """of the rated speed, or of the mean starting torque"""


class Profile(Fragment):
    """How the drive starts."""

    shape: Literal["step", "ramp", "cosine", "parabolic", "table", "curve"] = "step"
    """`step` instantaneous, `ramp` linear, `cosine` as (1 - cos)/2, `parabolic` as two parabolas, `table` by `points`,
    `curve` as the motors' torque over their speed; when left out, the `curve` of the motors if the file gives one, else
    a step"""
    time: Annotated[PositiveTime | None, OneOf("points, or an instantaneous shape")] = None
    """duration of the rise"""
    points: Annotated[tuple[ProfilePoint, ...], Field(min_length=2, max_length=500)] | None = None
    """of a `table`: times ascending from 0, shares ascending to 1, linear between points"""
    control: Literal["torque", "speed"] | None = None
    """controlled quantity; a step is a torque, any other shape is a speed unless this is `torque`"""
    ripple: Annotated[PositiveFrequency | None, Absent("a control without ripple")] = None
    """ripple frequency of the drive control; checked against the natural frequencies of the machine"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """A step is at once and of torque; a table has its points; anything else takes its time."""
        shape = given.word("shape")
        if shape in ("step", "curve", "table") and "time" in given:
            hint = (
                "delete `time`: the last point states it"
                if shape == "table"
                else "delete `time`, or write `shape: ramp`"
            )
            yield Conflict(("time",), f"a `{shape}` has no `time`", hint)
        if shape in ("step", "curve"):
            if given.word("control") == "speed":
                reason = "a step of speed needs an infinite force"
                if shape == "curve":
                    reason = "a motor curve describes a torque"
                yield Conflict(("control",), reason, "write `shape: ramp` and a `time`")
        elif shape == "table":
            yield from _faulty_points(given)
        elif shape is not None and "time" not in given:
            yield given.missing("time", f"a `{shape}` needs its `time`")
        if shape not in ("table", None) and "points" in given:
            yield Conflict(("points",), f"a `{shape}` has no `points`", "write `shape: table`")

    def followed(self, curves: bool) -> "Profile":
        """The profile of a machine whose motors have curves or not: with curves and no shape given, the curves."""
        return self.model_copy(update={"shape": "curve"}) if curves and "shape" not in self.model_fields_set else self

    @property
    def imposes_speed(self) -> bool:
        """Whether the speed follows the profile, not the torque."""
        return self.shape not in ("step", "curve") and self.control != "torque"

    @property
    def rise(self) -> start_profile.Shape:
        """How the mean starting torque or the speed rises; on a motor's curve it is there at once."""
        if self.points is not None:
            return tuple((point.time / self.rise_time, point.share) for point in self.points)
        return "step" if self.shape == "curve" else self.shape

    @property
    def rise_time(self) -> float:
        """Duration of the rise [s], 0 where it is at once."""
        return self.points[-1].time if self.points is not None else self.time or 0.0

    @property
    def time_key(self) -> str:
        """The key that says how long the rise takes; empty where it is at once."""
        return "points" if self.points is not None else "time" if self.time is not None else ""


def _faulty_points(given: Given) -> Iterator[Conflict]:
    """A table starts at 0, and rises to 1: of speed from 0."""
    if "points" not in given:
        hint = "add `points: [{time: 0 s, share: 0}, {time: 10 s, share: 1}]`"
        yield Conflict((), "a `table` needs its `points`", hint)
        return
    points = given.blocks("points")
    times = [point.number("time") if point else None for point in points]
    shares = [point.number("share") if point else None for point in points]
    if times and times[0]:
        yield Conflict(("points", 0, "time"), "a table begins at time 0", "write `time: 0 s`")
    for index, (one, other) in enumerate(itertools.pairwise(times), 1):
        if one is not None and other is not None and other <= one:
            reason = "the time is not after that of the point before"
            yield Conflict(("points", index, "time"), reason, "sort the points by time, and give each time once")
    for index, (one, other) in enumerate(itertools.pairwise(shares), 1):
        if one is not None and other is not None and other < one:
            yield Conflict(
                ("points", index, "share"), "the share decreases", "a start profile only increases: sort the shares"
            )
    if shares and shares[0] and given.word("control") != "torque":
        reason = "the speed of a machine at standstill is 0 and does not jump"
        yield Conflict(("points", 0, "share"), reason, "write `share: 0`, or `control: torque`")
    if len(points) > 1 and shares[-1] is not None and shares[-1] != 1:
        reason = "a table ends at 1, the full speed or the full mean starting torque"
        yield Conflict(("points", len(points) - 1, "share"), reason, "write `share: 1`")
