"""Speed and acceleration of a measured speed record, with their uncertainty: polynomials fitted to stretches of it."""

import math
from dataclasses import dataclass
from itertools import accumulate

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

DEGREE = 3
FEWEST = 10
"""Samples a record needs at least."""
_SIZES = (9, 13, 19, 27, 39, 57, 83, 121, 177, 259, 379, 555)
_MEDIAN = 0.870  # of chi^2/5: residuals of a cubic through nine samples
_REACH = 2.0  # standard deviations of the intervals that must have a point in common
_BIAS = 2.0  # of what a stretch does not follow, over what it has changed by from the next shorter one
_SPREAD = 15  # samples over which the median of the lengths is taken


@dataclass(frozen=True, slots=True)
class Fitted:
    """A record at its times, shape (n,) each: speed and acceleration with their covariance."""

    time: FloatArray
    angle: FloatArray
    """turned since the first sample [rad]"""
    speed: FloatArray
    acceleration: FloatArray
    speed_variance: FloatArray
    acceleration_variance: FloatArray
    covariance: FloatArray
    noise: float
    """standard deviation of a sample [rad/s]"""
    first: NDArray[np.intp]
    last: NDArray[np.intp]
    """samples that each stretch begins and ends with"""

    def apart(self, low: int, high: int) -> NDArray[np.intp]:
        """Fits whose stretches lie within some samples and share none, so that their errors are independent."""
        found, free = [], low
        for k in range(low, high + 1):
            if self.first[k] >= free and self.last[k] <= high:
                found.append(k)
                free = int(self.last[k]) + 1
        return np.array(found, dtype=np.intp)


def fit(time: FloatArray, speed: FloatArray, window: int | None = None) -> Fitted:
    """Speed and acceleration at every sample of a record, from a cubic fitted to the stretch around it.

        w(t) = c_0 + c_1 (t - t_i) + ...,   covariance of c = s^2 (X^T X)^-1

    The noise s is the median of the residuals over stretches of nine samples. At each sample the stretch is as long as
    the acceleration within twice its deviation still has a value in common with that of all shorter ones: where the
    motion has a corner, the stretches are short. What the acceleration has changed by from the next shorter stretch is
    added to its deviation, as a measure of what the cubic does not follow.

    Args:
        time: rising, shape (n,), n >= 10.
        speed: at these times, shape (n,).
        window: samples of a stretch; chosen when left out.

    **Error** the deviations hold for samples with independent errors of one size: a record that has been smoothed seems
    better than it is.
    **Source** A. Savitzky and M. Golay, Anal. Chem. 36 (1964), for samples at any times; intersection of confidence
    intervals: A. Goldenshluger and A. Nemirovski, Math. Methods Statist. 6 (1997).
    """
    n = len(time)
    shortest = min(_SIZES[0], n)
    residuals = _at_all(time, speed, shortest)[1]
    noise = math.sqrt(float(np.median(residuals)) / _MEDIAN)
    sizes = [size for size in _SIZES if size <= n] if window is None else [min(max(window, DEGREE + 2), n)]
    fits = np.array([_at_all(time, speed, size)[0] for size in sizes])
    chosen = _chosen(fits, noise)
    best = np.take_along_axis(fits, chosen[None, None, :], axis=0)[0]
    shorter = np.take_along_axis(fits[:, 1], np.maximum(chosen - 1, 0)[None, :], axis=0)[0]
    drift = _BIAS * (best[1] - shorter)
    w, a, of_w, of_a, both, first, last = best
    step = np.diff(time)
    turned = step * (w[1:] + w[:-1]) / 2 + step**2 * (a[:-1] - a[1:]) / 12
    return Fitted(
        time=time,
        angle=np.concatenate([[0.0], np.cumsum(turned)]),
        speed=w,
        acceleration=a,
        speed_variance=noise**2 * of_w,
        acceleration_variance=noise**2 * of_a + drift**2,
        covariance=noise**2 * both,
        noise=noise,
        first=first.astype(np.intp),
        last=last.astype(np.intp),
    )


