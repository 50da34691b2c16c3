"""The buffers a crane runs onto: what a file says of them."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.result import Failure, Finding
from ptmcalc.laws import buffer
from ptmcalc.spec.fields import (
    Measure,
    PositiveForce,
    PositiveFraction,
    PositiveLength,
    PositiveLineMass,
    PositiveSpeed,
    PositiveStiffness,
)
from ptmcalc.spec.fragment import Conflict, Fragment, Given
from ptmcalc.spec.optional import Absent, Assumed, Limit, OneOf

_SLOW = 0.01
"""PositiveShare of the speed from which on something in an orifice buffer stands."""
_OF = {"linear": "stiffness", "constant": "force", "hydraulic": "orifice", "progressive": "end_force"}
_EXAMPLE = {
    "stiffness": "stiffness: 400 kN/m",
    "force": "force: 60 kN",
    "orifice": "orifice: 30 t/m",
    "end_force": "end_force: 80 kN",
}


class Buffer(Fragment):
    """The buffers at one end: equal, in contact at the same time."""

    type: Literal["linear", "progressive", "constant", "hydraulic"] = "linear"
    """`linear`: springs, rubber; `progressive`: cellular plastic, its force grows as a power of the stroke; `constant`:
    friction, hydraulic with a tapered pin; `hydraulic`: one orifice, force proportional to the square of the speed"""
    count: Annotated[int, Field(ge=1, le=16, strict=True), Absent("one buffer on each rail, the usual arrangement")] = 2
    """number of buffers in simultaneous contact, one on each rail"""
    stiffness: Annotated[PositiveStiffness | None, OneOf("force, end_force, orifice")] = None
    """of one `linear` buffer"""
    force: Annotated[PositiveForce | None, OneOf("stiffness, end_force, orifice")] = None
    """of one `constant` buffer"""
    end_force: Annotated[PositiveForce | None, OneOf("stiffness, force, orifice")] = None
    """of one `progressive` buffer at the end of its stroke"""
    power: Annotated[
        Annotated[float, Measure(units.RATIO, above=0, at_most=10)],
        Assumed(2.0, 1.5, 3.0, "cellular plastic 2 to 3; rubber about 1.5", only_with=("type", "progressive")),
    ] = 2.0
    """exponent of the force of a `progressive` buffer; 2 to 3 for cellular plastic"""
    orifice: Annotated[PositiveLineMass | None, OneOf("stiffness, force, end_force")] = None
    """force / squared speed of one `hydraulic` buffer, in kg/m"""
    stroke: PositiveLength
    """maximum compression"""
    rating: Annotated[PositiveForce | None, Limit()] = None
    """permissible force of one buffer, or of its end stop; needed to check it"""
    largest_speed: Annotated[PositiveSpeed | None, Limit()] = None
    """maximum impact speed, from the manufacturer's catalogue"""
    shape: Annotated[PositiveFraction | None, Absent("the value of the curve of the `type`")] = None
    """energy / (maximum force times stroke); default: by the type"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Each type has its own number."""
        kind = given.word("type")
        if kind is None:
            return
        wanted = _OF[kind]
        if wanted not in given:
            yield Conflict((), f"a `{kind}` buffer needs its `{wanted}`", f"add `{_EXAMPLE[wanted]}`")
        for other in _OF.values():
            if other != wanted and other in given:
                fits = next(name for name, key in _OF.items() if key == other)
                yield Conflict((other,), f"a `{kind}` buffer has no `{other}`", f"delete it, or write `type: {fits}`")

    @property
    def key(self) -> str:
        """The key that says how hard it is."""
        return _OF[self.type]

    @property
    def hardness(self) -> float:
        """Stiffness [N/m], end force [N], force [N] or orifice [kg/m] of all buffers together."""
        value = getattr(self, self.key)
        assert value is not None
        return float(self.count * value)


