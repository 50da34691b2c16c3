"""Elastic links of a train, with backlash or slack."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from ptmcalc.base import units
from ptmcalc.machines.drivetrain.machine.keys.quantities import (
    Damping,
    Exponent,
    Play,
    PositiveTorque,
    Stiffness,
    Torque,
)
from ptmcalc.machines.drivetrain.machine.wiring import GROUND
from ptmcalc.spec.fields import Fraction, Measure, PositiveLength
from ptmcalc.spec.fragment import Conflict, Fragment, Given, at_most_one, exactly_one, together
from ptmcalc.spec.optional import Absent, Assumed, Limit, OneOf
from ptmcalc.spec.shape import Also


class Clearance(Fragment):
    """The backlash of a gear or toothed coupling from its geometry."""

    centre_distance: Annotated[PositiveLength | None, OneOf("value")] = None
    """with `accuracy_class`: minimum clearance of new spur gears, a*cbrt(A) (reconstructed table)"""
    accuracy_class: Literal[2, 3, 4] | None = None
    """accuracy class of the old standard the table was made for"""
    value: Annotated[PositiveLength | None, OneOf("centre_distance")] = None
    """clearance of the new gear along the pitch circle, instead of the two"""
    pitch_radius: PositiveLength
    """of the wheel on the shaft of the link's first inertia"""
    module: Annotated[PositiveLength | None, Absent("needed with `wear` only")] = None
    """needed with `wear`"""
    wear: Annotated[Annotated[float, Measure(units.LENGTH, at_least=0)] | None, Assumed()] = None
    """thickness lost by a tooth; none to 15 % of the tooth is assumed with a `module` when it is left out"""
    both_worn: bool = True
    """whether both gears have lost it"""
    kind: Literal["gearbox", "coupling", "open_gear"] = "gearbox"
    """wear limit: 25 % of the tooth in gearboxes and couplings, 40 % in open gears"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The clearance is measured, or comes from the table."""
        if "accuracy_class" not in given and "centre_distance" not in given:
            yield from exactly_one(given, "value", "centre_distance")
        else:
            yield from at_most_one(given, "centre_distance", "value")
            for one, other in (("centre_distance", "accuracy_class"), ("accuracy_class", "centre_distance")):
                yield from together(given, one, other, "the table needs centre distance and accuracy class")
        wear = given.number("wear")
        if wear:
            yield from together(given, "wear", "module", "wear is a share of the tooth")


class Link(Fragment):
    """An elastic link between two inertias, or between an inertia and the ground."""

    between: Annotated[tuple[str, ...], Field(min_length=2, max_length=2)]
    """names of two inertias, or of one and `ground`; a positive torque drives the second"""
    stiffness: Annotated[Stiffness | None, OneOf("law: rigid")] = None
    """of the whole link; a `rigid` contact has none"""
    damping: Annotated[Damping, Absent("undamped oscillations are largest")] = 0.0
    """viscous damping of the link"""
    gap: Annotated[Play | None, Absent("a shaft or another part without clearance"), Also("backlash")] = None
    """total backlash, half of it to either side"""
    clearance: Clearance | None = None
    """the backlash from the gear geometry, instead of `gap`"""
    slack: Annotated[Play | None, Absent("no rope or chain")] = None
    """a rope or chain: tension only, after this slack travel"""
    law: Literal["clamped", "no_pull", "kelvin", "hunt_crossley", "rigid"] | None = None
    """contact law; default: `clamped` with a gap, `no_pull` with slack"""
    dissipation: Annotated[
        Annotated[float, Measure(units.RATIO, at_least=0)] | None,
        Absent("a contact without losses has the largest rebound"),
    ] = None
    """c in F = k d^n (1 + 1.5 c d'), in s/rad or s/m (`hunt_crossley`)"""
    exponent: Annotated[Exponent, Absent("a linear contact")] = 1.0
    """n of `hunt_crossley`"""
    restitution: Annotated[Fraction | None, Assumed()] = None
    """of a `rigid` contact; 0 to 0.5 is assumed when it is left out"""
    start: Literal["centred", "driving", "braking"] = "centred"
    """initial position of the link in its backlash: `driving` touches on the side of a positive torque"""
    preload: Annotated[Torque, Absent("no torque at the start")] = 0.0
    """torque in the link at the start; with `slack` and `driving` the rope is taut"""
    limit: Annotated[PositiveTorque | None, Limit()] = None
    """permissible torque of the link"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """What a contact needs."""
        yield from at_most_one(given, "gap", "clearance")
        for key in ("gap", "clearance"):
            yield from at_most_one(given, "slack", key)
        law = given.word("law")
        contact = any(key in given for key in ("gap", "clearance", "slack"))
        if law is not None and not contact:
            yield Conflict(("law",), f"`{law}` is a contact law, and the link has no backlash", "add `gap: 0 deg`")
        if law == "rigid":
            for key in ("stiffness", "damping"):
                if key in given:
                    yield Conflict((key,), "a rigid contact has none", f"delete `{key}`, or write `law: clamped`")
        elif "stiffness" not in given:
            yield given.missing("stiffness", "an elastic link needs its `stiffness`")
        for key, wanted in (("dissipation", "hunt_crossley"), ("exponent", "hunt_crossley"), ("restitution", "rigid")):
            if key in given and law != wanted and (law is not None or "law" not in given):
                yield Conflict((key,), f"it belongs to `law: {wanted}`", f"delete it, or write `law: {wanted}`")
        if law == "hunt_crossley" and "damping" in given:
            yield Conflict(("damping",), "`hunt_crossley` is damped by `dissipation`", "delete `damping`")

    @property
    def body(self) -> str:
        """The first inertia it is tied to."""
        return next(name for name in self.between if name != GROUND)

    @property
    def contact_law(self) -> str:
        """The law of contact, or `linear` without play."""
        if self.law is not None:
            return self.law
        if self.slack is not None:
            return "no_pull"
        return "linear" if self.gap is None and self.clearance is None else "clamped"
