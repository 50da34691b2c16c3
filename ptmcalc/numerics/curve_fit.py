"""Parameters of a model from a whole record: nonlinear least squares with a covariance that the residuals confirm."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Model = Callable[[FloatArray], FloatArray]
"""Values at the samples, shape (k, n), for k sets of parameters, shape (k, p)."""

_ITERATIONS = 30
_STEP = 1e-5
"""Difference of a derivative in scales: rounding and curvature are both below 1e-9 of the change."""
_SETTLED = 1e-6
_BLOCKS = 8
"""Blocks of the record over which the sums of the residuals are compared: enough for a variance, each long enough to
hold what a model that does not follow the record leaves."""
_EASIEST, _HARDEST = 1e-8, 1e8


@dataclass(frozen=True, slots=True)
class Parameters:
    """Best parameters, shape (p,), their covariance (p, p), the fitted values (n,) and the residuals' deviation."""

    values: FloatArray
    covariance: FloatArray
    fitted: FloatArray
    noise: float
    settled: bool


def fit(model: Model, begin: FloatArray, scale: FloatArray, samples: FloatArray) -> Parameters:
    """Parameters with the least sum of squared residuals, by damped Gauss-Newton steps.

        (X^T X + l diag X^T X) d = X^T r,   V = s^2 (X^T X)^-1,   s^2 = r^T r/(n - p)

    The residuals of a model that does not follow the record are not independent: their sums over blocks of the record
    scatter by more than s tells. Each variance is then that of the block sums, V_b = (X^T X)^-1 G (X^T X)^-1 with
    G = m/(m - 1) sum_b (X_b^T r_b)(X_b^T r_b)^T; the larger of both is taken.

    Args:
        model: the values at the samples.
        begin: first guess, shape (p,).
        scale: size of a change of each parameter that matters, shape (p,), > 0.
        samples: what was measured, shape (n,), n > p.

    **Range** a model that is smooth in its parameters near the best ones.
    **Error** first order in the deviations of the parameters; V holds for independent errors of one size.
    **Source** K. Levenberg, Quart. Appl. Math. 2 (1944); block sums: H. White, Econometrica 48 (1980), for clusters
    K.-Y. Liang and S. Zeger, Biometrika 73 (1986).
    """
    at, damping, settled = begin.astype(float), 1e-3, False
    count = len(at)
    steps = np.diag(_STEP * scale)
    values, slopes = _slopes(model, at, steps, scale)
    residual = samples - values
    for _ in range(_ITERATIONS):
        normal, right = slopes.T @ slopes, slopes.T @ residual
        damped = normal + damping * np.diag(np.maximum(np.diag(normal), 1e-300))
        change = np.linalg.lstsq(damped, right, rcond=None)[0]
        trial = at + change * scale
        new_values, new_slopes = _slopes(model, trial, steps, scale)
        new_residual = samples - new_values
        square, new_square = float(residual @ residual), float(new_residual @ new_residual)
        if np.isfinite(new_square) and new_square <= square:
            at, slopes, residual, values = trial, new_slopes, new_residual, new_values
            damping = max(damping / 10, _EASIEST)
            if np.abs(change).max() <= _SETTLED or square - new_square <= 1e-10 * square:
                settled = True
                break
        elif damping >= _HARDEST or np.abs(change).max() <= _SETTLED:
            settled = True
            break
        else:
            damping *= 10
    inverse = np.asarray(np.linalg.pinv(slopes.T @ slopes), np.float64)
    noise = float(np.sqrt(residual @ residual / (len(samples) - count)))
    independent = np.asarray(noise**2 * inverse, np.float64)
    covariance = np.outer(scale, scale) * _larger(independent, _of_blocks(slopes, residual, inverse))
    return Parameters(at, covariance, values, noise, settled)


def _slopes(model: Model, at: FloatArray, steps: FloatArray, scale: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Values and their derivatives with respect to the parameters in their scales, shape (n,) and (n, p)."""
    count = len(at)
    found = model(np.concatenate([at[None], at + steps, at - steps]))
    rises = (found[1 : count + 1] - found[count + 1 :]) / (2 * _STEP)
    return found[0], np.asarray(rises.T)


def _of_blocks(slopes: FloatArray, residual: FloatArray, inverse: FloatArray) -> FloatArray:
    """The covariance of the parameters by the scatter of the blocks' sums."""
    parts = np.array_split(np.arange(len(residual)), _BLOCKS)
    sums = np.array([slopes[part].T @ residual[part] for part in parts])
    return np.asarray(inverse @ (sums.T @ sums * _BLOCKS / (_BLOCKS - 1)) @ inverse)


def _larger(one: FloatArray, other: FloatArray) -> FloatArray:
    """The first covariance, stretched along each parameter to the larger of both deviations."""
    first, second = np.sqrt(np.maximum(np.diag(one), 0.0)), np.sqrt(np.maximum(np.diag(other), 0.0))
    wider = np.where(first > 0, np.maximum(second / np.where(first > 0, first, 1.0), 1.0), 1.0)
    return np.asarray(one * np.outer(wider, wider))
