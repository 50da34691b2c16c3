"""What is propagated: the equations of one mode, and the system that has them."""

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ptmcalc.numerics.panels import FloatArray
from ptmcalc.numerics.record import Event

Mode = Hashable
NOISE = 16 * float(np.finfo(float).eps)
"""Rounding of a functional, over the sum of the magnitudes it adds."""
DUST = 1e-22
"""Share of the largest state, in variables of like size, below which a state is no motion but rounding of none."""
_ORDERS = 5
"""Derivatives looked at to tell on which side of 0 a guard goes on."""


@dataclass(frozen=True, slots=True)
class Curve:
    """A smooth nonlinear input n(y), y = Y z.

    `value` takes y of shape (arguments, nodes) and gives shape (nodes,); `slope` the derivative to the first argument
    at one point; `size` the size of n that the tolerance is a share of; `grain` the steps in which slopes are used.
    """

    rows: FloatArray
    value: Callable[[FloatArray], FloatArray]
    slope: Callable[[FloatArray], float]
    size: float
    grain: float


@dataclass(frozen=True, slots=True)
class Motion:
    """What holds in one mode.

    `rate` A (n, n); `gain` B (n, curves); `guards` (guards, n + curves) and `watch` (signals, n + curves) act on z
    and, behind it, on the values of the curves.
    """

    rate: FloatArray
    gain: FloatArray
    guards: FloatArray
    watch: FloatArray
    curves: tuple[Curve, ...] = ()


@dataclass(frozen=True, slots=True)
class Reaction:
    """What follows an event: the mode and the state after it, what happened, the energy lost in a jump."""

    mode: Mode
    state: FloatArray
    events: tuple[Event, ...] = ()
    lost: float = 0.0
    finished: bool = False


class System(Protocol):
    """What is propagated. The first `own` states are its own, the others are inputs that depend on none of them."""

    own: int
    input_speed: float

    @property
    def scale(self) -> FloatArray:
        """Sizes that make the states alike."""
        ...

    @property
    def products(self) -> Sequence[tuple[int, int]]:
        """Pairs of watched signals whose product is integrated."""
        ...

    def motion(self, mode: Any) -> Motion:
        """The equations of a mode."""
        ...

    def next_break(self, mode: Any, time: float) -> float:
        """The next time at which an input changes its form; infinite where none will."""
        ...

    def react(self, mode: Any, time: float, state: FloatArray, fired: int | None) -> Reaction:
        """The mode that holds from now on, after guard `fired` crossed, or after a break (None)."""
        ...


@dataclass(frozen=True, slots=True)
class Look:
    """A state seen in a mode: on which side of 0 each guard goes on."""

    system: System
    state: FloatArray

    def sides(self, mode: Mode) -> NDArray[np.intp]:
        """-1, 0 or 1 for every guard of a mode: the sign of its first derivative that is not 0 beyond rounding."""
        own = self.system.own
        size = float(np.abs(self.state[:own] / self.system.scale[:own]).max(initial=0.0))
        dust = np.zeros(len(self.state))
        dust[:own] = DUST * size * self.system.scale[:own]
        return _sides(self.system.motion(mode), self.state, dust)


def _sides(motion: Motion, state: FloatArray, dust: FloatArray) -> NDArray[np.intp]:
    """Signs of the guards just after a state.

    The k-th derivative of g is G A^k z; where a curve takes part it counts with its slope,
    which is exact to the second derivative.
    """
    n = len(state)
    rate, guards = motion.rate, motion.guards[:, :n]
    offset, level = 0.0, 0.0
    for index, curve in enumerate(motion.curves):
        y = curve.rows @ state
        slope, now = curve.slope(y), float(curve.value(y[:, None])[0])
        rest = now - slope * y[0]
        rate = rate + np.outer(motion.gain[:, index], slope * curve.rows[0])
        guards = guards + np.outer(motion.guards[:, n + index], slope * curve.rows[0])
        offset = offset + motion.gain[:, index] * rest
        level = level + motion.guards[:, n + index] * rest
    z, size = state, np.abs(state)
    found, noise = guards @ z + level, NOISE * (np.abs(guards) @ size + np.abs(level)) + np.abs(guards) @ dust
    sides = np.where(np.abs(found) > noise, np.sign(found), 0.0)
    magnitude, allowed = np.abs(rate), NOISE
    for _ in range(_ORDERS):
        open_ = np.flatnonzero(sides == 0)
        if not len(open_):
            break
        z, size = rate @ z + offset, magnitude @ size + np.abs(offset)
        offset, allowed = 0.0, 4 * allowed
        rows = guards[open_]
        found = rows @ z
        clear = np.abs(found) > allowed * (np.abs(rows) @ size)
        sides[open_[clear]] = np.sign(found[clear])
    return sides.astype(np.intp)
