"""A take-up weight that may reach a stop during a scene: from there on its tension is not that of the simulation."""

import math
from collections.abc import Iterator, Mapping

import numpy as np

from ptmcalc.base.estimate import Interval
from ptmcalc.contract.result import Failure, Found, family
from ptmcalc.machines.conveyor.machine.loads import CHANGED_BY_MOTION, DRIVE, TAKEUP_CLEARANCES, TAKEUP_WAYS
from ptmcalc.machines.conveyor.machine.model import FloatArray
from ptmcalc.machines.conveyor.machine.motion import Moving
from ptmcalc.machines.conveyor.machine.resistances import filled
from ptmcalc.machines.conveyor.waves import load_errors
from ptmcalc.numerics.belt.march import Drawn


def sinking(case: Moving, drawn: Drawn) -> FloatArray:
    """Distance by which the weight has sunk since the beginning, over time [m]; negative where it has risen.

        x = integral of (v_on - v_off) dt/2

    **Range** a weight on two falls.
    **Error** trapezium rule.
    **Source** the belt that arrives and does not leave lengthens both falls.
    """
    station, step = drawn.tail if case.line.weight_at_tail else drawn.head, float(drawn.times[1])
    apart = station.belt - (station.behind - station.creep)
    way: FloatArray = np.concatenate([[0.0], np.cumsum((apart[1:] + apart[:-1]) / 2)]) * step / 2
    return way


def contact(
    case: Moving, drawn: Drawn, loads: Mapping[str, Found], present: Mapping[str, Interval]
) -> tuple[dict[str, Interval], str]:
    """Offsets of the loads of a scene in which the weight may reach a stop, and that state; nothing where it does not.

    The weight at its upper stop is a fixed take-up, on its lower stop it leaves the belt slack: the loads after that
    have no bound. The distances from the stops themselves are those of a weight that could go on. `present` are the
    offsets after the window.
    """
    if TAKEUP_CLEARANCES[0] not in loads:
        return {}, ""
    ends = [loads[name].estimate.low + present.get(name, Interval(0.0, 0.0)).low for name in TAKEUP_CLEARANCES]
    if min(ends) >= 0:
        return {}, ""
    takeup, way = case.spec.takeup, sinking(case, drawn)
    at = filled(takeup.position) + way
    outside = np.flatnonzero((at < 0) | (at > filled(takeup.stroke)))
    stop = "upper" if ends[0] < ends[1] else "lower"
    does = (
        f"reaches its {stop} stop at {drawn.times[outside[0]]:.3g} s" if len(outside) else f"may reach its {stop} stop"
    )
    unknown = {
        name: load_errors.anything(name, found.estimate)
        for name, found in loads.items()
        if family(name) in (CHANGED_BY_MOTION | frozenset(DRIVE)) - TAKEUP_WAYS
    }
    return unknown, f"the take-up weight {does}: its tension is unknown from there on"


def failures(case: Moving, drawn: Drawn, loads: Mapping[str, Found]) -> Iterator[Failure]:
    """A weight that reaches a stop whatever the error bars are, with the travel and the position that pass."""
    known = [loads[name].estimate for name in TAKEUP_CLEARANCES if name in loads]
    if not known or min(one.high for one in known) >= 0:
        return
    takeup, way = case.spec.takeup, sinking(case, drawn)
    begins, stroke = filled(takeup.position), filled(takeup.stroke)
    above, below = (_upward(part - one.low) for part, one in zip((begins, stroke - begins), known, strict=True))
    stop, when = ("upper", way.argmin()) if known[0].low < known[1].low else ("lower", way.argmax())
    outside = np.flatnonzero((begins + way < 0) | (begins + way > stroke))
    time = drawn.times[outside[0] if len(outside) else when]
    reason = f"the take-up weight reaches its {stop} stop at {time:.3g} s and no longer keeps the tension"
    cure = f"`travel: {max(above + below, stroke):.4g} m` passes with `position: {above:.4g} m`"
    path = ("takeup", "stroke" if above + below > stroke else "position")
    yield Failure("CNV141", reason, path, cure)


def _upward(way: float) -> float:
    """A distance rounded up to a centimetre [m], at least 0."""
    return max(math.ceil(way * 100 - 1e-6), 0) / 100
