"""What lies behind the last harmonic: bounds of its sum, and its value at an engagement.

The motion of a sprocket has |u_n| = c/(n^3 w_1^2) behind the last harmonic N, alternating. One complex modulus for all
strands means D(w) = k^2 D_0(w/k), D_0 without damping at a complex frequency: waves fade by X between the ends and no
end reflects more than it receives. So D = i z (1 - R)/(1 + R) with |R| <= q = |X_1|^2 and |D| <= |z| (1 + q)/(1 - q);
between the ends |D_12| <= 2 |z_1 z_2|^(1/2) |X_1 X_2|/(1 - max q), from the scattering matrix of the joint between both
delays. These bound the sum of the rest. Because i z u_n changes steadily from one harmonic to the next, Abel's
summation bounds it far better everywhere but next to the engagement: by (1 + pi/2) |z u|_(N+1)/|sin(pi x)|, x the
distance from it in pitches. At the engagement itself, where the force has a corner and often its smallest value, all
terms of i z u_n have one sign and their sum is an integral.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptmcalc.numerics.collocation import gauss
from ptmcalc.numerics.harmonic.parts import FREE, KELVIN_VOIGT, ON_SPROCKET, ZENER, Chain, Damping, Excitation, Line
from ptmcalc.numerics.harmonic.waves import EPS

FloatArray = NDArray[np.float64]

_PASSES = 1 - 16 * EPS
"""Part of a wave from which on nothing of it is surely lost."""
_STEADY = 1 + np.pi / 2
"""Variation of i z u_n behind the last harmonic over its first value: it falls, and turns by less than 45 deg there
and, with Zener, back."""
_CORNER = 32
"""Nodes for the sum behind the last harmonic at an engagement."""


@dataclass(frozen=True, slots=True)
class Rest:
    """What lies behind the last harmonic of one excitation: bounds of the sum of all terms, of its steady part's
    variation and of the sum without that part; the steady part at the engagement, and how far it may be wrong."""

    whole: FloatArray
    variation: FloatArray
    echoes: FloatArray
    corner: FloatArray
    unsure: FloatArray


def rest_of(
    chain: Chain, speeds: FloatArray, part: Excitation, *, crossed: bool, at_far_end: bool, apart: bool
) -> Rest:
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
        return np.where(fade < _PASSES, 2 * fade / np.maximum(1 - fade, EPS), np.inf)

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
    back = np.where(give < _PASSES, felt / np.maximum(1 - give, EPS), np.inf)
    fed_back = _scaled(back, own[motion] + through)
    level = np.abs(part.harmonics[:, -1]) * count / speeds  # c/w_1
    rest = through + fed_back if crossed else strays[force] + fed_back
    steady = np.zeros_like(level) if crossed else level * stiff[force]
    beside = _scaled(growth * level / count, rest)
    whole, variation = growth * steady / count + beside, _STEADY * steady / (count + 1) ** 2
    if crossed:
        return Rest(whole, variation, beside, np.zeros_like(level), beside)
    line, side = (lines[-1], 1.0) if at_far_end else (lines[0], -1.0)
    sign = side * np.sign(part.harmonics[:, -1]) * (-1.0) ** count
    corner = sign * level * line.impedance * _reach(damping, speeds, count)
    before = np.abs(part.harmonics[:, max(count - 2, 0)]) * max(count - 1, 1) / speeds
    settled = np.abs(before - level) * count + level / count**2  # n |b_n| less its limit, and sum less integral
    return Rest(whole, variation, beside, corner, beside + _scaled(settled, growth * stiff[force] / count))


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
    return np.where(most < _PASSES, both / np.maximum(1 - most, EPS), np.inf)
