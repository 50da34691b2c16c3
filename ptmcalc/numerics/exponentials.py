"""Divided differences of exp over times: what an oscillator makes of exponential forces, without cancellation.

exp[z_0, ..., z_n] is a quotient of two differences of lower order where its points lie farther apart than 1, and a
power series about their mean where they do not. Of the two points whose conjugates exist, 0 and 1, only sets with the
first are computed; the others are their conjugates. What does not depend on the times is kept for the next call. Where
all points lie farther apart than 1, the whole is a sum of exponentials (`superposed`).
"""

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Values = NDArray[Any]
"""Real or complex numbers."""
Set = tuple[int, ...]
"""Indices of points, rising."""

_TERMS = 18
"""Of a series about the mean of points within 1 of each other, |offset| <= 3/4: (3/4)^18/18! is below rounding."""
_ONES = np.ones((_TERMS, 1))
_KEPT = 64
FEW = 256
"""Times below which a table of exponentials would save nothing."""
_UNEVEN = 2 * float(np.finfo(float).eps)
"""Share of the last time by which evenly spaced times may be off."""


@dataclass(frozen=True, slots=True)
class _Node:
    """A difference: `halves` are the sets whose quotient it is and whether they are conjugates, `apart` the distance
    of the points they lack, `factors` those of its series in `radius` t about `centre`."""

    chosen: Set
    real: bool
    width: float
    halves: tuple[tuple[Set, bool], ...]
    apart: complex
    centre: complex
    radius: float
    factors: Values


def differences(points: tuple[complex, ...], wanted: tuple[Set, ...], t: FloatArray) -> list[Values]:
    """exp[z_i t for i in a set] for each of the wanted sets.

    Args:
        points: z; the first two may be conjugates of each other, the others are real [1/s].
        wanted: sets of indices, of one point or more.
        t: rising, not below 0, shape (n,) [s].

    Returns:
        a difference for each set, shape (n,); real where the conjugates of its points are in the set.

    **Error** rounding: a quotient loses no more than a digit, its points being apart.
    **Source** Hermite, Genocchi; module docstring.
    """
    nodes = _tree(points, wanted)
    count = len(t)
    start = dict.fromkeys((node.chosen for node in nodes), count)
    for one in wanted:
        start[_key(points, one)[0]] = 0
    turns = []
    for node in nodes:  # larger sets come first
        begin = start[node.chosen]
        near = int(t.searchsorted(1 / node.width, "right")) if node.width > 0 else count
        turn = max(near, begin)
        turns.append(turn)
        if turn < count:
            for half, _ in node.halves:
                start[half] = min(start[half], turn)
    values: dict[Set, Values] = {}
    for node, turn in zip(reversed(nodes), reversed(turns), strict=True):
        begin = start[node.chosen]
        if begin == count > 0:
            continue
        found = np.empty(count, float if node.real else complex)
        if begin < turn:
            found[begin:turn] = _series(node, t[begin:turn])
        if turn < count:
            found[turn:] = _quotient(node, values, t, turn)
        values[node.chosen] = found
    return [_value(values, *_key(points, one), 0) for one in wanted]


def superposed(rates: tuple[complex, ...], weights: Values, t: FloatArray) -> FloatArray:
    """Real parts of sums of exponentials at rising times; a product of two tables where they are evenly spaced.

        x_i = Re sum_k w_ik exp(z_k t),   exp(z (t_b + s)) = exp(z t_b) exp(z s)

    so that of n evenly spaced times 2 n^(1/2) have exponentials of their own.

    Args:
        rates: z, not growing [1/s].
        weights: w, shape (m, rates).
        t: rising, not below 0, shape (n,) [s].

    Returns:
        x, shape (m, n).

    **Error** rounding: the spacing may miss a time by 2 eps t, what rounding leaves of times made evenly, or every time
    has exponentials of its own.
    """
    count, z = len(t), np.array(rates)
    if count >= FEW:
        width = 1 << ((count - 1).bit_length() + 1) // 2
        blocks, inside = t[::width], np.arange(width) * ((t[-1] - t[0]) / (count - 1))
        missed = np.add.outer(blocks, inside).ravel()[:count]
        missed -= t
        if np.abs(missed, out=missed).max() <= _UNEVEN * t[-1]:
            ahead = weights.conj()[:, None] * np.exp(np.multiply.outer(blocks, z.conj()))
            beside = np.exp(np.multiply.outer(inside, z))  # Re(a b) is the product of the parts of a* and of b
            table = ahead.view(float).reshape(-1, 2 * len(z)) @ beside.view(float).T
            return np.asarray(table.reshape(len(weights), -1)[:, :count])
    return np.asarray((weights @ np.exp(np.multiply.outer(z, t))).real)


