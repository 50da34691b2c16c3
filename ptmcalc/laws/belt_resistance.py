"""Secondary and special resistances of a belt conveyor, its effective tension and power, its take-up.

ISO 5048:1989 and DIN 22101 divide the resistances into main (`resistance.main_resistance_per_length`), secondary,
special and gradient resistances. The CEMA formula stands beside them as another method; results of the two are never
added. Friction coefficients are arguments; the ranges in the docstrings are those the standards quote [R] and have to
be compared with the edition in force.
"""

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ptmcalc.laws.resistance import length_factor

FloatArray = NDArray[np.float64]

POUND_FORCE = 4.4482216152605
"""1 lbf [N]."""

WRAP_COEFFICIENTS: Mapping[str, tuple[float, float]] = MappingProxyType(
    {"fabric": (1260.0, 0.09), "steel_cord": (2400.0, 0.12)}
)
"""Share per width [N/m] and share of the tension [1] of `wrap_resistance`, by carcass: ISO 5048:1989 prints
9 B (140 + 0.01 F/B) d/D for fabric and 12 B (200 + 0.01 F/B) d/D for steel cord [R]."""

TILT_CONTACT: Mapping[int, float] = MappingProxyType({30: 0.4, 45: 0.5})
"""C_eps of `idler_tilt_resistance` for three equal rolls, by trough angle in degrees; 1 on a flat return [R]."""

CEMA_IDLER_DRAG: Mapping[str, float] = MappingProxyType(
    {
        "6in": 1.5 * POUND_FORCE,
        "5in": 1.8 * POUND_FORCE,
        "4in": 2.3 * POUND_FORCE,
        "7in": 2.4 * POUND_FORCE,
    }
)
"""A_i of `cema_idler_resistance` [N], by roll diameter: 1.5 lbf for 6 in (classes C6, D6), 1.8 for 5 in, 2.3 for 4 in,
2.4 for 7 in (E7) [R]."""


# -- resistances besides those of the idlers ---------------------------------------------------------------------


def secondary_resistance(main_resistance: float, length: float) -> float:
    """Secondary resistances of a long conveyor as a share of the main resistances.

        F_N = (C(L) - 1) F_H

    Args:
        main_resistance: F_H, of both strands [N].
        length: L, centre distance [m].

    Returns:
        F_N [N].

    **Range** L >= 80 m, one loading point; below it each secondary resistance has its own law here.
    **Error** as `resistance.length_factor`: 25 % of F_N is a fair interval.
    **Source** DIN 22101 and ISO 5048:1989, coefficient C.

    Raises:
        ValueError: below 80 m.
    """
    return (float(length_factor(length)) - 1) * main_resistance


def loading_resistance(throughput: ArrayLike, speed: ArrayLike, feed_speed: ArrayLike) -> FloatArray:
    """Force that brings the material to the speed of the belt where it is loaded.

        F_bA = Q (v - v_0)

    Args:
        throughput: Q [kg/s].
        speed: v, of the belt [m/s].
        feed_speed: v_0, speed component of the material along the belt at loading [m/s].

    Returns:
        F_bA; negative where the material arrives faster than the belt [N].

    **Range** material that leaves the loading zone with the speed of the belt.
    **Error** exact: momentum; half of the power Q (v - v_0)^2 is friction between belt and material.
    **Source** ISO 5048:1989, inertial and frictional resistance at the loading point; DIN 22101.
    """
    return np.asarray(np.asarray(throughput, float) * (np.asarray(speed, float) - np.asarray(feed_speed, float)))


def acceleration_length(speed: ArrayLike, feed_speed: ArrayLike, friction: ArrayLike, gravity: float) -> FloatArray:
    """Length over which friction brings the material to the speed of the belt.

        l_b = (v^2 - v_0^2) / (2 g mu_1)

    Args:
        speed: v, of the belt [m/s].
        feed_speed: v_0, of the material along the belt [m/s].
        friction: mu_1, between material and belt; 0.5 to 0.7 [1].
        gravity: g [m/s^2].

    Returns:
        l_b, at least 0 [m].

    **Range** a level loading point; friction only from the weight of the material.
    **Error** exact for that model.
    **Source** ISO 5048:1989, acceleration length (least value).
    """
    v, start = np.asarray(speed, float), np.asarray(feed_speed, float)
    return np.asarray(np.maximum(v - start, 0) * (v + start) / (2 * gravity * np.asarray(friction, float)))


