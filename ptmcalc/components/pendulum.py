"""A load on ropes under something that travels or slews: what a file says of it, and the pendulum it is."""

from typing import Annotated

from ptmcalc.base import units
from ptmcalc.spec.fields import Measure, PositiveSpan, PositiveSpeed
from ptmcalc.spec.fragment import Fragment
from ptmcalc.spec.optional import Absent


class Suspension(Fragment):
    """How the load hangs."""

    length: PositiveSpan
    """from where the ropes are held to the middle of the load, where a scene names no other; not the height of lift"""
    hoist_speed: Annotated[PositiveSpeed | None, Absent("no hoisting while the crane travels")] = None
    """of the hook; needed to hoist while travelling"""
    creep_speed: Annotated[PositiveSpeed | None, Absent("lift-off at the full `hoist_speed`")] = None
    """slow speed of the hook; with HD2 and HD3 the load is lifted off the ground with it"""
    height: Annotated[
        Annotated[float, Measure(units.SPAN, at_least=0)] | None,
        Absent("the rope suspension point is at trolley height"),
    ] = None
    """of the place where the ropes are held, above the rails; that of the trolley when left out"""
