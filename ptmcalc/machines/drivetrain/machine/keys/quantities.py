"""Quantities of parts that turn or travel, and points of a table in order."""

from collections.abc import Iterator
from itertools import pairwise
from typing import Annotated

from ptmcalc.base import units
from ptmcalc.base.units import Quantity
from ptmcalc.spec.fields import Measure
from ptmcalc.spec.fragment import Conflict, Given


def either(rotation: Quantity, translation: Quantity, **limits: float) -> Measure:
    """A quantity of a part that turns, or the like one of a part that travels."""
    return Measure(rotation, or_else=translation, **limits)


Turn = Annotated[float, either(units.ANGLE, units.LENGTH)]
Play = Annotated[float, either(units.ANGLE, units.LENGTH, at_least=0)]
AnySpeed = Annotated[float, either(units.ANGULAR_SPEED, units.SPEED)]
Torque = Annotated[float, either(units.TORQUE, units.FORCE)]
PositiveTorque = Annotated[float, either(units.TORQUE, units.FORCE, above=0)]
TorqueOrNone = Annotated[float, either(units.TORQUE, units.FORCE, at_least=0)]
Stiffness = Annotated[float, either(units.TORSIONAL_STIFFNESS, units.STIFFNESS, above=0)]
Damping = Annotated[float, either(units.TORSIONAL_DAMPING, units.DAMPING, at_least=0)]
AnyImpulse = Annotated[float, either(units.ANGULAR_IMPULSE, units.IMPULSE)]
AngularFrequency = Annotated[float, Measure(units.ANGULAR_FREQUENCY, above=0)]
Exponent = Annotated[float, Measure(units.RATIO, at_least=1, at_most=3)]


def rising(given: Given, key: str) -> Iterator[Conflict]:
    """Points of a table in order."""
    numbers = [point.number(key) if point else None for point in given.blocks("points")]
    for index, (one, other) in enumerate(pairwise(numbers), 1):
        if one is not None and other is not None and not other > one:
            reason = f"the `{key}` of a point is not above that of the point before"
            yield Conflict(("points", index, key), reason, "sort the points")
            return
