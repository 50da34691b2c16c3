"""Horizontal curves of a belt conveyor: how far the belt drifts on its idlers, and what the curve adds at its edges.

**Balance.** In a curve of the radius R a belt of the tension T is pulled inward, to the centre, by T/R per length.
Nothing holds it but the idlers. Across its width the belt is a ribbon that slides along the profile of its rolls; y is
its drift, positive inward. A part of the weight q dw climbs where the belt moves inward: by sin(lambda + beta) on the
inner wing roll, by sin(beta) on the middle roll, and it sinks by sin(lambda - beta) on the outer wing roll; lambda is
the troughing angle, beta the banking, which lifts the inner side. The weight thus resists by

    F(y) = q_i(y) sin(lambda + beta) + q_m(y) sin(beta) - q_o(y) sin(lambda - beta)

with the weights q_i, q_m, q_o of belt and load on the three rolls. A drift inward brings more of both on the inner wing
roll: F grows with y, and the belt comes to rest where F(y) = p, the inward force per length. Rolls that stand square to
the belt resist no lateral creep of a running belt for long: friction only delays the drift.

**Three rules.** How the wings pass their force on at the edges between the rolls is not settled, and published rules
differ. All three are here:

    ribbon   p as it acts along the profile:  (p/B) (b_i cos(lambda + beta) + l cos(beta) + b_o cos(lambda - beta));
             exact for a ribbon without bending stiffness, which passes its lateral force round the edges undiminished
    part_2   p in full                        Grimmer and Kessler, part II, without load factors of the rolls
    part_1   p in full, and the force of the wings by cos(lambda) smaller     Grimmer and Kessler, part I

The belt drifts least by `ribbon` and most by `part_1` where it drifts inward.
"""

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

RULES = ("part_2", "ribbon", "part_1")
"""The rules of the balance; the first one is the middle one."""
_CLOSE, _ROUNDS = 1e-12, 100
"""Change of a root relative to the width at which a search ends, and its most rounds; numerical choices. A larger
change is less exact; fewer rounds may end before it."""


def inward_force(tension: float, line_mass: float, speed: float, radius: float) -> float:
    """Force to the centre of a curve by which a belt presses on its idlers.

        p = (T - rho v^2)/R

    Args:
        tension: T, of the belt [N].
        line_mass: rho, of what moves along [kg/m].
        speed: v [m/s].
        radius: R, of the curve [m].

    Returns:
        p [N/m].

    **Range** a curve longer than a few idler pitches.
    **Error** exact for a belt on an arc.
    **Source** equilibrium of an element; T/R in K.-J. Grimmer and F. Kessler (1987), rho v^2/R by Newton's law.
    """
    return (tension - line_mass * speed**2) / radius


def bed_width(middle: float, trough_angle: float, area: float, surcharge: float) -> float:
    """Width of the belt that the load covers, measured along the belt.

        A = (l + 2 e cos(lambda))^2 tan(theta)/6 + (l + e cos(lambda)) e sin(lambda),   b = l + 2 e
        A = b^2 tan(theta)/6   on the middle roll only

    Args:
        middle: l, of the belt on the middle roll [m].
        trough_angle: lambda [rad].
        area: A, cross-section of the load [m^2].
        surcharge: theta, slope of the load at its edges [rad].

    Returns:
        b [m].

    **Range** a load in the middle of the belt; theta or lambda above 0.
    **Error** exact for a parabolic surface.
    **Source** cross-section of ISO 5048:1989 solved for the width.
    """
    heap, sine, cosine = math.tan(surcharge), math.sin(trough_angle), math.cos(trough_angle)
    left = area - middle**2 * heap / 6
    if left <= 0:
        return math.sqrt(6 * area / heap) if area > 0 else 0.0
    square = cosine * (2 * cosine * heap / 3 + sine)
    linear = middle * (2 * cosine * heap / 3 + sine)
    return middle + 4 * left / (linear + math.sqrt(linear**2 + 4 * square * left))


