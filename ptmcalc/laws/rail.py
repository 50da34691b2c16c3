"""A wheel that climbs a step or drops into a gap of its rail: what a mass on a spring above it feels.

The wheel's centre rises over a step as half a cosine wave and dips over a gap as a whole one; both have the largest
acceleration (pi/2)^2 v^2/r. The mass answers with xi times as much: the standards take what is left of the swing
behind the place (`residual_step`, `residual_gap`), the largest may come before (`step_extremes`, `gap_extremes`).
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


def rail_acceleration(speed: float, radius: float) -> float:
    """Largest acceleration of the centre of a wheel over a step or a gap.

        a = (pi/2)^2 v^2/r

    Args:
        speed: v, of travel [m/s].
        radius: r, of the wheel [m].

    Returns:
        a [m/s^2].

    **Range** steps and gaps much smaller than the wheel.
    **Error** of the cosine for the circle the wheel really rolls on; a wheel that leaves the rail follows neither.
    **Source** EN 13001-2 and ISO 8686-1, travelling on an uneven surface; derived again.
    """
    return (math.pi / 2 * speed) ** 2 / radius


def step_number(frequency: float, speed: float, radius: float, step: float) -> float:
    """How fast a wheel climbs a step beside the swing of the mass above it.

        alpha = (w/(pi v)) (2 h r)^(1/2)

    Args:
        frequency: w = 2 pi f_q, of the mass on its spring [rad/s].
        speed: v, of travel [m/s].
        radius: r, of the wheel [m].
        step: h, of the rail [m].

    Returns:
        alpha: twice the time of the climb over the period of the mass [1].

    **Range** h << r.
    **Error** as `rail_acceleration`.
    **Source** EN 13001-2, ISO 8686-1: alpha_s = (2 f_q/v)(2 h r)^(1/2).
    """
    return frequency / (math.pi * speed) * math.sqrt(2 * step * radius)


def gap_number(frequency: float, speed: float, gap: float) -> float:
    """How fast a wheel passes a gap beside the swing of the mass above it.

        alpha = w e/(2 pi v)

    Args:
        frequency: w = 2 pi f_q, of the mass on its spring [rad/s].
        speed: v, of travel [m/s].
        gap: e, of the rail [m].

    Returns:
        alpha: time of the passage over the period of the mass [1].

    **Range** e << r.
    **Error** as `rail_acceleration`.
    **Source** EN 13001-2, ISO 8686-1: alpha_g = f_q e/v.
    """
    return frequency * gap / (2 * math.pi * speed)


def residual_step(number: ArrayLike) -> FloatArray:
    """Swing behind a step, over the acceleration of the wheel.

        xi_s = alpha^2/|1 - alpha^2| (2 + 2 cos(pi alpha))^(1/2),   pi/2 at alpha = 1

    Args:
        number: alpha, of `step_number` [1].

    Returns:
        xi_s [1].

    **Range** one undamped mode at rest before the step.
    **Error** exact for what is left of the swing; for alpha > 1 the mass has felt more before, `step_extremes`.
    **Source** EN 13001-2, ISO 8686-1; derived again, without 0/0 at alpha = 1.
    """
    a = np.asarray(number, float)
    return np.asarray(a**2 / (1 + a) * math.pi * np.abs(np.sinc((a - 1) / 2)))


def residual_gap(number: ArrayLike) -> FloatArray:
    """Swing behind a gap, over the acceleration of the wheel.

        xi_g = 2 alpha^2/|1 - alpha^2| |sin(pi alpha)|,   pi at alpha = 1

    Args:
        number: alpha, of `gap_number` [1].

    Returns:
        xi_g [1].

    **Range** one undamped mode at rest before the gap.
    **Error** exact for what is left of the swing; for alpha > 1 the mass may have felt more before, `gap_extremes`.
    **Source** EN 13001-2, ISO 8686-1; derived again, without 0/0 at alpha = 1.
    """
    a = np.asarray(number, float)
    return np.asarray(2 * a**2 / (1 + a) * math.pi * np.abs(np.sinc(a - 1)))


def _sine_over(angle: float) -> float:
    return math.sin(angle) / angle if angle else 1.0


def _answer(a: float, x: float) -> float:
    """a^2/(a^2 - 1) (cos x - cos a x): what the mass feels of cos x in the pulse; a product, good at a = 1."""
    return a * a / (a + 1) * x * math.sin((a + 1) * x / 2) * _sine_over((a - 1) * x / 2)


def _turn(a: float, low: float, high: float) -> float:
    """Where the answer turns between two places at which its slope has two signs."""

    def slope(x: float) -> float:
        lean = x * math.cos((a + 1) * x / 2) * _sine_over((a - 1) * x / 2)
        return math.sin(a * x) + lean

    rises = slope(low) > 0
    while low < (middle := (low + high) / 2) < high:
        low, high = (middle, high) if (slope(middle) > 0) == rises else (low, middle)
    return low


def _turn_near(a: float, half_turns: int, end: float) -> float:
    """The answer where it turns beside a x = k pi, a > 1."""
    low, high = (half_turns - 0.5) * math.pi / a, (half_turns + 0.5) * math.pi / a
    return _answer(a, _turn(a, low, min(high, end)))


def step_extremes(number: float) -> tuple[float, float]:
    """Most and least a mass feels while its wheel climbs a step and ever after, over the acceleration of the wheel.

        u'' + w^2 u = w^2 cos(O t) while 0 <= O t <= pi, w = alpha O, then free
        more = max(u, xi_s),   less = max(-u, xi_s)

    In the climb u = alpha^2/(alpha^2 - 1)(cos x - cos(alpha x)); its largest maximum is its first, its deepest minimum
    its last. A wheel that comes down a step swaps both.

    Args:
        number: alpha, of `step_number` [1].

    Returns:
        (more [1], less [1]): the load is 1 + more a/g at most and 1 - less a/g at least, a of `rail_acceleration`.

    **Range** one undamped mode at rest before the step, a wheel that stays on the rail: 1 - less a/g > 0.
    **Error** exact for that path of the wheel; damping lowers both.
    **Source** derived: at its turns cos(alpha x) = -+ (1 - (sin(x)/alpha)^2)^(1/2), so that maxima fall and minima sink
    along the climb; the swing behind it by `residual_step`.
    """
    rest = float(residual_step(number))
    if number < 2:  # it turns once
        return max(_answer(number, _turn(number, math.pi / 2, math.pi)), rest), rest
    more, less = _turn_near(number, 1, math.pi), -_turn_near(number, 2 * math.floor(number / 2), math.pi)
    return max(more, rest), max(less, rest)


def gap_extremes(number: float) -> tuple[float, float]:
    """Most and least a mass feels while its wheel passes a gap and ever after, over the acceleration of the wheel.

        u'' + w^2 u = -w^2 cos(O t) while 0 <= O t <= 2 pi, w = alpha O, then free
        more = max(u, xi_g),   less = max(-u, xi_g)

    Args:
        number: alpha, of `gap_number` [1].

    Returns:
        (more [1], less [1]): the load is 1 + more a/g at most and 1 - less a/g at least, a of `rail_acceleration`.

    **Range** one undamped mode at rest before the gap, a wheel that stays on the rail: 1 - less a/g > 0.
    **Error** exact for that path of the wheel; damping lowers both.
    **Source** derived as `step_extremes`; the passage is even in time, so that its largest turns stand at its ends and
    in its middle.
    """
    rest, end = float(residual_gap(number)), 2 * math.pi
    if number <= 1:
        return rest, max(_answer(number, _turn(number, math.pi / 2, math.pi)), rest)  # it rises most behind the gap
    middle = 2 * math.floor(number / 2)
    turns = {k for k in (1, 2 * math.floor(number - 0.5) + 1) if 1 <= k <= 2 * number}
    sinks = {k for k in (middle, middle + 2) if 2 <= k <= 2 * number}
    less = max(_turn_near(number, k, end) for k in turns)
    more = max(-_turn_near(number, k, end) for k in sinks)
    return max(more, rest), max(less, rest)


def wheel_modes(
    mass: float, hung_mass: float, stiffness: float, hung_stiffness: float
) -> tuple[float, float, float, float]:
    """Two modes of a crane over its wheels with a second mass on it: frequencies and shares of the force at the wheels.

        w_k^2, v_k of [(c_1 + c_2)/m_1, -c_2/(m_1 m_2)^(1/2); -c_2/(m_1 m_2)^(1/2), c_2/m_2]
        p_k = (v_k1 m_1^(1/2) + v_k2 m_2^(1/2))^2/(m_1 + m_2)

    At the wheels the load is 1 + a/g sum p_k u_k of the weight; at most 1 + a/g sum p_k more_k, with `step_extremes`
    or `gap_extremes` of each mode's number, and so with less_k.

    Args:
        mass: m_1, on the wheels: the structure [kg].
        hung_mass: m_2, on the structure: the load on its rope, or the trolley on its bridge [kg].
        stiffness: c_1, between wheels and structure [N/m].
        hung_stiffness: c_2, between the masses [N/m].

    Returns:
        (w_1 [rad/s], w_2 [rad/s], p_1 [1], p_2 [1]), the lower mode first; p_1 + p_2 = 1.

    **Range** undamped; a rope that stays taut.
    **Error** exact; the sum of both extremes is a bound, reached behind the place where the frequencies are strangers.
    **Source** derived: eigenvectors of the two masses; effective masses under a moved foot.
    """
    a, d = (stiffness + hung_stiffness) / mass, hung_stiffness / hung_mass
    b = hung_stiffness / (math.sqrt(mass) * math.sqrt(hung_mass))
    high = (a + d) / 2 + math.hypot((a - d) / 2, b)
    low = stiffness / mass * (hung_stiffness / hung_mass) / high
    turn = math.atan2(-2 * b, a - d) / 2
    total = mass + hung_mass
    one, two = math.sqrt(mass / total), math.sqrt(hung_mass / total)
    share = (math.cos(turn) * one + math.sin(turn) * two) ** 2
    other = (math.cos(turn) * two - math.sin(turn) * one) ** 2
    return math.sqrt(low), math.sqrt(high), other, share


def rail_factor(speed: float, radius: float, gravity: float, answer: float) -> float:
    """Dynamic factor phi_4 of travel over a step or a gap.

        phi_4 = 1 + (pi/2)^2 v^2/(g r) xi

    Args:
        speed: v, of travel [m/s].
        radius: r, of the wheel [m].
        gravity: g [m/s^2].
        answer: xi, of `residual_step` or `residual_gap` (the standards), of `step_extremes` or `gap_extremes`, below 0
            for the least load [1].

    Returns:
        phi_4; below 0 a wheel that leaves the rail [1].

    **Range** every wheel over a step at once: an axle that climbs alone lifts its share of the mass only.
    **Error** exact for that model.
    **Source** EN 13001-2, ISO 8686-1: phi_4 = 1 where the tolerances of the track are kept.
    """
    return 1 + rail_acceleration(speed, radius) / gravity * answer


def waviness_acceleration(speed: float, wavelength: float, height: float) -> float:
    """Largest acceleration of a wheel on a wavy rail.

        a = (h/2) (2 pi v/lambda)^2

    Args:
        speed: v, of travel [m/s].
        wavelength: lambda [m].
        height: h, from trough to crest [m].

    Returns:
        a; of the mass above it `vibration.transmissibility` times as much [m/s^2].

    **Range** waves much longer than the wheel's contact, less curved than the wheel.
    **Error** exact for a sine wave.
    **Source** derived: second derivative of the path.
    """
    return height / 2 * (2 * math.pi * (speed / wavelength)) ** 2


def tilt_way(lift: float, height: float, base: float) -> float:
    """Way of a point of a mast when a wheel of its bottom carriage is lifted.

        x = h l/B

    Args:
        lift: h, of the wheel [m].
        height: l, of the point over the rail [m].
        base: B, between the wheels [m].

    Returns:
        x [m].

    **Range** a rigid mast on a rigid carriage, small angles; the other wheel stays.
    **Error** (h/B)^2/2 of it.
    **Source** geometry of the tilt.
    """
    return lift * (height / base)


def resonance_speed(frequency: float, wavelength: float) -> float:
    """Speed at which a wavy rail shakes a mode at its own frequency.

        v = f lambda

    Args:
        frequency: w = 2 pi f, of the mode [rad/s].
        wavelength: lambda, of the rail [m].

    Returns:
        v [m/s].

    **Range** a rail of one wavelength.
    **Error** exact.
    **Source** w = 2 pi v/lambda.
    """
    return frequency / (2 * math.pi) * wavelength
