"""Panels: short stretches of time on which a smooth signal is the polynomial through nine Gauss-Lobatto nodes.

The same nodes carry the work integrals (exact to degree 15), the search for roots and the search for peaks, so no
event, peak or joule is read from samples.
"""

import math

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def lobatto(count: int) -> tuple[FloatArray, FloatArray]:
    """Gauss-Lobatto nodes on [0, 1], both ends among them, and their weights."""
    inner = np.polynomial.legendre.Legendre.basis(count - 1).deriv().roots()
    nodes = np.concatenate([[-1.0], np.sort(inner.real), [1.0]])
    nodes = (nodes - nodes[::-1]) / 2  # rounding leaves them symmetric
    heights = np.polynomial.legendre.Legendre.basis(count - 1)(nodes)
    return (nodes + 1) / 2, 1 / (count * (count - 1) * heights**2)


COUNT = 9
NODES, WEIGHTS = lobatto(COUNT)
TO_CHEBYSHEV = np.linalg.inv(np.polynomial.chebyshev.chebvander(2 * NODES - 1, COUNT - 1))
"""Chebyshev coefficients from node values."""
_DERIVATIVE = np.zeros((COUNT, COUNT))
_DERIVATIVE[:-1] = np.polynomial.chebyshev.chebder(np.eye(COUNT), scl=2.0)
SLOPES = np.polynomial.chebyshev.chebvander(2 * NODES - 1, COUNT - 1) @ _DERIVATIVE @ TO_CHEBYSHEV
"""Derivatives at the nodes from node values, per panel."""
_BINOMIALS = np.array([math.comb(COUNT - 1, k) for k in range(COUNT)], dtype=float)
TO_BERNSTEIN = np.linalg.inv(
    _BINOMIALS * NODES[:, None] ** np.arange(COUNT) * (1 - NODES[:, None]) ** np.arange(COUNT)[::-1]
)
"""Bernstein coefficients from node values: where none is negative, the polynomial is not."""
_PLACES = NODES.tolist()
_HALVES = (np.diff(NODES) / 2).tolist()
_FINE = np.linspace(0.0, 1.0, 33)
_ON_FINE = np.polynomial.chebyshev.chebvander(2 * _FINE - 1, COUNT - 1) @ TO_CHEBYSHEV
_ORDERS = np.arange(COUNT)
_MOST_STEPS = 100
_UNSURE = 1e-11
"""Depth of a dip, as a share of the largest node, that the polynomial does not show reliably."""
_MOST_HALVINGS = 48


def at(coefficients: list[float], place: float) -> float:
    """The polynomial of these Chebyshev coefficients at a place in [0, 1] (Clenshaw)."""
    x = 2 * (2 * place - 1)
    b0 = b1 = 0.0
    for c in coefficients[:0:-1]:
        b0, b1 = c + x * b0 - b1, b0
    return coefficients[0] + x / 2 * b0 - b1


def crossing(nodes: FloatArray, noise: float) -> float | None:
    """Where the polynomial through the nodes first goes below 0 by more than noise, or None.

    Between the nodes where its sign changes, and at every dip between nodes that could reach 0 and come back.
    """
    values, slopes, places = nodes.tolist(), (SLOPES @ nodes).tolist(), _PLACES
    for i, half in enumerate(_HALVES):
        if values[i + 1] < -noise:
            left = places[i]
            if values[i] <= noise:  # from 0 up and back: the root is behind the summit
                left = above(nodes, left, places[i + 1])
            return root(nodes, left, places[i + 1])
        falling, rising = slopes[i], slopes[i + 1]
        if falling < 0 < rising and min(values[i], values[i + 1]) < half * max(-falling, rising):
            lowest, place = dip(nodes, places[i], places[i + 1])
            if lowest < -noise - _UNSURE * max(map(abs, values)):
                return root(nodes, places[i], place)
    return None


