"""Linear systems that the same stretch of a sine drives again and again: teeth that pass, each with a jump between.

    z' = A z + b f(t),   f(k T + s) = sin(w s + p) for 0 <= s < T

The system and the sine together are one linear system, whose exponential at the places of one pass gives every pass:
z_k -> z_(k+1) = M z_k + g is the same affine map each time. Its powers come by doubling, those of a block of passes and
those from block to block: a thousand passes are ten small matrix products, at resonance as anywhere.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ptmcalc.numerics.expm import Powers, balance

FloatArray = NDArray[np.float64]

_NEWTON = 6


@dataclass(frozen=True, slots=True)
class Wave:
    """What drives in each pass: sin(`frequency` s + `phase`) for the time `period`, then again from the beginning."""

    frequency: float
    phase: float
    period: float


def oscillators(frequencies: ArrayLike, damping_ratios: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """(A, b) of oscillators whose base is accelerated by f: q'' + 2 zeta w q' + w^2 q = -f, z = (q_1 ..., q'_1 ...)."""
    w = np.atleast_1d(np.asarray(frequencies, float))
    count, zero = len(w), np.zeros((len(w), len(w)))
    damping = np.diag(2 * np.broadcast_to(np.asarray(damping_ratios, float), w.shape) * w)
    rate = np.block([[zero, np.eye(count)], [-np.diag(w**2), -damping]])
    return rate, np.concatenate([np.zeros(count), -np.ones(count)])


def iterates(matrix: FloatArray, offset: FloatArray, start: FloatArray, count: int) -> FloatArray:
    """The first states of z -> M z + g, the start among them.

        z_k = M^k z_0 + (I + M + ... + M^(k-1)) g,  k = 0 ... count - 1

    Args:
        matrix: M, shape (n, n).
        offset: g, shape (n,).
        start: z_0, shape (n,).
        count: how many, at least 1.

    Returns:
        states, shape (count, n).

    **Error** rounding, count times that of M: the error of an angle per pass adds up.
    **Source** doubling: M_2m = M_m^2, g_2m = M_m g_m + g_m, both in one matrix.
    """
    return _seen(np.eye(len(start), len(start) + 1), matrix, offset, start, count)


def _seen(rows: FloatArray, matrix: FloatArray, offset: FloatArray, start: FloatArray, count: int) -> FloatArray:
    """Rows, shape (m, n + 1), times each of the states with a 1 behind it, shape (count, m).

    By blocks: the first state of each, times what the rows see of a block from its first state.
    """
    n, width = len(start), 1 << (count - 1).bit_length() // 2
    step = np.zeros((n + 1, n + 1))  # with a 1 behind each state map and shift are one product
    step[:n, :n], step[:n, n], step[n, n] = matrix, offset, 1.0
    inside = _powers(step, width)
    firsts = _powers(inside[width], -(-count // width) - 1) @ np.append(start, 1.0)
    return np.asarray(firsts @ (rows @ inside[:width]).reshape(-1, n + 1).T).reshape(-1, len(rows))[:count]


def _powers(matrix: FloatArray, most: int) -> FloatArray:
    """M^0 ... M^most, by doubling, shape (most + 1, n, n)."""
    found = np.empty((most + 1, *matrix.shape))
    found[0] = np.eye(len(matrix))
    found[1:2] = matrix
    filled = 1
    while filled < most:
        more = min(filled, most - filled)
        np.matmul(found[1 : more + 1], found[filled], out=found[filled + 1 : filled + more + 1])
        filled += more
    return found


class Passes:
    """The response to one wave in every pass, in any pass and at any place within it."""

    def __init__(self, rate: FloatArray, gain: FloatArray, wave: Wave, passes: int, start: ArrayLike = 0.0) -> None:
        """A shape (n, n), b shape (n,); `start` the state before the first pass."""
        n = len(rate)
        self.wave, self.passes, self._n = wave, passes, n
        whole = np.zeros((n + 2, n + 2))
        whole[:n, :n], whole[:n, n] = rate, gain
        whole[n, n + 1], whole[n + 1, n] = wave.frequency, -wave.frequency
        self._rate = whole
        scale = balance(whole)
        self._powers = Powers(whole * scale / scale[:, None])
        self._back = scale[:n, None]
        self._into = np.eye(n + 2, n + 1) / scale[:, None]  # balanced, of a state with a 1 behind it
        self._into[n:, n] = math.sin(wave.phase) / scale[n], math.cos(wave.phase) / scale[n + 1]
        self._start = np.zeros(n) + np.asarray(start, float)

    @cached_property
    def starts(self) -> FloatArray:
        """States at the beginning of all passes, shape (passes, n)."""
        return self.at([0.0], np.eye(self._n))[:, 0]

    def _step(self, times: FloatArray) -> FloatArray:
        """Maps (M, g) from the beginning of a pass, shape (times, n, n + 1)."""
        return np.asarray((self._powers.at(times)[:, : self._n] * self._back) @ self._into)

    def at(self, places: ArrayLike, watch: FloatArray) -> FloatArray:
        """Rows of `watch`, shape (m, n), times the state at places in [0, 1] of every pass: (passes, places, m)."""
        places = np.atleast_1d(np.asarray(places, float))
        maps = self._step(np.append(places, 1.0) * self.wave.period)
        rows = (watch @ maps[:-1]).reshape(-1, self._n + 1)
        seen = _seen(rows, maps[-1, :, :-1], maps[-1, :, -1], self._start, self.passes)
        return seen.reshape(self.passes, len(places), len(watch))

    def largest(self, row: FloatArray, samples: int = 41) -> tuple[float, int, float]:
        """Largest value of one row of the state, its pass and place: the root of its slope beside the largest sample.

        **Error** rounding, if the samples are close enough to find the highest wave.
        """
        places = np.linspace(0.0, 1.0, samples)
        values = self.at(places, row[None, :])[:, :, 0]
        which, sample = divmod(int(np.argmax(values)), samples)
        best, best_place = float(values[which, sample]), float(places[sample])
        low, high = float(places[max(sample - 1, 0)]), float(places[min(sample + 1, samples - 1)])
        place = best_place
        for _ in range(_NEWTON):
            value, slope, bend = self._derivatives(which, place, row)
            if value > best:
                best, best_place = value, place
            if bend >= 0:
                break
            place = min(max(place - slope / bend / self.wave.period, low), high)
        return best, which, best_place

    def _derivatives(self, which: int, place: float, row: FloatArray) -> tuple[float, float, float]:
        """Value, slope and curvature of a row in time."""
        n, time = self._n, place * self.wave.period
        step = self._step(np.array([time]))[0]
        angle = self.wave.frequency * time + self.wave.phase
        state = np.concatenate([step[:, :n] @ self.starts[which] + step[:, n], [np.sin(angle), np.cos(angle)]])
        slope = self._rate @ state
        return float(row @ state[:n]), float(row @ slope[:n]), float(row @ (self._rate @ slope)[:n])
