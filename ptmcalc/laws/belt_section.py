"""Load cross-section of a troughed belt, capacity, and what the pulleys and the transition ask of the belt."""

from collections.abc import Callable, Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

PULLEY_FACTORS: Mapping[str, float] = MappingProxyType(
    {"cotton": 80.0, "polyamide": 90.0, "polyester": 108.0, "aramid": 138.0, "steel_cord": 145.0}
)
"""c_Tr of DIN 22101 by the material of the warp [1] [R]: to be compared with the edition in force."""

_INCH = 0.0254  # m


# -- what lies on the belt ---------------------------------------------------------------------------------------


def usable_width(belt_width: ArrayLike) -> FloatArray:
    """Width of the belt that may carry load.

        b = 0.9 B - 0.05 m up to B = 2 m,   b = B - 0.25 m above

    Args:
        belt_width: B [m].

    Returns:
        b, at least 0; continuous at 2 m [m].

    **Range** belts that run centred; B from 0.3 m.
    **Error** a rule.
    **Source** ISO 5048:1989; DIN 22101.
    """
    width = np.asarray(belt_width, float)
    return np.asarray(np.maximum(np.where(width <= 2, 0.9 * width - 0.05, width - 0.25), 0.0))


def water_section(loaded_width: ArrayLike, centre_roll: ArrayLike, trough_angle: ArrayLike) -> FloatArray:
    """Cross-section of the load below the line between the edges of its bed.

        S_2 = (l + e cos(lambda)) e sin(lambda),   e = (b - l)/2, at least 0

    Args:
        loaded_width: b, of `usable_width` [m].
        centre_roll: l, length of the middle roll; 0 for two rolls [m].
        trough_angle: lambda, of the wing rolls; 0 for a flat belt [rad].

    Returns:
        S_2 [m^2].

    **Range** two or three equal rolls, a belt that lies on them.
    **Error** the belt rounds the corners: a few per cent less.
    **Source** ISO 5048:1989, lower part of the cross-section.
    """
    middle, side = _middle_and_side(loaded_width, centre_roll)
    angle = np.asarray(trough_angle, float)
    return np.asarray((middle + side * np.cos(angle)) * side * np.sin(angle))


def surcharge_section(
    loaded_width: ArrayLike, centre_roll: ArrayLike, trough_angle: ArrayLike, surcharge_angle: ArrayLike
) -> FloatArray:
    """Cross-section of the load above the line between the edges of its bed.

        S_1 = w^2 tan(theta)/6,   w = l + 2 e cos(lambda),   e = (b - l)/2, at least 0

    A parabola over the width w that meets the edges under the angle theta is w tan(theta)/4 high.

    Args:
        loaded_width: b, of `usable_width` [m].
        centre_roll: l, length of the middle roll; 0 for two rolls [m].
        trough_angle: lambda [rad].
        surcharge_angle: theta, of the moving material; 0.75 of the angle of repose is usual [rad].

    Returns:
        S_1 [m^2].

    **Range** theta below a right angle.
    **Error** theta is known to a few degrees.
    **Source** ISO 5048:1989, upper part of the cross-section.
    """
    middle, side = _middle_and_side(loaded_width, centre_roll)
    width = middle + 2 * side * np.cos(np.asarray(trough_angle, float))
    return np.asarray(width**2 * np.tan(np.asarray(surcharge_angle, float)) / 6)


def triangle_surcharge_section(
    loaded_width: ArrayLike, centre_roll: ArrayLike, trough_angle: ArrayLike, equivalent_slope: ArrayLike
) -> FloatArray:
    """Cross-section of the load above the line between the edges of its bed, by the equivalent slope of DIN 22101.

        S_1 = w^2 tan(beta)/4,   w = l + 2 e cos(lambda),   e = (b - l)/2, at least 0

    A triangle over the width w with the slope beta at both edges is w tan(beta)/2 high.

    Args:
        loaded_width: b, of `usable_width` [m].
        centre_roll: l, length of the middle roll; 0 for two rolls [m].
        trough_angle: lambda [rad].
        equivalent_slope: beta, of the moving material [rad].

    Returns:
        S_1, 1.5 times that of `surcharge_section` at the same angle [m^2].

    **Range** beta below a right angle. The equivalent slope of a material is smaller than its angle at the edges.
    **Error** beta is known to a few degrees.
    **Source** DIN 22101:2011, theoretical cross-section of fill A_1 [R]: to be compared with the edition in force.
    """
    return np.asarray(1.5 * surcharge_section(loaded_width, centre_roll, trough_angle, equivalent_slope))


def standard_edge_width(belt_width: ArrayLike) -> FloatArray:
    """Width of the belt that carries load by the standard edge distance of CEMA.

        b = B - 2 (0.055 B + 0.9 in)

    Args:
        belt_width: B [m].

    Returns:
        b, at least 0 [m].

    **Range** belts that run centred; B from 0.4 m.
    **Error** a rule.
    **Source** CEMA, "Belt Conveyors for Bulk Materials", standard edge distance; to be compared with the edition in
    force.
    """
    width = np.asarray(belt_width, float)
    return np.asarray(np.maximum(width - 2 * (0.055 * width + 0.9 * _INCH), 0.0))


