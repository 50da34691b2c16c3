"""The column of a stacker crane: how far it gives, what of its mass moves with its ends, and how it swings.

Source of the stiffness and of the coefficients 0.236 and 0.305: N. Yu. Dorokhov, "Dynamics of hoisting and conveying
machines", lecture notes, Kramatorsk 2007 (stacker cranes). The column of length l hangs from a trolley on two girders
or stands on a bottom carriage. Its free end moves against that trolley or carriage by

    f(s) = gamma + b s + alpha (3 s^2 - s^3)/2,   alpha = 1 - b - gamma,   s from 0 at the root to 1 at the tip

for a force at the tip: the shares b of a root that turns, gamma of one that shifts, alpha of the column's own bending.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]
HANGING, STANDING = "hanging", "standing"
NOTES_RIGID, NOTES_ELASTIC = 0.236, 0.305
"""Shares of the column's mass at its tip of the lecture notes, for a rigid root and for one that gives."""
FIRST_MOMENT = 11 / 40
"""Integral of s q, q = (3 s^2 - s^3)/2 the shape of a clamped column."""
_MEAN, _FIRST, _SQUARE = 3 / 8, FIRST_MOMENT, 33 / 140
"""Integrals of q, s q and q^2."""


def mean_shape(rotation_share: ArrayLike, translation_share: ArrayLike) -> FloatArray:
    """Mean of the column's shape under a force at its tip: its share in the inertia that bends it.

        integral f ds = gamma + b/2 + 3/8 alpha

    Args:
        rotation_share: b, of the tip's deflection [1].
        translation_share: gamma [1].

    Returns:
        mean; 3/8 for a rigid root [1].

    **Range** b, gamma >= 0, b + gamma <= 1.
    **Error** exact: an accelerated root bends the column at its tip as this share of its mass at the tip would.
    **Source** derived: integral of the shape, Maxwell and Betti.
    """
    b, gamma = np.asarray(rotation_share, float), np.asarray(translation_share, float)
    return np.asarray(gamma + b / 2 + _MEAN * (1 - b - gamma))


def mass_coefficient(rotation_share: ArrayLike, translation_share: ArrayLike) -> FloatArray:
    """Share of the column's mass that swings with its tip where its root is held.

        kappa = integral f^2 ds = 33/140 alpha^2 + b^2/3 + gamma^2 + 11/20 alpha b + 3/4 alpha gamma + b gamma

    Args:
        rotation_share: b, of the tip's deflection [1].
        translation_share: gamma [1].

    Returns:
        kappa; 33/140 = 0.2357 for a rigid root, 1/3 for one that only turns, 1 for one that only shifts [1].

    **Range** b, gamma >= 0, b + gamma <= 1; from gamma = 0.1 on a mass of its own for what shifts.
    **Error** the frequency by it is too high: by 1.5 % for a bare column, 0.35 % with a tip of a quarter of its mass,
    0.05 % with one of its mass.
    **Source** derived: kinetic energy of the static shape; 0.236 of the lecture notes Kramatorsk 2007 is its value for
    a rigid root, 0.305 that for b = 0.747.
    """
    b, gamma = np.asarray(rotation_share, float), np.asarray(translation_share, float)
    alpha = 1 - b - gamma
    bent = alpha * (_SQUARE * alpha + 2 * _FIRST * b + 2 * _MEAN * gamma)
    return np.asarray(bent + b * b / 3 + gamma * gamma + b * gamma)


def tip_shape(place: ArrayLike, rotation_share: ArrayLike, translation_share: ArrayLike) -> FloatArray:
    """How far a column gives at a place of it for a force at its tip, over how far its tip gives.

        f(s) = gamma + b s + alpha (3 s^2 - s^3)/2,   alpha = 1 - b - gamma

    Args:
        place: s, from the root over the length [1].
        rotation_share: b, of the tip's deflection [1].
        translation_share: gamma [1].

    Returns:
        f [1].

    **Range** 0 <= s <= 1, b, gamma >= 0, b + gamma <= 1.
    **Error** exact for an even column.
    **Source** bending of beams.
    """
    s, b, gamma = np.asarray(place, float), np.asarray(rotation_share, float), np.asarray(translation_share, float)
    return np.asarray(gamma + s * (b + (1 - b - gamma) * s * (3 - s) / 2))


