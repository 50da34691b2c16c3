"""Grip of a belt on a drum (Euler, Eytelwein), with the centrifugal tension of the bare belt.

Everything is written with exp(-mu alpha) or expm1, so that 400 turns do not overflow and a wrap of 1e-12 keeps
its digits.
"""

import math

import numpy as np

from ptmcalc.laws.quotient import FloatArray, over


def slip_utilisation(
    tight: float | FloatArray, slack: float | FloatArray, centrifugal: float | FloatArray, exponent: float
) -> FloatArray:
    """Share of the drum's grip that is used; the belt slips at 1.

        U = (S_t - rho v^2) / ((S_s - rho v^2) exp(mu alpha))

    Args:
        tight: S_t, tension of the tighter side [N].
        slack: S_s, tension of the slacker side [N].
        centrifugal: rho v^2, rho the mass per length of the bare belt: load and idlers are not on the drum [N].
        exponent: mu alpha, friction coefficient times wrap angle in radians [1].

    Returns:
        U; infinite where the slack side has no tension left [1].

    **Range** a flexible belt, friction independent of pressure and speed.
    **Error** exact for that model; the friction coefficient itself is known to 20 % at best.
    **Source** Euler-Eytelwein; centrifugal term from the equilibrium of the moving belt element.
    """
    return over((tight - centrifugal) * np.exp(-exponent), slack - centrifugal)


def slip_reserve_force(tight: float | FloatArray, slack: float | FloatArray, exponent: float) -> FloatArray:
    """Reserve of friction force at the drum: what it can transmit over what it must.

        k = S_s (exp(mu alpha) - 1) / (S_t - S_s)

    Args:
        tight: S_t, tension of the tighter side [N].
        slack: S_s, tension of the slacker side [N].
        exponent: mu alpha [1].

    Returns:
        k; infinite where nothing is transmitted, 0 where the slack side has no tension left [1].

    **Range** slow belts: the definition of handbooks leaves out the centrifugal tension, so that a belt slips
    (`slip_utilisation` reaches 1) at k = S_s/(S_s - rho v^2), a little above 1.
    **Error** exact for that definition.
    **Source** reserve of friction forces k_T, lecture notes Kramatorsk 2007, with the usual reading
    S_off (exp(mu alpha) - 1) >= k_T F.
    """
    with np.errstate(over="ignore"):
        reserve = over(slack * np.expm1(exponent), tight - slack)
    return np.where(np.greater(slack, 0), reserve, 0.0)


def slip_reserve_ratio(ratio: float, exponent: float) -> float:
    """Reserve of friction force where the tensions have a ratio.

        k = (1 - exp(-mu alpha)) / (r - exp(-mu alpha)),   r = S_t/S_s exp(-mu alpha)

    Args:
        ratio: r, the utilisation without centrifugal tension [1].
        exponent: mu alpha [1].

    Returns:
        k; infinite where nothing is transmitted, 0 where the ratio is infinite [1].

    **Range** as `slip_reserve_force`.
    **Error** exact.
    **Source** `slip_reserve_force`, divided by S_s.
    """
    if math.isinf(ratio):
        return 0.0
    pull = ratio - math.exp(-exponent)
    return -math.expm1(-exponent) / pull if pull > 0 else math.inf


def slip_ratio(reserve: float, exponent: float) -> float:
    """The inverse of `slip_reserve_ratio`.

        r = exp(-mu alpha) + (1 - exp(-mu alpha))/k

    Args:
        reserve: k [1].
        exponent: mu alpha [1].

    Returns:
        r; infinite for no reserve [1].

    **Range** k at least 0.
    **Error** exact.
    **Source** `slip_reserve_ratio`.
    """
    return math.exp(-exponent) - math.expm1(-exponent) / reserve if reserve > 0 else math.inf
