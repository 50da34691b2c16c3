"""A sum of damped modes that follow one input: what it comes to at several places, and between which numbers it lies.

    x_k'' + 2 zeta_k w_k x_k' + w_k^2 x_k = w_k^2 q + 2 zeta_k w_k q',   S_i = sum_k g_ki x_k + (G_i - sum_k g_ki) q

A mode that followed at once would be x = q, so the way d = x - q it strays is what is computed: d'' + 2 zeta w d' +
w^2 d = -q'', a free motion between the kinks of q, exact however long. The modes left out are taken as following at
once; what they stray is bounded.

The input is pieced together from parabolas and sines. Samples are close enough for the fastest mode to turn by half a
unit, and the second derivative of the sum bounds what it can do between two of them. After the last kink free motion
only loses energy: the march ends where what is left of it cannot reach another extreme.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.free_motion import free_motion

FloatArray = NDArray[np.float64]

MOST_SAMPLES = 4_000_000
_TURN = 0.5
"""Angle of the fastest mode from one sample to the next [rad]."""
_CHUNK = 1024
_AWAY = 1e-7
"""Share by which a sine at the frequency of an undamped mode is moved off it."""
_LOOK, _CLOSER = np.linspace(-1.0, 1.0, 17), 5


@dataclass(frozen=True, slots=True)
class Course:
    """An input over time: from `times[j]` on, a time t later,

        q = values_j + slopes_j t + bends_j t^2/2 + swings_j sin(frequency t + phases_j)

    and 0 before the first one. All shape (pieces,); the last piece goes on.
    """

    times: FloatArray
    values: FloatArray
    slopes: FloatArray
    bends: FloatArray
    swings: FloatArray
    phases: FloatArray
    frequency: float = 0.0

    @classmethod
    def step(cls) -> "Course":
        """1 from the beginning on."""
        zero, one = np.zeros(1), np.ones(1)
        return cls(zero, one, zero, zero, zero, zero)

    @classmethod
    def straight(cls, times: FloatArray, values: FloatArray) -> "Course":
        """Straight lines between values, the last one holding on; times rise from the first on."""
        zero = np.zeros(len(times))
        slopes = np.concatenate([np.diff(values) / np.diff(times), [0.0]])
        return cls(np.asarray(times, float), np.asarray(values, float), slopes, zero, zero, zero)

    def at(self, piece: int, since: FloatArray) -> FloatArray:
        """The input in a piece, so long after its beginning."""
        turned = self.swings[piece] * np.sin(self.frequency * since + self.phases[piece])
        parabola = self.values[piece] + since * (self.slopes[piece] + since * self.bends[piece] / 2)
        return np.asarray(parabola + turned)

    def slope(self, piece: int, since: float) -> float:
        """Its slope there."""
        angle = self.frequency * since + float(self.phases[piece])
        swing = float(self.swings[piece]) * self.frequency * math.cos(angle)
        return float(self.slopes[piece] + since * self.bends[piece]) + swing


@dataclass(frozen=True, slots=True)
class Modes:
    """The modes: frequencies above 0 and damping ratios, shape (k,), their gains at the places, shape (k, places), the
    gain of all modes there are, and a bound on the absolute gains of those left out, shape (places,)."""

    frequencies: FloatArray
    damping_ratios: FloatArray
    gains: FloatArray
    whole: FloatArray
    left_out: FloatArray


@dataclass(frozen=True, slots=True)
class Peaks:
    """Largest and smallest value at every place, their times, and the numbers between which they truly lie.

    The largest and the smallest of all places are summits, the others samples.
    """

    largest: FloatArray
    largest_time: FloatArray
    largest_low: FloatArray
    largest_high: FloatArray
    smallest: FloatArray
    smallest_time: FloatArray
    smallest_low: FloatArray
    smallest_high: FloatArray
    samples: int


def mode_sum(modes: Modes, course: Course, window: float) -> Peaks:
    """Extremes of the sum over a window that begins at time 0.

    Args:
        modes: the modes and the places.
        course: the input; its kinks are the beginnings of its pieces.
        window: its end [s].

    Returns:
        the extremes; the state before the input, 0, counts.

    **Error** told: `low` and `high` hold what samples miss and what the modes left out can add. They are bounds.
    **Source** module docstring.

    Raises:
        NumericsError: NUM101 where the window needs more than MOST_SAMPLES samples.
    """
    return _Sum(modes, course, window).go()


def sampled(modes: Modes, course: Course, times: FloatArray) -> FloatArray:
    """The sum at times, shape (times, places).

    Args:
        modes: the modes and the places.
        course: the input.
        times: rising, the first one 0 or later [s].

    **Error** exact for the modes there are; those left out follow at once.
    **Source** module docstring.
    """
    return _Sum(modes, course, float(times[-1])).at(times)


def kicks(course: Course, window: float) -> tuple[float, float]:
    """Sum of the jumps of an input and the variation of its slope within a window [1, Hz].

    A mode strays by no more than the jumps and the variation of the slope over its frequency: each kick sets off a free
    motion that never exceeds its beginning.
    """
    jumps = variation = 0.0
    value = slope = 0.0
    for piece, begins in enumerate(course.times):
        if begins > window:
            break
        jumps += abs(float(course.at(piece, np.zeros(1))[0]) - value)
        variation += abs(course.slope(piece, 0.0) - slope)
        length = _length(course, piece, window)
        variation += abs(float(course.bends[piece])) * length
        turns = math.ceil(course.frequency * length / math.pi)
        variation += 2 * abs(float(course.swings[piece])) * course.frequency * turns
        value, slope = float(course.at(piece, np.array([length]))[0]), course.slope(piece, length)
    return jumps, variation


def _length(course: Course, piece: int, window: float) -> float:
    ends = float(course.times[piece + 1]) if piece + 1 < len(course.times) else math.inf
    return max(min(ends, window) - float(course.times[piece]), 0.0)


class _Sum:
    def __init__(self, modes: Modes, course: Course, window: float) -> None:
        self.modes, self.course, self.window = modes, course, window
        self.w, self.zeta = modes.frequencies, modes.damping_ratios
        places = len(modes.whole)
        self.state = np.zeros((len(self.w), 2))  # (d, d')
        self.best = np.zeros((2, places))  # largest, and smallest with its sign turned
        self.limit = np.zeros((2, places))
        self.time = np.zeros((2, places))
        self.samples = 0

    def go(self) -> Peaks:
        for piece, begins, length in self._pieces():
            self._piece(piece, begins, length)
        jumps, variation = kicks(self.course, self.window)
        stray = jumps + (variation / float(self.w.max()) if variation else 0.0)
        off = self.modes.left_out * stray
        (top, bottom), (high, low) = self.best, self.limit
        return Peaks(
            top,
            self.time[0],
            np.maximum(top - off, 0.0),
            np.maximum(high, top) + off,
            -bottom,
            self.time[1],
            -np.maximum(low, bottom) - off,
            -np.maximum(bottom - off, 0.0),
            self.samples,
        )

    def at(self, times: FloatArray) -> FloatArray:
        """The sums at rising times within the window."""
        found = np.zeros((len(times), len(self.modes.whole)))
        for piece, begins, length in self._pieces():
            forced = self._forced(piece, 0.0)
            for chunk in np.split(here := np.flatnonzero(times >= begins), range(_CHUNK, len(here), _CHUNK)):
                since = times[chunk] - begins
                free = np.einsum(
                    "tmj,mj->tm", free_motion(self.w, self.zeta, since[:, None])[:, :, 0, :], self.state - forced
                )
                found[chunk] = self._sums(piece, since, free)
            self._leave(piece, length)
        return found

    def _pieces(self) -> Iterator[tuple[int, float, float]]:
        """Number, beginning and length of each piece of the input in the window; the state has taken its kink."""
        course = self.course
        value = slope = 0.0
        for piece, begins in enumerate(course.times):
            if begins > self.window:
                break
            jump = float(course.at(piece, np.zeros(1))[0]) - value
            self.state[:, 1] += 2 * self.zeta * self.w * jump - (course.slope(piece, 0.0) - slope)
            self.state[:, 0] -= jump
            length = _length(course, piece, self.window)
            yield piece, float(begins), length
            value, slope = float(course.at(piece, np.array([length]))[0]), course.slope(piece, length)

    def _leave(self, piece: int, length: float) -> None:
        """The state at the end of a piece, exactly."""
        whole = free_motion(self.w, self.zeta, np.array([length]))
        rest = self.state - self._forced(piece, 0.0)
        self.state = np.einsum("mij,mj->mi", whole, rest) + self._forced(piece, length)

    def _piece(self, piece: int, begins: float, length: float) -> None:
        """March through a piece of the input."""
        if length <= 0:
            return
        fastest = max(float(self.w.max()), self.course.frequency)
        count = math.ceil(fastest * length / _TURN) + 1
        if count > MOST_SAMPLES:
            raise NumericsError("NUM101", f"{count} samples in a window of {self.window:.4g} s")
        step = length / count
        per_chunk = min(count, _CHUNK)
        times: FloatArray = step * np.arange(per_chunk + 1, dtype=np.float64)
        maps = free_motion(self.w, self.zeta, times[:, None])
        forced = self._forced(piece, 0.0)
        free = self.state - forced
        done = 0
        steady = not self.course.bends[piece] and not self.course.swings[piece] and not self.course.slopes[piece]
        while done < count:
            if steady and self._cannot_reach(piece, free):
                break
            here = min(per_chunk, count - done)
            since = step * done + times[: here + 1]
            d = np.einsum("tmj,mj->tm", maps[: here + 1, :, 0, :], free)
            self._see(piece, begins, since, d, free, step)
            free = np.einsum("mij,mj->mi", maps[here], free)
            done += here
        self.samples += done * len(self.w)
        self._leave(piece, length)  # whatever was left out

    def _forced(self, piece: int, since: float) -> FloatArray:
        """The part of (d, d') that the bend and the sine of a piece hold up, shape (k, 2)."""
        held = np.zeros((len(self.w), 2))
        held[:, 0] = -float(self.course.bends[piece]) / self.w**2
        swing = float(self.course.swings[piece])
        if swing:
            omega = self._frequency()
            turn = self._gain() * swing * np.exp(1j * (omega * since + self.course.phases[piece]))
            held += np.stack([turn.imag, (1j * omega * turn).imag], axis=-1)
        return held

    def _frequency(self) -> FloatArray:
        """Frequency of the sine for every mode, a trifle off that of an undamped one."""
        omega = np.full_like(self.w, self.course.frequency)
        near = np.abs(omega / self.w - 1) < _AWAY
        return np.where(near, omega * (1 - _AWAY), omega)

    def _gain(self) -> NDArray[np.complex128]:
        omega = self._frequency()
        return np.asarray(omega**2 / ((self.w - omega) * (self.w + omega) + 2j * self.zeta * self.w * omega))

    def _forced_at(self, piece: int, since: FloatArray) -> FloatArray:
        """The held up part of d over time, shape (times, k)."""
        held = np.broadcast_to(-float(self.course.bends[piece]) / self.w**2, (len(since), len(self.w)))
        swing = float(self.course.swings[piece])
        if not swing:
            return held
        angle = self._frequency() * since[:, None] + self.course.phases[piece]
        return np.asarray(held + swing * (np.exp(1j * angle) * self._gain()).imag)

    def _energy(self, free: FloatArray) -> FloatArray:
        """What a free motion never exceeds."""
        return np.hypot(free[:, 0], free[:, 1] / self.w)

    def _cannot_reach(self, piece: int, free: FloatArray) -> bool:
        """Whether nothing to come in a piece of a constant input is an extreme anywhere."""
        swing = np.abs(self.modes.gains).T @ self._energy(free)
        rest = self.modes.whole * float(self.course.values[piece])
        return bool(np.all(rest + swing <= self.best[0]) and np.all(swing - rest <= self.best[1]))

    def _see(
        self, piece: int, begins: float, since: FloatArray, free: FloatArray, at_start: FloatArray, step: float
    ) -> None:
        """Take in samples of a chunk; `free` is d without its forced part."""
        sums = self._sums(piece, since, free)
        length = float(since[-1] - since[0])
        missed = self._bend(piece, at_start + self._forced(piece, float(since[0])), length) * step**2 / 8
        for side, sign in enumerate((1, -1)):
            values = sign * sums
            where = values.argmax(axis=0)
            tops = values[where, np.arange(len(where))]
            self.limit[side] = np.maximum(self.limit[side], tops + missed)
            better = tops > self.best[side]
            self.best[side, better], self.time[side, better] = tops[better], begins + since[where[better]]
            place = int(tops.argmax())
            if tops[place] + missed[place] > self.best[side].max():
                self._polish(side, _Summit(piece, begins, since, int(where[place]), at_start, step), place)

    def _polish(self, side: int, summit: "_Summit", place: int) -> None:
        """The summit beside the highest sample of all places: samples ever closer."""
        sign = (1, -1)[side]
        since, first = summit.since, float(summit.since[0])
        center, width = float(since[summit.at]), summit.step
        for _ in range(_CLOSER):
            times = np.clip(center + width * _LOOK, first, float(since[-1]))
            maps = free_motion(self.w, self.zeta, (times - first)[:, None])
            d = np.einsum("tmj,mj->tm", maps[:, :, 0, :], summit.at_start)
            values = sign * self._sums(summit.piece, times, d, place)[:, 0]
            top = int(values.argmax())
            center, width = float(times[top]), width * 2 / (len(_LOOK) - 1)
            if values[top] > self.best[side, place]:
                self.best[side, place], self.time[side, place] = float(values[top]), summit.begins + center

    def _sums(self, piece: int, since: FloatArray, free: FloatArray, place: int | None = None) -> FloatArray:
        chosen = slice(None) if place is None else slice(place, place + 1)
        q = self.course.at(piece, since)
        strayed = (free + self._forced_at(piece, since)) @ self.modes.gains[:, chosen]
        return np.asarray(q[:, None] * self.modes.whole[chosen] + strayed)

    def _bend(self, piece: int, state: FloatArray, length: float) -> FloatArray:
        """Bound of the second derivative of the sums over a length from a state (d, d') on.

        |d''| <= w^2 (1 + 2 zeta) E + |q''|,   E the root of the energy, which grows by |q''|/w per time at most
        """
        driven = abs(float(self.course.bends[piece])) + abs(float(self.course.swings[piece])) * self.course.frequency**2
        energy = self._energy(state) + driven / self.w * length
        bend = self.w**2 * (1 + 2 * self.zeta) * energy + driven
        return np.asarray(np.abs(self.modes.gains).T @ bend + np.abs(self.modes.whole) * driven)


@dataclass(frozen=True, slots=True)
class _Summit:
    """Where samples of a chunk are highest: its piece, its times, the sample, the free motion at its first one."""

    piece: int
    begins: float
    since: FloatArray
    at: int
    at_start: FloatArray
    step: float