def root(nodes: FloatArray, left: float, right: float) -> float:
    """The first place after `left` where the polynomial through the nodes is no longer above 0, by false position
    (Illinois); `left` if it is not above 0 there, `right` if it is still above 0 there.

    **Error** rounding of the polynomial: about 1e-15 of the largest node over its slope.
    """
    return _first_root((TO_CHEBYSHEV @ nodes).tolist(), left, right)


def _first_root(coefficients: list[float], left: float, right: float) -> float:
    above, below = at(coefficients, left), at(coefficients, right)
    largest = sum(map(abs, coefficients))
    if above <= 0:
        return left
    if below > 0:
        return right
    side = 0
    for _ in range(_MOST_STEPS):
        middle = right - below * (right - left) / (below - above)
        if not left < middle < right or abs(middle - left) < 1e-16:
            middle = (left + right) / 2
        found = at(coefficients, middle)
        if found > 0:
            left, above = middle, found
            below = below / 2 if side > 0 else below
            side = 1
        else:
            right, below = middle, found
            above = above / 2 if side < 0 else above
            side = -1
        if right - left <= 4e-16 or abs(found) <= 4e-17 * largest:
            return middle
    return right


def above(nodes: FloatArray, left: float, right: float) -> float:
    """A place between two places where the polynomial through the nodes is above 0, as far right as halving finds one;
    `left` where there is none.

    A signal that starts at 0 and goes up and back stays above 0 over most of the way to its root.
    """
    coefficients = (TO_CHEBYSHEV @ nodes).tolist()
    reach = right - left
    for _ in range(_MOST_HALVINGS):
        reach /= 2
        if at(coefficients, left + reach) > 0:
            return left + reach
    return left


def dip(nodes: FloatArray, left: float, right: float) -> tuple[float, float]:
    """Value and place of the minimum of the polynomial through the nodes between two places, at the first of which it
    falls and at the second rises: the root of its derivative."""
    coefficients = TO_CHEBYSHEV @ nodes
    place = _first_root((-_DERIVATIVE @ coefficients).tolist(), left, right)
    return at(coefficients.tolist(), place), place


def highest(nodes: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Largest values of polynomials over a panel, and the places.

        p'(x) = 0 by Newton's method from the largest of 33 values, kept between its neighbours

    Args:
        nodes: node values, shape (signals, nodes).

    Returns:
        (values, places), shape (signals,) each.

    **Error** 2e-14 of the largest node; a peak narrower than a thirtieth of a panel is not one of degree 8.
    """
    coefficients = nodes @ TO_CHEBYSHEV.T
    sampled = nodes @ _ON_FINE.T
    best = sampled.max(axis=1)
    where = _FINE[sampled.argmax(axis=1)]
    low, high = np.maximum(where - _FINE[1], 0.0), np.minimum(where + _FINE[1], 1.0)
    place = where
    for _ in range(3):
        slope, bend = _slopes(coefficients, place)
        with np.errstate(divide="ignore", invalid="ignore"):
            moved = place - slope / bend
        place = np.where((bend < 0) & np.isfinite(moved), np.clip(moved, low, high), place)
    return _better(coefficients, place, best, where)


def _better(
    coefficients: FloatArray, place: FloatArray, best: FloatArray, where: FloatArray
) -> tuple[FloatArray, FloatArray]:
    found = _values(coefficients, place)
    return np.maximum(found, best), np.where(found > best, place, where)


def _values(coefficients: FloatArray, place: FloatArray) -> FloatArray:
    angle = np.arccos(np.clip(2 * place - 1, -1, 1))
    result: FloatArray = (coefficients * np.cos(angle[:, None] * _ORDERS)).sum(axis=1)
    return result


def _slopes(coefficients: FloatArray, place: FloatArray) -> tuple[FloatArray, FloatArray]:
    """First and second derivative."""
    first = coefficients @ _DERIVATIVE.T
    return _values(first, place), _values(first @ _DERIVATIVE.T, place)
