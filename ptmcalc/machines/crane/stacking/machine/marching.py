"""A short motion of a few masses, played exactly from event to event, and what is read from it with its bars."""

import math
from collections.abc import Callable, Mapping, Sequence
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
"""Factor [1] on the difference of two runs with other time steps, in the error bar. A numerical choice: both runs are
exact but for rounding. A larger value widens the bar; below 1 the bar may exclude the second run."""
_UNSEEN = FADED + 3e-12
"""What reading a signal may miss of it: components that have faded, and what lies between the nodes."""
_CLOSES = 1e-9
"""Largest relative residual [1] of the energy balance. A numerical choice: it is above the rounding of a run and below
the accuracy of any input. Above it NUM101 is reported and the error bar is unbounded."""
MOST_SPREAD = 300.0
"""Fastest over slowest vibration of what is played: beyond it the fast one has died in any machine, not in a run."""
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

    def largest_of(self, sign: int, link: str) -> tuple[float, float]:
        """Largest (1) or smallest (-1) force of a link, and its time."""
        value, time = (self.top if sign > 0 else self.bottom)("link", self.link(link))
        return value, time or 0.0

    def last(self, what: str, index: int) -> float:
        """Value of a watched signal at the end."""
        return float(self.record.last[self.system.watched[what, index]])

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
    record = march(system, *start, window, refined=refined, most_events=_MOST_EVENTS, unsought=system.unsought)
    return Played(train, system, record, ledger(system, start, record))


def spread(train: Train) -> float:
    """Fastest over slowest vibration with every contact closed [1]."""
    found = frequencies(train)
    return float(found.max() / found.min())


def slowest(train: Train) -> float:
    """Period of the slowest vibration with every contact closed [s]."""
    return 2 * math.pi / float(frequencies(train).min())


@dataclass(frozen=True, slots=True)
class Course:
    """Loads of a motion with their bars, and what has to be said of it; `stages` are its runs, one after the other."""

    found: dict[str, Found]
    findings: tuple[Finding, ...]
    stages: tuple[Played, ...]
    residual: float
    work: int

    @property
    def played(self) -> Played:
        """The first run."""
        return self.stages[0]

    def result(self, found: Mapping[str, Found], findings: tuple[Finding, ...] = ()) -> Result:
        """What a solver hands back of a motion in one run."""
        record = self.played.record
        events = tuple(Event(float(one.time), one.element, one.before, one.after) for one in record.events)
        return Result(
            found,
            work=self.work,
            window=(0.0, record.time),
            health={"energy_residual": self.residual, "steps": float(record.steps)},
            findings=(*self.findings, *findings),
            events=events,
        )


Stages = Callable[[float], tuple[Sequence[Played], Mapping[str, Reading]]]
"""The runs of a motion with panels so much longer than usual, and what is read from them."""


def course(label: str, train: Train, window: float, read: Read) -> Course:
    """A motion in one run, and its loads."""

    def stages(refined: float) -> tuple[Sequence[Played], Mapping[str, Reading]]:
        played = play(train, window, refined)
        return (played,), read(played)

    return compared(label, stages)


def compared(label: str, stages: Stages) -> Course:
    """A motion and its loads.

        bar = 3 |x - x'|, x' of a run that divides time otherwise, and what reading a signal may miss

    All torques are straight pieces or sines, so both runs are exact but for rounding. The numbers are trusted only
    where the energy ledgers close to 1e-9.
    """
    (plays, own), (others, beside) = stages(1.0), stages(_OTHERWISE)
    found = {name: _with_bar(value, time, beside[name][0]) for name, (value, time) in own.items()}
    findings: tuple[Finding, ...] = ()
    residual = max(one.ledger.residual for one in plays)
    if residual > _CLOSES:
        said = (
            f"scene `{label}`: the energy balance has a residual of {residual:.1e}, more"
            f" than {_CLOSES:.0e}; the numbers are"
            " not reliable"
        )
        findings = (Finding("NUM101", said),)
        found = {name: Found(Estimate.unknown(one.estimate.value), one.at) for name, one in found.items()}
    return Course(found, findings, tuple(plays), residual, sum(one.record.steps for one in (*plays, *others)))


def _with_bar(value: float, time: float | None, other: float) -> Found:
    at = {} if time is None else {"time": time}
    if not math.isfinite(value):
        return Found(Estimate.exact(value) if value == other else Estimate.unknown(value), at)
    return Found(Estimate.within(value, _MARGIN * abs(value - other) + _UNSEEN * abs(value)), at)