@dataclass(frozen=True, slots=True)
class Stopped:
    """What buffers come to that something runs onto."""

    force: float
    """largest, of all buffers together [N]"""
    stroke: float
    """that the buffers would need; infinite where they do not stop it [m]"""
    left: float
    """speed at which they bottom out, 0 where they do not [m/s]"""
    energy_share: float
    """of their curve [1]"""

    def findings(self, path: KeyPath) -> tuple[Finding, ...]:
        """What to say where the buffers, which stand at `path`, do not stop what hits them."""
        if not self.left:
            return ()
        left = units.show(self.left, units.SPEED)
        why = f"the buffers bottom out with a residual speed of {left}: the force has no upper limit"
        return (Finding("NUM110", why, (*path, "stroke"), "increase the stroke or the force of the buffers"),)

    def failures(self, check: str, given: Buffer, path: KeyPath, error: float = 0.0) -> tuple[Failure, ...]:
        """A check of the force that fails because the energy of the impact exceeds what the buffers take.

        Args:
            check: its code.
            given: the buffers, with a rating to compare a force with.
            path: their place in the file.
            error: of the speed that is left [m/s].
        """
        if given.rating is None or self.left <= error:
            return ()
        left = units.show(self.left, units.SPEED)
        reason = f"the buffers bottom out with a residual speed of {left}, and the crane hits the end stop"
        return (Failure(check, reason, (*path, "stroke"), "increase the stroke or the force of the buffers"),)

    def at_least(self, value: float) -> Estimate:
        """A force, or what comes of one: exact, or without an end above where the stop behind the buffers is hit."""
        return Estimate(value, value, math.inf, model=math.inf) if self.left else Estimate.exact(value)


def stopped(given: Buffer, mass: float, speed: float, push: float, stroke: float | None = None) -> Stopped:
    """What a mass that runs onto the buffers with a constant push behind it comes to; a push below 0 brakes it.

    An orifice alone never stops it wholly: its stroke is reckoned until a hundredth of the speed, what is left at the
    end of its stroke is told.
    """
    way = given.stroke if stroke is None else stroke
    hard = given.hardness
    if given.type == "linear":
        force, needed = buffer.driven_buffer(push, mass, hard, speed)
        return _ended(force, needed, way, mass, speed, push, hard * way**2 / 2, hard * way, _share(given, 0.5))
    if given.type == "progressive":
        force, needed = buffer.progressive_buffer(push, mass, speed, hard, way, given.power)
        energy = hard * way / (given.power + 1)
        return _ended(force, needed, way, mass, speed, push, energy, hard, _share(given, 1 / (given.power + 1)))
    if given.type == "constant":
        needed = buffer.constant_force_stroke(push, hard, mass, speed)
        return _ended(hard, needed, way, mass, speed, push, hard * way, hard, _share(given, 1.0))
    force = float(np.max(buffer.orifice_buffer_force(np.array([0.0, way]), mass, hard, speed, push)))
    left = float(buffer.orifice_buffer_speed(way, mass, hard, speed, push))
    slow = _SLOW * speed
    left = left if left > slow else 0.0
    share = _share(given, buffer.orifice_energy_share(mass, hard, way))
    return Stopped(force, _orifice_stroke(mass, hard, speed, push, slow), left, share)


def _ended(
    force: float,
    needed: float,
    way: float,
    mass: float,
    speed: float,
    push: float,
    energy: float,
    end_force: float,
    share: float,
) -> Stopped:
    """A buffer that stops what runs onto it, or bottoms out with what speed is left."""
    if needed <= way:
        return Stopped(force, needed, 0.0, share)
    return Stopped(end_force, needed, buffer.speed_left(push, mass, speed, energy, way), share)


def _share(given: Buffer, own: float) -> float:
    return given.shape if given.shape is not None else own


def _orifice_stroke(mass: float, orifice: float, speed: float, push: float, slow: float) -> float:
    """Way until an orifice has brought the speed down to a slow one; infinite where the push keeps it faster [m]."""
    steady = push / orifice
    if steady >= slow**2:
        return math.inf
    return mass / (2 * orifice) * math.log((speed**2 - steady) / (slow**2 - steady))
