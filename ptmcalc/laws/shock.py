"""How much more than at rest a spring is loaded by a force that comes at once, rises, or strikes.

A dynamic factor is the largest deflection over the one the same force causes at rest; without damping unless zeta is
an argument. Times are given as shares of the natural period T.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


def step_factor(damping_ratio: ArrayLike) -> FloatArray:
    """Dynamic factor of a force applied at once and kept.

        1 + exp(-pi zeta/(1 - zeta^2)^(1/2))

    Args:
        damping_ratio: zeta [1].

    Returns:
        factor, 2 without damping, 1 from zeta = 1 on [1].

    **Range** one mode from rest, zeta >= 0.
    **Error** exact for viscous damping.
    **Source** derived: first maximum of the step response, half a damped period after it.
    """
    zeta = np.minimum(np.asarray(damping_ratio, float), 1.0)
    with np.errstate(divide="ignore"):
        return np.asarray(1 + np.exp(-np.pi * zeta / np.sqrt((1 - zeta) * (1 + zeta))))


def ramp_factor(rise: ArrayLike) -> FloatArray:
    """Dynamic factor of a force that rises linearly and then stays.

        1 + |sin(pi t_r/T)| / (pi t_r/T)

    Args:
        rise: t_r/T, time of the rise over the natural period [1].

    Returns:
        factor, 2 for a step, 1 for a rise in whole periods [1].

    **Range** one undamped mode from rest; a ramp of force, that is of acceleration.
    **Error** exact; with damping lower.
    **Source** derived: superposition of the responses to the start and the end of the ramp.
    """
    return np.asarray(1 + np.abs(np.sinc(np.asarray(rise, float))))


def rectangular_pulse_factor(duration: ArrayLike) -> FloatArray:
    """Dynamic factor of a force that comes at once and goes at once.

        2 sin(pi t_p/T)      2 from t_p = T/2 on

    Args:
        duration: t_p/T, of the pulse over the natural period [1].

    Returns:
        factor [1].

    **Range** one undamped mode from rest.
    **Error** exact; with damping lower.
    **Source** derived: free vibration after the pulse; from half a period on the step response has its maximum inside.
    """
    return np.asarray(2 * np.sin(np.pi * np.minimum(np.asarray(duration, float), 0.5)))


def half_sine_pulse_factor(duration: ArrayLike) -> FloatArray:
    """Dynamic factor of a force that rises and falls as half a sine wave.

        x = t_p/T
        x <= 1/2:  4 x cos(pi x)/(1 - 4 x^2)                                  after the pulse; pi/2 at x = 1/2
        x >= 1/2:  2 x/(2 x - 1) sin(2 pi n/(2 x + 1)),  n = (2 x + 1)/4 rounded, at least 1      in the pulse

    Args:
        duration: t_p/T, of the pulse over the natural period [1].

    Returns:
        factor, at most 1.77 at t_p = 0.81 T, 1 for a long pulse [1].

    **Range** one undamped mode from rest.
    **Error** exact; with damping lower.
    **Source** derived: zeros of the speed in the pulse and amplitude after it; no 0/0 at x = 1/2 with sin(y)/y.
    """
    x = np.asarray(duration, float)
    after = 2 * np.pi * x * np.sinc(np.minimum(x, 0.5) - 0.5) / (2 * x + 1)
    beyond = np.maximum(x, 0.5)
    first = 2 * np.pi * beyond / (2 * beyond + 1) * np.sinc((2 * beyond - 1) / (2 * beyond + 1))  # n = 1
    turn = np.maximum(np.rint((2 * beyond + 1) / 4), 1.0)
    wide = np.maximum(beyond, 1.0)
    later = 2 * wide / (2 * wide - 1) * np.sin(2 * np.pi * (turn / (2 * wide + 1)))
    return np.asarray(np.where(x <= 0.5, after, np.where(turn == 1, first, later)))


def impulse_displacement(impulse: float, stiffness: float, mass: float) -> float:
    """Largest deflection after a short blow.

        x = I / (m w_0) = I / (c m)^(1/2)

    Args:
        impulse: I, force times time [N*s].
        stiffness: c [N/m].
        mass: m [kg].

    Returns:
        x [m].

    **Range** a blow much shorter than the natural period, undamped, from rest.
    **Error** too large by the share (pi t_p/T)^2/6 for a rectangular pulse.
    **Source** momentum I = m v, then energy m v^2 = c x^2.
    """
    return impulse / (math.sqrt(stiffness) * math.sqrt(mass))


def impact_force_unloaded(weight: float, stiffness: float, mass: float, speed: float) -> float:
    """Largest force of a spring that a moving mass runs onto under its own weight.

        F = Q + (Q^2 + c m v^2)^(1/2)

    Args:
        weight: Q, steady force that presses the mass on, without force in the spring at first [N].
        stiffness: c [N/m].
        mass: m [kg].
        speed: v, at first contact [m/s].

    Returns:
        F; 2 Q for v = 0 [N].

    **Range** no damping, Q >= 0.
    **Error** exact for that model.
    **Source** energy: m v^2/2 + Q x = c x^2/2.
    """
    return weight + math.hypot(weight, speed * math.sqrt(stiffness) * math.sqrt(mass))


def impact_force_preloaded(weight: float, stiffness: float, mass: float, speed: float) -> float:
    """Largest force of a spring that already carries a mass when it gets a speed.

        F = Q + v (c m)^(1/2)

    Args:
        weight: Q, force of the spring in equilibrium [N].
        stiffness: c [N/m].
        mass: m [kg].
        speed: v, in the equilibrium position [m/s].

    Returns:
        F [N].

    **Range** no damping.
    **Error** exact for that model; with damping lower by about delta/4 of the dynamic part, delta the decrement.
    **Source** energy about the equilibrium.
    """
    return weight + speed * math.sqrt(stiffness) * math.sqrt(mass)
