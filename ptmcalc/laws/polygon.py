"""Polygon effect: the motion a sprocket that turns evenly forces on its chain, its harmonics, its textbook force.

A place x counts pitches from the middle of a tooth: the seated joint is at the angle phi = 2 h x, h = pi/z, and the
next joint engages at x = 1/2, which is x = -1/2 again. Over a pitch the chain moves by R sin(phi), once per pitch
with the tooth frequency V/p. The acceleration falls from +a_max after an engagement to -a_max before the next one and
jumps by 2 a_max there.

Source of the textbook forms: N. Yu. Dorokhov, "Dynamics of hoisting and conveying machines", lecture notes,
Kramatorsk 2007 (the chapter on the dynamics of chain conveyors).
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

LAMBDA_TABLE = ((25.0, 2.0), (60.0, 1.5), (math.inf, 1.0))
"""Up to these lengths [m] so much of the return strand counts; 60 m itself has 1."""


def peak_acceleration(chain_speed: ArrayLike, pitch: float, teeth: int) -> FloatArray:
    """Largest acceleration of a chain on a sprocket that turns evenly.

        a_max = w^2 R sin(pi/z) = w^2 p/2 = 2 pi^2 V^2/(z^2 p)

    Args:
        chain_speed: V, mean speed of the chain [m/s].
        pitch: p [m].
        teeth: z.

    Returns:
        a_max; the acceleration jumps by twice as much at every engagement [m/s^2].

    **Range** a strand in one direction, a sprocket of unlimited inertia.
    **Error** exact.
    **Source** lecture notes Kramatorsk 2007.
    """
    return np.asarray(2 * (np.pi / teeth * np.asarray(chain_speed, float)) ** 2 / pitch)


def _wrapped(place: ArrayLike) -> FloatArray:
    x = np.asarray(place, float)
    return np.asarray(x - np.floor(x + 0.5))


def _less_sinc(x: ArrayLike) -> FloatArray:
    """1 - sin(x)/x for |x| <= pi/2 by its series, which loses no digits."""
    square = np.asarray(x, float) ** 2
    total = np.ones_like(square)
    for k in range(12, 1, -1):
        total = 1 - square / (2 * k * (2 * k + 1)) * total
    return np.asarray(square / 6 * total)


def polygon_displacement(place: ArrayLike, pitch: float, teeth: int) -> FloatArray:
    """How far a chain is ahead of its mean motion.

        u = R (sin(phi) - phi sin(h)/h),   phi = 2 h x,  h = pi/z

    Args:
        place: x, pitches since the middle of a tooth [1].
        pitch: p [m].
        teeth: z.

    Returns:
        u; 0 at every engagement and in the middle [m].

    **Range** as `peak_acceleration`.
    **Error** exact.
    **Source** lecture notes Kramatorsk 2007: v = w R cos(phi), integrated.
    """
    half = np.pi / teeth
    angle = 2 * half * _wrapped(place)
    return np.asarray(pitch / (2 * np.sin(half)) * angle * (_less_sinc(half) - _less_sinc(angle)))


def polygon_speed(place: ArrayLike, chain_speed: float, teeth: int) -> FloatArray:
    """How much faster a chain is than on average.

        v - V = w R (cos(phi) - sin(h)/h),   phi = 2 h x,  h = pi/z,  w R = V h/sin(h)

    Args:
        place: x, pitches since the middle of a tooth [1].
        chain_speed: V, mean speed of the chain [m/s].
        teeth: z.

    Returns:
        v - V [m/s].

    **Range** as `peak_acceleration`.
    **Error** exact.
    **Source** lecture notes Kramatorsk 2007: v = w R cos(phi).
    """
    half = np.pi / teeth
    angle = 2 * half * _wrapped(place)
    return np.asarray(chain_speed * half / np.sin(half) * (_less_sinc(half) - 2 * np.sin(angle / 2) ** 2))


def polygon_acceleration(place: ArrayLike, chain_speed: float, pitch: float, teeth: int) -> FloatArray:
    """Acceleration of a chain on a sprocket that turns evenly.

        a = -w^2 R sin(phi) = -a_max sin(phi)/sin(h),   phi = 2 h x,  h = pi/z

    Args:
        place: x, pitches since the middle of a tooth [1].
        chain_speed: V, mean speed of the chain [m/s].
        pitch: p [m].
        teeth: z.

    Returns:
        a; at an engagement itself the value after it, a_max [m/s^2].

    **Range** as `peak_acceleration`.
    **Error** exact.
    **Source** lecture notes Kramatorsk 2007.
    """
    half = np.pi / teeth
    peak = peak_acceleration(chain_speed, pitch, teeth)
    return np.asarray(-peak * np.sin(2 * half * _wrapped(place)) / np.sin(half))


def ramped_acceleration(
    angle: ArrayLike, sprocket_speed: ArrayLike, sprocket_acceleration: float, pitch: float, teeth: int
) -> FloatArray:
    """Acceleration of a chain on a sprocket that speeds up.

        a = e R cos(phi) - w^2 R sin(phi)

    Args:
        angle: phi, of the seated joint from the middle of its tooth [rad].
        sprocket_speed: w [rad/s].
        sprocket_acceleration: e [rad/s^2].
        pitch: p [m].
        teeth: z.

    Returns:
        a, its mean e z p/(2 pi) included [m/s^2].

    **Range** as `peak_acceleration`.
    **Error** exact.
    **Source** derivative of v = w R cos(phi).
    """
    radius, phi, w = pitch / (2 * np.sin(np.pi / teeth)), np.asarray(angle, float), np.asarray(sprocket_speed, float)
    return np.asarray(radius * (sprocket_acceleration * np.cos(phi) - w**2 * np.sin(phi)))


def engagement_times(sprocket_speed: float, sprocket_acceleration: float, teeth: int, pitches: int) -> FloatArray:
    """Times at which a sprocket that speeds up evenly takes the next joint.

        t_k = 4 h k/(w + (w^2 + 4 h k e)^(1/2)),   h = pi/z,  k = 0 ... n

    Args:
        sprocket_speed: w, at the first engagement [rad/s].
        sprocket_acceleration: e; negative for a run-down that does not end within the pitches [rad/s^2].
        teeth: z.
        pitches: n.

    Returns:
        t_k, shape (n + 1,) [s].

    **Range** w^2 + 4 h n e >= 0, w and e not both 0.
    **Error** exact.
    **Source** derived: 2 h k = w t + e t^2/2, solved without a difference.

    Raises:
        ValueError: where the sprocket stops before the last pitch.
    """
    turned = 4 * math.pi / teeth * np.arange(pitches + 1)
    square = sprocket_speed**2 + turned * sprocket_acceleration
    if square[-1] < 0:
        raise ValueError(f"the sprocket stops before it has taken {pitches} pitches")
    speeds = sprocket_speed + np.sqrt(square)
    return np.asarray(np.divide(turned, speeds, out=np.zeros_like(turned), where=turned > 0))


# -- harmonics ----------------------------------------------------------------------------------------------------


def acceleration_harmonics(orders: FloatArray, chain_speed: float, pitch: float, teeth: int) -> FloatArray:
    """Fourier coefficients of the acceleration: a = sum b_n sin(2 pi n x), x from the middle of a tooth.

        b_n = (-1)^n a_max (2/(pi n)) n^2 z^2/(n^2 z^2 - 1)

    Args:
        orders: n, whole numbers from 1 [1].
        chain_speed: V, mean speed of the chain [m/s].
        pitch: p [m].
        teeth: z.

    Returns:
        b_n [m/s^2].

    **Range** as `peak_acceleration`; the n-th has the frequency n V/p.
    **Error** exact.
    **Source** derived: integral of sin(phi) sin(2 pi n x) over one pitch.
    """
    n = np.asarray(orders, float)
    sign = np.where(n % 2 == 0, 1.0, -1.0)
    peak = peak_acceleration(chain_speed, pitch, teeth)
    return np.asarray(sign * peak * 2 / (np.pi * n) / (1 - (n * teeth) ** -2.0))


def harmonic_tail(last: int, falloff: float, chain_speed: float, pitch: float, teeth: int) -> float:
    """Most that all harmonics of the acceleration behind one can add up to, each weighted with n^-s.

        sum_(n>N) |b_n| n^-s <= a_max (2/pi) q N^-s/s,   q = 1/(1 - ((N + 1) z)^-2)

    Args:
        last: N, at least 1.
        falloff: s, above 0; 0 has no bound: the acceleration jumps [1].
        chain_speed: V, mean speed of the chain [m/s].
        pitch: p [m].
        teeth: z.

    Returns:
        the bound [m/s^2].

    **Range** s = 2 for the displacement in units of (p/(2 pi V))^2.
    **Error** a bound, too high by about s/(2 N) of itself.
    **Source** derived: comparison of the sum with the integral of x^(-1-s).
    """
    most = 1 / (1 - 1 / ((last + 1) * teeth) ** 2)
    peak = float(peak_acceleration(chain_speed, pitch, teeth))
    return peak * (2 / math.pi) * most * math.pow(last, -falloff) / falloff


# -- the textbook force -------------------------------------------------------------------------------------------


def return_share(length: float) -> float:
    """Part of the return strand that the textbook lets take part in the polygon effect.

        lambda = 2 for L <= 25 m,   1.5 for 25 m < L < 60 m,   1 for L >= 60 m

    Args:
        length: L, of the conveyor, one strand [m].

    Returns:
        lambda, on the mass per length of one strand of chain [1].

    **Range** traction chains of conveyors; 25 m and 60 m are printed in two rows each, the heavier and the lighter one
    are taken here.
    **Error** none bound: no wave theory supports a table of lengths alone; what counts is the tooth frequency over the
    first natural frequency. The force jumps by 14 % and 17 % at the thresholds (`nearest_threshold`).
    **Source** lecture notes Kramatorsk 2007.
    """
    if length <= LAMBDA_TABLE[0][0]:
        return LAMBDA_TABLE[0][1]
    return LAMBDA_TABLE[1][1] if length < LAMBDA_TABLE[1][0] else LAMBDA_TABLE[2][1]


def nearest_threshold(length: float) -> tuple[float, float]:
    """Threshold of the table of `return_share` that a length is nearest to.

        d = L/L_0 - 1,   L_0 = 25 m or 60 m

    Args:
        length: L, of the conveyor, one strand [m].

    Returns:
        L_0 [m], d; within 5 % the table deserves a warning [1].

    **Range** any length.
    **Error** exact.
    **Source** `return_share`.
    """
    low, high = LAMBDA_TABLE[0][0], LAMBDA_TABLE[1][0]
    threshold = low if length * length < low * high else high
    return threshold, length / threshold - 1


def textbook_mass(load_line_mass: float, strand_line_mass: float, length: float, share: float) -> float:
    """Mass that the textbook lets swing with the polygon effect.

        m = (m_G + lambda m_K) L

    Args:
        load_line_mass: m_G [kg/m].
        strand_line_mass: m_K, chain and plates of one strand [kg/m].
        length: L, of the conveyor, one strand: with the whole chain the masses would count twice [m].
        share: lambda, of `return_share` [1].

    Returns:
        m [kg].

    **Range** as `return_share`.
    **Error** as `return_share`.
    **Source** lecture notes Kramatorsk 2007.
    """
    return (load_line_mass + share * strand_line_mass) * length


def textbook_polygon_force(mass: float, acceleration: float) -> float:
    """Dynamic force of the polygon effect by the textbook.

        S_D = 4 m a_max - m a_max = 3 m a_max

    Args:
        mass: m, of `textbook_mass` [kg].
        acceleration: a_max, of `peak_acceleration` [m/s^2].

    Returns:
        S_D, above the static force [N].

    **Range** a mass on a spring much faster than the teeth, so that every engagement finds it at rest: the force
    -m a_max before the tooth and a step of 2 m a_max, doubled.
    **Error** no bound: with 1 % of damping 3.3 m a_max at a twentieth, 10 at a third, 27 at once the first natural
    frequency; far too much above 1.2 times it. It is shown beside the solved value and never decides.
    **Source** lecture notes Kramatorsk 2007.
    """
    return 3 * mass * acceleration
