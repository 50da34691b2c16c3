"""Torque of motors over speed, slip and time: the start, the induction motor, its rheostat, the converter.

Slip is (w0 - w)/w0: 1 at rest, 0 at the synchronous speed, negative where the load drives (generating), above 1 where
the motor is turned against its field (counter-current braking).
"""

import math
from functools import cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


def mean_starting_torque(largest: float, smallest: float) -> float:
    """Mean torque of a stepped (rheostat) or soft start.

        M = (M_max + M_min) / 2

    Args:
        largest: M_max, torque after each switching step [N*m].
        smallest: M_min, torque before each switching step [N*m].

    Returns:
        M [N*m].

    **Range** steps of equal height; for a motor curve take its mean over the speed range.
    **Error** none bound: the mean stands for the real torque history.
    **Source** lecture notes Kramatorsk 2007.
    """
    return (largest + smallest) / 2


def rim_force(torque: float, ratio: float, efficiency: float, drum_radius: float) -> float:
    """Force of a motor torque at the rim of the drum.

        F = M i eta / R

    Args:
        torque: M, of all motors, on the motor shaft [N*m].
        ratio: i, motor speed over drum speed [1].
        efficiency: eta, of the gear from motor to drum [1].
        drum_radius: R, drum radius [m].

    Returns:
        F [N].

    **Range** power flows from motor to drum.
    **Error** exact for a gear of constant efficiency.
    **Source** lecture notes Kramatorsk 2007.
    """
    return torque * ratio * efficiency / drum_radius


def rated_torque(power: float, speed: float) -> float:
    """Torque of a motor at its rating.

        M_n = P_n / w_n

    Args:
        power: P_n, rated power on the shaft [W].
        speed: w_n, rated speed of the shaft, not the synchronous one [rad/s].

    Returns:
        M_n [N*m].

    **Range** the pair of power and speed on the rating plate.
    **Error** exact.
    **Source** definition of power.
    """
    return power / speed


def linear_torque(speed: ArrayLike, starting_torque: float, no_load_speed: float) -> FloatArray:
    """Torque of a motor whose curve is a straight line (shunt or permanent-magnet DC, servo on voltage).

        M = M_s (1 - w / w0)

    Args:
        speed: w, of the motor shaft [rad/s].
        starting_torque: M_s, at rest [N*m].
        no_load_speed: w0, where the torque is 0 [rad/s].

    Returns:
        M [N*m].

    **Range** constant voltage and flux; beyond both ends the same line holds (generating, counter-current braking).
    **Error** exact without armature reaction and brush drop.
    **Source** back electromotive force and Ohm's law of the armature.
    """
    return np.asarray(starting_torque * ((no_load_speed - np.asarray(speed, float)) / no_load_speed))


def slip(speed: ArrayLike, synchronous_speed: float) -> FloatArray:
    """Slip of an induction motor.

        s = (w0 - w) / w0

    Args:
        speed: w, of the rotor [rad/s].
        synchronous_speed: w0, of the field [rad/s].

    Returns:
        s [1].

    **Range** any speed: negative above the synchronous one, above 1 against the field.
    **Error** exact.
    **Source** definition.
    """
    return np.asarray((synchronous_speed - np.asarray(speed, float)) / synchronous_speed)


def breakdown_slip(rated_slip: float, overload: float, stator_ratio: float = 0.0) -> float:
    """Slip of the largest torque of an induction motor, from its rating.

        M(s_n) = M_n  =>  (1 - 2 a s_n (lambda - 1)) s_k^2 - 2 lambda s_n s_k + s_n^2 = 0, the larger root:
        s_k = s_n (lambda + sqrt((lambda - 1)(lambda + 1 + 2 a s_n))) / (1 - 2 a s_n (lambda - 1))

    Args:
        rated_slip: s_n [1].
        overload: lambda = M_k/M_n, largest torque over the rated one, at least 1 [1].
        stator_ratio: a = R_1/R_2', resistance of the stator over that of the rotor as seen from it; 0 for the
            simplified formula [1].

    Returns:
        s_k [1].

    Raises:
        ValueError: no motor has this rating: its a s_k = R_1/hypot(R_1, X) would not be below 1.

    **Range** a s_n (sqrt(lambda) + sqrt(lambda - 1))^2 < 1, which is a s_k < 1.
    **Error** exact for the curve of `kloss`; a list may be off by 20 % in the rated slip and 10 % in the
    breakdown torque (tolerances of IEC 60034-1).
    **Source** derived: the rated point put into the formula of Kloss; a = 0 gives s_n (lambda + sqrt(lambda^2 - 1)).
    """
    if stator_ratio >= largest_stator_ratio(rated_slip, overload):
        raise ValueError("no induction motor has this slip and overload with so large a stator resistance")
    a = stator_ratio
    root = math.sqrt((overload - 1) * (overload + 1 + 2 * a * rated_slip))
    return rated_slip * (overload + root) / (1 - 2 * a * rated_slip * (overload - 1))


