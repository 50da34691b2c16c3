"""A march of a mast and what is read from it: extremes, events, energy, when it stands, when it has settled."""

import math
from dataclasses import dataclass

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.base.memory import kept_for
from ptmcalc.numerics.energy import residual
from ptmcalc.numerics.mast.case import FREE, MOVED, Case
from ptmcalc.numerics.mast.modes import left_out
from ptmcalc.numerics.mast.parts import FloatArray
from ptmcalc.numerics.mast.settling import Ring, Settled, settling
from ptmcalc.numerics.mast.system import MastSystem
from ptmcalc.numerics.piecewise import march
from ptmcalc.numerics.record import LONG, Record

MOST_EVENTS = 4000
_JUST_AFTER = 1e-9
"""Radians of the fastest mode by which a state is taken later than an event, so that the event is over."""


@dataclass(frozen=True, slots=True)
class Course:
    """One run of a case. `residual` is what the works of forces, damping and shocks and the stored energy leave over,
    as a share of the energy turned over."""

    case: Case
    system: MastSystem
    record: Record
    residual: float

    def top(self, what: str, index: int = 0) -> tuple[float, float]:
        """Largest value of a watched signal and its time."""
        place = self.system.watched[what, index]
        return float(self.record.top.values[place]), float(self.record.top.at[place])

    def bottom(self, what: str, index: int = 0) -> tuple[float, float]:
        """Smallest value of a watched signal and its time."""
        place = self.system.watched[what, index]
        return float(self.record.bottom.values[place]), float(self.record.bottom.at[place])

    def largest(self, what: str, index: int = 0) -> tuple[float, float]:
        """Largest magnitude of a watched signal and its time."""
        high, low = self.top(what, index), self.bottom(what, index)
        return high if high[0] >= -low[0] else (-low[0], low[1])

    def over_time(self, what: str, index: int = 0) -> tuple[FloatArray, FloatArray]:
        """Times and values of a watched signal of a run that keeps them."""
        samples = self.record.samples
        if samples is None:
            raise ValueError("a run that keeps nothing has no history")
        times = np.maximum.accumulate(np.concatenate(samples.times))  # an event may move by a rounding
        return times, np.concatenate(samples.values)[:, self.system.watched[what, index]]

    def first(self, element: str, after: str) -> float:
        """When an element first came to a state; infinite where it never did [s]."""
        found = (event.time for event in self.record.events if event.element == element and event.after == after)
        return float(next(found, math.inf))

    @property
    def held_since(self) -> float:
        """Since when the base is held, up to the end of the run; infinite where it is not [s]."""
        base = self.record.mode.base
        if base == MOVED:
            return self.system.breaks[-1] if self.record.time >= self.system.breaks[-1] else math.inf
        if not base % 2:
            return math.inf
        times = [event.time for event in self.record.events if event.element == "base"]
        return float(times[-1]) if times else 0.0

    @property
    def stays(self) -> bool:
        """Whether the base is held for good at the end of the run, and nothing is touched: nothing can wake it."""
        return _stays(self)

    def most_later(self, what: str, index: int = 0) -> float:
        """What a watched signal never exceeds after the end of a run whose base stays held: all its modes in phase."""
        system, z = self.system, self.record.state
        row = system.motion(self.record.mode).watch[system.watched[what, index]]
        steady = abs(float(row[:2] @ z[:2])) + abs(float(row[system.own :] @ z[system.own :]))
        return steady + _swing(system, z, row)


def play(case: Case, end: float, refined: float = 1.0, *, keep: bool = False, most_work: float = math.inf) -> Course:
    """One run of a case from a straight mast on.

    Args:
        case: what moves.
        end: time to march to [s].
        refined: panels over the usual ones; two runs of unlike panels share no rounding.
        keep: whether signals are kept over time.
        most_work: panels after which the run is given up.

    **Error** rounding; what the modes left out could add is told by runs with more of them.
    **Source** `numerics.piecewise`, `numerics.mast.system`.
    """
    system = MastSystem(case)
    mode, z = system.start()
    record = march(
        system,
        mode,
        z,
        end,
        refined=refined,
        keep=keep,
        most_events=MOST_EVENTS,
        most_work=most_work,
        most_looks=most_work / LONG,
        unsought=system.unsought,
    )
    put, damped = system.works(record.integrals)
    before, after = system.energy(mode, z), system.energy(record.mode, record.state)
    fastest = max(abs(record.top.values[1]), abs(record.bottom.values[1]))
    scale = max(before, after, system.total * fastest**2 / 2, *(abs(work) for work in put.values()))
    left = residual(sum(put.values()), damped + record.lost, after - before, scale)
    return Course(case, system, record, float(left))


