"""The force of a chain of two strands where they meet, on either side of what stands there.

With C = X cos(theta) and S = X sin(theta) of a strand, scaled as in `waves`, and u_j the displacement of the joint:

    working strand at the joint   F_1 = z_1 (X_1 u_on - C_1 u_j)/S_1
    return strand at the joint    F_2 = F_1 + m w^2 u_j
    its far end free, mass M      F_2 = z_2 (X_2 M w^2 u_far - (z_2 S_2 + M w^2 C_2) u_j)/(z_2 C_2 - M w^2 S_2)
    its far end held, or on the sprocket   F_2 = z_2 (C_2 u_j - X_2 u_far)/S_2

Behind the last harmonic no wave in the strands has a larger force than z (2/(1 - q))^2 X_1 |u|, q the most that comes
back of a wave from the other end of a strand.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ptmcalc.numerics.harmonic.parts import FREE, ON_SPROCKET, Chain, Excitation
from ptmcalc.numerics.harmonic.waves import EPS, RESONANT, Waves, ratios_of

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

_PER_HARMONIC, _LEAST_SAMPLES = 8, 1024


@dataclass(frozen=True, slots=True)
class Extremes:
    """Largest and smallest force over a pitch, by how much either may be wrong, and the sum of the absolute terms, the
    tail included: no force is larger, whatever the phases; shape (speeds,) each [N]."""

    largest: FloatArray
    smallest: FloatArray
    error: FloatArray
    bound: FloatArray


def joint_response(
    chain: Chain, frequency: ArrayLike, near: Excitation, far: Excitation | None = None
) -> tuple[Extremes, Extremes]:
    """Forces of the working and of the return strand where they meet.

        F(x) = sum_n Im(F_n exp(2 pi i n x))

    Args:
        chain: two strands.
        frequency: w, of the teeth, shape (speeds,) [rad/s].
        near: acceleration of the run-on.
        far: acceleration of the far end; none where not given.

    Returns:
        (of the working strand, of the return strand).

    **Range** linear, the strands stay taut.
    **Error** told: what lies behind the last harmonic and between samples; infinite at a resonance without damping.
    **Source** module docstring.
    """
    first, second, rest = joint_forces(chain, frequency, near, far)
    return _extremes(first, rest), _extremes(second, rest)


def joint_forces(
    chain: Chain, frequency: ArrayLike, near: Excitation, far: Excitation | None = None
) -> tuple[ComplexArray, ComplexArray, FloatArray]:
    """Harmonics of both forces at the joint, shape (speeds, count), and what all behind the last can add up to."""
    if len(chain.lines) != 2:
        raise ValueError("one strand alone has no joint")
    speeds = np.atleast_1d(np.asarray(frequency, float))
    count = near.harmonics.shape[-1]
    orders = np.arange(1, count + 1)
    w = speeds[:, None] * orders

    def motion(part: Excitation) -> ComplexArray:
        return np.asarray(-part.harmonics / w**2 * np.exp(-2j * np.pi * orders * part.place))

    u_on = motion(near)
    u_far = motion(far) if far is not None else np.zeros_like(u_on)
    ratios = ratios_of(chain, Waves(chain, w), w)
    lost = np.any(ratios.sound <= RESONANT, axis=-1)
    below = np.where(ratios.sound <= RESONANT, 1.0, ratios.below)
    pull = (ratios.near[0] * u_on + ratios.near[1] * u_far) / below
    rides = chain.far == ON_SPROCKET
    if rides:  # both runs of the sprocket pull at the drive, and both go with it
        pull = pull - (ratios.far[0] * u_on + ratios.far[1] * u_far) / below
    given = pull / (chain.drive_mass * w**2)
    first, second = _forces(chain, w, u_on + given, u_far + given if rides else u_far)
    rest = _rest(chain, w[:, -1], np.abs(near.harmonics[..., -1]), count, speeds)
    if far is not None:
        rest = rest + _rest(chain, w[:, -1], np.abs(far.harmonics[..., -1]), count, speeds)
    return first, second, np.asarray(np.where(lost, np.inf, rest))


def _forces(chain: Chain, w: FloatArray, u_on: ComplexArray, u_far: ComplexArray) -> tuple[ComplexArray, ComplexArray]:
    root = np.sqrt(chain.damping.modulus(w))
    parts = []
    for line in chain.lines:
        theta = w * line.transit / root
        twice = np.expm1(-2j * theta)
        parts.append((w * line.impedance * root, 1 + twice / 2, twice * 0.5j, np.exp(-1j * theta)))
    (z1, c1, s1, x1), (z2, c2, s2, x2) = parts
    load = chain.joint_mass * w**2
    if chain.far == FREE:
        weight = chain.far_mass * w**2
        below = z2 * c2 - weight * s2
        stiff, through = -z2 * (z2 * s2 + weight * c2) / below, z2 * x2 * weight / below
    else:
        stiff, through = z2 * c2 / s2, -z2 * x2 / s2
    joint = (z1 * x1 * u_on - s1 * through * u_far) / ((stiff - load) * s1 + z1 * c1)
    back = stiff * joint + through * u_far
    return np.asarray(back - load * joint), np.asarray(back)


def _rest(chain: Chain, w: FloatArray, last: FloatArray, count: int, speeds: FloatArray) -> FloatArray:
    """Bound of the sum behind the last harmonic, |u_n| = |b_N| N/(n^3 w_1^2): the integral of z |u| over n."""
    root = np.sqrt(chain.damping.modulus(w))
    fades = [np.exp(np.imag(w * line.transit / root)) for line in chain.lines]
    most = np.maximum(fades[0], fades[-1]) ** 2
    stiffest = max(line.impedance for line in chain.lines)
    wave = stiffest * np.abs(root) * (2 / np.maximum(1 - most, EPS)) ** 2 * fades[0]
    return np.asarray(np.where(most < 1 - 16 * EPS, 2 * wave * last / speeds, np.inf))


def _extremes(force: ComplexArray, rest: FloatArray) -> Extremes:
    """By the samples of the sum, which its curvature exceeds by little between them."""
    speeds, count = force.shape
    samples = max(2 ** int(np.ceil(np.log2(_PER_HARMONIC * count))), _LEAST_SAMPLES)
    spectrum = np.zeros((speeds, count + 1), complex)  # none beyond
    spectrum[:, 1:] = np.where(np.isfinite(force), force, 0.0) * (-1j * (samples / 2))
    values = np.fft.irfft(spectrum, samples, axis=-1)
    bend = np.sum(np.abs(force) * (np.pi * np.arange(1, count + 1) / samples) ** 2 / 2, axis=-1)
    whole = np.sum(np.abs(force), axis=-1) + rest
    return Extremes(values.max(axis=-1), values.min(axis=-1), np.asarray(rest + bend), np.asarray(whole))
