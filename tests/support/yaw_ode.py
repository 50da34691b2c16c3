"""A crane on the buffers of both rails, free to turn, with a load on its ropes: followed over time by scipy."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from support.buffer_ode import SLOW, Cushion, Hit

Part = tuple[float, float, float]
"""Mass, place over the span, and square of the radius of gyration over that of the span."""
_FADES = 1e-3
"""Share of the speed below which a constant force gives way, as the force of friction does."""


def turned(
    cushion: Cushion, parts: Sequence[Part], pushes: tuple[float, float], load: tuple[float, float, float], speed: float
) -> tuple[Hit, float]:
    """The harder pressed rail, and the largest deceleration; `load` is its mass, place and square of its frequency.

    The hardness of the cushion is that of both rails together.
    """
    mass = np.zeros((2, 2))
    for m, x, spread in parts:
        mass += m * (np.outer([1 - x, x], [1 - x, x]) + spread * np.array([[1, -1], [-1, 1]]))
    inverse, share = np.linalg.inv(mass), np.array([1 - load[1], load[1]])
    slow = SLOW * speed if cushion.kind == "hydraulic" else _FADES * speed if cushion.kind == "constant" else 0.0

    def of_rail(way: float, rate: float) -> float:
        if way <= 0 or (rate <= 0 and cushion.kind in ("hydraulic", "constant")):
            return 0.0
        fades = min(rate / (_FADES * speed), 1.0) if cushion.kind == "constant" else 1.0
        return fades * cushion.force(way, rate**2) / 2

    (per_00, per_01), (per_10, per_11) = inverse.tolist()
    share_0, share_1 = share.tolist()
    hangs, swings = load[0], load[2]

    def rates(t: float, y: Any) -> Any:
        y_0, y_1, y_2, v_0, v_1, v_2 = y.tolist()  # plain numbers: the arrays would take most of the time
        lean = swings * (y_2 - share_0 * y_0 - share_1 * y_1)
        force_0 = pushes[0] + share_0 * hangs * lean - of_rail(y_0, v_0)
        force_1 = pushes[1] + share_1 * hangs * lean - of_rail(y_1, v_1)
        return v_0, v_1, v_2, per_00 * force_0 + per_01 * force_1, per_10 * force_0 + per_11 * force_1, -lean

    def stands(t: float, y: Any) -> float:
        return float(max(y[3], y[4])) - slow

    stands.terminal, stands.direction = True, -1  # type: ignore[attr-defined]
    done: Any = solve_ivp(
        rates, (0.0, 1e4), [0.0] * 3 + [speed] * 3, rtol=1e-9, atol=1e-11, events=stands, dense_output=True,
        method="DOP853", max_step=cushion.stroke / (300 * speed),
    )  # fmt: skip
    end = float(done.t[-1])
    times = np.concatenate([np.geomspace(1e-9, 1e-3, 200) * end, np.linspace(1e-3, 1.0, 4001) * end])
    looks = done.sol(times)
    tops = looks[:2].max(axis=1)
    side = int(tops[1] > tops[0])
    brakes = max(-min(rates(t, look)[3:5]) for t, look in zip(times, looks.T, strict=True))
    way = float(tops[side])
    if way > cushion.stroke:
        first = int(np.argmax(looks[side] > cushion.stroke))
        left = float(
            np.interp(cushion.stroke, looks[side, first - 1 : first + 1], looks[side + 3, first - 1 : first + 1])
        )
        return Hit(math.inf, way, left), math.inf
    if cushion.kind == "hydraulic":
        return Hit(cushion.force(0.0, speed**2), way, 0.0), float(brakes)
    return Hit(cushion.force(way, 0.0), way, 0.0), float(brakes)
