"""Motions from event to event against equations with known solutions."""

import math

import numpy as np
import pytest

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.passage import ANGLE, TIME, Phase, State, follow

SETTINGS = [(11, 1e-11), (7, 1e-8)]


def marks(*functions):  # type: ignore[no-untyped-def]
    """Rest first, then others."""
    return lambda t, a, w: np.array([w, *(f(t, a, w) for f in functions)])


def free(t: np.ndarray, a: np.ndarray, w: np.ndarray) -> np.ndarray:
    return np.zeros(w.shape)


@pytest.mark.parametrize(("order", "tolerance"), SETTINGS)
class TestEnds:
    def test_at_a_time(self, order: int, tolerance: float) -> None:
        """w' = -0.5 w."""
        phase = Phase(lambda t, a, w: -0.5 * w, marks(), until_time=3.7)
        done = follow(phase, State(0.0, 1.0, 8.0), order, tolerance)
        assert done.reason == TIME
        assert done.end.time == pytest.approx(3.7, rel=1e-14)
        assert done.end.speed == pytest.approx(8 * math.exp(-1.85), rel=1e3 * tolerance)
        assert done.end.angle == pytest.approx(1 + 16 * (1 - math.exp(-1.85)), rel=1e3 * tolerance)

    def test_at_an_angle(self, order: int, tolerance: float) -> None:
        """w' = -0.5 w: the angle 5 is passed at t = -2 ln(1 - 4/16)."""
        phase = Phase(lambda t, a, w: -0.5 * w, marks(), until_angle=5.0)
        done = follow(phase, State(0.0, 1.0, 8.0), order, tolerance)
        assert done.reason == ANGLE
        assert done.end.angle == 5.0
        assert done.end.time == pytest.approx(-2 * math.log(0.75), rel=1e3 * tolerance)

    def test_an_angle_costs_little_more_than_its_time(self, order: int, tolerance: float) -> None:
        """The last step is cut by Newton's method, not by smaller and smaller ones: in all at most twice the work."""
        passed, begin = -2 * math.log(0.75), State(0.0, 1.0, 8.0)
        by_time, by_angle = (
            follow(Phase(lambda t, a, w: -0.5 * w, marks(), **end), begin, order, tolerance)
            for end in ({"until_time": passed}, {"until_angle": 5.0})
        )
        assert len(by_angle.steps) == len(by_time.steps)
        assert by_angle.evaluations <= 2 * by_time.evaluations

    def test_at_rest(self, order: int, tolerance: float) -> None:
        """A pendulum swings up to where its speed is 0."""
        phase = Phase(lambda t, a, w: -9.0 * np.sin(a), marks())
        done = follow(phase, State(0.0, 0.0, 2.0), order, tolerance)
        assert done.reason == 0
        assert abs(done.end.speed) < 1e-12
        assert math.cos(done.end.angle) == pytest.approx(1 - 2.0**2 / 18, rel=1e3 * tolerance)

    def test_at_a_mark(self, order: int, tolerance: float) -> None:
        """Constant acceleration 3 from rest to the speed 12."""
        phase = Phase(lambda t, a, w: np.full(w.shape, 3.0), marks(lambda t, a, w: 12.0 - w))
        done = follow(phase, State(0.0, 0.0, 0.0), order, tolerance)
        assert done.reason == 1
        assert (done.end.time, done.end.angle) == pytest.approx((4.0, 24.0), rel=1e-13)

    def test_whatever_comes_first(self, order: int, tolerance: float) -> None:
        early, late = (lambda t, a, w: 2.0 - t), (lambda t, a, w: 2.5 - t)
        phase = Phase(free, marks(late, early), until_time=3.0, until_angle=40.0)
        done = follow(phase, State(0.0, 0.0, 8.0), order, tolerance)
        assert (done.reason, done.end.time) == (2, pytest.approx(2.0, rel=1e-12))

    def test_the_event_it_begins_with_is_not_found_again(self, order: int, tolerance: float) -> None:
        phase = Phase(free, marks(lambda t, a, w: a - 1.0), until_time=2.0)
        done = follow(phase, State(0.0, 1.0, 3.0), order, tolerance)
        assert (done.reason, done.end.time) == (TIME, 2.0)

    def test_a_bump_that_only_just_passes_a_mark_is_seen(self, order: int, tolerance: float) -> None:
        """w = 1 + 0.1 sin t stands above 1.0999 for 9 % of a radian."""
        phase = Phase(lambda t, a, w: 0.1 * np.cos(t), marks(lambda t, a, w: 1.0999 - w), until_time=9.0)
        done = follow(phase, State(0.0, 0.0, 1.0), order, tolerance)
        assert done.reason == 1
        assert done.end.time == pytest.approx(math.asin(0.999), rel=1e-7)


@pytest.mark.parametrize("angle", [1.0, 5.0, 9.0])
def test_a_coarse_step_still_ends_on_its_event(angle: float) -> None:
    """A pendulum over the top, in steps whose polynomials stray by some 1e-10 before the last one is made again."""
    done = follow(Phase(lambda t, a, w: -9.0 * np.sin(a), marks(), until_angle=angle), State(0.0, 0.0, 7.0), 7, 1e-6)
    assert float(done.steps[-1].at(np.array([1.0]))[1][0]) == pytest.approx(angle, rel=1e-14)


