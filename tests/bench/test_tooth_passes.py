"""A thousand tooth passes of the performance study (P3), at and beside resonance: accuracy and counts are gates.

tests/bench/test_problems.py prints their time beside scipy's solvers, which begin again at every engagement.
"""

from typing import Any

import numpy as np
import pytest
from support.problems import BESIDE, teeth, teeth_exactly, teeth_of_peer

from ptmcalc.numerics import expm

FREQUENCIES = {"resonance": 24.0, "1e-6 beside it": BESIDE, "1 % beside it": 24.24}


@pytest.mark.parametrize("name", FREQUENCIES)
def test_a_thousand_passes_to_1e_10(name: str, benchmark: Any) -> None:
    """Against the iterated exponential in extended precision."""
    w = FREQUENCIES[name]
    found, expected = benchmark(teeth, w), teeth_exactly(w)
    assert found.size == 20_000
    assert np.abs(found - expected).max() <= 1e-10 * np.abs(expected).max()


@pytest.mark.parametrize("name", FREQUENCIES)
@pytest.mark.parametrize("rtol", [1e-6, 1e-10])
def test_dop853_comes_to_the_same(name: str, rtol: float) -> None:
    w = FREQUENCIES[name]
    exact, found = teeth(w, 25), teeth_of_peer("DOP853", rtol, w, 25).answer
    assert np.abs(found - exact).max() < 3e4 * rtol * np.abs(exact).max()


def test_work_is_a_handful_of_small_products(monkeypatch: pytest.MonkeyPatch) -> None:
    """Exponentials of one pass only: one call, whatever the number of passes."""
    calls: list[int] = []
    powers = expm.Powers.at
    monkeypatch.setattr(expm.Powers, "at", lambda self, times: calls.append(len(times)) or powers(self, times))
    teeth(24.0, 10)
    few = list(calls)
    calls.clear()
    teeth(24.0, 100_000)
    assert calls == few == [21]
