"""Quotients whose denominator may come to nothing, of numbers and arrays alike.

The one place where a law asks which of the two it is given: a report asks for some hundred single numbers one by one,
each of which would take ten times as long as an array of one.
"""

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def over(part: float | FloatArray, whole: float | FloatArray) -> FloatArray:
    """Quotient, infinite where nothing is left to divide by.

        q = p/w where w > 0, else infinity

    Args:
        part: p, or both with units [1].
        whole: w [1].

    Returns:
        q [1].

    **Range** any p and w; a w below 0 counts as nothing left.
    **Error** exact.
    **Source** limit of p/w for p > 0, w -> 0+.
    """
    if isinstance(part, float) and isinstance(whole, float):
        return np.asarray(float(part) / float(whole) if whole > 0 else np.inf)
    with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
        return np.where(np.greater(whole, 0), np.divide(part, whole), np.inf)
