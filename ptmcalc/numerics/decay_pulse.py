"""Oscillator at rest under a pulse that rises fast, decays slowly and ends; its free vibration afterwards.

    x'' + 2 zeta w x' + w^2 x = f(t),   f = a (exp(-l_1 t) - exp(-l_2 t)) for 0 < t < tau, 0 after it

Duhamel's integral of exponentials is a divided difference of exp over the exponents of system and force,

    x = a (l_2 - l_1) t^3 exp[p_1 t, p_2 t, -l_1 t, -l_2 t]      x' = a (l_2 - l_1) t^2 (exp[all but q] + q t exp[all])

q an exponent not beyond w; see `numerics.exponentials`. Nothing cancels where exponents meet (resonance of real
exponents, critical damping, no spring) nor in short times. From where all exponents times t lie farther apart than 1,
nothing cancels in the sum of partial fractions either, which costs many times less:

    x = a (l_2 - l_1) sum_i exp(z_i t)/prod_(j != i) (z_i - z_j),   z = p_1, p_2, -l_1, -l_2
"""

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.distinct import distinct
from ptmcalc.numerics.exponentials import FEW, differences, superposed
from ptmcalc.numerics.free_motion import free_motion

FloatArray = NDArray[np.float64]

_PER_PERIOD, _CHUNK, _MOST_CHUNKS = 16, 32, 64
_PLACES = 160
_NEWTON = 60
_LOST = 1e15
_TIE = 1e-12


@dataclass(frozen=True, slots=True)
class Summit:
    """Largest deflection by size, with its sign, its time, and the most by which the size may be wrong."""

    value: float
    time: float
    error: float


