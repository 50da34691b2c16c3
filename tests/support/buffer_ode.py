"""What runs onto buffers, by its equation of motion along the way: numbers and scipy alone."""

import math
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp

SLOW = 0.01
"""Of the speed at the buffer, at which an orifice counts as having stopped what hit it."""
TOLERANCE = 1e-11
FARTHEST = 1e4
"""Strokes that are followed; but one through an orifice that the push keeps faster than that."""


@dataclass(frozen=True)
class Cushion:
    """All buffers of one end together: the type, its number, and the stroke."""

    kind: str
    hardness: float
    stroke: float
    power: float = 2.0

    def force(self, way: float, square: float) -> float:
        """When pressed in so far, with such a square of the speed [N]."""
        if self.kind == "linear":
            return self.hardness * way
        if self.kind == "progressive":
            return float(self.hardness * (way / self.stroke) ** self.power)
        return self.hardness if self.kind == "constant" else self.hardness * square


@dataclass(frozen=True)
class Hit:
    """Largest force on the way that is there [N], way that is needed [m], speed left at the end of the stroke [m/s]."""

    force: float
    way: float
    left: float


def hit(cushion: Cushion, mass: float, speed: float, push: float) -> Hit:
    """A mass with a push behind it: d(v^2)/du = 2 (P - F)/m. The force is infinite at the stop behind the buffers."""
    slow = (SLOW * speed if cushion.kind == "hydraulic" else 0.0) ** 2

    def slows(way: float, square: np.ndarray) -> list[float]:
        return [2 * (push - cushion.force(way, float(square[0]))) / mass]

    def stands(way: float, square: np.ndarray) -> float:
        return float(square[0]) - slow

    stands.terminal, stands.direction = True, -1  # type: ignore[attr-defined]
    never = cushion.kind == "hydraulic" and push >= cushion.hardness * slow
    followed = (0.0, (1.0 if never else FARTHEST) * cushion.stroke)
    done = solve_ivp(
        slows, followed, [speed**2], method="DOP853", events=stands, dense_output=True, rtol=TOLERANCE,
        atol=TOLERANCE * speed**2,
    )  # fmt: skip
    way = float(done.t_events[0][0]) if len(done.t_events[0]) else math.inf
    if way <= cushion.stroke:
        return Hit(cushion.force(way, 0.0) if cushion.kind != "hydraulic" else cushion.force(0.0, speed**2), way, 0.0)
    return Hit(math.inf, way, math.sqrt(float(done.sol(cushion.stroke)[0])))


def meeting(cushion: Cushion, masses: tuple[float, float], speeds: tuple[float, float], push: float) -> Hit:
    """Two that run at each other, with equal buffers between them and equal pushes: each buffer takes half of what they
    come together by, u'' = (P - F)(1/m_1 + 1/m_2)/2."""
    one, other = masses
    return hit(cushion, 2 / (1 / one + 1 / other), sum(speeds) / 2, push)
