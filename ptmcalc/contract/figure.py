"""A figure: what of a scene people would rather look at than read.

A kind declares its figures; the engine fills them with courses of loads, a report draws them. Nobody but the kind knows
what machine they are of.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.units import TIME, Quantity
from ptmcalc.contract.result import History

if TYPE_CHECKING:
    from ptmcalc.contract.report import SceneReport


@dataclass(frozen=True, slots=True)
class Course:
    """A load, or a family of loads, whose course is drawn. `also` are loads that are told of the same course: its
    smallest value beside its largest. `title` is what the course is called where the title of its load is not that."""

    load: str
    also: tuple[str, ...] = ()
    title: str = ""


@dataclass(frozen=True, slots=True)
class Band:
    """A stretch of what is drawn against, in SI units; a forbidden one is where a machine should not be."""

    low: float
    high: float
    title: str
    forbidden: bool = True


@dataclass(frozen=True, slots=True)
class Threshold:
    """A value of what is drawn that something is held against."""

    value: float
    title: str


@dataclass(frozen=True, slots=True)
class Moment:
    """A value of what is drawn against at which something happens: a time, a place, a speed."""

    at: float
    title: str


@dataclass(frozen=True, slots=True)
class Spot:
    """A point that is marked, and what it says."""

    at: float
    value: float
    title: str


@dataclass(frozen=True, slots=True)
class Marks:
    """What is drawn besides the courses themselves."""

    bands: tuple[Band, ...] = ()
    thresholds: tuple[Threshold, ...] = ()
    moments: tuple[Moment, ...] = ()
    spots: tuple[Spot, ...] = ()


@dataclass(frozen=True, slots=True)
class Figure:
    """What a kind has to show of some types of scene: courses of loads over time, or over what `over` says.

    `loads` that fall together in quantity share their axes. What a check holds a load against is drawn beside it, the
    interval it is known to lie in too; `marks` says what else belongs there. `moments` names loads that are a time,
    and what happens then.
    """

    name: str
    title: str
    scenes: tuple[str, ...]
    courses: tuple[Course, ...]
    upright: str
    """what the axis of the values is called"""
    over: Quantity = TIME
    across: str = "time"
    """what the other axis is called"""
    moments: tuple[tuple[str, str], ...] = ()
    marks: "Callable[[Any, SceneReport], Marks] | None" = None


@dataclass(frozen=True, slots=True)
class Told:
    """A load a figure speaks of: the number with its interval, and where it comes from."""

    load: str
    title: str
    quantity: Quantity
    estimate: Estimate
    solver: str
    level: str
    source: str
    at: Mapping[str, float] = field(default_factory=dict)
    mirrored: bool = False
    """whether it is the size of what the course has below zero"""

    @property
    def value(self) -> float:
        """The number as the course has it."""
        return -self.estimate.value if self.mirrored else self.estimate.value

    @property
    def ends(self) -> tuple[float, float]:
        """The interval as the course has it."""
        low, high = self.estimate.low, self.estimate.high
        return (-high, -low) if self.mirrored else (low, high)


@dataclass(frozen=True, slots=True)
class Curve:
    """The course of a load, thinned to what can be seen, and what is told of it."""

    title: str
    history: History
    told: tuple[Told, ...]


@dataclass(frozen=True, slots=True)
class FigureReport:
    """A figure of a scene; where there is nothing to draw, `missing` says why."""

    name: str
    title: str
    upright: str
    across: str
    curves: tuple[Curve, ...] = ()
    marks: Marks = Marks()
    missing: str = ""
