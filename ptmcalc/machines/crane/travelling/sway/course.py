"""What a start or a stop is made of, as loads read it: the states the crane goes through, and bars.

A phase in which one thing drives or stops the crane has a least and a largest pull of the load. Acceleration and
traction are straight functions of the pull, so whatever depends on them has its extremes at the ends of the pull, and a
bar of the pull is carried through to it. A simulated course has states over time instead (`simulated`).
"""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.machines.crane.travelling.machine.model import State

FloatArray = NDArray[np.float64]


Reading = Callable[[State], FloatArray]
"""A load by the state of the crane, arrays alike."""


@dataclass(frozen=True, slots=True)
class Phase:
    """A stretch in which one thing drives or stops the crane."""

    name: str
    pulls: tuple[Estimate, Estimate]
    """least and largest force of the load on the crane, against the travel [N]"""
    weight: Interval
    """of the load on the crane, downwards: what the bars let it be [N]"""
    rest_weight: float
    """of the load at rest [N]"""
    acceleration: Callable[[FloatArray], FloatArray]
    """of the crane, by the pull [m/s^2]"""
    traction: Callable[[FloatArray], FloatArray]
    """of the driven wheels on the crane, by the pull [N]"""
    wind: float
    """on what travels, against the travel [N]"""

    def states(self, pulls: FloatArray, weights: FloatArray) -> State:
        """The crane under pulls."""
        return State(self.acceleration(pulls), pulls, weights, self.traction(pulls), np.full(len(pulls), self.wind))


class Worst(NamedTuple):
    """The extreme of a load, and where it stands."""

    estimate: Estimate
    phase: str
    state: State


@dataclass(frozen=True, slots=True)
class Course:
    """A start or a stop as loads read it."""

    time: Estimate
    """until full speed or rest [s]"""
    distance: Estimate
    """travelled by then [m]"""
    sway: Estimate
    """largest angle of the load from the plumb line [rad]"""
    residual: Estimate
    """angle in which the load swings on afterwards [rad]"""
    phases: tuple[Phase, ...]
    work: int = 1
    """pieces of motion that were reckoned"""

    def extreme(self, of: Reading, largest: bool) -> Worst:
        """Largest or least of something over all phases."""
        found = [
            Worst(_at_end(phase, pull, of), phase.name, phase.states(*_rest(phase, pull)))
            for phase in self.phases
            for pull in phase.pulls
        ]
        pick = max if largest else min
        best = pick(found, key=lambda one: one.estimate.value)
        return best._replace(estimate=extreme([one.estimate for one in found], largest))


def _rest(phase: Phase, pull: Estimate) -> tuple[FloatArray, FloatArray]:
    return np.array([pull.value]), np.array([phase.rest_weight])


def _at_end(phase: Phase, pull: Estimate, of: Reading) -> Estimate:
    """Something at one end of the pull, with what the bars of pull and weight make of it."""
    value = float(of(phase.states(*_rest(phase, pull)))[0])
    if pull.low == pull.high and phase.weight.width == 0:
        return Estimate.exact(value)
    if not pull.bounded:
        return Estimate.unknown(value)
    pulls = np.array([pull.low, pull.low, pull.high, pull.high])
    weights = np.array([phase.weight.low, phase.weight.high] * 2)
    corners = of(phase.states(pulls, weights))
    low, high = min(value, float(corners.min())), max(value, float(corners.max()))
    return between(value, low, high, pull.numerical / abs(pull.value or 1.0))


def between(value: float, low: float, high: float, numerical_share: float = 0.0) -> Estimate:
    """A number between two others; how much of the bar is numerical goes by that of what it was made of."""
    if value == low == high:
        return Estimate.exact(value)
    bar = max(high - value, value - low)
    numerical = min(numerical_share * abs(value), bar) if math.isfinite(bar) else 0.0
    return Estimate(value, low, high, numerical, bar - numerical)


def extreme(found: Iterable[Estimate], largest: bool) -> Estimate:
    """The largest or the least of numbers with bars."""
    pick = max if largest else min
    several = tuple(found)
    best = pick(several, key=lambda one: one.value)
    low, high = pick(one.low for one in several), pick(one.high for one in several)
    return between(best.value, low, high, best.numerical / abs(best.value or 1.0))
