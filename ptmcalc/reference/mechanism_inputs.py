"""Inputs of a train over time and state: signals, smooth torques, and contacts of Hunt and Crossley."""

from dataclasses import dataclass

import numpy as np

from ptmcalc.numerics.train.parts import Smooth, Spring
from ptmcalc.reference.mechanism_coordinates import Coordinates, FloatArray, State


@dataclass
class Inputs:
    """The inputs u over time and state, in an interval without breaks."""

    mechanism: Coordinates
    state: State
    start: FloatArray
    slope: FloatArray
    waves: list[tuple[int, float, float, float]]
    decays: list[tuple[int, float, float, float]]

    def __post_init__(self) -> None:
        one = self.mechanism
        self._curves = []
        for k in one.smooth:
            drive, (stage, _) = one.train.drives[k], self.state.drives[k]
            law = drive.stages[stage].law
            if isinstance(law, Smooth):
                place = (one.body_speed if law.on == "speed" else one.body_position)(drive.body)
                gate = one.level(drive.gate, self.state, 0.0) if not drive.gate.times[1:] else None
                self._curves.append((one.smooth.index(k), place[: one.first_input + 1], law.value, gate))
        self._contacts = []
        for i, k in enumerate(one.hertz):
            name, side = self.state.branches[k]
            if name == "full":
                x, rate = one.extension(k)[: one.first_input + 1], one.speed_of(one.rows[k])[: one.first_input]
                self._contacts.append((i, one.train.springs[k], side, x, rate))

    def gated(self, inside: float) -> "Inputs":
        """The same with the gates of smooth torques at their level in the interval."""
        one = self.mechanism
        levels = [one.level(one.train.drives[k].gate, self.state, inside) for k in one.smooth]
        self._curves = [(i, place, value, levels[i]) for i, place, value, _ in self._curves]
        return self

    def wide(self, t: float, y: FloatArray) -> FloatArray:
        """w at one time."""
        return self.columns(np.array([t]), y[:, None])[:, 0] if self.waves or self.decays else self._plain(t, y)

    def _plain(self, t: float, y: FloatArray) -> FloatArray:
        one = self.mechanism
        w = np.zeros(one.width)
        first, count = one.first_input, len(self.start)
        w[:first], w[first] = y, 1.0
        w[first + 1 : first + 1 + count] = self.start + t * self.slope
        at = first + 1 + count
        for i, place, value, gate in self._curves:
            if gate:
                w[at + i] = gate * value(np.array([place @ w[: first + 1]]))[0]
        at += len(one.smooth)
        for i, spring, side, x, rate in self._contacts:
            w[at + i] = _hertz(spring, side, x @ w[: first + 1], rate @ w[:first])
        return w

    def columns(self, times: FloatArray, states: FloatArray) -> FloatArray:
        """w at several times, in columns."""
        one = self.mechanism
        w = np.zeros((one.width, len(times)))
        first, count = one.first_input, len(self.start)
        w[:first], w[first] = states, 1.0
        w[first + 1 : first + 1 + count] = self.start[:, None] + self.slope[:, None] * times
        for k, size, frequency, phase in self.waves:
            w[first + 1 + k] += size * np.sin(frequency * times + phase)
        for k, size, since, constant in self.decays:
            w[first + 1 + k] += size * np.exp(-(times - since) / constant)
        at = first + 1 + count
        for i, place, value, gate in self._curves:
            if gate:
                w[at + i] = gate * value(place @ w[: first + 1])
        at += len(one.smooth)
        for i, spring, side, x, rate in self._contacts:
            w[at + i] = _hertz(spring, side, x @ w[: first + 1], rate @ w[:first])
        return w


def _hertz(spring: Spring, side: int, x: FloatArray, rate: FloatArray) -> FloatArray:
    """Force of a contact of Hunt and Crossley."""
    depth = np.maximum(side * x - spring.play / 2, 0.0)
    elastic = spring.stiffness * depth**spring.exponent
    found: FloatArray = side * elastic * (1 + 1.5 * spring.dissipation * side * rate)
    return found