def skirt_resistance(
    throughput: ArrayLike,
    density: ArrayLike,
    material_speed: ArrayLike,
    width: ArrayLike,
    length: ArrayLike,
    friction: ArrayLike,
    gravity: float,
) -> FloatArray:
    """Friction of the material at skirt plates.

        F = mu_2 (Q/rho)^2 rho g l / (v b)^2

    The material stands Q/(rho v b) high between the plates and presses on each as a liquid would, rho g h^2/2 per
    length, on both rho g h^2.

    Args:
        throughput: Q [kg/s].
        density: rho, bulk density [kg/m^3].
        material_speed: v of the material: of the belt beside full skirts, (v + v_0)/2 in the acceleration zone [m/s].
        width: b_1, between the plates [m].
        length: l, of the plates [m].
        friction: mu_2, between material and plates; 0.5 to 0.7 [1].
        gravity: g [m/s^2].

    Returns:
        F [N].

    **Range** plates filled by the whole stream; lateral pressure ratio 1, as the standard has it.
    **Error** on the safe side: DIN 22101 lets the pressure ratio be 0.5 to 1 by the state of the material.
    **Source** ISO 5048:1989, resistance between material and skirt plates F_gL, and F_f in the acceleration area.
    """
    height = np.asarray(throughput, float) / density / (np.asarray(material_speed, float) * width)
    return np.asarray(np.asarray(friction, float) * density * gravity * np.asarray(length, float) * height**2)


def scraper_resistance(area: ArrayLike, pressure: ArrayLike, friction: ArrayLike) -> FloatArray:
    """Friction of a belt scraper.

        F_r = A p mu_3

    Args:
        area: A, contact of scraper and belt: width times thickness of the blade [m^2].
        pressure: p; 3e4 to 1e5 N per square metre [N/m^2].
        friction: mu_3; 0.5 to 0.7 [1].

    Returns:
        F_r, for each scraper [N].

    **Range** one blade in contact over A.
    **Error** the pressure is set by hand: a factor of 3 between scrapers.
    **Source** ISO 5048:1989, belt cleaners.
    """
    return np.asarray(np.asarray(area, float) * np.asarray(pressure, float) * np.asarray(friction, float))


def wrap_resistance(
    width: float,
    tension: ArrayLike,
    thickness: float,
    diameter: float,
    width_coefficient: float,
    tension_coefficient: float,
) -> FloatArray:
    """Resistance to bending a belt round a pulley.

        F_l = (k_B B + k_F F) d / D

    Args:
        width: B, of the belt [m].
        tension: F, mean of run-on and run-off tension at the pulley [N].
        thickness: d, of the belt [m].
        diameter: D, of the pulley [m].
        width_coefficient: k_B of `WRAP_COEFFICIENTS` [N/m].
        tension_coefficient: k_F of `WRAP_COEFFICIENTS` [1].

    Returns:
        F_l [N].

    **Range** fabric and steel-cord belts; wraps of more than a quarter turn, whatever the angle.
    **Error** empirical; small beside the main resistances of any conveyor over 80 m.
    **Source** ISO 5048:1989, wrap resistance between belt and pulleys.
    """
    force = width_coefficient * width + tension_coefficient * np.asarray(tension, float)
    return np.asarray(force * (thickness / diameter))


def bearing_resistance(
    bearing_load: ArrayLike, shaft_diameter: float, pulley_diameter: float, friction: float
) -> FloatArray:
    """Resistance of the bearings of a pulley, at its rim.

        F_t = mu (d_0/D) F_T

    Args:
        bearing_load: F_T, vector sum of both belt tensions and the weight of the pulley [N].
        shaft_diameter: d_0, in the bearings [m].
        pulley_diameter: D [m].
        friction: mu; 0.005 for rolling bearings [1].

    Returns:
        F_t [N].

    **Range** pulleys without a drive: the losses of a driven one are in the efficiency of the drive.
    **Error** mu is a mean of rolling bearings with their seals.
    **Source** ISO 5048:1989, pulley bearing resistance.
    """
    return np.asarray(friction * (shaft_diameter / pulley_diameter) * np.asarray(bearing_load, float))


