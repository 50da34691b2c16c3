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

FloatArray = NDArray[np.float64]

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
    free = np.setdiff1d(np.arange(len(row.masses)), np.mod(row.held, len(row.masses)))
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
    frequencies = np.sqrt(np.maximum(squares, squares[-1] * np.finfo(float).eps))
    moved = (row.pulls * row.compliances) @ bent / frequencies**2
    moving = (row.masses * row.speeds) @ modes / frequencies
    amplitudes = np.hypot(moved, moving)
    known = float((frequencies**4 * amplitudes**2).sum()) / 2
    rest = 2 * max(row.rate_energy - known, 0.0) * _TAIL * float(row.masses.sum()) / len(free)
    return Swings(amplitudes, bent, modes, math.sqrt(rest))
