"""Factors of the standards against their printed values and against what a drive really does."""

import math

import pytest

from ptmcalc.laws import shock, standard_factors


def test_own_mass() -> None:
    assert standard_factors.hoisting_factors(0.1) == pytest.approx((0.9, 1.1), rel=1e-15)
    assert standard_factors.hoisting_factors(0.0) == (1.0, 1.0)


@pytest.mark.parametrize("spread", [-1e-9, 0.1004, math.inf, math.nan])
def test_own_mass_spreads_by_a_tenth_at_most(spread: float) -> None:
    with pytest.raises(ValueError, match="by 0 to"):
        standard_factors.hoisting_factors(spread)


class TestDrive:
    @pytest.mark.parametrize(
        ("change", "factors"), [("centrifugal", (1.0, 1.0)), ("smooth", (1.0, 1.5)), ("sudden", (1.5, 2.0))]
    )
    def test_by_change(self, change: str, factors: tuple[float, float]) -> None:
        assert standard_factors.drive_factor(change, False) == factors
        assert standard_factors.drive_factor(change, True) == (factors if change == "centrifugal" else (3.0, 3.0))

    def test_by_control_grows_with_steps_and_backlash(self) -> None:
        names = list(standard_factors.DRIVE_CONTROLS)
        tight, loose = (
            [standard_factors.drive_factor(name, much, standard_factors.BY_CONTROL)[0] for name in names]
            for much in (False, True)
        )
        assert tight == sorted(tight) == [1.2, 1.6, 1.8, 2.0]
        assert loose == sorted(loose) == [1.5, 2.0, 2.2, 2.4]

    def test_one_undamped_mode_stays_below_the_range_of_a_sudden_change(self) -> None:
        """A step gives 2, a rise over a whole period 1: the ends of the standard's ranges."""
        assert standard_factors.drive_factor("sudden", False)[1] == shock.step_factor(0.0)
        assert standard_factors.drive_factor("smooth", False)[0] == pytest.approx(float(shock.ramp_factor(1.0)))
        slow = max(float(shock.ramp_factor(rise / 100)) for rise in range(61, 400))
        assert slow <= standard_factors.drive_factor("smooth", False)[1]


def test_test_loads() -> None:
    """A load test at 1.1 with phi_2 = 1.4 loads the crane by 1.32, the static one by 1.25."""
    dynamic, static = standard_factors.load_test_factors(1.4)
    tests = standard_factors.TEST_LOADS["en_13001_2"]
    assert (dynamic * tests[0], static * tests[1]) == pytest.approx((1.32, 1.25))
    assert math.isclose(standard_factors.load_test_factors(1.0)[0], 1.0)
