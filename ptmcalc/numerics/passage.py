"""Motion of one degree of freedom in time, from event to event: Radau collocation of the speed, its integral the angle.

The acceleration is smooth within a phase. A phase ends at a time, at an angle, or where one of its marks changes its
sign (standstill, a wanted speed, a stage of the motor); the last step is made again and again until its end is that
place, so no step ever reaches over one.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.collocation import Rule, gauss, integrals, radau, sampler

FloatArray = NDArray[np.float64]
Acceleration = Callable[[FloatArray, FloatArray, FloatArray], FloatArray]
"""Acceleration [rad/s^2] at times [s], angles [rad] and speeds [rad/s], shape (n,) each."""

_MOST_STEPS, _MOST_NEWTON, _MOST_JACOBIANS, _MOST_CUTS = 200_000, 12, 4, 60
_CONVERGED, _STAGNANT = 1e-14, 1e-11
_LONGEST_TURN = 0.9  # rad a step may turn the shaft by
_GROWTH, _SHRINKAGE = 2.0, 0.2
_SAMPLES = 24
_NUDGE = 1e-6


@dataclass(frozen=True, slots=True)
class State:
    """Where a motion is: time [s], angle [rad], speed [rad/s]."""

    time: float
    angle: float
    speed: float


@dataclass(frozen=True, slots=True)
class Step:
    """One step: where it begins, its duration [s], and the Legendre coefficients of its acceleration."""

    begin: State
    duration: float
    coefficients: FloatArray
    end: State

    def at(self, places: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Times, angles and speeds at places in [0, 1]."""
        return self._from(places, integrals(len(self.coefficients), places))

    def samples(self, count: int) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Times, angles and speeds at places spread evenly over (0, 1]."""
        return self._from(np.arange(1, count + 1) / count, sampler(len(self.coefficients), count))

    def _from(self, places: FloatArray, basis: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        turned = basis @ (radau(len(self.coefficients)).once_integrated @ self.coefficients)
        h = self.duration
        return (
            self.begin.time + h * places,
            self.begin.angle + h * (self.begin.speed * places + h * turned),
            self.begin.speed + h * (basis @ self.coefficients),
        )

    def sample(self, order: int) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray, FloatArray]:
        """Times, angles, speeds, accelerations and weights [s] of a Gauss quadrature over the step."""
        nodes, weights = gauss(order)
        rates = radau(len(self.coefficients)).evaluate(self.coefficients, nodes)
        return (*self.at(nodes), rates, weights * self.duration)


@dataclass(frozen=True, slots=True)
class Phase:
    """A stretch of motion in which the acceleration is smooth, and all that may end it.

    `marks` are functions of time, angle and speed, shape (k, n); the phase ends where one changes its sign.
    """

    acceleration: Acceleration
    marks: Acceleration
    until_time: float = math.inf
    until_angle: float = math.inf


TIME, ANGLE = -1, -2
"""What ended a phase, if it was no mark."""


@dataclass(frozen=True, slots=True)
class Followed:
    """The steps of a phase, where it ended, and what ended it: `TIME`, `ANGLE` or the index of a mark."""

    steps: tuple[Step, ...]
    end: State
    reason: int
    evaluations: int


def follow(phase: Phase, state: State, order: int, tolerance: float, first: float = math.inf) -> Followed:
    """The motion from a state to the end of its phase.

    Args:
        phase: the acceleration and what ends it.
        state: where the motion begins; the speed is not negative.
        order: number of nodes of a step.
        tolerance: what the last coefficients of a step may add to its speed, over the largest speed so far [1].
        first: duration of the first step at most [s].

    Raises:
        NumericsError: the steps become too small or too many.
    """
    rule, count = radau(order), 0
    steps: list[Step] = []
    size = min(first, _turn_time(phase, state))
    largest = state.speed
    while True:
        if len(steps) >= _MOST_STEPS:
            raise NumericsError("NUM103", f"the motion takes more than {_MOST_STEPS} steps")
        step, used = _made(phase, rule, state, size, tolerance, largest)
        count += used
        grown = _GROWTH if step.error == 0 else min((tolerance / step.error) ** (1 / order) * 0.9, _GROWTH)
        size = step.made.duration * max(grown, _SHRINKAGE)
        steps.append(step.made)
        state = step.made.end
        largest = max(largest, state.speed)
        if step.reason is not None:
            return Followed(tuple(steps), state, step.reason, count)
        size = min(size, _turn_time(phase, state))


def _turn_time(phase: Phase, state: State) -> float:
    """Time in which the shaft turns by so much that a step should end, at its present speed and acceleration."""
    here = (np.array([part]) for part in (state.time, state.angle, state.speed))
    a, w = abs(float(phase.acceleration(*here)[0])), state.speed
    if a == 0 and w == 0:
        return math.inf
    return 2 * _LONGEST_TURN / (w + math.sqrt(w * w + 2 * a * _LONGEST_TURN))


@dataclass(frozen=True, slots=True)
class _Made:
    made: Step
    error: float
    reason: int | None


def _made(phase: Phase, rule: Rule, state: State, size: float, tolerance: float, largest: float) -> tuple[_Made, int]:
    """One step of at most a size, cut at whatever ends the phase."""
    count, remaining = 0, phase.until_time - state.time
    for _ in range(_MOST_CUTS):
        reason = TIME if size >= remaining else None
        size = min(size, remaining)
        if size <= 4e-16 * max(abs(state.time), 1e-300) or not math.isfinite(size):
            raise NumericsError("NUM101", f"no step can be made at {state.time:.6g} s")
        solved, used = _collocated(phase, rule, state, size)
        count += used
        if solved is None:
            size /= 4
            continue
        scale = max(largest, solved.end.speed, abs(solved.end.speed - state.speed))
        error = float(rule.tail(solved.coefficients)) * size / scale if scale > 0 else 0.0
        if error > tolerance:
            size *= max(0.9 * (tolerance / error) ** (1 / rule.order), _SHRINKAGE)
            continue
        found = _first_event(phase, solved)
        if found is None:
            return _Made(solved, error, reason), count
        cut, used = _cut(phase, rule, solved, *found)
        count += used
        if cut is not None:
            return _Made(cut, error, found[1]), count
        size *= found[0] / 2
    raise NumericsError("NUM101", f"the end of a phase is not found after {state.time:.6g} s")


def _cut(phase: Phase, rule: Rule, step: Step, place: float, reason: int) -> tuple[Step | None, int]:
    """The step made again with such a size that it ends on an event, None where that does not converge."""
    count, missed = 0, math.inf
    for _ in range(_MOST_NEWTON):
        size = step.duration * place
        made, used = _collocated(phase, rule, step.begin, size)
        count += used
        if made is None:
            return None, count
        step = made
        value, earlier = (_distance(phase, step, at, reason) for at in (1.0, 1.0 - _NUDGE))
        slope = (value - earlier) / _NUDGE
        place = 1 - value / slope if slope != 0 else 1.0
        if not 0 < place < 2:
            return None, count
        before, missed = missed, abs(place - 1)
        if missed <= 1e-13 or (missed <= 1e-9 and missed >= before / 2):  # rounding leaves no more
            angle = phase.until_angle if reason == ANGLE else step.end.angle
            return Step(
                step.begin, step.duration, step.coefficients, State(step.end.time, angle, step.end.speed)
            ), count
    return None, count


def _distance(phase: Phase, step: Step, place: float, reason: int) -> float:
    """What is left to an event at a place of a step."""
    there = step.at(np.array([place]))
    if reason == ANGLE:
        return phase.until_angle - float(there[1][0])
    return float(phase.marks(*there)[reason, 0])


def _collocated(phase: Phase, rule: Rule, state: State, size: float) -> tuple[Step | None, int]:
    """The step of a size, by Newton's method on the speeds at the nodes, or None where it does not converge."""
    times = state.time + size * rule.nodes
    a = rule.integral * size
    count = 0

    def angles(speeds: FloatArray) -> FloatArray:
        return np.asarray(state.angle + a @ speeds)

    start = np.full(rule.order, state.speed)
    here = phase.acceleration(times[:1], np.array([state.angle]), start[:1])
    w = start + size * rule.nodes * here
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        for _ in range(_MOST_JACOBIANS):
            inverse, used = _inverse_jacobian(phase, times, angles(w), w, a)
            count += used
            if inverse is None:
                return None, count
            w, converged, used = _iterated(phase, times, angles, w, start, a, inverse)
            count += used
            if converged:
                rates = phase.acceleration(times, angles(w), w)
                end = State(float(times[-1]), float(angles(w)[-1]), float(w[-1]))
                return Step(state, size, rule.to_legendre @ rates, end), count + rule.order
            if not np.all(np.isfinite(w)):
                break
    return None, count


