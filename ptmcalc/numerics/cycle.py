"""Periodic motion of one degree of freedom over its angle: the fixed point of the Poincare map, found at once.

The unknown is e = w^2/2, half the squared speed, with de/dphi = f(phi, e). All stretches of a cycle are solved
together by Newton's method: each passes on an affine map from the value at its beginning to that at its end, so the
cycle closes by one division, and nothing is ever run until it settles.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ptmcalc.numerics.collocation import gauss, integrals, radau

FloatArray = NDArray[np.float64]
Rate = Callable[[FloatArray], tuple[FloatArray, FloatArray]]
"""de/dphi and its derivative by e, at the nodes of a grid, from e there."""

_MOST_STEPS = 40
_CONVERGED, _STAGNANT = 2e-14, 1e-10
_SMALLEST_FALL = 0.1  # part of its value that a Newton step leaves of e at least: it stays above 0
_SAMPLES = np.linspace(0.0, 1.0, 41)


@dataclass(frozen=True, slots=True)
class Grid:
    """Stretches of angle between edges [rad], each with the nodes of a Radau rule."""

    edges: FloatArray
    order: int

    @property
    def lengths(self) -> FloatArray:
        """Length of each stretch [rad], shape (m,)."""
        return np.diff(self.edges)

    @property
    def angles(self) -> FloatArray:
        """The nodes [rad], shape (m, n)."""
        return np.asarray(self.edges[:-1, None] + self.lengths[:, None] * radau(self.order).nodes)

    def with_order(self, order: int) -> "Grid":
        """The same stretches with other nodes."""
        return Grid(self.edges, order)


@dataclass(frozen=True, slots=True)
class Orbit:
    """A motion over the stretches of a grid: e at the beginning of each and the Legendre coefficients of de/dphi."""

    grid: Grid
    start: FloatArray
    slopes: FloatArray
    multiplier: float
    """by how much a change at the beginning has grown at the end; below 1 the cycle is stable"""

    def within(self, places: ArrayLike) -> FloatArray:
        """e at places in [0, 1] of every stretch, shape (m, places)."""
        inside = radau(self.grid.order).integrate(self.slopes, places)
        return np.asarray(self.start[:, None] + self.grid.lengths[:, None] * inside)

    @property
    def nodes(self) -> FloatArray:
        """e at the nodes, shape (m, n)."""
        return self.within(radau(self.grid.order).nodes)

    @property
    def rates(self) -> FloatArray:
        """de/dphi at the nodes, shape (m, n)."""
        return radau(self.grid.order).evaluate(self.slopes, radau(self.grid.order).nodes)

    def at(self, angle: ArrayLike) -> FloatArray:
        """e at angles within the grid."""
        angles = np.asarray(angle, float)
        flat = np.clip(angles.ravel(), self.grid.edges[0], self.grid.edges[-1])
        cell = np.clip(np.searchsorted(self.grid.edges, flat, side="right") - 1, 0, len(self.start) - 1)
        place = (flat - self.grid.edges[cell]) / self.grid.lengths[cell]
        inside = np.sum(integrals(self.grid.order, place) * self.slopes[cell], axis=-1)
        return np.asarray((self.start[cell] + self.grid.lengths[cell] * inside).reshape(angles.shape))

    def extremes(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """(smallest e, its angle), (largest e, its angle): vertices of the polynomials, and their ends."""
        values = self.within(_SAMPLES)
        found = []
        for sign in (-1.0, 1.0):
            cell, place = (int(at) for at in np.unravel_index(int(np.argmax(sign * values)), values.shape))
            looked = [(cell, float(_SAMPLES[place]))]
            if place == len(_SAMPLES) - 1:  # at an edge the vertex may lie in the stretch beside it
                looked.append(((cell + 1) % len(values), 0.0))
            elif place == 0:
                looked.append((cell - 1, 1.0))
            tops = [(self._refined(*where, sign), where[0] % len(values)) for where in looked]
            (x, value), cell = max(tops, key=lambda top: sign * top[0][1])
            found.append((value, float(self.grid.edges[cell] + x * self.grid.lengths[cell])))
        return found[0], found[1]

    def _refined(self, cell: int, place: float, sign: float) -> tuple[float, float]:
        """The extreme next to a place of a stretch, by false position on the slope: (place, value)."""
        rule, slopes = radau(self.grid.order), self.slopes[cell]
        step = float(_SAMPLES[1])
        low, high = max(place - step, 0.0), min(place + step, 1.0)
        ends = sign * rule.evaluate(slopes, [low, high])
        if ends[0] > 0 > ends[1]:
            at_low, at_high = ends.tolist()
            for _ in range(_MOST_STEPS):
                place = high - at_high * (high - low) / (at_high - at_low)
                at = sign * float(rule.evaluate(slopes, [place])[0])
                if high - low <= 1e-9 or abs(at) <= 1e-11 * abs(ends).max():  # the value is flat there
                    break
                if at > 0:
                    low, at_low, at_high = place, at, at_high / 2
                else:
                    high, at_high, at_low = place, at, at_low / 2
        inside = float(rule.integrate(slopes, [place])[0])
        return place, float(self.start[cell] + self.grid.lengths[cell] * inside)

    def sample(self, order: int) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Angles, e and weights [rad] of a Gauss quadrature over the stretches, shape (m, order) each."""
        nodes, weights = gauss(order)
        lengths = self.grid.lengths[:, None]
        return self.grid.edges[:-1, None] + lengths * nodes, self.within(nodes), lengths * weights

    def derivative(self, order: int) -> FloatArray:
        """de/dphi at the same nodes, shape (m, order)."""
        return radau(self.grid.order).evaluate(self.slopes, gauss(order)[0])

    def tail(self) -> FloatArray:
        """How far each stretch may be from the solution, from its last coefficients, shape (m,)."""
        return np.asarray(radau(self.grid.order).tail(self.slopes) * self.grid.lengths)


