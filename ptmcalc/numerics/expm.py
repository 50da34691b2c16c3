"""The matrix exponential, batched, without eigenvectors: they do not exist where a mass flies freely."""

import math

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

DEGREE = 18
"""Degree of the Taylor polynomial; at a norm of 1 its remainder is below 1e-17."""
_ORDERS = np.arange(1, DEGREE + 1)
_FACTORIALS = np.cumprod(_ORDERS, dtype=float)[:, None]


def balance(matrix: FloatArray, sweeps: int = 4) -> FloatArray:
    """Powers of two d that make rows and columns of diag(1/d) A diag(d) alike in size.

        d_i <- d_i f,   f the power of 2 next to sqrt(row_i/column_i)

    Without it the squarings are chosen by the largest entry (1e8 in [[0, 1e8], [0, -1]]) and lose digits.

    Args:
        matrix: A, shape (n, n).
        sweeps: how often every index is visited.

    Returns:
        d, shape (n,).

    **Source** Osborne, On pre-conditioning of matrices, 1960; Parlett and Reinsch, 1969.
    """
    size = np.abs(matrix)
    np.fill_diagonal(size, 0.0)
    rows: list[list[float]] = size.tolist()
    scale = [1.0] * len(rows)
    for _ in range(sweeps):
        steady = True
        for i in range(len(rows)):
            row, column = sum(rows[i]), sum(line[i] for line in rows)
            if row > 0 and column > 0:
                factor = 2.0 ** round(math.log2(row / column) / 2)
            elif row > 0:  # nothing comes back: make what it feeds on no larger than the rest
                factor = 2.0 ** math.ceil(math.log2(row / _usual(rows, i)))
            elif column > 0:
                factor = 2.0 ** -math.ceil(math.log2(column / _usual(rows, i)))
            else:
                factor = 1.0
            if factor != 1.0:
                steady = False
                rows[i] = [one / factor for one in rows[i]]
                for line in rows:
                    line[i] *= factor
                scale[i] *= factor
        if steady:
            break
    return np.array(scale)


def _usual(rows: list[list[float]], i: int) -> float:
    """Largest entry that has nothing to do with an index, 1 where there is none."""
    rest = (one for k, line in enumerate(rows) if k != i for j, one in enumerate(line) if j != i)
    return max(rest) or 1.0


class Powers:
    """The powers of a matrix over their factorials, for its exponential at many times.

        exp(A t) - I = D,   D_0 = sum_k>0 (A t/2^s)^k/k!,   D <- 2 D + D^2  s times,   |A| t_max/2^s <= 1

    The difference from I is squared, not the whole: what moves slowly beside something that fades fast is lost in the
    last digits of I + D_0 otherwise (4e-9 at rates 1e9 apart).

    **Error** rounding of the largest entry met on the way.
    """

    def __init__(self, matrix: FloatArray) -> None:
        n = len(matrix)
        self.norm = float(np.abs(matrix).sum(axis=0).max(initial=0.0))
        self._unit = 2.0 ** math.frexp(self.norm)[1] if self.norm else 1.0  # or high powers overflow
        stack = np.empty((DEGREE, n, n))
        stack[0], filled = matrix / self._unit, 1
        while filled < DEGREE:
            more = min(filled, DEGREE - filled)
            np.matmul(stack[:more], stack[filled - 1], out=stack[filled : filled + more])
            filled += more
        self._stack = stack.reshape(DEGREE, n * n) / _FACTORIALS
        self._n = n

    def at(self, times: FloatArray) -> FloatArray:
        """exp(A t) at several times, shape (times, n, n)."""
        return whole(self.changes(times))

    def changes(self, times: FloatArray) -> FloatArray:
        """exp(A t) - I at several times, shape (times, n, n)."""
        n, squarings = self._n, self._squarings(float(np.abs(times).max(initial=0.0)))
        terms = (times * (self._unit / 2.0**squarings))[:, None] ** _ORDERS
        change: FloatArray = (terms @ self._stack).reshape(len(times), n, n)
        return _squared(change, squarings)

    def change(self, time: float) -> FloatArray:
        """exp(A t) - I at one time, shape (n, n)."""
        squarings = self._squarings(abs(time))
        terms = (time * (self._unit / 2.0**squarings)) ** _ORDERS
        change: FloatArray = (terms @ self._stack).reshape(self._n, self._n)
        return _squared(change, squarings)

    def _squarings(self, longest: float) -> int:
        size = self.norm * longest
        return math.ceil(math.log2(size)) if size > 1 else 0


def whole(change: FloatArray) -> FloatArray:
    """exp(A t) of what it differs from I by, in place, shape (times, n, n)."""
    change.reshape(len(change), -1)[:, :: change.shape[1] + 1] += 1.0
    return change


def twice(change: FloatArray) -> FloatArray:
    """What exp(2 A t) differs from I by, of the same of exp(A t), shape (times, n, n)."""
    return _squared(change.copy(), 1)


def _squared(change: FloatArray, times: int) -> FloatArray:
    """D <- 2 D + D^2 several times, in two arrays."""
    other = np.empty_like(change) if times else change
    for _ in range(times):
        np.matmul(change, change, out=other)
        other += change
        other += change
        change, other = other, change
    return change


def expm(matrix: FloatArray) -> FloatArray:
    """exp(A) of one matrix, balanced first.

    **Range** any finite real matrix whose exponential is finite.
    **Error** rounding.
    **Source** scaling and squaring; Moler and Van Loan, Nineteen dubious ways, 2003.
    """
    scale = balance(matrix)
    balanced = matrix * scale / scale[:, None]
    result: FloatArray = Powers(balanced).at(np.ones(1))[0] * scale[:, None] / scale
    return result
