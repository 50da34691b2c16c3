"""A mast, what moves it, and the states of its contacts."""

from dataclasses import dataclass
from typing import NamedTuple

from ptmcalc.numerics.mast.base import Base, Guide, Obstacle
from ptmcalc.numerics.mast.modes import Mast
from ptmcalc.numerics.mast.parts import FloatArray

FREE, TOUCH, LOOSE = "free", "touch", "loose"
"""LOOSE: still within a contact whose damping would pull it back."""
MOVED = -1
"""Code of a base whose motion is prescribed."""


class State(NamedTuple):
    """What holds: of J grips at rising speeds the base is held by number j (code 2j + 1), or slips between number j - 1
    and number j (code 2j); the contact; the side on which the guide is touched; the stretch of time."""

    base: int
    contact: str = FREE
    guide: int = 0
    stretch: int = 0


@dataclass(frozen=True, slots=True)
class Case:
    """A mast, how much of it is followed, what moves it.

    `ratios` are the damping ratios of the modes kept, whose number they tell; `places` those at which deflections are
    read.
    """

    mast: Mast
    ratios: FloatArray
    base: Base
    places: tuple[float, ...]
    obstacle: Obstacle | None = None
    guide: Guide | None = None
