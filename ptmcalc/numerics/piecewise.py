"""Exact propagation of piecewise-linear systems with events, and of smooth nonlinear torques on top of them.

In each mode z' = A z + B n(z) with constant A; the inputs (1, time, sines, decays) are states of their own, so a
linear mode is propagated by exp(A h) without any error of method (`flow`); a nonlinear n is a polynomial of time over
a stretch (`stretch`).

A mode holds as long as its guards g = G z stay at 0 or above. The first crossing is located on the exact solution:
between the nodes where the sign changes, and at every dip that could reach 0 and come back (a double root).
"""

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics import panels
from ptmcalc.numerics.flow import MOST_PANELS, RESOLVED, Chunk, Flow
from ptmcalc.numerics.glide import Glide
from ptmcalc.numerics.motion import Mode, System
from ptmcalc.numerics.panels import FloatArray
from ptmcalc.numerics.record import CROSSING, LONG, PANEL, Record
from ptmcalc.numerics.stretch import Piece

JAMMED = "jammed"
"""What becomes of an element that stops at once; such an event counts even at the start."""
MOST_EVENTS = 20_000
_EPS = float(np.finfo(float).eps)
_POLISHES = 3
_FIRST_PANELS = 8
_EARLY = 0.01
_GLIDES = 64
"""Panels that one long panel has to be worth, and that go by before others are tried again; the first come sooner."""
_STEADY = 8
"""Long panels tried at once after which a length that was too long is tried again."""
_SURE = 64
"""Panels after which it is asked whether longer ones will do: what moves by itself only fades."""
_LONGER = 4
"""How many times as long a long panel is tried next, or as short."""
_FEW = 4
"""Long panels that are tried at once after some were too long."""
_IDLE = 4
"""Crossings of one guard in a row that change nothing, from which on only more than the error of a curve counts."""
_SHOWN = 1e-3
"""Share of a signal that a curve over time must not leave out."""
_LOOK = 10.0
"""Panels that a look at some in a row takes beside them."""
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
    most_work: float = math.inf,
    most_looks: float = math.inf,
    unsought: Sequence[int] = (),
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
        most_work: where the march is given up, in panels; looks that come to nothing count too.
        most_looks: where the looks for summits within long panels are given up, if that is below their own limit.
        unsought: watched signals whose summits between the nodes of long panels nobody asks for: a factor of a power
            that rings on would have to be looked at in every swing.

    Raises:
        NumericsError: NUM101, too many events or steps or a nonlinear input that no stretch resolves.
    """
    marching = _March(system, tolerance, refined, most_events, most_work)
    return marching.go(mode, state, end, keep, unsought, most_looks)


class _March:
    def __init__(self, system: System, tolerance: float, refined: float, most_events: int, most_work: float) -> None:
        self.system, self.tolerance, self.most_events = system, tolerance, most_events
        self.most_work, self.work = most_work, 0.0
        self.resolved = RESOLVED * refined
        self.unheard: int | None = None
        """guard that crosses without changing anything: too flat for its sign to be told; not heard for one panel"""
        self.idle: Counter[int] = Counter()
        """how often guards crossed without changing anything, since something changed"""
        self.products = np.array(system.products, dtype=np.intp).reshape(-1, 2)
        self.pieces: dict[Mode, Piece] = {}
        self.glides: dict[Flow, Glide] = {}
        self.reach = math.inf

    def go(
        self, mode: Mode, state: FloatArray, end: float, keep: bool, unsought: Sequence[int], most_looks: float
    ) -> Record:
        system = self.system
        reaction = system.react(mode, 0.0, state, None)
        first = tuple(event for event in reaction.events if event.after == JAMMED)
        reaction = replace(reaction, events=first)  # how it starts is no event
        record = Record.starting(self._piece(reaction.mode).now(reaction.state), self.products, keep)
        record.began = reaction.mode
        record.unsought = np.array(unsought, dtype=np.intp)
        record.most_looks = min(record.most_looks, most_looks)
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
                reason = f"more than {self.most_events} events by {record.time:.6g} s: chattering"
                raise NumericsError("NUM101", reason, PANEL * self.work)
            stop, before = min(end, system.next_break(record.mode, record.time)), record.time
            fired = self._advance(record, stop)
            if fired is None:
                record.time = stop
            else:
                record.crossings += 1
                self._pay(record, CROSSING)
            still = still + 1 if record.time <= before else 0
            if still > _MOST_AT_ONCE:
                raise NumericsError("NUM101", f"contacts change without end at {record.time:.6g} s")
            reaction = system.react(record.mode, record.time, record.state, fired)
            self.unheard = fired if still and reaction.mode == record.mode else None
            changed = reaction.mode != record.mode or reaction.events
            if fired is None or changed:
                self.idle.clear()
            else:
                self.idle[fired] += 1

    def _pay(self, record: Record, work: float) -> None:
        """Take account of work before it is done, and give up where it is too much."""
        self.work += work
        if self.work > self.most_work:
            reason = f"more than {self.most_work:.2g} steps by {record.time:.3g} s: given up"
            raise NumericsError("NUM101", reason, PANEL * self.work)

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
            state, fired = self._cross(record, piece.linear, record.state / scale, stop)
            record.state = state * scale
            return fired
        self.reach, entering = (piece.entry if math.isfinite(piece.entry) else self.reach), True
        while record.time < stop:
            self._pay(record, CROSSING)
            flow, state, span = piece.stretch(record.state / scale, self.reach, stop - record.time, self.tolerance)
            self.reach = piece.reach
            if entering:
                piece.entry, entering = piece.reach, False
            until = min(stop, record.time + span)
            state, fired = self._cross(record, flow, state, until, self._blur(piece))
            record.state = state[: len(scale)] * scale
            if fired is not None:
                return fired
            record.time = until
        return None

    def _blur(self, piece: Piece) -> FloatArray | float:
        """How far below 0 guards may be without crossing: one that keeps crossing to no effect, as a torque that has
        faded does, as far as the polynomials of the curves are wrong anyway."""
        flat = [guard for guard, times in self.idle.items() if times >= _IDLE]
        if not flat:
            return 0.0
        blur = piece.blur(self.tolerance)
        found = np.zeros_like(blur)
        found[flat] = blur[flat]
        return found

    def _cross(
        self, record: Record, flow: Flow, state: FloatArray, stop: float, blur: FloatArray | float = 0.0
    ) -> tuple[FloatArray, int | None]:
        """Along a linear flow to the first crossing of a guard, or to `stop`; `blur` is how far below 0 they may be."""
        unheard, self.unheard = self.unheard, None
        count, soon = _FIRST_PANELS if unheard is None else 1, flow.soonest(state)
        before, fine, sure = _GLIDES - _FIRST_PANELS, 0.0, 0  # after the first panels a long one is tried
        while (left := stop - record.time) > 4 * _EPS * abs(stop):
            if sure <= 0 or soon < math.inf:
                fine = flow.panel(state, min(left, soon), record.sizes)
                sure = _SURE if soon == math.inf else 0
            panel = min(fine, left)
            if before >= _GLIDES and left >= _GLIDES * panel and flow.glides(_GLIDES * panel):
                before, passed = 0, self._glide(record, flow, state, panel, stop)
                if passed is not state:
                    state, sure = passed, 0
                    continue
            soon = math.inf
            wanted = max(1, min(count, int(left / panel)))
            self._pay(record, _LOOK + wanted)
            chunk = flow.chunk(panel)
            starts = chunk.starts(state, wanted)
            hit = _first_hit(flow, chunk, starts, unheard, blur)
            unheard = None
            if hit is not None:
                index, place, guard = hit
                if index == 0 and 0 < place < _EARLY:  # so long a panel places it badly: look again from near by
                    soon, sure = flow.lattice(2 * place * panel), 0
                    continue
                if index:
                    record.see(flow, record.time, panel, starts[:index])
                    record.time += index * panel
                return self._land(record, flow, starts[index], place * panel, guard), guard
            record.see(flow, record.time, panel, starts[:-1])
            record.time += wanted * panel
            before += wanted
            sure -= wanted
            state = starts[-1]
            count = min(2 * count, MOST_PANELS)
        return state, None

    def _glide(self, record: Record, flow: Flow, state: FloatArray, panel: float, stop: float) -> FloatArray:
        """On by panels far longer than this one, as long as no guard can be reached; the state from which to go on."""
        glide = self.glides.setdefault(flow, Glide(flow))
        length, longest, tries = _GLIDES * panel, flow.longest(state, record.sizes), 1
        wary = False  # some were too long
        while length >= _GLIDES * panel:
            if length > min(stop - record.time, longest):
                length /= 2
                continue
            self._pay(record, LONG * tries)
            starts = flow.chunk(length).starts(state, min(tries, int((stop - record.time) / length)))
            passed = self._passed(record, glide, length, starts)
            if passed:
                record.time += passed * length
                state = starts[passed]
                longest = flow.longest(state, record.sizes)
            if passed < len(starts) - 1:
                length, tries, wary = length / _LONGER, _FEW, True
            elif not wary and length < longest:
                length, tries = min(_LONGER * length, longest), 1
            else:  # as long as they may be, or long enough after they were too long: then longer ones are tried again
                wary = wary and tries < _STEADY
                tries = min(2 * tries, _STEADY)
        return state

    @staticmethod
    def _passed(record: Record, glide: Glide, length: float, starts: FloatArray) -> int:
        """How many long panels in a row pass over no event, nor over what a curve over time has to show; taken in."""
        bands = glide.bands(length, starts[:-1])
        if bands is None:
            return 0
        passed = glide.clear(bands, starts)
        if record.samples is not None:
            ringing = (glide.watched(bands).envelope > _SHOWN * record.sizes()).any(axis=1)
            passed = min(passed, int(ringing.argmax())) if ringing.any() else passed
        if passed:
            record.see_long(glide, length, starts[:passed], glide.watched(bands, slice(passed)))
        return passed

    @staticmethod
    def _land(record: Record, flow: Flow, start: FloatArray, length: float, guard: int) -> FloatArray:
        """The state at a crossing, by Newton's method on the exact solution from the root of the polynomial."""
        if length <= 0:
            return start
        state = flow.moved(start, length)
        record.see(flow, record.time, length, start[None])
        for _ in range(_POLISHES):
            value, slope = flow.guard(guard, state)
            change = -value / slope if slope else 0.0
            if abs(change) <= _EPS * length or abs(change) > 1e-6 * length:
                break
            speed = flow.rate @ state
            state = state + change * speed + change**2 / 2 * (flow.rate @ speed)
            length += change
        record.time += length
        return flow.on(guard, state)


def _first_hit(
    flow: Flow, chunk: Chunk, starts: FloatArray, unheard: int | None, blur: FloatArray | float
) -> tuple[int, float, int] | None:
    """(panel, place in it, guard) of the first crossing below 0 by more than rounding and `blur`, or None. One guard
    may go unheard."""
    noise = flow.noise(starts) + blur
    low: NDArray[np.bool_] = chunk.controls(starts[:-1]) < -noise
    if unheard is not None:
        low[:, :, unheard] = False
    if not low.size or not low.ravel()[first := int(low.argmax())]:
        return None
    for index in range(first * len(low) // low.size, len(low)):
        guards = np.flatnonzero(np.logical_or.reduce(low[index])).tolist()
        readings = chunk.readings(starts[index]) if guards else starts
        found = []
        for guard in guards:
            place = panels.crossing(readings[:, guard], float(noise[guard]))
            if place is not None:
                found.append((place, guard))
        if found:
            return index, *min(found)
    return None
