"""Many cycles at once: what a cycle changes is a smooth function of the energy it begins with, known from a few.

Over a factor of 2 of the energy the change of e = w^2/2 in a cycle, and its duration, are polynomials through the
cycles that begin at Chebyshev points. The cycles in between are then steps of a map and cost next to nothing; where the
polynomials do not settle (corners that come and go), nothing is skipped.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptmcalc.numerics.cycle import Orbit

FloatArray = NDArray[np.float64]
WholeCycle = Callable[[float], tuple[Orbit, float] | None]
"""The motion over a cycle that begins with e, and its duration [s]; None where it does not go through."""

FEWEST = 60
"""Cycles below which each is followed on its own."""
_SHARE = 0.05  # of the range is left at the end towards which e goes, to be followed cycle by cycle
_KEPT = 60
"""Points of the time history kept of the skipped cycles, about [1]. An engineering choice: more points draw smoother
curves and take memory. No load depends on it."""


@dataclass(frozen=True)
class Skipped:
    """Cycles that were stepped over: how many, their duration [s], e behind them, some (time, turns, e) on the way."""

    cycles: int
    duration: float
    energy: float
    trace: tuple[tuple[float, int, float], ...]
    orbits: tuple[Orbit, ...]
    """the cycles the polynomials go through"""


def skip(once: WholeCycle, begin: float, end: float, most: int, nodes: int, tolerance: float) -> Skipped | None:
    """The cycles from an energy towards another one, as long as a whole one fits in between.

    Args:
        once: a cycle from its beginning to its end.
        begin: e at the beginning [rad^2/s^2].
        end: e towards which it goes; the last part of the way is left.
        most: number of cycles after which it is given up.
        nodes: cycles the polynomials go through.
        tolerance: last coefficients of the polynomials over the largest.

    Returns:
        What was skipped; None where there are too few cycles, or the polynomials do not settle.
    """
    places = np.cos(np.pi * (np.arange(nodes) + 0.5) / nodes)
    energies = (begin + end) / 2 + (begin - end) / 2 * places
    orbits, changes, times = [], [], []
    for e in energies.tolist():
        found = once(e)
        if found is None:
            return None
        orbits.append(found[0])
        changes.append(float(found[0].within([1.0])[-1, 0]) - e)
        times.append(found[1])
    change, time = (np.array(values) for values in (changes, times))
    if np.any(change * (end - begin) <= 0) or abs(end - begin) < FEWEST * float(np.abs(change).max()):
        return None
    matrix = np.polynomial.chebyshev.chebvander(places, nodes - 1)
    both = np.linalg.solve(matrix, np.stack([change, time], axis=1))
    if np.any(np.abs(both[-2:]).max(axis=0) > tolerance * np.abs(both).max(axis=0)):
        return None
    return _stepped(both.T.tolist(), begin, end, most, tuple(orbits))


def _stepped(
    polynomials: list[list[float]], begin: float, end: float, most: int, orbits: tuple[Orbit, ...]
) -> Skipped | None:
    """The steps of the map, until the rest of the way is a small share of it."""
    of_change, of_time = polynomials
    e, time, count = begin, 0.0, 0
    middle, half, last = (begin + end) / 2, (begin - end) / 2, -1 + 2 * _SHARE
    trace = [(0.0, 0, begin)]
    while True:
        x = (e - middle) / half
        if x <= last:
            break
        e, time, count = e + _value(of_change, x), time + _value(of_time, x), count + 1
        trace.append((time, count, e))
        if count > most:
            return None
    kept = trace[:: max(len(trace) // _KEPT, 1)]
    return Skipped(count, time, e, tuple(kept), orbits) if math.isfinite(e) and count else None


def _value(coefficients: list[float], x: float) -> float:
    """A Chebyshev series (Clenshaw)."""
    b0 = b1 = 0.0
    for c in reversed(coefficients[1:]):
        b0, b1 = c + 2 * x * b0 - b1, b0
    return coefficients[0] + x * b0 - b1
