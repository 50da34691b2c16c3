"""Chebyshev panels: a smooth function over a stretch of time as the polynomial through its values at nodes."""

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

COUNT = 14
"""Nodes of a panel, both ends among them."""
_DENSE = 4 * COUNT


def _nodes() -> FloatArray:
    return np.asarray((1 - np.cos(np.pi * np.arange(COUNT) / (COUNT - 1))) / 2)


NODES = _nodes()
"""On [0, 1]."""
_WEIGHTS = np.where((np.arange(COUNT) == 0) | (np.arange(COUNT) == COUNT - 1), 0.5, 1.0) * (-1.0) ** np.arange(COUNT)


def to(places: FloatArray) -> FloatArray:
    """Matrix from node values to values at places in [0, 1], shape (places, nodes)."""
    apart = np.asarray(places, float)[:, None] - NODES
    on = apart == 0
    rows = on.any(axis=1)
    weights = _WEIGHTS / np.where(on, 1.0, apart)
    found = weights / weights.sum(axis=1, keepdims=True)
    found[rows] = on[rows]
    return np.asarray(found)


_VANDER = np.polynomial.chebyshev.chebvander(2 * NODES - 1, COUNT - 1)
TO_SERIES = np.asarray(np.linalg.inv(_VANDER))
"""Chebyshev coefficients from node values."""


def _integral() -> FloatArray:
    columns = []
    for k in range(COUNT):
        series = np.polynomial.chebyshev.chebint(np.eye(COUNT)[k], lbnd=-1) / 2
        columns.append(np.polynomial.chebyshev.chebval(2 * NODES - 1, series))
    return np.asarray(np.stack(columns, axis=1) @ TO_SERIES)


INTEGRAL = _integral()
"""Integrals from 0 to each node from node values."""
PLACES = np.linspace(0.0, 1.0, _DENSE + 1)
DENSE = to(PLACES)
"""To places spread evenly, among which extremes and roots are looked for."""


def tail(values: FloatArray) -> FloatArray:
    """Size of the last two Chebyshev coefficients of node values, shape (nodes, ...)."""
    return np.asarray(np.abs(TO_SERIES[-2:] @ values.reshape(COUNT, -1)).max(axis=0))


def root(values: FloatArray, low: float, high: float) -> float:
    """Where the polynomial through node values falls through 0 between two places, by bisection and secants."""
    first, last = (float((to(np.array([x])) @ values)[0]) for x in (low, high))
    if first <= 0:
        return low
    for _ in range(60):
        x = low + (high - low) * min(max(first / (first - last), 0.05), 0.95)
        value = float((to(np.array([x])) @ values)[0])
        if value > 0:
            low, first = x, value
        else:
            high, last = x, value
        if high - low <= 4e-16 * max(high, 1e-3) or last == 0:
            break
    return high


def largest(values: FloatArray) -> tuple[float, int, float]:
    """Largest value of signals of panels, shape (panels, nodes): (value, panel, place in it)."""
    dense = values @ DENSE.T
    panel, index = divmod(int(dense.argmax()), dense.shape[1])
    low, high = PLACES[max(index - 1, 0)], PLACES[min(index + 1, len(PLACES) - 1)]
    best, place = float(dense[panel, index]), float(PLACES[index])
    for _ in range(6):
        fine = np.linspace(low, high, 21)
        course = to(fine) @ values[panel]
        top = int(course.argmax())
        if course[top] > best:
            best, place = float(course[top]), float(fine[top])
        low, high = fine[max(top - 1, 0)], fine[min(top + 1, 20)]
    return best, panel, place
