"""One stage of the torque curve of a motor."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]
Curve = Callable[[FloatArray], FloatArray]


@dataclass(frozen=True, slots=True)
class Stage:
    """The torque of a motor over its speed [rad/s, N*m], until it goes over to the next stage.

    It is either exactly piecewise linear (`pieces`) or smooth (`formula` with its derivative `slope`).
    """

    pieces: tuple[tuple[float, float], ...] | None = None
    """knots (speed, torque), the speeds rising; one knot is a constant torque"""
    extends: bool = False
    """whether the first and the last piece go on as straight lines; else the end values hold outside"""
    formula: Curve | None = None
    slope: Curve | None = None
    kloss: tuple[float, float, float, float] | None = None
    """numbers of `formula`, above the last of `knots` where there are any: those of `numerics.belt.curve.Kloss`"""
    knots: tuple[tuple[float, float], ...] = ()
    until_speed: float | None = None
    """the next stage begins when the speed rises to it"""
    until_time: float | None = None
    """the next stage begins at this time after the start"""

    def torque(self, speed: ArrayLike) -> FloatArray:
        """Torque at a speed, in or out of the part of the start in which the stage is on [N*m]."""
        at = np.asarray(speed, float)
        if self.formula is not None:
            return self.formula(at)
        assert self.pieces is not None
        knots, values = np.array(self.pieces).T
        inside = np.asarray(np.interp(at, knots, values))
        if not self.extends or len(knots) == 1:
            return inside
        rises = np.diff(values) / np.diff(knots)
        below, above = np.minimum(at - knots[0], 0), np.maximum(at - knots[-1], 0)
        return np.asarray(inside + rises[0] * below + rises[-1] * above)
