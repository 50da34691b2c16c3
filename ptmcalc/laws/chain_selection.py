"""Selecting a chain: power, length, wrap, safety, pressure, load on the shafts, lubrication.

Standards: ISO 606:2015 (chains and sprockets), ISO 10823:2004 (selection of roller chain drives), ACA (American Chain
Association, "Standard Handbook of Chains"). Factors on which they or makers differ are arguments.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

LUBRICATION_LIMITS = (
    (12.7, 300.0, 2300.0),
    (15.875, 250.0, 2000.0),
    (19.05, 220.0, 1800.0),
    (25.4, 170.0, 1500.0),
    (31.75, 150.0, 1300.0),
    (38.1, 130.0, 1200.0),
    (44.45, 115.0, 1100.0),
    (50.8, 100.0, 1000.0),
)
"""Pitch [mm] and the highest chain speeds [ft/min] with oil by hand or drip and with an oil bath."""
_FOOT_PER_MINUTE = 0.3048 / 60


APPLICATION_FACTORS = {
    "smooth": {"smooth": 1.0, "moderate": 1.4, "heavy": 1.8},
    "slight": {"smooth": 1.1, "moderate": 1.5, "heavy": 1.9},
    "moderate": {"smooth": 1.3, "moderate": 1.7, "heavy": 2.1},
}
"""Application factor f_1 [1] by shocks of the driver, then of the driven machine (ISO 10823:2004)."""


def application_factor(driver: str, machine: str) -> float:
    """Factor on the power for the shocks of driver and driven machine.

        f_1 = 1 to 2.1, by table

    Args:
        driver: shocks of the driver: `smooth`, `slight` or `moderate`.
        machine: shocks of the driven machine: `smooth`, `moderate` or `heavy`.

    Returns:
        f_1 [1].

    **Range** roller chain drives.
    **Error** that of the class: a neighbouring class differs by 0.1 to 0.4.
    **Source** ISO 10823:2004, table of application factors; quoted from manufacturers' catalogues.
    """
    return APPLICATION_FACTORS[driver][machine]


def tooth_factor(teeth: int, exponent: float, reference: int = 19) -> float:
    """Factor on the power for a small sprocket that has not as many teeth as that of the rating charts.

        f_2 = (z_r/z_1)^e

    Args:
        teeth: z_1, of the small sprocket.
        exponent: e; recommended 1.08 (ISO 10823), 1 in some course cards [1].
        reference: z_r, of the small sprocket of the chart: 19 (ISO 10823), 17 in older handbooks.

    Returns:
        f_2 [1].

    **Range** roller chains, z_1 from 11; 17 and more are recommended.
    **Error** the exponent's choice is 1 % at 17 and 4 % at 11 teeth.
    **Source** ISO 10823:2004, tooth factor; quoted from secondary sources.
    """
    return float((reference / teeth) ** exponent)


def design_power(power: float, service_factor: float, tooth_factor: float, strand_factor: float) -> float:
    """Power by which a chain is chosen from a rating chart of one strand and 19 teeth.

        P_c = P f_1 f_2/k

    Args:
        power: P, to be transmitted [W].
        service_factor: f_1, of driver and load: 1 to 2.1 in ISO 10823 [1].
        tooth_factor: f_2, of `tooth_factor` [1].
        strand_factor: k: 1 for one strand; two and three strands 1.7 and 2.5 (recommended, ACA), 1.9 and 2.7 by some
            readings of ISO 10823 [1].

    Returns:
        P_c, per strand [W].

    **Range** roller chain drives.
    **Error** that of the factors; the two readings of k differ by 12 % and 8 %.
    **Source** ISO 10823:2004; ACA.
    """
    return power * service_factor * tooth_factor / strand_factor


def chain_pitches(centre_distance: float, pitch: float, teeth_one: int, teeth_two: int) -> float:
    """Length of a chain round two sprockets, in pitches.

        X = 2 C/p + (z_1 + z_2)/2 + ((z_2 - z_1)/(2 pi))^2 p/C

    Args:
        centre_distance: C [m].
        pitch: p [m].
        teeth_one: z_1.
        teeth_two: z_2.

    Returns:
        X, not rounded [1].

    **Range** sprockets that do not touch; C of 30 to 50 p is recommended.
    **Error** (C/p) y^4/12 pitches short of the tangents to the pitch circles, sin y = (z_2 - z_1) p/(2 pi C): 0.01
    for 19 and 76 teeth at 40 p.
    **Source** ISO 606:2015, ISO 10823:2004.
    """
    return (
        2 * centre_distance / pitch
        + (teeth_one + teeth_two) / 2
        + _step(teeth_one, teeth_two) ** 2 * (pitch / centre_distance)
    )


def _step(teeth_one: int, teeth_two: int) -> float:
    return (teeth_two - teeth_one) / (2 * math.pi)


def even_pitches(pitches: float) -> int:
    """Even number of pitches of a chain, which needs no cranked link.

        X_0 = 2 ceil(X/2)

    Args:
        pitches: X, of `chain_pitches` [1].

    Returns:
        X_0, not shorter than X [1].

    **Range** any length; a length within 1e-9 of an even number counts as that number.
    **Error** exact.
    **Source** ISO 10823:2004: an even number of links.
    """
    return 2 * math.ceil(pitches / 2 * (1 - 1e-9))


def centre_distance(pitches: float, pitch: float, teeth_one: int, teeth_two: int) -> float:
    """Distance of the shafts for a chain of given length: the inverse of `chain_pitches`.

        C = (p/4) (y + (y^2 - 8 d^2)^(1/2)),   y = X - (z_1 + z_2)/2,   d = (z_2 - z_1)/(2 pi)

    Args:
        pitches: X [1].
        pitch: p [m].
        teeth_one: z_1.
        teeth_two: z_2.

    Returns:
        C [m].

    **Range** a chain long enough, y >= 8^(1/2) |d|.
    **Error** as `chain_pitches`, half of it in pitches.
    **Source** ISO 606:2015, ISO 10823:2004.

    Raises:
        ValueError: for a chain too short for the sprockets.
    """
    straight = pitches - (teeth_one + teeth_two) / 2
    step = math.sqrt(8) * abs(_step(teeth_one, teeth_two))
    if straight < step or straight <= 0:
        raise ValueError(f"{pitches:g} pitches do not reach round {teeth_one} and {teeth_two} teeth")
    return pitch / 4 * (straight + math.sqrt((straight - step) * (straight + step)))


def wrap_angle(centre_distance: float, radius_small: float, radius_large: float) -> float:
    """Angle over which a chain lies on the smaller of two sprockets.

        gamma = pi - 2 arcsin((R_2 - R_1)/C)

    Args:
        centre_distance: C [m].
        radius_small: R_1 [m].
        radius_large: R_2 [m].

    Returns:
        gamma; z_1 gamma/(2 pi) teeth are in mesh, 120 deg are recommended [rad].

    **Range** C >= R_2 - R_1 >= 0; straight strands.
    **Error** exact for the pitch circles; sag adds to it.
    **Source** geometry of the tangents; the limit of 120 deg from handbooks (ACA).

    Raises:
        ValueError: for sprockets that lie within each other.
    """
    step = radius_large - radius_small
    if step > centre_distance:
        raise ValueError("the distance of the shafts is smaller than the difference of the radii")
    return math.pi - 2 * math.asin(step / centre_distance)


def centrifugal_force(line_mass: ArrayLike, chain_speed: ArrayLike) -> FloatArray:
    """Tension that a chain has from running round curves alone.

        S_f = m V^2

    Args:
        line_mass: m, of the chain [kg/m].
        chain_speed: V [m/s].

    Returns:
        S_f, everywhere in the chain; it does not load the shafts [N].

    **Range** any curve.
    **Error** exact.
    **Source** momentum of the chain in a curve.
    """
    return np.asarray(np.asarray(line_mass, float) * np.asarray(chain_speed, float) ** 2)


def chain_safety(breaking_load: float, tension: ArrayLike, unevenness: float) -> FloatArray:
    """Safety of a chain against its breaking load.

        n = F_B/(c S)

    Args:
        breaking_load: F_B, of all strands of the chain together [N].
        tension: S: static and centrifugal for the static safety, with the polygon or the starting force for the
            dynamic one [N].
        unevenness: c, share of parallel chains: 1 for one chain, recommended 1.1 to 1.25 for several [1].

    Returns:
        n; 7 to 10 is usual for traction chains; infinite without tension [1].

    **Range** S >= 0.
    **Error** exact but for c.
    **Source** chain manufacturers' handbooks; lecture notes Kramatorsk 2007.
    """
    pull = np.asarray(tension, float) * unevenness
    return np.asarray(np.divide(breaking_load, pull, out=np.full_like(pull, np.inf), where=pull > 0))


def articulation_pressure(tension: ArrayLike, pin_diameter: float, bush_length: float) -> FloatArray:
    """Pressure in the joints of a chain.

        p = S/(d b)

    Args:
        tension: S, of one strand, centrifugal force included [N].
        pin_diameter: d [m].
        bush_length: b [m].

    Returns:
        p, on the projected area of the joint [N/m^2].

    **Range** a joint that bears over its whole length.
    **Error** a mean: the pressure at the ends of a bent pin is higher.
    **Source** ISO 606:2015, bearing area; chain manufacturers' handbooks.
    """
    return np.asarray(np.asarray(tension, float) / pin_diameter / bush_length)


def shaft_load(tight: ArrayLike, slack: ArrayLike, wrap: float) -> FloatArray:
    """Force of a chain on the shaft of a sprocket.

        F = (((S_1 + S_2) sin(g/2))^2 + ((S_1 - S_2) cos(g/2))^2)^(1/2)

    Args:
        tight: S_1, tension of the tight strand without its centrifugal part [N].
        slack: S_2, of the slack strand without its centrifugal part [N].
        wrap: g, angle of wrap [rad].

    Returns:
        F [N].

    **Range** any wrap.
    **Error** exact; handbooks take 1.05 to 1.25 times the pull instead.
    **Source** sum of two vectors.
    """
    one, two = np.asarray(tight, float), np.asarray(slack, float)
    return np.asarray(np.hypot((one + two) * math.sin(wrap / 2), (one - two) * math.cos(wrap / 2)))


def lubrication(pitch: float, chain_speed: float) -> str:
    """How a roller chain drive has to be lubricated.

        V <= V_A(p): by hand or drip      V <= V_B(p): bath      else: stream      V_A, V_B by a table, linear between

    Args:
        pitch: p [m].
        chain_speed: V [m/s].

    Returns:
        the class in words.

    **Range** pitches of 12.7 to 50.8 mm; the ends of the table hold beyond.
    **Error** limits rounded by the table; makers differ by some 10 %.
    **Source** ACA lubrication types A, B, C for chains no. 40 to 160, as printed by suppliers.
    """
    pitches, by_hand, bath = np.array(LUBRICATION_LIMITS).T
    at = 1e3 * pitch
    if chain_speed <= np.interp(at, pitches, by_hand) * _FOOT_PER_MINUTE:
        return "type A: oil by hand or drip"
    if chain_speed <= np.interp(at, pitches, bath) * _FOOT_PER_MINUTE:
        return "type B: oil bath or slinger disc"
    return "type C: oil stream from a pump"
