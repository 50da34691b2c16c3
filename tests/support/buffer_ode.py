"""What runs onto buffers, by its equation of motion: numbers and scipy alone."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp

SLOW = 0.01
"""Of the speed at the buffer, at which an orifice counts as having stopped what hit it."""
TOLERANCE = 1e-11


@dataclass(frozen=True)
class Cushion:
    """All buffers of one end together: the type, its number, and the stroke."""

    kind: str
    hardness: float
    stroke: float
    power: float = 2.0

    def force(self, way: float, speed: float) -> float:
        """When pressed in so far, so fast [N]."""
        way = max(way, 0.0)
        if self.kind == "linear":
            return self.hardness * way
        if self.kind == "progressive":
            return self.hardness * (way / self.stroke) ** self.power
        return self.hardness if self.kind == "constant" else self.hardness * speed * abs(speed)


@dataclass(frozen=True)
class Hit:
    """Largest force on the way that is there [N], way that is needed [m], speed left at the end of the stroke [m/s]."""

    force: float
    way: float
    left: float


def hit(cushion: Cushion, mass: float, speed: float, push: float) -> Hit:
    """A mass with a push behind it; the force is infinite where it comes to the stop behind the buffers."""

    def motion(_: float, state: np.ndarray) -> list[float]:
        return [state[1], (push - cushion.force(state[0], state[1])) / mass]

    return _followed(motion, cushion, speed, mass)


def meeting(cushion: Cushion, masses: tuple[float, float], speeds: tuple[float, float], push: float) -> Hit:
    """Two that run at each other, with equal buffers between them and equal pushes: way and speed of one buffer."""
    one, other = masses

    def motion(_: float, state: np.ndarray) -> list[float]:
        force = cushion.force(state[0], state[1])
        return [state[1], ((push - force) / one + (push - force) / other) / 2]

    return _followed(motion, cushion, sum(speeds) / 2, 2 * one * other / (one + other))


def _followed(motion: Callable[[float, np.ndarray], list[float]], cushion: Cushion, speed: float, mass: float) -> Hit:
    slow = SLOW * speed if cushion.kind == "hydraulic" else 0.0

    def stands(_: float, state: np.ndarray) -> float:
        return float(state[1]) - slow

    def ends(_: float, state: np.ndarray) -> float:
        return float(state[0]) - cushion.stroke

    stands.terminal, stands.direction = True, -1  # type: ignore[attr-defined]
    scale = cushion.stroke / speed
    done = solve_ivp(
        motion, (0.0, 1e4 * scale), [0.0, speed], method="DOP853", events=[stands, ends], rtol=TOLERANCE,
        atol=[TOLERANCE * cushion.stroke, TOLERANCE * speed], max_step=50 * scale,
    )  # fmt: skip
    way = float(done.y_events[0][0][0]) if len(done.y_events[0]) else math.inf
    if cushion.kind == "hydraulic":
        left = float(done.y_events[1][0][1]) if len(done.y_events[1]) else 0.0
        force = cushion.hardness * max(speed, left) ** 2
        return Hit(math.inf if left else force, way, left)
    if way <= cushion.stroke:
        return Hit(cushion.force(way, 0.0), way, 0.0)
    return Hit(math.inf, way, float(done.y_events[1][0][1]))