def largest_stator_ratio(rated_slip: float, overload: float) -> float:
    """Limit below which the stator resistance lies for a rating to belong to an induction motor.

        a s_k = 1  =>  a = 1 / (s_n (sqrt(lambda) + sqrt(lambda - 1))^2)

    Args:
        rated_slip: s_n [1].
        overload: lambda = M_k/M_n, at least 1 [1].

    Returns:
        a = R_1/R_2' [1].

    **Range** any rating.
    **Error** exact for the curve of `kloss`.
    **Source** derived: a s_k = R_1/hypot(R_1, X) is below 1 for any stray reactance X; at 1 the generating branch has
    a pole.
    """
    return 1 / rated_slip / (math.sqrt(overload) + math.sqrt(overload - 1)) ** 2


def kloss(slip: ArrayLike, breakdown_torque: float, breakdown_slip: float, stator_ratio: float = 0.0) -> FloatArray:
    """Torque of an induction motor over its slip (formula of Kloss).

        M = 2 M_k (1 + a s_k) s s_k / (s^2 + s_k^2 + 2 a s_k^2 s)

    Args:
        slip: s [1].
        breakdown_torque: M_k, the largest torque as a motor [N*m].
        breakdown_slip: s_k, where it is reached [1].
        stator_ratio: a = R_1/R_2', resistance of the stator over that of the rotor as seen from it; 0 for the
            simplified formula [1].

    Returns:
        M, negative where it generates [N*m].

    **Range** steady supply, constant parameters, a s_k < 1. Generating (s < 0) the largest torque is
    -M_k (1 + a s_k)/(1 - a s_k).
    **Error** exact for the equivalent circuit with its magnetising branch at the terminals; a cage with current
    displacement (deep bars, two cages) gives more torque at rest than the formula: take its table instead. The electric
    transient of the first periods is left out.
    **Source** M. Kloss, Archiv fuer Elektrotechnik 5 (1916).
    """
    x, q = _folded(slip, breakdown_slip), stator_ratio * breakdown_slip
    return np.asarray(2 * breakdown_torque * (1 + q) * x / _denominator(x, q))


def kloss_slope(
    slip: ArrayLike, breakdown_torque: float, breakdown_slip: float, stator_ratio: float = 0.0
) -> FloatArray:
    """Rise of the torque of an induction motor with its slip.

        dM/ds = 2 M_k (1 + a s_k) s_k (s_k^2 - s^2) / (s^2 + s_k^2 + 2 a s_k^2 s)^2

    Args:
        slip: s [1].
        breakdown_torque: M_k [N*m].
        breakdown_slip: s_k [1].
        stator_ratio: a = R_1/R_2'; 0 for the simplified formula [1].

    Returns:
        dM/ds; over the speed it is dM/dw = -dM/ds / w0 [N*m].

    **Range** as `kloss`.
    **Error** exact derivative of `kloss`.
    **Source** derived.
    """
    x, q = _folded(slip, breakdown_slip), stator_ratio * breakdown_slip
    outside = np.abs(np.asarray(slip, float)) > breakdown_slip
    shape = (1 - x) * (1 + x) * np.where(outside, -(x**2), 1.0)
    return np.asarray(2 * breakdown_torque * (1 + q) / breakdown_slip * shape / _denominator(x, q) ** 2)


def _folded(slip: ArrayLike, breakdown_slip: float) -> FloatArray:
    """s/s_k or its inverse, whichever is not above 1: the curve takes both alike, and nothing overflows."""
    s = np.asarray(slip, float)
    inside = np.abs(s) <= breakdown_slip
    return np.asarray(np.where(inside, s, breakdown_slip) / np.where(inside, breakdown_slip, s))


