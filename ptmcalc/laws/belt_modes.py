"""Natural frequencies of a belt loop with all its masses, none missed and none spurious, and how they are damped.

The loop is that of `loop_bounds`: drive drum m, return strand 2, tail drum m_t, carry strand 1. A strand of mass m_i
and compliance C_i has the impedance Z_i = sqrt(m_i/C_i) and the phase theta_i = w sqrt(m_i C_i), with s_i and c_i its
sine and cosine. M is the weight of the take-up on two falls and k = M/4: it moves half as fast as the two falls differ,
and pulls each with half its force. The frequencies are the roots of

    B = Z1 c1 s2 + Z2 c2 s1 - m_t w s1 s2                                     fixed length, speed imposed
    A = Z1 Z2 c1 c2 - Z2^2 s1 s2 - m_t w Z2 s1 c2                             gravity, speed imposed (k = 0)
    A - k w B                                                                 weight M, speed imposed
    R = 2 Z1 Z2 (c1 c2 - 1) - (Z1^2 + Z2^2) s1 s2 - m_t w (Z1 c1 s2 + Z2 c2 s1)
    R - m w B                                                                 fixed length, torque imposed
    G = -Z1^2 Z2 s1 c2 - Z2^2 Z1 c1 s2 - m_t w Z1 Z2 c1 c2
    G - k w R - m w (A - k w B)                                               weight M, torque imposed; k = 0: gravity

**Why none is missed.** With the speed imposed the loop is a chain from the take-up to the clamped drum. In polar form,
u = r sin(phi) and S = Z w r cos(phi), the angle phi grows by theta on each strand and with w everywhere; it never
leaves its half turn at a mass or a jump of Z. So the modes below w are the half turns of phi at the drum. Letting the
drum go adds a mode wherever its dynamic stiffness, K = w (line with the torque)/(line with the speed imposed), is
negative: Wittrick and Williams' count for one freed displacement. The denominator is positive at w = 0 and changes its
sign at each of its roots, which are single: its sign is that of (-1)^(half turns), and rounding beside a root of it
cannot make count and sign disagree. Halving a bracket by the count finds every frequency, double ones twice.
"""

import itertools
import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ptmcalc.laws.loop_bounds import LoopMasses

FloatArray = NDArray[np.float64]

_CLOSE = 2.0**-52
"""Relative width at which an interval counts as a number."""


class _Waves(NamedTuple):
    """Travel times [s] and impedances [N*s/m] of both strands."""

    carry_time: float
    return_time: float
    carry: float
    back: float


def natural_frequencies(loop: LoopMasses, takeup_mass: float, count: int) -> FloatArray:
    """The lowest natural circular frequencies of a belt loop.

        w_n = smallest w at which N(w) >= n,   N of `modes_below`

    Args:
        loop: the loop; its drum is clamped when the speed is imposed.
        takeup_mass: M, weight of the take-up in two falls; 0 for a constant tension, and without effect in a loop of
            fixed length [kg].
        count: how many.

    Returns:
        w_1 <= w_2 <= ..., without the rigid motion of a loop whose drum is free [rad/s].

    **Range** undamped linear strands with mass; take-up beside the drive, its two falls short against a wave.
    **Error** rounding: some 1e-14 of each frequency, 1e-8 where two nearly coincide, 1e-4 where masses lie 20 decades
    apart.
    **Source** frequency equations in the module docstring, derived; W. H. Wittrick, F. W. Williams, "A general
    algorithm for computing natural frequencies of elastic structures", Q. J. Mech. Appl. Math. 24 (1971).
    """
    waves, quarter = _waves(loop), takeup_mass / 4
    return np.array([_frequency(loop, waves, quarter, order) for order in range(1, count + 1)])


def _frequency(loop: LoopMasses, waves: _Waves, quarter: float, order: int) -> float:
    """One of them. The count says on which side of a place it lies; the line says where to look next: at its chord,
    drawn as Illinois does, or in the middle, in every fourth step and where both ends lie on one side of it."""
    high = (order + 4) * (math.pi / (waves.carry_time + waves.return_time))  # N >= (theta_1 + theta_2)/pi - 3
    low = high / 2
    at_high, at_low = _seen(loop, waves, quarter, high).line, _seen(loop, waves, quarter, low)
    while at_low.below >= order:
        low, high, at_high = low / 2, low, at_low.line
        at_low = _seen(loop, waves, quarter, low)
    lower, upper = at_low.line, at_high
    was_below: bool | None = None
    for step in itertools.count(1):
        margin = _CLOSE * high
        if high - low <= 2 * margin:
            break
        middle = (low + high) / 2
        if step % 4 and lower * upper < 0:
            middle = min(max((low * upper - high * lower) / (upper - lower), low + margin), high - margin)
        seen = _seen(loop, waves, quarter, middle)
        below = seen.below < order
        again = below == was_below
        if below:
            low, lower, upper = middle, seen.line, upper / 2 if again else upper
        else:
            high, upper, lower = middle, seen.line, lower / 2 if again else lower
        was_below = below
    return (low + high) / 2


