"""Strands with mass under periodic motion of their ends: forces harmonic by harmonic, peaks by roots, errors by bounds.

A chain of one or two uniform strands starts at the run-on of a sprocket and goes against the travel: working strand,
a joint that may have a mass (tail), return strand, far end. Displacements are positive in the direction of travel,
forces are tensions, both without their static part. A harmonic of frequency w is Im(A exp(i w t)).

Every strand passes (u, S) from its far to its near end by one matrix, scaled with X = exp(-i theta) so that nothing
overflows however much is damped:

    X [[cos, sin/z], [-z sin, cos]],   theta = w T/k,  z = w Z k,  k^2 = complex modulus/modulus

with T the travel time and Z the impedance of the undamped strand. The product P of all of them has the determinant
X^2 and gives every force without a difference of large numbers. The drive, a mass m at the rim that gives way to the
tensions, comes in as nu = 1/(m w^2):

    far end free, mass M     S_on = (N u + M w^2 X u_far)/(Q - nu N),   N = P21 - M w^2 P22,   Q = P11 - M w^2 P12
    far end held             S_on = (P22 u - X u_far)/(P12 - nu P22)
    far end on the sprocket  S_on = (P22 u - X u_far - nu P21 (u - u_far))/(P12 - nu (P11 + P22 - 2 X))

A denominator that vanishes within its rounding is a resonance without damping: the force is unbounded.

**What is left out.** The motion of a sprocket has |u_n| = c/(n^3 w_1^2) behind the last harmonic N, alternating. One
complex modulus for all strands means D(w) = k^2 D_0(w/k), D_0 without damping at a complex frequency: waves fade by
X between the ends and no end reflects more than it receives. So D = i z (1 - R)/(1 + R) with |R| <= q = |X_1|^2 and
|D| <= |z| (1 + q)/(1 - q); between the ends |D_12| <= 2 |z_1 z_2|^(1/2) |X_1 X_2|/(1 - max q), from the scattering
matrix of the joint between both delays. These bound the sum of the rest; and because i z u_n changes steadily from one
harmonic to the next, Abel's summation bounds it far better everywhere but next to the engagement: by
(1 + pi/2) |z u|_(N+1)/|sin(pi x)|, x the distance from it in pitches. At the engagement itself, where the force has a
corner and often its smallest value, all terms of i z u_n have one sign and their sum is an integral. Between samples
of the force its second derivative is bounded in the same two ways. The largest force is therefore known to lie
between two numbers.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ptmcalc.numerics.collocation import gauss

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

KELVIN_VOIGT, HYSTERETIC, ZENER = "kelvin_voigt", "hysteretic", "zener"
FREE, HELD, ON_SPROCKET = "free", "held", "on_sprocket"

_EPS = float(np.finfo(float).eps)
_RESONANT = 8.0
"""Multiple of the rounding of its arguments below which a denominator counts as 0."""
_PASSES = 1 - 16 * _EPS
"""Part of a wave from which on nothing of it is surely lost."""
_STEADY = 1 + np.pi / 2
"""Variation of i z u_n behind the last harmonic over its first value: it falls, and turns by less than 45 deg there
and, with Zener, back."""
_PER_HARMONIC, _LEAST_SAMPLES = 4, 1024
"""Samples of the force per harmonic, and at least."""
_AT_IT = 1e-12
"""A distance from the engagement at which only the absolute sums count any more."""
_BLOCK = 16
"""Speeds computed at a time: what they need stays in the cache."""
_NEWTON, _CORNER = 4, 32
"""Steps to a summit, nodes for the sum behind the last harmonic at an engagement."""


@dataclass(frozen=True, slots=True)
class Damping:
    """Internal damping by a complex modulus: Kelvin-Voigt 1 + i w t (`time` t, the retardation time), hysteretic
    1 + i g (`share` g, the loss factor), Zener 1 + g i w t/(1 + i w t) (`share` g, the second spring over the first,
    `time` t, its relaxation time)."""

    law: str
    time: float = 0.0
    share: float = 0.0

    def __post_init__(self) -> None:
        if self.law not in (KELVIN_VOIGT, HYSTERETIC, ZENER):
            raise ValueError(f"no damping is called `{self.law}`")
        if self.time < 0 or self.share < 0:
            raise ValueError("damping takes energy out: neither its time nor its share is negative")

    def modulus(self, w: FloatArray) -> ComplexArray:
        """Complex modulus over the static one."""
        if self.law == KELVIN_VOIGT:
            return np.asarray(1 + 1j * (w * self.time))
        if self.law == HYSTERETIC:
            return np.full(np.shape(w), 1 + 1j * self.share)
        x = 1j * (w * self.time)
        return np.asarray(1 + self.share * x / (1 + x))


@dataclass(frozen=True, slots=True)
class Line:
    """A uniform strand: length [m], mass per length [kg/m], tensile stiffness [N]."""

    length: float
    line_mass: float
    stiffness: float

    @property
    def transit(self) -> float:
        """Travel time of a wave [s]."""
        return self.length * float(np.sqrt(self.line_mass / self.stiffness))

    @property
    def impedance(self) -> float:
        """Force of a wave over its particle speed [N*s/m]."""
        return float(np.sqrt(self.line_mass * self.stiffness))


@dataclass(frozen=True, slots=True)
class Chain:
    """One or two strands from the run-on of a sprocket against the travel, and how they end.

    `far` is `free` (constant tension, with a `far_mass` that moves with it: a take-up, or a tail sprocket with what it
    drives, whose own polygon moves the end against it), `held` (an end that is fixed or moved by something else) or
    `on_sprocket` (the run-off of the same sprocket: screw take-up). `drive_mass` is the drive at the rim, infinite for
    a sprocket whose speed nothing changes.
    """

    lines: tuple[Line, ...]
    damping: Damping
    far: str = FREE
    joint_mass: float = 0.0
    far_mass: float = 0.0
    drive_mass: float = np.inf

    def __post_init__(self) -> None:
        if len(self.lines) not in (1, 2):
            raise ValueError("a chain has one or two strands")
        if self.far not in (FREE, HELD, ON_SPROCKET):
            raise ValueError(f"no end is called `{self.far}`")


@dataclass(frozen=True, slots=True)
class Excitation:
    """Periodic acceleration of an end, sum b_n sin(2 pi n (x - place)), x in pitches.

    `harmonics` are the b_n from n = 1 on, shape (N,) or (speeds, N) [m/s^2]. Behind the last one they must go on
    alternating with n |b_n| falling to its limit like 1/n^2 at least, as those of an acceleration that jumps once per
    pitch at place + 1/2 do. A last one of 0 says that there are no more.
    """

    harmonics: FloatArray
    place: float = 0.0


@dataclass(frozen=True, slots=True)
class Peaks:
    """Largest and smallest dynamic force per speed, where in the pitch, and between which numbers they truly lie.

    Unbounded forces are infinite, with infinite ends. `bound` is the sum of the absolute terms, the tail included: no
    force is larger, whatever the phases [N].
    """

    largest: FloatArray
    largest_place: FloatArray
    largest_low: FloatArray
    largest_high: FloatArray
    smallest: FloatArray
    smallest_place: FloatArray
    smallest_low: FloatArray
    smallest_high: FloatArray
    bound: FloatArray


@dataclass(frozen=True, slots=True)
class _Ratios:
    """Forces of the run-on (and run-off) per unit displacement of near and far end: numerators over one denominator;
    `sound` is the denominator over what its parts add up to, in units of their rounding."""

    near: tuple[ComplexArray, ComplexArray]
    far: tuple[ComplexArray, ComplexArray]
    below: ComplexArray
    sound: FloatArray


@dataclass(frozen=True, slots=True)
class _Rest:
    """What lies behind the last harmonic of one excitation: bounds of the sum of all terms, of its steady part's
    variation and of the sum without that part; the steady part at the engagement, and how far it may be wrong."""

    whole: FloatArray
    variation: FloatArray
    echoes: FloatArray
    corner: FloatArray
    unsure: FloatArray


class _Waves:
    """The matrix P of a chain at frequencies, the sizes its entries are made of, and P11 - X and P22 - X, which are
    small where the motion is slow."""

    def __init__(self, chain: Chain, w: FloatArray) -> None:
        root = np.sqrt(chain.damping.modulus(w))
        whole = np.zeros(w.shape, complex)
        matrices, sizes = [], []
        for line in chain.lines:
            theta, z = w * line.transit / root, w * line.impedance * root
            twice = np.expm1(-2j * theta)
            cosine, sine = 1 + twice / 2, twice * 0.5j
            near, stiff = np.minimum(np.abs(theta), 1.0), np.abs(z)
            matrices.append([cosine, sine / z, -z * sine, cosine])
            sizes.append([np.ones(w.shape), near / stiff, near * stiff, np.ones(w.shape)])
            whole = whole + theta
        half = np.expm1(-1j * whole) ** 2 / 2  # X (cos - 1) of both angles
        self.scale, self.angle = np.exp(-1j * whole), np.abs(whole)
        self.matrix, self.sizes, self.less = matrices[0], sizes[0], (half, half)
        if len(matrices) == 2:
            (c1, s1, _, _), (c2, s2, r2, _) = matrices
            load, z1, z2 = chain.joint_mass * w**2, chain.lines[0].impedance, chain.lines[1].impedance
            both = s1 * r2  # -sin sin z2/z1
            self.less = (
                half + both * (1 - z1 / z2) - load * s1 * c2,
                half - both * (z1 / z2) * (1 - z1 / z2) - load * c1 * s2,
            )
            for entries in (matrices[1], sizes[1]):
                sign = 1.0 if entries is sizes[1] else -1.0
                entries[2] = entries[2] + sign * load * entries[0]
                entries[3] = entries[3] + sign * load * entries[1]
            self.matrix, self.sizes = _product(*matrices), _product(*sizes)


def _product(a: list[Any], b: list[Any]) -> list[Any]:
    """Of two matrices of arrays, row by row."""
    return [
        a[0] * b[0] + a[1] * b[2],
        a[0] * b[1] + a[1] * b[3],
        a[2] * b[0] + a[3] * b[2],
        a[2] * b[1] + a[3] * b[3],
    ]


def _ratios(chain: Chain, waves: _Waves, w: FloatArray) -> _Ratios:
    p11, p12, p21, p22 = waves.matrix
    s11, s12, s21, s22 = waves.sizes
    nu = 1 / (chain.drive_mass * w**2)
    if chain.far == FREE:
        load = chain.far_mass * w**2
        above = p21 - load * p22
        below = p11 - load * p12 - nu * above
        size = s11 + load * s12 + nu * (s21 + load * s22)
        through: ComplexArray = np.asarray(load * waves.scale)
        near, far = (above, through), (-through, load * (p11 - nu * p21))
    elif chain.far == HELD:
        below, size = p12 - nu * p22, s12 + nu * s22
        near, far = (p22, -waves.scale), (waves.scale, nu * p21 - p11)
    else:
        ring = waves.less[0] + waves.less[1]
        below, size = p12 - nu * ring, s12 + nu * np.minimum(s11 + s22 + 2, s12 * s21)
        slip = nu * p21
        near, far = (p22 - slip, slip - waves.scale), (waves.scale - slip, slip - p11)
    sound = np.abs(below) / (size * (1 + waves.angle))
    return _Ratios(near, far, below, np.asarray(sound / _EPS))


def dynamic_stiffness(chain: Chain, frequency: ArrayLike) -> ComplexArray:
    """Force at the run-on over a harmonic displacement of the sprocket, with a held far end at rest.

        S = D u

    Args:
        chain: the strands and their ends.
        frequency: w, above 0 [rad/s].

    Returns:
        D [N/m]; infinite at a resonance without damping.

    **Error** rounding, larger near a resonance by its amplification.
    **Source** module docstring.
    """
    w = np.atleast_1d(np.asarray(frequency, float))
    waves = _Waves(chain, w)
    found = _ratios(chain, waves, w)
    above = waves.less[1] if chain.far == ON_SPROCKET else found.near[0]
    result = np.full(w.shape, complex(np.inf, 0.0))
    np.divide(above, found.below, out=result, where=found.sound > _RESONANT)
    return np.asarray(result.reshape(np.shape(frequency)))


def polygon_response(
    chain: Chain,
    frequency: ArrayLike,
    near: Excitation,
    far: Excitation | None = None,
    at_far_end: bool = False,
) -> Peaks:
    """Peaks of the force of a chain whose ends move periodically, speed by speed.

        S(x) = sum_n Im((D_1 u_n + D_2 u_n,far) exp(2 pi i n x)),   u_n = -b_n/(n w)^2

    Args:
        chain: the strands and their ends.
        frequency: w, of the teeth, above 0, shape () or (speeds,) [rad/s].
        near: acceleration of the run-on.
        far: acceleration of the far end, against its mass where it is free; none where not given.
        at_far_end: the force at the far end instead of the run-on.

    Returns:
        the peaks, arrays of the shape of the frequency.

    **Range** linear, the strands stay taut.
    **Error** told with every peak; infinite where damping is too light to bound what lies behind the last harmonic.
    With 1024 harmonics and 0.5 to 5 % of damping it is below 0.6 % of the largest force from a fiftieth of the first
    natural frequency upwards.
    **Source** module docstring.
    """
    speeds = np.atleast_1d(np.asarray(frequency, float))
    parts = [near] if far is None else [near, far]
    if chain.far == FREE and chain.far_mass == 0 and (far is not None or at_far_end):
        raise ValueError("a free end without mass is not moved by anything and has no force")
    if far is not None and far.harmonics.shape[-1] != near.harmonics.shape[-1]:
        raise ValueError("both ends need the same number of harmonics")
    found: list[list[FloatArray]] = []
    for first in range(0, len(speeds), _BLOCK):
        rows = slice(first, first + _BLOCK)
        own = [Excitation(np.broadcast_to(p.harmonics, (len(speeds), p.harmonics.shape[-1]))[rows], p.place)
               for p in parts]  # fmt: skip
        found.append(_block(chain, speeds[rows], own, at_far_end))
    return Peaks(*(np.concatenate(column).reshape(np.shape(frequency)) for column in zip(*found, strict=True)))


def _block(chain: Chain, speeds: FloatArray, parts: list[Excitation], at_far_end: bool) -> list[FloatArray]:
    count = parts[0].harmonics.shape[-1]
    orders = np.arange(1, count + 1)
    w = speeds[:, None] * orders
    ratios = _ratios(chain, _Waves(chain, w), w)
    resonant = ratios.sound <= _RESONANT
    forces, rests = [], []
    apart = chain.far != FREE or len(parts) == 2 or at_far_end
    for k, part in enumerate(parts):
        above = (ratios.far if at_far_end else ratios.near)[k]
        moved = -part.harmonics / w**2 * np.exp(-2j * np.pi * orders * part.place)
        force = np.divide(above * moved, ratios.below, out=np.zeros_like(above), where=~resonant)
        forces.append(force)
        crossed = (k == 1) != at_far_end
        rests.append(_rest(chain, speeds, part, crossed=crossed, at_far_end=at_far_end, apart=apart))
    driven = np.sum([np.abs(part.harmonics) for part in parts], axis=0) > 0
    unbounded = np.any(resonant & driven, axis=-1)
    sizes: FloatArray = np.sum(np.abs(forces), axis=0)
    rounding = np.sum(sizes * (4 * _EPS + 4 / np.maximum(ratios.sound, _RESONANT)), axis=-1)
    bound = sizes.sum(axis=-1) + np.sum([rest.whole for rest in rests], axis=0)
    search = _Search(forces, [part.place for part in parts], rests, rounding)
    largest = search.largest(1.0)
    smallest = search.largest(-1.0)
    columns = [*largest, -smallest[0], smallest[1], -smallest[3], -smallest[2], bound]
    limits = [np.inf, 0.0, np.inf, np.inf, -np.inf, 0.0, -np.inf, -np.inf, np.inf]
    return [np.where(unbounded, limit, column) for column, limit in zip(columns, limits, strict=True)]


def _rest(chain: Chain, speeds: FloatArray, part: Excitation, *, crossed: bool, at_far_end: bool, apart: bool) -> _Rest:
    """Bounds behind the last harmonic; `crossed` for the force at the end that is not moved, `apart` where a mass at
    the far end counts as something that gives way and not as a part of the strands."""
    count = part.harmonics.shape[-1]
    w = speeds * (count + 1)
    lines, damping = chain.lines, chain.damping
    root = np.sqrt(damping.modulus(w))
    # |k| rises behind: at most with the root of the frequency with Kelvin-Voigt, to a limit with Zener
    size, growth = np.abs(root), 1.0
    if damping.law == KELVIN_VOIGT:
        growth = 2.0
    elif damping.law == ZENER:
        size = np.full_like(size, np.sqrt(1 + damping.share))
    fades = [np.exp(2 * np.imag(w * line.transit / root)) for line in lines]

    def echoes(fade: FloatArray) -> FloatArray:
        """|D/(i z) - 1| at most."""
        return np.where(fade < _PASSES, 2 * fade / np.maximum(1 - fade, _EPS), np.inf)

    # over the frequency: |z| and bounds of |D - i z| at the end of the force, and of |D| at both ends and between them
    stiff = [line.impedance * size for line in (lines[0], lines[-1])]
    strays = [stiff[0] * echoes(fades[0]), stiff[1] * echoes(fades[-1])]
    through = _through(lines, fades) * size if apart else np.zeros_like(size)
    force, motion = int(at_far_end), int(at_far_end != crossed)
    own = [one + stray for one, stray in zip(stiff, strays, strict=True)]
    # masses that give way feed back at most |D nu| (1 + |D nu| + ...) |D|
    drive, tail = 1 / (chain.drive_mass * w), np.zeros_like(w)
    if chain.far == ON_SPROCKET:
        felt, give = _scaled(drive, own[force] + through), _scaled(drive, own[0] + own[1] + 2 * through)
    else:
        if chain.far == FREE and apart:
            tail = 1 / (chain.far_mass * w)
        ends = [own[end] if end == force else through for end in (0, 1)]
        felt = np.maximum(_scaled(drive, ends[0]), _scaled(tail, ends[1]))
        give = np.maximum(_scaled(drive, own[0] + through), _scaled(tail, own[1] + through))
    back = np.where(give < _PASSES, felt / np.maximum(1 - give, _EPS), np.inf)
    fed_back = _scaled(back, own[motion] + through)
    level = np.abs(part.harmonics[:, -1]) * count / speeds  # c/w_1
    rest = through + fed_back if crossed else strays[force] + fed_back
    steady = np.zeros_like(level) if crossed else level * stiff[force]
    beside = _scaled(growth * level / count, rest)
    whole, variation = growth * steady / count + beside, _STEADY * steady / (count + 1) ** 2
    if crossed:
        return _Rest(whole, variation, beside, np.zeros_like(level), beside)
    line, side = (lines[-1], 1.0) if at_far_end else (lines[0], -1.0)
    sign = side * np.sign(part.harmonics[:, -1]) * (-1.0) ** count
    corner = sign * level * line.impedance * _reach(damping, speeds, count)
    before = np.abs(part.harmonics[:, max(count - 2, 0)]) * max(count - 1, 1) / speeds
    settled = np.abs(before - level) * count + level / count**2  # n |b_n| less its limit, and sum less integral
    return _Rest(whole, variation, beside, corner, beside + _scaled(settled, growth * stiff[force] / count))


def _reach(damping: Damping, speeds: FloatArray, count: int) -> FloatArray:
    """Sum of Re(k_n)/n^2 behind the last harmonic, by the integral with s = t^2/(N + 1/2) for 1/n."""
    t, weights = gauss(_CORNER)
    n = (count + 0.5) / t**2
    root = np.sqrt(damping.modulus(speeds[:, None] * n))
    return np.asarray((root.real * t) @ weights * 2 / (count + 0.5))


def _scaled(factor: FloatArray, bound: FloatArray) -> FloatArray:
    """Their product; 0 where the factor is, however large the bound."""
    return np.multiply(factor, bound, out=np.zeros_like(bound), where=factor > 0)


def _through(lines: tuple[Line, ...], fades: list[FloatArray]) -> FloatArray:
    """Bound of the force at one end per motion of the other, over w |k|."""
    both = 2 * np.sqrt(lines[0].impedance * lines[-1].impedance * np.prod(fades, axis=0))
    most = np.maximum(fades[0], fades[-1])
    return np.where(most < _PASSES, both / np.maximum(1 - most, _EPS), np.inf)


class _Search:
    """The largest value of S(x) = sum_n Im(c_n exp(2 pi i n x)) and the numbers it lies between."""

    def __init__(
        self, forces: list[ComplexArray], places: list[float], rests: list[_Rest], rounding: FloatArray
    ) -> None:
        self._terms: ComplexArray = np.asarray(sum(forces))
        self._rests, self._places, self._rounding = rests, places, rounding
        speeds, count = self._terms.shape
        self._orders = np.arange(1, count + 1)
        self._samples = max(2 ** int(np.ceil(np.log2(_PER_HARMONIC * count))), _LEAST_SAMPLES)
        spectrum = np.zeros((speeds, self._samples // 2 + 1), complex)
        spectrum[:, 1 : count + 1] = self._terms * (-1j * (self._samples / 2))
        self._values = np.fft.irfft(spectrum, self._samples, axis=-1)
        self._stray = self._strays(forces)

    def _away(self, place: float, x: FloatArray, reach: float) -> FloatArray:
        """|sin(pi d)| at the distance d of places from the engagement of an excitation, less a reach."""
        gap = x - place - 0.5
        distance = np.abs(gap - np.round(gap))
        return np.asarray(np.maximum(np.sin(np.pi * np.maximum(distance - reach, 0.0)), _AT_IT))

    def _strays(self, forces: list[ComplexArray]) -> FloatArray:
        """Most by which S exceeds the next sample: its curvature between them, and what was left out."""
        half = 0.5 / self._samples
        x = np.arange(self._samples) / self._samples
        step = (2 * np.pi * half) ** 2 / 2
        total = self._rounding[:, None] + np.zeros(self._samples)
        for force, place, rest in zip(forces, self._places, self._rests, strict=True):
            bent = force * np.exp(2j * np.pi * self._orders * (place + 0.5)) * self._orders**2
            change = np.abs(np.diff(bent, axis=-1)).sum(axis=-1) + np.abs(bent[:, -1])
            sine = self._away(place, x, half)
            total += step * np.minimum(change[:, None] / sine, np.abs(bent).sum(axis=-1)[:, None])
            total += np.minimum(rest.variation[:, None] / sine + rest.echoes[:, None], rest.whole[:, None])
        return total

    def largest(self, sign: float) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """(value, place, low, high) of the largest of sign S, shape (speeds,) each."""
        values = sign * self._values
        rows = np.arange(len(values))
        top = np.argmax(values, axis=-1)
        start = top / self._samples
        x = start.copy()
        reach = 1 / self._samples
        for _ in range(_NEWTON):
            phase = self._terms * np.exp(2j * np.pi * x[:, None] * self._orders)
            slope = sign * np.sum(phase.real * self._orders, axis=-1)
            bend = -sign * np.sum(phase.imag * self._orders**2, axis=-1)
            step = np.where(bend < 0, -slope / np.where(bend < 0, bend, -1.0), np.sign(slope))
            x = np.clip(x + np.clip(step / (2 * np.pi), -reach, reach), start - reach, start + reach)
        best = sign * self._sum(x)
        sampled = values[rows, top]
        x, best = np.where(best >= sampled, x, start), np.maximum(best, sampled)
        low = best - self._left_out(x)
        for k, (place, rest) in enumerate(zip(self._places, self._rests, strict=True)):
            corner = np.full_like(x, place + 0.5)
            value = sign * (self._sum(corner) + rest.corner)
            surely = value - rest.unsure - self._left_out(corner, without=k)
            better = surely > low
            best, x, low = (np.where(better, a, b) for a, b in ((value, best), (corner, x), (surely, low)))
        high = np.maximum(np.max(values + self._stray, axis=-1), best)
        return best, np.asarray(x - np.floor(x)), low, high

    def _sum(self, x: FloatArray) -> FloatArray:
        return np.asarray(np.sum((self._terms * np.exp(2j * np.pi * x[:, None] * self._orders)).imag, axis=-1))

    def _left_out(self, x: FloatArray, without: int | None = None) -> FloatArray:
        """Bound of what the sum at places leaves out, without that of one excitation."""
        total = self._rounding
        for k, (place, rest) in enumerate(zip(self._places, self._rests, strict=True)):
            if k != without:
                total = total + np.minimum(rest.variation / self._away(place, x, 0.0) + rest.echoes, rest.whole)
        return total
