"""Work balance by its own quadrature: the independent reference of a simulation."""

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def work(power: FloatArray, step: float) -> float:
    """Work of a sampled power by the trapezoidal rule; second order in the step."""
    return float(np.trapezoid(power, dx=step))


def residual(put_in: float, taken_out: float, stored: float, scale: float) -> float:
    """What a balance leaves over, relative to the larger of the converted work and `scale`."""
    largest = max(abs(put_in), abs(taken_out), abs(stored), scale)
    return abs(put_in - taken_out - stored) / largest if largest > 0 else 0.0
