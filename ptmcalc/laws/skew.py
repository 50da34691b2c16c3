"""A crane that runs askew: the friction that turns it, the guide that holds it, and what every wheel gets of both.

The crane travels at a small angle to its rails and leans on them with a guide (rollers or flanges) on rail 1. Every
wheel slips across, and turns about the slip pole as the guide turns the crane back; wheels that are coupled (through a
shaft or by their drives' speed) cannot follow and slip along the rail too. Distances count from the guide backwards.
"""

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

FIXED, MOVABLE = "fixed", "movable"
"""Wheels of rail 2 that hold against sideways forces, and wheels or legs that give way."""
FULL_PLAY, EN_13001_2, EN_1991_3 = "full", "en_13001_2", "en_1991_3"
"""Rules for the play of a guide: all of it, or three quarters of a large one (as the two standards are quoted)."""
LARGEST_ANGLE = 0.015
"""Most the angle of a crane may be [rad] (EN 13001-2, EN 1991-3)."""
TOLERANCE_ANGLE = 0.001
"""Angle from tolerances of wheels and rails [rad] (EN 13001-2, EN 1991-3)."""
LEAST_PLAY: Mapping[str, float] = MappingProxyType({"rollers": 0.005, "flanges": 0.010})
"""Least play [m] of guide rollers and of wheel flanges (EN 1991-3; to be confirmed)."""
WEAR_SHARE: Mapping[str, float] = MappingProxyType({"rollers": 0.03, "flanges": 0.10})
"""Wear of guide and rail over the width of the rail's head [1] (EN 1991-3; to be confirmed)."""
ADHESION: Mapping[str, float] = MappingProxyType({"cleaned": 0.3, "not_cleaned": 0.2})
"""Largest friction of a wheel that slips across [1]: 0.3 as a rule, 0.2 on rails that are never cleaned (newer
EN 13001-2; to be confirmed)."""


_STEPS = 100
"""More than Newton's method on the work of friction takes within its range (14)."""


def skew_angle(
    play: float,
    wear: float,
    guide_distance: float,
    least_play: float,
    tolerance: float = TOLERANCE_ANGLE,
    edition: str = EN_13001_2,
) -> float:
    """Angle at which a crane can run askew between its guides.

        alpha = s/a + w/a + alpha_t
        full:       s = x
        en_13001_2: s = x up to 4/3 x_min, 3/4 x above
        en_1991_3:  s = 3/4 x, at least x_min

    Args:
        play: x, between guides and rail, new [m].
        wear: w, of guides and rail, `WEAR_SHARE` of the rail's width [m].
        guide_distance: a, of the outer guides along the rail [m].
        least_play: x_min, `LEAST_PLAY` [m].
        tolerance: alpha_t, of wheels and rails [rad].
        edition: `full`, `en_13001_2` or `en_1991_3`.

    Returns:
        alpha; to be kept below `LARGEST_ANGLE` [rad].

    Raises:
        ValueError: for another edition.

    **Range** alpha << 1.
    **Error** none: conventions; the full play is what geometry allows, the others are less likely to be reached.
    **Source** EN 13001-2 and EN 1991-3, skewing, as quoted from memory; to be confirmed.
    """
    return skew_play(play, least_play, edition) / guide_distance + wear / guide_distance + tolerance


def skew_play(play: float, least_play: float, edition: str = EN_13001_2) -> float:
    """Play of a guide that counts for the angle of skewing.

        full: s = x;   en_13001_2: s = x up to 4/3 x_min, 3/4 x above;   en_1991_3: s = 3/4 x, at least x_min

    Args:
        play: x, between guides and rail, new [m].
        least_play: x_min, `LEAST_PLAY` [m].
        edition: `full`, `en_13001_2` or `en_1991_3`.

    Returns:
        s; larger than x where EN 1991-3 puts its least play in place of x [m].

    Raises:
        ValueError: for another edition.

    **Range** any play.
    **Error** none: conventions.
    **Source** EN 13001-2 and EN 1991-3, skewing, as quoted from memory; to be confirmed.
    """
    plays = {
        FULL_PLAY: play,
        EN_13001_2: play if play <= 4 / 3 * least_play else 0.75 * play,
        EN_1991_3: max(0.75 * play, least_play),
    }
    if edition not in plays:
        raise ValueError(f"the clearance of guides is that of {FULL_PLAY}, {EN_13001_2} or {EN_1991_3}")
    return plays[edition]


def skew_friction(angle: ArrayLike, adhesion: float) -> FloatArray:
    """Friction across the rail of a wheel that rolls at an angle to it.

        f = mu_0 (1 - exp(-250 alpha))

    Args:
        angle: alpha, at least 0 [rad].
        adhesion: mu_0, `ADHESION` [1].

    Returns:
        f, sideways force over wheel load [1].

    **Range** steel wheels, alpha up to 0.015 rad.
    **Error** none bound: an empirical curve.
    **Source** EN 13001-2, ISO 8686-1, EN 1991-3 (mu_0 = 0.3).
    """
    return np.asarray(-adhesion * np.expm1(-250 * np.asarray(angle, float)))


