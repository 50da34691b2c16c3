"""A pendulum of small angles in a plane, under a pivot that is moved or pushed: exact piece by piece.

u = L theta is how far the load hangs beside its pivot. The rope's pull is M g, so with the length L = L_0 + V t and a
pivot of acceleration a, or one that rolls with the mass m under the force F,

    L u'' + g u = -L a                    a imposed
    L u'' + g (1 + M/m) u = -L F/m        F imposed; the pivot's own acceleration is F/m + (M/m) g theta

A length that stays gives a polynomial and a sine, exact however long the piece; where it changes, and over times too
short for the sine to keep its digits, u is a power series. With q = |V| h/L <= 1/4 its terms over the step h obey

    c_(k+2) <= q c_(k+1) + kappa c_k,     kappa = g (1 + M/m) h^2/(L N (N - 1)),  k + 2 >= N

so that what is cut off is at most what a geometric row with the ratio r, r^2 = q r + kappa, adds.
"""

import math
from bisect import bisect_right
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics import panels
from ptmcalc.numerics.extremes import Extremes
from ptmcalc.numerics.pendulum.parts import Peak
from ptmcalc.numerics.pendulum.pieces import Pieces, moved

FloatArray = NDArray[np.float64]

ANGLE, RATE, OFFSET, SPEED, ACCELERATION = "angle", "rate", "offset", "speed", "acceleration"
"""theta [rad], theta' [rad/s], u [m], speed [m/s] and acceleration [m/s^2] of the pivot."""

_TERMS = 40
_SHRINK = 0.25
"""Most of its length that a rope wins or loses over one series."""
_PHASE = 1.6
"""Radians over one series."""
_LONG = 2.0
"""Radians from which a piece of constant length is a sine."""
_PANEL = 0.8
_SEEN = 6e-12
"""Share of the largest value by which a peak may lie above the one that the panels' polynomials point at."""
_MOST_PIECES = 5_000
_MOST_PANELS = 20_000
"""Pieces of a motion, and panels in which its swings are looked at: more than a thousand swings either way."""
_AT_ONCE = 20_000
_EPS = float(np.finfo(float).eps)


@dataclass(frozen=True, slots=True)
class LinearCase:
    """What swings.

    Args:
        gravity: g, above 0 [m/s^2].
        length: L over time, above 0, piece by piece straight and without jumps [m].
        push: acceleration of the pivot over time, or the force on it over its mass m, without the rope's [m/s^2].
        mass_ratio: M/m, load over trolley, of a pivot under a force; 0 where the acceleration is imposed [1].
        angle: theta at the start, in the direction of travel [rad].
        rate: theta' at the start [rad/s].
        speed: of the pivot at the start [m/s].
    """

    gravity: float
    length: Pieces
    push: Pieces
    mass_ratio: float = 0.0
    angle: float = 0.0
    rate: float = 0.0
    speed: float = 0.0


@dataclass(frozen=True, slots=True)
class _Part:
    """u over a stretch: a power series of the share of it, plus a sine where it is long; length and push there."""

    start: float
    end: float
    row: FloatArray
    unit: float
    """time that the series counts in"""
    frequency: float
    cosine: float
    sine: float
    length: tuple[float, float]
    """L and V at the start"""
    push: tuple[float, ...]
    speed: tuple[float, ...]
    """pivot's speed without the load, in powers of the time since the start"""
    error: float
    """bound of |(theta, theta'/omega)| at the end"""


