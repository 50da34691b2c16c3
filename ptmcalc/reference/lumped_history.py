"""What a run of a train found: extremes, events and the last values."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ptmcalc.reference.mechanism import Mechanism
from ptmcalc.reference.mechanism_coordinates import FloatArray


@dataclass(frozen=True, slots=True)
class Happened:
    """An event: a part of one kind, and the state it goes to."""

    time: float
    kind: str
    index: int
    to: object


@dataclass
class History:
    """What a run found; extremes by (what, index), with their times."""

    mechanism: Mechanism
    time: float = 0.0
    last: dict[tuple[str, int], float] = field(default_factory=dict)
    first: dict[tuple[str, int], float] = field(default_factory=dict)
    highest: dict[tuple[str, int], float] = field(default_factory=dict)
    lowest: dict[tuple[str, int], float] = field(default_factory=dict)
    squares: FloatArray = field(default_factory=lambda: np.zeros(0))
    events: list[Happened] = field(default_factory=list)
    turning: tuple[int | None, ...] = ()
    steps: int = 0

    def largest(self, what: str, index: int) -> float:
        """Largest magnitude of what is watched."""
        return max(self.highest[what, index], -self.lowest[what, index])

    def times(self, kind: str, index: int, fits: Callable[[Any], bool]) -> list[float]:
        """Times at which a part came to a state."""
        return [one.time for one in self.events if one.kind == kind and one.index == index and fits(one.to)]


def turns(heights: FloatArray) -> bool:
    """Whether the parabola through three equally spaced values has its summit among them."""
    slope, bend = (heights[2] - heights[0]) / 2, heights[2] - 2 * heights[1] + heights[0]
    return bool(bend < 0 and abs(slope) <= 1.2 * abs(bend))


def summit(heights: FloatArray) -> float:
    """Summit of the parabola through three equally spaced values; the largest of them where it has none inside."""
    slope, bend = (heights[2] - heights[0]) / 2, heights[2] - 2 * heights[1] + heights[0]
    if bend < 0 and abs(slope) <= abs(bend):
        return float(heights[1] - slope**2 / (2 * bend))
    return float(heights.max())
