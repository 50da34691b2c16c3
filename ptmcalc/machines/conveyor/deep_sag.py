"""A belt that sags on the way deeper than a parabola goes: what is certain up to that moment.

From the moment at which spans sag by a tenth of their length, cells with such spans are not trusted. That moment is
found by halving the window of the finest grid; the scene is marched again up to it, and what has come by then has come:
a largest value is at least that, a smallest one at most that.
"""

import math
from collections.abc import Callable

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Finding, Found, family
from ptmcalc.laws import sag
from ptmcalc.machines.conveyor.loads import OF_STOP
from ptmcalc.machines.conveyor.moving import Moving
from ptmcalc.numerics.belt.march import Drawn, Extreme

_HALVINGS = 3
_FRONT_STEPS = 12
"""Steps of the finest grid that a front is known to: three of the coarsest."""
_FALLING = frozenset(
    {
        "tension_run_off_min",
        "tension_min",
        "slack_margin_min",
        "slip_reserve_min",
        "belt_safety_min",
        "starting_reserve",
    }
)
"""Families of loads that only come down as time goes on; all others only go up."""


def limits(case: Moving) -> tuple[float, float]:
    """Tension of return and carry strand below which the belt sags too deep [N]; 0 where a pitch is not given."""
    line = case.line
    back, carry = (sag.tension_at_sag(one.span_weight or 0.0, sag.DEEPEST) for one in (line.back, line.carry))
    return back, carry


def too_deep(case: Moving, drawn: Drawn) -> bool:
    """Whether a strand of a belt whose sag is known came below its limit."""
    return bool(_sagging(case, drawn))


def _sagging(case: Moving, drawn: Drawn) -> list[Extreme]:
    """Lowest tensions of the strands that come below their limits."""
    lows = (drawn.back_min, drawn.carry_min)
    return [low for low, limit in zip(lows, limits(case), strict=True) if limit > 0 and low.value < limit]


def trusted_window(case: Moving, drawn: Drawn, once: Callable[[float], Drawn]) -> float | None:
    """How long the belt keeps above its limits [s], by runs of `once` up to a time; None if hardly at all."""
    low, high, step = 0.0, min(one.time for one in _sagging(case, drawn)), float(drawn.times[1])
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        low, high = (low, middle) if too_deep(case, once(middle)) else (middle, high)
    end = low - _FRONT_STEPS * step
    return end if end > _FRONT_STEPS * step else None


def certain(name: str, whole: Found, early: Found | None, constant: bool, window: float | None) -> Found:
    """A load of a run that was trusted up to a time only; `constant` is a tension that a weight keeps."""
    if constant and family(name) == "tension_run_off_min":
        return whole
    value = whole.estimate.value
    known = early.estimate if early is not None else Estimate.unknown(value)
    if family(name) in OF_STOP:
        if known.bounded:
            return early or whole
        known = Estimate.exact((window or 0.0) if name == "stop_time" else 0.0)
    if family(name) in _FALLING:
        return Found(Estimate(min(value, known.high), -math.inf, known.high, known.numerical, math.inf), whole.at)
    return Found(Estimate(max(value, known.low), known.low, math.inf, known.numerical, math.inf), whole.at)


def finding(case: Moving, drawn: Drawn, window: float | None) -> Finding:
    """Where and when it sags too deep, and what is known nevertheless."""
    low = min(_sagging(case, drawn), key=lambda one: one.value)
    does = "goes slack" if low.value < 0 else "sags by more than a tenth of the idler pitch"
    known = f"what came in the first {window:.3g} s is certain, and no more" if window else "no peak of it is certain"
    return Finding(
        "NUM102",
        f"the belt {does}, most of all at {low.time:.3g} s, {low.place:.4g} m behind the drive's run-off; {known}",
        ("takeup", "tension"),
        "a higher `tension` keeps the belt taut",
    )
