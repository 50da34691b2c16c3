"""A closed curve through points: one periodic cubic spline that gives value and slope alike."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class PeriodicSpline:
    """The twice continuously differentiable cubic through points of a periodic function.

    Value and slope come from the same polynomials, so the slope is that of the value to the last digit: an inertia
    and its derivative taken from two tables would not conserve energy.
    """

    knots: FloatArray
    """places of the points, rising, less than a period apart, shape (n + 1,): the first one again at the end"""
    coefficients: FloatArray
    """of the powers 0 to 3 of the distance from the knot before, shape (4, n)"""

    @property
    def period(self) -> float:
        """After which everything comes again."""
        return float(self.knots[-1] - self.knots[0])

    def __call__(self, place: ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Value and slope at some places."""
        cell, x = self._locate(np.asarray(place, float))
        a, b, c, d = (part[cell] for part in self.coefficients)
        return a + x * (b + x * (c + x * d)), b + x * (2 * c + x * (3 * d))

    def _locate(self, place: FloatArray) -> tuple[NDArray[np.intp], FloatArray]:
        first, turns = self.knots[0], np.floor((place - self.knots[0]) / self.period)
        within = np.clip(place - turns * self.period, first, self.knots[-1])
        cell = np.clip(np.searchsorted(self.knots, within, side="right") - 1, 0, self.coefficients.shape[1] - 1)
        return cell, within - self.knots[cell]

    @property
    def range(self) -> tuple[float, float]:
        """Smallest and largest value: at the points, and where the slope is 0 in between."""
        a, b, c, d = self.coefficients
        width = np.diff(self.knots)
        with np.errstate(divide="ignore", invalid="ignore"):
            root = np.sqrt(c * c - 3 * b * d)
            stable = -(c + np.copysign(root, c))  # of 3 d x^2 + 2 c x + b, without cancelling
            inside = np.array([stable / (3 * d), b / stable])
            inside = np.where((inside > 0) & (inside < width), inside, 0.0)
        values = a + inside * (b + inside * (c + inside * d))
        return float(min(values.min(), a.min())), float(max(values.max(), a.max()))


def through(places: ArrayLike, values: ArrayLike, period: float) -> PeriodicSpline:
    """The periodic cubic spline through points.

    Args:
        places: rising, all within one period, shape (n,), n >= 3.
        values: at the places, shape (n,).
        period: after which the function repeats.

    **Error** fourth order in the distance of the points for the value, third for the slope.
    **Source** slopes s from continuity of the second derivative,
    s_(i-1)/h_(i-1) + 2 s_i (1/h_(i-1) + 1/h_i) + s_(i+1)/h_i = 3 (d_(i-1)/h_(i-1) + d_i/h_i), d the chords.
    """
    x, y = np.asarray(places, float), np.asarray(values, float)
    knots = np.append(x, x[0] + period)
    h = np.diff(knots)
    chord = np.diff(np.append(y, y[0])) / h
    n = len(x)
    before = np.roll(h, 1)
    matrix = np.diag(2 * (1 / before + 1 / h))
    here = np.arange(n)
    np.add.at(matrix, (here, (here - 1) % n), 1 / before)
    np.add.at(matrix, (here, (here + 1) % n), 1 / h)
    slope = np.linalg.solve(matrix, 3 * (np.roll(chord, 1) / before + chord / h))
    following = np.roll(slope, -1)
    second = (3 * chord - 2 * slope - following) / h
    third = (slope + following - 2 * chord) / h**2
    return PeriodicSpline(knots, np.array([y, slope, second, third]))
