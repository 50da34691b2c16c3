"""The exact motion between two events: a linear system, and what is read from it at the nodes of panels."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ptmcalc.numerics import expm
from ptmcalc.numerics.panels import COUNT, NODES, FloatArray

RESOLVED = 0.8
"""Largest frequency times panel: the polynomial through the nodes is then exact to 3e-12 of the amplitude."""
FADED = 1e-11
"""Share of a signal below which a fast component no longer has to be resolved, unless a flow says otherwise."""
_WELL_POSED = 1e-6
WORTH_A_LOOK = 400.0
"""Radians to come of the fastest component above which it is worth asking whether it has faded."""
MOST_PANELS = 32

Readings = NDArray[np.float64]
"""Signals at the nodes of panels, shape (panels, nodes, signals)."""


@dataclass(slots=True)
class Flow:
    """z' = A z with the signals R z that are watched, in variables of like size.

    `rate` is A, shape (n, n); `rows` is R, shape (signals, n); both in the scaled variables z/scale.
    """

    rate: FloatArray
    rows: FloatArray
    own: int
    """how many states are the system's own; those after them are inputs, which depend on none of them"""
    input_speed: float = 0.0
    """frequency of the fastest input [rad/s]"""
    faded: float = FADED
    resolved: float = RESOLVED
    worth: float = WORTH_A_LOOK
    _stack: FloatArray = field(init=False)
    _norm: float = field(init=False)
    _largest: float = field(init=False)
    _components: "_Components | None" = field(init=False, default=None)
    magnitudes: FloatArray = field(init=False)
    """|R|"""
    _chunks: dict[float, "_Chunk"] = field(init=False, default_factory=dict)

    def __post_init__(self) -> None:
        self._stack = expm.powers(self.rate)
        self._norm = float(np.abs(self.rate).sum(axis=0).max(initial=0.0))
        self.magnitudes = np.abs(self.rows)
        speeds = np.abs(np.linalg.eigvals(self.rate[: self.own, : self.own]))
        self._largest = max(float(speeds.max(initial=0.0)), self.input_speed)

    def panel(self, state: FloatArray, longest: float, sizes: FloatArray) -> float:
        """A panel that resolves every component still seen in a signal of these sizes: a power of two in seconds, or
        the longest one that is asked for."""
        fastest = self._largest
        if fastest * longest > self.worth:
            if self._components is None:
                self._components = _components(self.rate, self.rows, self.own)
            limits = self.faded * np.maximum(self.magnitudes @ np.abs(state), sizes)
            fastest = max(self._components.fastest(state, limits), self.input_speed)
        if fastest * longest <= self.resolved:
            return longest
        return float(2.0 ** np.floor(np.log2(self.resolved / fastest)))

    def moved(self, state: FloatArray, time: float) -> FloatArray:
        """The state after some time, exact."""
        result: FloatArray = expm.from_powers(self._stack, self._norm, np.array([time]))[0] @ state
        return result

    def read(self, state: FloatArray, panel: float, count: int) -> tuple[Readings, FloatArray]:
        """Signals at the nodes of panels in a row, and the states at their starts and at the last end."""
        chunk = self._chunks.get(panel)
        if chunk is None:
            chunk = self._chunks[panel] = _Chunk(self.at_nodes(panel))
        starts = chunk.starts(state, count)
        readings = (starts[:-1] @ chunk.seen(self.rows)).reshape(count, COUNT, len(self.rows))
        return readings, starts

    def read_once(self, state: FloatArray, panel: float) -> tuple[Readings, FloatArray]:
        """Signals at the nodes of one panel of any length, and the state at its end."""
        nodes = self.at_nodes(panel) @ state
        return (nodes @ self.rows.T)[None], nodes[-1]

    def at_nodes(self, panel: float) -> FloatArray:
        return expm.from_powers(self._stack, self._norm, panel * NODES)


@dataclass(slots=True)
class _Chunk:
    """What panels of one length need: the exponentials at the nodes, and powers of the last one."""

    at_nodes: FloatArray
    _powers: FloatArray | None = None
    _seen: FloatArray | None = None

    def seen(self, rows: FloatArray) -> FloatArray:
        """Maps the state at a panel's start to the signals at its nodes, shape (n, nodes*signals)."""
        if self._seen is None:
            self._seen = np.ascontiguousarray((rows @ self.at_nodes).reshape(-1, rows.shape[1]).T)
        return self._seen

    def starts(self, state: FloatArray, count: int) -> FloatArray:
        """States after 0 .. count panels, shape (count + 1, n)."""
        whole, n = self.at_nodes[-1], len(state)
        if count < 4:
            found = np.empty((count + 1, n))
            found[0] = state
            for k in range(count):
                found[k + 1] = whole @ found[k]
            return found
        if self._powers is None:
            powers = np.empty((MOST_PANELS + 1, n, n))
            powers[0], powers[1] = np.eye(n), whole
            filled = 2
            while filled <= MOST_PANELS:  # doubling keeps rounding to a few units
                more = min(filled - 1, MOST_PANELS + 1 - filled)
                powers[filled : filled + more] = powers[1 : 1 + more] @ powers[filled - 1]
                filled += more
            self._powers = powers
        return (self._powers[: count + 1].reshape(-1, n) @ state).reshape(count + 1, n)


@dataclass(frozen=True, slots=True)
class _Components:
    """The components of a motion that can be told apart: how fast each is, what finds it, and who sees it.

    Eigenvectors only say which panel is short enough, never how the state moves. A component whose eigenvector is not
    well separated (a free mass, coinciding frequencies) counts as always there.
    """

    speeds: FloatArray
    shares: NDArray[np.complex128]
    shapes: FloatArray
    posed: NDArray[np.bool_]

    def fastest(self, state: FloatArray, limits: FloatArray) -> float:
        """Speed of the fastest component of a state that any signal sees above its limit."""
        if not len(self.speeds):
            return 0.0
        seen = np.abs(self.shares @ state)[:, None] * self.shapes > limits + 1e-290
        there = ~self.posed | seen.any(axis=1)
        return float(self.speeds[there].max(initial=0.0))


def _components(rate: FloatArray, rows: FloatArray, own: int) -> _Components:
    """Components of the first `own` states, which nothing after them depends on.

    The left eigenvector w of the block goes on as w C (lambda - S)^-1 over the inputs, C their effect, S their rates.
    """
    block, effect, inputs = rate[:own, :own], rate[:own, own:], rate[own:, own:]
    values, right = np.linalg.eig(block)
    twins, left = np.linalg.eig(block.T)
    match = np.abs(values[:, None] - twins).argmin(axis=1) if own else np.empty(0, int)
    left = left[:, match].T
    overlap = np.einsum("ij,ji->i", left, right)
    posed = (np.abs(overlap) > _WELL_POSED) & (np.bincount(match, minlength=own)[match] == 1)
    posed &= np.abs(values) > 1e-6 * np.abs(values).max(initial=0.0)
    left = left / np.where(posed, overlap, 1.0)[:, None]
    gap = values[:, None, None] * np.eye(len(inputs)) - inputs
    gap[~posed] = np.eye(len(inputs))
    beyond = np.linalg.solve(gap.transpose(0, 2, 1), (left @ effect)[:, :, None])[:, :, 0]
    return _Components(np.abs(values), np.hstack([left, beyond]), np.abs(rows[:, :own] @ right).T, posed)
