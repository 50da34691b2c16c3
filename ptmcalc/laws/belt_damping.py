"""Internal damping of a belt or chain: how far it moves the frequency of a free wave in the complex plane."""

import math


def kelvin_voigt_change(frequency: float, retardation_time: float) -> float:
    """Relative change of a wave's complex frequency in a Kelvin-Voigt belt, S = EA (e + t e'): its damping ratio.

        d = |EA*/EA - 1|/2 = w t/2,   EA* = EA (1 + i w t)

    Args:
        frequency: w, circular frequency of the wave [rad/s].
        retardation_time: t, viscosity over stiffness [s].

    Returns:
        d [1].

    **Range** any; above 1 the wave no longer swings.
    **Error** the damping ratio exactly, for a mode of a loop without other damping.
    **Source** derived from the complex modulus.
    """
    return frequency * retardation_time / 2


def hysteretic_change(loss_factor: float) -> float:
    """Relative change of a wave's complex frequency with hysteretic damping, the same at every frequency.

        d = |EA*/EA - 1|/2 = g/2,   EA* = EA (1 + i g)

    Args:
        loss_factor: g, energy lost per radian over the largest stored one [1].

    Returns:
        d, the damping ratio of every mode [1].

    **Range** light damping, vibration that goes on: in time it has no law.
    **Error** of second order in d.
    **Source** derived from the complex modulus.
    """
    return loss_factor / 2


def zener_change(frequency: float, relaxation_time: float, stiffening: float) -> float:
    """Relative change of a wave's complex frequency in a Zener belt (standard linear solid), damped and stiffened.

        d = |EA*/EA - 1|/2 = g w t/(2 sqrt(1 + (w t)^2)),   EA* = EA (1 + g i w t/(1 + i w t))

    Args:
        frequency: w, circular frequency of the wave [rad/s].
        relaxation_time: t, of the second spring's stress [s].
        stiffening: g, second spring over the first [1].

    Returns:
        d; the damping ratio for slow waves, half the stiffening for fast ones [1].

    **Range** any.
    **Error** of second order in d.
    **Source** derived from the complex modulus; C. Zener, "Elasticity and Anelasticity of Metals" (1948).
    """
    x = frequency * relaxation_time
    return stiffening * x / (2 * math.hypot(1.0, x))
