"""A short motion of a few masses, played exactly from event to event, and what is read from it with its bars."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Event, Finding, Found, Result
from ptmcalc.numerics.flow import FADED
from ptmcalc.numerics.piecewise import march
from ptmcalc.numerics.record import Record
from ptmcalc.numerics.train.ledger import Ledger, ledger
from ptmcalc.numerics.train.modes import frequencies
from ptmcalc.numerics.train.parts import Train
from ptmcalc.numerics.train.system import TrainSystem

_OTHERWISE = 0.7
"""How the run beside the one that counts divides time, over its own panels."""
_MARGIN = 3.0
_UNSEEN = FADED + 3e-12
"""What reading a signal may miss of it: components that have faded, and what lies between the nodes."""
_CLOSES = 1e-9
_MOST_EVENTS = 2000
"""Events after which something is said to chatter."""


@dataclass(frozen=True, slots=True)
class Played:
    """One run of a train over a window."""

    train: Train
    system: TrainSystem
    record: Record
    ledger: Ledger

    def link(self, name: str) -> int:
        """Index of a link."""
        return next(i for i, one in enumerate(self.train.springs) if one.name == name)

    def body(self, name: str) -> int:
        """Index of a body."""
        return next(i for i, one in enumerate(self.train.bodies) if one.name == name)

    def top(self, what: str, index: int) -> "Reading":
        """Largest value of a watched signal and its time."""
        place = self.system.watched[what, index]
        return float(self.record.top.values[place]), float(self.record.top.at[place])

    def bottom(self, what: str, index: int) -> "Reading":
        """Smallest value of a watched signal and its time."""
        place = self.system.watched[what, index]
        return float(self.record.bottom.values[place]), float(self.record.bottom.at[place])

    def largest(self, what: str, index: int) -> "Reading":
        """Largest magnitude of a watched signal and its time."""
        high, low = self.top(what, index), self.bottom(what, index)
        return high if high[0] >= -low[0] else (-low[0], low[1])

    def first(self, element: str, after: str) -> float:
        """When an element first came to a state; infinite where it never did [s]."""
        times = (one.time for one in self.record.events if one.element == element and one.after == after)
        return float(next(times, math.inf))


Reading = tuple[float, float | None]
"""A value, and when it occurs."""
Read = Callable[[Played], Mapping[str, Reading]]


def play(train: Train, window: float, refined: float = 1.0) -> Played:
    """One run from the start of a train to the end of its window."""
    system = TrainSystem(train)
    start = system.start()
    record = march(system, *start, window, refined=refined, most_events=_MOST_EVENTS)
    return Played(train, system, record, ledger(system, start, record))


def slowest(train: Train) -> float:
    """Period of the slowest vibration with every contact closed [s]."""
    return 2 * math.pi / float(frequencies(train).min())


@dataclass(frozen=True, slots=True)
class Course:
    """Loads of a motion with their bars, and what has to be said of it."""

    found: dict[str, Found]
    findings: tuple[Finding, ...]
    played: Played
    work: int

    def result(self, found: Mapping[str, Found], findings: tuple[Finding, ...] = ()) -> Result:
        """What a solver hands back."""
        record = self.played.record
        residual = self.played.ledger.residual
        events = tuple(Event(float(one.time), one.element, one.before, one.after) for one in record.events)
        return Result(
            found,
            work=self.work,
            window=(0.0, record.time),
            health={"energy_residual": residual, "steps": float(record.steps)},
            findings=(*self.findings, *findings),
            events=events,
        )


def course(label: str, train: Train, window: float, read: Read) -> Course:
    """A motion and its loads.

        bar = 3 |x - x'|, x' of a run that divides time otherwise, and what reading a signal may miss

    All torques are straight pieces, so both runs are exact but for rounding. The numbers are trusted only where the
    energy ledger closes to 1e-9.
    """
    played, other = play(train, window), play(train, window, _OTHERWISE)
    own, compared = read(played), read(other)
    found = {name: _with_bar(value, time, compared[name][0]) for name, (value, time) in own.items()}
    findings: tuple[Finding, ...] = ()
    residual = played.ledger.residual
    if residual > _CLOSES:
        said = (
            f"scene `{label}`: the energy ledger leaves {residual:.1e} over, more than {_CLOSES:.0e}; the numbers are"
            " not trusted"
        )
        findings = (Finding("NUM101", said),)
        found = {name: Found(Estimate.unknown(one.estimate.value), one.at) for name, one in found.items()}
    return Course(found, findings, played, played.record.steps + other.record.steps)


def _with_bar(value: float, time: float | None, other: float) -> Found:
    at = {} if time is None else {"time": time}
    if not math.isfinite(value):
        return Found(Estimate.exact(value) if value == other else Estimate.unknown(value), at)
    return Found(Estimate.within(value, _MARGIN * abs(value - other) + _UNSEEN * abs(value)), at)
