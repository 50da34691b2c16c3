"""Rolls of idlers against hand calculations."""

import math

import pytest

from ptmcalc.laws import idler_roll


class TestRoll:
    def test_speed_by_hand(self) -> None:
        """133 mm at 4.18 m/s: a circumference of 0.41783 m, 10.004 turns a second, 600 rpm."""
        omega = float(idler_roll.roll_speed(4.18, 0.133))
        assert omega * 60 / (2 * math.pi) == pytest.approx(4.18 / 0.417832 * 60, rel=1e-5)

    def test_load_by_hand(self) -> None:
        """0.7 of 1.2 1500 N and of 400 N in the curve, and 60 N: 0.7 2200 + 60 = 1600 N."""
        assert idler_roll.roll_load(0.7, 1500.0, 1.2, 400.0, 60.0) == pytest.approx(1600.0)

    def test_life_by_hand(self) -> None:
        """C/P = 10: 1e9 turns; at 600 rpm 1e9/36000 h = 27778 h, the life that catalogues tabulate for that ratio."""
        hours = float(idler_roll.bearing_life(20e3, 4e3, 600 * 2 * math.pi / 60)) / 3600
        assert hours == pytest.approx(27778, rel=1e-4)

    def test_life_falls_with_the_cube_of_the_load(self) -> None:
        lives = [float(idler_roll.bearing_life(20e3, load, 60.0)) for load in (1e3, 2e3)]
        assert lives[0] / lives[1] == pytest.approx(8.0)