def _check(wheels_of_rail_two: str) -> None:
    if wheels_of_rail_two not in (FIXED, MOVABLE):
        raise ValueError(f"the wheels of rail 2 are {FIXED} or {MOVABLE}")


def slip_pole(
    distances: FloatArray,
    coupled: FloatArray,
    weights: FloatArray,
    centre: float,
    span: float,
    rail_two: str = FIXED,
) -> float:
    """Distance from the guide to the pole about which a skewing crane slips.

        h = (xi_1 xi_2 l^2 sum p_i G_i + sum t G_i d_i^2)/sum t G_i d_i
        t = 1 (fixed) or xi_2 (movable);   for equal pairs h = (m xi_1 xi_2 l^2 + sum d_i^2)/sum d_i, or m xi_1 l^2

    Args:
        distances: d_i, of the pairs of wheels behind the guide, shape (n,) [m].
        coupled: p_i, 1 for a pair whose wheels turn alike, 0 for one whose wheels are free, shape (n,) [1].
        weights: G_i, on each pair, alike by the standard, shape (n,) [N].
        centre: xi_1, distance of the centre of mass from rail 1, the guiding one, over the span; xi_2 = 1 - xi_1 [1].
        span: l [m].
        rail_two: `fixed` or `movable` wheels across rail 2.

    Returns:
        h [m].

    Raises:
        ValueError: for another kind of rail 2, or no wheels behind the guide.

    **Range** slip forces that grow with the slip; the guide on rail 1, whose wheels are fixed and carry something.
    **Error** exact for that law of friction.
    **Source** derived: moments about the guide of wheels that slip in proportion to their distance from the pole; for
    equal pairs that of EN 13001-2, ISO 8686-1 and EN 1991-3 (CFF, IFF, CFM, IFM).
    """
    _check(rail_two)
    d, p, G = (np.asarray(given, float) for given in (distances, coupled, weights))
    held = 1.0 if rail_two == FIXED else 1 - centre
    moment = float(held * np.sum(G * d))
    if not moment > 0:
        raise ValueError("a crane that skews has wheels behind its guide")
    return float(centre * (1 - centre) * span**2 * np.sum(p * G) + held * np.sum(G * d**2)) / moment


def skew_forces(
    friction: float,
    distances: FloatArray,
    coupled: FloatArray,
    weights: FloatArray,
    centre: float,
    span: float,
    rail_two: str = FIXED,
) -> FloatArray:
    """Forces of all wheels on a skewing crane.

        across, rail 1: f xi_2 G_i (1 - d_i/h)      across, rail 2: f xi_1 G_i (1 - d_i/h), 0 where movable
        along: f xi_1 xi_2 G_i p_i l/h on rail 2, its opposite on rail 1

    The guide holds the sum of the forces across, on rail 1.

    Args:
        friction: f, of `skew_friction` [1].
        distances: d_i, of the pairs of wheels behind the guide, shape (n,) [m].
        coupled: p_i, 1 for a pair whose wheels turn alike, 0 for one whose wheels are free, shape (n,) [1].
        weights: G_i, on each pair, shape (n,) [N].
        centre: xi_1, distance of the centre of mass from rail 1, the guiding one, over the span; xi_2 = 1 - xi_1 [1].
        span: l [m].
        rail_two: `fixed` or `movable` wheels across rail 2.

    Returns:
        forces across of rail 1, across of rail 2, and along, shape (3, n); below 0 beyond the pole [N].

    Raises:
        ValueError: for another kind of rail 2, or no wheels behind the guide.

    **Range** as `slip_pole`.
    **Error** exact for slip forces that grow with the slip. The standard's own curve, wheel by wheel
    (`skew_equilibrium`), saturates and holds the rear wheels harder: the guide then gets 0.93 to 1.47 times as much
    in a sample of 400 cranes.
    **Source** derived as `slip_pole`; EN 13001-2, ISO 8686-1, EN 1991-3 for equal pairs.
    """
    pole = slip_pole(distances, coupled, weights, centre, span, rail_two)
    d, p, G = (np.asarray(given, float) for given in (distances, coupled, weights))
    slip = friction * G * (1 - d / pole)
    two = centre * slip if rail_two == FIXED else np.zeros(len(d))
    return np.array([(1 - centre) * slip, two, friction * centre * (1 - centre) * G * p * (span / pole)])


