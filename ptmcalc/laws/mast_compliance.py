"""How far the column of a stacker crane gives at its tip: column, root, girders, and the weight at its tip.

Source of the stiffness: N. Yu. Dorokhov, "Dynamics of hoisting and conveying machines", lecture notes, Kramatorsk 2007
(stacker cranes). The column of length l hangs from a trolley on two girders or stands on a bottom carriage.
"""

import math
from dataclasses import dataclass

from ptmcalc.laws.mast import HANGING, STANDING

SUPPORTED, CLAMPED = "supported", "clamped"
FREE, BRAKED = "free", "braked"
_NEAR = 0.5
_TERMS = 12


@dataclass(frozen=True, slots=True)
class Compliance:
    """Displacement of the tip per force at the tip, by what gives [m/N]: the column bends, its root turns, its root
    shifts."""

    bending: float
    rotation: float
    translation: float

    @property
    def total(self) -> float:
        return self.bending + self.rotation + self.translation

    @property
    def stiffness(self) -> float:
        return 1 / self.total

    @property
    def rotation_share(self) -> float:
        return self.rotation / self.total

    @property
    def translation_share(self) -> float:
        return self.translation / self.total


def column_bending(length: float, elasticity: float, second_moment: float) -> float:
    """Displacement of the tip of a column with a rigid root per force at the tip.

        d = l^3/(3 E J)

    Args:
        length: l, from the neutral axis of what holds it to the tip [m].
        elasticity: E [N/m^2].
        second_moment: J, of the column in the plane of bending [m^4].

    Returns:
        d [m/N].

    **Range** an even column, small deflections, no shear.
    **Error** exact for that column.
    **Source** bending of beams.
    """
    return length / elasticity * length * (length / second_moment) / 3


def bridge_travel_compliance(
    length: float,
    elasticity: float,
    column_moment: float,
    span: float,
    girder_vertical: float,
    girder_horizontal: float,
    gauge: float,
    place: float,
    ends: str,
    wheels: str,
) -> Compliance:
    """How far the tip of a column gives along the travel of a bridge with two girders.

        column      l^3/(3 E J_c)
        root turns  2 l^2 u_v/B^2    a couple of forces l/B on the girders; in the middle l^2 L^3/(24 E J_v B^2)
        root shifts u_h/2            both girders sideways; in the middle L^3/(96 E J_h)

    u, the deflection of a girder under a unit force x beside a support, y = L - x:

        supported: x^2 y^2/(3 E J L)         clamped: x^3 y^3/(3 E J L^3)
        sideways with braked wheels, which keep the trolley from turning with the girders:
        supported: x^3 y^3/(3 E J (x^3 + y^3))     clamped: x^3 y^3/(12 E J (x^3 + y^3))

    Args:
        length: l, from the neutral axis of the girders to the tip [m].
        elasticity: E [N/m^2].
        column_moment: J_c [m^4].
        span: L [m].
        girder_vertical: J_v, of one girder for vertical loads [m^4].
        girder_horizontal: J_h, of one girder for horizontal loads [m^4].
        gauge: B, of the trolley, between the girders [m].
        place: x, of the column from a support, L/2 the softest [m].
        ends: `supported`, or `clamped` by stiff end carriages in both planes.
        wheels: of the trolley along the girders: `free` to roll, or `braked` on girders that do not stretch.

    Returns:
        parts [m/N].

    **Range** 0 < x < L, a rigid trolley, a girder under either of its rails; torsion of the girders left out.
    **Error** exact for that frame; with free wheels at midspan within 1e-4 of a frame of finite elements.
    **Source** lecture notes Kramatorsk 2007 (midspan, supported, lost formula rebuilt from its legend); derived for
    other places, ends and wheels: two beam elements that meet under the trolley.

    Raises:
        ValueError: for other ends or wheels.
    """
    if wheels not in (FREE, BRAKED):
        raise ValueError(f"the wheels of a trolley are {FREE} or {BRAKED}")
    down = _girder_sag(span, place, ends, turns=True) / (elasticity * girder_vertical)
    across = _girder_sag(span, place, ends, turns=wheels == FREE) / (elasticity * girder_horizontal)
    arm = length / gauge
    return Compliance(column_bending(length, elasticity, column_moment), 2 * arm * arm * down, across / 2)


