"""A load that swings under a trolley or a jib: periods, angles and what a ramp leaves behind.

The load is a point on a rope without mass, L from the pivot to its middle; it lags behind a pivot that speeds up. In
the frame of a pivot with the constant acceleration a gravity is (g^2 + a^2)^(1/2), tilted by atan(a/g).
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

_EPS = float(np.finfo(float).eps)
_MEANS = 40
"""Steps of an arithmetic-geometric mean; each doubles the digits once both means are alike."""
_STEPS = 200
_NOTHING_KNOWN = 100.0
"""Exponent of a bound behind which it says nothing any more."""
_INSIDE = 1 / math.sqrt(7)
"""Acceleration over gravity above which the horizontal force is largest before the end of the swing."""


# --- periods ----------------------------------------------------------------------------------------------------


def swing_frequency(length: ArrayLike, gravity: float) -> FloatArray:
    """Frequency of a small swing.

        w = (g/L)^(1/2)

    Args:
        length: L [m].
        gravity: g [m/s^2].

    Returns:
        w [rad/s].

    **Range** a pivot that stays, or moves at a steady speed; small angles.
    **Error** too high for an amplitude A: `swing_period` is longer by the share A^2/16 and more.
    **Source** C. Huygens, Horologium oscillatorium, 1673.
    """
    return np.asarray(np.sqrt(gravity / np.asarray(length, float)))


def swing_period(length: ArrayLike, gravity: float, amplitude: ArrayLike) -> FloatArray:
    """Period of a swing of any amplitude.

        T = 2 pi (L/g)^(1/2)/M(1, cos(A/2)),   M the arithmetic-geometric mean

    Args:
        length: L [m].
        gravity: g [m/s^2].
        amplitude: A, largest angle [rad].

    Returns:
        T [s].

    **Range** 0 <= A < pi; a rope stays taut all the way only up to pi/2.
    **Error** exact; rounding, which grows as A comes near pi.
    **Source** C. F. Gauss, Werke III: the complete elliptic integral K(k) = pi/(2 M(1, (1 - k^2)^(1/2))), k = sin(A/2).
    """
    one, two = np.broadcast_arrays(np.asarray(length, float), np.cos(np.asarray(amplitude, float) / 2))
    mean = np.ones_like(two)
    for _ in range(_MEANS):
        following = (mean + two) / 2
        if np.all(np.abs(mean - two) <= 2 * _EPS * mean):
            break
        mean, two = following, np.sqrt(mean * two)
    return np.asarray(2 * math.pi * np.sqrt(one / gravity) / mean)


def driven_frequency(length: ArrayLike, gravity: float, load_mass: ArrayLike, trolley_mass: ArrayLike) -> FloatArray:
    """Frequency of a small swing under a trolley that a force drives, or nothing.

        w = ((g/L)(1 + M/m))^(1/2)

    Args:
        length: L [m].
        gravity: g [m/s^2].
        load_mass: M [kg].
        trolley_mass: m, with the rotating masses of its drive [kg].

    Returns:
        w [rad/s].

    **Range** a force that does not depend on the speed; small angles.
    **Error** exact for small angles; `swing_frequency` (a speed imposed) is its limit for a heavy trolley.
    **Source** derived: u = L theta is the distance of two masses, u'' = -g theta - F/m - (M/m) g theta.
    """
    ratio = np.asarray(load_mass, float) / np.asarray(trolley_mass, float)
    return np.asarray(np.sqrt(gravity / np.asarray(length, float) * (1 + ratio)))


# --- angles under a constant acceleration -------------------------------------------------------------------------


def steady_lean(acceleration: ArrayLike, gravity: float) -> FloatArray:
    """Angle at which a load hangs behind a pivot that keeps its acceleration, when the swing has died out.

        theta = atan(a/g)

    Args:
        acceleration: a [m/s^2].
        gravity: g [m/s^2].

    Returns:
        theta [rad].

    **Range** any a.
    **Error** exact; a/g in its place is too large by the share (a/g)^2/3 at most.
    **Source** equilibrium in the frame of the pivot.
    """
    return np.asarray(np.arctan(np.asarray(acceleration, float) / gravity))


def largest_lean(acceleration: ArrayLike, gravity: float) -> FloatArray:
    """Largest angle of a load that hung at rest when its pivot got a constant acceleration.

        theta = 2 atan(a/g)

    Args:
        acceleration: a, imposed; of a trolley under a constant force F it is F/(m + M) [m/s^2].
        gravity: g [m/s^2].

    Returns:
        theta [rad].

    **Range** an acceleration that lasts for half a swing at least; for a shorter one `ramp_swing`.
    **Error** exact at any angle, and for a driven trolley too: in the frame with the acceleration F/(m + M) no
    momentum comes in, and both masses rest where g (1 - cos theta) = a sin theta. The rope stays taut: its pull is
    M g at the extremes and more between. 2 a/g in its place is too large.
    **Source** derived: energy in the frame of the pivot.
    """
    return np.asarray(2 * np.arctan(np.asarray(acceleration, float) / gravity))


def swing_force(load_mass: float, acceleration: float, gravity: float) -> float:
    """Largest horizontal force of a load on a pivot that suddenly gets a constant acceleration.

        F = M g sin(2 atan(a/g)) = 2 M a/(1 + (a/g)^2)         a/g <= 7^(-1/2)
        F = max over theta of M ((3 (g cos + a sin) - 2 g) sin)  above, before the end of the swing

    Args:
        load_mass: M [kg].
        acceleration: a, imposed [m/s^2].
        gravity: g [m/s^2].

    Returns:
        F [N].

    **Range** as `largest_lean`.
    **Error** exact; the formula of the first line is too small above a/g = 0.378 (by 4 % at
    a = g/2, by 45 % at a = g).
    **Source** derived: rope tension from the energy, T = M (3 (g cos + a sin) - 2 g); the derivative at the end of
    the swing changes its sign at 7 a^2 = g^2.
    """
    share = acceleration / gravity
    if share <= _INSIDE:
        return 2 * load_mass * acceleration / (1 + share * share)
    low, high = 0.0, 2 * math.atan(share)
    for _ in range(_STEPS):
        theta = (low + high) / 2
        rises = 3 / share * math.cos(2 * theta) - 2 / share * math.cos(theta) + 3 * math.sin(2 * theta) > 0
        low, high = (theta, high) if rises else (low, theta)
        if high - low <= _EPS * high:
            break
    sine, cosine = math.sin(low), math.cos(low)
    return load_mass * acceleration * sine * ((3 * cosine - 2) / share + 3 * sine)


def driven_slow_down(acceleration: float, frequency: float, mass_ratio: float) -> float:
    """Largest speed by which a trolley under a constant force leads or lags the uniform start, swinging with its load.

        v - a t = a (M/m)/w sin(w t):   dv = a (M/m)/w

    Args:
        acceleration: a = F/(m + M), of both together [m/s^2].
        frequency: w, of `driven_frequency` [rad/s].
        mass_ratio: M/m, load over trolley [1].

    Returns:
        dv [m/s].

    **Range** small angles, a load at rest at first. The trolley's own acceleration is a (1 + (M/m) cos(w t)): from
    M = m on it runs back for a while.
    **Error** exact for small angles.
    **Source** derived: momentum m v + M (v + u') = F t.
    """
    return acceleration * mass_ratio / frequency


# --- ramps --------------------------------------------------------------------------------------------------------


def ramp_residual(acceleration: ArrayLike, gravity: float, frequency: float, ramp_time: ArrayLike) -> FloatArray:
    """Swing that is left when a pivot has sped up from rest to a steady speed along a ramp, by small angles.

        A = (2 a/g) |sin(w t_a/2)|

    Args:
        acceleration: a [m/s^2].
        gravity: g [m/s^2].
        frequency: w, of `swing_frequency` [rad/s].
        ramp_time: t_a [s].

    Returns:
        A, largest angle of the swing [rad].

    **Range** a load at rest at first; nothing is left after whole periods.
    **Error** of the angle at any time: `small_angle_error`; of A itself: compare `ramp_swing`, which is exact.
    **Source** derived: two steps of the acceleration t_a apart.
    """
    phase = frequency * np.asarray(ramp_time, float) / 2
    return np.asarray(2 * np.abs(np.asarray(acceleration, float)) / gravity * np.abs(np.sin(phase)))


def ramp_swing(acceleration: float, gravity: float, length: float, ramp_time: float) -> tuple[float, float]:
    """Largest angle while a pivot speeds up along a ramp and after, and the swing that is left, at any angle.

        theta_1 = 2 (asin k - asin(k cd(w_e t_a, k))),   k = sin(atan(a/g)/2),   w_e^2 = (g^2 + a^2)^(1/2)/L
        sin(A/2) = ((a/(2 g)) sin theta_1)^(1/2)

    theta_1 is the angle at the end of the ramp, cd = cn/dn Jacobi's functions.

    Args:
        acceleration: a, not below 0 [m/s^2].
        gravity: g [m/s^2].
        length: L [m].
        ramp_time: t_a [s].

    Returns:
        largest angle, 2 atan(a/g) once the ramp lasts half a swing, and A [rad].

    **Range** a load at rest at first; pi for a load that goes over the top. Beyond a = g the rope may go slack after
    the ramp, where the swing is no longer one.
    **Error** exact; rounding of w_e t_a in many swings.
    **Source** derived: the pendulum in tilted gravity starts at its turning point; energy after the ramp.
    """
    tilt = math.atan2(acceleration, gravity)
    modulus, rest = math.sin(tilt / 2), math.cos(tilt / 2)
    phase = math.sqrt(math.hypot(gravity, acceleration) / length) * ramp_time
    quarter = math.pi / 2 / _mean(1.0, rest)
    sn, cn, dn = _jacobi(math.fmod(phase, 4 * quarter), modulus, rest)
    if cn > 0:  # the difference of nearly equal angles keeps its digits
        less = (rest * sn) ** 2 / (dn * (dn + cn))
        other = modulus * cn / dn
        across = modulus * math.sqrt((1 - other) * (1 + other)) + other * rest
        half = math.asin(min(modulus**2 * less * (2 - less) / across, 1.0)) if across else 0.0
    else:
        half = math.asin(modulus) - math.asin(modulus * cn / dn)
    left = 2 * math.asin(min(math.sqrt(max(acceleration / (2 * gravity) * math.sin(2 * half), 0.0)), 1.0))
    return (max(2 * tilt, left) if phase >= 2 * quarter else max(2 * half, left)), left


def _mean(one: float, two: float) -> float:
    """Arithmetic-geometric mean."""
    for _ in range(_MEANS):
        if abs(one - two) <= 2 * _EPS * one:
            break
        one, two = (one + two) / 2, math.sqrt(one * two)
    return one


def _jacobi(phase: float, modulus: float, rest: float) -> tuple[float, float, float]:
    """sn, cn and dn, by descending Landen steps; `rest` = (1 - modulus^2)^(1/2)."""
    means, gaps = [1.0], [modulus]
    geometric = rest
    while gaps[-1] > _EPS * means[-1] and len(means) < _MEANS:
        one = means[-1]
        means.append((one + geometric) / 2)
        gaps.append((one - geometric) / 2)
        geometric = math.sqrt(one * geometric)
    angle = 2.0 ** (len(means) - 1) * means[-1] * phase
    for mean, gap in zip(means[:0:-1], gaps[:0:-1], strict=True):
        angle = (angle + math.asin(gap / mean * math.sin(angle))) / 2
    sine = math.sin(angle)
    return sine, math.cos(angle), math.sqrt((1 - modulus * sine) * (1 + modulus * sine))


def start_stop_residual(
    speed: float, gravity: float, frequency: float, start_time: float, run_time: float, stop_time: float
) -> float:
    """Swing that is left when a pivot has sped up, run at a steady speed and stopped, by small angles.

        A = (v w/g) |e_1 - e_2 exp(i w (t_1/2 + t_r + t_2/2))|,   e_k = sin(w t_k/2)/(w t_k/2)

    Args:
        speed: v, between the ramps [m/s].
        gravity: g [m/s^2].
        frequency: w, of `swing_frequency` [rad/s].
        start_time: t_1 [s].
        run_time: t_r [s].
        stop_time: t_2 [s].

    Returns:
        A [rad].

    **Range** a load at rest at first; times not below 0, a ramp of no time is a jump of the speed.
    **Error** of the angle at any time: `small_angle_error`.
    **Source** derived: Fourier integral of the acceleration at w; each ramp as if it were a jump in its middle.
    """
    one, two = (abs(float(np.sinc(frequency * t / (2 * math.pi)))) for t in (start_time, stop_time))
    same = np.sinc(frequency * start_time / (2 * math.pi)) * np.sinc(frequency * stop_time / (2 * math.pi)) >= 0
    turn = frequency * (start_time / 2 + run_time + stop_time / 2) / 2
    # |e_1 - e_2 exp(i x)|^2 = (e_1 - e_2)^2 + 4 e_1 e_2 sin^2(x/2)
    wave = math.sin(turn) if same else math.cos(turn)
    return abs(speed) * frequency / gravity * math.hypot(one - two, 2 * math.sqrt(one * two) * wave)


def cancelling_ramp(speed: float, acceleration: float, period: float) -> float:
    """Shortest ramp to a speed that leaves no swing and is not steeper than an acceleration.

        t_a = n T,   n the next whole number from v/(a T) on

    Args:
        speed: v [m/s].
        acceleration: a, largest that may be used [m/s^2].
        period: T of the small swing [s].

    Returns:
        t_a; the acceleration to use is v/t_a [s].

    **Range** v > 0, a load at rest at first, a constant acceleration.
    **Error** exact for small angles; what is left at finite ones: `ramp_swing`.
    **Source** derived: zeros of `ramp_residual`.
    """
    return max(math.ceil(speed / acceleration / period * (1 - 4 * _EPS)), 1) * period


# --- hoisting while the load swings -------------------------------------------------------------------------------


def hoisted_angle(angle: ArrayLike, length: ArrayLike, other: ArrayLike) -> FloatArray:
    """Amplitude of a swing after its rope got shorter or longer, slowly.

        A_1 = A_0 (L_0/L_1)^(3/4)

    Args:
        angle: A_0 [rad].
        length: L_0 [m].
        other: L_1 [m].

    Returns:
        A_1; the load swings out by L A, which goes with L^(1/4) [rad].

    **Range** small angles, a steady hoisting speed.
    **Error** lies within `hoisted_angle_bounds`.
    **Source** derived: the action of the swing, M g L A^2/w, stays (P. Ehrenfest).
    """
    ratio = np.asarray(length, float) / np.asarray(other, float)
    return np.asarray(np.asarray(angle, float) * ratio**0.75)


def hoisted_angle_bounds(
    angle: float, length: float, other: float, speed: float, gravity: float
) -> tuple[float, float]:
    """Interval that holds the amplitude of a swing after hoisting at any steady speed, begun and ended at once.

        A_1 = A_0 (L_0/L_1)^(3/4) exp(-x ... x),   e = |V|/(g L)^(1/2)
        x = asinh(3 e_0/8) + asinh(3 e_1/8) + (3/16) |e_1 - e_0|

    Args:
        angle: A_0, amplitude before [rad].
        length: L_0 [m].
        other: L_1 [m].
        speed: V, of the rope [m/s].
        gravity: g [m/s^2].

    Returns:
        smallest and largest A_1, whatever the phase; infinite for a rope far faster than its load swings [rad].

    **Range** small angles, V != 0 steady in between.
    **Error** a proven interval.
    **Source** derived after Liouville and Green: with u = L theta = L^(1/4) Y and the phase int w dt,
    Y'' + (1 + r) Y = 0 with r = (3/16) V^2/(g L), so |(Y, Y')| changes by exp(int |r|/2) at most; where hoisting begins
    and ends Y' jumps by (3/4) e Y against the amplitude.
    """
    before, after = (abs(speed) / math.sqrt(gravity * one) for one in (length, other))
    x = math.asinh(3 / 8 * before) + math.asinh(3 / 8 * after) + 3 / 16 * abs(after - before)
    slow = float(hoisted_angle(angle, length, other))
    return slow * math.exp(-x), slow * math.exp(x) if x < _NOTHING_KNOWN else math.inf


# --- slewing ------------------------------------------------------------------------------------------------------


def slewing_lean(speed: float, radius: float, length: float, gravity: float) -> float:
    """Angle by which a load hangs outward under a jib that slews steadily.

        tan(theta) = w^2 (R + L sin(theta))/g

    Args:
        speed: w, of the jib [rad/s].
        radius: R, of the pivot [m].
        length: L [m].
        gravity: g [m/s^2].

    Returns:
        theta; under the axis itself (R = 0) the angle of a conical pendulum once w^2 L > g [rad].

    **Range** R >= 0, a swing that has died out.
    **Error** rounding: for t = tan(theta) the right side is concave, and Newton's method from above meets the only
    root.
    **Source** equilibrium in the turning frame.
    """
    pull = speed * speed * radius / gravity
    more = speed * speed * length / gravity
    if radius == 0:
        return math.acos(1 / more) if more > 1 else 0.0
    t = pull + more
    for _ in range(_STEPS):
        root = math.hypot(1.0, t)
        value = pull + more * (t / root) - t
        slope = more / root / root / root - 1
        step = value / slope if slope < 0 else t
        following = t - step
        if not 0 < following < t:
            break
        t = following
    return math.atan(t)


# --- what small angles leave out ----------------------------------------------------------------------------------


def small_angle_error(angle: float, phase: float, push: float) -> float:
    """Most by which the angle of a swing computed as small may be wrong.

        E = phase H^3/6 + push H^2/2,   H = A + E: the smaller root

    Args:
        angle: A, largest angle met in the linear computation [rad].
        phase: w t, from the beginning until the time in question [rad].
        push: w/g times the sum of all changes of the pivot's speed up to then, int |a| dt [1].

    Returns:
        E, bound of |(e, e'/w)| with e the error of the angle; infinite where no bound follows [rad].

    **Range** a rope of constant length in a plane, a pivot whose motion is imposed.
    **Error** a bound; it grows with the time, as the two swings go out of step.
    **Source** derived: e'' + w^2 e = w^2 (theta - sin theta) + (a/L)(1 - cos theta) and |theta| <= H; while E < H - A
    holds the angle cannot leave H.
    """
    error = 0.0
    for _ in range(_STEPS):
        largest = angle + error
        value = phase * largest**3 / 6 + push * largest**2 / 2 - error
        slope = phase * largest**2 / 2 + push * largest - 1
        if value <= 0:
            return error
        if slope >= 0 or largest > math.pi:
            return math.inf
        following = error - value / slope
        if following <= error * (1 + 4 * _EPS):
            return following
        error = following
    return error
