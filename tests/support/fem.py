"""Finite elements of a belt loop: the independent reference. Imports nothing from `ptmcalc`.

Linear two-node elements with consistent mass; the loop runs drum - carry strand - tail - return strand and ends
free (gravity take-up) or at the drum again (rigid take-up). Dynamic quantities only.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import eigh


@dataclass(frozen=True)
class Belt:
    """A loop: lengths, masses per length and stiffnesses of carry and return, drum and tail mass."""

    lengths: tuple[float, float]
    line_masses: tuple[float, float]
    stiffness: float
    drum_mass: float
    tail_mass: float
    rigid_takeup: bool


def elements(belt: Belt, count: tuple[int, int]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Mass matrix, stiffness matrix, and the stiffness EA/h of every element in order."""
    carry, back = count
    nodes = carry + back + (0 if belt.rigid_takeup else 1)
    mass, stiff = np.zeros((nodes, nodes)), np.zeros((nodes, nodes))
    springs = []
    for index in range(carry + back):
        strand = 0 if index < carry else 1
        h = belt.lengths[strand] / count[strand]
        k, m = belt.stiffness / h, belt.line_masses[strand] * h
        i, j = index, (index + 1) % nodes
        springs.append(k)
        for a, b, kk, mm in ((i, i, k, m / 3), (j, j, k, m / 3), (i, j, -k, m / 6), (j, i, -k, m / 6)):
            stiff[a, b] += kk
            mass[a, b] += mm
    mass[0, 0] += belt.drum_mass
    mass[carry, carry] += belt.tail_mass
    return mass, stiff, np.array(springs)


def natural_frequencies(belt: Belt, count: tuple[int, int], clamped_drum: bool, how_many: int) -> np.ndarray:
    """Lowest nonzero natural frequencies, rad/s."""
    mass, stiff, _ = elements(belt, count)
    keep = slice(1, None) if clamped_drum else slice(None)
    values = eigh(stiff[keep, keep], mass[keep, keep], eigvals_only=True)
    frequencies = np.sqrt(np.maximum(values, 0))
    return frequencies[frequencies > 1e-4 * frequencies[-1] / len(frequencies)][:how_many]


def step_response(belt: Belt, count: tuple[int, int], force: float, times: np.ndarray) -> dict[str, np.ndarray]:
    """Answer to a step of rim force, exact in time by the modes of the mesh: tensions and drum speed."""
    mass, stiff, springs = elements(belt, count)
    values, modes = eigh(stiff, mass)
    w = np.sqrt(np.maximum(values, 0))
    w[0] = 0.0  # the whole loop moving
    drive = modes[0] * force
    phase = w[:, None] * times
    with np.errstate(divide="ignore", invalid="ignore"):
        position = np.where(w[:, None] > 0, (1 - np.cos(phase)) / w[:, None] ** 2, times**2 / 2) * drive[:, None]
        speed = np.where(w[:, None] > 0, np.sin(phase) / w[:, None], times) * drive[:, None]
    u = modes @ position
    count_all = len(springs)
    ends = np.array([(i, (i + 1) % len(u)) for i in range(count_all)])
    tension = springs[:, None] * (u[ends[:, 0]] - u[ends[:, 1]])  # the drum pulls node 0 ahead
    drum_speed = modes[0] @ speed
    return {
        "run_on": tension[0],
        "run_off": tension[-1] if belt.rigid_takeup else np.zeros_like(times),
        "all": tension,
        "drum_speed": drum_speed,
    }


def imposed_speed(
    belt: Belt, count: tuple[int, int], acceleration: Callable[[np.ndarray], np.ndarray], times: np.ndarray
) -> dict[str, np.ndarray]:
    """Answer to an imposed drum acceleration: Newmark average acceleration on the motion relative to the drum."""
    mass, stiff, springs = elements(belt, count)
    m, k = mass[1:, 1:], stiff[1:, 1:]
    load = -mass[1:, 1:] @ np.ones(len(m)) - mass[1:, 0]
    if belt.rigid_takeup:
        pass  # the drum node carries no belt mass of its own that moves relative to it
    step = times[1] - times[0]
    system = np.linalg.inv(m + step**2 / 4 * k)
    a = acceleration(times)
    u, v = np.zeros(len(m)), np.zeros(len(m))
    acc = np.linalg.solve(m, load * a[0])
    history = np.zeros((len(springs), len(times)))
    nodes = len(m) + 1
    ends = np.array([(i, (i + 1) % nodes) for i in range(len(springs))])
    for n in range(1, len(times)):
        guess_u, guess_v = u + step * v + step**2 / 4 * acc, v + step / 2 * acc
        acc = system @ (load * a[n] - k @ guess_u)
        u, v = guess_u + step**2 / 4 * acc, guess_v + step / 2 * acc
        whole = np.concatenate([[0.0], u])
        history[:, n] = springs * (whole[ends[:, 0]] - whole[ends[:, 1]])
    return {"run_on": history[0], "run_off": history[-1] if belt.rigid_takeup else np.zeros_like(times), "all": history}


def sagging_step(
    belt: Belt,
    count: tuple[int, int],
    force: float,
    static: np.ndarray,
    span_weights: tuple[float, float],
    times: np.ndarray,
    retardation: float,
) -> dict[str, np.ndarray]:
    """Step of rim force on a belt whose spans sag: lumped masses, springs with the exact strain of a parabolic span,
    integrated with tight tolerances. `static` is the static tension of every element, drum to run-off. A little
    Kelvin-Voigt damping (`retardation`, s) lets shocks dissipate; without it they would ring for ever."""
    mass, _, springs = elements(belt, count)
    lumped = mass.sum(axis=1)
    carry = count[0]
    kappa = np.array([span_weights[0 if i < carry else 1] ** 2 / 24 for i in range(len(springs))])
    lengths = np.array(
        [belt.lengths[0 if i < carry else 1] / count[0 if i < carry else 1] for i in range(len(springs))]
    )
    nodes = len(lumped)
    first = np.arange(len(springs))
    second = (first + 1) % nodes

    def tension(stretch: np.ndarray) -> np.ndarray:
        """Inverse of stretch/h = S/EA - kappa/S^2 - (the same of the static tension), by bisection and Newton."""
        goal = stretch / lengths + static / belt.stiffness - kappa / static**2
        s = np.maximum(static + springs * stretch, 0.2 * static)
        for _ in range(100):
            f = s / belt.stiffness - kappa / s**2 - goal
            new = np.maximum(s - f / (1 / belt.stiffness + 2 * kappa / s**3), 0.3 * s)
            if np.max(np.abs(new - s) / s) < 1e-13:
                return new
            s = new
        return s

    def rate(t: float, y: np.ndarray) -> np.ndarray:
        u, v = y[:nodes], y[nodes:]
        pull = tension(u[first] - u[second]) - static + retardation * springs * (v[first] - v[second])
        net = np.zeros(nodes)
        np.add.at(net, first, -pull)
        np.add.at(net, second, pull)
        net[0] += force
        return np.concatenate([v, net / lumped])

    solution = solve_ivp(rate, (0, times[-1]), np.zeros(2 * nodes), "DOP853", times, rtol=1e-8, atol=1e-9)
    pulls = np.array([tension(y[first] - y[second]) for y in solution.y[:nodes].T]).T
    return {"run_on": pulls[0], "all": pulls}
