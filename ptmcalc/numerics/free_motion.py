"""Free motion of oscillators with any damping, in the form that loses no digits."""

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def free_motion(w: FloatArray, zeta: FloatArray, time: FloatArray) -> FloatArray:
    """Map of (q, q') over a time for q'' + 2 zeta w q' + w^2 q = 0.

        q = e (cos + zeta w sin/w_d) q_0 + e sin/w_d q'_0,   e = exp(-zeta w t), w_d = w (1 - zeta^2)^(1/2)

    Args:
        w: frequencies, above 0, shape (modes,) [rad/s].
        zeta: damping ratios, also above 1, shape (modes,) [1].
        time: shape (..., 1) [s].

    Returns:
        maps, shape (..., modes, 2, 2).

    **Error** rounding; critical damping is no special case.
    """
    over = zeta > 1
    root = np.sqrt(np.abs(zeta - 1)) * np.sqrt(zeta + 1)
    damped, slow = w * root, np.exp(-w * np.where(over, 1 / (np.maximum(zeta, 1.0) + root), zeta) * time)
    fast = np.expm1(-2 * damped * time)
    cosine = slow * np.where(over, 1 + fast / 2, np.cos(damped * time))
    nonzero = np.where(damped > 0, damped, 1.0)
    sine = slow * np.where(damped > 0, np.where(over, -fast / 2, np.sin(damped * time)) / nonzero, time)
    drag = zeta * w * sine
    return np.stack([cosine + drag, sine, -(w**2) * sine, cosine - drag], axis=-1).reshape(*cosine.shape, 2, 2)
