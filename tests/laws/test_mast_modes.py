"""The column as an exact beam where rounding could take its digits: a load close to its far end."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import eigh
from support.beams import element

from ptmcalc.laws.mast_modes import Mast, mast_frequency


@pytest.mark.parametrize("guide", [0.0, 1e6, 1e8])
@pytest.mark.parametrize("beyond", [4e-3, 2e-3, 1e-3])
def test_a_load_close_to_the_far_end(beyond: float, guide: float) -> None:
    """A stretch of 0.1 % of the column is no beam any more whose stiffness has digits left: elements, one of them
    beyond the load."""
    length, bending, line, count = 7.5, 1.3e8, 450.0, 48
    one = Mast(length, bending, line * length, math.inf, 830.0, root_rotation=1.7e-7, place=1 - beyond,
               guide_stiffness=guide)  # fmt: skip
    k, m = np.zeros((2 * count + 4, 2 * count + 4)), np.zeros((2 * count + 4, 2 * count + 4))
    for i in range(count + 1):
        h = length * ((1 - beyond) / count if i < count else beyond)
        at = slice(2 * i, 2 * i + 4)
        own = element(h, bending, line * h)
        k[at, at] += own[0]
        m[at, at] += own[1]
    k[1, 1] += 1 / 1.7e-7
    k[-2, -2] += guide
    m[-4, -4] += 830.0
    exact = 1 / np.sqrt(eigh(m[1:, 1:], k[1:, 1:], eigvals_only=True)[::-1][:3])
    found = [mast_frequency(one, mode) for mode in (1, 2, 3)]
    assert found == pytest.approx(exact, rel=max(1e-6, 50 * np.finfo(float).eps / beyond**3))


def test_a_load_that_rounding_puts_below_the_far_end_is_at_it() -> None:
    """A height less a height over a length: 1 but for the last digit. The frequency was ten times too high."""
    end = Mast(7.5, 1.3e8, 3400.0, math.inf, 830.0, root_rotation=1.7e-7)
    below = replace(end, place=math.nextafter(1.0, 0.0))
    for mode in (1, 2, 3):
        assert mast_frequency(below, mode) == pytest.approx(mast_frequency(end, mode), rel=1e-12)
