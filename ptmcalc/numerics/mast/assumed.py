"""A column that keeps to one shape: two masses, coupled, instead of many modes.

The shape f is 1 at the far end, the unknown is the deflection there. What the shape makes of stiffness and masses comes
from outside, as closed forms; the march is that of any other mast.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ptmcalc.numerics.mast.elements import Elements
from ptmcalc.numerics.mast.modes import Mast
from ptmcalc.numerics.mast.parts import Column, FloatArray


@dataclass(frozen=True, slots=True)
class OneShape(Elements):
    """A column whose only unknown is the deflection of its far end."""

    shape: Callable[[float], float] = float

    def row(self, place: float) -> FloatArray:
        """The deflection at a place: the shape there."""
        return np.array([self.shape(place)])


def one_shape(
    column: Column,
    shape: Callable[[float], float],
    stiffness: float,
    masses: tuple[float, float],
    total: float,
    turning: tuple[float, float, float],
) -> Mast:
    """A mast that keeps to one shape.

    Args:
        column: what it stands for.
        shape: f, at a place of the column, 1 at its far end.
        stiffness: at the far end, with what weights do to it [N/m].
        masses: integral f^2 dm and integral f dm, all that is on the column and at its root [kg].
        total: of all that [kg].
        turning: integral z dm [kg m], integral z f dm [kg m], and what weights do against a turn about the root per
            deflection of the far end [N].

    **Error** frequencies too high, the deflection of the far end at rest under even acceleration exact, if the shape is
    that of a force at the far end.
    **Source** Rayleigh's principle.
    """
    built = OneShape(
        column,
        np.array([0.0, column.length]),
        np.array([[shape(0.0)], [0.0], [shape(column.length)], [0.0]]),  # `row` asks the shape itself
        np.array([[stiffness]]),
        np.array([[masses[0]]]),
        np.array([masses[1]]),
        total,
        turning[0],
        np.array([turning[1]]),
        np.array([turning[2]]),
        shape,
    )
    return Mast(built)
