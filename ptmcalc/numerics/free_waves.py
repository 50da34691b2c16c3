"""Waves that go on by themselves in a belt whose ends are held: how far they can ever swing.

The belt is a row of masses with springs between them. Of its natural modes each keeps its amplitude, and the largest
that they can add up to anywhere is what they give where all are in step:

    |S_j(t)| <= sum_k A_k |psi_k,j|,   A_k^2 = q_k^2 + (q_k'/w_k)^2,   psi_k,j = (phi_k,j+1 - phi_k,j)/c_j

with mass-normalised modes phi_k and compliances c_j. Frequencies that have no common measure come as near to it as one
likes, if one waits long enough; damping only lowers it.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.memory import remembered

FloatArray = NDArray[np.float64]

_ROWS = 16
"""Rows whose modes are remembered; a numerical choice. Each takes a megabyte; fewer repeat the work of a search."""
_TAIL = 0.5
"""Part of the mass in sum_k psi_k^2/w_k^2 that is left behind the n-th of the modes of a uniform belt, times n: 2/pi^2
at its held end, with a margin for belts that are not uniform."""


@dataclass(frozen=True, slots=True)
class Row:
    """A belt as masses [kg] and springs between them: compliances [m/N], pulls [N] and speeds [m/s] over those of even
    running, where n springs have n + 1 masses; `held` are the masses that do not move.

    `rate_energy` is that of the rates of its waves, half the integrals of v'^2 dm and S'^2 ds/EA [J/s^2].
    """

    masses: FloatArray
    compliances: FloatArray
    speeds: FloatArray
    pulls: FloatArray
    held: tuple[int, ...]
    rate_energy: float
    cut: int = 0
    """mass at which the row is cut, where a take-up is between this mass and one more at the end of the arrays, from
    which the next spring begins; 0 for none"""
    tie: float = 0.0
    """mass that the relative speed of both sides of the cut moves [kg]: M/4 of a weight on two falls"""


@dataclass(frozen=True, slots=True)
class Swings:
    """How far the waves of a belt can ever swing: amplitudes of its modes, their pulls (springs, modes) and shapes
    (masses, modes), and what waves shorter than its springs add to any pull [N]."""

    amplitudes: FloatArray
    bent: FloatArray
    modes: FloatArray
    rest: float

    @property
    def pulls(self) -> FloatArray:
        """Most by which pulls stray from those of even running [N]."""
        found: FloatArray = np.abs(self.bent) @ self.amplitudes + self.rest
        return found

    @property
    def ways(self) -> FloatArray:
        """Most by which masses stray from where they are in even running [m]."""
        found: FloatArray = np.abs(self.modes) @ self.amplitudes
        return found

    def way_of_weight(self, row: Row) -> float:
        """Most by which the belt at a take-up strays: its first mass from the held drum, or both sides of the cut."""
        if not row.cut:
            return float(self.ways[0])
        return float(np.abs(self.modes[row.cut] - self.modes[-1]) @ self.amplitudes)

    def together(self, weights: Mapping[int, float]) -> float:
        """Most by which a sum of some pulls with weights strays at any one time [N]."""
        bent = sum(weight * self.bent[spring] for spring, weight in weights.items())
        return float(np.abs(bent) @ self.amplitudes) + self.rest * sum(map(abs, weights.values()))


def swings(row: Row) -> Swings:
    """How far the waves of a belt can ever swing.

    Args:
        row: the belt at one time.

    **Range** linear springs without friction that changes.
    **Error** a bound for the row; waves shorter than its springs, known by their energy alone, are added to the pulls
    by Schwarz's inequality, as those of a uniform belt.
    **Source** module docstring; derived.
    """
    arrays = tuple(one.tobytes() for one in (row.masses, row.compliances, row.speeds, row.pulls))
    return _known(arrays, row.held, row.rate_energy, row.cut, row.tie)


@remembered(_ROWS)
def _known(arrays: tuple[bytes, ...], held: tuple[int, ...], energy: float, cut: int, tie: float) -> Swings:
    """The same of a row whose arrays are given as bytes: a search asks for many machines whose belts move alike."""
    masses, compliances, speeds, pulls = map(np.frombuffer, arrays)
    row = Row(masses, compliances, speeds, pulls, held, energy, cut, tie)
    free = np.setdiff1d(np.arange(len(row.masses)), np.mod(row.held, len(row.masses)))
    if row.cut:
        return _swings_of_cut(row, free)
    scale = 1 / np.sqrt(row.masses[free])
    stiffness = np.zeros((len(row.masses), len(row.masses)))
    springs, at = 1 / row.compliances, np.arange(len(row.compliances))
    stiffness[at, at] += springs
    stiffness[at + 1, at + 1] += springs
    stiffness[at, at + 1] = stiffness[at + 1, at] = -springs
    squares, shapes = np.linalg.eigh(stiffness[np.ix_(free, free)] * scale[:, None] * scale)
    modes = np.zeros((len(row.masses), len(free)))
    modes[free] = shapes * scale[:, None]
    bent = np.diff(modes, axis=0) / row.compliances[:, None]
    return _swings(row, squares, modes, bent, row.masses * row.speeds)


def _swings_of_cut(row: Row, free: NDArray[np.int_]) -> Swings:
    """The same of a row with a take-up at its cut: M = diag(m) + m_tie u u', u the difference of both sides."""
    springs, last = np.arange(len(row.compliances)), len(row.masses) - 1
    first, second = np.where(springs == row.cut, last, springs), springs + 1
    reach = np.zeros((len(springs), len(row.masses)))
    reach[springs, first], reach[springs, second] = -1.0, 1.0
    apart = np.zeros(len(row.masses))
    apart[row.cut], apart[last] = 1.0, -1.0
    whole = np.diag(row.masses) + row.tie * np.outer(apart, apart)
    stiffness = reach.T @ (reach / row.compliances[:, None])
    lower = np.linalg.inv(np.linalg.cholesky(whole[np.ix_(free, free)]))
    squares, shapes = np.linalg.eigh(lower @ stiffness[np.ix_(free, free)] @ lower.T)
    modes = np.zeros((len(row.masses), len(free)))
    modes[free] = lower.T @ shapes
    return _swings(row, squares, modes, reach @ modes / row.compliances[:, None], whole @ row.speeds)


def _swings(row: Row, squares: FloatArray, modes: FloatArray, bent: FloatArray, momentum: FloatArray) -> Swings:
    """Amplitudes of the modes, by what they have of the pulls and speeds of the row."""
    frequencies = np.sqrt(np.maximum(squares, squares[-1] * np.finfo(float).eps))
    moved = (row.pulls * row.compliances) @ bent / frequencies**2
    moving = momentum @ modes / frequencies
    amplitudes = np.hypot(moved, moving)
    known = float((frequencies**4 * amplitudes**2).sum()) / 2
    rest = 2 * max(row.rate_energy - known, 0.0) * _TAIL * float(row.masses.sum()) / len(squares)
    return Swings(amplitudes, bent, modes, math.sqrt(rest))
