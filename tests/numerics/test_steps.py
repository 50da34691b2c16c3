"""The step tables of textbooks against motions in closed form: under a constant acceleration every step is exact."""

import math

import numpy as np
import pytest

from ptmcalc.numerics.steps import energy_steps, step_table


@pytest.mark.parametrize("step", [0.7, 0.25, 10.0])
class TestConstantAcceleration:
    """Uniformly: t = (w_1 - w_0)/eps, phi = (w_1^2 - w_0^2)/(2 eps), also where the end lies within a step."""

    def test_speeding_up(self, step: float) -> None:
        """From 2 to 11 rad/s at 3 rad/s^2: 3 s and 19.5 rad, wherever it begins."""
        found = step_table(lambda time, angle, speed: 3.0, 5.0, 2.0, 11.0, step, 100)
        assert found.reached
        assert found.time == pytest.approx(3.0, rel=1e-14)
        assert found.angle == pytest.approx(19.5, rel=1e-14)
        assert found.speed == 11.0
        assert found.steps == math.ceil(3.0 / step)

    def test_slowing_down(self, step: float) -> None:
        """From 10 rad/s to rest at -2.5 rad/s^2: 4 s and 20 rad."""
        found = step_table(lambda time, angle, speed: -2.5, -1.0, 10.0, 0.0, step, 100)
        assert found.reached
        assert found.time == pytest.approx(4.0, rel=1e-14)
        assert found.angle == pytest.approx(20.0, rel=1e-14)


def test_the_acceleration_is_that_of_the_beginning_of_each_step() -> None:
    """By hand, dt = 1 s: eps = 1 at 0 s, phi = 0; eps = 3 at 1 s, phi = 0.5, w = 1; 1 + 3 reaches 4 at 2 s."""
    seen = []

    def rate(time: float, angle: float, speed: float) -> float:
        seen.append((time, angle, speed))
        return 1.0 + 2.0 * time

    found = step_table(rate, 0.0, 0.0, 4.0, 1.0, 10)
    assert seen == [(0.0, 0.0, 0.0), (1.0, 0.5, 1.0)]
    assert (found.time, found.angle, found.steps) == (2.0, 3.0, 2)


@pytest.mark.parametrize("rate", [-1.0, 0.0])
def test_a_start_that_never_moves_is_given_up_at_once(rate: float) -> None:
    calls = []
    found = step_table(lambda *now: calls.append(now) or rate, 0.0, 0.0, 4.0, 1.0, 10)
    assert not found.reached
    assert math.isinf(found.time)
    assert len(calls) == 1


def test_too_few_steps_reach_nothing() -> None:
    assert step_table(lambda *now: 1.0, 0.0, 0.0, 4.0, 1.0, 4).reached
    assert not step_table(lambda *now: 1.0, 0.0, 0.0, 4.0, 1.0, 3).reached


def test_speeds_from_energies() -> None:
    """J = 2 kg*m^2 from 3 rad/s, 9 J: 7 J more are 4 rad/s; of a body twice as heavy sqrt(8); spent energy is rest."""
    speeds = energy_steps(np.array([2.0, 2.0, 4.0, 2.0]), np.array([0.0, 7.0, 7.0, -9.5]), 9.0)
    np.testing.assert_allclose(speeds, [3.0, 4.0, math.sqrt(8.0), 0.0], rtol=1e-15)


def test_the_lines_of_a_table_lead_from_the_beginning_to_the_end() -> None:
    """From 2 rad/s at 3 rad/s^2 in steps of 1 s: 5, 8, 11 rad/s after 3.5, 10 and 19.5 rad, wherever it begins."""
    found = step_table(lambda time, angle, speed: 3.0, 5.0, 2.0, 11.0, 1.0, 100)
    assert np.array(found.lines) == pytest.approx(np.array([(0, 0, 2), (1, 3.5, 5), (2, 10, 8), (3, 19.5, 11)]))
    assert found.lines[-1] == (found.time, found.angle, found.speed)
