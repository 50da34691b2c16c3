"""Guides of a skewing crane: its pairs of wheels behind the front guide."""

import numpy as np
from numpy.typing import NDArray

from ptmcalc.machines.crane.travelling.machine.spec import Travelling

FloatArray = NDArray[np.float64]


def distances(spec: Travelling) -> FloatArray:
    """Of the front and the rear pair of wheels behind the front guide, shape (2,) [m]."""
    guide, base = spec.guide, spec.wheels.base
    ahead = guide is not None and guide.type == "rollers" and guide.base is not None
    front = max(guides_apart(spec) - base, 0.0) / 2 if ahead else 0.0
    return np.array([front, front + base])


def guides_apart(spec: Travelling) -> float:
    """From the front to the rear guide; flanges at the wheels where the file says nothing else [m]."""
    guide = spec.guide
    return guide.base if guide is not None and guide.base is not None else spec.wheels.base


def coupled(spec: Travelling) -> FloatArray:
    """1 for a front or rear pair of wheels on one shaft, 0 for one whose wheels are independent, shape (2,) [1]."""
    alike = [{f"A{end}", f"B{end}"} <= set(spec.wheels.driven) for end in ("1", "2")]
    return np.array([1.0 if one and spec.drive.wheels == "coupled" else 0.0 for one in alike])
