"""Start of a chain drive: textbook forms on the motor shaft, and the series of its modes under a sprocket's motion.

The driven mass on the motor shaft is `inertia.mass_on_motor_shaft` with the reeving 1: while the motor drives, the
efficiency divides; while the chain drives a brake on the motor shaft, it multiplies. The wave forms of a start by an
imposed torque are those of a belt (`wave`, `loop_bounds`, `numerics.strand`).

Source of the textbook forms: N. Yu. Dorokhov, "Dynamics of hoisting and conveying machines", lecture notes,
Kramatorsk 2007 (the chapter on the dynamics of chain conveyors).
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


def start_acceleration(starting_torque: float, static_torque: float, inertia: float) -> float:
    """Angular acceleration of the motor shaft during a start.

        eps = (M_p - M_s)/J

    Args:
        starting_torque: M_p, mean torque of the motor while it starts [N*m].
        static_torque: M_s, of the resistance on the motor shaft, the efficiency in it [N*m].
        inertia: J, rotor and driven masses on the motor shaft [kg*m^2].

    Returns:
        eps; not positive where the motor cannot start the chain [rad/s^2].

    **Range** a rigid drive train, mean torques.
    **Error** that of the mean torque.
    **Source** lecture notes Kramatorsk 2007.
    """
    return (starting_torque - static_torque) / inertia


def start_time(starting_torque: float, static_torque: float, inertia: float, speed: float) -> float:
    """Time a motor needs to bring a chain drive to speed.

        t = J w/(M_p - M_s)

    Args:
        starting_torque: M_p, mean torque of the motor while it starts [N*m].
        static_torque: M_s, of the resistance on the motor shaft, the efficiency in it [N*m].
        inertia: J, rotor and driven masses on the motor shaft [kg*m^2].
        speed: w, of the motor shaft at the end [rad/s].

    Returns:
        t; infinite where the motor cannot start the chain [s].

    **Range** as `start_acceleration`.
    **Error** as `start_acceleration`.
    **Source** lecture notes Kramatorsk 2007.
    """
    spare = starting_torque - static_torque
    return inertia * speed / spare if spare > 0 else math.inf


def start_force(driven_mass: float, acceleration: float, sprocket_radius: float, ratio: float) -> float:
    """Dynamic force in the chain during a start by the textbook.

        S_d = m eps R/i

    Args:
        driven_mass: m, of chain, load and tail [kg].
        acceleration: eps, of the motor shaft [rad/s^2].
        sprocket_radius: R [m].
        ratio: i, motor speed over sprocket speed [1].

    Returns:
        S_d, above the static force; it is not added to the polygon force of full speed [N].

    **Range** a rigid chain.
    **Error** the rigid-body part: with a constant tension at the run-off an elastic chain swings between 0 and twice
    of it after a step of torque.
    **Source** lecture notes Kramatorsk 2007.
    """
    return driven_mass * (acceleration / ratio) * sprocket_radius


def start_series(
    amplitudes: FloatArray, frequencies: FloatArray, damping_ratios: FloatArray, time: ArrayLike
) -> FloatArray:
    """Tension at a sprocket after a step that is kept: the sum over the modes of the chain.

        S = sum S_k (1 - e^(-zeta w t) (cos(w_d t) - zeta w sin(w_d t)/w_d)),   w_d = w (1 - zeta^2)^(1/2)

    Args:
        amplitudes: S_k: M_k a for a step of the sprocket's acceleration, M_k of `chain_resonance.modal_masses`; c_k F
            for a step of rim force, c_k of `chain_resonance.start_shares`; shape (k,) [N].
        frequencies: w_k, shape (k,) [rad/s].
        damping_ratios: zeta_k, of internal damping, also above 1, shape (k,) [1].
        time: t [s].

    Returns:
        S [N].

    **Range** damping that leaves the modes alone (Kelvin-Voigt of one retardation time).
    **Error** exact for the modes given, `start_series_tail` for those left out.
    **Source** derived: step response of every mode, its damper part of the force; checked by finite elements.
    """
    w, zeta, share = (np.asarray(part, float) for part in (frequencies, damping_ratios, amplitudes))
    t = np.asarray(time, float)[..., None]
    over = zeta > 1
    root = np.sqrt(np.abs(zeta - 1)) * np.sqrt(zeta + 1)
    damped, slow = w * root, np.exp(-w * np.where(over, 1 / (np.maximum(zeta, 1.0) + root), zeta) * t)
    # cos and sin/w_d; above critical damping cosh and sinh/w_d, what grows in them taken into the slow decay
    fast = np.where(over, np.expm1(-2 * damped * t), 0.0)
    cosine = np.where(over, 1 + fast / 2, np.cos(damped * t))
    nonzero = np.where(damped > 0, damped, 1.0)
    sine = np.where(damped > 0, np.where(over, -fast / 2, np.sin(damped * t)) / nonzero, t)
    return np.asarray(np.sum(share * (1 - slow * (cosine - zeta * w * sine)), axis=-1))


def start_series_tail(amplitudes: FloatArray, whole: float) -> float:
    """Most that the modes left out of `start_series` can add to it or take from it.

        dS = 2 (S_0 - sum S_k)

    Args:
        amplitudes: S_k, of the modes taken, shape (k,) [N].
        whole: S_0, of all modes: the quasi-static tension after the step [N].

    Returns:
        dS [N].

    **Range** the run-on with a constant tension at the run-off, where no mode has another sign.
    **Error** a bound: no mode's part leaves 0 to 2 S_k.
    **Source** derived: the speed of a free vibration never exceeds that at its beginning.
    """
    return 2 * abs(whole - float(np.sum(np.asarray(amplitudes, float))))
