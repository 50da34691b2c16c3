"""Values over time that a linear system can carry as inputs: pieces of straight lines, sines and decays."""

from bisect import bisect_right
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Trigger:
    """When a signal starts: as a body's speed or position, or a link's force, rises (or falls) through a level.

    `body` is the index of that body or link, `on` is "speed", "position" or "force".
    """

    body: int
    on: str
    level: float
    rising: bool


@dataclass(frozen=True, slots=True)
class Sine:
    """size sin(frequency t + phase)."""

    size: float
    frequency: float
    phase: float


@dataclass(frozen=True, slots=True)
class Signal:
    """A piecewise linear function of the time since its start, plus sines, plus what decays from its start on.

        s(t) = values_k + slopes_k (t - times_k) + sum size sin(w t + phase) + decay exp(-(t - start)/constant)

    `times` starts with 0 and increases; before a `trigger` has fired the signal is `before`.
    """

    times: tuple[float, ...] = (0.0,)
    values: tuple[float, ...] = (0.0,)
    slopes: tuple[float, ...] = (0.0,)
    sines: tuple[Sine, ...] = ()
    decay: float = 0.0
    decay_time: float = 1.0
    decay_start: float = 0.0
    trigger: Trigger | None = None
    before: float = 0.0

    @classmethod
    def constant(cls, value: float) -> "Signal":
        return cls(values=(value,))

    @classmethod
    def constant_from(cls, value: float, trigger: Trigger) -> "Signal":
        return cls(values=(value,), trigger=trigger)

    @classmethod
    def through(cls, points: tuple[tuple[float, float], ...]) -> "Signal":
        """Straight lines through (time, value) points; the last value holds on."""
        times, values = zip(*points, strict=True)
        slopes = (*(np.diff(values) / np.diff(times)).tolist(), 0.0)
        if times[0] > 0:
            times, values, slopes = (0.0, *times), (values[0], *values), (0.0, *slopes)
        return cls(times, values, slopes)

    def piece(self, since: float) -> int:
        """The piece that holds from this time after the start on."""
        return bisect_right(self.times, since) - 1

    @property
    def largest_frequency(self) -> float:
        """Frequency of the fastest part [rad/s]."""
        return max([sine.frequency for sine in self.sines] + ([1 / self.decay_time] if self.decay else []), default=0.0)


ZERO, ONE = Signal.constant(0.0), Signal.constant(1.0)


class Now(NamedTuple):
    """Where a signal stands: its piece (-1 while it waits for its trigger) and the time it started."""

    piece: int = 0
    start: float = 0.0


@dataclass(frozen=True, slots=True)
class Inputs:
    """The input states of a system: 1, the time, a pair for every frequency, one for every decay."""

    frequencies: tuple[float, ...]
    decays: tuple[Signal, ...]

    @classmethod
    def of(cls, signals: tuple[Signal, ...]) -> "Inputs":
        frequencies = sorted({sine.frequency for signal in signals for sine in signal.sines})
        return cls(tuple(frequencies), tuple(dict.fromkeys(signal for signal in signals if signal.decay)))

    @property
    def size(self) -> int:
        return 2 + 2 * len(self.frequencies) + len(self.decays)

    def rate(self) -> FloatArray:
        """S of u' = S u."""
        rate = np.zeros((self.size, self.size))
        rate[1, 0] = 1.0
        for index, frequency in enumerate(self.frequencies):
            sine = 2 + 2 * index
            rate[sine, sine + 1], rate[sine + 1, sine] = frequency, -frequency
        for index, signal in enumerate(self.decays):
            here = 2 + 2 * len(self.frequencies) + index
            rate[here, here] = -1 / signal.decay_time
        return rate

    def start(self) -> FloatArray:
        """u at time 0."""
        u = np.zeros(self.size)
        u[0] = 1.0
        u[3 : 2 + 2 * len(self.frequencies) : 2] = 1.0
        return u

    def decay_index(self, signal: Signal) -> int:
        return 2 + 2 * len(self.frequencies) + self.decays.index(signal)

    def row(self, signal: Signal, now: Now) -> FloatArray:
        """The signal as a functional of the inputs."""
        row = np.zeros(self.size)
        if now.piece < 0:
            row[0] = signal.before
            return row
        since = now.start + signal.times[now.piece]
        row[0] = signal.values[now.piece] - signal.slopes[now.piece] * since
        row[1] = signal.slopes[now.piece]
        for sine in signal.sines:
            index = 2 + 2 * self.frequencies.index(sine.frequency)
            row[index] += sine.size * np.cos(sine.phase)
            row[index + 1] += sine.size * np.sin(sine.phase)
        if signal.decay:
            row[self.decay_index(signal)] = signal.decay
        return row
