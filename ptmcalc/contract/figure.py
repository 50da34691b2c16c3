"""A figure: time histories or curves of a scene.

A kind declares its figures; the engine fills them with histories of loads, a report draws them. Only the kind knows the
machine.
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
    """A load, or a family of loads, with a plotted history. `also` are loads that are told of the same course: its
    smallest value beside its largest. `title` is what the course is called where the title of its load is not that."""

    load: str
    also: tuple[str, ...] = ()
    title: str = ""


@dataclass(frozen=True, slots=True)
class Band:
    """An interval of the abscissa, in SI units; a forbidden one is to be avoided in operation."""

    low: float
    high: float
    title: str
    forbidden: bool = True


@dataclass(frozen=True, slots=True)
class Threshold:
    """A limit value of the ordinate."""

    value: float
    title: str


@dataclass(frozen=True, slots=True)
class Moment:
    """A value of the abscissa with an event: a time, a position, a speed."""

    at: float
    title: str


@dataclass(frozen=True, slots=True)
class Spot:
    """A marked point with its text."""

    at: float
    value: float
    title: str


@dataclass(frozen=True, slots=True)
class Marks:
    """Marks drawn in addition to the histories."""

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
    """title of the ordinate"""
    over: Quantity = TIME
    across: str = "time"
    """title of the abscissa"""
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
