"""Exact propagation of piecewise-linear systems with events, and of smooth nonlinear torques on top of them.

In each mode z' = A z + B n(z) with constant A; the inputs (1, time, sines, decays) are states of their own, so a
linear mode is propagated by exp(A h) without any error of method. A nonlinear n is the polynomial through its values
at the nodes of a stretch, found by iteration; its slope is put into A, and a stretch is halved until the last
coefficients of what is left fall below the tolerance.

A mode holds as long as its guards g = G z stay at 0 or above. The first crossing is located on the exact solution:
between the nodes where the sign changes, and at every dip that could reach 0 and come back (a double root).
"""

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics import panels
from ptmcalc.numerics.extremes import Extremes
from ptmcalc.numerics.flow import FADED, MOST_PANELS, RESOLVED, Flow
from ptmcalc.numerics.panels import COUNT, NODES, WEIGHTS, FloatArray

Mode = Hashable
JAMMED = "jammed"
MOST_EVENTS = 20_000
_EPS = float(np.finfo(float).eps)
_NOISE = 16 * _EPS
_ORDERS = 5
"""Derivatives looked at to tell on which side of 0 a guard goes on."""
_POLISHES = 3
_MOST_ITERATIONS = 40
_SHORTEST = 1e-13
_FIRST_PANELS = 8
_FADED_SHARE = 0.1
_DIVERGED, _MOST_AHEAD = 8.0, 20.0
_BATCH = 512

_MONOMIALS = np.linalg.inv(NODES[:, None] ** np.arange(COUNT) / np.cumprod([1.0, *range(1, COUNT)]))
"""Coefficients of u^k/k! from node values, u the share of the stretch."""


@dataclass(frozen=True, slots=True)
class Curve:
    """A smooth nonlinear input n(y), y = Y z.

    `value` takes y of shape (arguments, nodes) and gives shape (nodes,); `slope` the derivative to the first argument
    at one point; `size` the size of n that the tolerance is a share of; `grain` the steps in which slopes are used.
    """

    rows: FloatArray
    value: Callable[[FloatArray], FloatArray]
    slope: Callable[[FloatArray], float]
    size: float
    grain: float


@dataclass(frozen=True, slots=True)
class Motion:
    """What holds in one mode.

    `rate` A (n, n); `gain` B (n, curves); `guards` (guards, n + curves) and `watch` (signals, n + curves) act on z
    and, behind it, on the values of the curves.
    """

    rate: FloatArray
    gain: FloatArray
    guards: FloatArray
    watch: FloatArray
    curves: tuple[Curve, ...] = ()


@dataclass(frozen=True, slots=True)
class Event:
    """A change of state of an element at a time."""

    time: float
    element: str
    before: str
    after: str


@dataclass(frozen=True, slots=True)
class Reaction:
    """What follows an event: the mode and the state after it, what happened, the energy lost in a jump."""

    mode: Mode
    state: FloatArray
    events: tuple[Event, ...] = ()
    lost: float = 0.0
    finished: bool = False


class System(Protocol):
    """What is propagated. The first `own` states are its own, the others are inputs that depend on none of them."""

    own: int
    input_speed: float

    @property
    def scale(self) -> FloatArray:
        """Sizes that make the states alike."""
        ...

    @property
    def products(self) -> Sequence[tuple[int, int]]:
        """Pairs of watched signals whose product is integrated."""
        ...

    def motion(self, mode: Any) -> Motion:
        """The equations of a mode."""
        ...

    def next_break(self, mode: Any, time: float) -> float:
        """The next time at which an input changes its form; infinite where none will."""
        ...

    def react(self, mode: Any, time: float, state: FloatArray, fired: int | None) -> Reaction:
        """The mode that holds from now on, after guard `fired` crossed, or after a break (None)."""
        ...


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
            first,
            sizes=np.abs(first),
        )

    def see(self, start: float, panel: float, watch: FloatArray) -> None:
        """Take in signals at the nodes of panels in a row, shape (panels, nodes, signals)."""
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
        self.sizes = np.maximum(self.top.best, self.bottom.best)
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