def _iterated(
    phase: Phase,
    times: FloatArray,
    angles: Callable[[FloatArray], FloatArray],
    w: FloatArray,
    start: FloatArray,
    a: FloatArray,
    inverse: FloatArray,
) -> tuple[FloatArray, bool, int]:
    """Speeds improved as long as one Jacobian does, whether they have converged, and the evaluations.

    With the ratio r of the last two changes, what is left after the last one d is d r/(1 - r).
    """
    change = math.inf
    for turn in range(_MOST_NEWTON):
        rates = phase.acceleration(times, angles(w), w)
        moved = inverse @ (start + a @ rates - w)
        w = w + moved
        before, change = change, float(np.abs(moved).max()) / max(float(np.abs(w).max()), 1e-300)
        if change <= _CONVERGED or (turn > 0 and change * (change / before) <= _CONVERGED):
            return w, True, (turn + 1) * len(w)
        if not change < 0.3 * before:
            return w, change <= _STAGNANT, (turn + 1) * len(w)
    return w, False, _MOST_NEWTON * len(w)


def _inverse_jacobian(
    phase: Phase, times: FloatArray, angles: FloatArray, speeds: FloatArray, a: FloatArray
) -> tuple[FloatArray | None, int]:
    """Inverse of d(w - w_0 - A eps(phi_0 + A w, w))/dw, by differences of the acceleration."""
    by_speed = _NUDGE * max(float(np.abs(speeds).max()), 1e-300)
    n = len(speeds)
    thrice = (
        np.concatenate([times] * 3),
        np.concatenate([angles, angles, angles + _NUDGE]),
        np.concatenate([speeds, speeds + by_speed, speeds]),
    )
    rates = phase.acceleration(*thrice)
    of_speed, of_angle = (rates[n : 2 * n] - rates[:n]) / by_speed, (rates[2 * n :] - rates[:n]) / _NUDGE
    jacobian = np.eye(n) - a @ (np.diag(of_speed) + of_angle[:, None] * a)
    count = 3 * n
    if not np.all(np.isfinite(jacobian)):
        return None, count
    try:
        return np.asarray(np.linalg.inv(jacobian)), count
    except np.linalg.LinAlgError:
        return None, count


