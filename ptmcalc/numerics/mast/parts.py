"""What a mast is made of: a column on a base that moves along a rail, what it carries, what props it.

Places on the column are told by their distance from its root, hanging or standing. Deflections are those beside the
base: the point of a column at the place z is at u + w(z), u the way of the base.
"""

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.errors import NumericsError

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Segment:
    """A stretch of a column: length [m], bending stiffness E I [N m^2], mass per length [kg/m]."""

    length: float
    bending: float
    mass: float = 0.0


@dataclass(frozen=True, slots=True)
class Lump:
    """A mass on a column: its place [m], mass [kg], inertia about its own axis [kg m^2]."""

    place: float
    mass: float
    inertia: float = 0.0


@dataclass(frozen=True, slots=True)
class Prop:
    """A spring between a column and a frame that travels with the base: its place [m], stiffness [N/m]."""

    place: float
    stiffness: float


@dataclass(frozen=True, slots=True)
class Column:
    """A column and what it carries.

    Args:
        segments: its stretches, from the root on.
        lumps: masses on it.
        root_rotation: stiffness of the root against turning; infinite where it is clamped [N m/rad].
        root_translation: stiffness of what the root stands on against the base; infinite where they are one [N/m].
        root_mass: what moves with the root [kg].
        root_inertia: inertia of what turns with the root [kg m^2].
        pull: acceleration of gravity, above 0 for a column that hangs, below 0 for one that stands, 0 to leave what
            weights do to the stiffness out [m/s^2].
        props: springs beside it.
    """

    segments: tuple[Segment, ...]
    lumps: tuple[Lump, ...] = ()
    root_rotation: float = math.inf
    root_translation: float = math.inf
    root_mass: float = 0.0
    root_inertia: float = 0.0
    pull: float = 0.0
    props: tuple[Prop, ...] = ()
    length: float = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "length", float(sum(segment.length for segment in self.segments)))
        numbers = [number for part in self.segments for number in (part.length, part.bending)]
        numbers += [self.root_rotation, self.root_translation, *(prop.stiffness for prop in self.props)]
        if not (self.segments and all(number > 0 for number in numbers)):
            raise NumericsError("NUM102", "lengths and stiffnesses of a mast are above 0")
        masses = [self.root_mass, self.root_inertia, *(segment.mass for segment in self.segments)]
        masses += [number for lump in self.lumps for number in (lump.mass, lump.inertia)]
        if not all(0 <= number < math.inf for number in masses):
            raise NumericsError("NUM102", "the masses of a mast and its attachments are not below 0")
        places = [*(lump.place for lump in self.lumps), *(prop.place for prop in self.props)]
        if not all(0 <= place <= self.length * (1 + 1e-12) for place in places):
            raise NumericsError("NUM102", "attachments are on the mast")
        if not (math.isfinite(self.pull) and math.isfinite(sum(numbers[: 2 * len(self.segments)]))):
            raise NumericsError("NUM102", "the dimensions of a mast are finite")
