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

_ONE_BY_ONE = 64


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


def rigid_acceleration(
    torque: float,
    motor_inertia: float,
    ratio: float,
    efficiency: float,
    sprocket_radius: float,
    driven_mass: float,
    resistance: float,
) -> tuple[float, float]:
    """Acceleration of a rigid chain by its motor, the losses of the gear by the direction of the power through it.

        m a + W = e (M i/R - J (i/R)^2 a),   e = eta where that force is positive, else 1/eta: the chain drives

    Args:
        torque: M, of all motors, not below 0 [N*m].
        motor_inertia: J, everything on the motor shaft [kg*m^2].
        ratio: i, motor speed over sprocket speed [1].
        efficiency: eta, of the gear [1].
        sprocket_radius: R [m].
        driven_mass: m, chain, load, tail and sprocket at the rim [kg].
        resistance: W, static at the rim, positive against the motion; a descent may drive [N].

    Returns:
        a; not positive where the motor cannot start the chain [m/s^2], e [1].

    **Range** a rigid drive train of constant efficiency; one of both directions always fits, and only one.
    **Error** exact for that model.
    **Source** derived: balances of motor and sprocket; the rule of the lecture notes for power mode is e = eta.
    """
    found = _by_losses(torque, motor_inertia, ratio, efficiency, sprocket_radius, driven_mass, resistance)
    if driven_mass * found + resistance >= 0:
        return found, efficiency
    back = 1 / efficiency
    return _by_losses(torque, motor_inertia, ratio, back, sprocket_radius, driven_mass, resistance), back


def _by_losses(
    torque: float, inertia: float, ratio: float, losses: float, radius: float, mass: float, resistance: float
) -> float:
    arm = radius / ratio
    return (losses * torque / arm - resistance) / (mass + losses * inertia / arm**2)


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
    cosine, sine = _fading(w, zeta, np.asarray(time, float)[..., None])
    return np.asarray(np.sum(share * (1 - (cosine - zeta * w * sine)), axis=-1))


def _fading(w: FloatArray, zeta: FloatArray, t: FloatArray) -> tuple[FloatArray, FloatArray]:
    """e^(-zeta w t) cos(w_d t) and e^(-zeta w t) sin(w_d t)/w_d; above critical damping with cosh and sinh, what grows
    in them taken into the slow decay."""
    over = zeta > 1
    root = np.sqrt(np.abs(zeta - 1)) * np.sqrt(zeta + 1)
    damped, slow = w * root, np.exp(-w * np.where(over, 1 / (np.maximum(zeta, 1.0) + root), zeta) * t)
    fast = np.expm1(-2 * damped * t)
    cosine = np.where(over, 1 + fast / 2, np.cos(damped * t))
    nonzero = np.where(damped > 0, damped, 1.0)
    sine = np.where(damped > 0, np.where(over, -fast / 2, np.sin(damped * t)) / nonzero, t)
    return np.asarray(slow * cosine), np.asarray(slow * sine)


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