def arc_surcharge_section(
    loaded_width: ArrayLike, centre_roll: ArrayLike, trough_angle: ArrayLike, surcharge_angle: ArrayLike
) -> FloatArray:
    """Cross-section of the load above the line between the edges of its bed, below a circular arc.

        S_1 = w^2 (theta - sin(theta) cos(theta))/(4 sin^2 theta),   w = l + 2 e cos(lambda),   e = (b - l)/2

    An arc over the chord w that meets the edges under the angle theta has the radius w/(2 sin(theta)).

    Args:
        loaded_width: b, of `standard_edge_width` [m].
        centre_roll: l, length of the middle roll; 0 for two rolls [m].
        trough_angle: lambda [rad].
        surcharge_angle: theta, of the moving material [rad].

    Returns:
        S_1 [m^2].

    **Range** theta below a right angle.
    **Error** theta is known to a few degrees; 1e-12 of the value by the series below 1e-3 rad.
    **Source** CEMA, "Belt Conveyors for Bulk Materials", surcharge area; segment of a circle.
    """
    middle, side = _middle_and_side(loaded_width, centre_roll)
    width = middle + 2 * side * np.cos(np.asarray(trough_angle, float))
    theta = np.asarray(surcharge_angle, float)
    wide = np.maximum(theta, 1e-3)
    segment = (wide - np.sin(wide) * np.cos(wide)) / (4 * np.sin(wide) ** 2)
    return np.asarray(width**2 * np.where(theta < 1e-3, theta / 6 * (1 + 2 * theta**2 / 15), segment))


EDITIONS: Mapping[str, tuple[Callable[..., FloatArray], Callable[..., FloatArray]]] = MappingProxyType(
    {
        "iso_5048": (usable_width, surcharge_section),
        "din_22101": (usable_width, triangle_surcharge_section),
        "cema": (standard_edge_width, arc_surcharge_section),
    }
)
"""By standard: the laws of the loaded width and of the section above the line between its edges."""


