"""Largest and smallest values from panels against the closed forms of the signals."""

import math

import numpy as np
import pytest

from ptmcalc.numerics import panels
from ptmcalc.numerics.extremes import Extremes


def times(starts: np.ndarray, length: float) -> np.ndarray:
    return starts[:, None] + length * panels.NODES


def seen(signals: list, end: float, length: float, chunk: int = 7) -> tuple[Extremes, Extremes]:
    """Extremes of functions of time over [0, end], shown in chunks of panels."""
    starts = np.arange(round(end / length)) * length
    top, bottom = Extremes.of(len(signals), 1), Extremes.of(len(signals), -1)
    for first in range(0, len(starts), chunk):
        here = starts[first : first + chunk]
        watch = np.stack([signal(times(here, length)) for signal in signals], axis=2)
        lengths = np.full(len(here), length)
        top.see(here, lengths, watch)
        bottom.see(here, lengths, watch)
    top.settle()
    bottom.settle()
    return top, bottom


class TestPeaks:
    @pytest.mark.parametrize("phase", np.linspace(0.0, 3.0, 13))
    def test_of_a_decaying_vibration(self, phase: float) -> None:
        """x = e^-zt cos(wt - phase) has its summits at tan(wt - phase) = -z/w."""
        z, w = 0.05, 3.0
        top, bottom = seen([lambda t: np.exp(-z * t) * np.cos(w * t - phase)], 8.0, 0.25)
        turn = phase - math.atan(z / w)
        summits = [(turn + k * math.pi) / w for k in range(-1, 9)]
        values = [math.exp(-z * t) * math.cos(w * t - phase) for t in (0.0, 8.0, *(s for s in summits if 0 < s < 8))]
        assert top.values[0] == pytest.approx(max(values), rel=1e-11)
        assert bottom.values[0] == pytest.approx(min(values), rel=1e-11)

    def test_time_of_the_peak(self) -> None:
        top, _ = seen([lambda t: np.exp(-0.1 * t) * np.sin(t)], 6.25, 0.25)
        assert top.at[0] == pytest.approx(math.atan(10.0), abs=1e-6)

    def test_many_signals_each_with_its_own_peak(self) -> None:
        places = np.linspace(0.01, 9.99, 60)
        signals = [lambda t, p=place: 2.0 + np.cos(t - p) for place in places]
        top, bottom = seen(signals, 10.0, 0.5)
        assert top.values == pytest.approx(np.full(60, 3.0), abs=1e-10)
        exact = [
            min(2 + np.cos(np.array([-p, 10 - p])).min(), 1.0 if p > math.pi or p < 10 - math.pi else 9.0)
            for p in places
        ]
        assert bottom.values == pytest.approx(exact, abs=1e-10)

    def test_at_both_ends(self) -> None:
        top, bottom = seen([lambda t: np.exp(t), lambda t: -t], 2.0, 0.5)
        assert top.values == pytest.approx([math.exp(2.0), 0.0])
        assert bottom.values == pytest.approx([1.0, -2.0])
        assert (top.at.tolist(), bottom.at.tolist()) == ([2.0, 0.0], [0.0, 2.0])

    def test_of_a_constant_and_of_nothing(self) -> None:
        top, bottom = seen([lambda t: 0 * t, lambda t: 0 * t + 7.5], 1.0, 0.25)
        assert top.values.tolist() == bottom.values.tolist() == [0.0, 7.5]

    @pytest.mark.parametrize("size", [1e-200, 1e-9, 1.0, 1e12, 1e200])
    def test_of_any_size(self, size: float) -> None:
        top, _ = seen([lambda t: size * (1 + 1e-3 * np.sin(t))], 5.0, 0.5)
        assert top.values[0] == pytest.approx(size * 1.001, rel=1e-12)

    def test_of_long_and_short_panels_mixed(self) -> None:
        """A short panel with the highest node does not hide the summit of a long one."""
        top = Extremes.of(1, 1)
        starts, lengths = np.array([0.0, 1.0, 1.001]), np.array([1.0, 0.001, 0.999])
        top.see(starts, lengths, np.sin(starts[:, None] + lengths[:, None] * panels.NODES)[:, :, None])
        top.settle()
        assert top.values[0] == pytest.approx(1.0, abs=1e-11)

    @pytest.mark.parametrize("seed", range(20))
    def test_of_random_polynomials_on_one_panel(self, seed: int) -> None:
        """Of every shape that a panel short enough for its frequencies can show."""
        rng = np.random.default_rng(seed)
        p = np.polynomial.Chebyshev(rng.normal(size=9) * 0.3 ** np.arange(9), domain=[0, 1])
        top, bottom = seen([p], 1.0, 1.0)
        turns = [x.real for x in p.deriv().roots() if abs(x.imag) < 1e-12 and 0 < x.real < 1]
        exact = p(np.array([0.0, 1.0, *turns]))
        size = np.abs(exact).max()
        assert (top.values[0], bottom.values[0]) == pytest.approx((exact.max(), exact.min()), abs=1e-12 * size)