@dataclass(frozen=True, slots=True)
class Look:
    """A state seen in a mode: on which side of 0 each guard goes on."""

    system: System
    state: FloatArray

    def sides(self, mode: Mode) -> NDArray[np.intp]:
        """-1, 0 or 1 for every guard of a mode: the sign of its first derivative that is not 0 beyond rounding."""
        motion = self.system.motion(mode)
        return _sides(motion, self.state)


def _sides(motion: Motion, state: FloatArray) -> NDArray[np.intp]:
    """Signs of the guards just after a state.

    The k-th derivative of g is G A^k z; where a curve takes part it counts with its slope,
    which is exact to the second derivative.
    """
    n = len(state)
    rate, guards = motion.rate, motion.guards[:, :n]
    offset, level = 0.0, 0.0
    for index, curve in enumerate(motion.curves):
        y = curve.rows @ state
        slope, now = curve.slope(y), float(curve.value(y[:, None])[0])
        rest = now - slope * y[0]
        rate = rate + np.outer(motion.gain[:, index], slope * curve.rows[0])
        guards = guards + np.outer(motion.guards[:, n + index], slope * curve.rows[0])
        offset = offset + motion.gain[:, index] * rest
        level = level + motion.guards[:, n + index] * rest
    z, size = state, np.abs(state)
    found, noise = guards @ z + level, _NOISE * (np.abs(guards) @ size + np.abs(level))
    sides = np.where(np.abs(found) > noise, np.sign(found), 0.0)
    magnitude, allowed = np.abs(rate), _NOISE
    for _ in range(_ORDERS):
        open_ = np.flatnonzero(sides == 0)
        if not len(open_):
            break
        z, size = rate @ z + offset, magnitude @ size + np.abs(offset)
        offset, allowed = 0.0, 4 * allowed
        rows = guards[open_]
        found = rows @ z
        clear = np.abs(found) > allowed * (np.abs(rows) @ size)
        sides[open_[clear]] = np.sign(found[clear])
    return sides.astype(np.intp)


def march(
    system: System,
    mode: Mode,
    state: FloatArray,
    end: float,
    *,
    tolerance: float = 1e-9,
    refined: float = 1.0,
    keep: bool = False,
    most_events: int = MOST_EVENTS,
) -> Record:
    """The motion from a state at time 0 to `end`, through all events.

    Args:
        system: what moves.
        mode: mode at the start; it is corrected to the one that holds.
        state: z at the start, shape (n,).
        end: time to march to [s].
        tolerance: largest tail of a nonlinear input, as a share of its size.
        refined: panels over the usual ones; two runs of unlike panels share no rounding.
        keep: whether signals are kept over time.
        most_events: where a chattering contact is given up.

    Raises:
        NumericsError: NUM101, too many events or a nonlinear input that no stretch resolves.
    """
    return _March(system, tolerance, refined, most_events).go(mode, state, end, keep)


