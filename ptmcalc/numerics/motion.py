"""What is propagated: the equations of one mode, and the system that has them."""

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple, Protocol

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
    ladder: "_Ladder | None" = field(init=False, default=None)
    """the derivatives of the guards, where no curve bends them"""

    def __post_init__(self) -> None:
        if not self.curves:
            object.__setattr__(self, "ladder", _Ladder.of(self.guards, self.rate))


class _Ladder(NamedTuple):
    """Guards and their derivatives G A^k as functionals, and what rounding leaves of them: NOISE 4^k |G| |A|^k."""

    rows: FloatArray
    noise: FloatArray

    @classmethod
    def of(cls, guards: FloatArray, rate: FloatArray) -> "_Ladder":
        rows, noise = [guards], [NOISE * np.abs(guards)]
        larger = 4 * np.abs(rate)
        for _ in range(_ORDERS):
            rows.append(rows[-1] @ rate)
            noise.append(noise[-1] @ larger)
        return cls(np.array(rows), np.array(noise))


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
    ladder = motion.ladder
    if ladder is None:
        ladder, state, dust = _bent(motion, state, dust)
    found, noise = ladder.rows @ state, ladder.noise @ np.abs(state)
    noise[0] += ladder.noise[0] @ (dust / NOISE)
    clear = np.abs(found) > noise
    which = clear.argmax(axis=0), np.arange(clear.shape[1])
    sides: NDArray[np.intp] = (np.sign(found[which]) * clear[which]).astype(np.intp)
    return sides


def _bent(motion: Motion, state: FloatArray, dust: FloatArray) -> tuple[_Ladder, FloatArray, FloatArray]:
    """The same with the tangents of the curves, whose constant parts go with a last state that is 1."""
    n = len(state)
    rate, guards = np.zeros((n + 1, n + 1)), np.zeros((len(motion.guards), n + 1))
    rate[:n, :n], guards[:, :n] = motion.rate, motion.guards[:, :n]
    for index, curve in enumerate(motion.curves):
        y = curve.rows @ state
        slope, now = curve.slope(y), float(curve.value(y[:, None])[0])
        tangent = np.append(slope * curve.rows[0], now - slope * y[0])
        rate[:n] += np.outer(motion.gain[:, index], tangent)
        guards += np.outer(motion.guards[:, n + index], tangent)
    return _Ladder.of(guards, rate), np.append(state, 1.0), np.append(dust, 0.0)