def consistent_masses(
    base_mass: float,
    load_mass: float,
    column_mass: float,
    root_mass: float,
    rotation_share: float,
    translation_share: float,
    place: float,
) -> tuple[float, float, float]:
    """Masses of a column that moves with both its ends, the shape between them that of a force at its tip.

        m_11 = m_1 + integral (1 - f)^2 dm,   m_12 = integral f (1 - f) dm,   m_22 = integral f^2 dm

    f of `tip_shape`; dm counts the column, the load at its place, and the mass at the root.

    Args:
        base_mass: m_1, that the drive moves [kg].
        load_mass: m_2, of carriage and load [kg].
        column_mass: m_c [kg].
        root_mass: at the root, what shifts against the base with it: a trolley on girders that give sideways [kg].
        rotation_share: b, of the deflection at the tip [1].
        translation_share: gamma [1].
        place: of the load, from the root over the length of the column, 1 at the tip [1].

    Returns:
        m_11 [kg], m_12 [kg], m_22 [kg]; their sum m_11 + 2 m_12 + m_22 is all there is.

    **Range** 0 <= place <= 1; best with the load near the tip.
    **Error** deflection of the tip under even acceleration exact; lowest frequency too high, by at most 0.4 % for a
    load at the tip and a base from a quarter to four times the column's mass.
    **Source** derived: kinetic energy of the static shape (consistent masses, J. Archer 1963).
    """
    gamma = translation_share
    mean = float(mean_shape(rotation_share, gamma))
    square = float(mass_coefficient(rotation_share, gamma))
    at_load = float(tip_shape(place, rotation_share, gamma))
    return (
        base_mass
        + (1 - 2 * mean + square) * column_mass
        + (1 - at_load) ** 2 * load_mass
        + (1 - gamma) ** 2 * root_mass,
        (mean - square) * column_mass + at_load * (1 - at_load) * load_mass + gamma * (1 - gamma) * root_mass,
        square * column_mass + at_load * at_load * load_mass + gamma * gamma * root_mass,
    )


def consistent_frequency(stiffness: float, base: float, coupling: float, tip: float) -> float:
    """Frequency of a load against a base that is free to move, both coupled by the column between them.

        w^2 = c (m_11 + 2 m_12 + m_22)/(m_11 m_22 - m_12^2)

    Args:
        stiffness: c, of the column at the load [N/m].
        base: m_11 [kg].
        coupling: m_12, below the square root of m_11 m_22 [kg].
        tip: m_22 [kg].

    Returns:
        w [rad/s].

    **Range** a base without stiffness of its own; one that is held has (c/m_22)^(1/2).
    **Error** exact for these masses.
    **Source** derived: the relative motion of two coupled masses.
    """
    root = math.sqrt(base) * math.sqrt(tip)
    return (
        math.sqrt(stiffness) * math.sqrt(base + 2 * coupling + tip) / math.sqrt((root - coupling) * (root + coupling))
    )


def two_mass_damping(stiffness: float, base_mass: float, tip_mass: float, decrement: float) -> float:
    """Damping between trolley and load from the logarithmic decrement of their relative motion.

        b = 2 m delta/T_d = 2 zeta (c m)^(1/2),   m = m_1 m_2/(m_1 + m_2),   zeta = delta/(4 pi^2 + delta^2)^(1/2)

    Args:
        stiffness: c [N/m].
        base_mass: m_1; infinite for a trolley that is held, where m = m_2 [kg].
        tip_mass: m_2 [kg].
        decrement: delta, of two maxima one damped period apart [1].

    Returns:
        b [N*s/m].

    **Range** delta >= 0.
    **Error** exact for viscous damping.
    **Source** lecture notes Kramatorsk 2007; T_d that of the relative motion.
    """
    reduced = tip_mass if math.isinf(base_mass) else base_mass * (tip_mass / (base_mass + tip_mass))
    zeta = decrement / math.hypot(2 * math.pi, decrement)
    return 2 * zeta * math.sqrt(stiffness) * math.sqrt(reduced)


def static_lag(force: float, stiffness: float, base: float, coupling: float, tip: float) -> float:
    """How far the load lags behind its base while a force accelerates both evenly.

        x = P (m_22 + m_12)/(c (m_11 + 2 m_12 + m_22))

    Args:
        force: P, at the base [N].
        stiffness: c [N/m].
        base: m_11 [kg].
        coupling: m_12 [kg].
        tip: m_22 [kg].

    Returns:
        x; a force that comes at once makes 2 x of it without damping [m].

    **Range** a base without stiffness of its own.
    **Error** exact, for a column with mass too: m_22 + m_12 is what bends it at its tip.
    **Source** derived; lecture notes Kramatorsk 2007: 2 P m_2/(c (m_1 + m_2)).
    """
    return force * ((tip + coupling) / (base + 2 * coupling + tip)) / stiffness


def notes_deflection(
    force: float, stiffness: float, base_mass: float, tip_mass: float, column_mass: float, coefficient: float
) -> float:
    """Largest deflection of the column's tip by the lecture notes, as a braked trolley is stopped.

        x = 2 P m_2/(c (m_1 + m_2)),   m_2 = tip + k m_c

    Args:
        force: P, of brake and resistance [N].
        stiffness: c [N/m].
        base_mass: m_1, of the trolley, no part of the column with it [kg].
        tip_mass: at the tip [kg].
        column_mass: m_c [kg].
        coefficient: k, 0.236 for a rigid root, 0.305 for one that gives [1].

    Returns:
        x [m].

    **Range** a force that comes at once and stays for more than half a period; no damping.
    **Error** unbounded: the rest of the column's mass, left out, sits on the trolley (6.5 % too much in one case).
    **Source** lecture notes Kramatorsk 2007.
    """
    tip = tip_mass + coefficient * column_mass
    return 2 * force * (tip / (base_mass + tip)) / stiffness