class _March:
    def __init__(self, system: System, tolerance: float, refined: float, most_events: int) -> None:
        self.system, self.tolerance, self.most_events = system, tolerance, most_events
        self.resolved = RESOLVED * refined
        self.products = np.array(system.products, dtype=np.intp).reshape(-1, 2)
        self.pieces: dict[Mode, _Piece] = {}
        self.reach = np.inf

    def go(self, mode: Mode, state: FloatArray, end: float, keep: bool) -> Record:
        system = self.system
        reaction = system.react(mode, 0.0, state, None)
        first = tuple(event for event in reaction.events if event.after == JAMMED)
        reaction = replace(reaction, events=first)  # how it starts is no event
        record = Record.starting(self._piece(reaction.mode).now(reaction.state), self.products, keep)
        record.began = reaction.mode
        while True:
            record.mode, record.state = reaction.mode, reaction.state
            record.events += reaction.events
            record.lost += reaction.lost
            if reaction.finished or record.time >= end:
                record.finished = reaction.finished
                record.close()
                return record
            if len(record.events) > self.most_events:
                raise NumericsError("NUM101", f"more than {self.most_events} events by {record.time:.6g} s: chattering")
            stop = min(end, system.next_break(record.mode, record.time))
            fired = self._advance(record, stop)
            if fired is None:
                record.time = stop
            reaction = system.react(record.mode, record.time, record.state, fired)

    def _piece(self, mode: Mode) -> "_Piece":
        piece = self.pieces.get(mode)
        if piece is None:
            piece = self.pieces[mode] = _Piece(self.system.motion(mode), self.system, self.resolved)
        return piece

    def _advance(self, record: Record, stop: float) -> int | None:
        """On to the first event or to `stop`; the guard that crossed, or None."""
        piece = self._piece(record.mode)
        scale = self.system.scale
        if not piece.motion.curves:
            state, fired = self._cross(record, piece.linear, record.state / scale, piece.guards, stop)
            record.state = state * scale
            return fired
        while record.time < stop:
            flow, state, span = piece.stretch(record.state / scale, self.reach, stop - record.time, self.tolerance)
            self.reach = piece.reach
            until = min(stop, record.time + span)
            state, fired = self._cross(record, flow, state, piece.guards, until)
            record.state = state[: len(scale)] * scale
            if fired is not None:
                return fired
            record.time = until
        return None

    def _cross(
        self, record: Record, flow: Flow, state: FloatArray, guards: int, stop: float
    ) -> tuple[FloatArray, int | None]:
        """Along a linear flow to the first crossing of a guard or to `stop`."""
        count, soon = _FIRST_PANELS, _soonest(flow, state, guards)
        sizes = np.concatenate([np.zeros(guards), record.sizes])
        while (left := stop - record.time) > 4 * _EPS * abs(stop):
            panel = flow.panel(state, min(left, soon), sizes)
            soon = np.inf
            wanted = min(count, int(left / panel))
            if wanted <= 1 or panel == left:
                panel = min(panel, left)
                readings, end = flow.read_once(state, panel)
                starts, wanted = np.array([state, end]), 1
            else:
                readings, starts = flow.read(state, panel, wanted)
            hit = _first_hit(readings[:, :, :guards], flow, starts) if guards else None
            if hit is not None:
                index, place, guard = hit
                if index:
                    record.see(record.time, panel, readings[:index, :, guards:])
                    record.time += index * panel
                state, length = self._event(record, flow, starts[index], place * panel, guard, guards)
                record.time += length
                return state, guard
            record.see(record.time, panel, readings[:, :, guards:])
            record.time += wanted * panel
            state = starts[-1]
            count = min(2 * count, MOST_PANELS)
        return state, None

    @staticmethod
    def _event(
        record: Record, flow: Flow, start: FloatArray, length: float, guard: int, guards: int
    ) -> tuple[FloatArray, float]:
        """State and time at a crossing, by Newton's method on the exact solution from the root of the polynomial."""
        row = flow.rows[guard]
        if length <= 0:
            return start, 0.0
        readings, state = flow.read_once(start, length)
        record.see(record.time, length, readings[:, :, guards:])
        for _ in range(_POLISHES):
            speed = flow.rate @ state
            slope = float(row @ speed)
            change = -float(row @ state) / slope if slope else 0.0
            if abs(change) <= _EPS * length or abs(change) > 1e-6 * length:
                break
            state = state + change * speed + change**2 / 2 * (flow.rate @ speed)
            length += change
        own = np.where(np.arange(len(row)) < flow.own, row, 0.0)
        if own.any():  # onto the guard itself, to the last digit: what follows starts from 0
            state = state - own * (float(row @ state) / float(own @ own))
        return state, length


def _soonest(flow: Flow, state: FloatArray, guards: int) -> float:
    """Time in which a guard that starts at 0 and rises could be back, g = g' t + g'' t^2/2."""
    rows = flow.rows[:guards]
    zero = np.abs(rows @ state) <= _NOISE * (np.abs(rows) @ np.abs(state))
    if not zero.any():
        return np.inf
    speed = flow.rate @ state
    first, second = rows[zero] @ speed, rows[zero] @ (flow.rate @ speed)
    back = (first > 0) & (second < 0)
    return float((-4 * first[back] / second[back]).min(initial=np.inf))


