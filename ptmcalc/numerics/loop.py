"""A closed loop of two elastic strands round a drive drum: what goes in, the grid of times, what comes out.

Coordinate along the belt: drum run-off -> return strand -> tail -> carry strand -> drum run-on.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.free_waves import Row
from ptmcalc.numerics.peaks import largest, smallest

FloatArray = NDArray[np.float64]

MOST_STEPS = 4_000_000
_ROUNDING = 1e-8
_FIRST_TRIED = 128
"""Numbers of cells that are tried for a match at first; then eight times as many, and so on."""
BACKWARD = 1e-6
"""Share of the fastest speed of belt and drum from which on a belt runs backward; less is rounding."""


@dataclass(frozen=True, slots=True)
class Strand:
    """A uniform strand: length [m], mass per length [kg/m], tensile stiffness [N]; its static tension is linear
    from `static_start` to `static_end` [N]; `span_weight` is the weight on one idler pitch [N], 0 for no sag."""

    length: float
    line_mass: float
    stiffness: float
    static_start: float
    static_end: float
    span_weight: float = 0.0

    @property
    def speed(self) -> float:
        """Wave speed [m/s]."""
        return math.sqrt(self.stiffness / self.line_mass)

    @property
    def transit(self) -> float:
        """Travel time of a wave along the strand [s]."""
        return self.length / self.speed

    def static(self, x: FloatArray) -> FloatArray:
        """Static tension at fractions x of the length [N]."""
        return self.static_start + (self.static_end - self.static_start) * x

    @property
    def rest_energy(self) -> float:
        """Elastic energy of the static tension [J]."""
        first, last = self.static_start, self.static_end
        return self.length / self.stiffness * (first**2 + first * last + last**2) / 6


@dataclass(frozen=True, slots=True)
class Grip:
    """Friction between belt and drum: exponent mu alpha [1] and mass per length of the bare belt [kg/m]."""

    exponent: float
    belt_line_mass: float


@dataclass(frozen=True, slots=True)
class Loop:
    """Two strands, the drum and the tail; `impedance_jump` False treats the return strand as if it had the
    impedance of the carry strand (its travel time stays)."""

    carry: Strand
    back: Strand
    drum_mass: float
    tail_mass: float
    fixed_length: bool
    grip: Grip | None = None
    impedance_jump: bool = True

    @property
    def impedances(self) -> tuple[float, float]:
        """Z of carry and return strand [N*s/m]."""
        z_carry = math.sqrt(self.carry.line_mass * self.carry.stiffness)
        z_back = math.sqrt(self.back.line_mass * self.back.stiffness)
        return z_carry, z_back if self.impedance_jump else z_carry

    @property
    def least_energy(self) -> float:
        """Energy below which the exchange of the belt is rounding: of tensions 1e-8 of the static ones [J]."""
        return _ROUNDING**2 * (self.carry.rest_energy + self.back.rest_energy)


@dataclass(frozen=True, slots=True)
class Drive:
    """What the drum does: force over the static resistance [N], or speed [m/s], as a function of time [s]. A drum
    that has reached `hold` [m/s], the speed of its motor, is held at it."""

    force: Callable[[FloatArray], FloatArray] | None = None
    speed: Callable[[FloatArray], FloatArray] | None = None
    hold: float = math.inf


@dataclass(frozen=True, slots=True)
class Grid:
    """Steps of time: `carry` and `back` cells per strand; `mismatch` is the relative error of the travel times; so many
    steps a `panel`, over which waves are polynomials of its degree: whole panels make up a strand."""

    step: float
    carry: int
    back: int
    mismatch: float
    panel: int = 1


@dataclass(frozen=True, slots=True)
class Extreme:
    """A value, the time [s] and the position along the belt from the run-off [m] where it occurs; `missed` is what
    corners between the samples may add to it."""

    value: float
    time: float
    position: float
    missed: float = 0.0

    def moved(self, by: float) -> "Extreme":
        """The same extreme on a strand that begins so far along the belt [m]."""
        return replace(self, position=self.position + by)


@dataclass(frozen=True, slots=True)
class Motion:
    """The answer of a loop, sampled at `times` (shape (n,)); tensions are whole ones, static part included.

    Samples are a grid step apart, but for the last one, which is the end of the window.

    `waves` (shape (4, n)) are the waves that leave the drum, the tail into either strand, and the run-off.
    """

    grid: Grid
    times: FloatArray
    waves: FloatArray
    belt_speed: FloatArray
    drum_speed: FloatArray
    run_on: FloatArray
    run_off: FloatArray
    carry_max: Extreme
    carry_min: Extreme
    back_max: Extreme
    back_min: Extreme
    slipped: bool
    reversed: bool
    energy_residual: float
    cell_updates: int
    ending: Row
    """the belt at the end from run-off to run-on, its speeds over that of the belt at the drum"""
    tail: int
    """which of its masses is at the tail"""

    def largest(self, values: FloatArray) -> tuple[float, float]:
        """Largest value of a sampled history and its time."""
        value, time = largest(values, self.grid.step)
        return value, min(time, float(self.times[-1]))

    def smallest(self, values: FloatArray) -> tuple[float, float]:
        """Smallest value of a sampled history and its time."""
        value, time = smallest(values, self.grid.step)
        return value, min(time, float(self.times[-1]))


def match(first: float, second: float, at_least: int, tolerance: float, at_most: int = 8192) -> Grid:
    """The coarsest grid that divides both travel times to `tolerance`, or the best one up to `at_most` cells.

    Both times share the mismatch so that their sum is exact.
    """
    last = max(at_most, at_least)
    best: Grid | None = None
    begin, many = at_least, _FIRST_TRIED
    while begin <= last:  # the coarsest that is good enough comes early most of the time
        carry = np.arange(begin, min(begin + many, last + 1))
        back = np.maximum(1, np.rint(carry * (second / first)))
        step = (first + second) / (carry + back)
        mismatch = np.maximum(np.abs(carry * step / first - 1), np.abs(back * step / second - 1))
        good = mismatch <= tolerance
        found = bool(good.any())
        at = int(np.argmax(good)) if found else int(np.argmin(mismatch))
        if found or best is None or mismatch[at] < best.mismatch:
            best = Grid(float(step[at]), int(carry[at]), int(back[at]), float(mismatch[at]))
        if found:
            break
        begin, many = begin + many, 8 * many
    assert best is not None
    return best


def refined(grid: Grid) -> Grid:
    """The same grid with every cell halved."""
    return replace(grid, step=grid.step / 2, carry=grid.carry * 2, back=grid.back * 2)


def panelled(grid: Grid, panel: int) -> Grid:
    """The same grid with every cell cut into the steps of a panel."""
    return replace(grid, step=grid.step / panel, carry=grid.carry * panel, back=grid.back * panel, panel=panel)


def steps_of(window: float, grid: Grid) -> tuple[int, float]:
    """Steps that cover a window [s], and the share of the last one at which it ends.

    Raises:
        NumericsError: NUM101 when there are more than MOST_STEPS.
    """
    steps = max(math.ceil(window / grid.step - 1e-9), 1)
    if steps > MOST_STEPS:
        raise NumericsError("NUM101", f"the window of {window:.4g} s needs {steps} steps of {grid.step:.3g} s")
    return steps, window / grid.step - (steps - 1)


def at_end(history: FloatArray, share: float) -> FloatArray:
    """Values (one, or several along the second axis) of histories that end inside their last step, after a share of
    it, by the parabola of three samples."""
    if len(history) < 3:
        return np.asarray(history[-2] + share * (history[-1] - history[-2]))
    before, start, end = history[-3:]
    return np.asarray(start + share * (end - before) / 2 + share**2 * (end - 2 * start + before) / 2)
