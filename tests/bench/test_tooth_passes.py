"""A thousand tooth passes of the performance study (P3), at and beside resonance: counts are gates, seconds a table.

`python -m pytest tests/bench/test_tooth_passes.py --benchmark-enable -s -n 0` prints the table of times against
scipy's DOP853 restarted at every engagement, in the same run, and of RK45 on x'' = -x over 100 rad.
"""

import math
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from ptmcalc.numerics import expm
from ptmcalc.numerics.passes import Passes, Wave

TEETH, PITCH, OMEGA, ZETA, PASSES = 12, 0.1, 2.0, 1e-3, 1000
HALF = math.pi / TEETH
FORCE = OMEGA**2 * PITCH / 2 / math.sin(HALF)
WAVE = Wave(OMEGA, -HALF, 2 * HALF / OMEGA)
PLACES = np.arange(20) / 20
FREQUENCIES = {"resonance": 24.0, "1e-6 beside it": 24 * (1 + 1e-6), "1 % beside it": 24.24}
DEFLECTION = np.array([[1.0, 0.0]])


def played(w: float, passes: int = PASSES) -> np.ndarray:
    """Deflection at all places of all passes."""
    rate = np.array([[0.0, 1.0], [-w * w, -2 * ZETA * w]])
    return Passes(rate, np.array([0.0, FORCE]), WAVE, passes).at(PLACES, DEFLECTION)[:, :, 0]


def restarted(w: float, rtol: float, passes: int) -> np.ndarray:
    """The same by DOP853."""
    state, seen = np.zeros(2), np.empty((passes, len(PLACES)))
    times = [*(PLACES * WAVE.period), WAVE.period]

    def rate(t: float, y: np.ndarray) -> tuple[float, float]:
        return y[1], FORCE * math.sin(OMEGA * t - HALF) - 2 * ZETA * w * y[1] - w * w * y[0]

    for k in range(passes):
        run = solve_ivp(rate, (0, WAVE.period), state, "DOP853", times, rtol=rtol, atol=1e-2 * rtol)
        seen[k], state = run.y[0, :-1], run.y[:, -1]
    return seen


@pytest.mark.parametrize("name", FREQUENCIES)
def test_a_thousand_passes_to_1e_9(name: str, benchmark: Any) -> None:
    """Against the iterated exponential in extended precision: complex amplitude times the same factor, pass by pass."""
    w = FREQUENCIES[name]
    found = benchmark(played, w)
    assert found.size == 20_000
    pole = np.clongdouble(complex(-ZETA * w, 0)) + np.clongdouble(1j) * np.longdouble(w) * np.sqrt(
        np.longdouble(1) - np.longdouble(ZETA) ** 2
    )
    turn = np.clongdouble(1j) * OMEGA
    late = np.exp(-np.clongdouble(1j) * HALF) / (turn - pole)
    back = np.conj(np.exp(-np.clongdouble(1j) * HALF)) / (np.conj(turn) - pole)
    times = PLACES.astype(np.longdouble) * WAVE.period

    def gained(t: np.ndarray) -> np.ndarray:
        """Integral of exp(pole (t - s)) sin(OMEGA s - HALF) over a pass up to t."""
        both = late * (np.exp(turn * t) - np.exp(pole * t)) - back * (np.exp(-turn * t) - np.exp(pole * t))
        return FORCE * both / np.clongdouble(2j)

    factor, kick = np.exp(pole * WAVE.period), gained(np.array([np.longdouble(WAVE.period)]))[0]
    amplitude, expected = np.clongdouble(0), np.empty((PASSES, len(PLACES)))
    decay, inside = np.exp(pole * times), gained(times)
    for k in range(PASSES):
        expected[k] = ((decay * amplitude + inside).imag / pole.imag).astype(float)
        amplitude = factor * amplitude + kick
    assert np.abs(found - expected).max() <= 1e-10 * np.abs(expected).max()


def test_work_is_a_handful_of_small_products(monkeypatch: pytest.MonkeyPatch) -> None:
    """Exponentials of one pass only: two calls, whatever the number of passes."""
    calls: list[int] = []
    powers = expm.Powers.at
    monkeypatch.setattr(expm.Powers, "at", lambda self, times: calls.append(len(times)) or powers(self, times))
    played(24.0, 10)
    few = list(calls)
    calls.clear()
    played(24.0, 100_000)
    assert calls == few == [1, 20]


def test_table(request: pytest.FixtureRequest) -> None:
    """Without --benchmark-enable: fewer passes, and nothing is timed."""
    timed = bool(request.config.getoption("--benchmark-enable", default=False))
    passes = PASSES if timed else 25
    clock: Callable[[], float] = time.process_time if timed else lambda: 0.0
    rows = []
    for name, w in FREQUENCIES.items():
        exact, repeats = played(w, passes), 300 if timed else 1
        start = clock()
        for _ in range(repeats):
            played(w, passes)
        own = (clock() - start) / repeats
        rows.append(f"P3 {name:<16} {'affine map':>14} {1e3 * own:10.3f} ms")
        for rtol in (1e-6, 1e-10):
            start = clock()
            found = restarted(w, rtol, passes)
            span = clock() - start
            error = float(np.abs(found - exact).max() / np.abs(exact).max())
            ratio = span / own if timed else math.nan
            rows.append(
                f"P3 {name:<16} {f'DOP853 {rtol:.0e}':>14} {1e3 * span:10.1f} ms  error {error:.0e}  x {ratio:.0f}"
            )
            assert error < 3e4 * rtol
    if timed:
        start = clock()
        for _ in range(10):
            solve_ivp(lambda t, y: (y[1], -y[0]), (0, 100), (1.0, 0.0), rtol=1e-6)
        rows.append(f"RK45 on x'' = -x over 100 rad {1e3 * (clock() - start) / 10:10.1f} ms")
        print("", *rows, sep="\n")
