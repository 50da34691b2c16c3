"""Grip of a drum against the equilibrium of the belt element, integrated numerically.

Reference: dS/dphi = mu (S - rho v^2), the balance of a belt element that is about to slip, by an ODE solver. A drum
that is not at its limit slips over part of its wrap only; the rest of the arc is what it has in reserve.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from ptmcalc.laws import capstan

steady = settings(derandomize=True, database=None, deadline=None, max_examples=150)
tensions = st.floats(1.0, 1e6)
exponents = st.floats(0.01, 12.0)


def around(slack: float, friction: float, wrap: float, lift: float) -> float:
    """Tension at the end of an arc over which the belt slips."""
    if wrap == 0:
        return slack
    arc = solve_ivp(
        lambda phi, s: friction * (s - lift), (0.0, wrap), [slack], method="DOP853", rtol=1e-12, atol=1e-9 * slack
    )
    return float(arc.y[0, -1])


def slipping_arc(tight: float, slack: float, friction: float, lift: float, longest: float) -> float:
    """Wrap that is needed to raise the slack tension to the tight one."""
    return brentq(lambda wrap: around(slack, friction, wrap, lift) - tight, 0.0, longest, xtol=1e-12)


CASES = [(30e3, 0.35, 3.4, 0.0), (30e3, 0.2, 3.67, 900.0), (5e3, 0.05, 7.2, 4900.0), (1.0, 0.6, 2 * math.pi, 0.3)]


class TestUtilisation:
    @pytest.mark.parametrize(("slack", "friction", "wrap", "lift"), CASES)
    def test_is_one_where_the_whole_wrap_slips(self, slack: float, friction: float, wrap: float, lift: float) -> None:
        tight = around(slack, friction, wrap, lift)
        assert capstan.slip_utilisation(tight, slack, lift, friction * wrap) == pytest.approx(1.0, rel=1e-9)

    @pytest.mark.parametrize(("slack", "friction", "wrap", "lift"), CASES)
    @pytest.mark.parametrize("share", [0.1, 0.5, 0.9])
    def test_is_the_grip_of_the_arc_that_is_left(
        self, slack: float, friction: float, wrap: float, lift: float, share: float
    ) -> None:
        tight = slack + share * (around(slack, friction, wrap, lift) - slack)
        arc = slipping_arc(tight, slack, friction, lift, wrap)
        left = around(1.0, friction, wrap - arc, 0.0)  # factor by which the unused arc could still raise the tension
        assert capstan.slip_utilisation(tight, slack, lift, friction * wrap) == pytest.approx(1 / left, rel=1e-8)

    @pytest.mark.parametrize(
        ("friction", "turns", "printed"),
        [(0.1, 1, 1.9), (0.1, 5, 23), (0.2, 3, 43), (0.3, 1, 6.6), (0.3, 3, 286), (0.3, 5, 12392), (0.5, 2, 535)],
    )
    def test_printed_table_of_the_capstan_equation(self, friction: float, turns: int, printed: float) -> None:
        """Force ratio over whole turns as handbooks print it; half a unit of the last printed digit."""
        used = capstan.slip_utilisation(printed, 1.0, 0.0, friction * turns * 2 * math.pi)
        assert used == pytest.approx(1.0, abs=0.05 / printed if printed < 10 else 0.5 / printed)

    @given(tensions, tensions, exponents)
    @steady
    def test_the_two_senses_of_a_drum_share_its_grip(self, one: float, other: float, exponent: float) -> None:
        """Braking swaps the sides: the two utilisations differ by the square of the tension ratio, and only the sense
        that holds the tighter side back can slip."""
        driving = float(capstan.slip_utilisation(one, other, 0.0, exponent))
        braking = float(capstan.slip_utilisation(other, one, 0.0, exponent))
        assert driving * braking == pytest.approx(math.exp(-2 * exponent), rel=1e-9)
        assert min(driving, braking) < 1

    def test_braking_from_the_other_side_integrates_to_the_same_limit(self) -> None:
        """The arc seen from the tight side: tension falls along it, and the limit is the same."""
        slack, friction, wrap, lift = 20e3, 0.3, 3.5, 700.0
        tight = around(slack, friction, wrap, lift)
        back = solve_ivp(lambda phi, s: -friction * (s - lift), (0, wrap), [tight], rtol=1e-11, atol=1e-6).y[0, -1]
        assert back == pytest.approx(slack, rel=1e-8)
        assert capstan.slip_utilisation(tight, back, lift, friction * wrap) == pytest.approx(1.0, rel=1e-7)

    @given(tensions, st.floats(0.0, 0.99), st.floats(1.0, 5.0), exponents, st.floats(1.001, 2.0))
    @steady
    def test_grows_with_pull_and_speed_and_falls_with_slack_and_wrap(
        self, slack: float, lift_share: float, ratio: float, exponent: float, more: float
    ) -> None:
        tight, lift = ratio * slack, lift_share * slack
        used = capstan.slip_utilisation(tight, slack, lift, exponent)
        assert capstan.slip_utilisation(more * tight, slack, lift, exponent) > used
        assert capstan.slip_utilisation(tight, more * slack, lift, exponent) <= used * (1 + 1e-12)
        assert capstan.slip_utilisation(tight, slack, lift, exponent * more) < used
        faster = min(lift * more, 0.5 * (lift + slack))
        assert capstan.slip_utilisation(tight, slack, faster, exponent) >= used * (1 - 1e-12)

    @pytest.mark.parametrize("slack", [900.0, 899.0, 0.0, -1.0])
    def test_is_infinite_where_the_slack_side_is_only_thrown_outwards(self, slack: float) -> None:
        assert capstan.slip_utilisation(1000.0, slack, 900.0, 1.0) == math.inf

    def test_without_friction_any_difference_slips(self) -> None:
        assert capstan.slip_utilisation(100.0, 100.0, 10.0, 0.0) == 1.0
        assert capstan.slip_utilisation(101.0, 100.0, 10.0, 0.0) > 1.0


class TestReserve:
    @pytest.mark.parametrize(("slack", "friction", "wrap"), [case[:3] for case in CASES])
    @pytest.mark.parametrize("share", [0.05, 0.4, 1.0, 1.7])
    def test_is_what_the_wrap_can_transmit_over_what_it_must(
        self, slack: float, friction: float, wrap: float, share: float
    ) -> None:
        most = around(slack, friction, wrap, 0.0) - slack
        reserve = capstan.slip_reserve_force(slack + share * most, slack, friction * wrap)
        assert reserve == pytest.approx(1 / share, rel=1e-9)

    @pytest.mark.parametrize(("slack", "friction", "wrap", "lift"), CASES)
    def test_a_belt_slips_at_the_reserve_its_range_names(
        self, slack: float, friction: float, wrap: float, lift: float
    ) -> None:
        """With centrifugal tension U reaches 1 at k = S_s/(S_s - rho v^2), at 1 only for a slow belt."""
        tight = around(slack, friction, wrap, lift)
        reserve = capstan.slip_reserve_force(tight, slack, friction * wrap)
        assert reserve == pytest.approx(slack / (slack - lift), rel=1e-8)

    @given(tensions, tensions, exponents)
    @steady
    def test_is_above_one_exactly_where_a_slow_belt_holds(self, one: float, other: float, exponent: float) -> None:
        tight, slack = max(one, other), min(one, other)
        used = float(capstan.slip_utilisation(tight, slack, 0.0, exponent))
        reserve = float(capstan.slip_reserve_force(tight, slack, exponent))
        if abs(used - 1) > 1e-9:
            assert (reserve > 1) == (used < 1)

    @given(tensions, st.floats(1.001, 50.0), exponents, st.floats(1.001, 3.0))
    @steady
    def test_grows_with_slack_and_wrap_and_falls_with_pull(
        self, slack: float, ratio: float, exponent: float, more: float
    ) -> None:
        tight = ratio * slack
        reserve = capstan.slip_reserve_force(tight, slack, exponent)
        assert capstan.slip_reserve_force(tight * more, slack, exponent) < reserve
        assert capstan.slip_reserve_force(tight, slack * more, exponent) > reserve
        assert capstan.slip_reserve_force(tight, slack, exponent * more) > reserve

    @pytest.mark.parametrize(
        ("tight", "slack", "meant"),
        [(5.0, 5.0, math.inf), (4.0, 5.0, math.inf), (5.0, 0.0, 0.0), (5.0, -1.0, 0.0)],
    )
    def test_ends(self, tight: float, slack: float, meant: float) -> None:
        """Nothing transmitted: no limit to the reserve. No slack tension left: no reserve."""
        assert capstan.slip_reserve_force(tight, slack, 1.2) == meant

    def test_without_friction_there_is_none(self) -> None:
        assert capstan.slip_reserve_force(2.0, 1.0, 0.0) == 0.0


class TestReserveOfARatio:
    @given(tensions, st.floats(1.001, 50.0), exponents)
    @steady
    def test_needs_the_ratio_of_the_tensions_only(self, slack: float, ratio: float, exponent: float) -> None:
        """Hand value for S_s = 1: (e^x - 1)/(S_t/S_s - 1)."""
        reserve = capstan.slip_reserve_ratio(ratio * math.exp(-exponent), exponent)
        assert reserve == pytest.approx((math.exp(exponent) - 1) / (ratio - 1), rel=1e-7)
        assert reserve == pytest.approx(float(capstan.slip_reserve_force(ratio * slack, slack, exponent)), rel=1e-7)

    @given(st.floats(1e-3, 1e3), exponents)
    @steady
    def test_the_inverse_gives_the_ratio_with_that_reserve(self, reserve: float, exponent: float) -> None:
        found = brentq(
            lambda ratio: (1 - math.exp(-exponent)) - reserve * (ratio - math.exp(-exponent)), 0, 1e4, xtol=1e-13
        )
        ratio = capstan.slip_ratio(reserve, exponent)
        assert ratio == pytest.approx(found, rel=1e-8, abs=1e-11)
        assert ratio >= math.exp(-exponent)

    def test_both_read_one_at_the_limit_of_slip(self) -> None:
        assert capstan.slip_reserve_ratio(1.0, 1.3) == pytest.approx(1.0, rel=1e-14)
        assert capstan.slip_ratio(1.0, 1.3) == pytest.approx(1.0, rel=1e-14)

    def test_ends(self) -> None:
        """A ratio below exp(-mu alpha) is a drum loaded the other way, where this sense transmits nothing."""
        assert capstan.slip_reserve_ratio(math.inf, 1.0) == 0.0
        assert capstan.slip_reserve_ratio(0.9 * math.exp(-1.0), 1.0) == math.inf
        assert capstan.slip_ratio(0.0, 1.0) == math.inf
        assert capstan.slip_ratio(math.inf, 1.0) == pytest.approx(math.exp(-1.0), rel=1e-15)


def test_states_of_a_whole_history_are_judged_one_by_one() -> None:
    tight, slack = np.array([5.0, 2.0, 4.0]), np.array([1.0, 2.0, 0.1])
    used = capstan.slip_utilisation(tight, slack, 0.2, 1.0)
    by_hand = [(5 - 0.2) / (0.8 * math.e), (2 - 0.2) / (1.8 * math.e), math.inf]
    assert used == pytest.approx(by_hand, rel=1e-14)
