"""What a chain under periodic motion is made of: strands, damping, ends, and the motion.

A chain of one or two uniform strands starts at the run-on of a sprocket and goes against the travel: working strand,
a joint that may have a mass (tail), return strand, far end. Displacements are positive in the direction of travel,
forces are tensions, both without their static part.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

KELVIN_VOIGT, HYSTERETIC, ZENER = "kelvin_voigt", "hysteretic", "zener"
FREE, HELD, ON_SPROCKET = "free", "held", "on_sprocket"


@dataclass(frozen=True, slots=True)
class Damping:
    """Internal damping by a complex modulus: Kelvin-Voigt 1 + i w t (`time` t, the retardation time), hysteretic
    1 + i g (`share` g, the loss factor), Zener 1 + g i w t/(1 + i w t) (`share` g, the second spring over the first,
    `time` t, its relaxation time)."""

    law: str
    time: float = 0.0
    share: float = 0.0

    def __post_init__(self) -> None:
        if self.law not in (KELVIN_VOIGT, HYSTERETIC, ZENER):
            raise ValueError(f"no damping is called `{self.law}`")
        if self.time < 0 or self.share < 0:
            raise ValueError("damping takes energy out: neither its time nor its share is negative")

    def modulus(self, w: FloatArray) -> ComplexArray:
        """Complex modulus over the static one."""
        if self.law == KELVIN_VOIGT:
            return np.asarray(1 + 1j * (w * self.time))
        if self.law == HYSTERETIC:
            return np.full(np.shape(w), 1 + 1j * self.share)
        x = 1j * (w * self.time)
        return np.asarray(1 + self.share * x / (1 + x))


@dataclass(frozen=True, slots=True)
class Line:
    """A uniform strand: length [m], mass per length [kg/m], tensile stiffness [N]."""

    length: float
    line_mass: float
    stiffness: float

    @property
    def transit(self) -> float:
        """Travel time of a wave [s]."""
        return self.length * float(np.sqrt(self.line_mass / self.stiffness))

    @property
    def impedance(self) -> float:
        """Force of a wave over its particle speed [N*s/m]."""
        return float(np.sqrt(self.line_mass * self.stiffness))


@dataclass(frozen=True, slots=True)
class Chain:
    """One or two strands from the run-on of a sprocket against the travel, and how they end.

    `far` is `free` (constant tension, with a `far_mass` that moves with it: a take-up, or a tail sprocket with what it
    drives, whose own polygon moves the end against it), `held` (an end that is fixed or moved by something else) or
    `on_sprocket` (the run-off of the same sprocket: screw take-up). `drive_mass` is the drive at the rim, infinite for
    a sprocket whose speed nothing changes.
    """

    lines: tuple[Line, ...]
    damping: Damping
    far: str = FREE
    joint_mass: float = 0.0
    far_mass: float = 0.0
    drive_mass: float = np.inf

    def __post_init__(self) -> None:
        if len(self.lines) not in (1, 2):
            raise ValueError("a chain has one or two strands")
        if self.far not in (FREE, HELD, ON_SPROCKET):
            raise ValueError(f"no end is called `{self.far}`")


@dataclass(frozen=True, slots=True)
class Excitation:
    """Periodic acceleration of an end, sum b_n sin(2 pi n (x - place)), x in pitches.

    `harmonics` are the b_n from n = 1 on, shape (N,) or (speeds, N) [m/s^2]. Behind the last one they must go on
    alternating with n |b_n| falling to its limit like 1/n^2 at least, as those of an acceleration that jumps once per
    pitch at place + 1/2 do. A last one of 0 says that there are no more.
    """

    harmonics: FloatArray
    place: float = 0.0
