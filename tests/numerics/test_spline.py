"""The closed spline against scipy's, and against what a spline is."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from ptmcalc.numerics import spline

PERIOD = 2 * np.pi
EVERYWHERE = np.linspace(-9.0, 16.0, 501)


def points(seed: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    n = int(rng.integers(3, 40))
    places = np.sort(rng.uniform(0, PERIOD, n)) + rng.uniform(-3, 3)
    while np.min(np.diff(places)) < 1e-3:
        places = np.sort(rng.uniform(0, PERIOD, n))
    return places, rng.normal(size=n)


@pytest.mark.parametrize("seed", range(8))
class TestClosedCurve:
    def test_it_is_the_periodic_spline(self, seed: int) -> None:
        x, y = points(seed)
        ours = spline.through(x, y, PERIOD)
        other = CubicSpline(np.append(x, x[0] + PERIOD), np.append(y, y[0]), bc_type="periodic")
        value, slope = ours(EVERYWHERE)
        scale = np.abs(other(EVERYWHERE)).max()
        assert value == pytest.approx(other(EVERYWHERE), abs=1e-9 * scale)
        assert slope == pytest.approx(other(EVERYWHERE, 1), abs=1e-8 * np.abs(other(EVERYWHERE, 1)).max())

    def test_it_goes_through_its_points_and_repeats(self, seed: int) -> None:
        x, y = points(seed)
        curve = spline.through(x, y, PERIOD)
        for turns in (-2, 0, 5):
            assert curve(x + turns * PERIOD)[0] == pytest.approx(y, abs=1e-9)

    def test_its_range_is_that_of_many_samples(self, seed: int) -> None:
        x, y = points(seed)
        curve = spline.through(x, y, PERIOD)
        values = curve(np.linspace(0, PERIOD, 20001))[0]
        low, high = curve.range
        spread = high - low
        assert low <= values.min() <= low + 1e-3 * spread
        assert high >= values.max() >= high - 1e-3 * spread

    def test_its_range_is_the_same_in_any_unit_of_the_place(self, seed: int) -> None:
        x, y = points(seed)
        curve = spline.through(x, y, PERIOD)
        for unit in (1e-6, 1e6):
            assert spline.through(unit * x, y, unit * PERIOD).range == pytest.approx(curve.range, rel=1e-9)

    def test_the_slope_integrates_to_nothing_over_a_period(self, seed: int) -> None:
        """Two tables for J and J' would not: energy would be lost or won in every cycle."""
        x, y = points(seed)
        curve = spline.through(x, y, PERIOD)
        nodes, weights = np.polynomial.legendre.leggauss(4)
        low, width = curve.knots[:-1, None], np.diff(curve.knots)[:, None]
        total = np.sum(curve(low + width * (nodes + 1) / 2)[1] * width * weights / 2)
        assert total == pytest.approx(0.0, abs=1e-10 * np.abs(curve.coefficients[1]).max())


def test_a_smooth_function_is_met_to_fourth_order() -> None:
    errors = []
    for n in (16, 32, 64):
        x = np.linspace(0, PERIOD, n, endpoint=False)
        errors.append(
            np.abs(spline.through(x, np.exp(np.sin(x)), PERIOD)(EVERYWHERE)[0] - np.exp(np.sin(EVERYWHERE))).max()
        )
    assert np.log2(np.array(errors[:-1]) / errors[1:]) == pytest.approx([4.0, 4.0], abs=0.4)


def test_equal_values_give_a_constant() -> None:
    value, slope = spline.through([0.0, 1.0, 4.0], [7.0, 7.0, 7.0], PERIOD)(EVERYWHERE)
    assert value == pytest.approx(7.0, rel=1e-15)
    assert np.abs(slope).max() < 1e-14
    assert spline.through([0.0, 1.0, 4.0], [7.0, 7.0, 7.0], PERIOD).range == pytest.approx((7.0, 7.0))
