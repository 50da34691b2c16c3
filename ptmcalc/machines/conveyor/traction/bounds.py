"""How far the grip of a drum may be off when the tensions at it may be.

With S_on and S_off less the centrifugal tension, the grip used at any time is U = e max(S_on/S_off, S_off/S_on) with
e = exp(-mu alpha), and the tensions may be off by c and c_off. While the run-on is the tight side, its slack side is
the run-off, no less than the least x there is; where the run-off is the tight one, the run-on is no less than
y = max(x e/U, lowest tension of the belt), nor the run-off above the highest x' there is:

    U' <= max( (U x + c e)/(x - c_off),  min(U y + c_off e, (x' + c_off) e)/(y - c) )
    U' >= min( (U x - c e)/(x + c_off),  (U y - c_off e)/(y + c) )

each fraction being monotone in x and y. The second one of the least drops out where e x'/y < U: the run-off cannot be
the tight side then. The reserve stands for such a ratio too, with no centrifugal tension.

**Range** a belt that does not slip.
**Error** exact but for the tensions of one moment, which are taken as far off in the worst sense.
**Source** Euler-Eytelwein (`laws.capstan`).
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from ptmcalc.base.estimate import ANYTHING, Estimate, Interval
from ptmcalc.contract.result import family
from ptmcalc.laws import capstan

_ROUNDING = 1e-9
"""Relative tolerance of a comparison of two traction ratios [1], far above the resolution 2e-16 of the floating point.
It keeps the bound where both are equal, as with a constant leaving tension. A smaller value loses that bound to
rounding; a larger one widens the interval without need."""


@dataclass(frozen=True, slots=True)
class Drum:
    """What is known of the tensions at a drum [N]: the least and the highest x and x' of the run-off, the lowest
    tension of the belt, and by how much a tension and that of the run-off may be off."""

    off: Interval
    lowest: float
    change: float
    change_off: float

    def less(self, lift: float) -> "Drum":
        """The same with the centrifugal tension [N] taken off."""
        return Drum(Interval(self.off.low - lift, self.off.high - lift), self.lowest - lift, self.change,
                    self.change_off)  # fmt: skip

    def moved(self, used: Interval, squeeze: float) -> Interval:
        """The grip used, known to lie in an interval, with all that the tensions may be off by; `squeeze` is e."""
        change, change_off, off = self.change, self.change_off, self.off.low
        least, most = used.low, used.high
        if not off > change_off:
            return Interval(0.0, math.inf)
        on = max(off * squeeze / most if most > 0 else 0.0, self.lowest)
        high = (most * off + change * squeeze) / (off - change_off)
        low = (least * off - change * squeeze) / (off + change_off)
        turned = min(most * on + change_off * squeeze, (self.off.high + change_off) * squeeze)
        high = max(high, turned / (on - change) if on > change else math.inf)
        if self.off.high * squeeze * (1 + _ROUNDING) >= least * on:  # equal where a constant run-off is the tight side
            low = min(low, (least * on - change_off * squeeze) / (on + change) if on > 0 else 0.0)
        return Interval(max(low, 0.0), high)


def moved_grip(
    name: str, loads: Mapping[str, Estimate], lift: float, grips: Mapping[str, float], change: float, change_off: float
) -> Interval:
    """Offsets of the grip used or the reserve of grip at a drum, or at the worst of several.

    Args:
        name: the load.
        loads: it, the least run-off tension of the drum and the lowest and highest of the belt.
        lift: largest centrifugal tension [N].
        grips: mu alpha of the drums.
        change: how far any tension may be off [N].
        change_off: how far the run-off tension may be [N].
    """
    kind, _, drum = name.partition("[")
    load, reserve = loads[name], kind == "slip_reserve_min"
    exponents = [grips[drum[:-1]]] if drum and drum[:-1] in grips else list(grips.values())
    if not exponents or not (math.isfinite(load.value) or (reserve and load.value > 0)):
        return ANYTHING
    own = name.replace(kind, "tension_run_off_min", 1)
    offs = [loads[own]] if own in loads and drum else [
        one for other, one in loads.items() if family(other) == "tension_run_off_min"
    ]  # fmt: skip
    lowest = loads["tension_min"].low if "tension_min" in loads else -math.inf
    highest = loads["tension_max"].high if "tension_max" in loads else math.inf
    slack = min((one.low for one in offs), default=-math.inf)
    steady = max((one.high for one in offs), default=math.inf)
    known = Drum(Interval(slack, highest if change_off else steady), lowest, change, change_off)
    found = [_reserve(known, load, one) if reserve else _used(known.less(lift), load, one) for one in exponents]
    return Interval(min(one.low for one in found), max(one.high for one in found))


def _used(drum: Drum, load: Estimate, exponent: float) -> Interval:
    moved = drum.moved(Interval(load.low, load.high), math.exp(-exponent))
    return _offsets(load, moved)


def _reserve(drum: Drum, load: Estimate, exponent: float) -> Interval:
    if load.high <= 0:
        return ANYTHING  # a side without tension: how far it is from some the load does not tell
    most, least = (capstan.slip_ratio(end, exponent) if end > 0 else math.inf for end in (load.low, load.high))
    moved = drum.moved(Interval(least, most), math.exp(-exponent))
    low, high = (capstan.slip_reserve_ratio(end, exponent) for end in (moved.high, moved.low))
    return _offsets(load, Interval(low, high))


def _offsets(load: Estimate, moved: Interval) -> Interval:
    """How far the ends of a load moved; one without an end stays there."""
    low = 0.0 if moved.low >= load.low else moved.low - load.low
    if math.isfinite(load.high):
        return Interval(low, max(moved.high - load.high, 0.0))
    return Interval(low, 0.0 if load.low == load.high else math.inf)