def trolley_travel_compliance(
    length: float,
    elasticity: float,
    column_moment: float,
    span: float,
    girder_vertical: float,
    place: float,
    ends: str,
) -> Compliance:
    """How far the tip of a column gives along the travel of its trolley on two girders.

        column      l^3/(3 E J_c)
        root turns  l^2 r/2   both girders turned by the moment l; in the middle l^2 L/(24 E J_v)

    r, the slope of a girder under a unit moment x beside a support, y = L - x:

        supported: (x^3 + y^3)/(3 E J L^2)      clamped: x y (x^3 + y^3)/(E J L^4)

    Args:
        length: l, from the neutral axis of the girders to the tip [m].
        elasticity: E [N/m^2].
        column_moment: J_c [m^4].
        span: L [m].
        girder_vertical: J_v, of one girder for vertical loads [m^4].
        place: x, of the column from a support; in the middle a girder turns least [m].
        ends: `supported`, or `clamped` by stiff end carriages.

    Returns:
        parts [m/N].

    **Range** 0 < x < L, a trolley whose wheel base is small beside x.
    **Error** exact for that frame.
    **Source** derived: slope of a beam under a moment.

    Raises:
        ValueError: for other ends.
    """
    y = span - place
    p, q = place / span, y / span
    cubes = p**3 + q**3
    if ends == SUPPORTED:
        slope = span * cubes / 3
    elif ends == CLAMPED:
        slope = span * p * q * cubes
    else:
        raise ValueError(f"the ends of a girder are {SUPPORTED} or {CLAMPED}")
    turned = slope / (elasticity * girder_vertical)
    return Compliance(column_bending(length, elasticity, column_moment), length * length * turned / 2, 0.0)


def _girder_sag(span: float, place: float, ends: str, turns: bool) -> float:
    """Deflection under a unit force at the place, times E J; the section there turns, or is kept from it."""
    p, q = place / span, (span - place) / span
    product = (p * q) ** 3
    if ends not in (SUPPORTED, CLAMPED):
        raise ValueError(f"the ends of a girder are {SUPPORTED} or {CLAMPED}")
    cube = span * span * span
    if not turns:
        return cube * product / ((p**3 + q**3) * (3 if ends == SUPPORTED else 12))
    return cube * ((p * q) ** 2 if ends == SUPPORTED else product) / 3


def weighted_tip_compliance(
    length: float, flexural_stiffness: float, root_stiffness: float, tip_weight: float, attitude: str
) -> float:
    """Displacement of the tip of a column per force across it, under a weight at its tip.

        standing: d = (t/(1 - t P/k) - l)/P,   t = tan(q l)/q      hanging: d = (l - t/(1 + t P/k))/P,   t = tanh(q l)/q

    q = (P/(E J))^(1/2).

    Args:
        length: l [m].
        flexural_stiffness: E J [N*m^2].
        root_stiffness: k, of the root against turning, infinite for a rigid one [N*m].
        tip_weight: P [N].
        attitude: `hanging` or `standing`.

    Returns:
        d; l^3/(3 E J) + l^2/k without weight [m/N].

    **Range** a column without weight of its own.
    **Error** exact; freed of the difference of two large numbers for small weights.
    **Source** derived: beam under axial force (S. Timoshenko, Theory of elastic stability).

    Raises:
        ValueError: for another attitude, or a weight that buckles the column.
    """
    if attitude not in (HANGING, STANDING):
        raise ValueError(f"a mast is {HANGING} or {STANDING}")
    z = length * math.sqrt(tip_weight / flexural_stiffness)
    bend = length / flexural_stiffness * length * length
    if attitude == HANGING:
        tangent = math.tanh(z) / z if z > 0 else 1.0
        turned = length / root_stiffness * tangent
        return (bend * _hanging_excess(z) + length * turned) / (1 + tip_weight * turned)
    if z >= math.pi / 2:
        raise ValueError("the weight buckles the mast")
    tangent = math.tan(z) / z if z > 0 else 1.0
    turned = length / root_stiffness * tangent
    left = 1 - tip_weight * turned
    if left <= 0:
        raise ValueError("the weight buckles the mast with its root")
    return (bend * _standing_excess(z) + length * turned) / left


def _standing_excess(z: float) -> float:
    """(tan z - z)/z^3."""
    if z > _NEAR:
        return (math.tan(z) - z) / z**3
    sine, cosine = _excess_series(z, -1.0)
    return sine / cosine


def _hanging_excess(z: float) -> float:
    """(z - tanh z)/z^3."""
    if z > _NEAR:
        return (1 - math.tanh(z) / z) / z / z
    sine, cosine = _excess_series(z, 1.0)
    return sine / cosine


def _excess_series(z: float, sign: float) -> tuple[float, float]:
    """(sin z - z cos z)/z^3 and cos z, or those of sinh and cosh with the sign turned."""
    difference = cosine = 0.0
    for k in reversed(range(_TERMS)):
        power = (sign * z * z) ** k
        difference += power * (2 * k + 2) / math.factorial(2 * k + 3)
        cosine += power / math.factorial(2 * k)
    return difference, cosine
