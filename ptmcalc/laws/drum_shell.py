"""Stress of a drum: the shell under wound layers, at the edge of the winding and under one wrap, and its flanges.

The shell is a long thin cylinder. A wrap of the pull F at the pitch p presses it with F/(p R). Lengths along the shell
are in units of 1/beta with beta = (3 (1 - nu^2))^(1/4)/sqrt(R t).
"""

import math
from collections.abc import Sequence
from itertools import accumulate, pairwise

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

POISSON = 0.3
"""Poisson's ratio of steel and cast iron [1]; 0.25 to 0.3. The bending stresses change by at most 1 %."""
_BENDING = 1.5 / math.sqrt(3 * (1 - POISSON**2))
"""Bending stress 6 M/t^2 of the moment p_r/(4 beta^2) relative to the hoop stress p_r R/t: 0.908."""
YIELD = {
    "S235": ((0.016, 235e6), (0.040, 225e6), (0.100, 215e6)),
    "S275": ((0.016, 275e6), (0.040, 265e6), (0.063, 255e6), (0.080, 245e6), (0.100, 235e6)),
    "S355": ((0.016, 355e6), (0.040, 345e6), (0.063, 335e6), (0.080, 325e6), (0.100, 315e6)),
}
"""Yield strength of steels [N/m^2] up to a thickness [m] (EN 10025-2:2004, to be compared with the certificate)."""


def yield_strength(steel: str, thickness: float) -> float | None:
    """Yield strength of a structural steel by its thickness; None above 100 mm.

        S235: f_y = 235, 225, 215 N/mm^2 up to t = 16, 40, 100 mm

    Args:
        steel: a name of `YIELD`.
        thickness: t [m].

    Returns:
        f_y [N/m^2].

    **Range** plates up to 100 mm.
    **Error** none: a table, to be compared with the certificate.
    **Source** EN 10025-2:2004.
    """
    return next((strength for most, strength in YIELD[steel] if thickness <= most), None)


def layer_pressures(layers: int, compliance: float) -> tuple[float, ...]:
    """Pressures on the shell under one to n layers wound with one pull, relative to that of the first layer.

        C_n = sum over k = 1 ... n of 1/(1 + (k - 1) kappa),   kappa = E_r A_r/(E t p)

    Args:
        layers: n.
        compliance: kappa, stiffness of a layer relative to that of the shell [1].

    Returns:
        C_1 ... C_n; 1.87, 2.65 and 3.99 for two, three and five layers at kappa = 0.144 [1].

    **Range** lower layers taut; ropes stiff across.
    **Error** an upper bound: the transverse compliance of the rope lowers it. DNV 2.22:2011 has 1.75 for two layers.
    **Source** derived: each new layer compresses the shell and the layers below together.
    """
    return tuple(accumulate(1 / (1 + k * compliance) for k in range(layers)))


def pull_left(layers: int, compliance: float) -> float:
    """Pull left in the first layer under the layers wound on it, relative to the pull of the rope.

        1 - sum over k = 2 ... n of kappa/(1 + (k - 1) kappa)

    Args:
        layers: n.
        compliance: kappa of `layer_pressures` [1].

    Returns:
        the share; below 0 the first layer goes slack [1].

    **Range** as `layer_pressures`.
    **Error** a lower bound: the transverse compliance of the rope relieves the shell.
    **Source** derived, as `layer_pressures`.
    """
    return 1 - math.fsum(compliance / (1 + k * compliance) for k in range(1, layers))


def edge_of_winding(place: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Hoop and axial bending stress near the edge of the wound part, relative to the hoop stress far inside.

        hoop: 1 - exp(-x) cos(x)/2,   bending: 0.908 exp(-x) sin(x)

    Args:
        place: x = beta times the distance from the edge, inside the wound part [1].

    Returns:
        hoop 1/2 at the edge; bending at most 0.293, at x = pi/4 [1].

    **Range** pressure on a half of a long cylinder.
    **Error** of thin shells, t/R.
    **Source** S. Timoshenko, Theory of Plates and Shells; M. Hetenyi, Beams on Elastic Foundation.
    """
    fading = np.exp(-place)
    return np.asarray(1 - fading * np.cos(place) / 2), np.asarray(_BENDING * fading * np.sin(place))


def single_wrap(pull: float, radius: float, thickness: float) -> tuple[float, float]:
    """Hoop and axial bending stress under one wrap on a bare shell.

        hoop: F beta/(2 t),   bending: 1.5 F/(beta R t^2)

    Args:
        pull: F [N].
        radius: R, of the middle of the shell [m].
        thickness: t [m].

    Returns:
        0.909 and 1.65 F/(sqrt(D) t^1.5) with D = 2 R [N/m^2].

    **Range** a ring load on a long cylinder.
    **Error** of thin shells, t/R.
    **Source** S. Timoshenko, Theory of Plates and Shells. Handbooks average over the width of the rope: 0.96, not 1.65.
    """
    beta = (3 * (1 - POISSON**2)) ** 0.25 / math.sqrt(radius * thickness)
    return pull * beta / (2 * thickness), 1.5 * pull / (beta * radius * thickness**2)


def equivalent_stress(axial: FloatArray, hoop: FloatArray, shear: float) -> FloatArray:
    """Equivalent stress of a shell by von Mises.

        s_v = sqrt(s_x^2 - s_x s_t + s_t^2 + 3 tau^2)

    Args:
        axial: s_x [N/m^2].
        hoop: s_t [N/m^2].
        shear: tau [N/m^2].

    Returns:
        s_v [N/m^2].

    **Range** plane stress.
    **Error** none: a definition.
    **Source** R. von Mises.
    """
    return np.asarray(np.sqrt(axial**2 - axial * hoop + hoop**2 + 3 * shear**2))


def flange_loads(pressures: Sequence[float], radii: Sequence[float], radius: float) -> tuple[float, float]:
    """Thrust and moment of a flange at the shell, per length of its circumference.

        T = (1/R) sum q_k (r_k^2 - r_(k-1)^2)/2,   M = (1/R) sum q_k (r^3/3 - R r^2/2) from r_(k-1) to r_k

    Args:
        pressures: q_k, axial pressure of each layer on the flange [N/m^2].
        radii: r_0 ... r_n, limits of the layers [m].
        radius: R, of the clamped edge [m].

    Returns:
        T [N/m] and M [N].

    **Range** a flange clamped at the shell and free outside.
    **Error** an upper bound: sectors of the flange are cantilevers, without the hoop stress that relieves them.
    **Source** derived: equilibrium of a sector.
    """
    thrust = moment = 0.0
    for pressure, (low, high) in zip(pressures, pairwise(radii), strict=True):
        thrust += pressure * (high**2 - low**2) / 2
        moment += pressure * ((high**3 - low**3) / 3 - radius * (high**2 - low**2) / 2)
    return thrust / radius, moment / radius
