"""Resistance to motion of a belt conveyor (ISO 5048, DIN 22101)."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

_LENGTHS = (80, 100, 150, 200, 300, 400, 500, 600, 700, 800, 900, 1000, 1500, 2000)
_FACTORS = (1.92, 1.78, 1.58, 1.45, 1.31, 1.25, 1.20, 1.17, 1.14, 1.12, 1.10, 1.09, 1.06, 1.05)

SHORTEST_FOR_LENGTH_FACTOR = float(_LENGTHS[0])
"""Below this length [m] secondary resistances dominate and must be given themselves."""


def main_resistance_per_length(
    coefficient: float, gravity: float, line_load: float, idler_line_mass: float, slope_cosine: float
) -> float:
    """Resistance of the idlers to one metre of strand.

        w = f g (q cos(delta) + q_R)

    Args:
        coefficient: f, fictitious friction coefficient [1].
        gravity: g [m/s^2].
        line_load: q, belt and load per length [kg/m].
        idler_line_mass: q_R, rotating idler mass per length [kg/m].
        slope_cosine: cos(delta), slope of the strand; 1 is allowed below 18 degrees [1].

    Returns:
        w [N/m].

    **Range** a loaded belt conveyor on troughing idlers, f about 0.017 to 0.030, 0.020 in normal conditions.
    **Error** none bound: f is an empirical mean over the whole conveyor.
    **Source** ISO 5048:1989; DIN 22101.
    """
    return coefficient * gravity * (line_load * slope_cosine + idler_line_mass)


def length_factor(length: ArrayLike) -> FloatArray:
    """Secondary resistances as a factor on the main resistances of a long conveyor.

        C = C(L), table from 80 m (1.92) to 2000 m (1.05), interpolated over log L

    Args:
        length: L, centre distance [m].

    Returns:
        C [1].

    **Range** L >= 80 m; below it secondary resistances must be computed one by one. Above 2000 m C stays 1.05.
    **Error** the table rounds to 0.01 and stands for typical loading points; 25 % of C - 1 is a fair interval.
    **Source** DIN 22101 and ISO 5048 length coefficient as quoted in public handbooks; to be compared with the
    edition in force.

    Raises:
        ValueError: below 80 m.
    """
    if np.any(np.less(length, SHORTEST_FOR_LENGTH_FACTOR)):
        raise ValueError(f"the table of C starts at {SHORTEST_FOR_LENGTH_FACTOR:g} m")
    return np.asarray(np.interp(np.log(length), np.log(_LENGTHS), _FACTORS))
