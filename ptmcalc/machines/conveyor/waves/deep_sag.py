"""A belt that sags on the way deeper than a parabola goes: what is certain up to that moment.

From the moment at which spans sag by a tenth of their length, cells with such spans are not trusted. The scene is
marched again up to that moment on the finest grid, and what has come by then has come: a largest value is at least
that, a smallest one at most that.
"""

import math
from collections.abc import Iterable, Iterator, Mapping

import numpy as np

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Failure, Finding, Found, family
from ptmcalc.laws import sag
from ptmcalc.machines.conveyor.machine import tension_loads
from ptmcalc.machines.conveyor.machine.loads import BRAKING_RESERVE, OF_STOP, SLIPS, TAKEUP_CLEARANCES
from ptmcalc.machines.conveyor.machine.motion import Moving
from ptmcalc.machines.conveyor.machine.scenes import Start
from ptmcalc.numerics.belt.march import Drawn, Extreme

_FRONT_STEPS = 12
"""Steps of the finest grid by which the time of a front is uncertain [1]: three of the coarsest. A numerical choice. A
larger value reports a shorter certain part of the scene; a smaller one includes the doubtful part."""
_FALLING = frozenset(
    {
        "tension_run_off_min",
        "tension_min",
        "tension_bend_min",
        "slack_margin_min",
        "slip_reserve_min",
        "belt_safety_min",
        "starting_reserve",
        BRAKING_RESERVE,
        *TAKEUP_CLEARANCES,
    }
)
"""Families of loads that only come down as time goes on; all others only go up."""


def limits(case: Moving) -> tuple[float, float]:
    """Tension of return and carry strand below which the belt sags too deep [N]; 0 where a pitch is not given."""
    line = case.line
    back, carry = (sag.tension_at_sag(one.span_weight or 0.0, sag.DEEPEST) for one in (line.back, line.carry))
    return back, carry


def _least_limits(case: Moving) -> tuple[float, float]:
    """The same of the lightest spans, where lengths have loads of their own."""
    if not case.line.by_length:
        return limits(case)
    lightest = [min(one.span_weights, default=0.0) for one in (case.line.back, case.line.carry)]
    back, carry = (sag.tension_at_sag(span, sag.DEEPEST) for span in lightest)
    return back, carry


def too_deep(case: Moving, drawn: Drawn) -> bool:
    """Whether a strand of a belt whose sag is known came below its limit."""
    return bool(_sagging(case, drawn))


def _sagging(case: Moving, drawn: Drawn) -> list[Extreme]:
    """Lowest tensions of the strands that come below their limits."""
    lows = (drawn.back_min, drawn.carry_min)
    return [low for low, limit in zip(lows, limits(case), strict=True) if limit > 0 and low.value < limit]


def trusted_window(case: Moving, drawn: Drawn) -> float:
    """How long the belt keeps above its limits [s]; 0 if hardly at all."""
    back, carry = (limit if limit > 0 else -math.inf for limit in limits(case))
    deep = (drawn.lows < (back, carry)).any(axis=1)
    end = (int(np.argmax(deep)) - _FRONT_STEPS) * float(drawn.times[1])
    return end if end > _FRONT_STEPS * float(drawn.times[1]) else 0.0


def certain(case: Moving, whole: Mapping[str, Found], early: Mapping[str, Found], window: float) -> dict[str, Found]:
    """Loads of a run that is trusted up to a time only, by those it has up to then; none where that is at once.

    A stop or a jam begins with even running: its loads are at least as bad as there.
    """
    even = {} if isinstance(case.scene, Start) else tension_loads.even_loads(case.line)
    kept = case.line.keeps_run_off and not case.spec.takeup_weight  # a tension that the take-up keeps
    found = {}
    for name, one in whole.items():
        value, begins = one.estimate.value, even.get(name)
        known = early[name].estimate if name in early else Estimate.unknown(value)
        if family(name) in OF_STOP:
            if known.bounded:
                found[name] = early[name]
                continue
            known = Estimate.exact(window if name == "stop_time" else 0.0)
        if name == "tension_run_off_min" and kept:
            found[name] = one
        elif family(name) in _FALLING:
            high = min(known.high, math.inf if begins is None else begins)
            found[name] = Found(Estimate(min(value, high), -math.inf, high, known.numerical, math.inf), one.at)
        else:
            least = 0.0 if family(name) in SLIPS else -math.inf
            low = max(known.low, least if begins is None else begins)
            found[name] = Found(Estimate(max(value, low), low, math.inf, known.numerical, math.inf), one.at)
    return found


def finding(case: Moving, drawn: Drawn, window: float) -> Finding:
    """Where and when it sags too deep, and what is known nevertheless."""
    low = min(_sagging(case, drawn), key=lambda one: one.value)
    does = "goes slack" if low.value < 0 else "sags by more than a tenth of the idler pitch"
    return taut(f"{does}, most at {low.time:.3g} s, {low.place:.4g} m after the drive pulley", window)


def slack(case: Moving, grids: Iterable[Drawn]) -> Iterator[Failure]:
    """A belt that surely goes slack: on every grid its spans sag by twice the tenth that is trusted, or more.

        S < min(S_tenth/2, S_slack)   on a strand, by each grid of the run

    **Range** a belt with idler pitches whose run has left the range of shallow spans.
    **Error** the factor 2 is an engineering choice; the peaks of such a run have no bound.
    **Source** sag of a shallow parabola goes with 1/S.
    """
    doubtless = [limit / 2 for limit in _least_limits(case)]
    lows = [(one.back_min, one.carry_min) for one in grids]
    for strand, (limit, kept) in enumerate(zip(doubtless, tension_loads.slack_limits(case.line), strict=True)):
        kept = min(kept, 2 * limit * sag.DEEPEST / case.line.slack_sag) if case.line.by_length else kept
        if limit > 0 and lows and all(low[strand].value < min(limit, kept) for low in lows):
            low = lows[-1][strand]
            does = f"at {low.time:.3g} s its tension is lowest, {low.place:.4g} m after the drive pulley"
            cure = "a higher `tension` keeps the belt taut"
            yield Failure("CNV105", f"the belt goes slack: {does}", ("takeup", "tension"), cure)
            return


def taut(does: str, window: float) -> Finding:
    """What a belt does that its tension is too low for, and how long it was trusted [s]."""
    known = f"only results of the first {window:.3g} s are reliable" if window else "no peak is reliable"
    return Finding(
        "NUM102", f"the belt {does}; {known}", ("takeup", "tension"), "a higher `tension` keeps the belt taut"
    )
