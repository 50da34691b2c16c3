"""A load on ropes under something that travels or slews: what a file says of it, and the pendulum it is."""

from typing import Annotated

from ptmcalc.base import units
from ptmcalc.spec.fields import Measure, PositiveSpan, PositiveSpeed
from ptmcalc.spec.fragment import Fragment
from ptmcalc.spec.optional import Absent


class Suspension(Fragment):
    """Suspension of the load."""

    length: PositiveSpan
    """rope length from suspension point to load centre, unless the scene gives another; not the lifting height"""
    hoist_speed: Annotated[PositiveSpeed | None, Absent("no hoisting while the crane travels")] = None
    """of the hook; needed to hoist while travelling"""
    creep_speed: Annotated[PositiveSpeed | None, Absent("lift-off at the full `hoist_speed`")] = None
    """creep speed of the hook; lift-off speed with HD2 and HD3"""
    height: Annotated[
        Annotated[float, Measure(units.SPAN, at_least=0)] | None,
        Absent("the rope suspension point is at trolley height"),
    ] = None
    """height of the rope suspension point above the rails; default: that of the trolley"""
