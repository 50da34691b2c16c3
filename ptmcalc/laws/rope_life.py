"""Number of bendings that a running wire rope endures until it is discarded or breaks.

K. Feyrer, *Wire Ropes: Tension, Endurance, Reliability*, 2nd edition, Springer 2015, chapter 3.4 (method Stuttgart),
and VDI 2358. The form and the endurance factors are confirmed by a public excerpt of the book. The constants b_0 to b_3
depend on the rope and on the number that is asked for (mean or 10 %, breaking or discarding): they are an input with a
source.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

_STRENGTH = 1770e6
"""Nominal wire strength to which the constants refer [N/m^2]; a definition of the book."""
_LARGEST = 300.0
"""Decimal logarithm of a number of bendings above which it is reported as infinite; a numerical choice below the
largest floating point number, 1e308."""
_SHORTEST = 10.0
"""Bending length relative to the diameter below which the factor stays constant [1]. An engineering choice: the formula
grows without limit towards 2.5; a smaller value lets short bending lengths endure more."""
CORE_FACTOR: Mapping[str, Mapping[int, float]] = MappingProxyType(
    {
        "FC": MappingProxyType({8: 1.0, 6: 0.94}),
        "IWRC": MappingProxyType({8: 1.0, 6: 0.81}),
        "PWRC": MappingProxyType({8: 1.86, 6: 1.51}),
        "ESWRC": MappingProxyType({8: 2.05, 6: 1.66}),
        "EFWRC": MappingProxyType({8: 1.06, 6: 0.86}),
    }
)
"""Endurance factor f_C by core and number of strands [1]: fibre core, independent and parallel steel core, steel core
covered by plastic and by fibre (Feyrer 2015, table 3.14a; confirmed by a public excerpt)."""


@dataclass(frozen=True, slots=True)
class Constants:
    """Constants of the number of bendings of one kind of rope."""

    b0: float
    b1: float
    b2: float
    b3: float


def diameter_factor(diameter: float) -> float:
    """Endurance factor of the rope diameter.

        f_d = 0.52/((d/16 mm)^0.3 - 0.48)

    Args:
        diameter: d [m].

    Returns:
        f_d; 1 at 16 mm [1].

    Raises:
        ValueError: at 1.4 mm and below, where the formula has a pole.

    **Range** ropes of about 3 to 60 mm.
    **Error** that of the regression.
    **Source** Feyrer 2015, table 3.14a.
    """
    below = (diameter / 16e-3) ** 0.3 - 0.48
    if below <= 0:
        raise ValueError("the factor is not defined for ropes of 1.4 mm and less")
    return float(0.52 / below)


def length_factor(length: float, diameter: float) -> float:
    """Endurance factor of the bending length.

        f_L = 1.49/(2.49 - ((l/d - 2.5)/57.5)^(-0.14)),   l >= 10 d

    Args:
        length: l, of the piece of rope that runs over the sheave [m].
        diameter: d [m].

    Returns:
        f_L; 1 at l = 60 d, 0.6 for very long pieces [1].

    **Range** l >= 10 d; shorter pieces have the value at 10 d.
    **Error** that of the regression.
    **Source** Feyrer 2015, table 3.14a.
    """
    ratio = max(length / diameter, _SHORTEST)
    return float(1.49 / (2.49 - ((ratio - 2.5) / 57.5) ** -0.14))


def bending_number(
    force: float, diameter: float, bend_ratio: float, strength: float, constants: Constants, factor: float
) -> float:
    """Number of simple bendings, straight - bent - straight, that a rope endures.

        lg N = b_0 + (b_1 + b_3 lg(D/d)) (lg(S/d^2) - 0.4 lg(R_0/1770)) + b_2 lg(D/d) + lg f

    with S in N, d in mm and R_0 in N/mm^2.

    Args:
        force: S, of the rope [N].
        diameter: d [m].
        bend_ratio: D/d, D to the centre of the rope [1].
        strength: R_0, nominal strength of the wires [N/m^2].
        constants: b_0 to b_3 of the rope.
        factor: f = f_d f_L f_C [1].

    Returns:
        N; infinite without a force [1].

    **Range** 10 <= D/d <= 100, forces below the Donandt force.
    **Error** that of the regression: a factor of about 1.5 for single ropes; constants of the 10 % number cover it.
    **Source** Feyrer 2015, eq. 3.55.
    """
    if force <= 0:
        return math.inf
    bend = math.log10(bend_ratio)
    stress = math.log10(force / (diameter * 1e3) ** 2) - 0.4 * math.log10(strength / _STRENGTH)
    slope = constants.b1 + constants.b3 * bend
    logarithm = constants.b0 + slope * stress + constants.b2 * bend + math.log10(factor)
    return math.inf if logarithm > _LARGEST else float(10**logarithm)


def reversed_number(number: float, factor: float, exponent: float) -> float:
    """Number of bendings in alternating directions.

        N_rev = a_1 N^a_2, at most N

    Args:
        number: N, of simple bendings [1].
        factor: a_1 [1].
        exponent: a_2 [1].

    Returns:
        N_rev [1].

    **Range** constants of the same rope and the same unit of N.
    **Error** that of the regression.
    **Source** Feyrer 2015, chapter 3.4.
    """
    return number if math.isinf(number) else min(number, factor * number**exponent)


WIRE_BREAKS: Mapping[str, tuple[float, float, float, float]] = MappingProxyType(
    {
        "FC-8x19": (18.0, 1.74e-4, 1550.0, 0.026),
        "WRC-8x19": (33.3, 1.84e-4, 1830.0, 0.0447),
        "FC-8x36": (29.0, 2.71e-4, 2400.0, 0.0403),
        "WRC-8x36": (44.5, 2.22e-4, 2200.0, 0.0536),
        "18x7": (14.0, 1.6e-4, -350.0, 0.035),
        "34x7": (20.0, 2.3e-4, -500.0, 0.05),
    }
)
"""Constants g_0 to g_3 of the wire breaks at discard by the rope (Feyrer 2015, chapter 3.4; numbers confirmed, their
signs to be compared with the book)."""


def wire_breaks(force: float, diameter: float, bend_ratio: float, rope: str) -> float:
    """Visible wire breaks on 30 diameters of a rope that is due to be discarded.

        B = g_0 - g_1 (S/d^2)^2 - g_2 (d/D)^2 - g_3 (S/d^2)^2 (d/D)^2, at least 0

    with S in N and d in mm.

    Args:
        force: S [N].
        diameter: d [m].
        bend_ratio: D/d [1].
        rope: a name of `WIRE_BREAKS`.

    Returns:
        B; 13.4 for FC-8x19 at S/d^2 = 100 N/mm^2 and D/d = 25 [1].

    **Range** ordinary lay, steel sheaves.
    **Error** that of the regression.
    **Source** Feyrer 2015, chapter 3.4; signs of the constants to be compared.
    """
    g0, g1, g2, g3 = WIRE_BREAKS[rope]
    stress, bend = (force / (diameter * 1e3) ** 2) ** 2, bend_ratio**-2
    return max(g0 - g1 * stress - g2 * bend - g3 * stress * bend, 0.0)


def discard_force(diameter: float, bend_ratio: float, rope: str, breaks: float) -> float:
    """Largest rope force at which a rope shows enough wire breaks before it breaks.

        S_G = d^2 sqrt((g_0 - g_2 (d/D)^2 - B)/(g_1 + g_3 (d/D)^2))

    Args:
        diameter: d [m].
        bend_ratio: D/d [1].
        rope: a name of `WIRE_BREAKS`.
        breaks: B, wire breaks on 30 d that an inspection finds, 8 to 10 [1].

    Returns:
        S_G; 0 where no force gives so many breaks [N].

    **Range** as `wire_breaks`, of which it is the inverse.
    **Error** that of the regression.
    **Source** Feyrer 2015, chapter 3.4.
    """
    g0, g1, g2, g3 = WIRE_BREAKS[rope]
    bend = bend_ratio**-2
    left = (g0 - g2 * bend - breaks) / (g1 + g3 * bend)
    return (diameter * 1e3) ** 2 * math.sqrt(left) if left > 0 else 0.0
