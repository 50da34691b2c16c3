"""A slewing crane with its load as an integration of its own: Cartesian, the rope as a constraint force, DOP853.

Nothing of ptmcalc stands behind it: the load's offset d from the head of the jib obeys

    d'' = g - a_S + lambda d,   lambda = -(d.(g - a_S) + |d'|^2)/L^2

and the jib turns under what acts on it and the pull -m lambda d of the rope at its head.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

FloatArray = NDArray[np.float64]
Acceleration = Callable[[float, float, float, float], float]
"""Angular acceleration of the jib by time, speed, and the pull of the rope: torque T = a - b phi'' as (a, b)."""


@dataclass(frozen=True)
class Crane:
    """Plain numbers in SI units."""

    jib: float
    rotor: float
    mass: float
    radius: float
    rope: float
    efficiency: float
    back: float
    friction: float
    wind: float
    most_wind: float
    torque: float
    """of the motor times the ratio"""
    brake: float
    """of the closed brake times the ratio"""
    delay: float
    rise: float
    speed: float
    rotation: float


@dataclass(frozen=True)
class Seen:
    """What the integration saw."""

    start_time: float
    start_angle: float
    brake_time: float
    radial: float
    """largest angle outwards or inwards until the crane stands"""
    tangential: float


G = np.array([0.0, 0.0, -9.81])


def _parts(one: Crane, state: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, float, float, float]:
    phi, omega, d, rate = state[0], state[1], state[2:5], state[5:8]
    outwards = np.array([np.cos(phi), np.sin(phi), 0.0])
    ahead = np.array([-np.sin(phi), np.cos(phi), 0.0])
    fixed = -(d @ G + omega**2 * one.radius * (d @ outwards) + rate @ rate) / one.rope**2
    grows = one.radius * (d @ ahead) / one.rope**2
    lever = one.mass * one.radius * (d @ ahead)
    return outwards, ahead, d, float(fixed), float(grows), float(lever)


def _derivative(one: Crane, state: FloatArray, turning: float) -> FloatArray:
    outwards, ahead, d, fixed, grows, _ = _parts(one, state)
    pull = fixed + grows * turning
    head = one.radius * (turning * ahead - state[1] ** 2 * outwards)
    return np.concatenate([[state[1], turning], state[5:8], G - head + pull * d])


def _free(one: Crane, state: FloatArray, torque: float, inertia: float) -> float:
    """Angular acceleration under a torque: the rope pulls the head with -m lambda d."""
    *_, fixed, grows, lever = _parts(one, state)
    return (torque - fixed * lever) / (inertia + grows * lever)


def _braked(one: Crane, state: FloatArray, held: float) -> float:
    """Through a gear whose losses go by the direction of the power."""
    drive = one.most_wind - one.friction
    back = _free(one, state, drive - held / one.back, one.jib + one.rotor / one.back)
    if held + one.rotor * back >= 0:
        return back
    return _free(one, state, drive - held * one.efficiency, one.jib + one.rotor * one.efficiency)


def angles(one: Crane, states: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Angles along the way and outwards, as an offset over the depth."""
    phi, d = states[0], states[2:5]
    out = d[0] * np.cos(phi) + d[1] * np.sin(phi)
    ahead = -d[0] * np.sin(phi) + d[1] * np.cos(phi)
    return np.arctan2(ahead, -d[2]), np.arctan2(out, -d[2])


def rotate(one: Crane, stop_angle: float) -> Seen:
    """A whole rotation until the crane stands for the first time; the drive is off `stop_angle` before its end."""
    state = np.array([0.0, 0.0, 0.0, 0.0, -one.rope, 0.0, 0.0, 0.0])
    rules = {"method": "DOP853", "rtol": 1e-11, "atol": 1e-12, "dense_output": True, "max_step": 0.05}
    net = one.torque * one.efficiency - one.friction - one.wind
    inertia = one.jib + one.rotor * one.efficiency

    def at_speed(t: float, y: FloatArray) -> float:
        return float(y[1] - one.speed)

    at_speed.terminal = True  # type: ignore[attr-defined]
    first = solve_ivp(
        lambda t, y: _derivative(one, y, _free(one, y, net, inertia)), (0, 500), state, events=at_speed, **rules
    )
    reached = first.y[:, -1].copy()
    reached[1] = one.speed
    steady = max(one.rotation - reached[0] - stop_angle, 0.0) / one.speed
    second = solve_ivp(lambda t, y: _derivative(one, y, 0.0), (0, steady), reached, **rules)

    def stands(t: float, y: FloatArray) -> float:
        return float(y[1])

    stands.terminal = True  # type: ignore[attr-defined]
    stands.direction = -1  # type: ignore[attr-defined]
    state, since, runs = second.y[:, -1], 0.0, [first, second]
    for until in (one.delay, one.delay + one.rise, 500.0):
        if until <= since:
            continue

        def held(t: float) -> float:
            if t < one.delay:
                return 0.0
            return one.brake * (min((t - one.delay) / one.rise, 1.0) if one.rise else 1.0)

        middle = (since + min(until, since + 1)) / 2
        closed = one.brake if middle >= one.delay + one.rise else None
        run = solve_ivp(
            lambda t, y, closed=closed: _derivative(one, y, _braked(one, y, held(t) if closed is None else closed)),
            (since, until), state, events=stands, **rules,
        )  # fmt: skip
        runs.append(run)
        state, since = run.y[:, -1], float(run.t[-1])
        if run.status == 1:
            break
    seen = [angles(one, run.sol(np.linspace(run.t[0], run.t[-1], 40001))) for run in runs]
    return Seen(
        float(first.t[-1]),
        float(reached[0]),
        since,
        max(float(np.max(np.abs(out))) for _, out in seen),
        max(float(np.max(np.abs(along))) for along, _ in seen),
    )
