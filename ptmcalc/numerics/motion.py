"""What is propagated: the equations of one mode, and the system that has them."""

from collections.abc import Callable, Hashable, Iterator, Sequence
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
    guard_sizes: FloatArray = field(init=False)
    """|G|"""
    whole: FloatArray = field(init=False)
    """A and B side by side, where there are curves"""
    sizes: FloatArray = field(init=False)
    """what a derivative's rounding grows by: 4 |A|, 4 |B|"""
    ladder: "_Ladder | None" = field(init=False, default=None)
    """the derivatives of the guards, where no curve bends them"""

    def __post_init__(self) -> None:
        object.__setattr__(self, "guard_sizes", np.abs(self.guards))
        if self.curves:
            object.__setattr__(self, "whole", np.hstack([self.rate, self.gain]))
            object.__setattr__(self, "sizes", 4 * np.abs(self.whole))
        else:
            object.__setattr__(self, "ladder", _Ladder.of(self.guards, self.rate))


class _Ladder(NamedTuple):
    """Guards and their derivatives G A^k as functionals, one order after the other, and what rounding leaves of them:
    NOISE 4^k |G| |A|^k."""

    rows: FloatArray
    noise: FloatArray

    @classmethod
    def of(cls, guards: FloatArray, rate: FloatArray) -> "_Ladder":
        rows, noise = [guards], [NOISE * np.abs(guards)]
        larger = 4 * np.abs(rate)
        for _ in range(_ORDERS):
            rows.append(rows[-1] @ rate)
            noise.append(noise[-1] @ larger)
        return cls(np.concatenate(rows), np.concatenate(noise))


@dataclass(slots=True)
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


class Look:
    """A state seen in a mode: on which side of 0 each guard goes on."""

    def __init__(self, system: System, state: FloatArray) -> None:
        self.system, self.state = system, state
        own, scale = system.own, system.scale
        size = float(np.abs(state[:own] / scale[:own]).max(initial=0.0))
        self.dust = DUST * size * scale[:own]
        self.magnitude = np.abs(state)

    def sides(self, mode: Mode) -> NDArray[np.intp]:
        """-1, 0 or 1 for every guard of a mode: the sign of its first derivative that is not 0 beyond rounding."""
        return np.array(self.told(self.system.motion(mode)), dtype=np.intp)

    def told(self, motion: Motion) -> list[int]:
        """The same of the equations of a mode."""
        count = len(motion.guards)
        sides, waiting = [0] * count, list(range(count))
        beside = (motion.guard_sizes[:, : len(self.dust)] @ self.dust).tolist()
        for found, noise in self._derivatives(motion):
            undecided = []
            for guard in waiting:
                value = found[guard]
                if abs(value) > noise[guard] + beside[guard]:
                    sides[guard] = 1 if value > 0 else -1
                else:
                    undecided.append(guard)
            if not undecided:
                break
            waiting, beside = undecided, [0.0] * count
        return sides

    def _derivatives(self, motion: Motion) -> Iterator[tuple[list[float], list[float]]]:
        """Guards and their derivatives, one order after the other, with the rounding of each: NOISE 4^k |G| |A|^k |z|.

        The k-th derivative of g is G A^k z; where a curve takes part it counts with its tangent, which is exact to the
        second derivative.
        """
        if motion.ladder is not None:
            count = len(motion.guards)
            found, noise = (motion.ladder.rows @ self.state).tolist(), (motion.ladder.noise @ self.magnitude).tolist()
            for first in range(0, len(found), max(count, 1)):
                yield found[first : first + count], noise[first : first + count]
            return
        y = [curve.rows @ self.state for curve in motion.curves]
        values = np.array([float(curve.value(at[:, None])[0]) for curve, at in zip(motion.curves, y, strict=True)])
        slopes = [curve.slope(at) for curve, at in zip(motion.curves, y, strict=True)]
        tangents = np.array([slope * curve.rows[0] for slope, curve in zip(slopes, motion.curves, strict=True)])
        beyond = values - [slope * at[0] for slope, at in zip(slopes, y, strict=True)]
        sizes = np.abs(tangents)
        now = np.concatenate([self.state, values])
        larger = np.concatenate([self.magnitude, sizes @ self.magnitude + np.abs(beyond)])
        larger *= NOISE
        for order in range(_ORDERS + 1):
            yield (motion.guards @ now).tolist(), (motion.guard_sizes @ larger).tolist()
            if order < _ORDERS:
                moved, more = motion.whole @ now, motion.sizes @ larger
                now = np.concatenate([moved, tangents @ moved])
                larger = np.concatenate([more, sizes @ more])
