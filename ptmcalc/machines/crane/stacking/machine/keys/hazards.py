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
    """The obstacle in the path of the mast tip."""

    contact: Literal["elastic", "plastic"] = "elastic"
    """whether the tip rebounds, or stays in contact"""
    stiffness: Annotated[PositiveStiffness | None, OneOf("`contact: plastic`")] = None
    """contact stiffness; of an `elastic` contact"""
    restitution: Annotated[Fraction, Absent("an impact without losses causes the largest mast deflection")] = 1.0
    """speed after an `elastic` contact / speed before"""

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
    """of fork and drive, reduced to the fork; with a slip clutch weaker than the motor only the driven parts"""
    speed: PositiveSpeed
    """of the fork"""
    motor_force: PositiveForce
    """maximum force of its drive, at the fork"""
    clutch_force: Annotated[
        PositiveForce | None, Absent("without a slip clutch the full motor force and the full mass act")
    ] = None
    """slip force of its clutch, at the fork; a clutch as strong as the motor is neglected: the full mass
    then bounds the force"""
    torsion_stiffness: Annotated[
        Annotated[float, Measure(units.TORSIONAL_STIFFNESS, above=0)] | None,
        Absent("a mast without torsion results in the largest fork thrust"),
    ] = None
    """torsional stiffness of the mast at the carriage; rigid when left out"""
    arm: Annotated[SignedSpan, Absent("a mast without torsion results in the largest fork thrust")] = 0.0
    """lever arm of the extending fork about the mast axis, along the aisle"""
    rating: Annotated[PositiveForce | None, Limit()] = None
    """permissible thrust of the telescopic fork; needed to check it"""


class Rack(Fragment):
    """The rack at the fork."""

    stiffness_push: Annotated[PositiveStiffness | None, OneOf("no `fork`: with one it is required")] = None
    """stiffness against the extending fork; needed with a `fork`"""
    stiffness_vertical: Annotated[PositiveStiffness | None, Absent("a rigid rack results in the largest force")] = None
    """stiffness against the lifting fork; rigid when left out"""
    rating_push: Annotated[PositiveForce | None, Limit()] = None
    """permissible thrust of the fork on the rack; needed to check it"""
    rating_vertical: Annotated[PositiveForce | None, Limit()] = None
    """permissible uplift of the fork on the rack; needed to check it"""


class Waviness(Fragment):
    """Uniform waves of the rail."""

    height: PositiveLength
    """from trough to crest"""
    length: PositiveLength
    """from crest to crest"""


class Rail(Fragment):
    """The rail a rack stacker runs on."""

    step: Annotated[Length, Absent("no step given")] = 0.0
    """height of the maximum step"""
    gap: Annotated[Length, Absent("no gap given")] = 0.0
    """width of the maximum gap"""
    waviness: Waviness | None = None
    """uniform rail waves"""
    frequency: Annotated[Annotated[float, Measure(units.FREQUENCY, above=0)] | None, Assumed()] = None
    """vertical natural frequency of the machine on its wheels; 10 Hz is assumed for a `rail`"""
    damping: Annotated[
        Annotated[float, Measure(units.RATIO, at_least=0, at_most=0.5)],
        Absent("without damping, the oscillation is largest"),
    ] = 0.0
    """damping ratio of that oscillation; 0 when left out, on the safe side"""

    @property
    def uneven(self) -> bool:
        """Whether there is anything to run over."""
        return bool(self.step or self.gap or self.waviness)


class SafetyGear(Fragment):
    """The safety gear, which stops the carriage after rope failure."""

    type: Literal["progressive", "instantaneous"]
    """`progressive`: it brakes with a constant force; `instantaneous`: it locks, and only its mounting and the mast
    deflect"""
    force: Annotated[PositiveForce | None, OneOf("stiffness")] = None
    """braking force of a `progressive` gear"""
    stiffness: Annotated[PositiveStiffness | None, OneOf("force")] = None
    """of an `instantaneous` gear with its mounting and the mast"""
    stroke: PositiveLength = Field(examples=["300 mm"])
    """braking distance of a `progressive` gear, maximum deflection of an `instantaneous` one"""
    trip_ratio: Annotated[TripRatio, _TRIP_RATIO] = 1.4
    """trip speed / hoisting speed; 1.2 to 1.5"""
    reaction_time: Annotated[Time, _REACTION] = 0.05
    """from tripping to engagement"""
    arm: Annotated[SignedSpan, _GEAR_ARM] = 0.0
    """lever arm of the gear force about the mast axis, along the travel of bridge or base"""

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
    """Positioning tolerance of the mast before the fork extends."""

    window: Annotated[PositiveLength | None, Limit(), Also("positioning_tolerance")] = None
    """positioning tolerance of the mast tip to each side of the undeflected position; no default"""
    wait: Annotated[Annotated[float, Measure(units.TIME, above=0)] | None, Limit()] = None
    """maximum settling time after standstill; needed to check it"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """A time to wait is for a window."""
        yield from together(given, "wait", "window", "the settling time refers to a positioning tolerance")
