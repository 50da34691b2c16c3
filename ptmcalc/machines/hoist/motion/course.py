"""One run of a hoist's train, and when its events happen."""

import math
from dataclasses import dataclass

from ptmcalc.machines.hoist.motion.train import BRAKE, GEARBOX, GROUND, TOLERANCES, Case
from ptmcalc.numerics.piecewise import JAMMED, march
from ptmcalc.numerics.record import LONG, Record, most_work
from ptmcalc.numerics.train import price
from ptmcalc.numerics.train.ledger import Ledger, ledger
from ptmcalc.numerics.train.system import TrainSystem

_MOST_EVENTS = 2000
"""Events after which a run ends because of chatter; a numerical choice. Without damping chatter never ends. More take
longer; fewer refuse runs with many real events."""


@dataclass(frozen=True, slots=True)
class Course:
    """One run of a case."""

    case: Case
    system: TrainSystem
    record: Record
    ledger: Ledger

    def top(self, what: str, index: int) -> tuple[float, float]:
        """Largest value of a watched signal and its time."""
        place = self.system.watched[what, index]
        return float(self.record.top.values[place]), float(self.record.top.at[place])

    def bottom(self, what: str, index: int) -> tuple[float, float]:
        """Smallest value of a watched signal and its time."""
        place = self.system.watched[what, index]
        return float(self.record.bottom.values[place]), float(self.record.bottom.at[place])

    def largest(self, what: str, index: int) -> tuple[float, float]:
        """Largest magnitude of a watched signal and its time."""
        high, low = self.top(what, index), self.bottom(what, index)
        return high if high[0] >= -low[0] else (-low[0], low[1])


def play(case: Case, tolerance: float, refined: float = 1.0, *, end: float = 0.0, keep: bool = False) -> Course:
    """One run of a case, over its window or to another end."""
    system = TrainSystem(case.train)
    start = system.start()
    end, most = end or case.window, most_work(cost(case, TOLERANCES.index(tolerance)))
    record = march(
        system,
        *start,
        end,
        tolerance=tolerance,
        refined=refined,
        keep=keep,
        most_events=_MOST_EVENTS,
        most_work=most,
        most_looks=most / LONG,
        unsought=system.unsought,
    )
    return Course(case, system, record, ledger(system, start, record))


def first_event(course: Course, element: str, after: str) -> float:
    """When an element first came to a state; infinite where it never did [s]."""
    times = (event.time for event in course.record.events if event.element == element and event.after == after)
    return float(next(times, math.inf))


def lift_off_time(course: Course) -> float:
    """When the load left the ground; infinite where it never did [s]."""
    return first_event(course, GROUND, "open")


def _braked_group(course: Course) -> int:
    """What turns with the shaft of the brake."""
    brake = course.case.named("grip", BRAKE)
    return course.system.groups.of[course.case.train.grips[brake].first if brake is not None else 0]


def stopped(course: Course) -> float:
    """When the shaft of the brake came to rest for good; infinite where it still turns [s]."""
    group = _braked_group(course)
    if course.record.mode.turning[group] != 0:
        return math.inf
    name = course.system.friction_name(group)
    times = [event.time for event in course.record.events if event.element == name and event.after == "at rest"]
    return float(times[-1]) if times else 0.0


def first_rest(course: Course) -> float:
    """When the shaft of the brake first came to rest; a swinging load may pull it through once more [s]. A gear that
    jams stops both its shafts."""
    if not any(body.speed for body in course.case.train.bodies):
        return 0.0
    name = course.system.friction_name(_braked_group(course))
    return min(first_event(course, name, "at rest"), first_event(course, GEARBOX, JAMMED))


def cost(case: Case, level: int) -> float:
    """Seconds predicted of a run and those it is compared with: what rings, as long as it has to be looked at, and a
    few events."""
    runs = 2 if case.coarser is None else 3
    if case.smooth:
        ringing = price.RADIAN * price.radians(case.train, case.window)
        return 4e-3 + runs * (ringing + 5e-3) * (1 + level / 2)
    return 4e-3 + runs * (price.linear(case.train, case.window) + 5e-3)
