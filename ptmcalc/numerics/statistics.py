"""What a sample says: intervals of a share and of a quantile that hold without assumptions, and rank correlation."""

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

_TINY = 1e-300
_TERMS = 100_000
_HALVINGS = 200


def beta_share(x: float, a: float, b: float) -> float:
    """The regularised incomplete beta function.

        I_x(a, b) = (integral from 0 to x of t^(a-1) (1-t)^(b-1) dt)/B(a, b),   P(Bin(n, x) >= k) = I_x(k, n - k + 1)

    By its continued fraction, on the side of the mean where it converges in about the root of a + b terms.

    **Range** a, b > 0, 0 <= x <= 1.
    **Error** 1e-9 relative up to a + b = 1e6, from the logarithms of the gamma function.
    **Source** NIST Digital Library of Mathematical Functions, 8.17.22; Lentz's evaluation.
    """
    if x <= 0 or x >= 1:
        return float(x >= 1)
    if x > (a + 1) / (a + b + 2):
        return 1 - beta_share(1 - x, b, a)
    front = math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b) + a * math.log(x) + b * math.log1p(-x)
    return math.exp(front) / (a * _fraction(x, a, b))


def _fraction(x: float, a: float, b: float) -> float:
    """1 + d_1/(1 + d_2/(1 + ...)), by Lentz."""
    value, above, below = 1.0, 1.0, 0.0
    for k in range(1, _TERMS):
        m = k // 2
        if k % 2:
            d = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))
        else:
            d = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
        below = 1 / _not_zero(1 + d * below)
        above = _not_zero(1 + d / above)
        value *= above * below
        if abs(above * below - 1) < 1e-15:
            break
    return value


def _not_zero(value: float) -> float:
    return value if abs(value) > _TINY else _TINY


def share_interval(hits: int, size: int, confidence: float) -> tuple[float, float]:
    """The interval of a probability of which a sample shows so many hits.

        I_low(k, n - k + 1) = (1 - c)/2,   I_high(k + 1, n - k) = (1 + c)/2

    It holds the probability at least as often as it says, for every probability and every size of sample; Wilson's is
    shorter and does so only about. 0 hits of n leave up to 1 - ((1 - c)/2)^(1/n).

    **Range** 0 <= hits <= size, size > 0, 0 < confidence < 1.
    **Error** that of `beta_share`; conservative, as the number of hits is a whole one.
    **Source** Clopper and Pearson, Biometrika 26 (1934) 404.
    """
    tail = (1 - confidence) / 2
    low = 0.0 if hits == 0 else _root(lambda p: beta_share(p, hits, size - hits + 1) - tail)
    high = 1.0 if hits == size else _root(lambda p: beta_share(p, hits + 1, size - hits) - 1 + tail)
    return low, high


def _root(rising: Callable[[float], float]) -> float:
    """Where a rising function between 0 and 1 crosses 0."""
    low, high = 0.0, 1.0
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        if not low < middle < high or high - low <= 1e-12 * high:
            break
        low, high = (middle, high) if rising(middle) < 0 else (low, middle)
    return (low + high) / 2


def quantile_interval(values: ArrayLike, share: float, confidence: float) -> tuple[float, float, float]:
    """The value below which a share of all lies: that of the sample, and its interval.

        x_(r) <= x_q <= x_(s),   P(Bin(n, q) < r) <= (1 - c)/2,   P(Bin(n, q) >= s) <= (1 - c)/2

    Which of the sorted values lie around a quantile is a matter of counting, whatever they are distributed like; an end
    is infinite where the sample is too small to have one.

    **Range** 0 < share < 1, no NaN among the values.
    **Error** none: at least the confidence.
    **Source** H. A. David and H. N. Nagaraja, Order Statistics, 3rd ed., section 7.1.
    """
    ordered = np.sort(np.asarray(values, float))
    size, tail = ordered.size, (1 - confidence) / 2
    below = _last(size, lambda r: beta_share(1 - share, size - r + 1, r) <= tail)  # P(Bin <= r - 1)
    above = size + 1 - _last(size, lambda m: beta_share(share, size + 1 - m, m) <= tail)  # P(Bin >= s), s = n + 1 - m
    middle = min(max(math.ceil(size * share), 1), size)
    low = float(ordered[below - 1]) if below else -math.inf
    high = float(ordered[above - 1]) if above <= size else math.inf
    return float(ordered[middle - 1]), low, high


def _last(size: int, holds: Callable[[int], bool]) -> int:
    """The largest number from 1 on up to which a condition holds, 0 where it never does."""
    low, high = 0, size + 1
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if holds(middle) else (low, middle)
    return low


def ranks(values: ArrayLike) -> FloatArray:
    """The place of each value in their order, from 1 on; equal ones share the mean of their places.

    **Range** no NaN.
    **Error** exact.
    **Source** Kendall, Rank Correlation Methods (midranks).
    """
    _, turned, counts = np.unique(np.asarray(values, float), return_inverse=True, return_counts=True)
    last = np.cumsum(counts)
    middle: FloatArray = (last - (counts - 1) / 2)[turned]
    return middle


def rank_correlation(one: FloatArray, other: FloatArray) -> float:
    """How far one number rises with another, by their `ranks`: 1 always, -1 always falls, 0 neither.

        rho = sum (a - mean a)(b - mean b)/sqrt(sum (a - mean a)^2 sum (b - mean b)^2)

    Of independent numbers it lies within about 2/sqrt(n) of 0. It sees what rises or falls throughout, straight or not;
    of a number that does not change it is 0.

    **Range** the ranks of two lists of one length.
    **Error** exact.
    **Source** Spearman, American Journal of Psychology 15 (1904) 72.
    """
    a, b = one - one.mean(), other - other.mean()
    size = math.sqrt(float(a @ a) * float(b @ b))
    return float(a @ b) / size if size > 0 else 0.0
