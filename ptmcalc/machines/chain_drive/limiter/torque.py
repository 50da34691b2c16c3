"""Torque through a limiter between gear and driving sprocket, from the tensions on both sides of the sprocket."""

import math
from dataclasses import dataclass

import numpy as np

from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.laws import chain_resonance, loop_bounds
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.chain_drive.machine.layout import ConveyorLayout
from ptmcalc.machines.chain_drive.machine.model import mean_arm, radius
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, ChainScene
from ptmcalc.machines.chain_drive.starting.motion import Swinging, ratios
from ptmcalc.machines.chain_drive.starting.waves import natural_frequencies
from ptmcalc.numerics.mode_sum import Modes, Peaks

_ENDS = ((CARRY, np.ones(1)), (RETURN, np.zeros(1)))
"""Sections on both sides of the driving sprocket: where the chain enters, and where it leaves."""


@dataclass(frozen=True, slots=True)
class Arms:
    """Lever arms of the tensions on the sprocket shaft over the passage of a tooth: smallest, mean and largest [m].

    They are `equal` on both sides of a half turn over an even number of teeth.
    """

    least: float
    mean: float
    most: float
    equal: bool

    def torque(self, pull: Interval, leaving: Interval) -> Interval:
        """Torque of a difference of both tensions, at whatever arms [N*m].

        r S_on - r' S_off,   r and r' between r cos(pi/z) and r;   r = r' on an even half turn
        """
        ends = [arm * end for arm in (self.least, self.most) for end in (pull.low, pull.high)]
        low, high = min(ends), max(ends)
        if self.equal:
            return Interval(low, high)
        apart = (self.most - self.least) * max(leaving.high, 0.0)
        return Interval(low - apart, high + apart)


def arms(spec: ChainDrive) -> Arms:
    """Arms of the driving sprocket."""
    most, teeth = radius(spec), spec.sprocket.teeth
    even = isinstance(spec.layout, ConveyorLayout) and teeth % 2 == 0
    return Arms(most * math.cos(math.pi / teeth), mean_arm(spec), most, even)


def of_pull(spec: ChainDrive, pull: Estimate, leaving: Interval) -> Estimate:
    """Torque of the largest difference of both tensions; its value is that at the mean arm [N*m]."""
    lever = arms(spec)
    value = lever.mean * pull.value
    if not pull.bounded:
        return Estimate.unknown(value)
    ends = lever.torque(Interval(pull.low, pull.high), leaving)
    numerical = lever.mean * pull.numerical
    bar = max(value - ends.low, ends.high - value)
    return Estimate(value, ends.low, ends.high, numerical, max(bar - numerical, 0.0))


def larger(forward: Estimate, backward: Estimate) -> Estimate:
    """The larger of the torques in both directions: a limiter trips in either."""
    top = forward if forward.value >= backward.value else backward
    low, high = max(forward.low, backward.low), max(forward.high, backward.high)
    return Estimate(top.value, low, high, top.numerical, top.model)


def negative(one: Estimate) -> Estimate:
    """The same in the other direction."""
    return Estimate(-one.value, -one.high, -one.low, one.numerical, one.model)


# -- modes ----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Through:
    """How the force through the limiter follows from the tensions: c times their difference, and b times the course."""

    of_tensions: float
    of_course: float


def modes_through(spec: ChainDrive, scene: ChainScene, case: Swinging, count: int, through: Through) -> Modes:
    """Modes of the force through the limiter over the acceleration of the rigid body, one place [kg].

    (F - F_0)/a = c (r_on - r_off) q + b q + c sum (M_on,k - M_off,k) (x_k - q)
    """
    w, c = natural_frequencies(case, count), through.of_tensions
    on, off = (chain_resonance.modal_tensions(case.masses, w, *end) for end in _ENDS)
    whole_on, whole_off = (loop_bounds.quasi_static(case.masses, *end) for end in _ENDS)
    rest = sum(chain_resonance.modal_rest(case.masses, w, *end) for end in _ENDS)
    whole = c * (whole_on - whole_off) + through.of_course
    return Modes(w, ratios(spec, scene, w), c * (on - off), whole, np.asarray(c * rest))


def extremes(peaks: Peaks, scale: float, base: float, after: float) -> tuple[Estimate, Estimate]:
    """Largest and smallest force over the whole motion, with what may come behind the window of its modes [N]."""

    def estimate(value: float, low: float, high: float) -> Estimate:
        return Estimate(base + value, base + low, base + high, numerical=max(value - low, high - value))

    most = estimate(*(scale * float(one[0]) for one in (peaks.largest, peaks.largest_low, peaks.largest_high)))
    least = estimate(*(scale * float(one[0]) for one in (peaks.smallest, peaks.smallest_low, peaks.smallest_high)))
    more, less = max(base + after - most.high, 0.0), max(least.low - (base - after), 0.0)
    return (
        Estimate(most.value, most.low, most.high + more, most.numerical, more),
        Estimate(least.value, least.low - less, least.high, least.numerical, less),
    )