def idler_tilt_resistance(
    contact: float,
    friction: float,
    length: float,
    line_load: float,
    gravity: float,
    slope_cosine: float,
    tilt: float,
) -> float:
    """Resistance of wing rolls that are tilted forward to centre the belt.

        F_eps = C mu L q g cos(delta) sin(eps)

    Args:
        contact: C_eps of `TILT_CONTACT` for three rolls; cos of the trough angle for two on the return [1].
        friction: mu_0, between idlers and belt; 0.3 to 0.4 [1].
        length: L, equipped with tilted rolls [m].
        line_load: q, belt and load per length [kg/m].
        gravity: g [m/s^2].
        slope_cosine: cos(delta), slope of the strand [1].
        tilt: eps, forward tilt of the roll axis [rad].

    Returns:
        F_eps [N].

    **Range** tilts up to 3 degrees.
    **Error** the share C of the load on the wing rolls is a mean over fillings.
    **Source** ISO 5048:1989, special main resistance.
    """
    return float(contact * friction * length * line_load * gravity * slope_cosine * np.sin(tilt))


# -- effective tension and power ---------------------------------------------------------------------------------


def effective_tension(
    main_resistance: ArrayLike, length_factor: float, special_resistance: ArrayLike, gradient_resistance: ArrayLike
) -> FloatArray:
    """Force the drives put on the belt in steady running.

        F_U = C F_H + F_S + F_St

    Args:
        main_resistance: F_H, of both strands [N].
        length_factor: C of `resistance.length_factor`; 1 with all secondary resistances in F_S [1].
        special_resistance: F_S, skirts, scrapers, tilted idlers [N].
        gradient_resistance: F_St, weight of the load times lift over length [N].

    Returns:
        F_U; negative where the load drives the conveyor [N].

    **Range** steady running.
    **Error** as its parts.
    **Source** ISO 5048:1989; DIN 22101.
    """
    main = length_factor * np.asarray(main_resistance, float)
    return np.asarray(main + np.asarray(special_resistance, float) + np.asarray(gradient_resistance, float))


def shaft_power(effective_tension: ArrayLike, speed: ArrayLike) -> FloatArray:
    """Power on the shafts of the drive drums.

        P = F_U v

    Args:
        effective_tension: F_U [N].
        speed: v, of the belt [m/s].

    Returns:
        P; negative where the load drives [W].

    **Range** steady running.
    **Error** exact.
    **Source** ISO 5048:1989.
    """
    return np.asarray(np.asarray(effective_tension, float) * np.asarray(speed, float))


def motor_power(shaft_power: ArrayLike, efficiency: float) -> FloatArray:
    """Power of the motors for a power on the drum shafts.

        P_M = P/eta for P >= 0,   P eta for P < 0

    Args:
        shaft_power: P of `shaft_power` [W].
        efficiency: eta, of the gears; 0.85 to 0.95 [1].

    Returns:
        P_M; negative where the motors brake [W].

    **Range** the same efficiency both ways; ISO 5048:1989 lets eta be 0.95 to 1 in regeneration.
    **Error** exact.
    **Source** ISO 5048:1989; losses take their share from where the power comes.
    """
    power = np.asarray(shaft_power, float)
    return np.asarray(np.where(power >= 0, power / efficiency, power * efficiency))


def cycle_time(loop_length: float, speed: float) -> float:
    """Time in which the belt comes round once.

        T = L_loop / v

    Args:
        loop_length: L_loop, of the whole belt [m].
        speed: v [m/s].

    Returns:
        T [s].

    **Range** v > 0.
    **Error** exact.
    **Source** definition.
    """
    return loop_length / speed


# -- take-up -----------------------------------------------------------------------------------------------------


def takeup_travel(
    loop_length: float,
    mean_tension: ArrayLike,
    mounting_tension: float,
    stiffness: float,
    permanent_elongation: float,
    falls: int,
) -> FloatArray:
    """Way of the take-up that a belt needs for its elongation.

        s = L_loop ((S_mean - S_0)/EA + eps_p) / n

    Args:
        loop_length: L_loop, of the whole belt [m].
        mean_tension: S_mean, over the length of the loop in the state looked at [N].
        mounting_tension: S_0, at which the take-up stood at 0 [N].
        stiffness: EA, tensile stiffness of the belt [N].
        permanent_elongation: eps_p, stretch left by long service; 0.001 for steel cord to 0.01 for fabric [1].
        falls: n, strands the take-up pulley pays in: 2.

    Returns:
        s; negative where the belt is less stretched than when mounted [m].

    **Range** one stiffness all round; elongation is the integral of S/EA, so only the mean counts.
    **Error** eps_p is experience; the rest exact.
    **Source** derived: Hooke's law over the loop; take-up travel in DIN 22101.
    """
    elastic = (np.asarray(mean_tension, float) - mounting_tension) / stiffness
    return np.asarray(loop_length * (elastic + permanent_elongation) / falls)


