"""A mode in variables of like size, and stretches of time on which its smooth curves are polynomials.

A nonlinear n is the polynomial through its values at the nodes of a stretch, found by iteration; its slope is put into
A, and a stretch is halved until the last coefficients of what is left fall below the tolerance.
"""

from collections.abc import Hashable

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics import panels
from ptmcalc.numerics.flow import FADED, RESOLVED, Flow
from ptmcalc.numerics.motion import Motion, System
from ptmcalc.numerics.panels import COUNT, NODES, FloatArray

_EPS = float(np.finfo(float).eps)
_MOST_ITERATIONS = 40
_SHORTEST, _LONGEST = 1e-13, 1e6
_FADED_SHARE = 0.1
_WORTH = 40.0
_DIVERGED, _MOST_AHEAD = 8.0, 20.0

_MONOMIALS = np.linalg.inv(NODES[:, None] ** np.arange(COUNT) / np.cumprod([1.0, *range(1, COUNT)]))
"""Coefficients of u^k/k! from node values, u the share of the stretch."""


class Piece:
    """A mode in scaled variables, with the flows it needs."""

    def __init__(self, motion: Motion, system: System, resolved: float) -> None:
        self.motion, self.system, self.resolved = motion, system, resolved
        scale = system.scale
        n = len(scale)
        self.rate = motion.rate * scale / scale[:, None]
        self.gain = motion.gain / scale[:, None]
        self.guards, self.guards_direct = motion.guards[:, :n] * scale, motion.guards[:, n:]
        self.watch, self.watch_direct = motion.watch[:, :n] * scale, motion.watch[:, n:]
        self.arguments = [curve.rows * scale for curve in motion.curves]
        self.reach = np.inf
        self.entry = np.inf
        """stretch that was short enough the last time this mode began"""
        self._flows: dict[Hashable, Flow] = {}
        self._stretches: dict[Hashable, _Stretch] = {}

    @property
    def linear(self) -> Flow:
        """The flow of a mode without curves."""
        flow = self._flows.get("linear")
        if flow is None:
            flow = self._flows["linear"] = Flow(
                self.rate, self.guards, self.watch, self.system.own, self.system.input_speed, resolved=self.resolved
            )
        return flow

    def now(self, state: FloatArray) -> FloatArray:
        """The watched signals of a state."""
        values = [float(curve.value((curve.rows @ state)[:, None])[0]) for curve in self.motion.curves]
        result: FloatArray = self.motion.watch @ np.concatenate([state, values])
        return result

    def stretch(
        self, state: FloatArray, reach: float, longest: float, tolerance: float
    ) -> tuple[Flow, FloatArray, float]:
        """A stretch on which the curves are polynomials of time: its flow, the state that goes with it, its length."""
        slopes = tuple(
            round(curve.slope(rows @ state) / curve.grain) * curve.grain
            for curve, rows in zip(self.motion.curves, self.arguments, strict=True)
        )
        unit = self.resolved / RESOLVED  # a lattice of its own for every `refined`: two runs share no stretch
        span = min(reach, float(unit * 2.0 ** np.ceil(np.log2(longest / unit))), unit * _LONGEST)
        while span > _SHORTEST:
            found = self._solve(state, slopes, span, tolerance)
            if found is not None:
                flow, extended, tail = found
                self.reach = 2 * span if tail < tolerance / 256 else span
                return flow, extended, span
            span /= 2
        raise NumericsError("NUM101", "a nonlinear torque could not be resolved by any step")

    def _solve(
        self, state: FloatArray, slopes: tuple[float, ...], span: float, tolerance: float
    ) -> tuple[Flow, FloatArray, float] | None:
        """Iterate the curves' values at the nodes of a stretch until they fit the motion they cause."""
        key = (slopes, span)
        stretch = self._stretches.get(key)
        if stretch is None:
            stretch = self._stretches[key] = _Stretch(self, slopes, span, tolerance)
        free = stretch.seen_state @ state
        rest = stretch.rest(np.repeat(free.reshape(-1, COUNT)[:, :1], COUNT, axis=1))
        found, change = stretch.rest(stretch.moved(free, rest)), np.inf
        for _ in range(_MOST_ITERATIONS):
            step, before = found - rest, change
            change = float((np.abs(step) / stretch.sizes).max())
            if not change <= _DIVERGED * before:
                return None
            if change <= max(1e-3 * tolerance, 64 * _EPS):
                break
            new = stretch.rest(stretch.moved(free, found))
            bend = step - (new - found)
            size = float((bend * bend).sum())
            share = float((bend * (new - found)).sum()) / size if size > 0 else 0.0
            share = share if abs(share) < _MOST_AHEAD else 0.0
            rest = found + share * step  # Anderson's mixing of two iterates
            found = new + share * (new - found)
        else:
            return None
        rest = found
        tail = float((np.abs(rest @ panels.TO_CHEBYSHEV.T[:, -2:]) / stretch.sizes).max())
        if tail > tolerance:
            return None
        return stretch.flow, np.concatenate([state, (rest @ _MONOMIALS.T).ravel()]), tail


