"""Quantities over time that are polynomials piece by piece."""

import math
from bisect import bisect_right
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Pieces:
    """A polynomial of the time since its start in every piece; the last one holds on.

        f(t) = sum_k coefficients[i][k] (t - starts[i])^k,   starts[i] <= t < starts[i + 1]

    `starts` rises from 0 on.
    """

    starts: tuple[float, ...] = (0.0,)
    coefficients: tuple[tuple[float, ...], ...] = ((0.0,),)

    def __post_init__(self) -> None:
        rising = all(a < b for a, b in pairwise(self.starts))
        if not self.starts or self.starts[0] != 0 or not rising or len(self.starts) != len(self.coefficients):
            raise ValueError("pieces start at 0, one after the other, each with its coefficients")
        if not all(math.isfinite(c) for piece in self.coefficients for c in piece):
            raise ValueError("the coefficients of pieces are finite")

    @classmethod
    def constant(cls, value: float) -> "Pieces":
        return cls((0.0,), ((value,),))

    @classmethod
    def through(cls, points: tuple[tuple[float, float], ...]) -> "Pieces":
        """Straight lines through (time, value) points, constant before and behind; two points at one time are a
        jump."""
        starts: list[float] = []
        coefficients: list[tuple[float, ...]] = []
        if points[0][0] > 0:
            starts, coefficients = [0.0], [(points[0][1],)]
        for (t0, v0), (t1, v1) in pairwise(points):
            if t1 > t0:
                starts.append(t0)
                coefficients.append((v0, (v1 - v0) / (t1 - t0)) if v1 != v0 else (v0,))
        starts.append(points[-1][0])
        coefficients.append((points[-1][1],))
        return cls(tuple(starts), tuple(coefficients))

    @classmethod
    def steps(cls, points: tuple[tuple[float, float], ...]) -> "Pieces":
        """Each value from its time on; 0 before the first."""
        if points[0][0] > 0:
            points = ((0.0, 0.0), *points)
        return cls(tuple(t for t, _ in points), tuple((v,) for _, v in points))

    def piece(self, time: float) -> int:
        """The piece that holds from a time on."""
        return max(bisect_right(self.starts, time) - 1, 0)

    def at(self, time: ArrayLike) -> FloatArray:
        """Values at times, the later one at a jump."""
        t = np.asarray(time, float)
        if len(self.starts) == 1:
            return np.asarray(_value(self.coefficients[0], t), float)
        where = np.clip(np.searchsorted(self.starts, t, "right") - 1, 0, None)
        result = np.empty(t.shape)
        for index in np.unique(where):
            inside = where == index
            result[inside] = _value(self.coefficients[index], t[inside] - self.starts[index])
        return result

    def within(self, index: int, time: ArrayLike) -> FloatArray:
        """Values of one piece, wherever the times are: the limit from its own side at its ends."""
        return np.asarray(_value(self.coefficients[index], np.asarray(time, float) - self.starts[index]), float)

    def around(self, time: float) -> tuple[float, ...]:
        """Coefficients of the powers of the time since `time`, in the piece that holds from it on."""
        index = self.piece(time)
        return tuple(moved(self.coefficients[index], time - self.starts[index]))

    def next_break(self, time: float) -> float:
        """The next time at which another piece begins; infinite where none does."""
        index = bisect_right(self.starts, time)
        return self.starts[index] if index < len(self.starts) else math.inf

    def derivative(self) -> "Pieces":
        """Rate of change inside the pieces; a jump is lost."""
        rates = tuple(tuple(k * c for k, c in enumerate(piece) if k) or (0.0,) for piece in self.coefficients)
        return Pieces(self.starts, rates)

    def integral(self, start: float = 0.0) -> "Pieces":
        """Integral from 0 on, that is `start` there."""
        found = []
        for index, piece in enumerate(self.coefficients):
            grown = (start, *(c / (k + 1) for k, c in enumerate(piece)))
            found.append(grown)
            if index + 1 < len(self.starts):
                start = float(_value(grown, self.starts[index + 1] - self.starts[index]))
        return Pieces(self.starts, tuple(found))

    def times(self, factor: float) -> "Pieces":
        """The same, larger by a factor."""
        return Pieces(self.starts, tuple(tuple(factor * c for c in piece) for piece in self.coefficients))

    def plus(self, other: "Pieces") -> "Pieces":
        """Sum of two."""
        starts = tuple(sorted({*self.starts, *other.starts}))
        sums = []
        for start in starts:
            one, two = self.around(start), other.around(start)
            longest = max(len(one), len(two))
            sums.append(tuple(a + b for a, b in zip(_filled(one, longest), _filled(two, longest), strict=True)))
        return Pieces(starts, tuple(sums))

    @property
    def degree(self) -> int:
        """Highest power in any piece."""
        return max(map(len, self.coefficients)) - 1

    @property
    def jumps(self) -> bool:
        """Whether it is not continuous (rounding apart: that of the terms, which may come to nothing in the end)."""
        for index, (start, end) in enumerate(pairwise(self.starts)):
            row, lasts = self.coefficients[index], end - start
            before, after = float(_value(row, lasts)), self.coefficients[index + 1][0]
            size = max(abs(after), *(abs(one) * lasts**k for k, one in enumerate(row)))
            if abs(after - before) > 1e-9 * size:
                return True
        return False


def braking(force: float, at: float = 0.0, delay: float = 0.0, rise: float = 0.0) -> Pieces:
    """What a brake can hold that is told to close at a time: nothing for `delay`, then up to `force` along a straight
    line over `rise`."""
    begins = at + delay
    if rise > 0:
        return Pieces.through(((begins, 0.0), (begins + rise, force)))
    return Pieces.steps(((begins, force),))


def moved(coefficients: tuple[float, ...], place: float) -> list[float]:
    """Coefficients of a polynomial about another place (Horner's scheme again and again)."""
    found = list(coefficients)
    if place:
        for lowest in range(len(found) - 1):
            for k in range(len(found) - 2, lowest - 1, -1):
                found[k] += place * found[k + 1]
    return found


def _value(coefficients: tuple[float, ...], since: ArrayLike) -> FloatArray:
    since = np.asarray(since, float)
    total = np.full(since.shape, coefficients[-1])
    for c in coefficients[-2::-1]:
        total = total * since + c
    return total


def _filled(coefficients: tuple[float, ...], count: int) -> tuple[float, ...]:
    return coefficients + (0.0,) * (count - len(coefficients))
