"""A mode in variables of like size, and stretches of time on which its smooth curves are polynomials.

A nonlinear n is the polynomial through its values at the nodes of a stretch, found by iteration; its slope is put into
A, and a stretch is halved until the last coefficients of what is left fall below the tolerance.
"""

import math
from collections.abc import Hashable

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics import panels
from ptmcalc.numerics.flow import FADED, RESOLVED, Flow, fastest
from ptmcalc.numerics.motion import Motion, System
from ptmcalc.numerics.panels import COUNT, NODES, FloatArray

_EPS = float(np.finfo(float).eps)
_MOST_ITERATIONS = 20
_SHORTEST, _LONGEST = 1e-13, 1e6
_FADED_SHARE = 0.1
_WORTH = 40.0
_DIVERGED, _TINY = 8.0, 1e-290
_ORDER, _MOST_HALVINGS = 8, 4
"""Power of a stretch with which the last coefficients rise; how often one is halved at once that does not do."""
_CHAIN = np.eye(COUNT, k=1)
_LAST = panels.TO_CHEBYSHEV.T[:, -2:]

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
        self.reach = math.inf
        self.entry = math.inf
        """stretch that should be short enough where this mode begins"""
        self._linear: Flow | None = None
        self._tangents: dict[Hashable, _Tangent] = {}
        self._stretches: dict[Hashable, _Stretch] = {}

    @property
    def linear(self) -> Flow:
        """The flow of a mode without curves."""
        if self._linear is None:
            system = self.system
            self._linear = Flow(
                self.rate, self.guards, self.watch, system.own, system.input_speed, resolved=self.resolved
            )
        return self._linear

    def _tangent(self, slopes: tuple[float, ...]) -> "_Tangent":
        tangent = self._tangents.get(slopes)
        if tangent is None:
            tangent = self._tangents[slopes] = _Tangent(self, slopes)
        return tangent

    def now(self, state: FloatArray) -> FloatArray:
        """The watched signals of a state."""
        values = [float(curve.value((curve.rows @ state)[:, None])[0]) for curve in self.motion.curves]
        result: FloatArray = self.motion.watch @ np.concatenate([state, values])
        return result

    def stretch(
        self, state: FloatArray, reach: float, longest: float, tolerance: float
    ) -> tuple[Flow, FloatArray, float]:
        """A stretch on which the curves are polynomials of time: its flow, the state that goes with it, its length."""
        exact = [curve.slope(rows @ state) for curve, rows in zip(self.motion.curves, self.arguments, strict=True)]
        slopes = tuple(
            round(slope / curve.grain) * curve.grain for slope, curve in zip(exact, self.motion.curves, strict=True)
        )
        unit = self.resolved / RESOLVED  # a lattice of its own for every `refined`: two runs share no stretch
        span = min(reach, unit * 2.0 ** math.ceil(math.log2(longest / unit)), unit * _LONGEST)
        while span > _SHORTEST:
            stretch = self._stretches.get((slopes, span))
            if stretch is None:
                stretch = self._stretches[slopes, span] = _Stretch(self, self._tangent(slopes), span, tolerance)
            rest, tail = stretch.solve(state, exact, tolerance)
            doublings = -math.log2(max(tail, _EPS**2) / tolerance) / _ORDER if math.isfinite(tail) else -_MOST_HALVINGS
            if rest is not None:
                self.reach = span * 2.0 ** math.floor(doublings)
                return stretch.flow, np.concatenate([state, (rest @ _MONOMIALS.T).ravel()]), span
            span *= 2.0 ** -min(max(math.ceil(-doublings), 1), _MOST_HALVINGS)
        raise NumericsError("NUM101", "a nonlinear torque could not be resolved by any step")


class _Tangent:
    """A mode with slopes of its curves put into A, in states that go on with the coefficients of what they leave."""

    def __init__(self, piece: Piece, slopes: tuple[float, ...]) -> None:
        n, own, self.slopes = len(piece.rate), piece.system.own, slopes
        size = n + len(slopes) * COUNT
        first = np.array([slope * rows[0] for slope, rows in zip(slopes, piece.arguments, strict=True)])

        def wide(rows: FloatArray, direct: FloatArray, height: int) -> FloatArray:
            found = np.zeros((height, size))
            found[: len(rows), :n] = rows + direct @ first
            found[: len(rows), n::COUNT] = direct
            return found

        self.rate = wide(piece.rate, piece.gain, size)
        self.guards = wide(piece.guards, piece.guards_direct, len(piece.guards))
        self.watch = wide(piece.watch, piece.watch_direct, len(piece.watch))
        self.largest = fastest(self.rate[:own, :own])


