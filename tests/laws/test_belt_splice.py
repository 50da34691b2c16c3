"""Strength of a spliced belt against hand calculations."""

import math

import pytest

from ptmcalc.laws import belt_splice


class TestSplice:
    def test_steel_cord_belt_by_hand(self) -> None:
        """ST 2000 with k_t,rel = 0.45 at 400 N/mm: 900/(400 1.1 1.7) = 900/748."""
        s_0, s_1 = belt_splice.SPLICE_CONDITIONS["normal"], belt_splice.BELT_LIFE["normal"]
        assert belt_splice.splice_reserve(2e6, 0.45, 400e3, s_0, s_1) == pytest.approx(900 / 748, rel=1e-12)

    def test_required_strength_has_no_reserve(self) -> None:
        """k_N = k_max S_0 S_1/k_t,rel: 100 kN/m, poor conditions and long life, textile 0.32: 712.5 kN/m."""
        assert belt_splice.splice_reserve(712.5e3, 0.32, 100e3, 1.2, 1.9) == pytest.approx(1.0, rel=1e-12)

    def test_a_normal_steel_cord_splice_requires_a_smaller_factor_than_the_edition_of_1982(self) -> None:
        """1.1 1.7/0.45 = 4.16 without edge addition; the 6.7 of 1982 includes it."""
        factor = 1 / float(belt_splice.splice_reserve(1.0, 0.45, 1.0, 1.1, 1.7))
        assert factor == pytest.approx(1.87 / 0.45)
        assert factor < 6.7

    def test_a_belt_without_tension_does_not_break(self) -> None:
        assert belt_splice.splice_reserve(2e6, 0.45, 0.0, 1.1, 1.7) == math.inf
        assert belt_splice.splice_reserve(2e6, 0.45, -1.0, 1.1, 1.7) == math.inf
