"""A slewing drive's cycle: what its torques are worth, and what they make of the turning crane."""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]
Numbers = Sequence[float] | FloatArray
"""One number for each phase of a cycle."""


def fatigue_torque(shares: Numbers, torques: Numbers, exponent: float = 3.0) -> float:
    """Torque that, always there, would tire the gear as much as the phases of a cycle.

        M = (sum lambda_i |M_i|^m)^(1/m)

    Args:
        shares: lambda_i, of the time of the cycle, shape (n,) [1].
        torques: M_i, in each phase, shape (n,) [N*m].
        exponent: m, slope of fatigue over the load: 3 for the contact of teeth, 6 to 9 for their bending [1].

    Returns:
        M [N*m].

    **Range** one slope of fatigue; shares that add up to 1, or to what rounding made of it.
    **Error** exact for that law of damage.
    **Source** Palmgren 1924, Miner 1945; design of slewing cranes on a fixed column, course notes (3.5.2.11), whose
    print has lost the third power and its root.
    """
    sizes = np.abs(np.asarray(torques, float))
    largest = float(np.max(sizes, initial=0.0))
    if largest == 0:
        return 0.0
    damage = np.sum(np.asarray(shares, float) * (sizes / largest) ** exponent)
    return largest * float(damage ** (1 / exponent))


def uniform_start_time(inertia: ArrayLike, speed: ArrayLike, torque: ArrayLike, resistance: ArrayLike) -> FloatArray:
    """Time in which a constant torque brings a rigid crane to its speed.

        t = J w/(M - M_r)

    Args:
        inertia: J, of all that is accelerated, about the slewing axis [kg*m^2].
        speed: w [rad/s].
        torque: M, of the motor, carried to the slewing axis [N*m].
        resistance: M_r, of friction and wind [N*m].

    Returns:
        t; infinite for M <= M_r, a motor that stalls [s].

    **Range** a rigid crane, constant torques.
    **Error** exact for that model; the load swings, see `momentum_share`.
    **Source** change of angular momentum.
    """
    free = np.asarray(torque, float) - np.asarray(resistance)
    momentum = np.asarray(inertia, float) * np.asarray(speed)
    return np.asarray(np.where(free > 0, momentum / np.where(free > 0, free, 1.0), math.inf))


def torque_for_start(inertia: ArrayLike, speed: ArrayLike, time: ArrayLike, resistance: ArrayLike) -> FloatArray:
    """Constant torque that brings a rigid crane to its speed in a time.

        M = J w/t + M_r

    Args:
        inertia: J, of all that is accelerated, about the slewing axis [kg*m^2].
        speed: w [rad/s].
        time: t [s].
        resistance: M_r, of friction and wind [N*m].

    Returns:
        M, about the slewing axis [N*m].

    **Range** as `uniform_start_time`.
    **Error** exact for that model.
    **Source** change of angular momentum.
    """
    return np.asarray(np.asarray(inertia, float) * np.asarray(speed) / np.asarray(time) + np.asarray(resistance))


def ring_moment(weights: Numbers, radii: Numbers, sideways: Numbers, heights: Numbers) -> float:
    """Tilting moment of a slewing ring: weights beside the axis and horizontal forces above the ring.

        M = |sum G_i r_i + sum H_j h_j|

    Args:
        weights: G_i, shape (n,) [N].
        radii: r_i, of each weight from the axis, towards the load, negative behind, shape (n,) [m].
        sideways: H_j, horizontal forces outwards along the jib, shape (k,) [N].
        heights: h_j, of each over the ring, shape (k,) [m].

    Returns:
        M [N*m].

    **Range** a rigid crane, its parts in the plane of the jib.
    **Error** exact for that model.
    **Source** balance of moments; catalogues of slewing rings.
    """
    standing = np.sum(np.asarray(weights, float) * np.asarray(radii, float))
    return abs(float(standing + np.sum(np.asarray(sideways, float) * np.asarray(heights, float))))
