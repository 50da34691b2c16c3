"""What a march finds on its way: extremes, works, events, and the signals over time where they are kept."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ptmcalc.numerics.extremes import Extremes
from ptmcalc.numerics.panels import NODES, WEIGHTS, FloatArray

_BATCH = 512
"""Panels that are worked off at once."""


@dataclass(frozen=True, slots=True)
class Event:
    """A change of state of an element at a time."""

    time: float
    element: str
    before: str
    after: str


@dataclass(slots=True)
class Samples:
    """Signals over time, at every node that was looked at."""

    times: list[FloatArray] = field(default_factory=list)
    values: list[FloatArray] = field(default_factory=list)


@dataclass(slots=True)
class Record:
    """What a march found: extremes of the watched signals with their times, integrals of products, events."""

    products: NDArray[np.intp]
    first: FloatArray
    top: Extremes
    bottom: Extremes
    integrals: FloatArray
    samples: Samples | None = None
    began: Any = None
    """mode that holds from the start on"""
    last: FloatArray = field(default_factory=lambda: np.empty(0))
    time: float = 0.0
    state: FloatArray = field(default_factory=lambda: np.empty(0))
    mode: Any = None
    lost: float = 0.0
    finished: bool = False
    events: list[Event] = field(default_factory=list)
    steps: int = 0
    sizes: FloatArray = field(default_factory=lambda: np.empty(0))
    """largest magnitude of each signal so far"""
    _waiting: list[tuple[float, float, FloatArray]] = field(default_factory=list)
    _count: int = 0

    @classmethod
    def starting(cls, first: FloatArray, products: NDArray[np.intp], keep: bool) -> "Record":
        return cls(
            products,
            first,
            Extremes.of(len(first), 1),
            Extremes.of(len(first), -1),
            np.zeros(len(products)),
            Samples() if keep else None,
            last=first,
            sizes=np.abs(first),
        )

    def see(self, start: float, panel: float, watch: FloatArray) -> None:
        """Take in signals at the nodes of panels in a row, shape (panels, nodes, signals)."""
        self.sizes = np.maximum(self.sizes, np.abs(watch).max(axis=(0, 1)))
        self._waiting.append((start, panel, watch))
        self._count += len(watch)
        if self._count >= _BATCH:
            self.settle()

    def settle(self) -> None:
        """Work off what waits: many panels at once cost little more than one."""
        if not self._waiting:
            return
        counts = [len(watch) for _, _, watch in self._waiting]
        watch = np.concatenate([watch for _, _, watch in self._waiting])
        lengths = np.repeat([panel for _, panel, _ in self._waiting], counts)
        starts = np.concatenate([start + panel * np.arange(len(part)) for start, panel, part in self._waiting])
        self.top.see(starts, lengths, watch)
        self.bottom.see(starts, lengths, watch)
        if len(self.products):
            power = watch[:, :, self.products[:, 0]] * watch[:, :, self.products[:, 1]]
            self.integrals += lengths @ (WEIGHTS @ power)
        self.last = watch[-1, -1]
        self.steps += len(watch)
        if self.samples is not None:
            self.samples.times.append((starts[:, None] + lengths[:, None] * NODES).ravel())
            self.samples.values.append(watch.reshape(-1, watch.shape[2]))
        self._waiting.clear()
        self._count = 0

    def close(self) -> None:
        """Nothing more comes."""
        self.settle()
        self.top.settle()
        self.bottom.settle()
