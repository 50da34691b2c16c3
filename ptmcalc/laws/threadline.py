"""Transverse vibration of a free span that travels along itself: chain or belt between two shafts."""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


def transverse_frequency(order: ArrayLike, length: float, line_mass: float, tension: float, speed: float) -> FloatArray:
    """Natural frequencies of a moving string between two fixed points.

        f_k = (k/(2 l)) (c^2 - v^2)/c,   c^2 = P/q + v^2

    P is the tension without the centrifugal share q v^2: the whole tension is T = P + q v^2, and c its wave speed.
    A wave travels at c + v in one direction and at c - v in the other, so that one period of the first mode is
    1/f_1 = l/(c + v) + l/(c - v). In terms of P: f_k = (k/(2 l)) (P/q)^(1/2) (1 - v^2/c^2)^(1/2).

    Args:
        order: k, from 1 [1].
        length: l, of the free span [m].
        line_mass: q [kg/m].
        tension: P, tension of the span without the centrifugal share [N].
        speed: v, of the chain along itself [m/s].

    Returns:
        f_k [Hz]; 0 without tension.

    **Range** constant tension, sprockets that do not move sideways, link joints without friction.
    **Error** exact for a straight string. The sag of a slack span raises odd modes in its own plane, for a chain that
    is held at both ends and does not stretch up to 2.86 f_1 and 4.92 f_1 (Irvine 1981); even modes and sideways modes
    keep their values up to the square of sag over span.
    **Source** R. Skutch, Annalen der Physik 61 (1897); S. Timoshenko, D. H. Young, W. Weaver, "Vibration Problems in
    Engineering", 4th ed. 1974 (string); J. A. Wickert, C. D. Mote, J. Acoust. Soc. Am. 84 (1988) 963.
    """
    force = max(tension, 0.0) / line_mass
    wave = math.sqrt(force + speed**2)
    if wave == 0:
        return np.zeros(np.shape(order))
    return np.asarray(np.asarray(order, float) / (2 * length) * force / wave)
