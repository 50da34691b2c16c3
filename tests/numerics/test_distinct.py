"""Distinct values, against a set."""

import numpy as np
import pytest

from ptmcalc.numerics.distinct import distinct


@pytest.mark.parametrize("values", [[], [2.0], [3.0, 1.0, 2.0], [1.0, 1.0, 1.0], [-0.0, 0.0, 5.0, -5.0, 5.0, 1e-300]])
def test_each_value_once_in_rising_order(values: list[float]) -> None:
    given = np.array(values)
    assert distinct(given).tolist() == sorted(set(values))
    assert given.tolist() == values