def _first_hit(readings: FloatArray, flow: Flow, starts: FloatArray) -> tuple[int, float, int] | None:
    """(panel, place in it, guard) of the first crossing below 0, or None."""
    noise = _NOISE * (np.abs(flow.rows[: readings.shape[2]]) @ np.abs(starts).max(axis=0))
    dips = _dips(readings)
    suspects = (readings.min(axis=1) < -noise) | dips.any(axis=1)
    for index in np.flatnonzero(suspects.any(axis=1)):
        found = []
        for guard in np.flatnonzero(suspects[index]):
            place = _crossing(readings[index, :, guard], dips[index, :, guard], float(noise[guard]))
            if place is not None:
                found.append((place, int(guard)))
        if found:
            return int(index), *min(found)
    return None


def _dips(readings: FloatArray) -> NDArray[np.bool_]:
    """Intervals between nodes with a minimum inside that could reach 0, shape (panels, nodes - 1, guards)."""
    slopes = np.matmul(panels.SLOPES, readings)
    falling, rising = slopes[:, :-1], slopes[:, 1:]
    lower = np.minimum(readings[:, :-1], readings[:, 1:])
    reach = 0.5 * np.diff(NODES)[:, None] * np.maximum(-falling, rising)
    near: NDArray[np.bool_] = (falling < 0) & (rising > 0) & (lower < reach)
    return near


def _crossing(nodes: FloatArray, dips: NDArray[np.bool_], noise: float) -> float | None:
    """Where a guard given at the nodes first goes below 0 in a panel, as a share of it."""
    for i in range(COUNT - 1):
        if nodes[i + 1] < -noise:
            left = NODES[i]
            if nodes[i] <= noise:  # from 0 up and back: the root is behind the summit
                left = panels.above(nodes, NODES[i], NODES[i + 1])
            return panels.root(nodes, left, NODES[i + 1])
        if dips[i]:
            lowest, place = panels.lowest(nodes, NODES[i], NODES[i + 1])
            if lowest < -noise - 1e-11 * float(np.abs(nodes).max()):
                return panels.root(nodes, NODES[i], place)
    return None


class _Piece:
    """A mode in scaled variables, with the flows it needs."""

    def __init__(self, motion: Motion, system: System, resolved: float) -> None:
        self.motion, self.system, self.resolved = motion, system, resolved
        self.guards = len(motion.guards)
        scale = system.scale
        n = len(scale)
        rows = np.vstack([motion.guards, motion.watch])
        self.rate = motion.rate * scale / scale[:, None]
        self.gain = motion.gain / scale[:, None]
        self.rows, self.direct = rows[:, :n] * scale, rows[:, n:]
        self.arguments = [curve.rows * scale for curve in motion.curves]
        self.reach = np.inf
        self._flows: dict[Hashable, Flow] = {}
        self._stretches: dict[Hashable, _Stretch] = {}

    @property
    def linear(self) -> Flow:
        """The flow of a mode without curves."""
        flow = self._flows.get("linear")
        if flow is None:
            flow = self._flows["linear"] = Flow(
                self.rate, self.rows, self.system.own, self.system.input_speed, resolved=self.resolved
            )
        return flow

    def now(self, state: FloatArray) -> FloatArray:
        """The watched signals of a state."""
        values = [float(curve.value((curve.rows @ state)[:, None])[0]) for curve in self.motion.curves]
        result: FloatArray = self.motion.watch @ np.concatenate([state, values])
        return result

    def stretch(
        self, state: FloatArray, reach: float, longest: float, tolerance: float
    ) -> tuple[Flow, FloatArray, float]:
        """A stretch on which the curves are polynomials of time: its flow, the state that goes with it, its length."""
        slopes = tuple(
            round(curve.slope(rows @ state) / curve.grain) * curve.grain
            for curve, rows in zip(self.motion.curves, self.arguments, strict=True)
        )
        span = min(reach, float(2.0 ** np.ceil(np.log2(longest))), 1e6)
        while span > _SHORTEST:
            found = self._solve(state, slopes, span, tolerance)
            if found is not None:
                flow, extended, tail = found
                self.reach = 2 * span if tail < tolerance / 256 else span
                return flow, extended, span
            span /= 2
        raise NumericsError("NUM101", "a nonlinear torque could not be resolved by any step")

    def _solve(
        self, state: FloatArray, slopes: tuple[float, ...], span: float, tolerance: float
    ) -> tuple[Flow, FloatArray, float] | None:
        """Iterate the curves' values at the nodes of a stretch until they fit the motion they cause."""
        key = (slopes, span)
        stretch = self._stretches.get(key)
        if stretch is None:
            stretch = self._stretches[key] = _Stretch(self, slopes, span, tolerance)
        free = stretch.seen_state @ state
        rest = stretch.rest(np.repeat(free.reshape(-1, COUNT)[:, :1], COUNT, axis=1))
        found, change = stretch.rest(stretch.moved(free, rest)), np.inf
        for _ in range(_MOST_ITERATIONS):
            step, before = found - rest, change
            change = float((np.abs(step) / stretch.sizes).max())
            if not change <= _DIVERGED * before:
                return None
            if change <= max(1e-3 * tolerance, 64 * _EPS):
                break
            new = stretch.rest(stretch.moved(free, found))
            bend = step - (new - found)
            size = float((bend * bend).sum())
            share = float((bend * (new - found)).sum()) / size if size > 0 else 0.0
            share = share if abs(share) < _MOST_AHEAD else 0.0
            rest = found + share * step  # Anderson's mixing of two iterates
            found = new + share * (new - found)
        else:
            return None
        rest = found
        tail = float((np.abs(rest @ panels.TO_CHEBYSHEV.T[:, -2:]) / stretch.sizes).max())
        if tail > tolerance:
            return None
        return stretch.flow, np.concatenate([state, (rest @ _MONOMIALS.T).ravel()]), tail


