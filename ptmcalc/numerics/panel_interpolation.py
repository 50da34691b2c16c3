"""Histories of samples between their samples: polynomials over panels of several steps."""

from functools import cache

import numpy as np

from ptmcalc.numerics.loop import FloatArray, Grid

_READ = 8192
"""Times that are read at once: as many as the cache holds."""


def between(history: FloatArray, grid: Grid, when: FloatArray) -> FloatArray:
    """A history of samples at the times `when`, by the polynomials through the samples of every panel."""
    many = grid.panel
    panels = np.lib.stride_tricks.sliding_window_view(history, many + 1)[::many]
    coefficients = _to_chebyshev(many) @ panels.T
    found = np.empty(len(when))
    for begin in range(0, len(when), _READ):
        part = slice(begin, begin + _READ)
        found[part] = _summed(coefficients, when[part] / (grid.step * many))
    return found


def _summed(coefficients: FloatArray, place: FloatArray) -> FloatArray:
    """Sums of Chebyshev polynomials at places counted in panels, by the recurrence of Clenshaw."""
    which = np.minimum(place, coefficients.shape[1] - 1).astype(np.intp)
    twice, newer, older = 4 * (place - which) - 2, np.zeros(len(place)), np.zeros(len(place))
    spare = np.empty(len(place))
    for one in coefficients[:0:-1]:
        np.subtract(one.take(which), older, out=older)
        older += np.multiply(twice, newer, out=spare)
        newer, older = older, newer
    twice *= newer / 2
    return np.asarray(coefficients[0].take(which) - older + twice)


@cache
def _to_chebyshev(many: int) -> FloatArray:
    """Chebyshev coefficients of the polynomial through the samples of a panel of so many steps."""
    at_samples = np.polynomial.chebyshev.chebvander(np.linspace(-1.0, 1.0, many + 1), many)
    found: FloatArray = np.asarray(np.linalg.inv(at_samples), float)
    found.setflags(write=False)
    return found
