"""Forces at the ends of a chain per displacement of them, at one frequency after the other.

A harmonic of frequency w is Im(A exp(i w t)).

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
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ptmcalc.numerics.harmonic.parts import FREE, HELD, ON_SPROCKET, Chain

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

EPS = float(np.finfo(float).eps)
RESONANT = 8.0
"""Multiple of the rounding of its arguments below which a denominator counts as 0."""


@dataclass(frozen=True, slots=True)
class Ratios:
    """Forces of the run-on (and run-off) per unit displacement of near and far end: numerators over one denominator;
    `sound` is the denominator over what its parts add up to, in units of their rounding."""

    near: tuple[ComplexArray, ComplexArray]
    far: tuple[ComplexArray, ComplexArray]
    below: ComplexArray
    sound: FloatArray


class Waves:
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


def ratios_of(chain: Chain, waves: Waves, w: FloatArray) -> Ratios:
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
    return Ratios(near, far, below, np.asarray(sound / EPS))


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
    waves = Waves(chain, w)
    found = ratios_of(chain, waves, w)
    above = waves.less[1] if chain.far == ON_SPROCKET else found.near[0]
    result = np.full(w.shape, complex(np.inf, 0.0))
    np.divide(above, found.below, out=result, where=found.sound > RESONANT)
    return np.asarray(result.reshape(np.shape(frequency)))
