"""A motion as it is kept: polynomials over steps, and what is read from them."""

import math
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import groupby

import numpy as np
from numpy.typing import NDArray

from ptmcalc.numerics import panels
from ptmcalc.numerics.collocation import integrals
from ptmcalc.numerics.extremes import Extremes, reach_of
from ptmcalc.numerics.pendulum.equations import Leg
from ptmcalc.numerics.record import Event

FloatArray = NDArray[np.float64]

HALVES = 2
"""Panels that are looked at in a step."""
PLACES = np.concatenate([(k + panels.NODES) / HALVES for k in range(HALVES)])


@dataclass(frozen=True, slots=True)
class Step:
    leg: Leg
    start: float
    length: float
    used: float
    """share of it up to the event that ended it"""
    state: FloatArray
    row: FloatArray
    """Legendre coefficients of the derivative, shape (states, nodes)"""

    @property
    def end(self) -> float:
        return self.start + self.used * self.length

    def states(self, share: FloatArray) -> FloatArray:
        """States at shares of the step, shape (states, shares)."""
        return self._moved(integrals(self.row.shape[1], share))

    def looked_at(self) -> FloatArray:
        """States at the places of all panels of the step, shape (states, places)."""
        return self._moved(_basis(self.row.shape[1]))

    def last(self) -> FloatArray:
        """State where it ends: over a whole step all polynomials but the first integrate to nothing."""
        if self.used == 1.0:
            return np.asarray(self.state + self.length * self.row[:, 0])
        return self.states(np.array([self.used]))[:, 0]

    def _moved(self, basis: FloatArray) -> FloatArray:
        return np.asarray(self.state[:, None] + self.length * (self.row @ basis.T))


@lru_cache
def _basis(order: int) -> FloatArray:
    """`integrals` at the places of all panels: the same in every step."""
    return integrals(order, PLACES)


def _bases(order: int, share: FloatArray) -> FloatArray:
    """`integrals` at shares of steps, shape (steps, shares, order); those at the places of all panels are known."""
    if share.shape[1] != len(PLACES):
        return integrals(order, share)
    known = (share == PLACES).all(axis=1)
    bases = np.empty((*share.shape, order))
    bases[known] = _basis(order)
    bases[~known] = integrals(order, share[~known])
    return bases


def states_of(steps: Sequence[Step], share: FloatArray) -> FloatArray:
    """States at shares of each of several steps, shape (states, steps * shares): all at once, as there are many."""
    rows, began = np.stack([step.row for step in steps]), np.stack([step.state for step in steps])
    length = np.array([step.length for step in steps])[:, None, None]
    moved = rows @ _bases(rows.shape[2], share).swapaxes(1, 2)
    return np.concatenate(began[:, :, None] + length * moved, axis=1)


def _states_at(steps: Sequence[Step], which: NDArray[np.intp], times: FloatArray) -> FloatArray:
    """States at times that lie each in one of several steps, shape (states, times)."""
    begins, length, used = np.array([(step.start, step.length, step.used) for step in steps]).T[:, which]
    share = np.divide(times - begins, length, out=np.zeros(len(times)), where=length > 0)
    basis = integrals(steps[0].row.shape[1], np.clip(share, 0.0, used))
    moved = np.einsum("tsn,tn->st", np.stack([step.row for step in steps])[which], basis)
    return np.asarray(np.stack([step.state for step in steps])[which].T + length * moved)