@dataclass(frozen=True, slots=True)
class LinearSwing:
    """The motion.

    `at`, `largest` and `smallest` know `angle`, `rate`, `offset`, `speed` and `acceleration` (those of the pivot).
    """

    case: LinearCase
    end: float
    parts: tuple[_Part, ...]
    _starts: list[float] = field(repr=False)

    def at(self, name: str, time: ArrayLike) -> FloatArray:
        """A signal at times from 0 to the end."""
        t = np.asarray(time, float)
        where = np.maximum(np.searchsorted(self._starts, t, "right") - 1, 0)
        result = np.empty(t.shape)
        for index in np.unique(where):
            inside = where == index
            result[inside] = self._seen(self.parts[index], name, t[inside])
        return result

    def amplitude(self, time: ArrayLike) -> FloatArray:
        """Angle of the free swing that would follow if length and speed of the pivot stayed: |(theta, theta'/w)|."""
        t = np.asarray(time, float)
        stiff = self.case.gravity * (1 + self.case.mass_ratio)
        omega = np.sqrt(stiff / self.case.length.at(t))
        return np.asarray(np.hypot(self.at(ANGLE, t), self.at(RATE, t) / omega))

    def bar(self, time: float) -> float:
        """Most by which |(theta, theta'/omega)| may be wrong at a time."""
        return self.parts[self._index(time)].error

    def largest(self, name: str, since: float = 0.0, until: float = math.inf) -> Peak:
        """Largest value of a signal in a stretch of time."""
        return self._extreme(name, 1, since, min(until, self.end))

    def smallest(self, name: str, since: float = 0.0, until: float = math.inf) -> Peak:
        """Smallest value of a signal in a stretch of time."""
        return self._extreme(name, -1, since, min(until, self.end))

    def farthest(self, name: str, since: float = 0.0, until: float = math.inf) -> Peak:
        """Largest magnitude of a signal in a stretch of time, with its sign."""
        top, bottom = self.largest(name, since, until), self.smallest(name, since, until)
        return top if top.value >= -bottom.value else bottom

    # --- parts --------------------------------------------------------------------------------------------------

    def _index(self, time: float) -> int:
        return max(bisect_right(self._starts, time) - 1, 0)

    def _seen(self, part: _Part, name: str, time: FloatArray) -> FloatArray:
        since = time - part.start
        x = since / part.unit
        u, rate = _polynomial(part.row, x)
        rate = rate / part.unit
        if part.frequency:
            phase = part.frequency * since
            c, s = np.cos(phase), np.sin(phase)
            u = u + part.cosine * c + part.sine * s
            rate = rate + part.frequency * (part.sine * c - part.cosine * s)
        if name == OFFSET:
            return u
        length = part.length[0] + part.length[1] * since
        if name == ANGLE:
            return np.asarray(u / length)
        if name == RATE:
            return np.asarray((rate - part.length[1] * u / length) / length)
        ratio = self.case.mass_ratio
        if name == SPEED:
            return np.asarray(_polynomial(np.array(part.speed), since)[0] - ratio / (1 + ratio) * rate)
        if name == ACCELERATION:
            return np.asarray(_polynomial(np.array(part.push), since)[0] + ratio * self.case.gravity * u / length)
        raise ValueError(f"a pendulum has no {name}")

    def _extreme(self, name: str, sign: int, since: float, until: float) -> Peak:
        found, size, most, panel_count = Extremes.of(1, sign), 0.0, 0.0, 0
        for index in range(self._index(since), self._index(until) + 1):
            part = self.parts[index]
            low, high = max(since, part.start), min(until, part.end)
            if high < low:
                continue
            omega = part.frequency or _PHASE / part.unit
            count = max(math.ceil((high - low) * omega / _PANEL), 1)
            panel_count += count
            if panel_count > _MOST_PANELS:
                raise NumericsError("NUM103", f"more than {_MOST_PANELS} panels are needed to resolve all oscillations")
            step = (high - low) / count
            for first in range(0, count, _AT_ONCE):
                starts = np.asarray(low + step * np.arange(first, min(first + _AT_ONCE, count)), float)
                values = self._seen(part, name, starts[:, None] + step * panels.NODES)
                size = max(size, float(np.abs(values).max()))
                found.see(starts, np.full(len(starts), step), values[:, :, None])
            most = max(most, part.error * self._per_angle(part, name))
        found.settle()
        time = float(np.clip(found.at[0], since, until))
        part = self.parts[self._index(time)]
        exact = float(self._seen(part, name, np.array([time]))[0])
        if sign * exact < sign * float(found.values[0]) - _SEEN * size:  # the last part but one, at a jump
            exact = float(found.values[0])
        return Peak(exact, time, float(most + _SEEN * size))

    def _per_angle(self, part: _Part, name: str) -> float:
        """What an error of the angle is worth in a signal."""
        length = max(part.length[0], part.length[0] + part.length[1] * (part.end - part.start))
        omega = math.sqrt(self.case.gravity * (1 + self.case.mass_ratio) / part.length[0])
        return {
            ANGLE: 1.0,
            OFFSET: length,
            RATE: 2 * omega,
            SPEED: self.case.mass_ratio * length * 2 * omega,
            ACCELERATION: self.case.mass_ratio * self.case.gravity,
        }[name]


