"""What a march finds on its way: extremes, works, events, and the signals over time where they are kept."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.extremes import Extremes, reach_of
from ptmcalc.numerics.panels import COUNT, NODES, WEIGHTS, FloatArray

if TYPE_CHECKING:
    from ptmcalc.numerics.flow import Flow
    from ptmcalc.numerics.glide import Bands, Glide

_BATCH = 256
"""Panels that are worked off at once."""
_PARTS = 4
"""A long panel that tells too little is looked at in so many."""
MOST_KEPT = 1_000_000
"""Long panels that may wait for a second look; about 400 bytes each, so that a run stays within 0.5 GB."""
_LOOKS_ONE_BY_ONE, _MOST_LOOKS, _ROUND = 4_000, 1_000_000, 40
PANEL, LONG, CROSSING = 4e-6, 15.0, 60.0
"""Seconds of a panel; how many of them a long panel and a crossing take."""
_LEAST_WORK, _MOST_TIMES = 2e4, 5.0
"""Panels that any run may take, and how many times the predicted ones."""


def most_work(seconds: float) -> float:
    """Panels after which a run is given up: many times what was predicted, so that no run takes far longer."""
    return _LEAST_WORK + _MOST_TIMES * seconds / PANEL


def too_much_memory(time: float) -> NumericsError:
    """A run that would keep more panels than its memory budget has room for, by a time [s]."""
    return NumericsError("NUM103", f"a run to {time:.3g} s needs more memory than the 0.5 GB it may take")


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


class _Long(NamedTuple):
    """Long panels of one length: when and from which states they start, and where their signals lie."""

    glide: "Glide"
    panel: float
    starts: FloatArray
    states: FloatArray
    bands: "Bands"


def _divided(panels: list[_Long]) -> Iterator[_Long]:
    """The parts of single long panels: all that belong together at once."""
    alike: dict[tuple[Glide, float], list[_Long]] = {}
    for one in panels:
        alike.setdefault((one.glide, one.panel / _PARTS), []).append(one)
    for (glide, part), ones in alike.items():
        states = np.concatenate([glide.flow.chunk(part).starts(one.states[0], _PARTS)[:-1] for one in ones])
        starts = np.add.outer(np.concatenate([one.starts for one in ones]), part * np.arange(_PARTS)).ravel()
        bands = glide.bands(part, states)
        assert bands is not None  # what a panel resolves, its parts do
        yield _Long(glide, part, starts, states, glide.watched(bands))


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
    """signals at the end"""
    _until: float = 0.0
    time: float = 0.0
    state: FloatArray = field(default_factory=lambda: np.empty(0))
    mode: Any = None
    lost: float = 0.0
    finished: bool = False
    events: list[Event] = field(default_factory=list)
    steps: int = 0
    long: int = 0
    """of the steps, the long ones"""
    crossings: int = 0
    """guards that were crossed, also where that is no event worth a name"""
    most_looks: float = _MOST_LOOKS
    """where looks for the summits within long panels are given up"""
    looks: int = 0
    """parts of long panels that were looked at again for a summit"""
    unsought: NDArray[np.intp] = field(default_factory=lambda: np.empty(0, dtype=np.intp))
    """signals whose summits within long panels nobody asks for: those at the nodes do"""
    _waiting: list["_Panels"] = field(default_factory=list)
    _count: int = 0
    _sizes: FloatArray = field(default_factory=lambda: np.empty(0))
    _sized: int = 0
    _passed: list["_Long"] = field(default_factory=list)
    _unread: int = 0
    """panels among these"""
    _kept: list["_Long"] = field(default_factory=list)
    """single long panels in which some signal could still have an extreme"""
    _squares: dict["Glide", dict[float, FloatArray]] = field(default_factory=dict)
    """sums of z z^T over the states that long panels of each length start from"""

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
        reach = reach_of(watch)
        self.top.see(starts, lengths, watch, reach=reach)
        self.bottom.see(starts, lengths, watch, reach=reach)
        self._sizes = np.maximum(self._sizes, np.maximum(self.top.best, self.bottom.best))
        if len(self.products):
            power = by_nodes.take(self.products[:, 0], axis=2)
            power *= by_nodes.take(self.products[:, 1], axis=2)
            self.integrals += lengths @ (WEIGHTS @ power.reshape(COUNT, -1)).reshape(len(lengths), -1)
        self._ends(starts[-1] + lengths[-1], watch[-1, -1])
        self.steps += len(watch)
        if self.samples is not None:
            self.samples.times.append((starts[:, None] + lengths[:, None] * NODES).ravel())
            self.samples.values.append(watch.reshape(-1, watch.shape[2]))
        self._waiting.clear()
        self._count = self._sized = 0

    def _ends(self, time: float, signals: FloatArray) -> None:
        """Signals at the end of something that was seen, which need not come in the order of time."""
        if time >= self._until:
            self.last, self._until = signals, time

    @property
    def work(self) -> float:
        """What it took, in panels: a long one takes as long as fifteen, a crossing as sixty."""
        return self.steps - self.long + LONG * self.long + CROSSING * self.crossings

    # -- long panels --------------------------------------------------------------------------------------------

    def see_long(self, glide: "Glide", panel: float, states: FloatArray, bands: "Bands") -> None:
        """Take in long panels from now and from these states on, with the bands signals lie in; they are read later."""
        if self.samples is not None:
            self.settle()  # in the order of time
        count = len(states)
        starts: FloatArray = self.time + panel * np.arange(count, dtype=float)
        self._passed.append(_Long(glide, panel, starts, states, bands))
        self._unread += count
        self._sizes = np.maximum(self._sizes, np.abs(bands.nodes[:, -1]).max(axis=0))
        if self.samples is not None:
            self.samples.times.append(np.add.outer(starts, panel * NODES).ravel())
            self.samples.values.append(bands.nodes.reshape(-1, bands.nodes.shape[2]))
        if len(self.products):
            squares = self._squares.setdefault(glide, {})
            squares[panel] = squares.get(panel, 0.0) + states.T @ states
        self._ends(self.time + count * panel, bands.nodes[-1, -1])
        self.steps += count
        self.long += count
        if self._unread >= _BATCH:
            self._look()

    def _look(self) -> None:
        """Extremes in the long panels that were passed: at their nodes; between them at once where a signal has no
        fast part, and later where it has one that could make it an extreme."""
        passed, self._passed, self._unread = self._passed, [], 0
        if not passed:
            return
        counts = [len(one.starts) for one in passed]
        starts, lengths = (
            np.concatenate([one.starts for one in passed]),
            np.repeat([one.panel for one in passed], counts),
        )
        nodes, low, high, envelope = (np.concatenate(one) for one in zip(*(one.bands for one in passed), strict=True))
        smooth: NDArray[np.bool_] = np.less_equal(envelope, self._least(passed))
        reach = reach_of(nodes)
        self.top.see(starts, lengths, nodes, smooth, reach)
        self.bottom.see(starts, lengths, nodes, smooth, reach)
        low[smooth], high[smooth] = np.inf, -np.inf
        low[:, self.unsought], high[:, self.unsought] = np.inf, -np.inf
        read = type(passed[0].bands)(nodes[:, :0], low, high, envelope)  # nodes are seen, and would fill the memory
        owners = [(one, k) for one in passed for k in range(len(one.starts))]
        for place in np.flatnonzero(self._promising(passed, low, high).any(axis=1)).tolist():
            one, k = owners[place]
            bands = read.part(slice(place, place + 1))
            self._kept.append(_Long(one.glide, one.panel, one.starts[k : k + 1], one.states[k : k + 1], bands))
        if len(self._kept) > MOST_KEPT:
            self._forget()

    def _forget(self) -> None:
        """Leave out kept panels that promise nothing any more; given up where the others are still too many."""
        low, high = (np.concatenate([getattr(one.bands, side) for one in self._kept]) for side in ("low", "high"))
        promising: NDArray[np.bool_] = np.any(self._promising(self._kept, low, high), axis=1)
        self._kept = [one for one, promises in zip(self._kept, promising.tolist(), strict=True) if promises]
        if len(self._kept) > MOST_KEPT / 2:
            raise too_much_memory(self.time)

    def _least(self, panels: list["_Long"]) -> FloatArray:
        """What an extreme in panels may be missed by: what may be left out of a signal anyway."""
        return min(one.glide.flow.faded for one in panels) * np.maximum(self.top.best, self.bottom.best)

    def _promising(self, panels: list["_Long"], low: FloatArray, high: FloatArray) -> FloatArray:
        """By how much signals could lie beyond their extremes in panels with these bounds, shape (panels, signals), or
        0."""
        beyond: FloatArray = np.maximum(high - self.top.best, -low - self.bottom.best)
        beyond[beyond <= self._least(panels)] = 0.0
        return beyond

    def _look_again(self) -> None:
        """The extremes in long panels, best first: of each signal the panel that promises most is divided, until none
        promises more than what has been found; all of them where that takes long."""
        self._look()
        rounds = 0
        while self._kept:
            self.top.settle()
            self.bottom.settle()
            low, high = (np.concatenate([getattr(one.bands, side) for one in self._kept]) for side in ("low", "high"))
            beyond = self._promising(self._kept, low, high)
            chosen: NDArray[np.bool_] = np.any(beyond, axis=1)
            if self.looks < _LOOKS_ONE_BY_ONE:
                chosen &= np.isin(np.arange(len(chosen)), beyond.argmax(axis=0))
            kept, self._kept = self._kept, []
            self._passed = list(_divided([kept[k] for k in np.flatnonzero(chosen)]))
            self._kept = [kept[k] for k in np.flatnonzero(np.any(beyond, axis=1) & ~chosen)]
            self.looks += _PARTS * len(np.flatnonzero(chosen))
            self._look()
            rounds += 1
            if self.looks + _ROUND * rounds > self.most_looks:
                raise NumericsError("NUM101", "the summits of a vibration as fast as this cannot be separated")

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
        for glide, squares in self._squares.items():
            self.integrals += glide.works(squares, self.products)
        self._look_again()
        self.top.settle()
        self.bottom.settle()
