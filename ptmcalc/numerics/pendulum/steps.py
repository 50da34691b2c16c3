"""A smooth stretch of the motion, step by step: Radau collocation, Newton's method, lengths by the tail."""

import math

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.collocation import Rule
from ptmcalc.numerics.pendulum.equations import STATES, Leg
from ptmcalc.numerics.pendulum.track import Step

FloatArray = NDArray[np.float64]

_FIRST, _SHORTEST = 0.3, 1e-12
"""Share of 1/omega that is tried first; shortest step over 1/omega."""
_LONGEST = 4.0
_MOST_ITERATIONS = 14
_MANY = 10
"""Iterations of Newton's method from which on the next step is no longer, and its Jacobian a new one."""
_FURTHER = 0.9


class Stepper:
    """Steps of one order that keep a tolerance; `scale` holds sizes of the states, `omega` the pendulum's frequency."""

    def __init__(self, rule: Rule, tolerance: float, scale: FloatArray, omega: float) -> None:
        self.rule, self.tolerance, self.scale, self.omega = rule, tolerance, scale, omega
        self.reach = _FIRST / omega
        self.inverse: tuple[Leg, float, FloatArray] | None = None
        self.eye = np.eye(rule.order * STATES)

    def step(self, leg: Leg, time: float, state: FloatArray, stop: float) -> Step:
        """One step, at most to a time, with the same equations all along."""
        rule, left = self.rule, stop - time
        if left <= 0:
            return Step(leg, time, 0.0, 1.0, state, np.zeros((STATES, rule.order)))
        length = min(self.reach, _LONGEST / self.omega)
        if left <= 1.3 * length:
            length = left
        while True:
            row, tail, iterations = self._solve(leg, time, state, length)
            if iterations >= _MANY:
                self.inverse = None
            if row is not None and tail <= self.tolerance:
                break
            shrink = _FURTHER * (self.tolerance / tail) ** (1 / rule.order) if row is not None else 0.4
            length *= min(max(shrink, 0.2), 0.8)
            if length < _SHORTEST / self.omega:
                raise NumericsError("NUM101", f"the motion could not be resolved by any step at {time:.6g} s")
        assert row is not None
        grow = _FURTHER * (self.tolerance / max(tail, 1e-30)) ** (1 / rule.order)
        reach = length * min(max(grow, 0.3), 2.5 if iterations < _MANY else 1.0)
        if length < left or reach < self.reach:
            self.reach = reach
        return Step(leg, time, length, 1.0, state, row)

    def _solve(self, leg: Leg, time: float, state: FloatArray, length: float) -> tuple[FloatArray | None, float, int]:
        """Legendre coefficients of the derivative over a step, its tail, and the iterations they took."""
        rule, scale = self.rule, self.scale[:, None]
        times = time + length * rule.nodes
        first = leg.rate(np.array([time]), state[:, None])
        slopes = np.repeat(first, rule.order, axis=1)
        inverse = self._inverse(leg, time, state, length, first)
        before = math.inf
        for iteration in range(1, _MOST_ITERATIONS + 1):
            states = state[:, None] + length * (slopes @ rule.integral.T)
            miss = leg.rate(times, states) - slopes
            change = (inverse @ (miss / scale).ravel()).reshape(miss.shape) * scale
            slopes = slopes + change
            size = float(np.abs(change / scale).max()) * length
            if not math.isfinite(size) or size > 1e3:
                return None, math.inf, iteration
            if size <= 1e-3 * self.tolerance or (size >= 0.5 * before and size <= 0.1 * self.tolerance):
                row = slopes @ rule.to_legendre.T
                return row, float(rule.tail(row / scale).max()) * length, iteration
            if size > 2 * before and size > self.tolerance:
                return None, math.inf, iteration
            before = size
        return None, math.inf, _MOST_ITERATIONS

    def _inverse(self, leg: Leg, time: float, state: FloatArray, length: float, first: FloatArray) -> FloatArray:
        """Of I - h A J in scaled variables, J by differences at the start; kept while the step stays."""
        kept = self.inverse
        if kept is not None and kept[0] is leg and abs(kept[1] - length) <= 0.02 * length:
            return kept[2]
        nudge = 1e-7 * self.scale
        shifted = np.repeat(state[:, None], STATES, axis=1) + np.diag(nudge)
        jacobian = (leg.rate(np.full(STATES, time), shifted) - first) / nudge
        jacobian = jacobian * self.scale / self.scale[:, None]
        inverse = np.linalg.inv(self.eye - length * np.kron(jacobian, self.rule.integral))
        self.inverse = leg, length, inverse
        return inverse