def _stays(course: Course) -> bool:
    case, system, mode = course.case, course.system, course.record.mode
    if not (mode.base % 2 and mode.contact == FREE and mode.guide == 0 and mode.stretch + 1 == len(system.breaks)):
        return False
    z = course.record.state
    watch = system.motion(mode).watch
    if mode.base != MOVED:
        grip = mode.base // 2
        needed = watch[system.watched["grip", grip]]
        steady = abs(float(needed[system.own :] @ z[system.own :]))
        if steady + _swing(system, z, needed) >= case.base.grips[grip].capacity.values[-1]:
            return False
    points = []
    if case.obstacle is not None:
        away = case.obstacle.gap - float(z[0])
        points.append((case.obstacle.place, away))
    if case.guide is not None:
        points.append((case.guide.place, case.guide.gap))
    return all(ring_of(system, z, case.mast.at(place)[: system.count]).envelope(0.0) < room for place, room in points)


def _swing(system: MastSystem, z: FloatArray, row: FloatArray) -> float:
    """What a functional over the modes never exceeds while they swing freely."""
    n = system.count
    q, rates = z[2 : 2 + n], z[2 + n : system.own]
    w, ratios = system.w, system.case.ratios
    turning = w * np.sqrt(1 - ratios**2)
    size = np.hypot(q, (rates + ratios * w * q) / turning)
    return float((np.abs(row[2 : 2 + n]) + w * np.abs(row[2 + n : system.own])) @ size)


def ring_of(system: MastSystem, z: FloatArray, gains: FloatArray) -> Ring:
    """The free vibration of a mast whose base is held, from a state on."""
    n = system.count
    return Ring.of(gains, system.w, system.case.ratios, z[2 : 2 + n], z[2 + n : system.own])


def settled(course: Course, place: float, window: float, lean: float = 0.0, doubt: float = 0.0) -> Settled:
    """When a place of the mast stays in a window, counted from when the base is held for good.

    Args:
        course: a run to beyond that.
        place: on the mast [m].
        window: half width of the window about where the base stands [m].
        lean: how far the mast rests beside it [m].
        doubt: how far the deflection may be off [m].

    **Error** told: `numerics.mast.settling`, with the modes left out, which stray by twice what the largest
    acceleration of the base could have set them off.
    **Source** `numerics.mast.settling`.

    Raises:
        NumericsError: where the base is not yet held permanently.
    """
    if not course.stays:
        raise NumericsError("NUM103", f"by {course.record.time:.4g} s the base is not yet held permanently")
    system, mast = course.system, course.case.mast
    since = course.held_since
    z = _just_held(course) if since else system.start()[1]
    strays = 2 * left_out(mast, math.inf, place, system.count, 0.0, course.largest("acceleration")[0])
    ring = ring_of(system, z, mast.at(place)[: system.count])
    if course.case.guide is not None:
        gap, beside = course.case.guide.gap, mast.at(course.case.guide.place)[: system.count]
        if ring_of(system, z, beside).envelope(0.0) >= gap:
            return _beyond_guide(course, place, window, lean, doubt + strays)
    return settling(ring, window, lean, doubt + strays)


@kept_for(64)
def _just_held(course: Course) -> FloatArray:
    """The state in which the base of a run is held for good: asked for with every lean, window and doubt."""
    return play(course.case, course.held_since + _JUST_AFTER / float(course.system.w[-1])).record.state


def _beyond_guide(course: Course, place: float, window: float, lean: float, doubt: float) -> Settled:
    """With a guide that is touched after the stop: not before its last touch, if the swing is then still outside."""
    z = course.record.state
    ring = ring_of(course.system, z, course.case.mast.at(place)[: course.system.count])
    found = settling(ring, window, lean, doubt)
    passed = course.record.time - course.held_since
    if math.isinf(found.time):
        return found
    low = found.low + passed if found.low > 0 else 0.0
    return Settled(found.time + passed, low, found.high + passed, found.reason)
