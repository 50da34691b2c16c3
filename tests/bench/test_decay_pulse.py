"""Duhamel's integral of the performance study (P6): accuracy and counts are gates, seconds a table.

`python -m pytest tests/bench/test_decay_pulse.py --benchmark-enable -s -n 0` prints the table of times against scipy's
DOP853 on the same samples in the same run.
"""

import math
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from ptmcalc.numerics import exponentials
from ptmcalc.numerics.decay_pulse import DecayPulse

K, SLOW, FAST, TAU, UNTIL, SAMPLES = 5.47, 3.0, 96.0, 5.0, 20.0, 10_001
TIMES = np.linspace(0, UNTIL, SAMPLES)


def closed() -> np.ndarray:
    """Deflection at all samples."""
    return DecayPulse(K, 0.0, SLOW, FAST, 1.0, TAU).at(TIMES)[0]


def integrated(rtol: float, times: np.ndarray) -> np.ndarray:
    """The same by DOP853, restarted where the pulse ends."""
    during, after = times[times <= TAU], times[times > TAU]

    def force(t: float) -> float:
        return math.exp(-SLOW * t) - math.exp(-FAST * t)

    run = solve_ivp(
        lambda t, y: (y[1], force(t) - K * K * y[0]), (0, TAU), (0.0, 0.0), "DOP853",
        np.append(during[during < TAU], TAU), rtol=rtol, atol=1e-2 * rtol,
    )  # fmt: skip
    free = solve_ivp(
        lambda _, y: (y[1], -K * K * y[0]), (TAU, UNTIL), run.y[:, -1], "DOP853", after, rtol=rtol, atol=1e-2 * rtol
    )
    return np.concatenate([run.y[0][: len(during)], free.y[0]])


def exactly() -> np.ndarray:
    """Partial fractions in extended precision, where t is not small: the free part from the end of the pulse."""
    k, tau = np.longdouble(K), np.longdouble(TAU)
    t = TIMES.astype(np.longdouble)
    late = np.maximum(t - tau, 0)
    total = np.zeros_like(t)
    for a, sign in ((np.longdouble(SLOW), 1), (np.longdouble(FAST), -1)):
        swing = a * np.sin(k * t) - k * np.cos(k * t)
        since = a * np.sin(k * late) - k * np.cos(k * late)
        total += sign * (swing - np.exp(-a * np.minimum(t, tau)) * since) / (a * a + k * k)
    return np.asarray(total / k)


def test_ten_thousand_samples_to_1e_13(benchmark: Any) -> None:
    found = benchmark(closed)
    expected = exactly()
    assert np.abs(found - expected).max() <= 1e-13 * np.abs(expected).max()


def test_series_only_where_they_are_needed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Work per sample is that of the exponentials: series for the first of the samples only."""
    seen: list[int] = []
    series = exponentials._series

    def counted(node: Any, t: np.ndarray) -> np.ndarray:
        if len(node.chosen) > 1:
            seen.append(len(t))
        return series(node, t)

    monkeypatch.setattr(exponentials, "_series", counted)
    closed()
    assert 1 <= len(seen) <= 6
    assert sum(seen) <= 0.02 * SAMPLES


def test_table(request: pytest.FixtureRequest) -> None:
    """Without --benchmark-enable: one run of each, and nothing is timed."""
    timed = bool(request.config.getoption("--benchmark-enable", default=False))
    clock: Callable[[], float] = time.process_time if timed else lambda: 0.0
    repeats = 300 if timed else 1
    closed()
    start = clock()
    for _ in range(repeats):
        found = closed()
    own = (clock() - start) / repeats
    rows = [f"P6 {SAMPLES} samples {'closed form':>14} {1e3 * own:10.3f} ms"]
    for rtol in (1e-6, 1e-9, 1e-12):
        start = clock()
        for _ in range(3 if timed else 1):
            other = integrated(rtol, TIMES)
        span = (clock() - start) / (3 if timed else 1)
        error = float(np.abs(other - found).max() / np.abs(found).max())
        ratio = span / own if timed else math.nan
        rows.append(
            f"P6 {SAMPLES} samples {f'DOP853 {rtol:.0e}':>14} {1e3 * span:10.1f} ms  error {error:.0e}  x {ratio:.0f}"
        )
        assert error < 1e4 * rtol
    if timed:
        start = clock()
        for _ in range(20):
            DecayPulse(K, 0.0, SLOW, FAST, 1.0, TAU).largest()
        rows.append(f"P6 largest deflection      {1e3 * (clock() - start) / 20:10.2f} ms")
        print("", *rows, sep="\n")