def test_a_linear_motion_takes_one_jacobian_and_one_step_of_newton() -> None:
    """Eleven nodes thrice for the differences, once before, once after the step, and once more to see it stand."""
    done = follow(Phase(lambda t, a, w: -0.5 * w, marks(), until_time=3.7), State(0.0, 1.0, 8.0), 11, 1e-9)
    assert done.evaluations <= 6 * 11 * len(done.steps)


def test_steps_join_and_know_their_inside() -> None:
    phase = Phase(lambda t, a, w: -9.0 * np.sin(a), marks(), until_time=4.0)
    done = follow(phase, State(0.0, 0.0, 20.0), 11, 1e-11)
    for before, after in zip(done.steps[:-1], done.steps[1:], strict=True):
        assert before.end == after.begin
    for step in done.steps:
        times, angles, speeds = step.at(np.array([0.0, 0.3, 1.0]))
        assert (times[0], angles[0], speeds[0]) == (step.begin.time, step.begin.angle, step.begin.speed)
        assert (angles[2], speeds[2]) == pytest.approx((step.end.angle, step.end.speed), rel=1e-12)
        energy = speeds**2 / 2 - 9 * np.cos(angles)
        assert energy == pytest.approx(200 - 9, rel=1e-10)
        time, angle, speed, rate, weight = step.sample(9)
        assert rate == pytest.approx(-9 * np.sin(angle), abs=1e-7)
        assert np.sum(weight) == pytest.approx(step.duration, rel=1e-13)
        assert np.all((time > step.begin.time) & (time < step.end.time) & (speed > 0))


@pytest.mark.parametrize("rate", [1e2, 1e5, 1e8])
def test_stiffness_costs_no_steps_without_end(rate: float) -> None:
    """A speed that is held by a stiff motor follows it after the first moment."""
    phase = Phase(lambda t, a, w: -rate * (w - 10.0), marks(), until_time=5.0)
    done = follow(phase, State(0.0, 0.0, 1.0), 11, 1e-9)
    assert done.end.speed == pytest.approx(10.0, rel=1e-9)
    assert len(done.steps) < 250


def test_what_cannot_be_followed_is_said() -> None:
    phase = Phase(lambda t, a, w: np.full(w.shape, np.nan), marks(), until_time=1.0)
    with pytest.raises(NumericsError):
        follow(phase, State(0.0, 0.0, 1.0), 7, 1e-8)


@pytest.mark.parametrize("unit", [1e-7, 1.0, 1e5])
def test_a_slow_motion_is_followed_as_well_as_a_fast_one(unit: float) -> None:
    """A pendulum over the top in other units of time: the same steps, each as long in its own unit."""
    whole = follow(Phase(lambda t, a, w: -9.0 * np.sin(a), marks(), until_angle=9.0), State(0.0, 0.0, 7.0), 7, 1e-7)
    phase = Phase(lambda t, a, w: -9.0 * unit**2 * np.sin(a), marks(), until_angle=9.0)
    done = follow(phase, State(0.0, 0.0, 7.0 * unit), 7, 1e-7)
    assert len(done.steps) == len(whole.steps)
    assert done.end.time * unit == pytest.approx(whole.end.time, rel=1e-11)
    assert done.end.speed / unit == pytest.approx(whole.end.speed, rel=1e-11)
    assert done.end.speed**2 / 2 == pytest.approx(unit**2 * (24.5 - 9 + 9 * math.cos(9.0)), rel=1e-5)


def test_a_torque_that_goes_by_the_angle_is_no_harder_than_one_that_goes_by_the_speed() -> None:
    """w' = -400 a is linear too: one Jacobian and one step of Newton's method for each step of the motion."""
    phase = Phase(lambda t, a, w: -400.0 * a, marks(), until_time=0.07)
    done = follow(phase, State(0.0, 0.1, 30.0), 11, 1e-9)
    assert done.end.angle == pytest.approx(0.1 * math.cos(1.4) + 1.5 * math.sin(1.4), rel=1e-9)
    assert done.end.speed == pytest.approx(30.0 * math.cos(1.4) - 2.0 * math.sin(1.4), rel=1e-9)
    assert done.evaluations <= 6 * 11 * len(done.steps)


def test_a_torque_whose_last_digits_are_noise_is_followed_to_them() -> None:
    """Nothing converges below the noise of what is asked: that is no reason to make steps shorter and shorter."""

    def noisy(t: np.ndarray, a: np.ndarray, w: np.ndarray) -> np.ndarray:
        return -0.5 * w * (1 + 3e-13 * np.sin(1e17 * w))

    done = follow(Phase(noisy, marks(), until_time=3.7), State(0.0, 1.0, 8.0), 11, 1e-9)
    clean = follow(Phase(lambda t, a, w: -0.5 * w, marks(), until_time=3.7), State(0.0, 1.0, 8.0), 11, 1e-9)
    assert done.end.speed == pytest.approx(8 * math.exp(-1.85), rel=1e-9)
    assert len(done.steps) == len(clean.steps)
    assert done.evaluations <= 4 * clean.evaluations