class _Stretch:
    """The linear system that carries the curves along as polynomials: m_k' = m_(k+1)/H, n = m_0."""

    def __init__(self, piece: Piece, slopes: tuple[float, ...], span: float, tolerance: float) -> None:
        curves, n, count = piece.motion.curves, len(piece.rate), len(slopes)
        self.curves, self.slopes = curves, slopes
        self.sizes = np.array([[curve.size] for curve in curves])
        rate = np.zeros((n + count * COUNT, n + count * COUNT))
        rate[:n, :n] = piece.rate
        outputs = [(piece.guards, piece.guards_direct), (piece.watch, piece.watch_direct)]
        guards, watch = (np.hstack([rows, np.zeros((len(rows), count * COUNT))]) for rows, _ in outputs)
        for index, slope in enumerate(slopes):
            first = n + index * COUNT
            rate[:n, :n] += np.outer(piece.gain[:, index], slope * piece.arguments[index][0])
            rate[:n, first] = piece.gain[:, index]
            for rows, (_, direct) in zip((guards, watch), outputs, strict=True):
                rows[:, :n] += np.outer(direct[:, index], slope * piece.arguments[index][0])
                rows[:, first] = direct[:, index]
            chain = np.arange(first, first + COUNT - 1)
            rate[chain, chain + 1] = 1 / span
        faded = max(FADED, _FADED_SHARE * tolerance)  # a curve joined within the tolerance keeps ringing at its size
        self.flow = Flow(rate, guards, watch, piece.system.own, piece.system.input_speed, faded, piece.resolved, _WORTH)
        nodes = self.flow.chunk(span).at_nodes
        arguments = np.vstack(piece.arguments)
        self.seen_state = (arguments @ nodes[:, :n, :n]).transpose(1, 0, 2).reshape(-1, n)
        carried = (arguments @ nodes[:, :n, n:]).reshape(COUNT, -1, count, COUNT) @ _MONOMIALS
        self.seen_rest = carried.transpose(1, 0, 2, 3).reshape(-1, count * COUNT)
        ends = np.cumsum([len(rows) for rows in piece.arguments])
        self.parts = [slice(end - len(rows), end) for end, rows in zip(ends, piece.arguments, strict=True)]

    def moved(self, free: FloatArray, rest: FloatArray) -> FloatArray:
        """Arguments of the curves at the nodes when their rests have these values there."""
        result: FloatArray = (free + self.seen_rest @ rest.ravel()).reshape(-1, COUNT)
        return result

    def rest(self, y: FloatArray) -> FloatArray:
        """What the curves have beyond their linear parts, at the nodes."""
        return np.array(
            [
                curve.value(y[part]) - slope * y[part][0]
                for curve, slope, part in zip(self.curves, self.slopes, self.parts, strict=True)
            ]
        )