@dataclass(frozen=True, slots=True)
class Track:
    """One run."""

    steps: list[Step]
    events: tuple[Event, ...]
    finished: str
    _starts: list[float] = field(repr=False)
    jerks: dict[str, float]
    """work done at once"""

    def index(self, time: float) -> int:
        return max(bisect_right(self._starts, time) - 1, 0)

    def runs(self, since: float, until: float) -> Iterator[tuple[Leg, list[Step]]]:
        """Steps that share their equations."""
        row: list[Step] = []
        for step in self.steps[self.index(since) : self.index(until) + 1]:
            if row and row[-1].leg is not step.leg:
                yield row[-1].leg, row
                row = []
            row.append(step)
        if row:
            yield row[-1].leg, row

    def at(self, names: tuple[str, ...], times: FloatArray) -> FloatArray:
        """Signals at times, shape (names, times); the later side at an event."""
        result = np.empty((len(names), len(times)))
        where = np.maximum(np.searchsorted(self._starts, times, "right") - 1, 0)
        used, which = np.unique(where, return_inverse=True)
        for _, alike in groupby(enumerate(self.steps[k] for k in used), lambda one: id(one[1].leg)):
            numbers, steps = zip(*alike, strict=True)
            inside = (numbers[0] <= which) & (which <= numbers[-1])
            states = _states_at(steps, which[inside] - numbers[0], times[inside])
            result[:, inside] = steps[0].leg.signals(names, times[inside], states)
        return result

    def extremes(
        self, name: str, signs: tuple[int, ...], since: float, until: float
    ) -> tuple[list[tuple[float, float]], float]:
        """Largest value (sign 1) or smallest value (sign -1) with its time, for each sign, and the largest magnitude
        met."""
        found, size = [Extremes.of(1, sign) for sign in signs], 0.0
        for leg, steps in self.runs(since, until):
            inside = [step for step in steps if min(until, step.end) >= max(since, step.start)]
            if not inside:
                continue
            begin, length, used = np.array([(step.start, step.length, step.used) for step in inside]).T
            low, high = np.maximum(since, begin), np.minimum(until, begin + used * length)
            passed = (low - begin)[:, None] + (high - low)[:, None] * PLACES
            share = np.clip(passed / np.where(length > 0, length, math.inf)[:, None], 0.0, used[:, None])
            share[(used == 1) & (low == begin) & (high == begin + length) & (length > 0)] = PLACES
            times = low[:, None] + (high - low)[:, None] * PLACES
            values = leg.signals((name,), times.ravel(), states_of(inside, share))[0]
            size = max(size, float(np.abs(values).max()))
            span = (high - low) / HALVES
            starts = (low[:, None] + span[:, None] * np.arange(HALVES)).ravel()
            watch, spans = values.reshape(-1, panels.COUNT, 1), np.repeat(span, HALVES)
            reach = reach_of(watch)
            for one in found:
                one.see(starts, spans, watch, reach=reach)
        for one in found:
            one.settle()
        return [(float(one.values[0]), float(one.at[0])) for one in found], size

    def crossing(self, name: str, level: float, since: float, rising: bool) -> float | None:
        """The first time from `since` on at which a signal goes through a level, or None."""
        sign = -1 if rising else 1
        for step in self.steps[self.index(since) :]:
            begin, end = max(since, step.start), step.end
            if not end > begin:
                continue
            span = end - begin
            for half in range(HALVES):
                low = begin + half * span / HALVES
                times = low + span / HALVES * panels.NODES
                share = np.clip((times - step.start) / step.length, 0.0, step.used)
                values = sign * (step.leg.signals((name,), times, step.states(share))[0] - level)
                above, below = values[:-1] > 0, values[1:] <= 0
                if (above & below).any():
                    first = int(np.argmax(above & below))
                    place = panels.root(values, float(panels.NODES[first]), float(panels.NODES[first + 1]))
                    return low + span / HALVES * place
        return None

    def polished(self, name: str, value: float, time: float, since: float, until: float) -> float:
        """The signal itself at the place of a peak, from whichever side is nearer to what was seen."""
        best = math.inf, value
        near = 4 * float(np.spacing(time))  # the place of a peak is rounded, and so is the end of its step
        for index in {self.index(time - near), self.index(time + near)}:
            step = self.steps[index]
            if since <= time <= until and step.length:
                share = np.clip(np.array([(time - step.start) / step.length]), 0.0, step.used)
                seen = float(step.leg.signals((name,), np.array([time]), step.states(share))[0, 0])
                best = min(best, (abs(seen - value), seen))
        return best[1]
