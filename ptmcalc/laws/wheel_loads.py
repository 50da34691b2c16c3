"""Wheel loads of whatever runs on four corners: a bridge, a gantry, a trolley; by the place of every mass on it.

Axes: `across` the rails from rail 0 (0) to rail 1 (the span), `along` them from the middle of the wheel base, positive
to the front, heights above the top of the rail. Corners are an array [rail, end]: rail 0 or 1, end 0 the rear, 1 the
front. A load below 0 means that the corner lifts off: what is computed with it does not hold any more.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ptmcalc.laws import classification

FloatArray = NDArray[np.float64]

HINGED, RIGID = "hinged", "rigid"
"""How a frame on four corners shares what statics alone leaves open: girders hinged to their end carriages (the usual
one), or a frame that does not twist on corners that give alike."""
EQUALISED = "equalised"
"""Several wheels of a corner on balance beams (the usual one); the other way is `RIGID`, in one stiff carriage."""
ROLLING_CONTACT_SLOPE = 10 / 3
"""Slope of the fatigue of rolling contact in terms of load (EN 13001-3-3); ISO 4301-1 takes 3 for spectra."""


def _shares(position: FloatArray, length: float) -> FloatArray:
    """Lever law: the shares of the two ends of a beam, shape (2, n)."""
    return np.array([1 - position / length, position / length])


def corner_loads(
    weights: FloatArray,
    across: FloatArray,
    along: FloatArray,
    along_forces: FloatArray,
    across_forces: FloatArray,
    heights: FloatArray,
    span: float,
    wheel_base: float,
    frame: str = HINGED,
) -> FloatArray:
    """Loads of the four corners of a crane from its masses and the horizontal forces on them.

        hinged: N_se = sum  G b_s c_e +- F_x h/B b_s +- F_y h/L c_e
        rigid:  N_se = sum  G/4 +- (G x + F_x h)/(2 B) +- (G (y - L/2) + F_y h)/(2 L)
        b = 1 - y/L or y/L (lever across),  c = 1/2 -+ x/B (lever along)

    Inertia forces are horizontal forces: -m a on a mass of the crane under an acceleration a, at its height; those of
    a hanging load act where its rope is held, as much where it leans steadily, `pendulum.swing_force` where it swings.

    Args:
        weights: G, of every mass, shape (n,) [N].
        across: y, from rail 0, shape (n,) [m].
        along: x, from the middle of the wheel base, shape (n,) [m].
        along_forces: F_x, on every mass, positive to the front, shape (n,) [N].
        across_forces: F_y, on every mass, positive to rail 1, shape (n,) [N].
        heights: h, at which its horizontal forces act, above the rail, shape (n,) [m].
        span: L, between the rails [m].
        wheel_base: B, between the corners of a rail [m].
        frame: `hinged` or `rigid`.

    Returns:
        N, shape (2, 2), rail and end [N].

    Raises:
        ValueError: for another frame.

    **Range** every corner loaded; y beyond 0 to L on cantilevers.
    **Error** exact for the frame named; both have the same sum and the same moments, and stray from each other by a
    warp +w, -w, -w, +w. A real frame lies between.
    **Source** derived: equilibrium; hinged girders on hinged carriages are statically determinate, equal springs share
    by a plane.
    """
    if frame not in (HINGED, RIGID):
        raise ValueError(f"the frame of a crane is {HINGED} or {RIGID}")
    G, y, x, h = (np.asarray(given, float) for given in (weights, across, along, heights))
    tilt, sway = np.asarray(along_forces, float) * h / wheel_base, np.asarray(across_forces, float) * h / span
    sign = np.array([-1.0, 1.0])
    if frame == RIGID:
        front = np.sum(G * (x / wheel_base) + tilt) / 2
        right = np.sum(G * (y / span - 0.5) + sway) / 2
        return np.asarray(np.sum(G) / 4 + sign[:, None] * right + sign * front)
    b, c = _shares(y, span), _shares(x + wheel_base / 2, wheel_base)
    return np.asarray((b * G) @ c.T + (b @ tilt)[:, None] * sign + sign[:, None] * (c @ sway))


def corner_load_range(
    weights: FloatArray,
    across_low: FloatArray,
    across_high: FloatArray,
    along: FloatArray,
    along_forces: FloatArray,
    across_forces: FloatArray,
    heights: FloatArray,
    span: float,
    wheel_base: float,
    frame: str = HINGED,
) -> tuple[FloatArray, FloatArray]:
    """Least and greatest loads of the corners over all places of a trolley and all horizontal forces up to the given.

        N_min = min N,  N_max = max N   over y_1 <= y <= y_2, |F_x|, |F_y| up to the given ones

    Args:
        weights: G, of every mass, shape (n,) [N].
        across_low: y_1, where the trolley is nearest to rail 0; masses of the bridge have the same place in both,
            shape (n,) [m].
        across_high: y_2, where it is farthest, shape (n,) [m].
        along: x, from the middle of the wheel base, shape (n,) [m].
        along_forces: F_x, that may act either way, shape (n,) [N].
        across_forces: F_y, that may act either way, shape (n,) [N].
        heights: h, at which its horizontal forces act, above the rail, shape (n,) [m].
        span: L, between the rails [m].
        wheel_base: B, between the corners of a rail [m].
        frame: `hinged` or `rigid`.

    Returns:
        (N_min [N], N_max [N]), shape (2, 2) each.

    Raises:
        ValueError: for another frame.

    **Range** as `corner_loads`; all forces along act at once, so do those across.
    **Error** exact: the loads are linear in the place and in either set of forces, so their extremes stand at the ends.
    **Source** derived from `corner_loads`.
    """
    corners = np.array(
        [
            corner_loads(
                weights, y, along, t * np.asarray(along_forces), s * np.asarray(across_forces), heights, span,
                wheel_base, frame,
            )
            for y in (across_low, across_high)
            for t in (-1.0, 1.0)
            for s in (-1.0, 1.0)
        ]
    )  # fmt: skip
    return np.min(corners, axis=0), np.max(corners, axis=0)


def wheels_of_rail(rear_load: float, front_load: float, positions: FloatArray, carriage: str = EQUALISED) -> FloatArray:
    """Loads of all wheels on one rail from the loads of its two corners.

        equalised: N_j = N_corner/(n/2)      rigid: N_j = N/n + M (x_j - x_m)/sum (x_i - x_m)^2

    The rear half of the wheels makes the rear corner, the front half the front one; a corner is the middle of its
    wheels. N is the load of the rail, M its moment about the middle x_m of all wheels.

    Args:
        rear_load: N_0, of `corner_loads` [N].
        front_load: N_1 [N].
        positions: x, of the wheels from the rear to the front, an even number of them, shape (n,) [m].
        carriage: `equalised`, balance beams, or `rigid`, all wheels of the rail in one stiff carriage on a level rail.

    Returns:
        N_j, shape (n,) [N].

    Raises:
        ValueError: for another carriage or wheels that make no two corners.

    **Range** a level rail: of a rigid carriage a wheel over a low spot carries nothing.
    **Error** exact for equal wheels.
    **Source** derived: balance beams; equal springs under a stiff beam.
    """
    x = np.asarray(positions, float)
    if carriage not in (EQUALISED, RIGID):
        raise ValueError(f"wheels of a corner are {EQUALISED} or {RIGID}")
    if len(x) < 2 or len(x) % 2 or not np.all(np.diff(x) > 0):
        raise ValueError("a rail needs an even number of wheels, listed from the rear to the front")
    half = len(x) // 2
    if carriage == EQUALISED:
        return np.repeat([rear_load / half, front_load / half], half)
    from_middle = x - np.mean(x)
    moment = rear_load * np.mean(from_middle[:half]) + front_load * np.mean(from_middle[half:])
    return np.asarray((rear_load + front_load) / len(x) + moment * from_middle / np.sum(from_middle**2))


def mean_wheel_load(least: ArrayLike, greatest: ArrayLike) -> FloatArray:
    """Load for which the running surface of a wheel is chosen, from its extremes.

        P = (P_min + 2 P_max)/3

    Args:
        least: P_min, over the cycle [N].
        greatest: P_max [N].

    Returns:
        P [N].

    **Range** loads spread about evenly between both.
    **Error** of the cubic mean of evenly spread loads it is 1 (P_min = P_max) to 1.084 times (P_min = 0.29 P_max) it.
    **Source** FEM 1.001 and ISO 16881-1, choice of rail wheels; to be compared with the edition in force.
    """
    return np.asarray((np.asarray(least, float) + 2 * np.asarray(greatest, float)) / 3)


def wheel_spectrum_factor(loads: FloatArray, shares: FloatArray, exponent: float = ROLLING_CONTACT_SLOPE) -> float:
    """Spectrum factor of a wheel over the places of trolley and load.

        k = sum s_i (N_i/N_max)^m / sum s_i

    Args:
        loads: N_i, of the wheel in every place, at least 0, shape (n,) [N].
        shares: s_i, of the way rolled with it, shape (n,) [1].
        exponent: m, slope of the fatigue of rolling contact [1].

    Returns:
        k, 0 for a wheel that carries nothing [1].

    **Range** steady loads; dynamic ones beside it by the factors of the standard.
    **Error** exact.
    **Source** Palmgren 1924, Miner 1945: damages add up; slope of EN 13001-3-3 (ISO 4301-1: 3).
    """
    N, share = np.asarray(loads, float), np.asarray(shares, float)
    largest = float(np.max(N))
    if largest <= 0:
        return 0.0
    return classification.spectrum_factor(share / np.sum(share), N / largest, exponent)


def even_travel_factor(ratio: float, exponent: float = ROLLING_CONTACT_SLOPE) -> float:
    """Spectrum factor of a wheel whose load goes evenly between its extremes, as a trolley goes along the bridge.

        k = (1 - r^(m+1)) / ((m + 1) (1 - r)),   r = N_min/N_max

    Args:
        ratio: r, least over greatest load, from 0 to 1 [1].
        exponent: m, slope of the fatigue of rolling contact [1].

    Returns:
        k; 1 at r = 1, 1/(m+1) at r = 0 [1].

    **Range** every place of the trolley as often as any other, always with the same load.
    **Error** exact.
    **Source** derived: mean of N^m over a linear N.
    """
    power = exponent + 1
    if ratio <= 0:
        return 1 / power
    if ratio == 1:
        return 1.0
    rate = np.log(ratio)
    return float(np.expm1(power * rate) / (power * np.expm1(rate)))
