"""Results of a solver."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache

from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.base.units import TIME, Quantity


@dataclass(frozen=True, slots=True)
class LoadInfo:
    """A load of a kind: name in JSON, title in tables, quantity.

    A load that occurs once for each part of a machine is a family: `torque_peak` stands for `torque_peak[shaft]`.
    """

    name: str
    title: str
    quantity: Quantity
    headline: bool = True
    """True if the verbose table shows it; the JSON always does"""

    governing: bool = False
    """True for a governing load: the short table shows these, and those that a check of the file uses"""

    def of(self, element: str, quantity: Quantity | None = None) -> "LoadInfo":
        """The load of one part."""
        title = f"{self.title}, {element}"
        return replace(self, name=of(self.name, element), title=title, quantity=quantity or self.quantity)


def of(family: str, element: str) -> str:
    """Name of the load of one part: `torque_peak[shaft]`."""
    return f"{family}[{element}]"


@lru_cache(maxsize=4096)
def family(name: str) -> str:
    """The family of a load, which is its own name for a load that a machine has once."""
    return name.partition("[")[0]


@dataclass(frozen=True, slots=True)
class Found:
    """A load computed by a solver: value with error bar, place and time of occurrence, remark."""

    estimate: Estimate
    at: Mapping[str, float] = field(default_factory=dict)
    note: str = ""


@dataclass(frozen=True, slots=True)
class Finding:
    """A message of a solver about its results, or of a kind about its input."""

    code: str
    message: str
    path: tuple[str | int, ...] = ()
    hint: str = ""
    other: tuple[str | int, ...] = ()
    """a second key of the message: its line is also reported"""


@dataclass(frozen=True, slots=True)
class Failure:
    """A failure that a run found, such as a load that lowers although the motor lifts.

    The check with this code fails in the scene whatever its number, with `message` as the reason. A solver reports it
    only if its error bars leave no doubt. `path` is the governing key, `hint` the remedy.
    """

    check: str
    message: str
    path: tuple[str | int, ...] = ()
    hint: str = ""
    element: str = ""


@dataclass(frozen=True, slots=True)
class Event:
    """A change of state of a part at a time, in s."""

    time: float
    element: str
    before: str
    after: str


@dataclass(frozen=True, slots=True)
class History:
    """A quantity over time, or over the speed or whatever else `over` says: shape (n,) each, SI."""

    quantity: Quantity
    times: Sequence[float]
    values: Sequence[float]
    over: Quantity = TIME

    def course(self, parts: int) -> tuple[float, ...]:
        """Its shape in a few numbers: in each of so many equal parts of the time the value farthest from the mean, or
        the one before where a part has none; nothing where it stays as it is."""
        finite = [(time, value) for time, value in zip(self.times, self.values, strict=True) if math.isfinite(value)]
        if not finite:
            return ()
        begin, end = min(finite)[0], max(finite)[0]
        mean = sum(value for _, value in finite) / len(finite)
        found = [math.nan] * parts
        for time, value in finite:
            part = min(int(parts * (time - begin) / (end - begin)), parts - 1) if end > begin else 0
            if not abs(value - mean) <= abs(found[part] - mean):
                found[part] = value
        for part in range(1, parts):
            if math.isnan(found[part]):
                found[part] = found[part - 1]
        return tuple(found) if max(found) > min(found) else ()


@dataclass(frozen=True, slots=True)
class Result:
    """Loads of one solver run. `work` counts what the run evaluated; `window` is the time it covers, in s.

    `spent` is the seconds that what was counted comes to, where that can be much more than what was predicted.

    `histories` gives, by the name of a load, the quantity it is the extreme or end of, over time; it is only called
    where someone asks for it.
    """

    loads: Mapping[str, Found]
    work: int = 0
    window: tuple[float, float] | None = None
    health: Mapping[str, float] = field(default_factory=dict)
    findings: tuple[Finding, ...] = ()
    events: tuple[Event, ...] = ()
    histories: Callable[[], Mapping[str, History]] = dict
    spent: float = 0.0
    failures: tuple[Failure, ...] = ()
    """failures of the machine that the run found: a check fails by each of them"""
    beyond: Mapping[str, Interval] = field(default_factory=dict)
    """possible changes of loads after the window, if the motion is not steady at its end"""
    open_end: str = ""
    """with `beyond`, the state at the end of the window: "belt at 1.43 of 3 m/s" """