def modes_below(loop: LoopMasses, takeup_mass: float, frequency: ArrayLike) -> FloatArray:
    """How many natural frequencies of a belt loop are lower than a given one.

        speed imposed: N = floor(phi/pi)      torque imposed: N = floor(phi/pi) + (1 if K < 0 else 0) - 1

    Args:
        loop: the loop; its drum is clamped when the speed is imposed.
        takeup_mass: M, as in `natural_frequencies` [kg].
        frequency: w, above 0 [rad/s].

    Returns:
        N, without the rigid motion [1].

    **Range** as `natural_frequencies`.
    **Error** exact but within rounding of a natural frequency.
    **Source** module docstring.
    """
    waves, places = _waves(loop), np.asarray(frequency, float)
    counts = [_seen(loop, waves, takeup_mass / 4, w).below for w in places.ravel().tolist()]
    return np.array(counts, float).reshape(places.shape)


def _waves(loop: LoopMasses) -> _Waves:
    m1, m2 = math.sqrt(loop.carry_mass), math.sqrt(loop.return_mass)
    c1, c2 = math.sqrt(loop.carry_compliance), math.sqrt(loop.return_compliance)
    return _Waves(m1 * c1, m2 * c2, m1 / c1, m2 / c2)


class _Seen(NamedTuple):
    """How many frequencies are below w, and a line that is 0 at each of them and nowhere else."""

    below: int
    line: float


def _seen(loop: LoopMasses, waves: _Waves, quarter: float, w: float) -> _Seen:
    angle = _angle_at_drum(loop, waves, quarter, w)
    clamped = math.floor(angle / math.pi)
    if loop.imposed_speed:
        return _Seen(clamped, math.sin(angle))
    free = _with_free_drum(loop, waves, quarter, w)
    return _Seen(clamped + (free > 0 if clamped % 2 else free < 0) - 1, free)


def _angle_at_drum(loop: LoopMasses, waves: _Waves, quarter: float, w: float) -> float:
    """phi at the run-on, from 0 at a clamped and pi/2 at a free beginning."""
    begin = 0.0
    if not loop.fixed_length:
        begin = math.pi / 2 + math.atan(w * quarter / waves.back)
    angle = begin + w * waves.return_time
    turns = math.floor(angle / math.pi) * math.pi
    sine, cosine = math.sin(angle - turns), math.cos(angle - turns)
    end = math.atan2(waves.carry * sine, waves.back * cosine - w * loop.tail_mass * sine)
    return turns + end + w * waves.carry_time


def _with_free_drum(loop: LoopMasses, waves: _Waves, quarter: float, w: float) -> float:
    """The functions of the module docstring with the torque imposed."""
    t1, t2, z1, z2 = waves
    m, tail = loop.drive_mass * w, loop.tail_mass * w
    s1, c1, s2, c2 = math.sin(w * t1), math.cos(w * t1), math.sin(w * t2), math.cos(w * t2)
    cross = z1 * c1 * s2 + z2 * c2 * s1
    b = cross - tail * s1 * s2
    # 2 Z1 Z2 (c1 c2 - 1) - (Z1^2 + Z2^2) s1 s2, without its cancellation
    ring = -4 * z1 * z2 * math.sin(w * (t1 + t2) / 2) ** 2 - (z1 - z2) ** 2 * s1 * s2
    r = ring - tail * cross
    if loop.fixed_length:
        return r - m * b
    a = z2 * (z1 * c1 * c2 - z2 * s1 * s2 - tail * s1 * c2)
    g = -z1 * z2 * (z1 * s1 * c2 + z2 * c1 * s2 + tail * c1 * c2)
    return g - quarter * w * r - m * (a - quarter * w * b)


