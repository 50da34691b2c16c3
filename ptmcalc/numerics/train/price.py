"""What a run of a train will cost, by the radians of its vibrations that have to be looked at."""

import math

import numpy as np

from ptmcalc.numerics.train.modes import damped
from ptmcalc.numerics.train.parts import Train
from ptmcalc.numerics.train.signals import FloatArray

RADIAN, LONG_RADIAN = 2e-5, 5e-5
"""Seconds a radian takes that is followed, and one that is passed over by long panels."""
_FADES = 25.0
_GLIDED = 200.0


def radians(train: Train, end: float) -> float:
    """Radians of the fastest vibration to the end or until it has faded: a smooth curve has to follow it."""
    values, seen = _seen(train, end)
    return float((values * seen).max(initial=1.0))


def linear(train: Train, end: float) -> float:
    """Seconds of what rings in a linear motion.

    It goes over what rings beside something slower by long panels, so that no more than some hundred radians of it
    are looked at; the slowest vibration that is left is followed until it has faded.
    """
    values, seen = _seen(train, end)
    before = np.concatenate([[0.0], np.maximum.accumulate(seen)])[: len(seen)]
    alone = values * np.maximum(seen - before, 0.0)
    return float((RADIAN * alone + LONG_RADIAN * np.minimum(values * seen, _GLIDED)).sum())


def _seen(train: Train, end: float) -> tuple[FloatArray, FloatArray]:
    """Frequencies of the vibrations, rising, and how long each is seen [s]."""
    values, fading = damped(train)
    return values, np.minimum(end, np.divide(_FADES, fading, out=np.full_like(fading, math.inf), where=fading > 0))
