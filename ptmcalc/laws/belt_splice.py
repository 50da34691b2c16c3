"""Strength of a conveyor belt with its splices by DIN 22101:2011."""

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

SPLICE_CONDITIONS: Mapping[str, float] = MappingProxyType({"good": 1.0, "normal": 1.1, "poor": 1.2})
"""S_0 of DIN 22101:2011 by the conditions in which the splice is made [1] [R]: to be compared with the edition in
force. A larger value requires a stronger belt."""

BELT_LIFE: Mapping[str, float] = MappingProxyType({"short": 1.5, "normal": 1.7, "long": 1.9})
"""S_1 of DIN 22101:2011 by the expected life of the belt and the consequences of its failure [1] [R]: to be compared
with the edition in force. A larger value requires a stronger belt."""


def splice_reserve(
    strength: float, reference_strength: float, tension: ArrayLike, conditions: float, life: float
) -> FloatArray:
    """Reserve of a spliced belt against fatigue of the splice.

        r = k_N k_t,rel/(k_max S_0 S_1)

    Args:
        strength: k_N, rated breaking strength per width [N/m].
        reference_strength: k_t,rel, reference fatigue strength of the splice relative to k_N [1].
        tension: k_max, largest belt tension per width, edge addition included [N/m].
        conditions: S_0, of `SPLICE_CONDITIONS` [1].
        life: S_1, of `BELT_LIFE` [1].

    Returns:
        r; infinite without tension, sufficient from 1 on [1].

    **Range** vulcanised splices with a reference fatigue strength after DIN 22110-3.
    **Error** that of k_t,rel, which differs between makers.
    **Source** DIN 22101:2011, required minimum strength of the belt, solved for the reserve; as quoted by belt makers.
    """
    most = np.asarray(tension, float)
    with np.errstate(divide="ignore"):
        reserve = strength * reference_strength / (np.maximum(most, 0) * conditions * life)
    return np.asarray(np.where(most > 0, reserve, np.inf))
