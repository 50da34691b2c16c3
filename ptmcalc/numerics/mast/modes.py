"""What a column does beside its base: vibrations, what it gives way statically, how much of it a run has to follow.

    K p = w^2 M p,   p^T M p = 1,   L = p^T M 1      base held
    K p = w^2 (M - M 1 1^T M/m) p                    base free to roll, m the mass of all that rolls

Solved as 1/w^2 from the Cholesky factor of K scaled to a unit diagonal, so the lowest frequencies keep their digits
beside whatever is stiff, and what has no mass gives 1/w^2 = 0: it follows at once.
"""

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.mast.elements import Elements, elements
from ptmcalc.numerics.mast.parts import Column, FloatArray

MASSLESS = 1e-13
"""Share of the largest 1/w^2 below which a mode has no mass beyond rounding."""
_RISE_PERIODS = 5.0
FEWEST = 2
_COARSE = 2
"""Times as many elements as those a bar is found with."""
_ROUNDING = 4 * float(np.finfo(float).eps)
_NO_STIFFNESS = (
    "the mast buckles under its weights, or two points on it are too close to each other to compute the stiffness"
)
_BAR = 1.0
"""Share of the difference to half as many elements that a frequency may be wrong by; the fourth power says 1/15."""


class Mast:
    """The modes of a column over a base that is held, and what it does statically."""

    def __init__(self, built: Elements) -> None:
        self.elements = built
        self._factor = _factor(built.stiffness)
        self.frequencies, self.shapes = _modes(self._factor, built.mass)
        self.participation: FloatArray = built.carried @ self.shapes
        self._rolling: dict[float, tuple[FloatArray, FloatArray]] = {}

    @classmethod
    def of(cls, column: Column, count: int, marks: tuple[float, ...] = ()) -> "Mast":
        """The mast of a column in so many elements, with nodes at the marks."""
        return _mast(column, count, marks)

    @cached_property
    def flexibility(self) -> FloatArray:
        """K^-1."""
        result: FloatArray = self._factor.T @ self._factor
        return result

    def at(self, place: float) -> FloatArray:
        """The modes at a place, shape (k,)."""
        return np.asarray(self.elements.row(place) @ self.shapes)

    def gives(self, place: float, beside: float) -> float:
        """Deflection at a place by a force of 1 N at another [m/N]."""
        return float(self.elements.row(place) @ self.flexibility @ self.elements.row(beside))

    def rolling(self, base: float) -> tuple[FloatArray, FloatArray]:
        """Frequencies over a base of that mass that rolls, and the shapes beside it, normalised with it."""
        built = self.elements
        if not base > 0:
            raise NumericsError("NUM102", "a base that rolls has a mass above 0")
        if base not in self._rolling:
            free = built.mass - np.outer(built.carried, built.carried) / (built.total + base)
            self._rolling[base] = _modes(self._factor, free)
        return self._rolling[base]


@lru_cache(maxsize=64)
def _mast(column: Column, count: int, marks: tuple[float, ...]) -> Mast:
    """Criteria, bounds, costs and runs of a scene ask for the same few masts again and again."""
    return Mast(elements(column, count, marks))


def _factor(stiffness: FloatArray) -> FloatArray:
    """F with F^T F = K^-1."""
    diagonal = np.diag(stiffness)
    if not (diagonal > 0).all():
        raise NumericsError("NUM102", _NO_STIFFNESS)
    size = 1 / np.sqrt(diagonal)
    try:
        lower = np.linalg.cholesky(stiffness * size * size[:, None])
    except np.linalg.LinAlgError:
        raise NumericsError("NUM102", _NO_STIFFNESS) from None
    return np.asarray(np.linalg.inv(lower) * size)


