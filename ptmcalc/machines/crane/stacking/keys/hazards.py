"""What a stacker crane meets: an obstacle, the rack at its fork, the rail, its safety gear; and how still it must be.

What each block says belongs to the scene of the same name."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from ptmcalc.base import units
from ptmcalc.spec.fields import (
    Fraction,
    Length,
    Measure,
    PositiveForce,
    PositiveLength,
    PositiveMass,
    PositiveSpeed,
    PositiveStiffness,
    SignedSpan,
    Time,
)
from ptmcalc.spec.fragment import Conflict, Fragment, Given, together
from ptmcalc.spec.optional import Absent, Assumed, Limit, OneOf
from ptmcalc.spec.shape import Also

TripRatio = Annotated[float, Measure(units.RATIO, at_least=1, at_most=3)]
_TRIP_RATIO = Assumed(
    1.4, 1.2, 1.5, "overspeed governors trip at 1.2 to 1.5 times the hoisting speed (EN 528, EN 81-20)"
)
_REACTION = Assumed(0.05, 0.02, 0.15, "linkages of safety gears engage within 20 to 150 ms of tripping")
_GEAR_ARM = Assumed(0.0, -0.2, 0.2, "safety gears act on a guide within 0.2 m of the mast axis")


class Obstacle(Fragment):
    """What the free end of the column runs into."""

    contact: Literal["elastic", "plastic"] = "elastic"
    """whether the far end springs back, or stays where it hits"""
    stiffness: Annotated[PositiveStiffness | None, OneOf("`contact: plastic`")] = None
    """of the place that is hit; of an `elastic` contact"""
    restitution: Annotated[Fraction, Absent("an impact without losses causes the largest mast deflection")] = 1.0
    """speed after an `elastic` contact over that before"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """What springs back has a stiffness."""
        if given.word("contact") == "elastic" and "stiffness" not in given:
            yield given.missing("stiffness", "an `elastic` contact needs its stiffness")
        if given.word("contact") == "plastic":
            for key in ("stiffness", "restitution"):
                if key in given:
                    yield Conflict((key,), "a `plastic` contact has none", "delete it, or write `contact: elastic`")


class Fork(Fragment):
    """The telescopic fork and its drive."""

    mass: PositiveMass
    """of fork and drive, reduced to the fork; with a slip clutch weaker than the motor only the parts behind it"""
    speed: PositiveSpeed
    """of the fork"""
    motor_force: PositiveForce
    """largest of its drive that goes on pushing, at the fork"""
    clutch_force: Annotated[
        PositiveForce | None, Absent("without a slip clutch the full motor force and the full mass act")
    ] = None
    """at which its slip clutch slips, at the fork; one as strong as the motor is not reckoned with: the whole mass
    bounds the force then"""
    torsion_stiffness: Annotated[
        Annotated[float, Measure(units.TORSIONAL_STIFFNESS, above=0)] | None,
        Absent("a mast without torsion results in the largest fork thrust"),
    ] = None
    """of the column against twisting, where the carriage is; rigid when left out"""
    arm: Annotated[SignedSpan, Absent("a mast without torsion results in the largest fork thrust")] = 0.0
    """of the pushing fork from the axis of the column, along the aisle"""
    rating: Annotated[PositiveForce | None, Limit()] = None
    """largest force of the telescope; needed to check it"""


class Rack(Fragment):
    """The rack at the fork."""

    stiffness_push: Annotated[PositiveStiffness | None, OneOf("no `fork`: with one it is required")] = None
    """against the fork that pushes; with a `fork` it is needed"""
    stiffness_vertical: Annotated[PositiveStiffness | None, Absent("a rigid rack results in the largest force")] = None
    """against the fork that lifts; rigid when left out"""
    rating_push: Annotated[PositiveForce | None, Limit()] = None
    """largest force of the pushing fork on the rack; needed to check it"""
    rating_vertical: Annotated[PositiveForce | None, Limit()] = None
    """largest force of the lifting fork on the rack; needed to check it"""


class Waviness(Fragment):
    """Even waves of the rail."""

    height: PositiveLength
    """from trough to crest"""
    length: PositiveLength
    """from crest to crest"""


class Rail(Fragment):
    """The rail a rack stacker runs on."""

    step: Annotated[Length, Absent("no step given")] = 0.0
    """height of the largest step"""
    gap: Annotated[Length, Absent("no gap given")] = 0.0
    """width of the largest gap"""
    waviness: Waviness | None = None
    """even waves"""
    frequency: Annotated[Annotated[float, Measure(units.FREQUENCY, above=0)] | None, Assumed()] = None
    """of the machine that swings vertically on its wheels; 10 Hz is assumed for a `rail`"""
    damping: Annotated[
        Annotated[float, Measure(units.RATIO, at_least=0, at_most=0.5)],
        Absent("without damping, the oscillation is largest"),
    ] = 0.0
    """damping ratio of that swing; none when left out, which is on the safe side"""

    @property
    def uneven(self) -> bool:
        """Whether there is anything to run over."""
        return bool(self.step or self.gap or self.waviness)


class SafetyGear(Fragment):
    """What catches the carriage when its ropes fail."""

    type: Literal["progressive", "instantaneous"]
    """`progressive`: it brakes with a constant force; `instantaneous`: it locks, and only its mounting and the column
    deflect"""
    force: Annotated[PositiveForce | None, OneOf("stiffness")] = None
    """braking force of a `progressive` gear"""
    stiffness: Annotated[PositiveStiffness | None, OneOf("force")] = None
    """of an `instantaneous` gear with its mounting and the column"""
    stroke: PositiveLength = Field(examples=["300 mm"])
    """braking distance of a `progressive` gear, maximum deflection of an `instantaneous` one"""
    trip_ratio: Annotated[TripRatio, _TRIP_RATIO] = 1.4
    """speed at which it trips over the hoisting speed; 1.2 to 1.5"""
    reaction_time: Annotated[Time, _REACTION] = 0.05
    """from tripping until it engages"""
    arm: Annotated[SignedSpan, _GEAR_ARM] = 0.0
    """of the gear's force from the axis of the column, along the travel of bridge or base"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Each type has its own number."""
        what = given.word("type")
        for kind, key, other in (("progressive", "force", "stiffness"), ("instantaneous", "stiffness", "force")):
            if what == kind and key not in given:
                yield given.missing(key, f"a `{kind}` safety gear needs its `{key}`")
            if what == kind and other in given:
                yield Conflict((other,), f"a `{kind}` safety gear has no `{other}`", f"delete `{other}`")


class Settling(Fragment):
    """How still the column must be before the fork may go out."""

    window: Annotated[PositiveLength | None, Limit(), Also("positioning_tolerance")] = None
    """distance to each side of the place of a column without lean within which its far end has to stay; no default"""
    wait: Annotated[Annotated[float, Measure(units.TIME, above=0)] | None, Limit()] = None
    """longest time from the standstill until then; needed to check it"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """A time to wait is for a window."""
        yield from together(given, "wait", "window", "the settling time refers to a positioning tolerance")
