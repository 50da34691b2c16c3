"""A body with modes under the force of a drive, as `numerics.driven_modes` takes it, and what a march of it gives."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

MOST_STEPS = 50_000
"""Steps of a march. A numerical choice: more follow slower starts and take longer; fewer report NUM101."""


class Drive(Protocol):
    """The force of a drive, less the resistance."""

    @property
    def kinks(self) -> Sequence[float]:
        """Times at which the slope of the force over time jumps [s], in ascending order."""

    def force(self, stage: int, time: float, speed: float) -> tuple[float, float]:
        """Force [N] and its slope over the speed [N*s/m]."""

    def until(self, stage: int) -> tuple[float, float]:
        """Speed [m/s] and time [s] at which the next stage begins; infinite if there is none."""

    def steepest(self, stage: int) -> float:
        """Largest slope of the force over the speed in a stage, of either sign [N*s/m]."""

    def to_come(self, time: float) -> float:
        """Bound of the total later change of the force over time at a constant speed [N]; infinite before the last
        kink."""


@dataclass(frozen=True, slots=True)
class Gear:
    """Inertia behind which the force of the drive is transmitted [kg], its static value [N], and the factor of the
    force with the other sign: above 0 for negative forces, below 0 for positive ones [1]."""

    mass: float = 0.0
    static: float = 0.0
    extra: float = 0.0

    def more(self, through: float) -> float:
        """What the drive adds at a transmitted force [N]."""
        return self.extra * (min(through, 0.0) if self.extra > 0 else max(through, 0.0))


@dataclass(frozen=True, slots=True)
class Body:
    """Mass [kg], frequencies [rad/s], damping ratios [1] and mobilities [1/kg] of the modes, shape (k,), mobility of
    those left out [1/kg], and the mass that the gear adds in its other direction [kg]."""

    mass: float
    frequencies: FloatArray
    damping_ratios: FloatArray
    mobilities: FloatArray
    left_out: float
    spare: float = 0.0

    @property
    def drive_mass(self) -> float:
        """At the driven point [kg]."""
        return 1 / (1 / self.mass + float(self.mobilities.sum()) + self.left_out)


@dataclass(frozen=True, slots=True)
class Places:
    """Quantities of interest over the force: gains of the modes, shape (k, p), of all modes, bound of the absolute
    gains of those left out, and the mass that accelerates through each [kg], shape (p,) each."""

    gains: FloatArray
    whole: FloatArray
    left_out: FloatArray
    masses: FloatArray


@dataclass(slots=True)
class Followed:
    """A march: largest and smallest value of each place with times and bounds, shape (p,) each, largest amplitude of
    each mode, bounds of the places between the marks, shape (marks + 1, p), what may come after its end, the end,
    steps, and whether the motion is steady there; nodes of its force; samples."""

    largest: FloatArray
    largest_time: FloatArray
    largest_low: FloatArray
    largest_high: FloatArray
    smallest: FloatArray
    smallest_time: FloatArray
    smallest_low: FloatArray
    smallest_high: FloatArray
    swings: FloatArray
    parts_high: FloatArray
    parts_low: FloatArray
    after: FloatArray = field(default_factory=lambda: np.full(1, math.inf))
    end: float = 0.0
    steps: int = 0
    steady: bool = False
    times: list[float] = field(default_factory=list)
    speeds: list[float] = field(default_factory=list)
    forces: list[float] = field(default_factory=list)
    samples: list[FloatArray] = field(default_factory=list)

    @classmethod
    def of(cls, places: int, modes: int, parts: int) -> "Followed":
        """A march that has not begun."""
        a, b, c, d, e, f, g, h = (np.zeros(places) for _ in range(8))
        return cls(a, b, c, d, e, f, g, h, np.zeros(modes), np.zeros((parts, places)), np.zeros((parts, places)))


@dataclass(frozen=True, slots=True)
class Plan:
    """How a march is made: its beginning [s], longest step [s], the same relative to the time constant of drive mass
    and steepest torque of a stage [1], tolerance of what is left at the end in the unit of the places, number of modes
    whose speed the drive follows, factor of the time until the motion is steady, last time at which it ends [s],
    whether all samples of the first place are kept, most steps, and times between which extremes are kept apart [s]."""

    begin: float
    step: float
    response: float
    tolerance: float
    felt: int
    longer: float = 1.0
    latest: float = math.inf
    keep: bool = False
    most: int = MOST_STEPS
    marks: tuple[float, ...] = ()

    def coarser(self, factor: float) -> "Plan":
        """The same with steps so many times as long."""
        return replace(self, step=factor * self.step, response=factor * self.response)
