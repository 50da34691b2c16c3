"""Linear systems that the same stretch of a sine drives again and again: teeth that pass, each with a jump between.

    z' = A z + b f(t),   f(k T + s) = sin(w s + p) for 0 <= s < T

The system and the sine together are one linear system, whose exponential at the places of one pass gives every pass:
z_k -> z_(k+1) = M z_k + g is the same affine map each time. Its iterates come by doubling, since M^2m and the offset
of 2m passes follow from those of m: a thousand passes are ten small matrix products, at resonance as anywhere.
"""

from dataclasses import dataclass

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
    return _with_one(matrix, offset, start, count)[:, :-1]


def _with_one(matrix: FloatArray, offset: FloatArray, start: FloatArray, count: int) -> FloatArray:
    """The same with a 1 behind each state, so that map and shift are one product; shape (count, n + 1)."""
    n = len(start)
    states = np.empty((count, n + 1))
    states[0, :n], states[0, n] = start, 1.0
    whole = np.zeros((n + 1, n + 1))
    whole[:n, :n], whole[:n, n], whole[n, n] = matrix, offset, 1.0
    filled = 1
    while True:
        more = min(filled, count - filled)
        np.matmul(states[:more], whole.T, out=states[filled : filled + more])
        filled += more
        if filled >= count:
            break
        whole = whole @ whole
    return states


class Passes:
    """The response to one wave in every pass, in any pass and at any place within it."""

    def __init__(self, rate: FloatArray, gain: FloatArray, wave: Wave, passes: int, start: ArrayLike = 0.0) -> None:
        """A shape (n, n), b shape (n,); `start` the state before the first pass."""
        n = len(rate)
        self.wave, self.passes, self._n = wave, passes, n
        whole = np.zeros((n + 2, n + 2))
        whole[:n, :n], whole[:n, n] = rate, gain
        whole[n, n + 1], whole[n + 1, n] = wave.frequency, -wave.frequency
        self._scale = balance(whole)
        self._rate = whole
        self._powers = Powers(whole * self._scale / self._scale[:, None])
        self._driven = np.array([np.sin(wave.phase), np.cos(wave.phase)])
        step = self._step(np.array([wave.period]))[0]
        self._states = _with_one(step[:, :n], step[:, n], np.zeros(n) + np.asarray(start, float), passes)
        self.starts = self._states[:, :n]

    def _step(self, times: FloatArray) -> FloatArray:
        """Maps (M, g) from the beginning of a pass, shape (times, n, n + 1)."""
        n = self._n
        maps = self._powers.at(times)[:, :n] * self._scale[:n, None] / self._scale
        return np.concatenate([maps[:, :, :n], (maps[:, :, n:] @ self._driven)[:, :, None]], axis=-1)

    def at(self, places: ArrayLike, watch: FloatArray) -> FloatArray:
        """Rows of `watch`, shape (m, n), times the state at places in [0, 1] of every pass: (passes, places, m)."""
        maps = self._step(np.atleast_1d(np.asarray(places, float)) * self.wave.period)
        seen = np.matmul(watch, maps).reshape(-1, self._n + 1)
        return np.asarray((self._states @ seen.T).reshape(self.passes, len(maps), len(watch)))

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
