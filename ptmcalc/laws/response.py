"""One mass on a spring over time: its free vibration, and its answer from rest to a sine and to decaying forces.

    x'' + 2 zeta w_0 x' + w_0^2 x = a(t),   a = F/m

The answer to exponentials is a divided difference of exp over the exponents of system and force,

    x(t) = exp[p_1 t, p_2 t, q t] t^2      p = roots of the system, q = exponent of the force,

which has no 0/0 where exponents coincide (resonance, critical damping, no spring) and no cancellation in short times;
partial fractions have both.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

_TERMS = 22
"""Of the series of a divided difference whose points lie within 1 of each other: 1/22! is below rounding."""


# --- free vibration ---------------------------------------------------------------------------------------------


def free_response(
    natural_frequency: float, damping_ratio: float, displacement: float, speed: float, time: ArrayLike
) -> FloatArray:
    """Free vibration of a mass let go with a displacement and a speed, for any damping.

        zeta < 1:   x = exp(-zeta w_0 t) (x_0 cos(w_d t) + (v_0 + zeta w_0 x_0) sin(w_d t)/w_d)
        zeta >= 1:  x = exp(-s_1 t) (x_0 + (v_0 + s_1 x_0) (1 - exp(-(s_2 - s_1) t))/(s_2 - s_1))

    w_d = w_0 (1 - zeta^2)^(1/2); s_1, s_2 = w_0 (zeta -+ (zeta^2 - 1)^(1/2)), s_1 s_2 = w_0^2.

    Args:
        natural_frequency: w_0 [rad/s].
        damping_ratio: zeta [1].
        displacement: x_0 [m].
        speed: v_0 [m/s].
        time: t [s].

    Returns:
        x [m].

    **Range** t >= 0, zeta >= 0; w_0 = 0 is free flight, w_0 t counted in turns loses its fraction beyond 1e15.
    **Error** exact for viscous damping.
    **Source** derived: solution of the equation of motion, the slow root as w_0^2/s_2, differences by expm1.
    """
    t = np.asarray(time, float)
    if damping_ratio < 1:
        decay = damping_ratio * natural_frequency
        damped = natural_frequency * math.sqrt((1 - damping_ratio) * (1 + damping_ratio))
        swing = displacement * np.cos(damped * t) + (speed + decay * displacement) * t * _sinc(damped * t)
        return np.asarray(np.exp(-decay * t) * swing)
    root = math.sqrt((damping_ratio - 1) * (damping_ratio + 1))
    slow = natural_frequency / (damping_ratio + root)
    gap = 2 * natural_frequency * root
    reach = -np.expm1(-gap * t) / gap if gap > 0 else t
    return np.asarray(np.exp(-slow * t) * (displacement + (speed + slow * displacement) * reach))


def free_speed(
    natural_frequency: float, damping_ratio: float, displacement: float, speed: float, time: ArrayLike
) -> FloatArray:
    """Speed of a mass let go with a displacement and a speed, for any damping.

        v(t) = x(t) of `free_response` let go with v_0 and v'_0 = -2 zeta w_0 v_0 - w_0^2 x_0

    Args:
        natural_frequency: w_0 [rad/s].
        damping_ratio: zeta [1].
        displacement: x_0 [m].
        speed: v_0 [m/s].
        time: t [s].

    Returns:
        v [m/s].

    **Range** as `free_response`.
    **Error** exact for viscous damping.
    **Source** derived: the derivative obeys the same equation of motion.
    """
    start = -natural_frequency * (2 * damping_ratio * speed + natural_frequency * displacement)
    return free_response(natural_frequency, damping_ratio, speed, start, time)


def decay_envelope(natural_frequency: float, damping_ratio: float, amplitude: float, time: ArrayLike) -> FloatArray:
    """Amplitude to which a free vibration has decayed.

        A(t) = A exp(-zeta w_0 t)

    Args:
        natural_frequency: w_0 [rad/s].
        damping_ratio: zeta [1].
        amplitude: A, at t = 0 [m].
        time: t [s].

    Returns:
        amplitude; 0 once it is below the smallest float [m].

    **Range** zeta < 1.
    **Error** exact for viscous damping.
    **Source** solution of the equation of motion.
    """
    return np.asarray(amplitude * np.exp(-damping_ratio * natural_frequency * np.asarray(time, float)))


# --- from rest under a force ------------------------------------------------------------------------------------


def sine_response(natural_frequency: float, frequency: float, acceleration: float, time: ArrayLike) -> FloatArray:
    """Answer of an undamped oscillator at rest to a sine that begins, through and beside resonance.

        x'' + k^2 x = a sin(w t):   x = a (sin(w t) - (w/k) sin(k t)) / (k^2 - w^2)
                                      = a t/(2 k) (sinc(s t) cos(d t) - cos(s t) sinc(d t))

    s, d = (w +- k)/2, sinc(y) = sin(y)/y; at w = k a (sin(k t) - k t cos(k t))/(2 k^2).

    Args:
        natural_frequency: k [rad/s].
        frequency: w, of the excitation [rad/s].
        acceleration: a, force amplitude over mass [m/s^2].
        time: t [s].

    Returns:
        x [m].

    **Range** t >= 0, undamped, any k and w, 0 among them.
    **Error** exact; w t counted in turns loses its fraction beyond 1e15.
    **Source** derived: half-angle form near resonance, series for short times, the first form elsewhere.
    """
    t = np.asarray(time, float)
    a, b = natural_frequency * t, frequency * t
    larger = np.maximum(a, b)
    early, apart = larger < 1, np.abs(b - a) > larger / 2
    spread = np.where(apart & ~early, (a - b) * (a + b), 1.0)
    away = (np.sin(b) - b * _sinc(a)) / spread
    s, d = (b + a) / 2, (b - a) / 2
    beside = (_sinc(s) * np.cos(d) - np.cos(s) * _sinc(d)) / np.where(a > 0, 2 * a, 1.0)
    series = _sine_series(np.minimum(a, 1.0), np.minimum(b, 1.0))
    return np.asarray(acceleration * t**2 * np.where(early, series, np.where(apart, away, beside)))


def decay_response(
    natural_frequency: float, damping_ratio: float, decay: float, acceleration: float, time: ArrayLike
) -> FloatArray:
    """Answer of an oscillator at rest to a force that comes at once and decays.

        x'' + 2 zeta w_0 x' + w_0^2 x = a exp(-l t):   x = a t^2 exp[p_1 t, p_2 t, -l t]

    Args:
        natural_frequency: w_0 [rad/s].
        damping_ratio: zeta [1].
        decay: l, 0 for a force that stays [1/s].
        acceleration: a, force at t = 0 over mass [m/s^2].
        time: t [s].

    Returns:
        x [m].

    **Range** t >= 0, any exponents, equal ones and 0 among them.
    **Error** exact; w_0 t counted in turns loses its fraction beyond 1e15.
    **Source** derived: convolution of exponentials is a divided difference of exp (Hermite, Genocchi).
    """
    t = np.asarray(time, float)
    points = (*_roots(natural_frequency, damping_ratio), complex(-decay))
    return np.asarray(acceleration * t**2 * _divided_difference(points, t).real)


def pulse_response(
    natural_frequency: float,
    damping_ratio: float,
    slow_decay: float,
    fast_decay: float,
    acceleration: float,
    time: ArrayLike,
) -> FloatArray:
    """Answer of an oscillator at rest to a pulse that rises fast and decays slowly, as at a change of rope layer.

        x'' + 2 zeta w_0 x' + w_0^2 x = a (exp(-l_1 t) - exp(-l_2 t)):
        x = a (l_2 - l_1) t^3 exp[p_1 t, p_2 t, -l_1 t, -l_2 t]

    Args:
        natural_frequency: w_0 [rad/s].
        damping_ratio: zeta [1].
        slow_decay: l_1 [1/s].
        fast_decay: l_2 [1/s].
        acceleration: a, over mass [m/s^2].
        time: t [s].

    Returns:
        x [m].

    **Range** t >= 0, any exponents, equal ones and 0 among them.
    **Error** exact; w_0 t counted in turns loses its fraction beyond 1e15.
    **Source** derived: as `decay_response`; the pulse itself is the divided difference over its two exponents.
    """
    t = np.asarray(time, float)
    points = (*_roots(natural_frequency, damping_ratio), complex(-slow_decay), complex(-fast_decay))
    return np.asarray(acceleration * (fast_decay - slow_decay) * t**3 * _divided_difference(points, t).real)


# --- functions without 0/0 --------------------------------------------------------------------------------------


def _sinc(y: FloatArray) -> FloatArray:
    safe = np.where(y == 0, 1.0, y)
    return np.where(y == 0, 1.0, np.sin(safe) / safe)


def _sine_series(a: FloatArray, b: FloatArray) -> FloatArray:
    """`sine_response` over a t^2 for a, b up to 1: b sum (-1)^j h_j(a^2, b^2)/(2 j + 3)!, h_j = sum a^2i b^2(j-i)."""
    h, power, total = np.ones_like(a), np.ones_like(a), np.zeros_like(a)
    for j in range(10):
        total = total + (-1) ** j * h / math.factorial(2 * j + 3)
        power = power * a**2
        h = h * b**2 + power
    return b * total


def _roots(natural_frequency: float, damping_ratio: float) -> tuple[complex, complex]:
    """Exponents of the free vibration."""
    if damping_ratio < 1:
        decay = -damping_ratio * natural_frequency
        damped = natural_frequency * math.sqrt((1 - damping_ratio) * (1 + damping_ratio))
        return complex(decay, damped), complex(decay, -damped)
    sum_of = damping_ratio + math.sqrt((damping_ratio - 1) * (damping_ratio + 1))
    return complex(-natural_frequency / sum_of), complex(-natural_frequency * sum_of)


def _divided_difference(points: tuple[complex, ...], t: FloatArray) -> ComplexArray:
    """exp[p_0 t, ..., p_n t]: by its series where all points lie within 1, else split at the two farthest apart."""
    pairs = [(abs(p - q), i, j) for i, p in enumerate(points) for j, q in enumerate(points[:i])]
    if not pairs:
        return np.asarray(np.exp(points[0] * t), complex)
    width, i, j = max(pairs)
    near = width * t <= 1
    close = _series(points, width, np.where(near, t, 0.0))
    if np.all(near):
        return close
    far = np.where(near, 1.0, t)  # where it counts, the quotient loses no more than one digit
    without_i, without_j = points[:i] + points[i + 1 :], points[:j] + points[j + 1 :]
    split = (_divided_difference(without_j, far) - _divided_difference(without_i, far)) / (
        (points[i] - points[j]) * far
    )
    return np.where(near, close, split)


def _series(points: tuple[complex, ...], width: float, t: FloatArray) -> ComplexArray:
    """exp(c) sum h_k (width t)^k/(k + n)!, h_k the complete symmetric sums of the points about their mean c."""
    order, centre = len(points) - 1, sum(points) / len(points)
    sums = [1.0 + 0j] + [0j] * _TERMS
    for point in points:
        offset = (point - centre) / width if width > 0 else 0j
        for k in range(1, _TERMS + 1):
            sums[k] += offset * sums[k - 1]
    total = np.zeros_like(t, dtype=complex)
    for k in reversed(range(_TERMS + 1)):
        total = total * (width * t) + sums[k] / math.factorial(k + order)
    return np.asarray(np.exp(centre * t) * total)
