"""A mast as an independent reference: own beam elements in absolute coordinates, DOP853 with events, nothing reduced.

It imports nothing of ptmcalc. The unknowns are the way of the base and the absolute shifts and slopes of the nodes; a
clamped root moves with the base.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import eigh
from scipy.optimize import brentq

Array = np.ndarray


def beam(length: float, bending: float, density: float, axial: Callable[[float], float]) -> tuple[Array, Array]:
    """Stiffness with that of an axial force (pull above 0), and mass, by quadrature of the cubic shapes."""
    points, weights = np.polynomial.legendre.leggauss(6)
    stiffness, mass = np.zeros((4, 4)), np.zeros((4, 4))
    h = length
    for point, weight in zip(points, weights, strict=True):
        s = (point + 1) / 2
        shape = np.array([1 - 3 * s**2 + 2 * s**3, h * (s - 2 * s**2 + s**3), 3 * s**2 - 2 * s**3, h * (s**3 - s**2)])
        slope = np.array([-6 * s + 6 * s**2, h * (1 - 4 * s + 3 * s**2), 6 * s - 6 * s**2, h * (3 * s**2 - 2 * s)]) / h
        bend = np.array([-6 + 12 * s, h * (-4 + 6 * s), 6 - 12 * s, h * (6 * s - 2)]) / h**2
        share = weight * h / 2
        stiffness += share * (bending * np.outer(bend, bend) + axial(s * h) * np.outer(slope, slope))
        mass += share * density * np.outer(shape, shape)
    return stiffness, mass


@dataclass
class Reference:
    """A column of even section in equal elements, a load at one node, on a base.

    `pull` g above 0 hanging, below 0 standing; `turn`, `shift` stiffness of the root, None where rigid; `guide` that of
    a spring between the far end and the base; `held_ratio` damping ratio of every mode over a base that is held.
    """

    base: float
    length: float
    bending: float
    column: float
    load: float
    count: int
    load_node: int | None = None
    pull: float = 0.0
    turn: float | None = None
    shift: float | None = None
    root: float = 0.0
    held_ratio: float = 0.0
    inertia: float = 0.0
    guide: float = 0.0
    names: list[str] = field(init=False)

    def __post_init__(self) -> None:
        n, h, density = self.count, self.length / self.count, self.column / self.length
        at = n if self.load_node is None else self.load_node
        whole = 2 * (n + 1)
        k, m = np.zeros((whole, whole)), np.zeros((whole, whole))
        for i in range(n):
            beyond = density * h * (n - 1 - i) + (self.load if at > i else 0.0)
            own_k, own_m = beam(
                h, self.bending, density, lambda x, beyond=beyond: self.pull * (beyond + density * (h - x))
            )
            k[2 * i : 2 * i + 4, 2 * i : 2 * i + 4] += own_k
            m[2 * i : 2 * i + 4, 2 * i : 2 * i + 4] += own_m
        m[2 * at, 2 * at] += self.load
        m[2 * at + 1, 2 * at + 1] += self.inertia
        m[0, 0] += self.root
        if self.turn is not None:
            k[1, 1] += self.turn
        # absolute nodes behind the base: columns say how a node follows the unknowns
        free = [j for j in range(whole) if not ((j == 0 and self.shift is None) or (j == 1 and self.turn is None))]
        follow = np.zeros((whole, 1 + len(free)))
        for column, j in enumerate(free):
            follow[j, 1 + column] = 1.0
        if self.shift is None:
            follow[0, 0] = 1.0
        self.m = follow.T @ m @ follow
        self.k = follow.T @ k @ follow
        self.m[0, 0] += self.base
        if self.shift is not None:
            spring = np.zeros(1 + len(free))
            spring[0], spring[1 + free.index(0)] = -1.0, 1.0
            self.k += self.shift * np.outer(spring, spring)
        self.tip = 1 + free.index(2 * n)
        self.beside = np.zeros(1 + len(free))  # of the far end over the base
        self.beside[0], self.beside[self.tip] = -1.0, 1.0
        self.k += self.guide * np.outer(self.beside, self.beside)
        self.at_load = 1 + free.index(2 * at)
        self.size = 1 + len(free)
        self.c = np.zeros_like(self.k)
        if self.held_ratio:
            w2, shapes = eigh(self.k[1:, 1:], self.m[1:, 1:])
            turned = self.m[1:, 1:] @ shapes
            inner = turned @ np.diag(2 * self.held_ratio * np.sqrt(w2)) @ turned.T
            rigid = np.zeros(self.size - 1)  # deflection beside the base of a unit way of the base
            for column, j in enumerate(free):
                rigid[column] = 1.0 if j % 2 == 0 else 0.0
            beside = np.hstack([-rigid[:, None], np.eye(self.size - 1)])
            self.c = beside.T @ inner @ beside

    def rolling(self) -> Array:
        """Frequencies over a base that rolls, without the free travel."""
        return np.sqrt(np.maximum(eigh(self.k, self.m, eigvals_only=True), 0.0))[1:]

    def held(self) -> Array:
        """Frequencies over a base that is held, by their inverses: the lowest are not lost in the highest."""
        return 1 / np.sqrt(eigh(self.m[1:, 1:], self.k[1:, 1:], eigvals_only=True)[::-1])

    def tip_stiffness(self) -> float:
        """Force at the far end per deflection there, base held."""
        force = np.zeros(self.size - 1)
        force[self.tip - 1] = 1.0
        return 1 / float(np.linalg.solve(self.k[1:, 1:], force)[self.tip - 1])


@dataclass
class Wall:
    """What the far end runs into: None for a point that stops dead, else its stiffness; its damping; its distance."""

    stiffness: float | None
    gap: float = 0.0
    damping: float = 0.0


@dataclass
class Found:
    """Largest and smallest deflection of the far end, stops of the base for good, largest push on a wall."""

    high: float
    low: float
    stands: float
    push: float
    times: Array
    tips: Array
    speeds: Array


def run(
    mast: Reference,
    speed: float,
    force: Callable[[float], float],
    end: float,
    *,
    wall: Wall | None = None,
    push: Callable[[float], float] = lambda t: 0.0,
    wanted: float = 0.0,
    breaks: tuple[float, ...] = (),
    rtol: float = 1e-9,
) -> Found:
    """The motion under dry friction `force(t)` towards the speed `wanted` and a force `push(t)` on the base.

    Restarted at every event: the base reaches the wanted speed (held there if less than the friction is needed), leaves
    it, the far end meets the wall or leaves it, a break of a force over time.
    """
    n, inverse = mast.size, np.linalg.inv(mast.m)
    y = np.zeros(2 * n)
    y[n : 2 * n] = speed * _translation(mast)
    state = {"slip": np.sign(wanted - speed), "wall": "free"}
    time, stands, largest = 0.0, math.inf, 0.0
    times, tips, speeds = [0.0], [0.0], [speed]

    def loads(t: float, y: Array) -> Array:
        f = -mast.k @ y[:n] - mast.c @ y[n:]
        f[0] += push(t)
        if wall is not None and wall.stiffness is not None and state["wall"] == "touch":
            f[mast.tip] -= max(wall.stiffness * (y[mast.tip] - wall.gap) + wall.damping * y[n + mast.tip], 0.0)
        return f

    def solved(t: float, y: Array, slip: float) -> tuple[Array, float, float]:
        """Accelerations, force that holds the base, force of a wall that stops dead."""
        f = loads(t, y)
        f[0] += slip * force(t)
        rows = [0] if slip == 0 else []
        if state["wall"] == "jammed":
            rows.append(mast.tip)
        a = inverse @ f
        if not rows:
            return a, 0.0, 0.0
        multipliers = np.linalg.solve(inverse[np.ix_(rows, rows)], -a[rows])
        a = a + inverse[:, rows] @ multipliers
        a[rows] = 0.0
        needed = multipliers[0] if slip == 0 else 0.0
        return a, float(needed), float(multipliers[-1]) if state["wall"] == "jammed" else 0.0

    def settle(t: float, y: Array) -> None:
        """Whether a base at the wanted speed is held."""
        if abs(solved(t, y, 0.0)[1]) <= force(t):
            state["slip"] = 0.0
        else:
            state["slip"] = float(np.sign(-solved(t, y, 0.0)[1]) * -1.0)

    if speed == wanted:
        settle(0.0, y)
    while time < end:
        stop = min([one for one in breaks if one > time * (1 + 1e-12) + 1e-15] + [end])
        if wall is not None and state["wall"] == "free" and y[mast.tip] >= wall.gap - 1e-14 and y[n + mast.tip] > 1e-12:
            if wall.stiffness is None:
                state["wall"] = "jammed"
                row = inverse[:, mast.tip]
                y[n:] -= row * (y[n + mast.tip] / row[mast.tip])
                y[n + mast.tip] = 0.0
            else:
                state["wall"] = "touch"

        def rhs(t: float, y: Array) -> Array:
            return np.concatenate([y[n:], solved(t, y, state["slip"])[0]])

        def base_event(t: float, y: Array) -> float:
            if state["slip"] == 0:
                return force(t) - abs(solved(t, y, 0.0)[1])
            return state["slip"] * (wanted - y[n])

        def wall_event(t: float, y: Array) -> float:
            if wall is None:
                return 1.0
            if state["wall"] == "jammed":
                return -solved(t, y, state["slip"])[2]
            return (wall.gap - y[mast.tip]) * (1 if state["wall"] == "free" else -1)

        base_event.terminal = wall_event.terminal = True  # type: ignore[attr-defined]
        base_event.direction = wall_event.direction = -1  # type: ignore[attr-defined]
        found = solve_ivp(
            rhs, (time, stop), y, "DOP853", rtol=rtol, atol=1e-13, events=(base_event, wall_event), dense_output=True
        )
        grid = np.linspace(time, found.t[-1], max(int((found.t[-1] - time) / end * 16000), 3))
        seen = found.sol(grid)
        times += grid.tolist()
        tips += (seen[mast.tip] - seen[0]).tolist()
        speeds += seen[n].tolist()
        if wall is not None and state["wall"] != "free":
            for t, column in zip(grid, seen.T, strict=True):
                if wall.stiffness is None:
                    largest = max(largest, -solved(float(t), column, state["slip"])[2])
                else:
                    spring = wall.stiffness * (column[mast.tip] - wall.gap)
                    largest = max(largest, spring + wall.damping * column[n + mast.tip])
        time, y = float(found.t[-1]), found.y[:, -1].copy()
        if found.status == 1 and len(found.t_events[0]):
            if state["slip"] == 0:
                state["slip"] = 1.0 if solved(time, y, 0.0)[1] > 0 else -1.0
                stands = math.inf
            else:
                y[n] = wanted
                settle(time, y)
                if state["slip"] == 0:
                    stands = time
        elif found.status == 1 and state["wall"] in ("jammed", "touch"):
            state["wall"] = "free"
            y[n + mast.tip] = min(y[n + mast.tip], -0.0)
    return Found(max(tips), min(tips), stands, largest, np.array(times), np.array(tips), np.array(speeds))


def _translation(mast: Reference) -> Array:
    """All shifts at once: every unknown that is no slope."""
    # a rigid motion costs no strain energy, and only shifts are in it
    found = np.zeros(mast.size)
    found[0] = 1.0
    shifts = np.linalg.lstsq(mast.k[1:, 1:], -mast.k[1:, 0], rcond=None)[0]
    found[1:] = shifts
    return found


def clamped_root(mass_ratio: float, mode: int = 1) -> float:
    """B of 1 + cos B cosh B + mu B (cos B sinh B - sin B cosh B) = 0."""

    def value(b: float) -> float:
        return 1 / math.cosh(b) + math.cos(b) + mass_ratio * b * (math.cos(b) * math.tanh(b) - math.sin(b))

    found, low, step = 0, 1e-6, 1e-3
    while True:
        if value(low) * value(low + step) <= 0:
            found += 1
            if found == mode:
                return float(brentq(value, low, low + step, xtol=1e-15))
        low += step


def first_at_speed(reference: Reference, force: float, speed: float, rise: float = 0.0) -> float:
    """When a base that rolls, pushed from rest by a force that comes at once or in a straight line, first has a speed:
    the sum over all modes of the elements, without damping, looked at in steps of the fastest mode that matters."""
    squares, shapes = eigh(reference.k, reference.m)
    own = shapes[0] ** 2
    w = np.sqrt(np.maximum(squares, 0.0))
    w[0] = 0.0

    def gained(t: Array) -> Array:
        """Speed by a force of 1 N that comes at once, or its mean over the rise."""
        t = np.maximum(t, 0.0)[:, None]
        return own[0] * t[:, 0] + np.sum(own[1:] * np.sin(w[1:] * t) / w[1:], axis=1)

    def summed(t: Array) -> Array:
        """Its integral from 0 on."""
        t = np.maximum(t, 0.0)[:, None]
        return own[0] * t[:, 0] ** 2 / 2 + np.sum(own[1:] * 2 * np.sin(w[1:] * t / 2) ** 2 / w[1:] ** 2, axis=1)

    def v(t: Array) -> Array:
        return force * ((summed(t) - summed(t - rise)) / rise if rise else gained(t))

    total = 1 / own[0]
    step = 0.02 * min(2 * math.pi / w[min(8, len(w) - 1)], total * speed / force + rise)
    begin = 0.0
    for _ in range(10_000):
        times = begin + step * np.arange(401)
        beyond = np.flatnonzero(v(times) >= speed)
        if len(beyond):
            at = times[beyond[0]]
            return float(brentq(lambda t: float(v(np.array([t]))[0]) - speed, at - step, at, xtol=1e-14, rtol=1e-13))
        begin = times[-1]
    raise AssertionError("the base does not come to its speed")
