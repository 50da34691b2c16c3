"""Fatigue of a chain's plates: how often, and how far the stress swings."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


def revolutions(life: ArrayLike, chain_length: float, chain_speed: float) -> FloatArray:
    """Revolutions of a chain in a life: each link swings once between slack and tight tension in each.

        N = T V/L

    Args:
        life: T, running time [s].
        chain_length: L, of the whole chain [m].
        chain_speed: V [m/s].

    Returns:
        N [1].

    **Range** one drive; each further drive or load step on the route adds a swing of its own.
    **Error** exact.
    **Source** definition.
    """
    return np.asarray(np.asarray(life, float) * (chain_speed / chain_length))


def tooth_passes(life: ArrayLike, pitch: float, chain_speed: float) -> FloatArray:
    """Teeth that pass in a life: the polygon force swings once in each.

        N = T V/p

    Args:
        life: T, running time [s].
        pitch: p [m].
        chain_speed: V [m/s].

    Returns:
        N; a link takes part in as many as the share of the route on which the force swings [1].

    **Range** one harmonic that leads; higher ones swing more often and less.
    **Error** exact.
    **Source** definition.
    """
    return np.asarray(np.asarray(life, float) * (chain_speed / pitch))


def stress_amplitude(largest: ArrayLike, smallest: ArrayLike, section: float) -> FloatArray:
    """Amplitude of the nominal stress in the plates.

        s_a = (S_max - S_min)/(2 A)

    Args:
        largest: S_max, tension [N].
        smallest: S_min, tension [N].
        section: A, of the plates of all strands at their narrowest place [m^2].

    Returns:
        s_a [N/m^2].

    **Range** nominal stress: the notch at the pin belongs to the permissible amplitude.
    **Error** exact.
    **Source** definition.
    """
    return np.asarray((np.asarray(largest, float) - np.asarray(smallest, float)) / (2 * section))


def fatigue_utilisation(amplitude: ArrayLike, mean: ArrayLike, limit: float, strength: float) -> FloatArray:
    """Part of the permissible stress amplitude that is used, with the mean stress counted by Goodman's line.

        U = s_a/s_lim + s_m/R_m

    Args:
        amplitude: s_a, of `stress_amplitude` [N/m^2].
        mean: s_m, mean nominal stress; 0 where the limit already holds for it [N/m^2].
        limit: s_lim, permissible amplitude for the number of swings, without mean stress [N/m^2].
        strength: R_m, of the plates; infinite to leave the mean stress out [N/m^2].

    Returns:
        U; up to 1 the plates last [1].

    **Range** s_m >= 0; for a limit measured at the machine's mean tension give R_m infinite.
    **Error** Goodman's line lies on the safe side for steel.
    **Source** J. Goodman, "Mechanics Applied to Engineering" (1899).
    """
    return np.asarray(np.asarray(amplitude, float) / limit + np.asarray(mean, float) / strength)
