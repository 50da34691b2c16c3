"""Oscillators whose base is accelerated pass after pass, each pass shorter or longer than the one before.

    q'' + 2 zeta w q' + w^2 q = -a(t)

A machine that speeds up takes its teeth ever faster: the state map of a pass changes with its time, so every pass has
its own. Each is put together from the stretches between the places looked at; within a stretch the free motion is
exact and Duhamel's integral is a Gauss quadrature, whose difference from one of lower order bounds its error. Errors
of all stretches add up at most, since a free motion never gains energy.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ptmcalc.numerics.collocation import gauss
from ptmcalc.numerics.free_motion import free_motion

FloatArray = NDArray[np.float64]

_ORDER, _LOWER = 12, 8


@dataclass(frozen=True, slots=True)
class Run:
    """What the oscillators do: times (passes, places), q and q' (passes, places, modes), and the most by which w q and
    q' may be wrong, per mode."""

    times: FloatArray
    displacement: FloatArray
    speed: FloatArray
    frequencies: FloatArray
    damping_ratios: FloatArray
    error: FloatArray

    @property
    def end(self) -> FloatArray:
        """(q, q') after the last pass, shape (modes, 2)."""
        return np.stack([self.displacement[-1, -1], self.speed[-1, -1]], axis=-1)

    def force(self, masses: ArrayLike) -> FloatArray:
        """Sum of -M_k (w^2 q + 2 zeta w q') over the modes, (passes, places)."""
        w, zeta = self.frequencies, self.damping_ratios
        return np.asarray(-(w**2 * self.displacement + 2 * zeta * w * self.speed) @ np.asarray(masses, float))


def run_through(
    edges: FloatArray,
    acceleration: Callable[[FloatArray], FloatArray],
    frequencies: ArrayLike,
    damping_ratios: ArrayLike,
    stretches: int,
    start: FloatArray | None = None,
    orders: tuple[int, int] = (_ORDER, _LOWER),
) -> Run:
    """Motion of oscillators through passes of any length.

    Args:
        edges: times between the passes, shape (passes + 1,) [s].
        acceleration: of the base at times since the beginning of each pass, (passes, any) -> the same shape, or
            (passes, any, modes) where every mode has a base of its own; smooth within a pass.
        frequencies: w, above 0, shape (modes,) [rad/s].
        damping_ratios: zeta, also above 1, shape (modes,) [1].
        stretches: into how many of one length each pass is cut, so that one map does for all of them; the motion is
            wanted at their ends. Enough for the fastest mode to turn or fade by a few units in each:
            w max(1, 2 zeta) T/stretches < 8 or so.
        start: (q, q') before the first pass, shape (modes, 2); at rest without it.
        orders: of the quadrature, and of the one it is compared with.

    Returns:
        the motion.

    **Error** told: a bound on what the quadrature misses, in w q and q'.
    **Source** module docstring.
    """
    w = np.atleast_1d(np.asarray(frequencies, float))
    zeta = np.broadcast_to(np.asarray(damping_ratios, float), w.shape)
    edges = np.asarray(edges, float)
    lengths, at = np.diff(edges), np.linspace(0.0, 1.0, stretches + 1)
    kicks, error = _kicks(acceleration, lengths, at, w, zeta, orders)
    short, whole = (free_motion(w, zeta, times[:, None]) for times in (lengths / stretches, lengths))
    states = _played(short, whole, kicks, np.zeros((len(w), 2)) if start is None else start)
    inside = lengths[:, None] * at
    return Run(
        times=edges[:-1, None] + inside,
        displacement=states[..., 0],
        speed=states[..., 1],
        frequencies=w,
        damping_ratios=zeta,
        error=error,
    )


def _kicks(
    acceleration: Callable[[FloatArray], FloatArray],
    lengths: FloatArray,
    at: FloatArray,
    w: FloatArray,
    zeta: FloatArray,
    orders: tuple[int, int],
) -> tuple[FloatArray, FloatArray]:
    """What the base adds to (q, q') in every stretch, (passes, stretches, modes, 2), and the bound of its error."""
    found, steps = [], lengths / (len(at) - 1)
    for order in orders:
        nodes, weights = gauss(order)
        inside = (at[:-1, None] + nodes / (len(at) - 1)).ravel()
        base = acceleration(lengths[:, None] * inside)
        modes = base.shape[2] if base.ndim == 3 else 1
        base = base.reshape(len(lengths), len(at) - 1, order, modes).transpose(0, 3, 1, 2)
        left = steps[:, None] * (1 - nodes)
        response = free_motion(w, zeta, left[..., None])[..., 1]  # of a kick of 1, at the end of the stretch
        response *= -(weights * steps[:, None])[..., None, None]
        found.append((base @ response.transpose(0, 2, 1, 3)).transpose(0, 2, 1, 3))
    stray = found[0] - found[1]
    return found[0], np.hypot(w * stray[..., 0], stray[..., 1]).sum(axis=(0, 1))


def _played(short: FloatArray, whole: FloatArray, kicks: FloatArray, state: FloatArray) -> FloatArray:
    """(q, q') at both ends of every stretch, (passes, stretches + 1, modes, 2): maps of a stretch and of a pass of each
    length, shape (passes, modes, 2, 2), and what the base adds."""
    passes, stretches, modes = kicks.shape[:3]
    states = np.zeros((passes, stretches + 1, modes, 2))
    for k in range(stretches):  # each pass from rest
        states[:, k + 1] = np.einsum("pmij,pmj->pmi", short, states[:, k]) + kicks[:, k]
    offset = states[:, -1].copy()
    for p in range(passes):
        states[p, 0] = state
        state = np.einsum("mij,mj->mi", whole[p], state) + offset[p]
    for k in range(stretches):
        states[:, k + 1] = np.einsum("pmij,pmj->pmi", short, states[:, k]) + kicks[:, k]
    return states
