"""What moves a mast's base and what stands in the mast's way: forces over time, grips, an obstacle, a guide."""

import math
from bisect import bisect_right
from dataclasses import dataclass

from ptmcalc.base.errors import NumericsError


@dataclass(frozen=True, slots=True)
class Signal:
    """A number over time, in straight lines: `values[j] + slopes[j] (t - times[j])` from `times[j]` on; the times rise
    from 0."""

    times: tuple[float, ...]
    values: tuple[float, ...]
    slopes: tuple[float, ...]

    @classmethod
    def constant(cls, value: float) -> "Signal":
        return cls((0.0,), (value,), (0.0,))

    @classmethod
    def rising(cls, value: float, delay: float = 0.0, rise: float = 0.0) -> "Signal":
        """0 until a delay is over, then up to a value in a straight line."""
        rows = [(0.0, 0.0, 0.0)] if delay > 0 else []
        rows += [(delay, 0.0, value / rise)] if rise > 0 else []
        rows += [(delay + rise, value, 0.0)]
        times, values, slopes = zip(*rows, strict=True)
        return cls(times, values, slopes)

    def now(self, time: float) -> tuple[float, float]:
        """Value and slope from a time on."""
        k = max(bisect_right(self.times, time) - 1, 0)
        return self.values[k] + self.slopes[k] * (time - self.times[k]), self.slopes[k]


@dataclass(frozen=True, slots=True)
class Grip:
    """Dry friction between the base and something that moves at a speed of its own: a brake and rolling on the rail
    (speed 0), a drive that pushes with all its force until the base has its speed and keeps it there.

    `capacity` is the force it slips at [N], `speed` [m/s].
    """

    name: str
    capacity: Signal
    speed: float = 0.0


@dataclass(frozen=True, slots=True)
class Obstacle:
    """What a point of the mast runs into.

    Args:
        place: that of the point on the mast [m].
        stiffness: of the contact; infinite where the point stops dead and stays until the contact would pull [N/m].
        gap: how far off it is at the start [m].
        damping: of the contact, k d + b d' as long as that pushes [N s/m].
    """

    place: float
    stiffness: float
    gap: float = 0.0
    damping: float = 0.0


@dataclass(frozen=True, slots=True)
class Guide:
    """A guide that travels with the base: its place on the mast, its stiffness [N/m], its play to either side [m]."""

    place: float
    stiffness: float
    gap: float


@dataclass(frozen=True, slots=True)
class Base:
    """The base of a mast.

    Args:
        mass: above 0 [kg].
        speed: at the start [m/s].
        push: force on it over time [N].
        grips: what holds it, each at a speed of its own.
        path: acceleration over time of a base that is moved [m/s^2]; then neither mass nor forces count.
    """

    mass: float
    speed: float = 0.0
    push: Signal = Signal((0.0,), (0.0,), (0.0,))
    grips: tuple[Grip, ...] = ()
    path: Signal | None = None

    def __post_init__(self) -> None:
        if not (0 < self.mass < math.inf):
            raise NumericsError("NUM102", "a base has a mass above 0")
        speeds = [grip.speed for grip in self.grips]
        if len(set(speeds)) < len(speeds) or speeds != sorted(speeds):
            raise NumericsError("NUM102", "friction values must be in the order of rising speed, one for each speed")

    @property
    def signals(self) -> tuple[Signal, ...]:
        """All that changes with time."""
        moved = (self.path,) if self.path is not None else ()
        return (self.push, *(grip.capacity for grip in self.grips), *moved)

    @property
    def breaks(self) -> tuple[float, ...]:
        """Times at which something changes its straight line."""
        return tuple(sorted({time for signal in self.signals for time in signal.times}))
