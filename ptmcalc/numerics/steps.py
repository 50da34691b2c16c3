"""The two tables a motion used to be computed with by hand: steps of equal time, and steps of equal angle."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Table:
    """The last line of a step table: time [s], angle [rad], speed [rad/s], and the number of steps.

    Time and angle at the very end are put on the straight line of the last step. `lines` are those of the whole table,
    shape (steps + 1, 3).
    """

    time: float
    angle: float
    speed: float
    steps: int
    reached: bool
    lines: tuple[tuple[float, float, float], ...] = ()


def step_table(
    acceleration: Callable[[float, float, float], float],
    angle: float,
    speed: float,
    until: float,
    step: float,
    most: int,
) -> Table:
    """Motion until a speed is reached, by the step table of the textbook (6.1).

        w_(i+1) = w_i + eps_i dt,   phi_(i+1) = phi_i + w_i dt + eps_i dt^2/2,   eps_i at (t_i, phi_i, w_i)

    Args:
        acceleration: eps of time, angle and speed.
        angle: where the motion begins [rad].
        speed: of the beginning [rad/s].
        until: speed at which it ends, above or below that of the beginning [rad/s].
        step: dt [s].
        most: number of steps after which it is given up.

    **Error** first order in dt for the speed and with it for the time.
    **Source** lecture notes Kramatorsk, chapter 6.
    """
    rising = until > speed
    start, w, time = angle, speed, 0.0
    phi = angle
    lines = [(time, 0.0, w)]
    for count in range(1, most + 1):
        rate = acceleration(time, phi, w)
        after = w + rate * step
        if (after >= until) if rising else (after <= until):
            part = (until - w) / rate
            lines.append((time + part, phi - start + w * part + rate * part**2 / 2, until))
            return Table(*lines[-1], count, True, tuple(lines))
        if rising and rate <= 0 and w <= 0:
            break
        phi, w, time = phi + w * step + rate * step**2 / 2, after, time + step
        lines.append((time, phi - start, w))
    return Table(math.inf, math.inf, w, most, False)


def energy_steps(inertia: FloatArray, work: FloatArray, energy: float) -> FloatArray:
    """Speeds at the ends of angle steps, from the kinetic energy at the first and the work of all torques since.

        w_i = sqrt(2 (T_0 + sum A)/J_i)

    Args:
        inertia: J_i, shape (n,) [kg*m^2].
        work: sum A, since the first, shape (n,) [J].
        energy: T_0 [J].

    Returns:
        w_i, shape (n,) [rad/s]; 0 where the energy is used up.

    **Error** exact in the inertia; that of the works.
    **Source** theorem of kinetic energy (6.9).
    """
    return np.asarray(np.sqrt(np.maximum(2 * (energy + work) / inertia, 0.0)))
