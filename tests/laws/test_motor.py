"""Torque of a start and its force at the rim against work and power."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from ptmcalc.laws import motor

steady = settings(derandomize=True, database=None, deadline=None, max_examples=150)


def sawtooth(largest: float, smallest: float, steps: int, speed: float) -> float:
    """Torque of a rheostat start of equal steps over the share of the rated speed: straight falls and jumps up."""
    return largest - (largest - smallest) * (speed * steps % 1.0)


class TestMeanStartingTorque:
    @pytest.mark.parametrize("steps", [1, 3, 7])
    def test_does_the_work_of_the_steps(self, steps: int) -> None:
        largest, smallest = 900.0, 550.0
        work = sum(
            quad(lambda s: sawtooth(largest, smallest, steps, s), k / steps, (k + 1) / steps - 1e-15, limit=200)[0]
            for k in range(steps)
        )
        assert motor.mean_starting_torque(largest, smallest) == pytest.approx(work, rel=1e-9)

    @given(st.floats(0, 1e6), st.floats(0, 1e6))
    @steady
    def test_lies_between_both_and_does_not_care_for_their_order(self, one: float, other: float) -> None:
        mean = motor.mean_starting_torque(one, other)
        assert min(one, other) <= mean <= max(one, other)
        assert mean == motor.mean_starting_torque(other, one)

    def test_of_a_constant_torque_is_that_torque(self) -> None:
        assert motor.mean_starting_torque(730.0, 730.0) == 730.0


class TestRimForce:
    @pytest.mark.parametrize("seed", range(6))
    def test_carries_the_power_that_leaves_the_gear(self, seed: int) -> None:
        rng = np.random.default_rng(seed)
        torque, ratio, eta, radius = rng.uniform(10, 1e4), rng.uniform(1, 80), rng.uniform(0.5, 1), rng.uniform(0.1, 1)
        rotor_speed = 153.0
        rim_speed = rotor_speed / ratio * radius
        assert motor.rim_force(torque, ratio, eta, radius) * rim_speed == pytest.approx(
            eta * torque * rotor_speed, rel=1e-12
        )

    def test_direct_drive_is_the_lever_of_the_drum(self) -> None:
        assert motor.rim_force(120.0, 1.0, 1.0, 0.4) == pytest.approx(300.0, rel=1e-15)

    @given(st.floats(-1e5, 1e5), st.floats(1.0, 100.0), st.floats(0.3, 1.0), st.floats(0.05, 2.0))
    @steady
    def test_turns_with_the_torque_and_loses_by_the_gear(
        self, torque: float, ratio: float, eta: float, radius: float
    ) -> None:
        force = motor.rim_force(torque, ratio, eta, radius)
        assert motor.rim_force(-torque, ratio, eta, radius) == -force
        assert abs(force) <= abs(torque) * ratio / radius * (1 + 1e-12)
