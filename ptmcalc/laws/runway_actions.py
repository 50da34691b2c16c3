"""Actions of a travelling crane on its runway beams by EN 1991-3:2006: what no other law of this package has.

The others: wheel loads `wheel_loads`, H_T `skew.start_side_forces`, skewing `skew`, phi_2 `lift_off_standard`, phi_1,
phi_5 and phi_6 `standard_factors`, phi_7 and buffer forces `buffer`.
"""

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

STEEL, RUBBER = "steel", "rubber"
"""Treads of the driven wheels, on rails of steel."""
DRIVE_FRICTION: Mapping[str, float] = MappingProxyType({STEEL: 0.2, RUBBER: 0.5})
"""Friction that limits the drive force [1]: steel on steel, and on rubber (EN 1991-3, 2.7.3)."""
DAMAGE_FACTORS: Mapping[str, tuple[float, float]] = MappingProxyType(
    {
        "S0": (0.198, 0.379),
        "S1": (0.250, 0.436),
        "S2": (0.315, 0.500),
        "S3": (0.397, 0.575),
        "S4": (0.500, 0.660),
        "S5": (0.630, 0.758),
        "S6": (0.794, 0.871),
        "S7": (1.0, 1.0),
        "S8": (1.260, 1.149),
        "S9": (1.587, 1.320),
    }
)
"""Damage equivalent factors lambda of normal and of shear stresses by the S class of the crane (EN 1991-3, table 2.12).
They are 2^((k - 7)/m), k the number of the class, m = 3 and 5, with three decimals."""
TROLLEY_SHARE = 0.1
"""Force of a trolley with a freely suspended load on its buffers, and of its acceleration, over the weight of trolley
and hoist load [1] (EN 1991-3, 2.7.5 and 2.11.2; to be compared with the standard)."""


def drive_force(friction: float, wheel_loads: FloatArray) -> float:
    """Drive force of a crane that its driven wheels can transmit.

        K = mu sum Q_r,min

    Args:
        friction: mu, of `DRIVE_FRICTION` [1].
        wheel_loads: Q_r,min, of every driven wheel, shape (n,) [N]. Single-wheel drives: the smallest load of the
            unloaded crane for each of them, since drives stay in step. A central drive: the loads of the wheels that it
            drives, at both rails.

    Returns:
        K [N].

    **Range** wheels that may slip while they drive; a weaker drive transmits less.
    **Error** none: a convention of the standard.
    **Source** EN 1991-3:2006, 2.7.3; as an open program has it (github.com/pmav99/crane_loads).
    """
    return float(friction * np.sum(np.asarray(wheel_loads, float)))


def fatigue_wheel_load(
    dead: float, hoist: float, dead_factor: float, hoist_factor: float, damage_factor: float
) -> float:
    """Constant wheel load that damages the runway as the service of the crane does.

        Q_e = lambda ((1 + phi_1)/2 Q_c + (1 + phi_2)/2 Q_h)

    Args:
        dead: Q_c, of the largest static wheel load, from the crane [N].
        hoist: Q_h, of it, from the hoist load [N].
        dead_factor: phi_1 [1].
        hoist_factor: phi_2 [1].
        damage_factor: lambda, of `DAMAGE_FACTORS` [1].

    Returns:
        Q_e [N].

    **Range** one crane; the spectrum of the S class of its own.
    **Error** none: a convention of the standard.
    **Source** EN 1991-3:2006, 2.12.1.
    """
    return damage_factor * ((1 + dead_factor) / 2 * dead + (1 + hoist_factor) / 2 * hoist)