def mean_tension(lengths: FloatArray, tensions: FloatArray) -> float:
    """Mean of the tension over the length of a route.

        S_mean = sum l_k (S_(k-1) + S_k)/2 / sum l_k

    Args:
        lengths: l_k, of the sections [m].
        tensions: S_0 ... S_n, of `strand_tension.strand_tensions` [N].

    Returns:
        S_mean [N].

    **Range** tension linear over each section.
    **Error** exact for that; waves need the integral over time as well.
    **Source** trapezium.
    """
    at, run = np.asarray(tensions), np.asarray(lengths)  # of floats, or of whatever adds up
    mean: float = np.sum((at[:-1] + at[1:]) / 2 * run) / np.sum(run)
    return mean


def takeup_mass(tension: ArrayLike, falls: int, gravity: float) -> FloatArray:
    """Mass of a gravity take-up.

        M = n T / g

    Args:
        tension: T, wanted in each fall [N].
        falls: n, falls of belt or rope that carry the weight: 2 for a pulley in a loop of the belt.
        gravity: g [m/s^2].

    Returns:
        M, pulley and frame included [kg].

    **Range** guides and rope sheaves without friction.
    **Error** exact for that; guides take 5 to 10 %.
    **Source** equilibrium.
    """
    return np.asarray(np.asarray(tension, float) * (falls / gravity))


# -- CEMA ---------------------------------------------------------------------------------------------------------


def cema_idler_resistance(
    belt_line_mass: float, load_line_mass: float, gravity: float, idler_drag: float, idler_spacing: float
) -> float:
    """Resistance of the idlers per length of conveyor, CEMA's K_x.

        K_x = 0.00068 (w_B + w_M) + A_i/S_i,   w = g q

    Each term is a force per length, so the formula reads the same in lbf/ft and in N/m; A_i is kept in newtons.

    Args:
        belt_line_mass: q_B [kg/m].
        load_line_mass: q_M [kg/m].
        gravity: g [m/s^2].
        idler_drag: A_i of `CEMA_IDLER_DRAG`, of one troughing idler set [N].
        idler_spacing: S_i, on the carry strand [m].

    Returns:
        K_x [N/m].

    **Range** CEMA idlers in fair maintenance; K_x counts the return idlers too.
    **Error** empirical.
    **Source** CEMA, "Belt Conveyors for Bulk Materials", historical method, as quoted in public handbooks [R].
    """
    return 0.00068 * gravity * (belt_line_mass + load_line_mass) + idler_drag / idler_spacing


def cema_effective_tension(
    length: float,
    lift: float,
    belt_line_mass: float,
    load_line_mass: float,
    gravity: float,
    temperature_factor: float,
    idler_resistance: float,
    flexure_factor: float,
    other_tension: float,
) -> float:
    """Effective tension by the CEMA formula.

        T_e = L K_t (K_x + K_y w_B + 0.015 w_B) + w_M (L K_y + H) + T_o,   w = g q,  T_o = T_p + T_am + T_ac

    In the book L and H are in ft, w_B, w_M and K_x in lbf/ft, T in lbf. Every term is a length times a force per
    length, so no constant changes in SI.

    Args:
        length: L, of the conveyor [m].
        lift: H, height gained; negative downhill [m].
        belt_line_mass: q_B [kg/m].
        load_line_mass: q_M [kg/m].
        gravity: g [m/s^2].
        temperature_factor: K_t; 1 above freezing [1].
        idler_resistance: K_x of `cema_idler_resistance` [N/m].
        flexure_factor: K_y, of the table over length, slope and weights; 0.016 to 0.035 [1].
        other_tension: T_o, pulleys, acceleration of the material (`loading_resistance`), accessories [N].

    Returns:
        T_e; negative where the load drives [N].

    **Range** carry strand of one slope, K_y from CEMA's table for it; 0.015 stands for the return strand.
    **Error** empirical; the book's own comparison with measured conveyors scatters by 20 %.
    **Source** CEMA, "Belt Conveyors for Bulk Materials", 5th and later editions, historical method [R].
    """
    belt, load = gravity * belt_line_mass, gravity * load_line_mass
    idlers = length * temperature_factor * (idler_resistance + (flexure_factor + 0.015) * belt)
    return idlers + load * (length * flexure_factor + lift) + other_tension
