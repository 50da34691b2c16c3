"""What a march finds on its way: extremes, works, events, and the signals over time where they are kept."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ptmcalc.numerics.extremes import Extremes
from ptmcalc.numerics.panels import COUNT, NODES, WEIGHTS, FloatArray

if TYPE_CHECKING:
    from ptmcalc.numerics.flow import Flow

_BATCH = 256
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


class _Panels(NamedTuple):
    """Panels in a row that wait to be read."""

    flow: "Flow"
    start: float
    panel: float
    states: FloatArray


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
    _waiting: list["_Panels"] = field(default_factory=list)
    _count: int = 0
    _sizes: FloatArray = field(default_factory=lambda: np.empty(0))
    _sized: int = 0

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
            _sizes=np.abs(first),
        )

    def see(self, flow: "Flow", start: float, panel: float, states: FloatArray) -> None:
        """Take in panels in a row from these states on; they are read when many have come."""
        self._waiting.append(_Panels(flow, start, panel, states))
        self._count += len(states)
        if self._count >= _BATCH:
            self.settle()

    def sizes(self) -> FloatArray:
        """Largest magnitude of each signal so far, at the starts of panels."""
        for waiting in self._waiting[self._sized :]:
            found = np.abs(waiting.states @ waiting.flow.watch.T).max(axis=0)
            self._sizes = np.maximum(self._sizes, found)
        self._sized = len(self._waiting)
        return self._sizes

    def settle(self) -> None:
        """Work off what waits: many panels at once cost little more than one."""
        if not self._waiting:
            return
        counts = [len(waiting.states) for waiting in self._waiting]
        lengths = np.repeat([waiting.panel for waiting in self._waiting], counts)
        starts = np.concatenate([one.start + one.panel * np.arange(len(one.states)) for one in self._waiting])
        by_nodes = self._watched(lengths)
        watch = by_nodes.transpose(1, 0, 2)
        self.top.see(starts, lengths, watch)
        self.bottom.see(starts, lengths, watch)
        self._sizes = np.maximum(self.top.best, self.bottom.best)
        if len(self.products):
            power = by_nodes[:, :, self.products[:, 0]] * by_nodes[:, :, self.products[:, 1]]
            self.integrals += lengths @ (WEIGHTS @ power.reshape(COUNT, -1)).reshape(len(lengths), -1)
        self.last = watch[-1, -1]
        self.steps += len(watch)
        if self.samples is not None:
            self.samples.times.append((starts[:, None] + lengths[:, None] * NODES).ravel())
            self.samples.values.append(watch.reshape(-1, watch.shape[2]))
        self._waiting.clear()
        self._count = self._sized = 0

    def _watched(self, lengths: FloatArray) -> FloatArray:
        """Signals at the nodes of all that waits, shape (nodes, panels, signals): all panels of a flow at once."""
        alike: dict[tuple[Flow, float], tuple[list[int], list[FloatArray]]] = {}
        place = 0
        for waiting in self._waiting:
            panel = waiting.panel if waiting.flow.keeps(waiting.panel) else 0.0
            places, states = alike.setdefault((waiting.flow, panel), ([], []))
            places.extend(range(place, place + len(waiting.states)))
            states.append(waiting.states)
            place += len(waiting.states)
        watch = np.empty((COUNT, place, len(self.first)))
        for (flow, panel), (places, states) in alike.items():
            found = np.concatenate(states)
            watch[:, places] = flow.seen(panel, found) if panel else flow.seen_once(lengths[places], found)
        return watch

    def close(self) -> None:
        """Nothing more comes."""
        self.settle()
        self.top.settle()
        self.bottom.settle()
