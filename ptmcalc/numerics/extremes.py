"""Largest and smallest values of smooth signals that come in panels: the nodes pick candidates, polynomials decide."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ptmcalc.numerics import panels
from ptmcalc.numerics.panels import FloatArray

_OVERSHOOT = 0.5
"""Most a summit between nodes can lie above the highest node, over the larger step beside it; 1/4 for a parabola."""


def reach_of(watch: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Largest and smallest value at the nodes of panels, of signals of shape (panels, nodes, signals)."""
    return watch.max(axis=1), watch.min(axis=1)


@dataclass(slots=True)
class Extremes:
    """The largest value of each signal and its time; `sign` -1 looks for the smallest."""

    sign: int
    best: FloatArray
    at: FloatArray
    _signals: list[FloatArray] = field(default_factory=list)
    _limits: list[FloatArray] = field(default_factory=list)
    _nodes: list[FloatArray] = field(default_factory=list)
    _starts: list[FloatArray] = field(default_factory=list)
    _lengths: list[FloatArray] = field(default_factory=list)

    @classmethod
    def of(cls, signals: int, sign: int) -> "Extremes":
        return cls(sign, np.full(signals, -np.inf), np.zeros(signals))

    def see(
        self,
        starts: FloatArray,
        lengths: FloatArray,
        watch: FloatArray,
        smooth: NDArray[np.bool_] | None = None,
        reach: tuple[FloatArray, FloatArray] | None = None,
    ) -> None:
        """Take in signals at the nodes of panels, shape (panels, nodes, signals); between the nodes only where they
        are smooth, shape (panels, signals), if that is given. `reach` is `reach_of` the same, where it is known."""
        heights, depths = reach_of(watch) if reach is None else reach
        if self.sign < 0:
            heights, depths = -depths, -heights
        peak = heights.max(axis=0)
        better = np.flatnonzero(peak > self.best)
        where = heights[:, better].argmax(axis=0)
        place = panels.NODES[(self.sign * watch[where, :, better]).argmax(axis=1)]
        self.at[better] = starts[where] + lengths[where] * place
        self.best[better] = peak[better]
        likely = heights + _OVERSHOOT * (heights - depths) > self.best
        index, signal = np.nonzero(likely if smooth is None else likely & smooth)
        nodes = self.sign * watch[index, :, signal]
        steps = np.abs(np.diff(nodes, axis=1)).max(axis=1)
        limits = heights[index, signal] + _OVERSHOOT * steps
        ends, highest = nodes @ panels.SLOPES[[0, -1]].T, nodes.argmax(axis=1)
        outside = (highest == panels.COUNT - 1) & (ends[:, 1] >= 0) | (highest == 0) & (ends[:, 0] <= 0)
        kept = ~outside & (steps > 0) & (limits > self.best[signal])
        self._signals.append(signal[kept])
        self._limits.append(limits[kept])
        self._nodes.append(nodes[kept])
        self._starts.append(starts[index[kept]])
        self._lengths.append(lengths[index[kept]])

    def settle(self) -> None:
        """Look at every candidate that could still be the summit."""
        if not self._signals:
            return
        signals, limits = np.concatenate(self._signals), np.concatenate(self._limits)
        still = limits > self.best[signals]
        signals, nodes = signals[still], np.concatenate(self._nodes)[still]
        starts, lengths = np.concatenate(self._starts)[still], np.concatenate(self._lengths)[still]
        if len(signals):
            values, places = panels.highest(nodes)
            for signal, value, time in zip(signals, values, starts + lengths * places, strict=True):
                if value > self.best[signal]:
                    self.best[signal], self.at[signal] = value, time
        for part in (self._signals, self._limits, self._nodes, self._starts, self._lengths):
            part.clear()

    @property
    def values(self) -> FloatArray:
        """The extremes, with their own sign."""
        return self.sign * self.best