def linear_swing(case: LinearCase, end: float) -> LinearSwing:
    """The motion of a pendulum of small angles from time 0 on.

    Args:
        case: what swings.
        end: time to look until [s].

    Returns:
        the motion.

    **Range** small angles, in a plane; a rope whose speed changes at once pulls without a jerk of the angle.
    **Error** told: rounding of sines and what the series cut off (module docstring), carried on with the largest growth
    a change of the length can cause, (L_0/L_1)^(3/4) exp(3/8 (e_0 + e_1) + 3/16 |e_1 - e_0|) with e = |V|/(g L)^(1/2).
    **Source** module docstring; growth after Liouville and Green.

    Raises:
        NumericsError: without gravity or rope, or for a motion of more than 5000 pieces.
    """
    _refuse(case, end)
    stiff = case.gravity * (1 + case.mass_ratio)
    free = case.push.integral().times(1 / (1 + case.mass_ratio))
    length, speed = case.length.around(0.0), _slope(case.length.around(0.0))
    u, rate = length[0] * case.angle, length[0] * case.rate + speed * case.angle
    held = case.speed + case.mass_ratio / (1 + case.mass_ratio) * rate
    parts: list[_Part] = []
    time, error, size = 0.0, 0.0, 0.0
    while time < end or not parts:
        if len(parts) > _MOST_PIECES:
            raise NumericsError("NUM103", f"more than {_MOST_PIECES} pieces by {time:.6g} s")
        about = case.length.around(time)
        l0, v = about[0], _slope(about)
        rate += (v - speed) * u / l0  # theta' goes on through a change of the rope's speed
        held += (v - speed) * u / l0 * case.mass_ratio / (1 + case.mass_ratio)
        speed = v
        stop = min(end, case.length.next_break(time), case.push.next_break(time))
        if l0 <= 0 or l0 + v * (stop - time) <= 0:
            raise NumericsError("NUM102", f"no rope is left at {stop:.6g} s")
        omega, push = math.sqrt(stiff / l0), case.push.around(time)
        begins = tuple(moved(free.around(time), 0.0))
        begins = (begins[0] + held, *begins[1:])
        if v == 0 and omega * (stop - time) > _LONG:
            row = _particular(push, omega)
            part = _Part(
                time, stop, row, 1.0, omega, u - row[0], (rate - _first(row)) / omega, (l0, 0.0), push, begins, 0.0
            )
            missed = 0.0
        else:
            reach = _PHASE / omega
            if v:
                reach = min(reach, _SHRINK * l0 / abs(v))
            stop = min(stop, time + reach)
            row, missed = _series(u, rate, stop - time, (l0, v), stiff, push)
            part = _Part(time, stop, row, stop - time or 1.0, 0.0, 0.0, 0.0, (l0, v), push, begins, 0.0)
        span = stop - time
        ends = l0 + v * span
        u, rate = _end_of(part, span)
        size = max(size, abs(u) / ends, abs(part.cosine) / l0, abs(part.sine) / l0, float(np.abs(row).sum()) / l0)
        error = error * _growth(l0, ends, v, case.gravity) + missed / min(l0, ends)
        error += 4 * _EPS * (1 + omega * span) * size
        parts.append(_replaced(part, error))
        time = stop
    return LinearSwing(case, end, tuple(parts), [part.start for part in parts])