class _Stretch:
    """The linear system that carries the curves along as polynomials: m_k' = m_(k+1)/H, n = m_0."""

    def __init__(self, piece: Piece, tangent: _Tangent, span: float, tolerance: float) -> None:
        self.curves, self.slopes = piece.motion.curves, tangent.slopes
        n, count = len(piece.rate), len(self.curves)
        self.sizes = np.array([[curve.size] for curve in self.curves])
        rate = tangent.rate.copy()
        rate[n:, n:] = np.kron(np.eye(count), _CHAIN) / span
        faded = max(FADED, _FADED_SHARE * tolerance)  # a curve joined within the tolerance keeps ringing at its size
        system = piece.system
        self.flow = Flow(
            rate, tangent.guards, tangent.watch, system.own, system.input_speed,
            faded=faded, resolved=piece.resolved, worth=_WORTH, largest=tangent.largest,
        )  # fmt: skip
        arguments = np.vstack(piece.arguments)
        seen = (arguments @ self.flow.chunk(span).at_nodes[:, :n]).transpose(1, 0, 2)
        self.seen_state = seen[:, :, :n].reshape(-1, n)
        self.seen_rest = (seen[:, :, n:].reshape(-1, count, COUNT) @ _MONOMIALS).reshape(-1, count * COUNT)
        sizes = [len(rows) for rows in piece.arguments]
        ends = np.cumsum(sizes)
        self.parts = [slice(end - size, end) for end, size in zip(ends, sizes, strict=True)]
        self.of = np.repeat(np.eye(count), sizes, axis=1)
        """which arguments belong to a curve, shape (curves, arguments)"""

    def solve(self, state: FloatArray, slopes: list[float], tolerance: float) -> tuple[FloatArray | None, float]:
        """What the curves have beyond their linear parts at the nodes, if it fits the motion it causes within the
        tolerance, and the size of its last coefficients.

            r = n(y) - s y,   y = free + M r

        by Newton's method from the slopes at the start, the tangents at the nodes by Broyden's update.
        """
        free = (self.seen_state @ state).reshape(-1, COUNT)
        y, change, tail = free[:, :1], math.inf, math.inf
        found = self.rest(y)
        tangents = np.zeros_like(free)
        for part, slope, base in zip(self.parts, slopes, self.slopes, strict=True):
            tangents[part.start] = slope - base
        rows = self.seen_rest.reshape(len(free), COUNT, -1)
        for _ in range(_MOST_ITERATIONS):
            system = -(self.of @ (tangents[:, :, None] * rows).reshape(len(free), -1)).reshape(
                found.shape[0] * COUNT, -1
            )
            system.ravel()[:: len(system) + 1] += 1.0
            right = found + self.of @ (tangents * (free - y))
            used = np.linalg.solve(system, right.ravel())
            last, y_last = found, y
            y = free + (self.seen_rest @ used).reshape(free.shape)
            found = self.rest(y)
            before, change = change, float((np.abs(found - used.reshape(found.shape)) / self.sizes).max())
            tail = float((np.abs(found @ _LAST) / self.sizes).max())
            if change <= max(1e-3 * tolerance, 64 * _EPS):
                return (found if tail <= tolerance else None), tail
            if not change <= _DIVERGED * before or tail > max(tolerance, change):
                break
            step = y - y_last
            bend = (found - last - self.of @ (tangents * step)) / np.maximum(self.of @ (step * step), _TINY)
            tangents = tangents + (self.of.T @ bend) * step
        return None, tail

    def rest(self, y: FloatArray) -> FloatArray:
        """What the curves have beyond their linear parts, at the nodes."""
        return np.array(
            [
                curve.value(y[part]) - slope * y[part][0]
                for curve, slope, part in zip(self.curves, self.slopes, self.parts, strict=True)
            ]
        )
