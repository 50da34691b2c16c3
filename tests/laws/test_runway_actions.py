"""Actions on the runway: damage factors by their rule, and K by the slip of single wheels."""

import numpy as np
import pytest

from ptmcalc.laws import runway_actions


def test_damage_factors_follow_from_the_spectrum_classes() -> None:
    """Classes of EN 13001-1 differ by a factor of 2 in damage: lambda = 2^((k - 7)/m), to three decimals, some of
    them rounded up (0.43528 is 0.436)."""
    for name, factors in runway_actions.DAMAGE_FACTORS.items():
        for slope, factor in zip((3, 5), factors, strict=True):
            assert -5e-4 <= factor - 2 ** ((int(name[1]) - 7) / slope) < 1e-3


def test_a_drive_force_is_what_its_wheels_hold() -> None:
    loads = np.array([22.665e3, 22.665e3])
    assert runway_actions.drive_force(0.2, loads) == pytest.approx(sum(0.2 * load for load in loads))


def test_a_fatigue_load_between_the_factors() -> None:
    """Without hoist load the factor is that of the crane, without crane that of the hoist load."""
    assert runway_actions.fatigue_wheel_load(3e4, 0.0, 1.1, 1.2, 0.5) == pytest.approx(0.5 * 1.05 * 3e4)
    assert runway_actions.fatigue_wheel_load(0.0, 3e4, 1.1, 1.2, 0.5) == pytest.approx(0.5 * 1.1 * 3e4)
