"""The components of a linear motion: how fast each is, how large it is in a state, and who sees it."""

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ptmcalc.numerics.panels import FloatArray

_WELL_POSED = 1e-6
_NOT_THERE = 64 * float(np.finfo(float).eps)
"""Share of what it adds up below which a component is rounding, which every step stirs anew."""
_CRUDE = 1e3 * float(np.finfo(float).eps)
"""Residual of an eigenvector, over what it adds up, above which its small entries are not what they should be."""
_BESIDE = 2.0**-46
"""How far beside an eigenvalue a vector is solved for, as a share of it: there the matrix is not singular."""


@dataclass(frozen=True, slots=True)
class Components:
    """The components of a motion that can be told apart.

    What is no more than rounding of the state is not there: a stiff link under a slow load never shows less.

    Eigenvectors only say what lies between the nodes of a panel, never how the state moves. A component whose
    eigenvector is not well separated (a free mass, coinciding frequencies, an input that moves as it does by itself)
    counts as always there.
    """

    values: NDArray[np.complex128]
    """eigenvalues, of conjugates the one whose imaginary part is above 0 [1/s]"""
    shares: NDArray[np.complex128]
    """what finds each in a state"""
    shapes: NDArray[np.complex128]
    """what guards and, behind them, signals see of each, and of its conjugate, shape (components, rows)"""
    posed: NDArray[np.bool_]
    magnitudes: FloatArray
    """of what the rows add up"""
    speeds: FloatArray = field(init=False)
    """how fast each moves or fades [rad/s]"""
    share_parts: FloatArray = field(init=False)
    """real and imaginary parts of the shares, one beside the other"""
    share_sizes: FloatArray = field(init=False)
    sights: FloatArray = field(init=False)
    """magnitudes of the shapes"""

    def __post_init__(self) -> None:
        object.__setattr__(self, "speeds", np.abs(self.values))
        object.__setattr__(self, "share_parts", self.shares.T.copy().view(float))
        object.__setattr__(self, "share_sizes", np.abs(self.shares).T)
        object.__setattr__(self, "sights", np.abs(self.shapes))

    def amplitudes(self, states: FloatArray) -> NDArray[np.complex128]:
        """The components of states, shape (states, components), or (components,) of one state."""
        found: NDArray[np.complex128] = (states @ self.share_parts).view(complex)
        found[np.abs(found) <= _NOT_THERE * (np.abs(states) @ self.share_sizes)] = 0.0
        return found

    def span(self, state: FloatArray, faded: float, sizes: FloatArray) -> tuple[float, float]:
        """Speeds of the slowest that moves and of the fastest component of a state among those that any guard or
        signal sees as more than a share of its size; (inf, 0) where there is none."""
        limits = self.magnitudes @ np.abs(state)
        watched = limits[len(limits) - len(sizes) :]
        np.maximum(watched, sizes, out=watched)
        seen = np.abs(self.amplitudes(state))[:, None] * self.sights > faded * limits + 1e-290
        there = ~self.posed | seen.any(axis=1)
        speeds = self.speeds[there]
        return float(speeds[speeds > 0].min(initial=math.inf)), float(speeds.max(initial=0.0))


def components(rate: FloatArray, rows: FloatArray, own: int) -> Components:
    """Components of the first `own` states, which nothing after them depends on.

    The left eigenvector w of the block goes on as w C (lambda - S)^-1 over the inputs, C their effect, S their rates.

    Args:
        rate: A, shape (n, n).
        rows: what sees the state, shape (rows, n).
        own: states that are no inputs.
    """
    block, effect, inputs = rate[:own, :own], rate[:own, own:], rate[own:, own:]
    values, right = np.linalg.eig(block)
    twins, left = np.linalg.eig(block.T)
    match = np.abs(values[:, None] - twins).argmin(axis=1) if own else np.empty(0, int)
    left = left[:, match].T
    overlap = np.einsum("ij,ji->i", left, right)
    posed = (np.abs(overlap) > _WELL_POSED) & (np.bincount(match, minlength=own)[match] == 1)
    posed &= np.abs(values) > 1e-6 * np.abs(values).max(initial=0.0)
    posed &= ~_driven_at_its_own(values, inputs)
    _polish(left, values, block, posed)
    overlap = np.einsum("ij,ji->i", left, right)
    left = left / np.where(posed, overlap, 1.0)[:, None]
    gap = values[:, None, None] * np.eye(len(inputs)) - inputs
    gap[~posed] = np.eye(len(inputs))
    beyond = np.linalg.solve(gap.transpose(0, 2, 1), (left @ effect)[:, :, None])[:, :, 0]
    shapes = (rows[:, :own] @ right).T
    shapes[values.imag > 0] *= 2.0  # its conjugate adds as much to what is seen
    one = values.imag >= 0
    found = np.hstack([left, beyond])[one].astype(complex)
    return Components(values[one].astype(complex), found, shapes[one].astype(complex), posed[one], np.abs(rows))


def _polish(left: NDArray[Any], values: NDArray[Any], block: FloatArray, posed: NDArray[np.bool_]) -> None:
    """Left eigenvectors with their small entries right, in place: those that need it, by one inverse iteration.

        w' (A - lambda (1 + e) I) = w

    A method for dense matrices is exact to rounding of the largest entry: of a stiff drive beside a soft column all
    others, times motions of hundreds of metres, would look like a fast component that never fades.
    """
    off = np.abs(left @ block - values[:, None] * left)
    sizes = np.abs(left) @ np.abs(block) + np.abs(values)[:, None] * np.abs(left)
    crude = np.flatnonzero(posed & (values.imag >= 0) & (off > _CRUDE * sizes).any(axis=1))
    if not len(crude):
        return
    shifts = values[crude, None, None] * (1 + _BESIDE) * np.eye(len(block))
    found = np.linalg.solve(block.T - shifts, left[crude][:, :, None])[:, :, 0]
    left[crude] = found / np.abs(found).max(axis=1, keepdims=True)
    pairs = crude[values[crude].imag > 0]
    left[pairs + 1] = left[pairs].conj()


def _driven_at_its_own(values: NDArray[np.complex128], inputs: FloatArray) -> NDArray[np.bool_]:
    """Whether an input moves as a component does by itself: neither then has a share of its own in a state."""
    apart = np.abs(values[:, None] - np.linalg.eigvals(inputs))
    return np.asarray((apart <= _WELL_POSED * np.abs(values)[:, None]).any(axis=1))
