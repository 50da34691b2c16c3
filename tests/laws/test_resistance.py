"""Resistance of the idlers against a sum over the idlers, and the length factor against the printed table."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ptmcalc.laws import resistance

steady = settings(derandomize=True, database=None, deadline=None, max_examples=150)

PRINTED = [
    (80, 1.92), (100, 1.78), (150, 1.58), (200, 1.45), (300, 1.31), (400, 1.25), (500, 1.20), (600, 1.17), (700, 1.14),
    (800, 1.12), (900, 1.10), (1000, 1.09), (1500, 1.06), (2000, 1.05),
]  # fmt: skip
"""Length coefficient of DIN 22101 and ISO 5048 over the centre distance in metres, as handbooks print it."""


class TestMainResistance:
    def test_idler_by_idler(self) -> None:
        """Every idler carries the belt and load of its pitch, pressed on by the part of the weight square to the
        strand, and its own rolls, whatever the slope; friction takes its share of what the bearings carry."""
        friction, gravity, pitch, stations = 0.02, 9.81, 1.25, 640
        belt, load, roll, slope = 14.5, 171.0, 22.4, math.radians(11)
        pull = 0.0
        for _ in range(stations):
            pull += friction * ((belt + load) * pitch * gravity * math.cos(slope) + roll * gravity)
        per_length = resistance.main_resistance_per_length(
            friction, gravity, belt + load, roll / pitch, math.cos(slope)
        )
        assert per_length * pitch * stations == pytest.approx(pull, rel=1e-12)

    def test_both_strands_add_up_to_the_standard(self) -> None:
        """F_H = f L g (q_RO + q_RU + (2 q_B + q_G) cos delta), ISO 5048."""
        f, length, g = 0.022, 850.0, 9.81
        rolls_carry, rolls_return, belt, load, cosine = 18.2, 6.7, 21.0, 155.0, math.cos(math.radians(4.0))
        carry = resistance.main_resistance_per_length(f, g, belt + load, rolls_carry, cosine)
        back = resistance.main_resistance_per_length(f, g, belt, rolls_return, cosine)
        standard = f * length * g * (rolls_carry + rolls_return + (2 * belt + load) * cosine)
        assert (carry + back) * length == pytest.approx(standard, rel=1e-13)

    def test_work_over_a_curved_profile_depends_on_the_horizontal_way_only(self) -> None:
        """The part of belt and load: sum of q cos(delta) ds along any profile is q times its horizontal length."""
        x = np.linspace(0, 400, 4001)
        height = 12 * np.sin(x / 70) + 0.02 * x
        bit = np.hypot(np.diff(x), np.diff(height))
        cosine = np.diff(x) / bit
        pull = sum(
            resistance.main_resistance_per_length(0.02, 9.81, 180.0, 0.0, c) * ds
            for c, ds in zip(cosine.tolist(), bit.tolist(), strict=True)
        )
        assert pull == pytest.approx(0.02 * 9.81 * 180.0 * 400, rel=1e-12)

    def test_level_cosine_is_on_the_safe_side_below_18_degrees(self) -> None:
        """What the range allows: cos = 1 adds at most 5.2 %."""
        steep = resistance.main_resistance_per_length(0.02, 9.81, 180.0, 0.0, math.cos(math.radians(18)))
        level = resistance.main_resistance_per_length(0.02, 9.81, 180.0, 0.0, 1.0)
        assert 0 < level / steep - 1 < 0.052


class TestLengthFactor:
    @pytest.mark.parametrize(("length", "printed"), PRINTED)
    def test_printed_points(self, length: float, printed: float) -> None:
        assert resistance.length_factor(length) == pytest.approx(printed, rel=1e-14)

    @pytest.mark.parametrize(("left", "right"), list(pairwise(PRINTED)))
    def test_straight_over_the_logarithm_between_them(self, left: tuple[int, float], right: tuple[int, float]) -> None:
        """At the geometric mean of two lengths stands the arithmetic mean of their factors."""
        (short, more), (long, less) = left, right
        assert resistance.length_factor(math.sqrt(short * long)) == pytest.approx((more + less) / 2, rel=1e-13)
        third = short * (long / short) ** (1 / 3)
        assert resistance.length_factor(third) == pytest.approx((2 * more + less) / 3, rel=1e-13)

    @pytest.mark.parametrize(("left", "right"), list(pairwise(PRINTED)))
    def test_straight_over_the_length_differs_less_than_the_stated_interval(
        self, left: tuple[int, float], right: tuple[int, float]
    ) -> None:
        """A handbook that interpolates over L itself reads at most a quarter of C - 1 more, never less."""
        for length in np.linspace(left[0], right[0], 9)[1:-1]:
            linear = np.interp(length, [left[0], right[0]], [left[1], right[1]])
            ours = resistance.length_factor(float(length))
            assert 0 < linear - ours < 0.25 * (ours - 1)

    def test_stands_for_secondary_resistances_that_hardly_grow_with_length(self) -> None:
        """(C - 1) L is what the secondary resistances are worth in metres of belt: 70 to 110 m over the table."""
        for length, _ in PRINTED:
            assert 70 <= (resistance.length_factor(length) - 1) * length <= 110

    @given(st.floats(80, 1e5), st.floats(1.0, 10.0))
    @steady
    def test_never_rises_and_never_leaves_the_table(self, length: float, more: float) -> None:
        factor = resistance.length_factor(length)
        assert 1.05 <= resistance.length_factor(length * more) <= factor <= 1.92

    @pytest.mark.parametrize("length", [2000.0, 2500.0, 1e5, math.inf])
    def test_stays_at_its_last_value(self, length: float) -> None:
        assert resistance.length_factor(length) == 1.05

    @pytest.mark.parametrize("length", [79.999, 10.0, 0.0, -100.0])
    def test_refuses_what_the_table_does_not_hold(self, length: float) -> None:
        assert length < resistance.SHORTEST_FOR_LENGTH_FACTOR
        with pytest.raises(ValueError, match="80 m"):
            resistance.length_factor(length)
