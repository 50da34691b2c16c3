"""The parts of a hauled load, in numbers at its hook: masses, losses, what pulls, what brakes, what gives way."""

from bisect import bisect_right
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

_EPS = 1e-13


@dataclass(frozen=True, slots=True)
class Course:
    """Straight pieces over the time since a start, plus a decay: s = values_k + slopes_k (t - times_k)
    + decay exp(-(t - since)/constant)."""

    times: tuple[float, ...] = (0.0,)
    values: tuple[float, ...] = (0.0,)
    slopes: tuple[float, ...] = (0.0,)
    decay: float = 0.0
    constant: float = 1.0
    since: float = 0.0

    def at(self, begin: float, times: FloatArray) -> FloatArray:
        """Values on a stretch that begins so long after the start and holds no break."""
        k = max(bisect_right(self.times, begin + _EPS * (1 + begin)) - 1, 0)
        found = self.values[k] + self.slopes[k] * (times - self.times[k])
        if self.decay and begin >= self.since - _EPS * (1 + begin):
            found = found + self.decay * np.exp(-(times - self.since) / self.constant)
        return np.asarray(found)

    @property
    def breaks(self) -> tuple[float, ...]:
        """Times of its corners."""
        return (*self.times[1:], *((self.since,) if self.decay else ()))


NONE = Course()
"""Nothing, always."""


@dataclass(frozen=True, slots=True)
class Tripped:
    """A course before a limiter trips, and the one from then on, over the time since the trip."""

    before: Course = NONE
    after: Course | None = None

    def at(self, trip: float, begin: float, times: FloatArray) -> FloatArray:
        """Values on a stretch without a break."""
        if self.after is None or begin < trip:
            return self.before.at(begin, times)
        return self.after.at(begin - trip, times - trip)


@dataclass(frozen=True, slots=True)
class Lines:
    """A force of straight pieces over the speed; constant beyond the ends, or going on straight."""

    knots: FloatArray
    values: FloatArray
    extends: bool = False

    def piece(self, speed: float) -> int:
        """Number of the piece at a speed."""
        found = int(np.searchsorted(self.knots, speed, "right")) - 1
        return min(max(found, 0), len(self.knots) - 2) if self.extends and len(self.knots) > 1 else found

    def force(self, piece: int, begin: float, times: FloatArray, speed: FloatArray) -> FloatArray:
        """Force of one piece."""
        last = len(self.knots) - 1
        if piece < 0 or piece >= last:
            return np.full(speed.shape, self.values[0 if piece < 0 else last])
        slope = (self.values[piece + 1] - self.values[piece]) / (self.knots[piece + 1] - self.knots[piece])
        return np.asarray(self.values[piece] + slope * (speed - self.knots[piece]))

    def guards(
        self, piece: int, begin: float, times: FloatArray, speed: FloatArray
    ) -> list[tuple[str, FloatArray, int]]:
        """What keeps the piece, and the piece that follows."""
        last, found = len(self.knots) - 1, []
        if piece >= (1 if self.extends else 0):
            found.append(("knot", speed - self.knots[piece], piece - 1))
        if piece < (last - 1 if self.extends else last):
            found.append(("knot", self.knots[piece + 1] - speed, piece + 1))
        return found


@dataclass(frozen=True, slots=True)
class Smooth:
    """A smooth force over the speed."""

    value: Callable[[FloatArray], FloatArray]

    def piece(self, speed: float) -> int:
        """There is one."""
        return 0

    def force(self, piece: int, begin: float, times: FloatArray, speed: FloatArray) -> FloatArray:
        """Its value."""
        return self.value(speed)

    def guards(
        self, piece: int, begin: float, times: FloatArray, speed: FloatArray
    ) -> list[tuple[str, FloatArray, int]]:
        """Nothing ends it."""
        return []


@dataclass(frozen=True, slots=True)
class Governed:
    """A speed control: clip(stiffness (reference - speed), -limit, limit)."""

    reference: Course
    stiffness: float
    limit: float

    def piece(self, speed: float) -> int:
        """Which side it is limited to, taken at the start of the reference."""
        free = self.stiffness * (self.reference.values[0] - speed)
        return int(np.sign(free)) if abs(free) > self.limit else 0

    def _free(self, begin: float, times: FloatArray, speed: FloatArray) -> FloatArray:
        return np.asarray(self.stiffness * (self.reference.at(begin, times) - speed))

    def force(self, piece: int, begin: float, times: FloatArray, speed: FloatArray) -> FloatArray:
        """Its force on one side of its limits."""
        return np.full(speed.shape, piece * self.limit) if piece else self._free(begin, times, speed)

    def guards(
        self, piece: int, begin: float, times: FloatArray, speed: FloatArray
    ) -> list[tuple[str, FloatArray, int]]:
        """What keeps it on its side."""
        free = self._free(begin, times, speed)
        if piece:
            return [("knot", piece * free - self.limit, 0)]
        return [("knot", self.limit - free, 1), ("knot", self.limit + free, -1)]


Law = Lines | Smooth | Governed


@dataclass(frozen=True, slots=True)
class Stage:
    """A law that holds until the speed rises to `until`, or a time has come."""

    law: Law
    until: float | None = None
    until_time: float | None = None


@dataclass(frozen=True, slots=True)
class Structure:
    """What the drum stands on: stiffness, mass (0 for a spring alone) and damping."""

    stiffness: float
    mass: float
    damping: float


@dataclass(frozen=True, slots=True)
class Haul:
    """A drive, what it stands on, and a load, all at the hook. Speeds are positive up, the sag of the structure down.

    The drive is a set speed kept by a force of `capacity` at most, or its own curve `stages`, times `gate`, or off.
    `forward`, `reverse` are efficiencies with the power flowing to the load and back, of gear and tackle.
    """

    motor_mass: float
    drum_mass: float
    load_mass: float
    weight: float
    gear: tuple[float, float]
    tackle: tuple[float, float]
    structure: Structure | None
    lifts: bool
    """whether the load stands on the ground at the beginning"""
    slack: float
    """way of the hook before the rope is taut"""
    speed: float
    """of the drive at the beginning"""
    way: int
    set_speed: Course | None = None
    capacity: Course = NONE
    stages: tuple[Stage, ...] = ()
    gate: Tripped = Tripped(Course(values=(1.0,)))
    """of either, 0 where the limiter has switched it off"""
    motor_brake: Tripped = Tripped()
    drum_brake: Tripped = Tripped()
    level: float = float("inf")
    """rope force at which the limiter trips"""

    @property
    def breaks(self) -> tuple[float, ...]:
        """Times at which something changes by itself."""
        courses = [self.capacity, *(one.before for one in (self.gate, self.motor_brake, self.drum_brake))]
        courses += [self.set_speed] if self.set_speed is not None else []
        courses += [one.law.reference for one in self.stages if isinstance(one.law, Governed)]
        ends = [one.until_time for one in self.stages if one.until_time is not None]
        return tuple(sorted({*(time for one in courses for time in one.breaks), *ends} - {0.0}))

    @property
    def breaks_after_the_trip(self) -> tuple[float, ...]:
        """The same, over the time since the limiter tripped."""
        given = (one.after for one in (self.gate, self.motor_brake, self.drum_brake))
        return tuple(sorted({time for one in given if one is not None for time in one.breaks}))