def skew_equilibrium(
    adhesion: float,
    angle: float,
    distances: FloatArray,
    coupled: FloatArray,
    weights: FloatArray,
    centre: float,
    span: float,
    rail_two: str = FIXED,
) -> FloatArray:
    """Forces of all wheels on a skewing crane whose wheels slip along the curve of friction, each for itself.

        F_j = N_j f(s_j),   against the slip s_j = (alpha (1 - d/h), alpha (y - e)/h)
        h, e:   sum F_x = 0 of the coupled wheels,   moment about the guide = 0

    `skew_forces` takes f(alpha) and lets it grow in proportion to the slip; here every wheel has its own f.

    Args:
        adhesion: mu_0, `ADHESION` [1].
        angle: alpha, above 0 [rad].
        distances: d_i, of the pairs of wheels behind the guide, shape (n,) [m].
        coupled: p_i, 1 for a pair whose wheels turn alike, 0 for one whose wheels are free, shape (n,) [1].
        weights: G_i, on each pair, shape (n,) [N].
        centre: xi_1, distance of the centre of mass from rail 1, the guiding one, over the span; xi_2 = 1 - xi_1 [1].
        span: l [m].
        rail_two: `fixed` or `movable` wheels across rail 2.

    Returns:
        forces across of rail 1, across of rail 2, along on rail 1, along on rail 2, shape (4, n) [N].

    Raises:
        ValueError: for another kind of rail 2, or no wheels behind the guide.

    **Range** as `slip_pole`; a stiff crane.
    **Error** of the balance below 1e-9 of the weight; of the curve none bound, it is empirical.
    **Source** derived: the balances are the gradient of a convex work of friction, whose minimum Newton's method finds
    from any start; f of `skew_friction`.
    """
    pole = slip_pole(distances, coupled, weights, centre, span, rail_two)
    d, p, G = (np.asarray(given, float) for given in (distances, coupled, weights))
    unit = max(span, float(np.max(d)))
    load = np.concatenate([G * (1 - centre), G * centre]) / np.sum(G)
    held = np.repeat([1.0, float(rail_two == FIXED)], len(d))
    across = np.tile(d / unit, 2) * held
    turns, rolls = np.repeat([0.0, span / unit], len(d)) * np.tile(p, 2), np.tile(p, 2)
    steps = np.array([[-across, turns], [np.zeros(2 * len(d)), -rolls]])  # of the slips over turn and roll

    def slips(state: FloatArray) -> FloatArray:
        return np.asarray(np.array([held, 0 * held]) + np.einsum("kcj,k->cj", steps, state))

    def work(state: FloatArray) -> float:
        size = 250 * angle * np.hypot(*slips(state))
        return float(np.sum(load * (size + np.expm1(-size))))

    state = np.array([unit / pole, centre * span / pole])
    free = [0, 1] if np.any(p > 0) else [0]
    for _ in range(_STEPS):
        slip = slips(state)
        length = np.hypot(*slip)
        size = 250 * angle * length
        small = size < 1e-6
        secant = np.where(small, 1 - size / 2, -np.expm1(-size) / np.where(small, 1.0, size))
        bend = np.exp(-size) - secant
        lean = slip / np.where(small, 1.0, length)
        gradient = np.einsum("kcj,cj,j->k", steps, slip, load * secant)[free]
        along = np.einsum("kcj,cj->kj", steps, lean)
        curve = np.einsum("kcj,lcj,j->kl", steps, steps, load * secant) + np.einsum(
            "kj,lj,j->kl", along, along, load * bend
        )
        move = np.zeros(2)
        move[free] = -np.linalg.lstsq(curve[np.ix_(free, free)], gradient, rcond=None)[0]
        before, share = work(state), 1.0
        while share > 1e-12 and not work(state + share * move) < before:
            share /= 2
        if share <= 1e-12:
            break
        state = state + share * move
    slip = slips(state)
    size = 250 * angle * np.hypot(*slip)
    secant = np.where(size < 1e-6, 1.0, -np.expm1(-size) / np.where(size < 1e-6, 1.0, size))
    force = adhesion * 250 * angle * np.sum(G) * load * secant * slip
    return np.asarray(force.reshape(4, len(d)))


def start_side_forces(drive_force: float, centre: float, span: float, wheel_base: float) -> tuple[float, float]:
    """Forces across the rails of a bridge whose drives push alike while its centre of mass is off the middle.

        M = K (xi_1 - 1/2) l,   H_1 = xi_2 M/a,   H_2 = xi_1 M/a

    Args:
        drive_force: K, of all drives together [N].
        centre: xi_1, distance of the centre of mass from rail 1 over the span; xi_2 = 1 - xi_1 [1].
        span: l [m].
        wheel_base: a, of the wheels or guides that hold the moment [m].

    Returns:
        (H_1 [N], H_2 [N]) at the front wheels, the opposite at the rear ones; negative where the moment turns back.

    **Range** drives of equal force on both rails; without phi_5.
    **Error** exact for wheels that share by their loads.
    **Source** derived: moment of the inertia about the middle of the drives; EN 1991-3 (2.7).
    """
    couple = drive_force * (centre - 0.5) * (span / wheel_base)
    return (1 - centre) * couple, centre * couple