def drift(
    width: float,
    middle: float,
    trough_angle: float,
    banking: float,
    belt_weight: float,
    load_weight: float,
    load_area: float,
    surcharge: float,
    belt_pull: float,
    load_push: float,
    rule: str,
) -> float:
    """Drift of a belt on its idlers in a horizontal curve, positive to the inner side.

        F(y) = p,   F, p as in the module, of belt and load together;   p_load = -rho_load v^2/R

    The load lies on the belt and moves with it: its weight per width is that of the cross-section in the middle.

    Args:
        width: B, of the belt [m].
        middle: l, of the middle roll; 0 for two rolls [m].
        trough_angle: lambda [rad].
        banking: beta, by which the inner side of the idlers is lifted [rad].
        belt_weight: weight of the belt per length, square to its slope [N/m].
        load_weight: the same of the load; 0 for an empty belt [N/m].
        load_area: cross-section of the load [m^2].
        surcharge: theta, slope of the load at its edges [rad].
        belt_pull: inward force of the belt, `inward_force` with its own mass [N/m].
        load_push: rho v^2/R of the load, outward [N/m].
        rule: `ribbon`, `part_2` or `part_1`.

    Returns:
        y; between -(B + l)/2 and (B + l)/2, where the whole belt lies on one wing roll and nothing holds it [m].

    **Range** lambda + beta below 90 deg; a quasi-static belt that is guided by its idlers only.
    **Error** that of the rule: the three differ by some ten per cent; bending stiffness and friction are left out.
    **Source** K.-J. Grimmer and F. Kessler, "Spezielle Betrachtungen zur Gurtfuehrung bei Gurtfoerderern mit
    Horizontalkurven" (1987), parts I and II, as restated in the public library eytelwein; `ribbon` derived in
    the module.
    """
    middle = min(middle, width)
    load = _below(middle, trough_angle, min(bed_width(middle, trough_angle, load_area, surcharge), width), surcharge)
    wing = math.cos(trough_angle) if rule == "part_1" else 1.0
    up, down = math.sin(trough_angle + banking), math.sin(trough_angle - banking)
    along = math.cos(trough_angle + banking), math.cos(banking), math.cos(trough_angle - banking)

    def belt(s: float) -> float:
        return min(max(0.5 + s / width, 0.0), 1.0)

    parts: list[tuple[Callable[[float], float], float, float]] = [(belt, belt_weight, belt_pull)]
    if load_weight > 0:
        parts.append((load, load_weight, -load_push))

    def unbalance(y: float) -> float:
        total = 0.0
        for below, weight, pull in parts:
            inner, outer = 1 - below(middle / 2 - y), below(-middle / 2 - y)
            centre = 1 - inner - outer
            climbs = wing * (inner * up - outer * down) + centre * math.sin(banking)
            pulled = inner * along[0] + centre * along[1] + outer * along[2] if rule == "ribbon" else 1.0
            total += weight * climbs - pull * pulled
        return total

    low, high = -(width + middle) / 2, (width + middle) / 2
    at_low, at_high = unbalance(low), unbalance(high)
    if at_low > 0:
        return low
    if at_high < 0:
        return high
    side, last = 0, high
    for _ in range(_ROUNDS):  # false position, whose end that stays is taken at half its value (Illinois)
        y = (low * at_high - high * at_low) / (at_high - at_low) if at_high > at_low else (low + high) / 2
        found = unbalance(y)
        if abs(y - last) <= _CLOSE * width or found == 0:
            return y
        last = y
        if found < 0:
            low, at_low, at_high = y, found, at_high / 2 if side < 0 else at_high
        else:
            high, at_high, at_low = y, found, at_low / 2 if side > 0 else at_low
        side = -1 if found < 0 else 1
    return (low + high) / 2


def _below(middle: float, angle: float, bed: float, surcharge: float) -> Callable[[float], float]:
    """Share of a load that lies outward of a place s on the belt, measured from its middle [1]."""
    heap, sine, cosine = math.tan(surcharge), math.sin(angle), math.cos(angle)
    side = max(bed - middle, 0.0) / 2
    half_middle, top = min(bed, middle) / 2, min(bed, middle) + 2 * side * cosine

    def half(s: float) -> float:
        """Cross-section between the middle of the belt and a place s >= 0 on it [m^2]."""
        flat, climbed = min(s, half_middle), min(max(s - half_middle, 0.0), side)
        x = flat + climbed * cosine
        water = side * sine * flat + sine * cosine * climbed * (side - climbed / 2)
        return water + (heap * (top / 4 - x**2 / (3 * top)) * x if top else 0.0)

    whole = 2 * half(bed / 2)

    def below(s: float) -> float:
        return 0.5 + math.copysign(half(abs(s)), s) / whole if whole else float(s >= 0)

    return below


def edge_strain(middle: float, side: float, trough_angle: float, radius: ArrayLike) -> FloatArray:
    """Strain that a horizontal curve adds at the outer edge of a belt, and takes away at the inner one.

        eps = (l + 2 e cos(lambda))/(2 R)

    Args:
        middle: l, of the belt on the middle roll [m].
        side: e, of the belt on each wing roll [m].
        trough_angle: lambda [rad].
        radius: R, of the curve [m].

    Returns:
        eps [1].

    **Range** plane sections; banking and drift left out, which change the horizontal width by less than 2 %.
    **Error** exact for that; B/(2 R) of a flat belt.
    **Source** derived: a fibre on the radius R + z has the strain z/R; the same in DIN 22101 and CEMA for curves.
    """
    return np.asarray((middle + 2 * side * np.cos(trough_angle)) / (2 * np.asarray(radius, float)))