def rise_factor(turns: ArrayLike) -> FloatArray:
    """Largest deflection under a force that rises evenly and then stays, over that at rest under it.

        1 + |sin(pi t_r/T)|/(pi t_r/T)

    Args:
        turns: t_r/T, time of the rise over period [1].

    Returns:
        factor, 2 for a sudden force, 1 for a rise of whole periods [1].

    **Range** no damping; the force stays for half a period more. It is the force that rises: the acceleration, not the
    speed.
    **Error** exact.
    **Source** derived: residual of a ramp in the phase plane.
    """
    return np.asarray(1 + np.abs(np.sinc(np.asarray(turns, float))))


def after_stop_ratio(angle: ArrayLike, mass_ratio: float) -> FloatArray:
    """Swing of the load once its base has come to rest and is held, over the largest deflection while it was braked.

        A/x_max = ((1 - cos(theta))^2 + (1 + r) sin(theta)^2)^(1/2)/2

    Args:
        angle: theta = k t, of the relative motion since the brake came [rad].
        mass_ratio: r, 1 + r = (k/w)^2 with w of the held column; m_2/m_1 for a column without mass [1].

    Returns:
        ratio: at most 1 for r <= 1, else (1 + r)/(2 r^(1/2)) [1].

    **Range** a force that came at once and stayed, no damping, a base that is held by whatever it takes; a brake of
    the same force lets go where r > 1 and the ratio is above (1 + r)/(2 r).
    **Error** exact for two masses.
    **Source** derived: deflection and speed go on, the frequency changes.
    """
    theta = np.asarray(angle, float)
    half = np.sin(theta / 2)
    return np.asarray(np.abs(half) * np.sqrt(half * half + (1 + mass_ratio) * np.cos(theta / 2) ** 2))


def root_moment(force: float, total_mass: float, tip_mass: float, column_mass: float, length: float) -> float:
    """Largest moment at the root of a column whose base is stopped suddenly by a force.

        M = 2 a l (m_2 + m_c/2),   a = P/m

    Args:
        force: P, at the base [N].
        total_mass: m, of all that is stopped [kg].
        tip_mass: m_2 [kg].
        column_mass: m_c [kg].
        length: l [m].

    Returns:
        M [N*m].

    **Range** a force that comes at once and stays for more than half a period; no damping.
    **Error** twice the moment of even deceleration, no bound; within 2 % of exact modes in one case, where c x_max l is
    4.7 % low.
    **Source** derived: inertia of load and column.
    """
    return 2 * force * (tip_mass / total_mass + column_mass / total_mass / 2) * length


def leaning(moment: float, length: float, flexural_stiffness: float, root_stiffness: float, place: float) -> float:
    """How far the tip of a column leans under a moment somewhere along it: weights that act beside its axis.

        x = M s l (l - s l/2)/(E J) + M l/k

    Args:
        moment: M [N*m].
        length: l [m].
        flexural_stiffness: E J [N*m^2].
        root_stiffness: k, of the root against turning, infinite for a rigid one [N*m].
        place: s, of the moment, from the root over the length [1].

    Returns:
        x [m].

    **Range** an even column, small deflections, a free tip; what weights do to the stiffness left out.
    **Error** exact for that column.
    **Source** bending of beams.
    """
    bent = place * (1 - place / 2) * (length / flexural_stiffness)
    return moment * (bent + 1 / root_stiffness) * length


def gravity_stiffness(
    tip_weight: float,
    column_weight: float,
    length: float,
    rotation_share: float,
    translation_share: float,
    attitude: str,
) -> float:
    """What weight adds to the stiffness of a hanging column, or takes from that of a standing one.

        dc = +- (1/l) (P (1.2 alpha^2 + 2 alpha b + b^2) + G (3/8 alpha^2 + 3/4 alpha b + b^2/2))

    Args:
        tip_weight: P, at the tip [N].
        column_weight: G [N].
        length: l [m].
        rotation_share: b, of the tip's deflection [1].
        translation_share: gamma [1].
        attitude: `hanging` or `standing`.

    Returns:
        dc [N/m].

    **Range** loads small beside those that buckle: |dc| < 0.3 c.
    **Error** of the order of dc^2/c: the work of gravity on the static shape, an upper bound of the stiffness.
    **Source** derived: 6 P/(5 l) and 3 G/(8 l) for a rigid root.

    Raises:
        ValueError: for another attitude.
    """
    if attitude not in (HANGING, STANDING):
        raise ValueError(f"a mast is {HANGING} or {STANDING}")
    b = rotation_share
    alpha = 1 - b - translation_share
    slopes = tip_weight / length * (alpha * (1.2 * alpha + 2 * b) + b * b)
    own = column_weight / length * (alpha * (_MEAN * alpha + 2 * _MEAN * b) + b * b / 2)
    return slopes + own if attitude == HANGING else -(slopes + own)