def passing_bound(
    frequencies: FloatArray,
    damping_ratios: FloatArray,
    sprocket_speed: float,
    sprocket_acceleration: float,
    pitch: float,
    teeth: int,
    passes: float,
) -> FloatArray:
    """Most that the teeth can make a mode follow while a sprocket changes its speed, over the gain of the mode.

        x <= 7 a_j + (2 a_j + min(2 a_j, v/w)) sum_(j>=1) E(j T),   T = 2 h/w_s,   h = pi/z
        a_j = R (w_s^2 sin(h) + e (1 - cos(h))),   v = R (2 w_s^3 (2 - cos(h)) + 6 e w_s (2 sin(h) + h))
        x <= w^2 (1 + 2 zeta) (4 u (2 E(0) + sum E(j T)) + E(0) w_s R (1 - cos(h))/w),   u = max |displacement|

    E(t) is the root of the energy that free motion leaves of a unit jump of the input after t: it bounds that motion
    from t on. Engagements, each a jump of 2 a_j at most, come T apart or more; what the acceleration does between two
    of them counts as a jump of the same size or by its slope over the frequency, whichever is less. Teeth much faster
    than the mode hardly move it: the second bound counts the ways they move, and the speed they begin with.

    Args:
        frequencies: w, shape (k,) [rad/s].
        damping_ratios: zeta, also above 1, shape (k,) [1].
        sprocket_speed: w_s, the highest of the range, above 0 [rad/s].
        sprocket_acceleration: e, its size [rad/s^2].
        pitch: p [m].
        teeth: z.
        passes: n, engagements in the range; infinite where it is not known [1].

    Returns:
        x, shape (k,); infinite without damping and a number of passes [m/s^2].

    **Range** modes at rest before; a sprocket that only speeds up or only slows down.
    **Error** a bound; runs through a resonance come to 0.2 to 0.4 of it.
    **Source** derived: variation of the input pass by pass, free motion after each part of it.
    """
    half = math.pi / teeth
    radius = pitch / (2 * math.sin(half))
    jump = radius * (sprocket_speed**2 * math.sin(half) + sprocket_acceleration * 2 * math.sin(half / 2) ** 2)
    steep = 2 * sprocket_speed**3 * (2 - math.cos(half))
    steep += 6 * sprocket_acceleration * sprocket_speed * (2 * math.sin(half) + half)
    w, zeta = np.asarray(frequencies, float), np.asarray(damping_ratios, float)
    late = _left_energies(w, zeta, 2 * half / sprocket_speed, passes)
    by_jumps = 7 * jump + (2 * jump + np.minimum(2 * jump, radius * steep / w)) * late
    ahead = radius * half**3 / (9 * math.sqrt(3))
    if half > 1e-3:  # a few teeth: where the chain is furthest ahead of its mean motion
        angle = math.acos(math.sin(half) / half)
        ahead = radius * (math.sin(angle) - angle * math.sin(half) / half)
    begun, ripple = np.sqrt(1 + 4 * zeta**2), 2 * radius * sprocket_speed * math.sin(half / 2) ** 2
    by_ways = w * (1 + 2 * zeta) * (4 * ahead * w * (2 * begun + late) + begun * ripple)
    return np.asarray(np.minimum(by_jumps, by_ways))


def _left_energies(w: FloatArray, zeta: FloatArray, period: float, passes: float) -> FloatArray:
    """Sum of E(j T) over 1 <= j < n: the first ones one by one; behind them every stretch as long as theirs leaves a
    part of the one before, the largest factor of its map."""
    first = int(min(max(passes - 1, 0), _ONE_BY_ONE))
    times: FloatArray = period * np.arange(1, first + 1, dtype=np.float64)[:, None]
    found = _left_energy(w, zeta, times)
    total = np.asarray(found.sum(axis=0))
    rest = passes - 1 - first
    if rest <= 0:
        return total
    cosine, sine = _fading(w, zeta, times[-1])
    swing, drag = w * sine, zeta * w * sine
    whole = np.moveaxis(np.array([[cosine + drag, swing], [-swing, cosine - drag]]), -1, 0)
    factor = np.linalg.norm(whole, 2, axis=(1, 2))
    fades = np.divide(factor, 1 - factor, out=np.full_like(factor, np.inf), where=factor < 1)
    by_one = np.multiply(rest, found[-1], out=np.zeros_like(total), where=found[-1] > 0)
    by_stretch = np.multiply(total, fades, out=np.zeros_like(total), where=total > 0)
    return np.asarray(total + np.minimum(by_one, by_stretch))


def _left_energy(w: FloatArray, zeta: FloatArray, t: FloatArray) -> FloatArray:
    """E(t): the root of d^2 + (d'/w)^2 after a unit jump, d = -1 and d' = 2 zeta w at first."""
    cosine, sine = _fading(w, zeta, t)
    swing = w * sine
    light = np.hypot(cosine - zeta * swing, 2 * zeta * cosine + (1 - 2 * zeta**2) * swing)
    # far above critical damping both poles apart: the sum above loses its digits
    root = np.sqrt(np.maximum(zeta - 1, 1.0)) * np.sqrt(zeta + 1)
    fast, slow = zeta + root, 1 / (zeta + root)
    one, other = np.exp(-fast * w * t), np.exp(-slow * w * t)
    heavy = np.hypot(fast * one - slow * other, fast**2 * one - slow**2 * other) / (2 * root)
    return np.where(zeta > 2, heavy, light)