def _middle_and_side(loaded_width: ArrayLike, centre_roll: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Width on the middle roll and on each wing roll; a narrow load lies on the middle roll alone."""
    b, roll = np.asarray(loaded_width, float), np.asarray(centre_roll, float)
    return np.minimum(roll, b), np.maximum(b - roll, 0) / 2


def slope_reduction(slope: ArrayLike, surcharge_angle: ArrayLike) -> FloatArray:
    """What a slope leaves of the surcharge section.

        k = sqrt((cos^2 delta - cos^2 theta)/(1 - cos^2 theta)) = sqrt(1 - sin^2 delta/sin^2 theta)

    Args:
        slope: delta, steepest slope of the carry strand, up or down [rad].
        surcharge_angle: theta [rad].

    Returns:
        k; 0 from delta = theta on, where the surcharge slides back [1].

    **Range** smooth belts.
    **Error** the part below the line between the edges is taken as unharmed.
    **Source** DIN 22101, k_1 in phi_St = 1 - S_1/S (1 - k_1); ISO 5048:1989 tabulates phi_St.
    """
    down, rest = np.abs(np.sin(np.asarray(slope, float))), np.sin(np.asarray(surcharge_angle, float))
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.minimum(np.where(rest > 0, down / rest, 1.0), 1.0)
    return np.asarray(np.sqrt((1 - ratio) * (1 + ratio)))


def capacity(section: ArrayLike, speed: ArrayLike, density: ArrayLike) -> FloatArray:
    """Largest mass flow of a belt.

        Q = S v rho

    Args:
        section: S = S_2 + k S_1, of `water_section`, `surcharge_section` and `slope_reduction` [m^2].
        speed: v [m/s].
        density: rho, bulk density [kg/m^3].

    Returns:
        Q [kg/s].

    **Range** even feed.
    **Error** as S.
    **Source** ISO 5048:1989.
    """
    return np.asarray(np.asarray(section, float) * np.asarray(speed, float) * np.asarray(density, float))


def load_line_mass(throughput: ArrayLike, speed: ArrayLike) -> FloatArray:
    """Mass of the load per length of belt.

        q_G = Q / v

    Args:
        throughput: Q [kg/s].
        speed: v [m/s].

    Returns:
        q_G [kg/m].

    **Range** v > 0, load that moves with the belt.
    **Error** exact.
    **Source** conservation of mass.
    """
    return np.asarray(np.asarray(throughput, float) / np.asarray(speed, float))


def fill_share(throughput: ArrayLike, capacity: ArrayLike) -> FloatArray:
    """How full the belt is.

        phi = Q / Q_max

    Args:
        throughput: Q [kg/s].
        capacity: Q_max of `capacity` [kg/s].

    Returns:
        phi, above 1 where material falls off; infinite where a belt has no capacity [1].

    **Range** even feed; 0.7 to 1.1 is usual for a wanted phi.
    **Error** as `capacity`.
    **Source** DIN 22101, effective filling ratio.
    """
    given, most = np.asarray(throughput, float), np.asarray(capacity, float)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.where(most > 0, given / most, np.inf))


# -- what the belt bears -----------------------------------------------------------------------------------------


def belt_safety(rating: float, belt_width: float, tension: ArrayLike) -> FloatArray:
    """Safety of the belt against its rated breaking strength.

        nu = k_N B / T

    Args:
        rating: k_N, breaking strength per width; a splice has less: multiply by its relative strength [N/m].
        belt_width: B [m].
        tension: T, largest tension of the state looked at [N].

    Returns:
        nu; infinite without tension [1].

    **Range** tension even over the width; edges at transitions and curves have their own laws.
    **Error** exact.
    **Source** definition; wanted values by S_0 and S_1 of DIN 22101, or rating over width.
    """
    force = np.asarray(tension, float)
    with np.errstate(divide="ignore"):
        return np.asarray(np.where(force > 0, rating * belt_width / np.maximum(force, 0), np.inf))


def minimum_pulley_diameter(carcass: str, thickness: float) -> float:
    """Smallest diameter of a drive pulley for the carcass of the belt.

        D = c_Tr d_Gk

    Args:
        carcass: material of the warp, a key of `PULLEY_FACTORS`.
        thickness: d_Gk, of the carcass, of the cords in a steel-cord belt [m].

    Returns:
        D, to be rounded up to a standard pulley [m].

    **Range** pulleys of group A (high tension: drives), belt used above 60 % of its rating; snub and tail pulleys
    may be smaller by the tables of the standard.
    **Error** experience with the life of carcass and splice.
    **Source** DIN 22101, factors c_Tr [R].

    Raises:
        ValueError: for a material that is not in the table.
    """
    if carcass not in PULLEY_FACTORS:
        raise ValueError(f"the carcass is one of {', '.join(PULLEY_FACTORS)}")
    return PULLEY_FACTORS[carcass] * thickness


def transition_strains(
    length: float, centre_width: float, side_width: float, trough_angle: float, pulley_lift: float
) -> tuple[float, float]:
    """How far the tightest and the slackest fibre of a belt are from its mean strain between pulley and trough.

        eps(y) = (y^2 (1 - cos(lambda)) - y h sin(lambda)) / l^2,   y from the corner (0) to the edge (s)
        most: max(eps(s), eps(0)) - mean,   least: mean - min eps(y),   y = min(s, h sin(lambda)/(2 (1 - cos(lambda))))
        mean = 2 s^2/(l^2 W) (s (1 - cos(lambda))/3 - h sin(lambda)/2),   W = c + 2 s

    A fibre at y on the wing roll is y sin(lambda) high and y (1 - cos(lambda)) off the place where it leaves the
    pulley, whose face is h above the middle roll. The tension of the belt fixes the mean over the width W. The edge is
    the tightest unless the pulley is lifted so far that the middle is.

    Args:
        length: l, between the pulley and the first full trough [m].
        centre_width: c, of the belt on the middle roll [m].
        side_width: s, of the belt on each wing roll [m].
        trough_angle: lambda [rad].
        pulley_lift: h, of the pulley's face over the middle roll; a third of the trough's depth is usual [m].

    Returns:
        (most [1], least [1]), both positive; times EA/W they are tensions per width above and below the mean.

    **Range** strains below a few per cent; the whole difference is taken up within l.
    **Error** eps/2 of the value by the shallow parabola; the belt spreads part of it into the trough, so it is on the
    safe side.
    **Source** derived: lengths of straight fibres; the same geometry as in DIN 22101.
    """
    bend, rise = 2 * np.sin(trough_angle / 2) ** 2, pulley_lift * np.sin(trough_angle)
    share = side_width / (centre_width + 2 * side_width)
    mean = 2 * share * side_width * (side_width * bend / 3 - rise / 2)
    edge = side_width * (side_width * bend - rise)
    dip = min(side_width, rise / (2 * bend)) if bend > 0 else 0.0
    most, least = max(edge, 0.0) - mean, mean - dip * (dip * bend - rise)
    return most / length / length, least / length / length


def transition_length(
    allowed_strain: float, centre_width: float, side_width: float, trough_angle: float, pulley_lift: float
) -> float:
    """Shortest distance from pulley to trough for an allowed strain of the tightest fibre.

        l = sqrt(l_1^2 eps_1/eps),   eps_1 = most of `transition_strains` at any length l_1

    Args:
        allowed_strain: eps, over the mean [1].
        centre_width: c, of the belt on the middle roll [m].
        side_width: s, of the belt on each wing roll [m].
        trough_angle: lambda [rad].
        pulley_lift: h, of the pulley's face over the middle roll [m].

    Returns:
        l; 0 for a flat belt [m].

    **Range** as `transition_strains`.
    **Error** as `transition_strains`.
    **Source** `transition_strains` solved for the length.
    """
    at_unit, _ = transition_strains(1.0, centre_width, side_width, trough_angle, pulley_lift)
    return float(np.sqrt(at_unit / allowed_strain))
