"""A column on a base that a force brings to rest and then holds, by matrices, modes and roots of SciPy: a reference."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh
from scipy.optimize import brentq

from support.beams import masted

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Stopped:
    """Largest deflection of the load beside the base, and when the base stood."""

    deflection: float
    time: float


def stopped(one: Any, force: float, speed: float, elements: int) -> Stopped:
    """Without damping, by beam elements."""
    k, m, base, load = masted(one, elements)
    assert base is not None
    return stop(k, m, base, load, force, speed)


def stop(k: FloatArray, m: FloatArray, base: int, load: int, force: float, speed: float) -> Stopped:
    """Of any stiffness and mass: modes while it rolls, modes while it is held."""
    size = len(k)
    squares, shapes = eigh(k, m)
    w = np.sqrt(np.maximum(squares, 0))
    rigid = w < 1e-5 * w[1]
    start = _rolling(k)
    pushed = -force * shapes[base]
    rates = shapes.T @ m @ (start * speed)
    soft = np.where(rigid, 1.0, w)

    def states(times: FloatArray) -> tuple[FloatArray, FloatArray]:
        t, rolls, pace = np.atleast_1d(times), rigid[:, None], soft[:, None]
        turn = w[:, None] * t
        way = np.where(rolls, t**2 / 2, (1 - np.cos(turn)) / pace**2)
        rate = np.where(rolls, t, np.sin(turn) / pace)
        own = rates[:, None] * rate
        moved = rates[:, None] * np.where(rolls, 1.0, np.cos(turn))
        return shapes @ (pushed[:, None] * way + own), shapes @ (pushed[:, None] * rate + moved)

    def pace_of_base(t: float) -> float:
        return float(states(np.array([t]))[1][base, 0])

    times = np.linspace(0, 3 * speed * float(start @ m @ start) / force, 20001)
    first = int(np.argmax(states(times)[1][base] <= 0))
    end = float(brentq(pace_of_base, times[first - 1], times[first], xtol=1e-13))
    ways = states(np.linspace(0, end, 20001))[0]
    before = float(np.abs(ways[load] - ways[base]).max())
    u, v = (part[:, 0] for part in states(np.array([end])))
    keep = [i for i in range(size) if i != base]
    held_k, held_m = k[np.ix_(keep, keep)], m[np.ix_(keep, keep)]
    squares, forms = eigh(held_k, held_m)
    pace = np.sqrt(squares)
    at, going = forms.T @ held_m @ (u - start * u[base])[keep], forms.T @ held_m @ v[keep]
    row = forms[keep.index(load)]
    grid = np.linspace(0, 6 * 2 * np.pi / pace[0], 20001)
    swings = at[:, None] * np.cos(np.outer(pace, grid)) + (going / pace)[:, None] * np.sin(np.outer(pace, grid))
    after = float(np.abs(row @ swings).max())
    return Stopped(max(before, after), end)


def _rolling(k: FloatArray) -> FloatArray:
    """The motion that strains nothing."""
    _, vectors = np.linalg.eigh(k)
    rigid = vectors[:, 0]
    return np.asarray(rigid / rigid[0])
