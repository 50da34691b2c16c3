"""A contact that gives part of its energy away: the damping that stands for a coefficient of restitution."""

import math

_HALVINGS = 200
_LARGEST = 1e6


def dashpot_ratio(restitution: float) -> float:
    """Damping ratio of a spring and a dashpot side by side that let a mass go with a share of its speed.

        e = exp(-z (pi - 2 asin z)/(1 - z^2)^(1/2))   z < 1;     e = exp(-2 z acosh z/(z^2 - 1)^(1/2))   z > 1

    They push as long as k d + b d' > 0, b = 2 z (k m)^(1/2): the mass leaves them before they are at their length.

    Args:
        restitution: e, speed after the contact over that before, from 0 to 1 [1].

    Returns:
        z; none for 1, the largest there is for 0 [1].

    **Range** 0 <= e <= 1, one mass against a wall.
    **Error** rounding; at most 1e6, below a restitution of 2e-13.
    **Source** T. Schwager, T. Poeschel, Coefficient of restitution and linear dashpot model revisited, Granular Matter
    9, 2007.

    Raises:
        ValueError: for a restitution that is none.
    """
    if not 0 <= restitution <= 1:
        raise ValueError("a coefficient of restitution is between 0 and 1")
    if restitution == 1:
        return 0.0
    low, high = 0.0, _LARGEST
    for _ in range(_HALVINGS):
        middle = (low + high) / 2 if high < 2 * low or low == 0 else math.sqrt(low * high)
        if not low < middle < high:
            break
        low, high = (middle, high) if _left(middle) > restitution else (low, middle)
    return (low + high) / 2


def _left(ratio: float) -> float:
    """Share of the speed that is left."""
    if ratio < 1:
        apart = math.sqrt((1 - ratio) * (1 + ratio))
        return math.exp(-2 * ratio * math.atan2(apart, ratio) / apart)  # pi/2 - asin z = atan(apart/z)
    if ratio == 1:
        return math.exp(-2.0)
    apart = math.sqrt((ratio - 1) * (ratio + 1))
    return math.exp(-2 * ratio * math.log(ratio + apart) / apart)
