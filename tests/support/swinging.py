"""A load on a rope under a pivot, by scipy's DOP853 in Cartesian coordinates of space: the constraint as a force.

Written anew from Newton's laws for a point mass and a rigid body on an axis; it shares nothing with the project.
The rope's force is found from the second derivative of |x - S|^2 = L^2; the pivot's way S(s, t) comes with its
derivatives. Lengths and radii are given with their rates at any time.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp

Array = np.ndarray
Way = Callable[[float], tuple[float, float, float]]
"""Value, rate and second rate of a quantity over time."""


def still(value: float) -> Way:
    return lambda t: (value, 0.0, 0.0)


@dataclass
class Hanging:
    """`force(t, s, v)` on the axis, or `imposed(t)`: its acceleration. `radius` None is a rail. Gravity leans by `tilt`
    from the axis of a jib, towards the direction `downhill`."""

    gravity: float
    mass: float
    inertia: float
    length: Way
    radius: Way | None = None
    force: Callable[[float, float, float], float] = lambda t, s, v: 0.0
    imposed: Callable[[float], float] | None = None
    tilt: float = 0.0
    downhill: float = 0.0

    @property
    def weight(self) -> Array:
        flat = self.gravity * math.sin(self.tilt)
        down = -self.gravity * math.cos(self.tilt)
        return np.array([flat * math.cos(self.downhill), flat * math.sin(self.downhill), down])

    def pivot(self, t: float, s: float, v: float) -> tuple[Array, Array, Array, Array]:
        """S, its rate, dS/ds, and the part of its acceleration without s''."""
        if self.radius is None:
            return np.array([s, 0, 0]), np.array([v, 0, 0]), np.array([1.0, 0, 0]), np.zeros(3)
        r, r1, r2 = self.radius(t)
        out, way = np.array([math.cos(s), math.sin(s), 0]), np.array([-math.sin(s), math.cos(s), 0])
        return r * out, r1 * out + r * v * way, r * way, (r2 - r * v * v) * out + 2 * r1 * v * way

    def start(self, s: float, v: float, along: float, across: float, rates: tuple[float, float] = (0, 0)) -> Array:
        """(s, v, x, x') for angles whose tangents are the offsets over the depth, rates in the pivot's frame."""
        way, out = np.array([1.0, 0, 0]), np.array([0, 1.0, 0])
        if self.radius is not None:
            out, way = np.array([math.cos(s), math.sin(s), 0]), np.array([-math.sin(s), math.cos(s), 0])
        length, hauled, _ = self.length(0.0)
        d = math.tan(along) * way + math.tan(across) * out + np.array([0, 0, -1.0])
        turned = rates[0] / math.cos(along) ** 2 * way + rates[1] / math.cos(across) ** 2 * out
        size = np.linalg.norm(d)
        n = d / size
        n_rate = (turned - n * (n @ turned)) / size
        if self.radius is not None:
            n_rate = n_rate + v * np.cross([0, 0, 1.0], n)
        place, speed, _, _ = self.pivot(0.0, s, v)
        return np.concatenate([[s, v], place + length * n, speed + hauled * n + length * n_rate])

    def rate(self, t: float, y: Array, held: bool) -> Array:
        s, v, x, u = y[0], y[1], y[2:5], y[5:8]
        place, speed, by, own = self.pivot(t, s, v)
        length, l1, l2 = self.length(t)
        d, w = x - place, u - speed
        # (x'' - S'').d + |w|^2 = L'^2 + L L'';  x'' = g - k d (k = tension/(M L)),  S'' = own + by s''
        g = self.weight
        right = l1 * l1 + length * l2 - w @ w
        free = g @ d - own @ d
        if self.imposed is not None or held:
            acceleration = self.imposed(t) if self.imposed is not None and not held else 0.0
            k = (free - by @ d * acceleration - right) / (d @ d)
        else:  # inertia s'' = force + M k d.by
            force = self.force(t, s, v)
            k = (free - by @ d * force / self.inertia - right) / (d @ d + (by @ d) ** 2 * self.mass / self.inertia)
            acceleration = (force + self.mass * k * (d @ by)) / self.inertia
        return np.concatenate([[v, acceleration], u, g - k * d])

    def pull(self, t: float, y: Array) -> float:
        """What the load does to an axis at rest."""
        rate = self.rate(t, y, held=True)
        k = -(rate[5:8] - self.weight)
        return float(self.mass * k @ self.pivot(t, y[0], y[1])[2])

    def run(self, y: Array, breaks: tuple[float, ...], begin: float = 0.0, held: bool = False, **more: object) -> Array:
        """On through the times at which something changes its form."""
        before = begin
        for stop in breaks:
            found = solve_ivp(self.rate, (before, stop), y, "DOP853", rtol=2e-13, atol=1e-14, args=(held,), **more)
            y, before = found.y[:, -1], stop
        return y

    def angles(self, t: float, y: Array) -> tuple[float, float, float]:
        """Along, across and between rope and plumb line."""
        place, _, by, _ = self.pivot(t, y[0], y[1])
        d = y[2:5] - place
        way = by / np.linalg.norm(by)
        out = np.array([way[1], -way[0], 0.0]) if self.radius is not None else np.array([0, 1.0, 0])
        return math.atan2(d @ way, -d[2]), math.atan2(d @ out, -d[2]), math.atan2(math.hypot(d[0], d[1]), -d[2])
