"""The largest value of a Fourier series whose end is known by bounds: a root of its slope, or a corner.

Between two samples the series stays above neither by more than its curvature allows; that is bounded as what lies
behind the last harmonic is (`rest`), absolutely and by Abel's summation. So the largest value is known to lie between
what the series surely reaches somewhere and what it surely exceeds nowhere.
"""

import numpy as np
from numpy.typing import NDArray

from ptmcalc.numerics.harmonic.rest import Rest

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

_PER_HARMONIC, _LEAST_SAMPLES = 4, 1024
"""Samples of the force per harmonic, and at least."""
_AT_IT = 1e-12
"""A distance from the engagement at which only the absolute sums count any more."""
_NEWTON = 4


class Search:
    """The largest value of S(x) = sum_n Im(c_n exp(2 pi i n x)) and the numbers it lies between."""

    def __init__(
        self, forces: list[ComplexArray], places: list[float], rests: list[Rest], rounding: FloatArray
    ) -> None:
        self._terms: ComplexArray = np.asarray(sum(forces))
        self._rests, self._places, self._rounding = rests, places, rounding
        speeds, count = self._terms.shape
        self._orders = np.arange(1, count + 1)
        self._samples = max(2 ** int(np.ceil(np.log2(_PER_HARMONIC * count))), _LEAST_SAMPLES)
        spectrum = np.zeros((speeds, count + 1), complex)  # none beyond
        spectrum[:, 1:] = self._terms * (-1j * (self._samples / 2))
        self._values = np.fft.irfft(spectrum, self._samples, axis=-1)
        self._stray = self._strays(forces)

    def _away(self, place: float, x: FloatArray, reach: float) -> FloatArray:
        """|sin(pi d)| at the distance d of places from the engagement of an excitation, less a reach."""
        gap = x - place - 0.5
        distance = np.abs(gap - np.round(gap))
        return np.asarray(np.maximum(np.sin(np.pi * np.maximum(distance - reach, 0.0)), _AT_IT))

    def _strays(self, forces: list[ComplexArray]) -> FloatArray:
        """Most by which S exceeds the next sample: its curvature between them, and what was left out."""
        half = 0.5 / self._samples
        x = np.arange(self._samples) / self._samples
        step = (2 * np.pi * half) ** 2 / 2
        total = self._rounding[:, None] + np.zeros(self._samples)
        for force, place, rest in zip(forces, self._places, self._rests, strict=True):
            bent = force * np.exp(2j * np.pi * self._orders * (place + 0.5)) * self._orders**2
            change = np.abs(np.diff(bent, axis=-1)).sum(axis=-1) + np.abs(bent[:, -1])
            sine = self._away(place, x, half)
            total += step * np.minimum(change[:, None] / sine, np.abs(bent).sum(axis=-1)[:, None])
            total += np.minimum(rest.variation[:, None] / sine + rest.echoes[:, None], rest.whole[:, None])
        return total

    def largest(self, sign: float) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """(value, place, low, high) of the largest of sign S, shape (speeds,) each."""
        values = sign * self._values
        rows = np.arange(len(values))
        top = np.argmax(values, axis=-1)
        start = top / self._samples
        x = start.copy()
        reach = 1 / self._samples
        for _ in range(_NEWTON):
            phase = self._terms * np.exp(2j * np.pi * x[:, None] * self._orders)
            slope = sign * np.sum(phase.real * self._orders, axis=-1)
            bend = -sign * np.sum(phase.imag * self._orders**2, axis=-1)
            step = np.divide(-slope, bend, out=np.sign(slope), where=bend < 0)
            x = np.clip(x + np.clip(step / (2 * np.pi), -reach, reach), start - reach, start + reach)
        best = sign * self._sum(x)
        sampled = values[rows, top]
        x, best = np.where(best >= sampled, x, start), np.maximum(best, sampled)
        low = best - self._left_out(x)
        for k, (place, rest) in enumerate(zip(self._places, self._rests, strict=True)):
            corner = np.full_like(x, place + 0.5)
            value = sign * (self._sum(corner) + rest.corner)
            surely = value - rest.unsure - self._left_out(corner, without=k)
            better = surely > low
            best, x, low = (np.where(better, a, b) for a, b in ((value, best), (corner, x), (surely, low)))
        high = np.maximum(np.max(values + self._stray, axis=-1), best)
        return best, np.asarray(x - np.floor(x)), low, high

    def _sum(self, x: FloatArray) -> FloatArray:
        return np.asarray(np.sum((self._terms * np.exp(2j * np.pi * x[:, None] * self._orders)).imag, axis=-1))

    def _left_out(self, x: FloatArray, without: int | None = None) -> FloatArray:
        """Bound of what the sum at places leaves out, without that of one excitation."""
        total = self._rounding
        for k, (place, rest) in enumerate(zip(self._places, self._rests, strict=True)):
            if k != without:
                total = total + np.minimum(rest.variation / self._away(place, x, 0.0) + rest.echoes, rest.whole)
        return total