def _refuse(case: LinearCase, end: float) -> None:
    if not case.gravity > 0:
        raise NumericsError("NUM102", "a load does not swing without gravity")
    if not (math.isfinite(end) and end >= 0):
        raise NumericsError("NUM102", "a motion ends at a time not before 0")
    if case.length.degree > 1 or case.length.jumps or not case.length.at(0.0) > 0:
        raise NumericsError("NUM102", "the length of a rope is above 0, and straight from corner to corner")
    if case.mass_ratio < 0:
        raise NumericsError("NUM102", "a load has no mass below 0")


def _slope(about: tuple[float, ...]) -> float:
    return about[1] if len(about) > 1 else 0.0


def _first(row: FloatArray) -> float:
    return float(row[1]) if len(row) > 1 else 0.0


def _replaced(part: _Part, error: float) -> _Part:
    return _Part(
        part.start, part.end, part.row, part.unit, part.frequency, part.cosine, part.sine, part.length, part.push,
        part.speed, error,
    )  # fmt: skip


def _particular(push: tuple[float, ...], omega: float) -> FloatArray:
    """The polynomial p with p'' + omega^2 p = -a."""
    row = [0.0] * (len(push) + 2)
    for k in range(len(push) - 1, -1, -1):
        row[k] = -(push[k] + (k + 2) * (k + 1) * row[k + 2]) / omega**2
    return np.array(row[: len(push)])


def _series(
    u: float, rate: float, h: float, length: tuple[float, float], stiff: float, push: tuple[float, ...]
) -> tuple[FloatArray, float]:
    """Terms u_k h^k of the solution, and what is cut off from u and from h u'."""
    l0, v = length
    shrink, turn = v * h / l0, stiff * h * h / l0
    forced = [0.0] * _TERMS
    power = h * h
    for k, a in enumerate(push):
        forced[k] += a * power
        forced[k + 1] += shrink * a * power
        power *= h
    c = [u, rate * h]
    for k in range(_TERMS - 2):
        c.append(-(forced[k] + shrink * (k + 1) * k * c[k + 1] + turn * c[k]) / ((k + 2) * (k + 1)))
    small = turn / (_TERMS * (_TERMS - 1))
    q = abs(shrink)
    ratio = (q + math.sqrt(q * q + 4 * small)) / 2
    last = max(abs(c[-1]), ratio * abs(c[-2]))
    return np.array(c), last * ratio * (_TERMS - (_TERMS - 1) * ratio) / (1 - ratio) ** 2


def _polynomial(row: FloatArray, x: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Value and derivative."""
    value, slope = np.full(x.shape, row[-1]), np.zeros(x.shape)
    for c in row[-2::-1]:
        slope = slope * x + value
        value = value * x + c
    return value, slope


def _end_of(part: _Part, span: float) -> tuple[float, float]:
    value, slope = _polynomial(part.row, np.array(span / part.unit))
    u, rate = float(value), float(slope) / part.unit
    if part.frequency:
        c, s = math.cos(part.frequency * span), math.sin(part.frequency * span)
        u += part.cosine * c + part.sine * s
        rate += part.frequency * (part.sine * c - part.cosine * s)
    return u, rate


def _growth(before: float, after: float, v: float, gravity: float) -> float:
    if v == 0:
        return 1.0
    one, two = (abs(v) / math.sqrt(gravity * length) for length in (before, after))
    return math.pow(before / after, 0.75) * math.exp(3 / 8 * (one + two) + 3 / 16 * abs(one - two))
