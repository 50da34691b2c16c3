"""Two masses on a one-sided spring, integrated with events: a reference for closed forms of hoists and shafts."""

from collections.abc import Callable

import numpy as np
from scipy.integrate import solve_ivp

Force = Callable[[float, float], float]
"""Force on the drive mass over time and its speed, without the spring's."""


def stretch_history(
    drive_mass: float,
    load_mass: float,
    stiffness: float,
    force: Force,
    weight: float,
    state: tuple[float, float, float],
    until: float,
    grounded: bool,
) -> tuple[np.ndarray, np.ndarray, float]:
    """Times, spring forces at a fine grid and the time of lift-off (0 for a load that hangs).

    State: path and speed of the drive, speed of the load; paths count from the unstretched spring. A load on the ground
    stays until the spring carries its weight.
    """
    lift = 0.0
    x, v, w = state
    start, y = 0.0, 0.0
    if grounded:

        def held(t: float, s: np.ndarray) -> list[float]:
            return [s[1], (force(t, s[1]) - stiffness * max(s[0], 0.0)) / drive_mass]

        def leaves(t: float, s: np.ndarray) -> float:
            return stiffness * s[0] - weight

        leaves.terminal, leaves.direction = True, 1.0  # type: ignore[attr-defined]
        first = solve_ivp(held, (0, until), [x, v], events=leaves, rtol=1e-11, atol=1e-13, dense_output=True)
        if first.status != 1:
            times = np.linspace(0, until, 20001)
            return times, stiffness * np.maximum(first.sol(times)[0], 0.0), np.inf
        lift = start = float(first.t[-1])
        x, v = first.y[:, -1]

    def free(t: float, s: np.ndarray) -> list[float]:
        pull = stiffness * max(s[0] - s[1], 0.0)
        return [s[2], s[3], (force(t, s[2]) - pull) / drive_mass, (pull - weight) / load_mass]

    run = solve_ivp(free, (start, until), [x, y, v, w], rtol=1e-11, atol=1e-13, dense_output=True, max_step=until / 200)
    times = np.linspace(start, until, 20001)
    states = run.sol(times)
    return times, stiffness * np.maximum(states[0] - states[1], 0.0), lift
