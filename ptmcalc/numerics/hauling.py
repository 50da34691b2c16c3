"""A load hauled up on a rope that a drum takes in: radius piecewise linear in the drum's angle, rope ever shorter.

The drum turns at a steady speed and takes in the strained rope at V = omega R. With the unstrained free length s, the
strain beyond the static one e, and the load on a tackle,

    s' = -V/(1 + e_0),   (s e')' + 2 z (kappa s)^(1/2) e' + kappa e = V',   kappa = K s/M,  k = (kappa/s)^(1/2)

K the stiffness at the hook, so kappa does not change; z the damping ratio. On a stretch where R is linear V' is a
constant and e_p = V'/kappa a solution, however the length changes. Around it, with theta = int k dt,
S = (kappa s)^(1/2) and e = e_p + S^(-1/2) Y (Liouville, Green),

    Y_tt + 2 z Y_t + (1 + r) Y = 0,   r = g^2 + V'/(4 kappa) + 2 z g,   g = V/(4 s k)     (derivatives by theta)

r is of the order of the share of its length that the rope loses in a period, squared. Without it a stretch is a turn
and a decay in closed form; e and e_theta go on through its ends. What r can change is bounded: for r = 0 the norm
(Y^2 + Y_t^2)^(1/2) never grows, so an error grows by no more than int |r| dtheta times the norm of Y itself.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.collocation import gauss

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

_ORDER = 12
_NEWTON = 6
_KEPT = 0.9
"""Part of its length that a stretch leaves of the rope at least: the quadrature is exact to 1e-11 from 0.25, and the
bound of what is neglected, by the largest drift of a stretch, is at most 1.2 times its integral."""
_MOST_TURNS = 1e6
_LEAST_LEFT = 1e-12
"""Part of the free rope that is left at least: below it rounding of the lengths hides where a stretch ends."""
_MOST_MISSED = 30.0
"""Growth of an error over all stretches, as an exponent, above which an error bar has no meaning: e^30 = 1e13."""


@dataclass(frozen=True, slots=True)
class Map:
    """Radius of the rope's centre over the angle of the drum: straight between its corners.

    Args:
        angles: of the corners, rising from 0, shape (n + 1,) [rad].
        radii: there, shape (n + 1,) [m].
    """

    angles: FloatArray
    radii: FloatArray


@dataclass(frozen=True, slots=True)
class Rope:
    """The rope and what hangs on it.

    Args:
        length: s, unstrained, free at the start [m].
        rate: kappa, stiffness at the hook times free length over mass [m/s^2].
        static_strain: e_0 [1].
        damping_ratio: z, below 1 [1].
    """

    length: float
    rate: float
    static_strain: float
    damping_ratio: float


@dataclass(frozen=True, slots=True)
class Extreme:
    """Dynamic strain where the force is an extreme, its time, and the most by which it may be wrong."""

    value: float
    time: float
    error: float


@dataclass(frozen=True, slots=True)
class Hauled:
    """The motion: times, lengths, speeds and phases of the corners, and per stretch e_p, lambda and the amplitude C of
    Y = Re(C exp(lambda theta)); `error` is the bound of the norm of Y's error at the end of each stretch."""

    rope: Rope
    times: FloatArray
    lengths: FloatArray
    speeds: FloatArray
    phases: FloatArray
    offsets: FloatArray
    amplitudes: ComplexArray
    error: FloatArray

    def at(self, time: ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Dynamic strain, and dynamic force over stiffness E A, which damping makes another.

        Args:
            time: from 0 to the last corner, any shape [s].

        Returns:
            e and e + 2 z e_theta [1].
        """
        t = np.asarray(time, float)
        j = np.clip(np.searchsorted(self.times, t, "right") - 1, 0, len(self.offsets) - 1)
        since = t - self.times[j]
        s, v = self._rope_at(j, since)
        return self._value(j, self._phase(j, since), s, v)

    def bar(self, time: ArrayLike) -> FloatArray:
        """The most by which the force over E A may be wrong at given times."""
        j = np.searchsorted(self.times, np.asarray(time, float), "right") - 1
        return self._bar(np.clip(j, 0, len(self.offsets) - 1))

    def rope_length(self, time: ArrayLike) -> FloatArray:
        """Unstrained free length s at given times [m]."""
        t = np.asarray(time, float)
        j = np.clip(np.searchsorted(self.times, t, "right") - 1, 0, len(self.offsets) - 1)
        return self._rope_at(j, t - self.times[j])[0]

    def extremes(self) -> tuple[Extreme, Extreme]:
        """Largest and smallest dynamic force over E A.

        Within a stretch the crests are half a turn apart and their envelope S^(-1/2) exp(-z theta) is convex in its
        logarithm, so the first two and the last two crests and the corners are all there is to look at.

        **Error** the bound of the module, for a crest and for its place.
        **Source** derived.
        """
        turn = math.sqrt(1 - self.rope.damping_ratio**2)
        decay = complex(-self.rope.damping_ratio, turn)
        count = len(self.offsets)
        length = np.diff(self.phases)
        g = self._drift(self.lengths[:-1], self.speeds[:-1])
        crest = self.amplitudes * (1 + 2 * self.rope.damping_ratio * (g + decay)) * (decay + g)
        first = np.mod(math.pi / 2 - np.angle(crest), math.pi) / turn
        last = first + math.pi / turn * np.floor((length - first) * turn / math.pi)
        j = np.tile(np.arange(count), 4)
        theta = np.concatenate([first, first + math.pi / turn, last - math.pi / turn, last])
        inside = (theta > 0) & (theta < length[j])
        j, theta = j[inside], theta[inside]
        since = theta / self._k(j, np.zeros(len(j)))
        for _ in range(_NEWTON):
            since = since - (self._phase(j, since) - theta) / self._k(j, since)
        times = np.concatenate([self.times, self.times[j] + since])
        values = self.at(times)[1]
        owner = np.concatenate([np.minimum(np.arange(count + 1), count - 1), j])
        bars = self._bar(owner)
        top, bottom = int(np.argmax(values)), int(np.argmin(values))
        # a lower crest with a wider bar may be the larger one
        over = float(np.max(values + bars)) - float(values[top])
        under = float(values[bottom]) - float(np.min(values - bars))
        return (
            Extreme(float(values[top]), float(times[top]), max(over, float(bars[top]))),
            Extreme(float(values[bottom]), float(times[bottom]), max(under, float(bars[bottom]))),
        )

    # --- parts --------------------------------------------------------------------------------------------------

    def _bar(self, j: NDArray[np.intp]) -> FloatArray:
        z = self.rope.damping_ratio
        shortest = self.lengths[np.minimum(j + 1, len(self.lengths) - 1)]
        of_force = math.sqrt(1 + 4 * z * z) * (1 + z)
        return np.asarray(self.error[j] * of_force / np.sqrt(np.sqrt(self.rope.rate * shortest)))

    def _rope_at(self, j: NDArray[np.intp], since: FloatArray) -> tuple[FloatArray, FloatArray]:
        step = np.diff(self.times)[j]
        growth = np.diff(self.speeds)[j] / step
        v = self.speeds[j] + growth * since
        s = self.lengths[j] - since * (self.speeds[j] + v) / 2 / (1 + self.rope.static_strain)
        return np.asarray(s), np.asarray(v)

    def _k(self, j: NDArray[np.intp], since: FloatArray) -> FloatArray:
        return np.sqrt(self.rope.rate / self._rope_at(j, since)[0])

    def _phase(self, j: NDArray[np.intp], since: FloatArray) -> FloatArray:
        """theta from the beginning of the stretch."""
        nodes, weights = gauss(_ORDER)
        total = np.zeros(np.shape(since))
        for node, weight in zip(nodes, weights, strict=True):
            total = total + weight * self._k(j, since * node)
        return np.asarray(since * total)

    def _drift(self, s: FloatArray, v: FloatArray) -> FloatArray:
        """g = V/(4 s k)."""
        return np.asarray(v / (1 + self.rope.static_strain) / (4 * np.sqrt(self.rope.rate * s)))

    def _value(
        self, j: NDArray[np.intp], theta: FloatArray, s: FloatArray, v: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        z = self.rope.damping_ratio
        decay = complex(-z, math.sqrt(1 - z * z))
        y = self.amplitudes[j] * np.exp(decay * theta) / np.sqrt(np.sqrt(self.rope.rate * s))
        e = self.offsets[j] + y.real
        rate = (decay * y).real + self._drift(s, v) * y.real
        return np.asarray(e), np.asarray(e + 2 * z * rate)


def _halved(radius: Map, which: NDArray[np.bool_]) -> Map:
    """The same map with a corner more in the middle of some of its pieces, over which the radius is linear."""
    middles = (radius.angles[1:] + radius.angles[:-1])[which] / 2
    angles = np.sort(np.concatenate([radius.angles, middles]))
    return replace(radius, angles=angles, radii=np.interp(angles, radius.angles, radius.radii))


def haul(radius: Map, drum_speed: float, rope: Rope) -> Hauled:
    """Motion of a load that rose steadily before the map begins.

    Args:
        radius: of the rope over the angle of the drum.
        drum_speed: omega, steady [rad/s].
        rope: and what hangs on it.

    Returns:
        the motion.

    **Range** linear in the dynamic strain, which shortens the rope no further; a rope without mass.
    **Error** reported, to first order in the dynamic strain. A stretch adds (|Y| + E)(exp(q) - 1) to the error E of Y
        with q = int |r| dtheta + theta d/(2 s): the dynamic strain neglected in s' changes s by d <= int |e| |s'| dt,
        k by k d/(2 s).
    **Source** module docstring.

    Raises:
        NumericsError: for a map that takes in more rope than there is, a rope that is shortened faster than the load
            swings, a million swings, damping from 1 on.
    """
    if rope.damping_ratio >= 1:
        raise NumericsError("NUM102", "a load damped so much does not swing")
    times = radius.angles / drum_speed
    speeds = drum_speed * radius.radii
    steps = np.diff(times)
    taken = steps * (speeds[:-1] + speeds[1:]) / 2 / (1 + rope.static_strain)
    lengths = rope.length - np.concatenate([[0.0], np.cumsum(taken)])
    if lengths[-1] <= _LEAST_LEFT * rope.length:
        raise NumericsError("NUM102", "the drum takes in more rope than is free")
    if (short := lengths[1:] < _KEPT * lengths[:-1]).any():
        return haul(_halved(radius, short), drum_speed, rope)
    offsets = np.diff(speeds) / steps / rope.rate
    blank = np.zeros(len(steps))
    hauled = Hauled(rope, times, lengths, speeds, np.zeros(len(times)), offsets, blank.astype(complex), blank)
    thetas = hauled._phase(np.arange(len(steps)), steps)
    phases = np.concatenate([[0.0], np.cumsum(thetas)])
    if phases[-1] > 2 * math.pi * _MOST_TURNS:
        raise NumericsError("NUM102", f"the load swings {phases[-1] / 2 / math.pi:.1e} times on its rope")
    amplitudes, error = _swung(hauled, thetas)
    return Hauled(rope, times, lengths, speeds, phases, offsets, amplitudes, error)


def _swung(still: Hauled, thetas: FloatArray) -> tuple[ComplexArray, FloatArray]:
    """Amplitude of every stretch, and the bound of its error."""
    z = still.rope.damping_ratio
    turn = math.sqrt(1 - z * z)
    decay = complex(-z, turn)
    size = np.sqrt(np.sqrt(still.rope.rate * still.lengths))
    drift = still._drift(still.lengths, still.speeds)
    missed = _missed(still, thetas)
    whole = np.exp(decay * thetas)
    amplitudes, error = np.empty(len(thetas), complex), np.empty(len(thetas))
    e, slope, wrong, slipped, grown = 0.0, 0.0, 0.0, 0.0, 0.0
    for j in range(len(thetas)):
        y = float(size[j]) * (e - float(still.offsets[j]))
        rate = float(size[j]) * slope - float(drift[j]) * y
        c = complex(y, -(rate + z * y) / turn)
        norm = math.hypot(y, rate)
        # by the dynamic strain the drum takes in another unstrained length, int |e| |s'| dt at most
        most = abs(float(still.offsets[j])) + (norm + wrong) / float(size[j + 1])
        slipped += most * float(still.lengths[j] - still.lengths[j + 1])
        shifted = slipped / float(still.lengths[j + 1]) / 2
        share = float(missed[j]) + shifted * float(thetas[j])
        grown += share
        if not grown < _MOST_MISSED:
            raise NumericsError("NUM102", "the drum changes the rope length faster than the load oscillates on it")
        wrong = wrong + (norm + wrong) * math.expm1(share)
        amplitudes[j], error[j] = c, wrong
        end = c * complex(whole[j])
        y, rate = end.real, (decay * end).real
        e = float(still.offsets[j]) + y / float(size[j + 1])
        slope = (rate + float(drift[j + 1]) * y) / float(size[j + 1])
    return amplitudes, error


def _missed(still: Hauled, thetas: FloatArray) -> FloatArray:
    """Bound of int |r| dtheta over every stretch."""
    fastest = np.maximum(still.speeds[:-1], still.speeds[1:])
    g = still._drift(still.lengths[1:], fastest)
    return np.asarray((g**2 + np.abs(still.offsets) / 4 + 2 * still.rope.damping_ratio * g) * thetas)


def largest_possible(radius: Map, drum_speed: float, rope: Rope) -> float:
    """Bound of the dynamic force over E A, whatever the phases in which the corners of the map find the swinging load.

        |C_j| <= |C_(j-1)| exp(-z theta) + S^(1/2) |e_p - e_p'| (1 + ((g + z)/(1 - z^2)^(1/2))^2)^(1/2)

    Args:
        radius: of the rope over the angle of the drum.
        drum_speed: omega, steady [rad/s].
        rope: and what hangs on it.

    Returns:
        the bound [1].

    **Range** as `haul`.
    **Error** a bound, what `haul` leaves out in it.
    **Source** triangle inequality in the solution of `haul`.

    Raises:
        NumericsError: as `haul`.
    """
    motion = haul(radius, drum_speed, rope)
    z = rope.damping_ratio
    turn = math.sqrt(1 - z * z)
    size = np.sqrt(np.sqrt(rope.rate * motion.lengths))
    drift = motion._drift(motion.lengths, motion.speeds)
    left = np.exp(-z * np.diff(motion.phases))
    steps = np.abs(np.diff(motion.offsets, prepend=0.0)) * size[:-1] * np.hypot(1, (drift[:-1] + z) / turn)
    bars = motion._bar(np.arange(len(motion.offsets)))
    amplitude, most = 0.0, 0.0
    for j in range(len(motion.offsets)):
        amplitude += float(steps[j])
        swing = amplitude / float(size[j + 1]) * math.hypot(1, 2 * z) * (1 + 2 * z * float(drift[j + 1]))
        most = max(most, abs(float(motion.offsets[j])) + swing + float(bars[j]))
        amplitude *= float(left[j])
    return most
