"""Finite elements of strands whose ends are moved: the reference of a chain with a driven tail. Imports nothing from
`ptmcalc`.

Nodes run with the travel. A motion is (way, speed, acceleration), each of shape (steps, columns); all columns are
followed at once. Newmark's method with the average acceleration; the damping is that of the stiffness times a time.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

Motion = tuple[np.ndarray, np.ndarray, np.ndarray]


@dataclass(frozen=True)
class Bar:
    """A strand: its length [m], mass per length [kg/m], EA [N], time of its damping [s]."""

    length: float
    line_mass: float
    stiffness: float
    damping: float

    def matrices(self, pieces: int) -> tuple[np.ndarray, np.ndarray]:
        """Mass, half lumped and half consistent, and stiffness."""
        h, count = self.length / pieces, pieces + 1
        mass, stiff = np.zeros((count, count)), np.zeros((count, count))
        for k in range(pieces):
            stiff[k : k + 2, k : k + 2] += self.stiffness / h * np.array([[1, -1], [-1, 1]])
            mass[k : k + 2, k : k + 2] += self.line_mass * h / 12 * np.array([[5, 1], [1, 5]])
        return mass, stiff


def moved_by_ends(
    bar: Bar, pieces: int, dt: float, first: Motion | None, last: Motion, hung: float = 0.0, *, running: bool = False
) -> np.ndarray:
    """Tensions at the beginning, in every element and at the end of a strand, shape (steps, pieces + 2, columns), when
    its ends are moved; without a motion of the first one, that end keeps its tension, but for a mass [kg] that follows
    its motion against the last one. A strand that is `running` begins with speeds between those of its ends."""
    own, stiff = bar.matrices(pieces)
    mass = own.copy()
    mass[0, 0] += hung
    given = {pieces: last} | ({} if first is None else {0: first})
    inner = [k for k in range(pieces + 1) if k not in given]
    held = sorted(given)
    steps, columns = last[0].shape
    u, v, a = (np.zeros((pieces + 1, columns)) for _ in range(3))
    for which, part in enumerate((u, v, a)):
        for k in held:
            part[k] = given[k][which][0]
    share = np.linspace(0.0, 1.0, pieces + 1)[:, None]
    begin = last if first is None else first
    u[:] = begin[0][0] + share * (last[0][0] - begin[0][0])
    if running:
        v[:] = begin[1][0] + share * (last[1][0] - begin[1][0])
    damp = bar.damping * stiff
    free = np.ix_(inner, inner)
    pushed = np.zeros((steps, pieces + 1, columns))
    pushed[:, 0] = hung * last[2]
    moved = mass[np.ix_(inner, held)] @ a[held] + (damp @ v + stiff @ u - pushed[0])[inner]
    a[inner] = np.linalg.solve(mass[free], -moved)
    step = np.linalg.inv(mass[free] + dt / 2 * damp[free] + dt**2 / 4 * stiff[free])
    found = np.zeros((steps, pieces + 2, columns))
    h = bar.length / pieces
    for n in range(steps):
        if n:
            u = u + dt * v + dt**2 / 4 * a
            v = v + dt / 2 * a
            for k in held:
                u[k], v[k], a[k] = (part[n] for part in given[k])
            moved = mass[np.ix_(inner, held)] @ a[held] + (damp @ v + stiff @ u - pushed[n])[inner]
            a[inner] = -step @ moved
            v[inner] += dt / 2 * a[inner]
            u[inner] += dt**2 / 4 * a[inner]
        forces = own @ a + damp @ v + stiff @ u
        found[n, 1:-1] = bar.stiffness / h * (np.diff(u, axis=0) + bar.damping * np.diff(v, axis=0))
        found[n, 0], found[n, -1] = -forces[0], forces[-1]
    return found


def on_one_shaft(
    bars: tuple[Bar, Bar],
    free: bool,
    sprockets: float,
    pieces: int,
    dt: float,
    forces: np.ndarray,
    ahead: tuple[Motion | None, ...] = (None, None, None, None),
) -> tuple[np.ndarray, np.ndarray]:
    """Tensions of the return and the working strand, each of shape (steps, pieces + 2), under a force over time.

    The sprockets are one mass [kg] of one speed; `free` where the return strand begins at a constant tension. The four
    ends, in the order of the travel, move `ahead` of their sprockets; each of shape (steps,).
    """
    found, _ = pulled_on_one_shaft(bars, free, sprockets, pieces, dt, len(forces), lambda n, _: float(forces[n]), ahead)
    return found[0], found[1]


def pulled_on_one_shaft(
    bars: tuple[Bar, Bar],
    free: bool,
    sprockets: float,
    pieces: int,
    dt: float,
    steps: int,
    force: Callable[[int, float], float],
    ahead: tuple[Motion | None, ...] = (None, None, None, None),
) -> tuple[np.ndarray, Motion]:
    """The same under a force by step and speed of the sprockets; tensions of shape (2, steps, pieces + 2), and the
    motion of the sprockets."""
    count = pieces + 1
    mass, stiff, damp = (np.zeros((2 * count, 2 * count)) for _ in range(3))
    for k, bar in enumerate(bars):
        part = slice(k * count, (k + 1) * count)
        mass[part, part], stiff[part, part] = bar.matrices(pieces)
        damp[part, part] = bar.damping * stiff[part, part]
    coupled = [pieces, count, 2 * count - 1] + ([] if free else [0])
    alone = [k for k in range(2 * count) if k not in coupled]
    gather = np.zeros((2 * count, len(alone) + 1))
    gather[alone, range(len(alone))] = 1
    gather[coupled, -1] = 1
    m, c, k = (gather.T @ part @ gather for part in (mass, damp, stiff))
    m[-1, -1] += sprockets
    push = np.zeros(len(m))
    push[-1] = 1
    given = np.zeros((3, steps, 2 * count))
    for node, moved in zip((0, pieces, count, 2 * count - 1), ahead, strict=True):
        if moved is not None:
            given[:, :, node] = moved
    for one in (0, 1):  # between its ends a strand begins as it is stretched, without more tension inside
        ends = given[0, 0, one * count], given[0, 0, one * count + pieces]
        first = ends[1] if one == 0 and free else ends[0]
        given[0, :, one * count + 1 : one * count + pieces] = np.linspace(first, ends[1], count)[1:-1]
    if free:
        given[0, :, 0] = given[0, 0, pieces]
    loads = -(given[2] @ mass + given[1] @ damp + given[0] @ stiff) @ gather
    u, v = np.zeros(len(m)), np.zeros(len(m))
    a = np.linalg.solve(m, push * force(0, 0.0) + loads[0])
    step = np.linalg.inv(m + dt / 2 * c + dt**2 / 4 * k)
    found, turned = np.zeros((2, steps, pieces + 2)), np.zeros((3, steps))
    for n in range(steps):
        if n:
            before = v[-1] + dt * a[-1]
            u, v = u + dt * v + dt**2 / 4 * a, v + dt / 2 * a
            rest = step @ (loads[n] - c @ v - k @ u)
            for _ in range(3):  # until force and speed fit each other
                a = rest + step[:, -1] * force(n, before)
                before = v[-1] + dt / 2 * a[-1]
            u, v = u + dt**2 / 4 * a, v + dt / 2 * a
        turned[:, n] = u[-1], v[-1], a[-1]
        way, speed, rate = (gather @ part + more[n] for part, more in zip((u, v, a), given, strict=True))
        inner = mass @ rate + damp @ speed + stiff @ way
        for one, bar in enumerate(bars):
            part = slice(one * count, (one + 1) * count)
            stretch = np.diff(way[part]) + bar.damping * np.diff(speed[part])
            found[one, n, 1:-1] = bar.stiffness * pieces / bar.length * stretch
            found[one, n, 0], found[one, n, -1] = -inner[part][0], inner[part][-1]
    return found, (turned[0], turned[1], turned[2])


def profile(shape: str, time: float, speed: float, times: np.ndarray) -> Motion:
    """Way, speed and acceleration of a profile of speed, each of shape (steps,)."""
    t, x = np.minimum(times, time), np.minimum(times / time, 1.0)
    after = speed * (times - t)
    if shape == "ramp":
        way, v, a = speed * time * x**2 / 2, speed * x, np.full_like(x, speed / time)
    elif shape == "cosine":
        way = speed * time * (x / 2 - np.sin(np.pi * x) / (2 * np.pi))
        v, a = speed * (1 - np.cos(np.pi * x)) / 2, speed * np.pi / (2 * time) * np.sin(np.pi * x)
    else:  # two parabolas
        early = x < 0.5
        way = speed * time * np.where(early, 2 * x**3 / 3, 2 * x**2 - 2 * x**3 / 3 - x + 1 / 6)
        v = speed * np.where(early, 2 * x**2, 1 - 2 * (1 - x) ** 2)
        a = 4 * speed / time * np.where(early, x, 1 - x)
    return way + after, v, np.where(times < time, a, 0.0)


def teeth(motion: Motion, pitch: float, count: int, lead: float) -> Motion:
    """What the chain on a sprocket of so many teeth moves ahead of its mean motion, the first joint a lead (in pitches)
    behind its engagement."""
    way, speed, rate = motion
    radius, arm = pitch / (2 * math.sin(math.pi / count)), pitch * count / (2 * math.pi)
    place = (way / pitch + lead) % 1.0 - 0.5
    angle, turning = 2 * math.pi / count * place, speed / arm
    ahead = radius * np.sin(angle) - pitch * place
    faster = radius * turning * np.cos(angle) - speed
    return ahead, faster, radius * (rate / arm * np.cos(angle) - turning**2 * np.sin(angle)) - rate