def _denominator(x: FloatArray, q: float) -> FloatArray:
    """1 + 2 q x + x^2 for -1 <= x <= 1, without cancelling where x is near -1 and q near 1."""
    return (1 + x) ** 2 - 2 * x * (1 - q)


def kloss_slip(
    torque: ArrayLike, breakdown_torque: float, breakdown_slip: float, stator_ratio: float = 0.0
) -> FloatArray:
    """Slip at which an induction motor steadily carries a torque: the inverse of `kloss` on its stable branch.

        s = s_k M / (N + sqrt(N^2 - M^2)),  N = M_k (1 + a s_k) - a s_k M

    Args:
        torque: M, of the load; negative when it drives [N*m].
        breakdown_torque: M_k [N*m].
        breakdown_slip: s_k [1].
        stator_ratio: a = R_1/R_2'; 0 for the simplified formula [1].

    Returns:
        s, between -s_k and s_k [1].

    Raises:
        ValueError: the torque is beyond the largest one the motor can give or, generating, take.

    **Range** a s_k < 1; -M_k (1 + a s_k)/(1 - a s_k) <= M <= M_k.
    **Error** exact inverse of `kloss`; near M_k the slip is as the square root of the torque that is left.
    **Source** derived: the quadratic in s/s_k.
    """
    q = stator_ratio * breakdown_slip
    m = np.asarray(torque, float) / breakdown_torque
    above, below = (1 + q) * (1 - m), (1 + m) + q * (1 - m)  # N - M and N + M over M_k
    if np.any(above < 0) or np.any(below < 0):
        raise ValueError("the motor has no steady slip at this torque: it is beyond the breakdown torque")
    return np.asarray(breakdown_slip * m / ((above + below) / 2 + np.sqrt(above) * np.sqrt(below)))


@cache
def _gauss() -> tuple[FloatArray, FloatArray]:
    """Nodes and weights of a quadrature, made when they are asked for: numpy.polynomial takes a while to import."""
    nodes, weights = np.polynomial.legendre.leggauss(16)
    return nodes, weights


def mean_kloss_torque(
    from_slip: float, to_slip: float, breakdown_torque: float, breakdown_slip: float, stator_ratio: float = 0.0
) -> float:
    """Mean torque of an induction motor over a range of speed.

        M = 1/(s_2 - s_1) * integral of M(s) ds from s_1 to s_2

    Args:
        from_slip: s_1, at one end of the range [1].
        to_slip: s_2, at the other [1].
        breakdown_torque: M_k [N*m].
        breakdown_slip: s_k [1].
        stator_ratio: a = R_1/R_2'; 0 for the simplified formula [1].

    Returns:
        M [N*m].

    **Range** as `kloss`. It does the work of the start; the time of a start asks for the mean of 1/(M - M_load).
    **Error** Gauss-Legendre of 16 nodes on panels of asinh(s/s_k): 1e-13 of M_k as a motor and up to a s_k = 0.9 as a
    generator; beyond, next to the pole, 1e-5 at a s_k = 0.99.
    **Source** derived.
    """
    ends = math.asinh(from_slip / breakdown_slip), math.asinh(to_slip / breakdown_slip)
    panels = max(math.ceil(2 * abs(ends[1] - ends[0])), 1)
    nodes, node_weights = _gauss()
    edges = np.linspace(*ends, panels + 1)
    u = ((edges[1:] + edges[:-1])[:, None] + np.diff(edges)[:, None] * nodes) / 2
    weights = np.cosh(u) * node_weights
    torque = kloss(breakdown_slip * np.sinh(u), breakdown_torque, breakdown_slip, stator_ratio)
    return float(np.sum(torque * (weights / np.sum(weights))))


