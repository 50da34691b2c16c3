"""Modes of a chain whose sprocket changes its speed: tooth after tooth, each pass with a map of its own.

The chain's way in pitches is a given smooth function between kinks; a joint engages wherever it passes a whole number.
Passes are carried in groups that are cut as finely as the longest of each asks for, so a slow beginning does not make a
fast end dear.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.distinct import distinct
from ptmcalc.numerics.run_through import run_through

FloatArray = NDArray[np.float64]
Inputs = Callable[[FloatArray, FloatArray], FloatArray]
"""Values at times, shape (passes, any), in passes with these middles, shape (passes,)."""

MOST_PASSES = 20_000
_GROUP = 200_000
"""Passes times stretches times modes that are carried at a time."""
_STRETCH = 2.0
"""Turn or fading of the fastest mode over a stretch."""
_ORDERS = 8, 6
_FEWEST = 8
_HALVINGS = 60


def engagements(pitches: Callable[[FloatArray], FloatArray], window: float, lead: float) -> FloatArray:
    """Times in (0, window] at which a rising way in pitches, plus a lead, passes whole numbers.

    Raises:
        NumericsError: NUM101 for more than MOST_PASSES.
    """
    count = math.floor(float(pitches(np.array([window]))[0]) + lead)
    if count > MOST_PASSES:
        raise NumericsError("NUM101", f"{count} tooth passes in {window:.4g} s")
    wanted = np.arange(1, count + 1) - lead
    low, high = np.zeros(count), np.full(count, window)
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        before = pitches(middle) < wanted
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    return np.asarray((low + high) / 2)


def passes(window: float, *kinks: FloatArray) -> FloatArray:
    """Edges of passes: both ends of the window, and all kinks in it."""
    times = np.concatenate([[0.0, window], *kinks])
    times = distinct(times[(times >= 0) & (times <= window)])
    return np.asarray(times[np.append(True, np.diff(times) > 1e-12 * window)])


@dataclass(frozen=True, slots=True)
class Passing:
    """Largest and smallest sum at every place over all passes with their times, and the most by which either may be
    wrong, shape (places,); the largest that each mode followed, shape (k,); the places looked at."""

    largest: FloatArray
    largest_time: FloatArray
    smallest: FloatArray
    smallest_time: FloatArray
    error: FloatArray
    followed: FloatArray
    work: int


def tooth_passes(
    edges: FloatArray,
    inputs: Inputs,
    frequencies: FloatArray,
    damping_ratios: FloatArray,
    gains: FloatArray,
    direct: Inputs | None = None,
    watch: Callable[[FloatArray, FloatArray], None] | None = None,
) -> Passing:
    """Extremes of sums of modes that follow accelerations which jump at every engagement.

        S_i = sum g_ki x_k + direct_i,   x_k'' + 2 zeta w x_k' + w^2 x_k = w^2 a_k + 2 zeta w a_k'

    Args:
        edges: of the passes, shape (passes + 1,) [s].
        inputs: a_k of every mode, (passes, any, k); smooth within a pass.
        frequencies: w, above 0, shape (k,) [rad/s].
        damping_ratios: zeta, also above 1, shape (k,) [1].
        gains: g, shape (k, places).
        direct: what is added at every place, (passes, any, places).
        watch: is told all that was looked at, group by group: times, and sums of shape (times, places).

    Returns:
        the extremes; 0, the state before, counts.

    **Error** told: what the quadrature misses, and twice what a parabola rises above the sample beside its summit.
    **Source** `numerics.run_through`, passes between engagements and kinks.
    """
    count, places = gains.shape
    fastest = float(np.max(frequencies * np.maximum(1.0, 2 * damping_ratios)))
    state, lengths = np.zeros((count, 2)), np.diff(edges)
    (best, at), missed = np.zeros((2, 2, places)), np.zeros(places)
    error, followed, work, first = np.zeros(count), np.zeros(count), 0, 0
    while first < len(lengths):
        last, stretches = _group(lengths, first, fastest, count)
        part = edges[first : last + 1]
        middles = (part[1:] + part[:-1]) / 2
        run = run_through(part, _since(part, middles, inputs), frequencies, damping_ratios, stretches, state, _ORDERS)
        state, error, work = run.end, error + run.error, work + run.times.size * count
        pulls = run.force(np.eye(count))  # x_k, (passes, places in time, k)
        followed = np.maximum(followed, np.abs(pulls).max(axis=(0, 1)))
        sums = pulls @ gains
        if direct is not None:
            sums = sums + direct(run.times, middles)
        flat, times = sums.reshape(-1, places), run.times.ravel()
        if watch is not None:
            watch(times, flat)
        for side, sign in enumerate((1.0, -1.0)):
            where = (sign * flat).argmax(axis=0)
            tops = sign * flat[where, np.arange(places)]
            better = np.flatnonzero(tops > best[side])
            best[side, better], at[side, better] = tops[better], times[where[better]]
            missed[better] = np.maximum(missed[better], _risen(sums, where)[better])
        first = last
    off = np.abs(gains).T @ error + missed
    return Passing(best[0], at[0], -best[1], at[1], off, followed, work)


def _risen(sums: FloatArray, where: FloatArray) -> FloatArray:
    """What summits beside samples may rise above them: a quarter of the second difference there, twice what a parabola
    does."""
    samples, places = sums.shape[1:]
    row, column = np.divmod(where, samples)
    inner = np.clip(column, 1, samples - 2)
    at = np.arange(places)
    second = sums[row, inner - 1, at] - 2 * sums[row, inner, at] + sums[row, inner + 1, at]
    return np.asarray(np.abs(second) / 4)


def _group(lengths: FloatArray, first: int, fastest: float, modes: int) -> tuple[int, int]:
    """End of a group of passes from the first on, and the stretches of each."""
    longest, last = 0.0, first
    stretches = _FEWEST
    while last < len(lengths):
        longest = max(longest, float(lengths[last]))
        wanted = max(math.ceil(fastest * longest / _STRETCH), _FEWEST)
        if last > first and (last + 1 - first) * wanted * modes > _GROUP:
            break
        last, stretches = last + 1, wanted
    return last, stretches


def _since(edges: FloatArray, middles: FloatArray, inputs: Inputs) -> Callable[[FloatArray], FloatArray]:
    """The inputs at times since the beginning of each pass."""
    return lambda inside: inputs(edges[:-1, None] + inside, middles)
