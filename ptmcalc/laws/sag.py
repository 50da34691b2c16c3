"""Sag of the belt between idlers, and how it softens the belt."""

from ptmcalc.laws.quotient import FloatArray, over

DEEPEST = 0.10
"""Sag over span at which the shallow parabola ends, and with it every law here [1]."""


def sag_ratio(span_weight: float, tension: float | FloatArray) -> FloatArray:
    """Sag of a span over its length.

        h = w l / (8 S)

    Args:
        span_weight: w l, weight of belt and load on one idler pitch [N].
        tension: S, belt tension between the idlers, its horizontal part [N].

    Returns:
        h; infinite where the belt has no tension [1].

    **Range** shallow parabola, h below 0.1; a belt without bending stiffness.
    **Error** 4/3 h^2 of the value against the catenary: 0.013 % at 1 %, 1.3 % at 10 %; for the tension at the idler,
    which carries half the span besides, 28/3 h^2: 0.09 % at 1 %, 9 % at 10 %.
    **Source** equilibrium of the parabolic span; limits of 1 to 2 % in DIN 22101.
    """
    return over(span_weight, 8 * tension)


def tension_at_sag(span_weight: float, ratio: float) -> float:
    """Tension at which a span sags by so much of its length.

        S = w l / (8 h)

    Args:
        span_weight: w l, weight of belt and load on one idler pitch [N].
        ratio: h, sag over span [1].

    Returns:
        S [N].

    **Range** as `sag_ratio`.
    **Error** as `sag_ratio`.
    **Source** `sag_ratio` solved for the tension.
    """
    return span_weight / (8 * ratio)


def softening(stiffness: float, span_weight: float, tension: float | FloatArray) -> FloatArray:
    """How much more a sagging span gives than the belt alone.

        f = EA (w l)^2 / (12 S^3),   EA_eff = EA / (1 + f)

    Args:
        stiffness: EA, tensile stiffness of the belt [N].
        span_weight: w l, weight of belt and load on one idler pitch [N].
        tension: S, belt tension [N].

    Returns:
        f; infinite where the belt has no tension [1].

    **Range** shallow parabola; changes of tension slow against the transverse oscillation of a span.
    **Error** as `sag_ratio`, and tangential: valid for a small change of tension about S.
    **Source** H.-J. Ernst, "Der E-Modul von Seilen unter Beruecksichtigung des Durchhanges", Bauingenieur 40 (1965).
    """
    return over(stiffness * span_weight**2, 12 * tension**3)
