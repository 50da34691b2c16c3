"""Extremes of sampled, piecewise smooth signals: from the smooth pieces and the corners, not from the samples."""

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def largest(values: FloatArray, step: float) -> tuple[float, float]:
    """Largest value of a continuous, piecewise smooth signal and its time.

    In each cell the signal is continued from both sides by the parabolas through the three samples on that side.
    A smooth maximum is the vertex of either; a corner between the samples is where they cross. The smaller of the
    two continuations is a value the signal reaches, so its largest value over the cell is taken, if it exceeds
    both samples.

    Args:
        values: samples at equal steps, shape (n,), n >= 1.
        step: distance of the samples.

    Returns:
        (largest value, its time from the first sample).

    **Error** second order at a corner inside a cell, third order at a smooth maximum, exact at a sampled corner.
    """
    top = int(np.argmax(values))
    best, place = float(values[top]), top * step
    n = len(values)
    if n < 6:
        return best, place
    left = slice(2, n - 3)  # cell k -> k+1 with samples k-2 .. k+3
    f0, f1, f2, f3, f4, f5 = (values[i : n - 5 + i] for i in range(6))
    # parabolas in x = (t - t_k)/step, 0 <= x <= 1
    a, b = (f2 - 2 * f1 + f0) / 2, (3 * f2 - 4 * f1 + f0) / 2  # from the left: f2 + b x + a x^2
    c, d = (f5 - 2 * f4 + f3) / 2, (3 * f3 - 4 * f4 + f5) / 2  # from the right: f3 + d y + c y^2, y = 1 - x
    # a side that bends upward has a corner among its samples or is convex: go on straight instead of overshooting
    a, b = np.where(a > 0, 0.0, a), np.where(a > 0, f2 - f1, b)
    c, d = np.where(c > 0, 0.0, c), np.where(c > 0, f3 - f4, d)
    rising = (b > 0) & (d > 0) & (np.maximum(f2 + b, f3 + d) > best)
    if not rising.any():
        return best, place
    a, b, c, d, f2, f3 = (part[rising] for part in (a, b, c, d, f2, f3))
    cells = np.arange(n)[left][rising]
    for x in _candidates(a, b, c, d, f2, f3):
        inside = (x > 0) & (x < 1)
        x = np.where(inside, x, 0.0)
        y = 1 - x
        height = np.where(inside, np.minimum(f2 + b * x + a * x**2, f3 + d * y + c * y**2), -np.inf)
        at = int(np.argmax(height))
        if height[at] > best:
            best, place = float(height[at]), float(cells[at] + x[at]) * step
    return best, place


def _candidates(
    a: FloatArray, b: FloatArray, c: FloatArray, d: FloatArray, f2: FloatArray, f3: FloatArray
) -> list[FloatArray]:
    """Vertices of both parabolas and their crossings, in x; NaN where there is none."""
    with np.errstate(divide="ignore", invalid="ignore"):
        vertex_left, vertex_right = -b / (2 * a), 1 + d / (2 * c)
        p, q, r = a - c, b + d + 2 * c, f2 - f3 - d - c  # p x^2 + q x + r = 0
        root = np.sqrt(q * q - 4 * p * r)
        stable = -(q + np.copysign(root, q)) / 2
        return [vertex_left, vertex_right, stable / p, r / stable]


def smallest(values: FloatArray, step: float) -> tuple[float, float]:
    """Smallest value of a continuous, piecewise smooth signal and its time; see `largest`."""
    value, place = largest(-values, step)
    return -value, place


def gap(values: FloatArray, others: FloatArray, reach: int) -> float:
    """Largest distance of a value from the range of the others within so many samples."""
    padded, width = np.pad(others, reach, mode="edge"), 2 * reach + 1
    high, low = _of_windows(padded, width, np.maximum), _of_windows(padded, width, np.minimum)
    return float(np.maximum(values - high, low - values).max(initial=0.0))


def _of_windows(values: FloatArray, width: int, choose: np.ufunc) -> FloatArray:
    """The largest or smallest value in every window of so many samples, from windows of half the width."""
    half = 1
    while 2 * half <= width:
        values, half = choose(values[:-half], values[half:]), 2 * half
    last = width - half
    found: FloatArray = choose(values[: len(values) - last], values[last:])
    return found