def _first_event(phase: Phase, step: Step) -> tuple[float, int] | None:
    """About the first place in a step at which an angle is reached or a mark changes its sign, and which it is."""
    found: list[tuple[float, int]] = []
    times, angles, speeds = step.samples(_SAMPLES)
    if step.end.angle >= phase.until_angle:
        left = phase.until_angle - np.append(step.begin.angle, angles)
        found.append((_crossing(left, int(np.argmax(left <= 0)) - 1), ANGLE))
    begin = (np.array([part]) for part in (step.begin.time, step.begin.angle, step.begin.speed))
    values = np.concatenate([phase.marks(*begin), phase.marks(times, angles, speeds)], axis=1)
    above = values > 0
    starts = np.abs(values[:, 0]) <= 1e-9 * np.abs(values).max(axis=1)  # the event this step begins with is none of it
    above[starts, 0] = above[starts, 1]
    for index in np.flatnonzero((above[:, 1:] != above[:, :-1]).any(axis=1)).tolist():
        first = int(np.argmax(above[index, 1:] != above[index, :-1]))
        found.append((_crossing(values[index], first), index))
    if not found:
        return None
    place, reason = min(found)
    for _ in range(2):
        value, beside = (_distance(phase, step, at, reason) for at in (place, place - _NUDGE))
        if value == beside:
            break
        moved = place - _NUDGE * value / (value - beside)
        if not abs(moved - place) < 1 / _SAMPLES or not 0 < moved < 2:
            break
        place = moved
    return place, reason


def _crossing(values: FloatArray, before: int) -> float:
    """The place of a change of sign behind one of the samples, the first one at the beginning of a step, by a straight
    line."""
    here, after = float(values[before]), float(values[before + 1])
    return (before + (here / (here - after) if here != after else 0.5)) / _SAMPLES
