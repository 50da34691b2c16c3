"""How far the ends of error bars must move to hold the loads of a main shaft."""

import math
from collections.abc import Mapping

from ptmcalc.base.estimate import ANYTHING, Estimate, Interval

Loads = Mapping[str, Estimate]
Offsets = Mapping[str, Interval]

_CLOSED = frozenset({"kinetic_energy", "speed_run_out", "torque_starting", "acceleration_starting"})
"""Loads that no effect changes: they are of the moment at which the motion begins."""


def offsets(held_in: Mapping[str, Interval], loads: Loads) -> dict[str, Interval]:
    """How far the ends of each load's bar must move to hold an interval."""
    return {
        name: Interval(_less(interval.low, loads[name].low, -1), _less(interval.high, loads[name].high, 1))
        for name, interval in held_in.items()
        if name in loads
    }


def _less(end: float, bar: float, side: int) -> float:
    if end == bar or not math.isfinite(bar):
        return 0.0
    moved = end - bar
    return max(moved, 0.0) if side > 0 else min(moved, 0.0)


def unknown(names: frozenset[str], loads: Loads) -> Offsets:
    """Offsets that leave nothing known of these loads but those of the moment at which the motion begins."""
    return {name: ANYTHING for name in names - _CLOSED if name in loads}