def _modes(factor: FloatArray, mass: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Frequencies, rising, and shapes p with p^T M p = 1."""
    squares, turned = np.linalg.eigh(factor @ mass @ factor.T)
    squares, turned = squares[::-1], turned[:, ::-1]
    count = int((squares > MASSLESS * squares[0]).sum()) if squares[0] > 0 else 0
    if not count:
        raise NumericsError("NUM102", "a massless mast does not vibrate")
    roots = np.sqrt(squares[:count])
    found = 1 / roots, (factor.T @ turned[:, :count]) / roots
    for one in found:
        one.setflags(write=False)
    return found


@dataclass(frozen=True, slots=True)
class Frequencies:
    """The lowest frequencies of a column and how far each may be off [rad/s], shape (k,): they are never too low by
    more than rounding."""

    values: FloatArray
    bars: FloatArray


def frequencies(column: Column, number: int, base: float = math.inf, count: int = 16) -> Frequencies:
    """The lowest frequencies of a column, on a base that is held or that rolls.

    Args:
        column: the column.
        number: how many are wanted; fewer are given where the column has no more.
        base: mass of a base that rolls; infinite for one that is held [kg].
        count: elements.

    **Error** told: the elements are conforming, so a frequency is too high, by about 1/15 of what half as many elements
    change it; the bar is the whole of that change, and rounding, which grows as the fourth power of their number.
    **Source** module docstring; Rayleigh's principle.
    """
    fine, coarse = (_lowest(column, one, base) for one in (_COARSE * count, count))
    number = min(number, len(fine), len(coarse))
    values = fine[:number]
    bars = _BAR * np.abs(coarse[:number] - values) + _ROUNDING * (_COARSE * count) ** 4 * values
    return Frequencies(values, np.asarray(bars))


def _lowest(column: Column, count: int, base: float) -> FloatArray:
    mast = Mast.of(column, count)
    return mast.frequencies if math.isinf(base) else mast.rolling(base)[0]


def wanted(values: FloatArray, rise: float) -> int:
    """How many modes a load that rises in some time [s] asks for: those up to 5/rise in Hz, and 2 at least.

    **Source** theory of the house, mast recipe: modes far above the load's own time follow it at once.
    """
    if rise <= 0:
        return len(values)
    return min(max(int((values <= 2 * math.pi * _RISE_PERIODS / rise).sum()), FEWEST), len(values))


def left_out(mast: Mast, base: float, place: float, kept: int, rise: float, force: float) -> float:
    """Bound of what modes that are taken to follow at once could still add to the deflection at a place [m].

        sum_(k > kept) |g_k| F s_k,   g_k = p_k(place) p_k^T M 1/(m w_k^2),   s_k = min(1, 2/(w_k rise))

    for a force F on a base that rolls, from 0 to its size in the time `rise` in a straight line; with an infinite
    base F is the acceleration of the base, g_k = p_k(place) L_k/w_k^2. A mode strays from what it would follow by no
    more than its share of the jump, or of the two kinks of the rise over its frequency; damping makes it less.
    """
    values, pushed, shapes = _set_off(mast, base)
    gains = (mast.elements.row(place) @ shapes) * pushed / values**2
    return _strays(gains, values, kept, rise) * abs(force)


def moment_left_out(mast: Mast, base: float, kept: int, rise: float, force: float) -> float:
    """Bound of what modes that are taken to follow at once could still add to the moment at the root [N m].

        sum_(k > kept) |h_k| F s_k,   h_k = (t^T M - t^T K_w/w_k^2) p_k p_k^T M 1/m   (less (t^T M 1/m) p_k^T M 1)

    for the inertia forces of a mode on their arms t and for what weights and props K_w do against it, in brackets
    beside a base that rolls; otherwise as `left_out`.
    """
    values, pushed, shapes = _set_off(mast, base)
    turned = mast.elements.turned @ shapes - (mast.elements.righted @ shapes) / values**2
    if math.isfinite(base):
        turned = turned - mast.elements.moment / (mast.elements.total + base) * (mast.elements.carried @ shapes)
    return _strays(turned * pushed, values, kept, rise) * abs(force)


def speed_left_out(mast: Mast, base: float, kept: int, rise: float, force: float) -> float:
    """Bound of what the same modes could still add to the speed of a base that rolls [m/s].

        F/m^2 sum_(k > kept) L_k^2/w_k s_k,   s_k as in `left_out`

    as m x'' = F - sum L_k q_k'' and q_k'' = -(L_k F/m) cos(w_k t) under a force F that comes at once.
    """
    values, pushed, _ = _set_off(mast, base)
    return _strays(pushed**2 / values, values, kept, rise) * abs(force)


def _set_off(mast: Mast, base: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Frequencies, what each mode gets of an acceleration of a held base or of a force on one that rolls, shapes."""
    if math.isinf(base):
        return mast.frequencies, mast.participation, mast.shapes
    values, shapes = mast.rolling(base)
    return values, np.asarray(mast.elements.carried @ shapes / (mast.elements.total + base)), shapes


def _strays(gains: FloatArray, values: FloatArray, kept: int, rise: float) -> float:
    """Sum of what modes beyond those kept may stray by, by their gains and the time in which it comes up."""
    strays = np.minimum(1.0, 2 / (values * rise)) if rise > 0 else np.ones(len(values))
    return float(np.abs(gains[kept:]) @ strays[kept:])
