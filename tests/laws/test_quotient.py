"""Quotients whose denominator may come to nothing."""

import math

import numpy as np
import pytest

from ptmcalc.laws.quotient import over


@pytest.mark.parametrize(
    ("part", "whole", "expected"),
    [
        (3.0, 2.0, 1.5),
        (-3.0, 2.0, -1.5),
        (0.0, 2.0, 0.0),
        (3.0, 0.0, math.inf),
        (3.0, -2.0, math.inf),
        (-3.0, -2.0, math.inf),
        (0.0, 0.0, math.inf),
        (1e300, 1e-300, math.inf),
        (3.0, math.inf, 0.0),
    ],
)
def test_numbers_and_arrays_give_the_same(part: float, whole: float, expected: float) -> None:
    assert float(over(part, whole)) == expected
    assert over(np.array([part, part]), np.array([whole, whole])).tolist() == [expected, expected]
    assert over(part, np.array([whole, 4.0])).tolist() == [expected, part / 4]
