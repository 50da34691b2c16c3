"""Duhamel's integral of the performance study (P6): accuracy and counts are gates.

tests/bench/test_problems.py prints its time beside scipy's solvers on the same samples.
"""

from typing import Any

import numpy as np
import pytest
from support.problems import SAMPLES, pulse, pulse_exactly, pulse_of_peer

from ptmcalc.numerics import exponentials


def test_ten_thousand_samples_to_1e_13(benchmark: Any) -> None:
    found, expected = benchmark(pulse), pulse_exactly()
    assert np.abs(found - expected).max() <= 1e-13 * np.abs(expected).max()


@pytest.mark.parametrize("rtol", [1e-6, 1e-9, 1e-12])
def test_dop853_comes_to_the_same(rtol: float) -> None:
    found, expected = pulse_of_peer("DOP853", rtol).answer, pulse()
    assert np.abs(found - expected).max() < 1e4 * rtol * np.abs(expected).max()


def test_series_only_where_they_are_needed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Work per sample is that of the exponentials: series for the first of the samples only."""
    seen: list[int] = []
    series = exponentials._series

    def counted(node: Any, t: np.ndarray) -> np.ndarray:
        if len(node.chosen) > 1:
            seen.append(len(t))
        return series(node, t)

    monkeypatch.setattr(exponentials, "_series", counted)
    pulse()
    assert 1 <= len(seen) <= 6
    assert sum(seen) <= 0.02 * SAMPLES


def test_evenly_spaced_samples_share_their_exponentials(monkeypatch: pytest.MonkeyPatch) -> None:
    """Some hundred for ten thousand samples, those of the first samples among them."""
    made: list[int] = []
    exp = np.exp

    def counted(values: Any, *arguments: Any, **options: Any) -> Any:
        made.append(np.size(values))
        return exp(values, *arguments, **options)

    monkeypatch.setattr(exponentials.np, "exp", counted)
    pulse()
    assert sum(made) <= 0.09 * SAMPLES
