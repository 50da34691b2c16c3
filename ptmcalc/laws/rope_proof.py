"""Proofs of competence of running wire ropes by EN 13001-3-2:2014: static strength and fatigue.

The standard was not at hand. Formulas and numbers are quoted from engineering knowledge and to be compared with its
text: every number is an input of the machine's file.
"""

import math
from collections.abc import Mapping, Sequence
from types import MappingProxyType

REFERENCE_BENDINGS = 5e5
"""Number of bendings w_D to which the fatigue strength of a rope refers [1] (EN 13001-3-2:2014, to be compared). A
larger number raises the resistance by its cube root."""
FATIGUE_RESISTANCE = 7.0
"""Resistance factor gamma_rf of the fatigue proof [1] (EN 13001-3-2:2014, to be compared)."""
_FLOOR, _BASE, _SLOPE, _EXPONENT, _POLE = 2.07, 1.35, 5.0, 0.8, 4.0
"""Numbers of the resistance factor gamma_rb [1] (EN 13001-3-2:2014, to be compared): its minimum, and those of its
formula. The formula reaches the minimum at D/d = 20."""
PARTIAL: Mapping[str, float] = MappingProxyType({"A": 1.34, "B": 1.22, "C": 1.10})
"""Partial safety factor gamma_p of the hoist load by load combination [1] (EN 13001-2, to be compared)."""
TERMINATION: Mapping[str, float] = MappingProxyType({"socket": 1.0, "ferrule": 0.9, "wedge": 0.8})
"""Strength of a rope termination relative to the rope [1] (EN 13411, to be compared with the data sheet)."""
SHEAVE, REVERSED, DRUM = 2, 4, 1
"""Bendings that a lift counts by EN 13001-3-2:2014, to be compared: on and off a sheave, the same to the other side, on
and off the drum."""


def static_resistance(bend_ratio: float) -> float:
    """Resistance factor of the static strength of a bent rope.

        gamma_rb = max(2.07, 1.35 + 5/((D/d)^0.8 - 4))

    Args:
        bend_ratio: D/d, the smallest of sheaves and drum [1].

    Returns:
        gamma_rb; infinite up to D/d = 5.66 [1].

    **Range** D/d above 5.66.
    **Error** none: a rule.
    **Source** EN 13001-3-2:2014, to be compared with the standard.
    """
    bent = bend_ratio**_EXPONENT - _POLE
    return max(_FLOOR, _BASE + _SLOPE / bent) if bent > 0 else math.inf


def history(shares: Sequence[float], forces: Sequence[float], bendings: float, reference: float) -> float:
    """Rope force history parameter.

        s_r = k_r nu_r,   k_r = sum u_i (F_i/F_max)^3,   nu_r = w_tot/w_D

    Args:
        shares: u_i, of the bendings with each force; together 1 [1].
        forces: F_i/F_max [1].
        bendings: w_tot, of one rope in its design life [1].
        reference: w_D [1].

    Returns:
        s_r [1].

    **Range** forces of at most F_max.
    **Error** none: a definition.
    **Source** EN 13001-3-2:2014, to be compared with the standard.
    """
    return math.fsum(u * force**3 for u, force in zip(shares, forces, strict=True)) * bendings / reference


def fatigue_resistance(breaking_force: float, factor: float, resistance: float, parameter: float) -> float:
    """Limit design rope force of the fatigue proof.

        F_Rd = F_u f_f/(gamma_rf s_r^(1/3))

    Args:
        breaking_force: F_u [N].
        factor: f_f, product of the factors of the rope drive [1].
        resistance: gamma_rf [1].
        parameter: s_r of `history` [1].

    Returns:
        F_Rd; infinite without bendings [N].

    **Range** s_r > 0.
    **Error** none: a rule. The number of bendings is a design number, not the attainable one (Anders and Schmidt, TU
        Dresden, FE-TL-35, 2015).
    **Source** EN 13001-3-2:2014, to be compared with the standard.
    """
    return breaking_force * factor / (resistance * parameter ** (1 / 3)) if parameter > 0 else math.inf
