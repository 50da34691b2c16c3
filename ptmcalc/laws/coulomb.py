"""Motion against dry friction of constant size: it stops, and then it holds. No smoothing, no time step."""

import math
from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


def coulomb_slide(mass: float, friction: float, pull: float, speed: float, time: ArrayLike) -> FloatArray:
    """Path of a mass against dry friction under a constant pull, with its stop and what follows.

        m v' = P - F sign(v);   at v = 0 it stays if |P| <= F, otherwise it goes on with P - F sign(P)

    Args:
        mass: m [kg].
        friction: F, at rest and in motion [N].
        pull: P, positive in the direction of positive speed [N].
        speed: v_0 [m/s].
        time: t, since then [s].

    Returns:
        path [m].

    **Range** t >= 0, F >= 0; sticking friction equal to sliding friction.
    **Error** exact for that model.
    **Source** C. A. de Coulomb's law of friction; uniform acceleration between the stops.
    """
    t = np.asarray(time, float)
    way = math.copysign(1.0, speed if speed != 0 else pull)
    first = (pull - friction * way) / mass
    if speed == 0 and first * way <= 0:
        return np.zeros_like(t)
    if first * way >= 0:
        return np.asarray(speed * t + first * t**2 / 2)
    stop = -speed / first
    second = (pull - math.copysign(friction, pull)) / mass if abs(pull) > friction else 0.0
    before, after = np.minimum(t, stop), np.maximum(t - stop, 0.0)
    return np.asarray(speed * before * (1 - before / stop / 2) + second * after**2 / 2)


def coulomb_decay(
    displacement: float, kinetic_friction: float, static_friction: float, stiffness: float, mass: float
) -> tuple[float, float, float]:
    """Half swings of a mass on a spring against dry friction until it sticks, where and when.

        n = smallest with |x_0| - 2 n F/c <= F_s/c;   x = (-1)^n sign(x_0) (|x_0| - 2 n F/c);   t = n pi (m/c)^(1/2)

    Args:
        displacement: x_0, from the unloaded spring, let go at rest [m].
        kinetic_friction: F, in motion [N].
        static_friction: F_s, at rest, at least F [N].
        stiffness: c [N/m].
        mass: m [kg].

    Returns:
        (n [1], x [m], t [s]).

    **Range** F > 0, F_s >= F, no other damping.
    **Error** exact; n counts in decimals as they are written, so that rounding adds or drops no half swing.
    **Source** derived: each half swing is a harmonic about +-F/c and loses 2 F/c of amplitude.

    Raises:
        ValueError: without friction in motion, where the vibration does not end.
    """
    if kinetic_friction <= 0:
        raise ValueError("without friction the vibration does not end")
    force = _as_written(abs(displacement)) * _as_written(stiffness)
    drop = 2 * _as_written(kinetic_friction)
    count = max(math.ceil((force - _as_written(static_friction)) / drop), 0)
    rest = (force - count * drop) / _as_written(stiffness) * (-1) ** (count % 2)
    return float(count), math.copysign(1.0, displacement) * float(rest), count * math.pi * math.sqrt(mass / stiffness)


def _as_written(number: float) -> Fraction:
    """The shortest decimal of a float: 0.05 is a twentieth, not the float a little above it."""
    return Fraction(repr(float(number)))
