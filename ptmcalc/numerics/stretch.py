"""A mode in variables of like size, and stretches of time on which its smooth curves are polynomials.

A nonlinear n is the polynomial through its values at the nodes of a stretch, found by Newton's method; its slope is put
into A, and a stretch is as long as the last coefficients of what is left stay below the tolerance.
"""

import math
from collections.abc import Hashable

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics import panels
from ptmcalc.numerics.flow import FADED, RESOLVED, Flow
from ptmcalc.numerics.motion import Motion, System
from ptmcalc.numerics.panels import COUNT, NODES, FloatArray

_EPS = float(np.finfo(float).eps)
_MOST_ITERATIONS = 20
_SHORTEST, _LONGEST = 1e-13, 1e6
_FADED_SHARE = 0.1
_WORTH = 40.0
_STALLED = 0.1
"""Share of the tolerance below which rounding may end an iteration."""
_ORDER, _MOST_HALVINGS = 8, 4
"""Power of a stretch with which the last coefficients rise; how often one is halved at once that does not do."""
_CHAIN = np.eye(COUNT, k=1)
_SHARED = 16.0
"""Longest over shortest of the stretches that share a flow."""
_LAST = panels.TO_CHEBYSHEV.T[:, -2:]
_EARLY = 1 / 16
"""Share of a stretch in which a vibration is looked for that its nodes do not resolve: where it has not yet faded."""
_MISSED = 4.0
"""What the polynomial may miss there, over the tolerance of its last coefficients."""
_TO_EARLY = np.polynomial.chebyshev.chebvander(2 * _EARLY * NODES - 1, COUNT - 1) @ panels.TO_CHEBYSHEV

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
        self._flows: dict[Hashable, Flow] = {}
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

    def _flow(self, slopes: tuple[float, ...], ticks: float, tolerance: float) -> Flow:
        """The linear system with slopes of the curves put into A, that carries along as polynomials what they leave:
        m_k' = m_(k+1)/ticks, n = s y + m_0."""
        flow = self._flows.get((slopes, ticks))
        if flow is None:
            n, count, system = len(self.rate), len(slopes), self.system
            first = np.array([slope * rows[0] for slope, rows in zip(slopes, self.arguments, strict=True)])

            def wide(rows: FloatArray, direct: FloatArray, height: int) -> FloatArray:
                found = np.zeros((height, n + count * COUNT))
                found[: len(rows), :n] = rows + direct @ first
                found[: len(rows), n::COUNT] = direct
                return found

            rate = wide(self.rate, self.gain, n + count * COUNT)
            for place in range(n, len(rate), COUNT):
                rate[place : place + COUNT, place : place + COUNT] = _CHAIN / ticks
            guards = wide(self.guards, self.guards_direct, len(self.guards))
            watch = wide(self.watch, self.watch_direct, len(self.watch))
            faded = max(FADED, _FADED_SHARE * tolerance)  # a curve joined within it keeps ringing at its size
            flow = Flow(
                rate, guards, watch, system.own, system.input_speed, faded, self.resolved, _WORTH, count * COUNT
            )
            self._flows[slopes, ticks] = flow
        return flow

    def blur(self, tolerance: float) -> FloatArray:
        """What the polynomials of the curves leave open of every guard: the tolerance, as a share of their sizes."""
        sizes = np.array([curve.size for curve in self.motion.curves])
        result: FloatArray = tolerance * (np.abs(self.guards_direct) @ sizes)
        return result

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
        unit = self.resolved / RESOLVED  # that of the flow, see there
        longest = max(longest, 2 * _SHORTEST)  # a rounding before the end is passed over
        span = min(reach, unit * 2.0 ** math.ceil(math.log2(longest / unit)), unit * _LONGEST)
        while span > _SHORTEST:
            stretch = self._stretches.get((slopes, span))
            if stretch is None:
                ticks = unit * _SHARED ** math.ceil(math.log(span / unit, _SHARED))
                flow = self._flow(slopes, ticks, tolerance)
                stretch = self._stretches[slopes, span] = _Stretch(self, flow, slopes, span, ticks)
            rest, tail = stretch.solve(state, exact, tolerance)
            doublings = -math.log2(max(tail, _EPS**2) / tolerance) / _ORDER if math.isfinite(tail) else -_MOST_HALVINGS
            if rest is not None:
                self.reach = span * 2.0 ** math.floor(doublings)
                return stretch.flow, np.concatenate([state, stretch.coefficients(rest).ravel()]), span
            span *= 2.0 ** -min(max(math.ceil(-doublings), 1), _MOST_HALVINGS)
        raise NumericsError("NUM101", "a nonlinear torque could not be resolved by any step")


