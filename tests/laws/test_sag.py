"""Sag of a belt span against the catenary, and the stiffness of a sagging span against its arc length.

Reference methods: the exact catenary of weight w per metre of belt, solved for its horizontal tension; the length of
belt in the span, differentiated numerically.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad, solve_bvp
from scipy.optimize import brentq

from ptmcalc.laws import sag

steady = settings(derandomize=True, database=None, deadline=None, max_examples=150)
SPAN, LINE_WEIGHT = 1.2, 2256.3
WEIGHT = SPAN * LINE_WEIGHT


def catenary_tension(ratio: float) -> float:
    """Horizontal tension of the catenary that sags by this share of its span."""

    def miss(tension: float) -> float:
        return tension / LINE_WEIGHT * (math.cosh(LINE_WEIGHT * SPAN / (2 * tension)) - 1) - ratio * SPAN

    return brentq(miss, WEIGHT / (8 * ratio) / 2, WEIGHT / (8 * ratio) * 2, xtol=1e-9, rtol=1e-15)


class TestSagRatio:
    @pytest.mark.parametrize("ratio", [0.001, 0.005, 0.01, 0.02, 0.05, 0.1])
    def test_is_as_far_from_the_catenary_as_its_error_says(self, ratio: float) -> None:
        error = float(sag.sag_ratio(WEIGHT, catenary_tension(ratio))) / ratio - 1
        assert abs(error) <= 8 / 3 * ratio**2
        assert error < 0  # the catenary hangs lower than the parabola: the formula is on the low side

    def test_is_the_deflection_of_a_string(self) -> None:
        """S y'' = w by collocation, with the load on the chord: the shallow parabola exactly."""
        tension = 40e3
        x = np.linspace(0, SPAN, 5)
        string = solve_bvp(
            lambda x, y: np.vstack([y[1], np.full_like(x, LINE_WEIGHT / tension)]),
            lambda a, b: np.array([a[0], b[0]]),
            x,
            np.zeros((2, 5)),
        )
        assert sag.sag_ratio(WEIGHT, tension) == pytest.approx(-string.sol(SPAN / 2)[0] / SPAN, rel=1e-10)

    @given(st.floats(1.0, 1e4), st.floats(1.0, 1e6), st.floats(1.001, 10.0))
    @steady
    def test_grows_with_weight_and_falls_with_tension(self, weight: float, tension: float, more: float) -> None:
        ratio = sag.sag_ratio(weight, tension)
        assert sag.sag_ratio(weight * more, tension) > ratio > sag.sag_ratio(weight, tension * more)

    @pytest.mark.parametrize("tension", [0.0, -0.0, -50.0])
    def test_is_infinite_without_tension(self, tension: float) -> None:
        assert sag.sag_ratio(WEIGHT, tension) == math.inf

    def test_usual_limits(self) -> None:
        """1 % of sag needs 12.5 times the weight of a span, 2 % needs 6.25 times (rule of the handbooks)."""
        assert sag.sag_ratio(1.0, 12.5) == pytest.approx(0.01, rel=1e-14)
        assert sag.sag_ratio(1.0, 6.25) == pytest.approx(0.02, rel=1e-14)


class TestTensionAtSag:
    @given(st.floats(1e-3, 1e5), st.floats(1e-4, 0.1))
    @steady
    def test_is_the_tension_that_sags_so_much(self, weight: float, ratio: float) -> None:
        solved = brentq(lambda log: float(sag.sag_ratio(weight, math.exp(log))) - ratio, -30, 30, xtol=1e-13)
        assert sag.tension_at_sag(weight, ratio) == pytest.approx(math.exp(solved), rel=1e-9)

    @pytest.mark.parametrize("ratio", [0.005, 0.01, 0.02])
    def test_of_the_catenary(self, ratio: float) -> None:
        assert sag.tension_at_sag(WEIGHT, ratio) == pytest.approx(catenary_tension(ratio), rel=8 / 3 * ratio**2)


class TestSoftening:
    STIFFNESS = 1.38e8

    def belt_in_span(self, tension: float) -> float:
        """Unstretched belt between two idlers: every bit of the catenary's arc shortened by its own strain."""
        hang = tension / LINE_WEIGHT

        def bit(x: float) -> float:
            slope = math.cosh((x - SPAN / 2) / hang)
            return slope / (1 + tension * slope / self.STIFFNESS)

        return quad(bit, 0, SPAN, epsabs=0, epsrel=1e-13)[0]

    @pytest.mark.parametrize("ratio", [0.0005, 0.002, 0.01, 0.02])
    def test_is_the_belt_that_a_rise_of_tension_draws_out_of_the_span(self, ratio: float) -> None:
        """Both idlers stand still; per unit of tension the belt gives (1 + f)/EA of the span."""
        tension = WEIGHT / (8 * ratio)
        h = 2e-3 * tension
        points = [self.belt_in_span(tension + k * h) for k in (-2, -1, 1, 2)]
        slope = (points[0] - 8 * points[1] + 8 * points[2] - points[3]) / (12 * h)  # fourth order
        given_way = -slope / SPAN * self.STIFFNESS
        assert 1 + sag.softening(self.STIFFNESS, WEIGHT, tension) == pytest.approx(
            given_way, rel=12 * ratio**2 + 3 * tension / self.STIFFNESS
        )

    def test_of_the_parabola_by_quadrature(self) -> None:
        """Arc length less chord is the integral of half the slope squared; its derivative by central differences."""

        def excess(tension: float) -> float:
            slope = LINE_WEIGHT / tension
            return quad(lambda x: (slope * (x - SPAN / 2)) ** 2 / 2, 0, SPAN)[0]

        tension, h = 50e3, 5.0
        slack = -(excess(tension + h) - excess(tension - h)) / (2 * h) * self.STIFFNESS / SPAN
        assert sag.softening(self.STIFFNESS, WEIGHT, tension) == pytest.approx(slack, rel=1e-7)

    @given(st.floats(1e5, 1e9), st.floats(1.0, 1e4), st.floats(1e3, 1e6), st.floats(1.01, 4.0))
    @steady
    def test_powers(self, stiffness: float, weight: float, tension: float, more: float) -> None:
        f = float(sag.softening(stiffness, weight, tension))
        assert sag.softening(more * stiffness, weight, tension) == pytest.approx(more * f, rel=1e-12)
        assert sag.softening(stiffness, more * weight, tension) == pytest.approx(more**2 * f, rel=1e-12)
        assert sag.softening(stiffness, weight, more * tension) == pytest.approx(f / more**3, rel=1e-12)

    @pytest.mark.parametrize("tension", [0.0, -1.0])
    def test_is_infinite_without_tension(self, tension: float) -> None:
        assert sag.softening(self.STIFFNESS, WEIGHT, tension) == math.inf


def test_slack_sections_of_a_strand_are_infinite_and_the_others_are_not() -> None:
    tension = np.array([-1.0, 0.0, 100.0])
    assert np.isinf(sag.sag_ratio(80.0, tension)).tolist() == [True, True, False]
    assert sag.sag_ratio(80.0, tension)[2] == pytest.approx(0.1, rel=1e-14)
    assert np.isinf(sag.softening(1e6, 80.0, tension)).tolist() == [True, True, False]


def test_the_parabola_ends_where_its_sag_is_a_percent_off() -> None:
    """At a tenth of the span the catenary of the same tension in the middle, (cosh(4 s) - 1)/(8 s), sags 1.3 % more."""
    deepest = sag.DEEPEST
    catenary = (math.cosh(4 * deepest) - 1) / (8 * deepest)
    assert catenary / deepest == pytest.approx(1.0134, abs=1e-4)