def stage_breakdown_slip(breakdown_slip: float, resistance_factor: float) -> float:
    """Breakdown slip of a slip-ring motor with resistance in its rotor circuit.

        s_k' = f s_k,  M_k' = M_k,  a' s_k' = a s_k

    Args:
        breakdown_slip: s_k, of the natural curve, the slip rings short-circuited [1].
        resistance_factor: f, resistance of the whole rotor circuit over that of the rotor alone [1].

    Returns:
        s_k' [1].

    **Range** resistance only, equal in the three phases; the same factor takes every slip of the natural curve to
    that of the same torque, and a = R_1/R_2' falls to a/f.
    **Error** exact for the equivalent circuit.
    **Source** the circuit knows slip and rotor resistance only as R_2'/s.
    """
    return breakdown_slip * resistance_factor


def switching_speed(resistance_factor: ArrayLike, natural_slip: float, synchronous_speed: float) -> FloatArray:
    """Speed at which the torque of a rheostat stage has fallen to the switching torque.

        w = w0 (1 - f s)

    Args:
        resistance_factor: f, resistance of the rotor circuit of the stage over that of the rotor alone [1].
        natural_slip: s, at the switching torque on the natural curve, see `kloss_slip` [1].
        synchronous_speed: w0 [rad/s].

    Returns:
        w; negative where the stage gives less than that torque from rest on [rad/s].

    **Range** the stable branch of the stage: f s below f s_k.
    **Error** exact for the equivalent circuit.
    **Source** derived, see `stage_breakdown_slip`.
    """
    return np.asarray(synchronous_speed * (1 - np.asarray(resistance_factor, float) * natural_slip))


def rheostat_factors(slip_at_largest: float, slip_at_smallest: float) -> FloatArray:
    """Resistances of a rheostat between whose steps the torque swings from a smallest to a largest one.

        f_j = (1 / s_1) (s_2 / s_1)^(j - 1),  j = 1, 2, ... as long as f_j > 1

    The first step gives the largest torque at rest; each switching at the smallest torque lifts it to the largest one
    again, the last one, onto the natural curve, to no more.

    Args:
        slip_at_largest: s_1, at the largest torque on the natural curve, below 1 [1].
        slip_at_smallest: s_2, at the smallest torque on the natural curve, below s_1 [1].

    Returns:
        f_1, f_2, ...: resistance of the rotor circuit over that of the rotor alone, one for each step [1].

    **Range** both torques below breakdown: 0 < s_2 < s_1 < 1.
    **Error** exact for the equivalent circuit.
    **Source** derived: at the speed of switching f_j s_2 = f_(j+1) s_1.
    """
    fall = math.log(slip_at_largest / slip_at_smallest)
    steps = math.ceil(
        -math.log(slip_at_largest) / fall - 1e-9
    )  # the last may fall on the natural curve but for rounding
    return np.asarray((slip_at_smallest / slip_at_largest) ** np.arange(steps) / slip_at_largest)


def converter_reference(time: ArrayLike, target: float, ramp_time: float) -> FloatArray:
    """Reference speed of a drive on a frequency converter: a ramp to the target.

        w_r = w_t min(t / t_r, 1)

    Args:
        time: t, since the start [s].
        target: w_t, speed asked for [rad/s].
        ramp_time: t_r, of the ramp; 0 asks for it at once [s].

    Returns:
        w_r; 0 before the start [rad/s].

    **Range** a straight ramp.
    **Error** exact.
    **Source** definition.
    """
    t = np.clip(np.asarray(time, float), 0.0, ramp_time)
    if ramp_time == 0:
        return np.where(np.asarray(time, float) >= 0, target, 0.0)
    return np.asarray(target * (t / ramp_time))


def converter_torque(speed: ArrayLike, reference: ArrayLike, stiffness: float, limit: float) -> FloatArray:
    """Torque of a drive on a frequency converter with a torque limit.

        M = h (w_r - w), no larger in size than M_lim

    Args:
        speed: w, of the motor shaft [rad/s].
        reference: w_r, speed asked for at that time [rad/s].
        stiffness: h, torque per speed it falls short of [N*m*s/rad].
        limit: M_lim, both driving and braking [N*m].

    Returns:
        M [N*m].

    **Range** a proportional speed control, or a motor at constant flux below breakdown; a regulator with an integral
    part holds the speed without the droop M/h.
    **Error** the inner current loop, about 1 to 5 ms, is left out.
    **Source** the straight part of the curve of `kloss`, carried along by the frequency.
    """
    difference = np.asarray(reference, float) - np.asarray(speed, float)
    return np.asarray(np.clip(stiffness * difference, -limit, limit))
