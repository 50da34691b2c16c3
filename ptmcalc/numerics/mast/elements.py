"""A column in finite elements: Euler-Bernoulli beams with cubic shapes, consistent masses and the stiffness of weights.

    K = int E I w''^2 + N w'^2,   M = int m w^2,   N(z) = pull (mass beyond z)

The unknowns are the deflection beside the base and the slope of the root, and at each further node what they are beside
a rigid column on that root. What is rigid is left out of the unknowns, so a root as stiff as a wall costs no digits; a
root as soft as a feather costs none either, for a rigid column does not bend. The elements are conforming: their
frequencies are never too low.
"""

import itertools
import math
from dataclasses import dataclass

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.mast.parts import Column, FloatArray

_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(3)
"""exact for what is integrated: a straight axial force times a parabola squared"""
_SAME = 1e-9
"""Share of the length below which two places are one."""


@dataclass(frozen=True, slots=True)
class Elements:
    """A column as matrices over its free unknowns, shape (n,) and (n, n).

    `places` of the nodes [m]; `moves` deflections and slopes of the nodes by the unknowns, shape (2 nodes, n);
    `stiffness` and `mass`; `carried` M 1: the momentum each unknown shares with the base;
    `total` mass of column, root and lumps [kg]. Along a rigid turn t about the root: `moment` t M 1 [kg m], `turned`
    t M, `righted` t (K - K_bending), what weights and props do against it.
    """

    column: Column
    places: FloatArray
    moves: FloatArray
    stiffness: FloatArray
    mass: FloatArray
    carried: FloatArray
    total: float
    moment: float
    turned: FloatArray
    righted: FloatArray

    def row(self, place: float) -> FloatArray:
        """The deflection at a node as a functional over the unknowns."""
        return np.asarray(self.moves[2 * self.node(place)])

    def node(self, place: float) -> int:
        """The node at a place."""
        index = int(np.abs(self.places - place).argmin())
        if abs(self.places[index] - place) > _SAME * self.column.length:
            raise NumericsError("NUM102", f"no node of the mast is at {place:.6g} m")
        return index


def elements(column: Column, count: int, marks: tuple[float, ...] = ()) -> Elements:
    """A column cut into at least so many elements, with nodes wherever something is and at the marks.

    **Range** slender columns, small deflections; the axial force is that of the weights at rest.
    **Error** of a frequency or deflection: the fourth power of the element's length.
    **Source** Przemieniecki, Theory of matrix structural analysis, 1968, ch. 5, 11 and 15.
    """
    places, bending, density = _cut(column, count, marks)
    beyond = _beyond(column, places, density)
    size = 2 * len(places)
    stiffness, beside, mass = np.zeros((size, size)), np.zeros((size, size)), np.zeros((size, size))
    for k, length in enumerate(np.diff(places)):
        at = slice(2 * k, 2 * k + 4)
        stiffness[at, at] += bending[k] * _bent(float(length))
        mass[at, at] += density[k] * _massed(float(length))
        beside[at, at] += column.pull * _pulled(float(length), float(beyond[k]), float(density[k]))
    for lump in column.lumps:
        at_node = 2 * int(np.abs(places - lump.place).argmin())
        mass[at_node, at_node] += lump.mass
        mass[at_node + 1, at_node + 1] += lump.inertia
    mass[0, 0] += column.root_mass
    mass[1, 1] += column.root_inertia
    for prop in column.props:
        at_node = 2 * int(np.abs(places - prop.place).argmin())
        beside[at_node, at_node] += prop.stiffness
    stiffness[:2], stiffness[:, :2] = 0.0, 0.0  # a column that moves rigidly with its root does not bend
    fixed = set()
    for unknown, spring in ((0, column.root_translation), (1, column.root_rotation)):
        if math.isinf(spring):
            fixed.add(unknown)
        else:
            stiffness[unknown, unknown] += spring
    along, turning = np.zeros(size), np.zeros(size)
    along[::2] = 1.0
    turning[::2], turning[1::2] = places, 1.0
    moves = np.eye(size)
    moves[:, 0], moves[:, 1] = along, turning
    chosen = [k for k in range(size) if k not in fixed]
    moves, inertia = moves[:, chosen], mass @ along
    return Elements(
        column,
        places,
        moves,
        stiffness[np.ix_(chosen, chosen)] + moves.T @ beside @ moves,
        moves.T @ mass @ moves,
        inertia @ moves,
        float(along @ inertia),
        float(turning @ inertia),
        (mass @ turning) @ moves,
        (beside @ turning) @ moves,
    )


def _cut(column: Column, count: int, marks: tuple[float, ...]) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Places of the nodes, bending stiffness and mass per length of the elements between them."""
    ends = np.concatenate([[0.0], np.cumsum([segment.length for segment in column.segments])])
    things = [*(lump.place for lump in column.lumps), *(prop.place for prop in column.props)]
    wanted = sorted({*ends.tolist(), *things, *marks})
    corners = [0.0]
    for place in wanted:
        if place > column.length * (1 + _SAME):
            raise NumericsError("NUM102", f"{place:.6g} m is beyond the mast")
        if place - corners[-1] > _SAME * column.length:
            corners.append(place)
    places: list[float] = [0.0]
    for low, high in itertools.pairwise(corners):
        parts = max(math.ceil(count * (high - low) / column.length * (1 - _SAME)), 1)
        places += (low + (high - low) * np.arange(1, parts + 1) / parts).tolist()
    middles = (np.array(places[1:]) + np.array(places[:-1])) / 2
    which = np.clip(np.searchsorted(ends, middles) - 1, 0, len(column.segments) - 1)
    bending = np.array([column.segments[k].bending for k in which])
    return np.array(places), bending, np.array([column.segments[k].mass for k in which])


def _beyond(column: Column, places: FloatArray, density: FloatArray) -> FloatArray:
    """Mass beyond the far end of each element."""
    own = np.append(np.cumsum((density * np.diff(places))[::-1])[::-1], 0.0)
    lumps = [sum(lump.mass for lump in column.lumps if lump.place >= end - _SAME * column.length) for end in places]
    return np.asarray(own[1:] + np.array(lumps)[1:], float)


def _bent(h: float) -> FloatArray:
    rows = [[12, 6 * h, -12, 6 * h], [6 * h, 4 * h**2, -6 * h, 2 * h**2]]
    rows += [[-12, -6 * h, 12, -6 * h], [6 * h, 2 * h**2, -6 * h, 4 * h**2]]
    return np.array(rows, float) / h**3


def _massed(h: float) -> FloatArray:
    rows = [[156, 22 * h, 54, -13 * h], [22 * h, 4 * h**2, 13 * h, -3 * h**2]]
    rows += [[54, 13 * h, 156, -22 * h], [-13 * h, -3 * h**2, -22 * h, 4 * h**2]]
    return np.array(rows, float) * h / 420


def _pulled(h: float, beyond: float, density: float) -> FloatArray:
    """int (mass beyond z) w'^2 over an element."""
    s = (1 + _POINTS) / 2
    slopes = np.array([(6 * s**2 - 6 * s) / h, 3 * s**2 - 4 * s + 1, (6 * s - 6 * s**2) / h, 3 * s**2 - 2 * s])
    axial = beyond + density * h * (1 - s)
    return np.asarray((slopes * (axial * _WEIGHTS * h / 2)) @ slopes.T)
