"""Exact propagation of piecewise-linear systems with events, and of smooth nonlinear torques on top of them.

In each mode z' = A z + B n(z) with constant A; the inputs (1, time, sines, decays) are states of their own, so a
linear mode is propagated by exp(A h) without any error of method (`flow`); a nonlinear n is a polynomial of time over
a stretch (`stretch`).

A mode holds as long as its guards g = G z stay at 0 or above. The first crossing is located on the exact solution:
between the nodes where the sign changes, and at every dip that could reach 0 and come back (a double root).
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics import panels
from ptmcalc.numerics.flow import MOST_PANELS, RESOLVED, Flow
from ptmcalc.numerics.motion import DUST, NOISE, Mode, System
from ptmcalc.numerics.panels import COUNT, NODES, FloatArray
from ptmcalc.numerics.record import Record
from ptmcalc.numerics.stretch import Piece

JAMMED = "jammed"
"""What becomes of an element that stops at once; such an event counts even at the start."""
MOST_EVENTS = 20_000
_EPS = float(np.finfo(float).eps)
_POLISHES = 3
_ROUNDING = 1e-12
_FIRST_PANELS = 8
_HALVES = np.diff(NODES)[:, None] / 2
_EARLY = 0.01
_MOST_AT_ONCE = 200
"""Events in a row without any progress in time."""


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
        self.unheard: int | None = None
        """guard that crosses without changing anything: too flat for its sign to be told; not heard for one panel"""
        self.products = np.array(system.products, dtype=np.intp).reshape(-1, 2)
        self.pieces: dict[Mode, Piece] = {}
        self.reach = np.inf

    def go(self, mode: Mode, state: FloatArray, end: float, keep: bool) -> Record:
        system = self.system
        reaction = system.react(mode, 0.0, state, None)
        first = tuple(event for event in reaction.events if event.after == JAMMED)
        reaction = replace(reaction, events=first)  # how it starts is no event
        record = Record.starting(self._piece(reaction.mode).now(reaction.state), self.products, keep)
        record.began = reaction.mode
        still = 0
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
            stop, before = min(end, system.next_break(record.mode, record.time)), record.time
            fired = self._advance(record, stop)
            if fired is None:
                record.time = stop
            still = still + 1 if record.time <= before else 0
            if still > _MOST_AT_ONCE:
                raise NumericsError("NUM101", f"contacts change without end at {record.time:.6g} s")
            reaction = system.react(record.mode, record.time, record.state, fired)
            self.unheard = fired if still and reaction.mode == record.mode else None

    def _piece(self, mode: Mode) -> "Piece":
        piece = self.pieces.get(mode)
        if piece is None:
            piece = self.pieces[mode] = Piece(self.system.motion(mode), self.system, self.resolved)
        return piece

    def _advance(self, record: Record, stop: float) -> int | None:
        """On to the first event or to `stop`; the guard that crossed, or None."""
        piece = self._piece(record.mode)
        scale = self.system.scale
        if not piece.motion.curves:
            state, fired = self._cross(record, piece.linear, record.state / scale, piece.guards, stop)
            record.state = state * scale
            return fired
        self.reach, entering = min(self.reach, piece.entry), True
        while record.time < stop:
            flow, state, span = piece.stretch(record.state / scale, self.reach, stop - record.time, self.tolerance)
            self.reach = piece.reach
            if entering:
                piece.entry, entering = 2 * span, False
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
        unheard, self.unheard = self.unheard, None
        count, soon = _FIRST_PANELS if unheard is None else 1, _soonest(flow, state, guards)
        while (left := stop - record.time) > 4 * _EPS * abs(stop):
            panel = flow.panel(state, min(left, soon), np.concatenate([np.zeros(guards), record.sizes]))
            soon = np.inf
            wanted = min(count, int(left / panel))
            if wanted <= 1 or panel == left:
                panel = min(panel, left)
                readings, end = flow.read_once(state, panel)
                starts, wanted = np.array([state, end]), 1
            else:
                readings, starts = flow.read(state, panel, wanted)
            if unheard is not None:
                readings[:, :, unheard] = 1.0
                unheard = None
            hit = _first_hit(readings[:, :, :guards], flow, starts) if guards else None
            if hit is not None:
                index, place, guard = hit
                if index == 0 and 0 < place < _EARLY:  # so long a panel places it badly: look again from near by
                    soon = 2 * place * panel
                    continue
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
            move = own * (float(row @ state) / float(own @ own))
            if np.abs(move).max() <= _ROUNDING * np.abs(state).max():
                state = state - move
        return state, length


def _soonest(flow: Flow, state: FloatArray, guards: int) -> float:
    """Time in which a guard that starts at 0 and rises could be back, g = g' t + g'' t^2/2."""
    rows = flow.rows[:guards]
    zero = np.abs(rows @ state) <= NOISE * (flow.magnitudes[:guards] @ np.abs(state))
    if not zero.any():
        return np.inf
    speed = flow.rate @ state
    first, second = rows[zero] @ speed, rows[zero] @ (flow.rate @ speed)
    back = (first > 0) & (second < 0)
    return float((-4 * first[back] / second[back]).min(initial=np.inf))


def _first_hit(readings: FloatArray, flow: Flow, starts: FloatArray) -> tuple[int, float, int] | None:
    """(panel, place in it, guard) of the first crossing below 0, or None."""
    rows, largest = flow.magnitudes[: readings.shape[2]], np.abs(starts).max(axis=0)
    dust = DUST * largest[: flow.own].max(initial=0.0)
    noise = NOISE * (rows @ largest) + dust * rows[:, : flow.own].sum(axis=1)
    dips = _dips(readings)
    suspects = (readings < -noise).any(axis=1) | dips.any(axis=1)
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
    reach = _HALVES * np.maximum(-falling, rising)
    near: NDArray[np.bool_] = (falling < 0) & (rising > 0) & (lower < reach)
    return near


def _crossing(nodes: FloatArray, dips: NDArray[np.bool_], noise: float) -> float | None:
    """Where a guard given at the nodes first goes below 0 in a panel, as a share of it."""
    values = nodes.tolist()
    for i in range(COUNT - 1):
        if values[i + 1] < -noise:
            left = NODES[i]
            if values[i] <= noise:  # from 0 up and back: the root is behind the summit
                left = panels.above(nodes, NODES[i], NODES[i + 1])
            return panels.root(nodes, left, NODES[i + 1])
        if dips[i]:
            lowest, place = panels.dip(nodes, NODES[i], NODES[i + 1])
            if lowest < -noise - 1e-11 * float(np.abs(nodes).max()):
                return panels.root(nodes, NODES[i], place)
    return None