def solve(grid: Grid, rate: Rate, guess: FloatArray, start: float | None = None) -> Orbit | None:
    """The motion over a grid that starts with e = `start`, or the closed one where no start is given.

    Args:
        grid: stretches and nodes.
        rate: de/dphi at the nodes, and its derivative by e.
        guess: e at the nodes, above 0, shape (m, n).
        start: e at the first edge; None closes the cycle.

    Returns:
        The motion, or None where Newton's method finds none with e above 0 everywhere.

    **Error** that of collocation with n nodes (`numerics.collocation`).
    **Source** Radau IIA over all stretches at once; condensation of each stretch to an affine map.
    """
    rule, h = radau(grid.order), grid.lengths
    if not np.all(guess > 0):
        return None
    weights = h[:, None, None] * rule.integral
    identity = np.eye(grid.order)
    e = np.array(guess, float)
    begin = np.empty(len(h))
    multiplier, change = np.nan, np.inf
    for _ in range(_MOST_STEPS):
        f, g = rate(e)
        if not (np.all(np.isfinite(f)) and np.all(np.isfinite(g))):
            return None
        pull = weights * g[:, None, :]
        known = np.einsum("mij,mj->mi", weights, f - g * e)
        try:
            solved = np.linalg.solve(identity - pull, np.stack([known, pull.sum(axis=-1)], axis=-1))
        except np.linalg.LinAlgError:
            return None
        begin, multiplier = _chained(solved[:, -1, 0], solved[:, -1, 1], start)
        if not np.all(np.isfinite(begin)):
            return None
        wanted = solved[..., 0] + solved[..., 1] * begin[:, None] + begin[:, None]
        following = np.maximum(wanted, _SMALLEST_FALL * e)
        before, change = change, float(np.max(np.abs(following - e)) / np.max(following))
        e = following
        if change <= _CONVERGED or (change <= _STAGNANT and change >= before / 2):
            break
    else:
        return None
    if np.any(e != wanted) or np.any(begin <= 0):
        return None
    slopes = rate(e)[0] @ rule.to_legendre.T
    return Orbit(grid, begin, slopes, multiplier)


def _chained(offset: FloatArray, growth: FloatArray, start: float | None) -> tuple[FloatArray, float]:
    """The values at the beginning of each stretch, from the affine map of each, and the factor of all of them.

    The maps are known by their factors less 1, which keep their digits where a heavy shaft hardly changes its speed.
    """
    shifts, growths = offset.tolist(), growth.tolist()
    p, more = 0.0, 0.0
    for a, b in zip(shifts, growths, strict=True):
        p, more = a + b * p + p, more + b + more * b
    if start is None:
        start = -p / more if more != 0 else np.nan
    begin = [start]
    for a, b in zip(shifts[:-1], growths[:-1], strict=True):
        begin.append(a + b * begin[-1] + begin[-1])
    return np.array(begin), 1 + more