@dataclass(frozen=True, slots=True)
class DecayPulse:
    """The oscillator and its pulse.

    Args:
        natural_frequency: w, 0 for a mass without spring [rad/s].
        damping_ratio: zeta, also above 1 [1].
        slow: l_1, decay of the pulse, 0 for one that stays [1/s].
        fast: l_2, its rise [1/s].
        acceleration: a, force over mass [m/s^2].
        duration: tau [s].
    """

    natural_frequency: float
    damping_ratio: float
    slow: float
    fast: float
    acceleration: float
    duration: float

    def force(self, time: ArrayLike) -> FloatArray:
        """f at given times, as a (exp(-l_1 t) expm1-form of the difference) without cancellation [m/s^2]."""
        t = np.asarray(time, float)
        low, high = sorted((self.slow, self.fast))
        sign = 1.0 if self.fast >= self.slow else -1.0
        inside = (t >= 0) & (t <= self.duration)
        t = np.where(inside, t, 0.0)
        return np.asarray(-sign * self.acceleration * np.exp(-low * t) * np.expm1(-(high - low) * t))

    def at(self, time: ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Deflection and speed at given times.

        Args:
            time: t >= 0, any shape; rising times are faster [s].

        Returns:
            x [m] and x' [m/s].

        **Error** rounding, eps (10 + 3 w t) of the largest deflection.
        **Source** module docstring; after the pulse the free motion from its end.
        """
        t = np.asarray(time, float)
        flat = t.ravel()
        order = None if (flat[1:] >= flat[:-1]).all() else np.argsort(flat, kind="stable")
        rising = flat if order is None else flat[order]
        count = int(rising.searchsorted(self.duration, "right"))
        if count == len(rising):
            motion = self._during(rising)
        else:
            there = count > 0 and rising[count - 1] == self.duration  # once: even samples are faster
            before = self._during(rising[:count] if there else np.append(rising[:count], self.duration))
            after = self._after(float(before[0, -1]), float(before[1, -1]), rising[count:] - self.duration)
            motion = np.concatenate([before[:, :count], after], axis=1)
        if order is not None:
            motion[:, order] = motion.copy()
        x, v = motion.reshape(2, *t.shape)
        return x, v

    def largest(self) -> Summit:
        """Largest deflection during and after the pulse: where the speed is 0, or where the pulse ends.

        Brackets come from 16 places per period and from places spread over all decades, the zero by Newton's method
        kept within them. The search goes on until nothing behind can be larger: behind the inflection of the force

            w^2 |x| <= f + w ((w y)^2 + y'^2)^(1/2) + |f'|/w + 2 zeta f,   y = x - f/w^2,

        since y'' + 2 zeta w y' + w^2 y = -f''/w^2 - 2 zeta f'/w feeds its energy no faster; and at any time
        of the pulse

            w^2 |x| <= max f + 4 (1 + 4 zeta) |f'(0)|/w,

        by parts: the slope of f varies by 3 |f'(0)| at most, and what a step lacks of its deflection at rest has no
        integral above (1 + 4 zeta)/w. Of deflections equal but for rounding, the first counts.

        **Error** rounding and, if the search had to stop, how far the lower of these bounds lies above the summit.
        **Source** derived.

        Raises:
            NumericsError: without a spring, where nothing turns the mass back; for a phase that has lost its fraction.
        """
        w = self.natural_frequency
        if w <= 0:
            raise NumericsError("NUM101", "a mass without a spring has no largest deflection")
        if self.acceleration == 0 or self.slow == self.fast or self.duration == 0:
            return Summit(0.0, 0.0, 0.0)
        if w * self.duration > _LOST:
            raise NumericsError("NUM102", f"a phase of {w * self.duration:.1e} rad has lost its fraction")
        length = _CHUNK * self._stretch
        crest = self._crest
        beside = self._places(crest - length / 2, crest + length / 2) if self.duration > length else np.empty(0)
        places = distinct(np.concatenate([self._decades, beside, self._places(0.0, length)]))
        best, begin = self._better(Summit(0.0, 0.0, 0.0), places), 0.0
        for chunk in range(_MOST_CHUNKS):
            if chunk > 0:
                best = self._better(best, self._places(begin, begin + length))
            begin = min(begin + length, self.duration)
            behind = 0.0 if begin >= self.duration else self._most_behind(begin)
            if behind <= abs(best.value):
                break
        best = self._better(best, self.duration + self._afterwards)
        missed = max(0.0, min(behind, self._most_at_all) - abs(best.value))
        rounding = (_TIE + np.finfo(float).eps * (16 + w * best.time)) * abs(best.value)
        return Summit(best.value, best.time, float(rounding + missed))

    # --- parts --------------------------------------------------------------------------------------------------

    @property
    def _stretch(self) -> float:
        """A period, or the time in which an overdamped oscillator comes back [s]."""
        w, zeta = self.natural_frequency, self.damping_ratio
        if zeta < 1:
            return 2 * math.pi / (w * max(math.sqrt((1 - zeta) * (1 + zeta)), 0.05))
        return (zeta + math.sqrt((zeta - 1) * (zeta + 1))) / w

    @property
    def _decades(self) -> FloatArray:
        """Places of the pulse over all its time scales: a mass without waves turns no sooner than the force."""
        return _spread(min(1e-2 / max(self.slow, self.fast), 1e-2 * self.duration), self.duration)

    @property
    def _afterwards(self) -> FloatArray:
        """Places of the free motion until it has turned back, from the end of the pulse."""
        if self.damping_ratio < 1:
            return np.linspace(0.0, 2 * self._stretch, 4 * _PER_PERIOD + 1)
        first = 1e-2 / (2 * self.damping_ratio * self.natural_frequency)
        return np.concatenate([[0.0], _spread(first, 40 * self._stretch)])

    def _places(self, begin: float, end: float) -> FloatArray:
        """Places at equal distances within the pulse."""
        return np.linspace(max(0.0, begin), min(end, self.duration), _CHUNK * _PER_PERIOD + 1)

    @property
    def _crest(self) -> float:
        """Time of the largest force [s]."""
        low, high = sorted((self.slow, self.fast))
        return min(self.duration, math.log(high / low) / (high - low)) if low > 0 else self.duration

    @property
    def _most_at_all(self) -> float:
        """Bound of the deflection during the pulse."""
        w, slope = self.natural_frequency, abs(self.acceleration * (self.fast - self.slow))
        ripple = 4 * (1 + 4 * self.damping_ratio) * slope / w
        return (abs(float(self.force(self._crest))) + ripple) / w / w

    def _after(self, x: float, v: float, time: FloatArray) -> FloatArray:
        """Free motion from a deflection and a speed, shape (2, times)."""
        w, zeta = self.natural_frequency, self.damping_ratio
        if w == 0 or zeta >= 1:
            maps = free_motion(np.array([w]), np.array([zeta]), time[:, None])[:, 0]
            return np.asarray(maps @ (x, v)).T
        decay, damped = zeta * w, w * math.sqrt((1 - zeta) * (1 + zeta))
        place = complex(x, -(v + decay * x) / damped)
        speed = complex(v, (w * w * x + decay * v) / damped)
        return superposed((complex(-decay, damped),), np.array([[place], [speed]]), time)

    def _better(self, best: Summit, places: FloatArray) -> Summit:
        """The best of a summit and those between places, which rise."""
        x, v = self.at(places)
        best = _first_of(best, x, places)
        turned = (v[:-1] > 0) & (v[1:] <= 0) | (v[:-1] < 0) & (v[1:] >= 0)
        near = np.maximum(np.abs(x[:-1]), np.abs(x[1:])) > 0.9 * abs(best.value)
        cells = np.flatnonzero(turned & near)
        if not len(cells):
            return best
        low, high, rising = places[cells], places[cells + 1], v[cells] > 0
        t = (low + high) / 2
        for _ in range(_NEWTON):
            x, v = self.at(t)
            before = (v > 0) == rising
            low, high = np.where(before, t, low), np.where(before, high, t)
            bend = self.force(t) - self.natural_frequency * (2 * self.damping_ratio * v + self.natural_frequency * x)
            step = np.divide(v, bend, out=np.full_like(v, np.inf), where=bend != 0)
            new = t - step
            new = np.where((new > low) & (new < high), new, (low + high) / 2)
            if np.all(np.abs(new - t) <= 1e-9 * self._stretch / (2 * math.pi)):
                break  # the deflection is stationary here: an error of 1e-9 rad is one of 1e-18 in it
            t = new
        return _first_of(best, self.at(t)[0], t)

    def _most_behind(self, time: float) -> float:
        """Bound of the deflection after a time; infinite before the inflection of the force."""
        w, zeta, low, high = self.natural_frequency, self.damping_ratio, *sorted((self.slow, self.fast))
        if low == 0 or 2 * math.log(high / low) / (high - low) > time:
            return math.inf
        x, v = (float(part) for part in self.at(time))
        size = abs(self.acceleration)
        f = abs(float(self.force(time)))
        sign = 1.0 if (self.acceleration > 0) == (self.fast > self.slow) else -1.0
        slope = size * (high * math.exp(-high * time) - low * math.exp(-low * time))
        y, speed = sign * x - f / w**2, sign * v - slope / w**2
        return (f + w * math.hypot(w * y, speed) + abs(slope) / w + 2 * zeta * f) / w / w

    def _during(self, t: FloatArray) -> FloatArray:
        """Motion in the pulse, shape (2, times)."""
        of = _exponents(self.natural_frequency, self.damping_ratio, self.slow, self.fast)
        late = int(t.searchsorted(of.apart, "right"))
        if len(t) - late < FEW:
            return self._early(of, t)
        sums = superposed(of.rates, self.acceleration * of.weights, t[late:])
        return np.concatenate([self._early(of, t[:late]), sums], axis=1)

    def _early(self, of: "_Exponents", t: FloatArray) -> FloatArray:
        whole, part = differences(of.points, (of.everything, of.rest), t)
        scale = self.acceleration * (self.fast - self.slow) * t * t
        turned = whole * t
        return np.array([scale * turned.real, scale * (part + of.points[of.least] * turned).real])


def _first_of(best: Summit, x: FloatArray, times: FloatArray) -> Summit:
    """The first of the largest of rising times, if it is larger than the best so far."""
    size = np.abs(x)
    top = int(np.argmax(size >= size.max() * (1 - _TIE)))
    return Summit(float(x[top]), float(times[top]), 0.0) if size[top] > abs(best.value) * (1 + _TIE) else best


def _spread(first: float, last: float) -> FloatArray:
    """Places 8 per decade or more."""
    return np.geomspace(first, last, max(_PLACES, 8 * math.ceil(math.log10(last / first))))


class _Exponents(NamedTuple):
    """The exponents of system and force; the one that is left out of the speed's difference, all, and the rest.

    From the time `apart` on all are farther apart than 1, and x and v of a = 1 the real parts of sums of exp(`rates` t)
    with `weights`, shape (2, rates).
    """

    points: tuple[complex, ...]
    least: int
    everything: tuple[int, ...]
    rest: tuple[int, ...]
    apart: float
    rates: tuple[complex, ...]
    weights: NDArray[np.complex128]


@lru_cache(maxsize=64)
def _exponents(natural_frequency: float, damping_ratio: float, slow: float, fast: float) -> _Exponents:
    points = (*_roots(natural_frequency, damping_ratio), complex(-slow), complex(-fast))
    everything = tuple(range(4))
    _, *apart = max((abs(points[i] - points[j]), i, j) for i in everything for j in range(i))
    least = min(apart, key=lambda i: abs(points[i]))  # left out of the whole already
    if abs(points[least]) > natural_frequency:
        least = min(everything, key=lambda i: abs(points[i]))
    rest = everything[:least] + everything[least + 1 :]
    nearest = min(abs(points[i] - points[j]) for i in everything for j in range(i))
    if nearest == 0:
        return _Exponents(points, least, everything, rest, math.inf, (), np.empty((2, 0), complex))
    paired = points[0].imag != 0  # the second is the conjugate of the first: twice the real part
    used = tuple(i for i in everything if not (paired and i == 1))
    shares = []
    for i in used:
        share = complex(2 * (fast - slow) if paired and i == 0 else fast - slow)
        for j in everything:
            share /= points[i] - points[j] if j != i else 1
        shares.append(share)
    rates = tuple(points[i] for i in used)
    weights = np.array([shares, np.multiply(shares, rates)])
    return _Exponents(points, least, everything, rest, 1 / nearest, rates, weights)


def _roots(natural_frequency: float, damping_ratio: float) -> tuple[complex, complex]:
    """Exponents of the free vibration."""
    if damping_ratio < 1:
        decay = -damping_ratio * natural_frequency
        damped = natural_frequency * math.sqrt((1 - damping_ratio) * (1 + damping_ratio))
        return complex(decay, damped), complex(decay, -damped)
    sum_of = damping_ratio + math.sqrt((damping_ratio - 1) * (damping_ratio + 1))
    return complex(-natural_frequency / sum_of), complex(-natural_frequency * sum_of)