class _Stretch:
    """The linear system that carries the curves along as polynomials: m_k' = m_(k+1)/H, n = m_0."""

    def __init__(self, piece: _Piece, slopes: tuple[float, ...], span: float, tolerance: float) -> None:
        curves, n, count = piece.motion.curves, len(piece.rate), len(slopes)
        self.curves, self.slopes = curves, slopes
        self.sizes = np.array([[curve.size] for curve in curves])
        rate = np.zeros((n + count * COUNT, n + count * COUNT))
        rate[:n, :n] = piece.rate
        rows = np.zeros((len(piece.rows), len(rate)))
        rows[:, :n] = piece.rows
        for index, slope in enumerate(slopes):
            first = n + index * COUNT
            rate[:n, :n] += np.outer(piece.gain[:, index], slope * piece.arguments[index][0])
            rate[:n, first] = piece.gain[:, index]
            rows[:, :n] += np.outer(piece.direct[:, index], slope * piece.arguments[index][0])
            rows[:, first] = piece.direct[:, index]
            chain = np.arange(first, first + COUNT - 1)
            rate[chain, chain + 1] = 1 / span
        faded = max(FADED, _FADED_SHARE * tolerance)  # a curve joined within the tolerance keeps ringing at its size
        self.flow = Flow(rate, rows, piece.system.own, piece.system.input_speed, faded, piece.resolved)
        nodes = self.flow.at_nodes(span)
        arguments = np.vstack(piece.arguments)
        self.seen_state = (arguments @ nodes[:, :n, :n]).transpose(1, 0, 2).reshape(-1, n)
        polynomial = np.kron(np.eye(count), _MONOMIALS)
        self.seen_rest = (arguments @ nodes[:, :n, n:] @ polynomial).transpose(1, 0, 2).reshape(-1, count * COUNT)
        ends = np.cumsum([len(rows) for rows in piece.arguments])
        self.parts = [slice(end - len(rows), end) for end, rows in zip(ends, piece.arguments, strict=True)]

    def moved(self, free: FloatArray, rest: FloatArray) -> FloatArray:
        """Arguments of the curves at the nodes when their rests have these values there."""
        result: FloatArray = (free + self.seen_rest @ rest.ravel()).reshape(-1, COUNT)
        return result

    def rest(self, y: FloatArray) -> FloatArray:
        """What the curves have beyond their linear parts, at the nodes."""
        return np.array(
            [
                curve.value(y[part]) - slope * y[part][0]
                for curve, slope, part in zip(self.curves, self.slopes, self.parts, strict=True)
            ]
        )
