"""One mass, one spring, one damper: natural frequency, damping, and the steady answer to a harmonic excitation.

    m x'' + b x' + c x = F(t),   w_0 = (c/m)^(1/2),   zeta = b/(2 (c m)^(1/2))

Frequencies are circular, in rad/s. Read torque, moment of inertia and angle for a shaft.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

# --- frequency and damping --------------------------------------------------------------------------------------


def natural_frequency(stiffness: float, mass: float) -> float:
    """Natural circular frequency of a mass on a spring.

        w_0 = (c/m)^(1/2)

    Args:
        stiffness: c [N/m].
        mass: m [kg].

    Returns:
        w_0 [rad/s].

    **Range** a massless spring on a fixed support.
    **Error** exact.
    **Source** C. Huygens; equation of motion.
    """
    return float(np.sqrt(stiffness / mass))


def damping_ratio(damping: float, stiffness: float, mass: float) -> float:
    """Damping as a share of the critical one.

        zeta = b / (2 (c m)^(1/2))

    Args:
        damping: b, force per speed [N*s/m].
        stiffness: c [N/m].
        mass: m [kg].

    Returns:
        zeta [1].

    **Range** viscous damping.
    **Error** exact.
    **Source** definition: critical damping is 2 (c m)^(1/2).
    """
    return float(damping / (2 * np.sqrt(stiffness) * np.sqrt(mass)))


def damping_ratio_of_decrement(decrement: ArrayLike) -> FloatArray:
    """Damping ratio of a logarithmic decrement.

        zeta = delta / (4 pi^2 + delta^2)^(1/2)

    Args:
        decrement: delta, logarithm of the ratio of two successive maxima [1].

    Returns:
        zeta [1].

    **Range** delta >= 0.
    **Error** exact for viscous damping.
    **Source** derived: inverse of `decrement_of_damping_ratio`.
    """
    delta = np.asarray(decrement, float)
    return np.asarray(delta / np.hypot(2 * np.pi, delta))


def decrement_of_damping_ratio(ratio: ArrayLike) -> FloatArray:
    """Logarithmic decrement of a damping ratio.

        delta = 2 pi zeta / (1 - zeta^2)^(1/2)

    Args:
        ratio: zeta [1].

    Returns:
        delta; infinite from zeta = 1 on, where no second maximum comes [1].

    **Range** zeta >= 0.
    **Error** exact for viscous damping.
    **Source** derived: maxima of the free vibration, one damped period apart.
    """
    zeta = np.asarray(ratio, float)
    inside = np.minimum(zeta, 1.0)
    with np.errstate(divide="ignore"):
        return np.asarray(2 * np.pi * inside / np.sqrt((1 - inside) * (1 + inside)))


def damping_of_decrement(decrement: float, mass: float, damped_period: float) -> float:
    """Damping of a vibration from its logarithmic decrement and its period.

        b = 2 m delta / T_d

    Args:
        decrement: delta, logarithm of the ratio of two successive maxima [1].
        mass: m; of two free masses m_1 m_2/(m_1 + m_2) [kg].
        damped_period: T_d, the period as measured, with the damping [s].

    Returns:
        b [N*s/m].

    **Range** viscous damping, delta >= 0.
    **Error** exact with T_d; with the undamped period too large by the factor 1/(1 - zeta^2)^(1/2).
    **Source** lecture notes Kramatorsk 2007; delta = b T_d/(2 m).
    """
    return 2 * mass * decrement / damped_period


def damped_frequency(natural_frequency: float, damping_ratio: float) -> float:
    """Circular frequency of a damped free vibration.

        w_d = w_0 (1 - zeta^2)^(1/2)

    Args:
        natural_frequency: w_0 [rad/s].
        damping_ratio: zeta [1].

    Returns:
        w_d; 0 from zeta = 1 on, where nothing vibrates [rad/s].

    **Range** zeta >= 0.
    **Error** exact for viscous damping.
    **Source** roots of m s^2 + b s + c = 0.
    """
    zeta = min(damping_ratio, 1.0)
    return float(natural_frequency * np.sqrt((1 - zeta) * (1 + zeta)))


# --- steady harmonic excitation ---------------------------------------------------------------------------------


def amplification(frequency_ratio: ArrayLike, damping_ratio: ArrayLike) -> FloatArray:
    """Amplitude under a harmonic force over the deflection under the same force at rest.

        beta = 1 / ((1 - r^2)^2 + (2 zeta r)^2)^(1/2)

    Args:
        frequency_ratio: r, excitation over natural frequency [1].
        damping_ratio: zeta [1].

    Returns:
        beta; infinite at r = 1 without damping [1].

    **Range** steady state, r >= 0, zeta >= 0.
    **Error** exact for viscous damping.
    **Source** particular solution of the equation of motion.
    """
    r, zeta = np.asarray(frequency_ratio, float), np.asarray(damping_ratio, float)
    with np.errstate(divide="ignore"):
        return np.asarray(1 / np.hypot((1 - r) * (1 + r), 2 * zeta * r))


def phase_lag(frequency_ratio: ArrayLike, damping_ratio: ArrayLike) -> FloatArray:
    """Angle by which the vibration lags behind its harmonic force.

        phi = atan2(2 zeta r, 1 - r^2)

    Args:
        frequency_ratio: r, excitation over natural frequency [1].
        damping_ratio: zeta [1].

    Returns:
        phi, from 0 through pi/2 at resonance to pi [rad].

    **Range** steady state, r >= 0, zeta >= 0; at r = 1 without damping there is no steady state, and 0 stands there.
    **Error** exact for viscous damping.
    **Source** particular solution of the equation of motion.
    """
    r, zeta = np.asarray(frequency_ratio, float), np.asarray(damping_ratio, float)
    return np.asarray(np.arctan2(2 * zeta * r, (1 - r) * (1 + r)))


def resonance_ratio(damping_ratio: ArrayLike) -> FloatArray:
    """Frequency ratio at which the amplitude under a harmonic force is largest.

        r = (1 - 2 zeta^2)^(1/2)

    Args:
        damping_ratio: zeta [1].

    Returns:
        r; 0 from zeta = 0.707 on, where the deflection at rest is the largest [1].

    **Range** steady state, zeta >= 0.
    **Error** exact for viscous damping.
    **Source** derivative of `amplification`.
    """
    zeta = np.minimum(np.asarray(damping_ratio, float), np.sqrt(0.5))
    return np.asarray(np.sqrt(np.maximum(1 - 2 * zeta**2, 0.0)))


def peak_amplification(damping_ratio: ArrayLike) -> FloatArray:
    """Largest amplification of a harmonic force over all frequencies.

        beta = 1 / (2 zeta (1 - zeta^2)^(1/2))

    Args:
        damping_ratio: zeta [1].

    Returns:
        beta; infinite without damping, 1 from zeta = 0.707 on [1].

    **Range** steady state, zeta >= 0.
    **Error** exact for viscous damping.
    **Source** `amplification` at `resonance_ratio`.
    """
    zeta = np.minimum(np.asarray(damping_ratio, float), np.sqrt(0.5))
    with np.errstate(divide="ignore"):
        return np.asarray(1 / (2 * zeta * np.sqrt((1 - zeta) * (1 + zeta))))


def transmissibility(frequency_ratio: ArrayLike, damping_ratio: ArrayLike) -> FloatArray:
    """Amplitude of a mass over that of its harmonically moving base; the same for force passed on to a fixed base.

        T = (1 + (2 zeta r)^2)^(1/2) beta

    Args:
        frequency_ratio: r, excitation over natural frequency [1].
        damping_ratio: zeta [1].

    Returns:
        T; infinite at r = 1 without damping [1].

    **Range** steady state, r >= 0, zeta >= 0; damper between base and mass.
    **Error** exact for viscous damping.
    **Source** particular solution of m x'' + b (x - y)' + c (x - y) = 0.
    """
    r, zeta = np.asarray(frequency_ratio, float), np.asarray(damping_ratio, float)
    with np.errstate(divide="ignore"):
        return np.asarray(np.hypot(1.0, 2 * zeta * r) / np.hypot((1 - r) * (1 + r), 2 * zeta * r))


def unbalance_amplification(frequency_ratio: ArrayLike, damping_ratio: ArrayLike) -> FloatArray:
    """Amplitude of a mass with a rotating unbalance over the shift of its centre of mass, m_e e/m.

        r^2 beta(r) = beta(1/r)

    Args:
        frequency_ratio: r, rotational over natural frequency [1].
        damping_ratio: zeta [1].

    Returns:
        amplitude over m_e e/m; infinite at r = 1 without damping, 1 far above [1].

    **Range** steady state, r >= 0, zeta >= 0.
    **Error** exact for viscous damping.
    **Source** `amplification` with the force m_e e w^2.
    """
    r, zeta = np.asarray(frequency_ratio, float), np.asarray(damping_ratio, float)
    below = np.minimum(r, 1.0)
    return np.asarray(below**2 * amplification(np.where(r <= 1, r, 1 / np.maximum(r, 1.0)), zeta))
