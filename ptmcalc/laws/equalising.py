"""Equalising drive: a sprocket turned unevenly, so that its chain runs evenly.

h = pi/z is half the angle of one pitch, R the radius of the pins; a place x counts pitches from the middle of a tooth.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


def _angle(place: ArrayLike, teeth: int) -> FloatArray:
    x = np.asarray(place, float)
    return np.asarray(np.arcsin(np.clip(2 * np.sin(np.pi / teeth) * (x - np.floor(x + 0.5)), -1.0, 1.0)))


def equalising_angle(place: ArrayLike, teeth: int) -> FloatArray:
    """Angle of the sprocket at which the chain is where even running wants it.

        phi = arcsin(2 sin(h) x) = arcsin(V t/R),   |x| <= 1/2

    Args:
        place: x, pitches since the middle of a tooth [1].
        teeth: z.

    Returns:
        phi, from the middle of the tooth [rad].

    **Range** any number of teeth from 3; exactly one pitch takes p/V.
    **Error** exact.
    **Source** lecture notes Kramatorsk 2007: omega cos(phi) = V/R; integrated.
    """
    return _angle(place, teeth)


def equalising_speed(place: ArrayLike, chain_speed: float, pitch: float, teeth: int) -> FloatArray:
    """Angular speed of the sprocket that keeps the chain even.

        omega = V/(R cos(phi)),   phi of `equalising_angle`

    Args:
        place: x, pitches since the middle of a tooth [1].
        chain_speed: V [m/s].
        pitch: p [m].
        teeth: z.

    Returns:
        omega, from V/R to V/(R cos(h)) [rad/s].

    **Range** as `equalising_angle`.
    **Error** exact.
    **Source** lecture notes Kramatorsk 2007.
    """
    slowest = 2 * math.sin(math.pi / teeth) * (chain_speed / pitch)
    return np.asarray(slowest / np.cos(_angle(place, teeth)))


def equalising_ratio(teeth: int) -> float:
    """Largest over smallest speed of the sprocket of an equalising drive.

        omega_max/omega_min = 1/cos(pi/z)

    Args:
        teeth: z.

    Returns:
        ratio [1].

    **Range** as `equalising_angle`.
    **Error** exact.
    **Source** lecture notes Kramatorsk 2007.
    """
    return 1 / math.cos(math.pi / teeth)


def equalising_acceleration(chain_speed: float, pitch: float, teeth: int) -> float:
    """Largest angular acceleration of the sprocket of an equalising drive.

        eps = (V/R)^2 tan(h)/cos(h)^2

    Args:
        chain_speed: V [m/s].
        pitch: p [m].
        teeth: z.

    Returns:
        eps, before an engagement; it jumps to -eps there and the drive's inertia with it [rad/s^2].

    **Range** as `equalising_angle`.
    **Error** exact.
    **Source** derived: time derivative of omega = V/(R cos(phi)).
    """
    half = math.pi / teeth
    return (2 * math.sin(half) * (chain_speed / pitch)) ** 2 * math.tan(half) / math.cos(half) ** 2