def natural_frequencies_of_lengths(
    loop: LoopMasses,
    back_masses: FloatArray,
    back_compliances: FloatArray,
    carry_masses: FloatArray,
    carry_compliances: FloatArray,
    takeup_mass: float,
    count: int,
) -> FloatArray:
    """The lowest natural circular frequencies of a belt loop whose strands have lengths of different mass.

        (u, S)' = [[c, s/(Z w)], [-Z w s, c]] (u, S)   over a length,   S' = S - m_t w^2 u   at the tail
        T the product of all:   T12 = 0,   T11 = 0,   T11 + T22 - 2 = m w^2 T12,   T21 = m w^2 T11

    in the sequence of the module docstring: fixed length and gravity with the speed imposed, then both with the torque
    imposed; a weight M adds -k w^2 T12 to T11 and -k w^2 (T11 + T22 - 2) to T21, k = M/4.

    Args:
        loop: point masses of the loop; its strands are not read.
        back_masses: of the lengths of the return strand from the drum on [kg].
        back_compliances: of the same [m/N].
        carry_masses: of the lengths of the carrying strand from the tail on [kg].
        carry_compliances: of the same [m/N].
        takeup_mass: M, as in `natural_frequencies` [kg].
        count: how many.

    Returns:
        w_1 <= w_2 <= ..., as `natural_frequencies` [rad/s].

    **Range** as `natural_frequencies`; mass and compliance uniform along each length.
    **Error** halving to 1e-12 of each frequency; rounding where two nearly coincide.
    **Source** transfer matrices of a bar; the count of `modes_below`, whose angle passes each jump of Z within its half
    turn.
    """
    columns = (back_masses, back_compliances), (carry_masses, carry_compliances)
    strands = [np.column_stack(strand) for strand in columns]
    whole = sum(float(np.sqrt(strand[:, 0] * strand[:, 1]).sum()) for strand in strands)
    return np.array([_halved(loop, strands, takeup_mass / 4, order, whole) for order in range(1, count + 1)])


_HALVED = 1e-12
"""Relative width at which a halved interval is a frequency [1]; a numerical choice. A smaller value halves longer."""


def _halved(loop: LoopMasses, strands: list[FloatArray], quarter: float, order: int, whole: float) -> float:
    low, high = 0.0, order * math.pi / whole
    while _below(loop, strands, quarter, high) < order:
        low, high = high, 2 * high
    while high - low > _HALVED * high:
        middle = (low + high) / 2
        low, high = (low, middle) if _below(loop, strands, quarter, middle) >= order else (middle, high)
    return (low + high) / 2


def _below(loop: LoopMasses, strands: list[FloatArray], quarter: float, w: float) -> int:
    """How many frequencies of a loop of lengths are below w."""
    impedance = math.sqrt(strands[0][0, 0] / strands[0][0, 1])
    angle = 0.0 if loop.fixed_length else math.pi / 2 + math.atan(w * quarter / impedance)
    matrix = np.eye(2)
    for number, strand in enumerate(strands):
        if number:
            angle = _past(angle, impedance, impedance, w * loop.tail_mass)
            matrix = np.array([[1.0, 0.0], [-loop.tail_mass * w**2, 1.0]]) @ matrix
        for mass, compliance in strand.tolist():
            own, phase = math.sqrt(mass / compliance), w * math.sqrt(mass * compliance)
            angle = _past(angle, impedance, own, 0.0) + phase
            impedance, s, c = own, math.sin(phase), math.cos(phase)
            matrix = np.array([[c, s / (own * w)], [-own * w * s, c]]) @ matrix
    clamped = math.floor(angle / math.pi)
    if loop.imposed_speed:
        return clamped
    (t11, t12), (t21, t22) = matrix.tolist()
    ring = t11 + t22 - 2
    held = t12 if loop.fixed_length else t11 - quarter * w**2 * t12
    pulled = ring if loop.fixed_length else t21 - quarter * w**2 * ring
    free = pulled - loop.drive_mass * w**2 * held
    return clamped + (free > 0 if clamped % 2 else free < 0) - 1


def _past(angle: float, before: float, after: float, mass: float) -> float:
    """The angle behind a jump of impedance or a point mass m, of which m w is given."""
    turns = math.floor(angle / math.pi) * math.pi
    sine, cosine = math.sin(angle - turns), math.cos(angle - turns)
    return turns + math.atan2(after * sine, before * cosine - mass * sine)


def modal_damping(
    natural_frequency: ArrayLike, retardation_time: float, resistance_rate: float, line_mass: float
) -> FloatArray:
    """Damping ratio of a mode of the belt.

        zeta = eta w/2 + k/(2 rho w)

    Args:
        natural_frequency: w, of `natural_frequencies` [rad/s].
        retardation_time: eta, Kelvin-Voigt: S = EA (u_s + eta u_st); 0.01 to 0.05 s is usual [s].
        resistance_rate: k, resistance per speed and length [N*s/m^2].
        line_mass: rho, moving mass per length [kg/m].

    Returns:
        zeta [1].

    **Range** the same eta and k/rho on both strands; drums and take-up without damping of their own, light against
    the belt in what k does.
    **Error** exact for a loop without point masses, where both kinds of damping leave the modes alone; else the
    part of k holds for the share of the kinetic energy that is in the belt.
    **Source** derived: proportional damping, each mode by itself.
    """
    w = np.asarray(natural_frequency, float)
    return np.asarray(retardation_time * w / 2 + resistance_rate / line_mass / w / 2)