def _quotient(node: _Node, values: dict[Set, Values], t: FloatArray, turn: int) -> Values:
    (first, mirrored), (second, other) = node.halves
    one = _value(values, first, mirrored, turn)
    if first == second:  # a number and its conjugate: their difference is imaginary
        return np.asarray(2 * one.imag / (node.apart.imag * t[turn:]))
    apart = node.apart.real if node.apart.imag == 0 else node.apart
    quotient = (one - _value(values, second, other, turn)) / apart
    return np.asarray((quotient.real if node.real else quotient) / t[turn:])


def _value(values: dict[Set, Values], key: Set, mirrored: bool, begin: int) -> Values:
    found = values[key][begin:]
    return np.conj(found) if mirrored else found


def _series(node: _Node, t: FloatArray) -> Values:
    """exp(c t) sum h_k t^k/(k + n)!, h_k the complete symmetric sums of the points about their mean c."""
    if len(node.chosen) == 1:
        return np.asarray(np.exp(node.centre.real * t) if node.real else np.exp(node.centre * t))
    powers = np.multiply.accumulate(_ONES * (node.radius * t))
    factors = node.factors
    total: Values = factors[0].real + factors[1:].real @ powers
    if node.real:
        return np.asarray(np.exp(node.centre.real * t) * total)
    return np.asarray(np.exp(node.centre * t) * (total + 1j * (factors[0].imag + factors[1:].imag @ powers)))


# --- what does not depend on the times ----------------------------------------------------------------------------


@lru_cache(maxsize=_KEPT)
def _tree(points: tuple[complex, ...], wanted: tuple[Set, ...]) -> tuple[_Node, ...]:
    """All differences that the wanted ones may need, the larger sets first."""
    nodes: dict[Set, _Node] = {}
    waiting = [_key(points, one)[0] for one in wanted]
    while waiting:
        chosen = waiting.pop()
        if chosen not in nodes:
            nodes[chosen] = node = _node(points, chosen)
            waiting += [half for half, _ in node.halves]
    return tuple(sorted(nodes.values(), key=lambda node: -len(node.chosen)))


def _key(points: tuple[complex, ...], chosen: Set) -> tuple[Set, bool]:
    """The set that stands for a set and its conjugate, and whether the set is that conjugate."""
    if _is_real(points, chosen) or 0 in chosen:
        return chosen, False
    return (0, *(i for i in chosen if i != 1)), True


def _is_real(points: tuple[complex, ...], chosen: Set) -> bool:
    """Whether the conjugates of the points of a set are in it."""
    return points[0].imag == 0 or (0 in chosen) == (1 in chosen)


def _node(points: tuple[complex, ...], chosen: Set) -> _Node:
    real, order = _is_real(points, chosen), len(chosen) - 1
    centre = sum(points[i] for i in chosen) / len(chosen)
    if order == 0:
        return _Node(chosen, real, 0.0, (), 0j, centre, 1.0, np.ones(1))
    width, i, j = max((abs(points[i] - points[j]), i, j) for i in chosen for j in chosen if j < i)
    halves = tuple(_key(points, tuple(s for s in chosen if s != left_out)) for left_out in (j, i)) if width > 0 else ()
    radius = max(abs(points[i] - centre) for i in chosen) or 1.0
    sums = [1.0 + 0j] + [0j] * _TERMS
    for one in chosen:
        offset = (points[one] - centre) / radius
        for k in range(1, _TERMS + 1):
            sums[k] += offset * sums[k - 1]
    factorials = np.array([float(math.factorial(k + order)) for k in range(_TERMS + 1)])
    factors = np.array(sums) / factorials
    return _Node(chosen, real, width, halves, points[i] - points[j], centre, radius, factors)