def _chosen(fits: FloatArray, noise: float) -> NDArray[np.intp]:
    """Which of the lengths to take at every sample: the longest before the intervals have nothing in common any more,
    in the median over some samples, so that no single one stands out by chance."""
    reach = _REACH * noise * np.sqrt(fits[:, 3])
    low = np.maximum.accumulate(fits[:, 1] - reach, axis=0)
    high = np.minimum.accumulate(fits[:, 1] + reach, axis=0)
    longest = np.logical_and.accumulate(low <= high, axis=0).sum(axis=0) - 1
    around = np.lib.stride_tricks.sliding_window_view(np.pad(longest, _SPREAD // 2, mode="edge"), _SPREAD)
    return np.asarray(np.median(around, axis=1), dtype=np.intp)


def _at_all(time: FloatArray, speed: FloatArray, size: int) -> tuple[FloatArray, FloatArray]:
    """Cubics through so many samples around every one: rows of speed, acceleration, their variances and covariance over
    the noise squared, first and last sample, shape (7, n); and the variance of the residuals."""
    n = len(time)
    starts = np.clip(np.arange(n) - size // 2, 0, n - size)
    index = starts[:, None] + np.arange(size)
    scale = (time[index[:, -1]] - time[index[:, 0]])[:, None]
    x = (time[index] - time[:, None]) / scale
    powers = np.stack(list(accumulate([x] * DEGREE, np.multiply, initial=np.ones_like(x))), axis=1)
    inverse = np.linalg.inv(powers @ powers.swapaxes(1, 2))
    level = speed[index].mean(axis=1)[:, None]
    around = speed[index] - level
    coefficients = (inverse @ (powers @ around[:, :, None]))[:, :, 0]
    residual = around - (coefficients[:, None, :] @ powers)[:, 0]
    one = scale[:, 0]
    fits = np.stack(
        [
            coefficients[:, 0] + level[:, 0],
            coefficients[:, 1] / one,
            inverse[:, 0, 0],
            inverse[:, 1, 1] / one**2,
            inverse[:, 0, 1] / one,
            starts.astype(float),
            (starts + size - 1).astype(float),
        ]
    )
    return fits, np.sum(residual**2, axis=1) / max(size - DEGREE - 1, 1)


@dataclass(frozen=True, slots=True)
class Line:
    """A straight line y = a + b x with the standard deviations of both."""

    offset: float
    slope: float
    offset_deviation: float
    slope_deviation: float


def torque(fitted: Fitted, inertia: FloatArray, slope: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Sum of all torques on a shaft of a known inertia, with its standard deviation.

        M = J eps + w^2 J'/2,   var M = J^2 var eps + 2 J J' w cov(w, eps) + (J' w)^2 var w

    Args:
        fitted: the record.
        inertia: J at the angles of the record, shape (k,).
        slope: J' there, shape (k,).

    **Error** first order in the deviations; the angle is taken as exact.
    **Source** `laws.shaft.torque_of_motion`; propagation of errors.
    """
    by_speed = slope * fitted.speed
    value = inertia * fitted.acceleration + fitted.speed * by_speed / 2
    variance = (
        inertia**2 * fitted.acceleration_variance
        + 2 * inertia * by_speed * fitted.covariance
        + by_speed**2 * fitted.speed_variance
    )
    return value, np.sqrt(np.maximum(variance, 0.0))


def line(x: FloatArray, y: FloatArray, deviation: FloatArray) -> Line:
    """The straight line through independent points of different weight.

    **Error** covariance (X^T V^-1 X)^-1, enlarged by the scatter of the points where that is larger than their
    deviations tell.
    **Source** weighted least squares.
    """
    weight = _weights(y, deviation)
    matrix = np.stack([np.ones(len(x)), x], axis=1) * weight[:, None]
    inverse = np.linalg.pinv(matrix.T @ matrix)
    offset, slope = inverse @ (matrix.T @ (y * weight))
    scatter = (y - offset - slope * x) * weight
    spread = max(float(scatter @ scatter) / max(len(x) - 2, 1), 1.0)
    deviations = np.sqrt(np.diag(inverse) * spread)
    return Line(float(offset), float(slope), float(deviations[0]), float(deviations[1]))


def mean(y: FloatArray, deviation: FloatArray) -> tuple[float, float]:
    """Weighted mean of independent points, and its standard deviation, enlarged by their scatter as in `line`."""
    weight = _weights(y, deviation) ** 2
    value = float(np.sum(weight * y) / np.sum(weight))
    scatter = float(np.sum(weight * (y - value) ** 2)) / max(len(y) - 1, 1)
    return value, math.sqrt(max(scatter, 1.0) / float(np.sum(weight)))


def _weights(y: FloatArray, deviation: FloatArray) -> FloatArray:
    """The inverse of the deviations, none of which is below rounding."""
    rounding = max(float(np.max(np.abs(y))) * 1e-12, 1e-100)  # weights are squared
    return np.asarray(1 / np.maximum(deviation, rounding))