class _Stretch:
    """How the curves move their arguments over a stretch of a flow that carries them along as polynomials."""

    def __init__(self, piece: Piece, flow: Flow, slopes: tuple[float, ...], span: float, ticks: float) -> None:
        curves, n, count = piece.motion.curves, len(piece.rate), len(slopes)
        self.flow, self.slopes = flow, slopes
        self.per_size = np.repeat([1 / curve.size for curve in curves], COUNT)
        self.monomials = _MONOMIALS * (ticks / span) ** np.arange(COUNT)[:, None]
        arguments = np.vstack(piece.arguments)

        def seen(span: float) -> tuple[FloatArray, FloatArray]:
            """What the arguments at the nodes of a span see of the state, and of the node values of the curves."""
            found = (arguments @ flow.chunk(span).at_nodes[:, :n]).transpose(1, 0, 2)
            rest = found[:, :, n:].reshape(-1, count, COUNT) @ self.monomials
            return found[:, :, :n].reshape(-1, n), rest.reshape(-1, count * COUNT)

        self.seen_state, self.seen_rest = seen(span)
        self.seen_early = seen(_EARLY * span) if not flow.resolves(span) else None
        sizes = [len(rows) for rows in piece.arguments]
        self.firsts = np.cumsum([0, *sizes[:-1]])
        self.parts = [
            (curve.value, slope, slice(first, first + size))
            for curve, slope, first, size in zip(curves, slopes, self.firsts.tolist(), sizes, strict=True)
        ]
        self.minus = -self.seen_rest.reshape(len(arguments), COUNT, -1)[self.firsts].reshape(count * COUNT, -1)

    def solve(self, state: FloatArray, slopes: list[float], tolerance: float) -> tuple[FloatArray | None, float]:
        """What the curves have beyond their linear parts at the nodes, if it fits the motion it causes within the
        tolerance, and its tail: the size of its last coefficients.

            r = n(y) - s y,   y = free + M r

        by Newton's method with the slopes at the start; a stretch is given up as soon as its tail is seen to be too
        long. The last correction is made without another look where the one before tells that it will do.
        """
        free = (self.seen_state @ state).reshape(-1, COUNT)
        first, start = free[self.firsts], self.rest(free[:, :1])
        tangents = np.repeat(np.subtract(slopes, self.slopes), COUNT)[:, None]
        system = tangents * self.minus
        system.reshape(-1)[:: len(system) + 1] += 1.0
        inverse = np.linalg.inv(system)
        used = inverse @ (start + tangents.reshape(-1, COUNT) * (first - first[:, :1])).ravel()
        change, enough = math.inf, max(1e-3 * tolerance, 64 * _EPS)
        for _ in range(_MOST_ITERATIONS):
            found = self.rest(free + (self.seen_rest @ used).reshape(free.shape))
            miss = found.ravel() - used
            before, change = change, float(np.abs(miss * self.per_size).max())
            stalled = not change < before
            if stalled and not change <= _STALLED * tolerance:
                break
            if before == math.inf and self._tail(found) > max(tolerance, change):
                break
            used = used + inverse @ miss
            if stalled or change <= enough or change**2 <= enough * before < math.inf:
                rest = used.reshape(found.shape)
                tail = self._tail(rest)
                if tail <= tolerance:
                    tail = max(tail, self._missed(state, rest) / _MISSED)
                return (rest if tail <= tolerance else None), tail
        return None, self._tail(found)

    def _missed(self, state: FloatArray, rest: FloatArray) -> float:
        """What polynomials miss of the curves early in the stretch, where its nodes do not resolve every vibration."""
        if self.seen_early is None:
            return 0.0
        of_state, of_rest = self.seen_early
        early = self.rest((of_state @ state + of_rest @ rest.ravel()).reshape(-1, COUNT))
        return float((np.abs(early - rest @ _TO_EARLY.T) * self.per_size[::COUNT, None]).max())

    def coefficients(self, rest: FloatArray) -> FloatArray:
        """Of u^k/k!, of what has such values at the nodes: of what changes from the first one, for a large constant
        would leave its rounding in all of them."""
        begin = rest[:, :1]
        found: FloatArray = (rest - begin) @ self.monomials.T
        found[:, :1] += begin
        return found

    def _tail(self, rest: FloatArray) -> float:
        return float((np.abs(rest @ _LAST) * self.per_size[::COUNT, None]).max())

    def rest(self, y: FloatArray) -> FloatArray:
        """What the curves have beyond their linear parts, at the nodes."""
        found = np.empty((len(self.parts), y.shape[1]))
        for row, (value, slope, part) in zip(found, self.parts, strict=True):
            np.subtract(value(y[part]), slope * y[part.start], out=row)
        return found
