"""Inertias of a train, and the motions and impulses prescribed to them."""

from collections.abc import Iterator
from typing import Annotated

from pydantic import Field

from ptmcalc.machines.drivetrain.machine.keys.bodies import AnyBody
from ptmcalc.machines.drivetrain.machine.keys.quantities import AnyImpulse, AnySpeed, Turn, rising
from ptmcalc.spec.fields import Inertia, Mass, PositiveTime, Time
from ptmcalc.spec.fragment import Conflict, Fragment, Given, exactly_one
from ptmcalc.spec.optional import Absent, OneOf


class Body(Fragment):
    """An inertia of the train: rotating (`inertia` or `body`) or travelling (`mass`)."""

    inertia: Annotated[Inertia | None, OneOf("mass, body")] = None
    """moment of inertia; 0 is permitted only on a shaft connected to another inertia by a gear"""
    mass: Annotated[Mass | None, OneOf("inertia, body")] = None
    """mass of a travelling part"""
    body: AnyBody | None = None
    """a body whose inertia is computed from its dimensions"""
    position: Annotated[Turn, Absent("positions are relative to it")] = 0.0
    """angle or position at the start"""
    speed: Annotated[AnySpeed | None, Absent("it starts from standstill or with the speed of the scene")] = None
    """speed at the start; default: that of the scene, or standstill"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The inertia is given in one way."""
        yield from exactly_one(given, "inertia", "mass", "body")

    @property
    def turns(self) -> bool:
        """Whether it turns."""
        return self.mass is None

    @property
    def size(self) -> float:
        """Moment of inertia or mass [kg*m^2 or kg]."""
        if self.body is not None:
            return self.body.inertia
        size = self.inertia if self.mass is None else self.mass
        assert size is not None
        return size


class MotionPoint(Fragment):
    """A speed at a time."""

    time: Time
    """since the start of the scene"""
    speed: AnySpeed
    """of the inertia"""


class Motion(Fragment):
    """A prescribed motion of an inertia, linear between the points of its speed."""

    at: str
    """the inertia it acts on"""
    points: Annotated[tuple[MotionPoint, ...], Field(min_length=1, max_length=500)]
    """in ascending order"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Times increase, from 0 on."""
        yield from rising(given, "time")
        first = next(iter(given.blocks("points")), None)
        if first is not None and first.number("time") not in (None, 0.0):
            yield Conflict(("points", 0, "time"), "the motion is known from time 0 on", "write `0 s`")


class Impulse(Fragment):
    """An impact: a sudden change of momentum."""

    at: str
    """the inertia it acts on"""
    time: PositiveTime
    """time of the impulse"""
    size: AnyImpulse
    """impulse: torque times time, or force times time"""
