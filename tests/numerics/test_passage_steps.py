"""How a motion is cut into steps: how long each is, what it costs, and where in a step an event is looked for.

The rules are written down again here from what the module says of itself, and held to the steps it makes.
"""

import math
from collections.abc import Callable

import numpy as np
import pytest

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics import passage
from ptmcalc.numerics.collocation import radau
from ptmcalc.numerics.passage import ANGLE, TIME, Phase, State, Step, follow

Acceleration = Callable[[np.ndarray, np.ndarray, np.ndarray], np.ndarray]
SETTINGS = [(11, 1e-11), (7, 1e-8), (5, 1e-5)]


def rest_only(t: np.ndarray, a: np.ndarray, w: np.ndarray) -> np.ndarray:
    return np.array([w])


def watching(*functions: Acceleration) -> Acceleration:
    return lambda t, a, w: np.array([f(t, a, w) for f in functions])


def decay(t: np.ndarray, a: np.ndarray, w: np.ndarray) -> np.ndarray:
    return np.asarray(-0.5 * w)


def pendulum(t: np.ndarray, a: np.ndarray, w: np.ndarray) -> np.ndarray:
    return np.asarray(-9.0 * np.sin(a))


def steady(t: np.ndarray, a: np.ndarray, w: np.ndarray) -> np.ndarray:
    return np.full(w.shape, 3.0)


def stiff(t: np.ndarray, a: np.ndarray, w: np.ndarray) -> np.ndarray:
    return np.asarray(-3e3 * (w - 10.0))


def free(t: np.ndarray, a: np.ndarray, w: np.ndarray) -> np.ndarray:
    return np.zeros(w.shape)


def turn_time(acceleration: Acceleration, state: State) -> float:
    """0.9 rad at the present speed and the size of the present acceleration: w t + a t^2/2 = 0.9."""
    a = abs(float(acceleration(*(np.array([x]) for x in (state.time, state.angle, state.speed)))[0]))
    return max(root.real for root in np.roots([a / 2, state.speed, -0.9])) if a else 0.9 / state.speed


def error_of(step: Step, largest: float) -> float:
    """Share of the largest speed that the last two coefficients may add."""
    order = len(step.coefficients)
    scale = max(largest, step.end.speed, abs(step.end.speed - step.begin.speed))
    return float(np.abs(step.coefficients[-2:]).max()) / (2 * order - 1) * step.duration / scale


def scaled(acceleration: Acceleration, unit: float) -> Acceleration:
    """The same motion in another unit of time."""
    return lambda t, a, w: unit**2 * acceleration(t, a, w / unit)


@pytest.mark.parametrize(("order", "tolerance"), SETTINGS)
@pytest.mark.parametrize("unit", [1.0, 1e-3, 1e4])
@pytest.mark.parametrize(
    ("acceleration", "speed"), [(decay, 8.0), (decay, 0.4), (pendulum, 7.0), (steady, 0.01), (stiff, 1.0)]
)
def test_each_step_is_as_long_as_the_one_before_allows(
    acceleration: Acceleration, speed: float, unit: float, order: int, tolerance: float
) -> None:
    """0.9 (tolerance/error)^(1/n) of the last, no more than twice and no less than a fifth of it, up to 0.9 rad; and
    where even that was too long, so much of it."""
    of = scaled(acceleration, unit)
    done = follow(Phase(of, rest_only, until_time=3.0 / unit), State(0.0, 0.0, speed * unit), order, tolerance)
    largest, tried = speed * unit, turn_time(of, done.steps[0].begin)
    as_foreseen = 0
    for step in done.steps[:-1]:
        while step.duration < tried * (1 - 1e-9):  # what was tried first, let through by any tolerance
            until = step.begin.time + 1.5 * tried
            refused = follow(Phase(of, rest_only, until_time=until), step.begin, order, 1e99, tried)
            assert refused.steps[0].duration == tried
            error = error_of(refused.steps[0], largest)
            assert error > tolerance
            tried *= max(0.9 * (tolerance / error) ** (1 / order), 0.2)
        assert step.duration == pytest.approx(tried, rel=1e-9)
        as_foreseen += 1
        error = error_of(step, largest)
        assert error <= tolerance
        grown = min(0.9 * (tolerance / error) ** (1 / order), 2.0) if error else 2.0
        largest = max(largest, step.end.speed)
        tried = min(step.duration * max(grown, 0.2), turn_time(of, step.end))
    assert as_foreseen >= 1


@pytest.mark.parametrize(("order", "tolerance"), SETTINGS)
class TestWork:
    """A Jacobian asks for 3 n accelerations, each turn of Newton's method for n, and the rates of the step for n."""

    def test_of_a_steady_acceleration(self, order: int, tolerance: float) -> None:
        """The guess is the solution: one turn to see it."""
        done = follow(Phase(steady, rest_only, until_time=4.0), State(0.0, 0.0, 0.5), order, tolerance)
        assert done.evaluations == 5 * order * len(done.steps)

    def test_of_a_linear_motion(self, order: int, tolerance: float) -> None:
        """One turn that solves it, one to see it."""
        done = follow(Phase(decay, rest_only, until_time=0.1), State(0.0, 1.0, 8.0), order, tolerance)
        assert len(done.steps) == 1
        assert done.evaluations == 6 * order

    def test_of_a_step_that_was_too_long(self, order: int, tolerance: float) -> None:
        def fast(t: np.ndarray, a: np.ndarray, w: np.ndarray) -> np.ndarray:
            return np.asarray(-200.0 * w)

        done = follow(Phase(fast, rest_only, until_time=0.04), State(0.0, 1.0, 8.0), order, tolerance, 0.04)
        tries = done.evaluations / (6 * order)
        assert tries == int(tries)
        assert tries > len(done.steps)

    def test_of_an_event(self, order: int, tolerance: float) -> None:
        """The step is made again once or twice; each time anew."""
        done = follow(Phase(decay, rest_only, until_angle=1.5), State(0.0, 1.0, 8.0), order, tolerance)
        assert done.reason == ANGLE
        assert done.evaluations in (12 * order, 18 * order, 24 * order)
        assert len(done.steps) == 1

    def test_of_a_pendulum(self, order: int, tolerance: float) -> None:
        """Newton's method with a Jacobian for a step: no more than five turns, and the equation holds at the nodes."""
        done = follow(Phase(pendulum, rest_only, until_time=1.0), State(0.0, 0.3, 8.0), order, tolerance)
        assert done.evaluations <= 9.5 * order * len(done.steps)
        nodes = radau(order).nodes
        for step in done.steps:
            times, angles, speeds = step.at(nodes)
            told = radau(order).evaluate(step.coefficients, nodes)
            assert np.abs(told - pendulum(times, angles, speeds)).max() <= 3e-13


def test_what_stands_still_is_one_step() -> None:
    done = follow(Phase(free, rest_only, until_time=7.0), State(1.0, 2.0, 0.0), 7, 1e-8)
    assert (done.reason, len(done.steps), done.end) == (TIME, 1, State(7.0, 2.0, 0.0))


def test_what_is_driven_from_rest_or_rolls_on_is_told_from_what_stands_still() -> None:
    """Accelerations and speeds of exactly 1 are none of 0."""
    one = lambda t, a, w: np.ones(w.shape)  # noqa: E731
    driven = follow(Phase(one, rest_only, until_time=30.0), State(0.0, 0.0, 0.0), 7, 1e-8)
    assert driven.steps[0].duration == pytest.approx(math.sqrt(1.8), rel=1e-12)
    rolling = follow(Phase(free, rest_only, until_time=30.0), State(0.0, 0.0, 1.0), 7, 1e-8)
    assert rolling.steps[0].duration == pytest.approx(0.9, rel=1e-12)


@pytest.mark.parametrize(("noise", "shorter"), [(1e-11, False), (1e-9, True)])
def test_noise_that_is_more_than_may_stay_makes_steps_shorter(noise: float, shorter: bool) -> None:
    """Speeds that will not stand to 1e-11 are not taken: over a shorter step less of the noise is in them."""

    def noisy(t: np.ndarray, a: np.ndarray, w: np.ndarray) -> np.ndarray:
        return np.asarray(-0.5 * w * (1 + noise * np.sin(1e15 * w)))

    clean, done = (
        follow(Phase(of, rest_only, until_time=1.0), State(0.0, 1.0, 8.0), 11, 1e-9) for of in (decay, noisy)
    )
    assert (len(done.steps) > len(clean.steps)) == shorter
    assert done.end.speed == pytest.approx(8 * math.exp(-0.5), rel=10 * noise)


@pytest.mark.parametrize("angle", [3.0, 4.2, 5.0, 6.1])
def test_a_mark_whose_last_digits_are_noise_is_met_as_well_as_they_allow(angle: float) -> None:
    """Where a try is no better than the one before the step stands: two or three tries more than without noise."""
    clean = watching(lambda t, a, w: w, lambda t, a, w: angle - a)
    noisy = watching(lambda t, a, w: w, lambda t, a, w: angle - a + 3e-11 * np.sin(1e14 * a))
    runs = [follow(Phase(decay, marks), State(0.0, 1.0, 8.0), 11, 1e-9) for marks in (clean, noisy)]
    assert [run.reason for run in runs] == [1, 1]
    assert runs[1].end.angle == pytest.approx(angle, rel=1e-10)
    assert len(runs[0].steps) == len(runs[1].steps)
    assert runs[1].evaluations <= runs[0].evaluations + 3 * 66


@pytest.mark.parametrize("angle", [5.0, 5.3, 6.1])
def test_an_event_that_newton_runs_away_from_is_come_near_by_halves(angle: float) -> None:
    """A cube root is met by no step of some length: half of what is left is gone, again and again."""
    done = follow(Phase(decay, watching(lambda t, a, w: np.cbrt(a - angle))), State(0.0, 1.0, 8.0), 11, 1e-9)
    assert done.end.angle == pytest.approx(angle, abs=3e-9)
    assert 20 < len(done.steps) < 50
    late = np.array([step.duration for step in done.steps[8:-1]])
    assert np.median(late[1:] / late[:-1]) == pytest.approx(0.5, abs=0.02)


def test_the_shortest_step_is_one_that_time_still_feels() -> None:
    done = follow(Phase(decay, rest_only, until_time=1 + 2e-14), State(1.0, 1.0, 8.0), 7, 1e-8)
    assert (done.reason, len(done.steps)) == (TIME, 1)
    with pytest.raises(NumericsError, match="no step can be made"):
        follow(Phase(decay, rest_only, until_time=1.0), State(1.0, 1.0, 8.0), 7, 1e-8)


class TestFirstEvent:
    """A step of a second at the speed 2 from the angle 1: the angle is 1 + 2 place."""

    STEP = Step(State(0.0, 1.0, 2.0), 1.0, np.zeros(7), State(1.0, 3.0, 2.0))

    def first(self, *marks: Acceleration, until_angle: float = math.inf) -> tuple[float, int] | None:
        return passage._first_event(Phase(free, watching(*marks), until_angle=until_angle), self.STEP)

    @pytest.mark.parametrize("place", [1e-3, 0.03, 0.3, 0.5, 0.77, 0.999])
    @pytest.mark.parametrize("sign", [1.0, -1.0])
    def test_of_straight_and_bent_marks(self, place: float, sign: float) -> None:
        there = 1 + 2 * place
        for mark, digits in (
            (lambda t, a, w: sign * (a - there), 1e-9),
            (lambda t, a, w: sign * (np.exp(a) - math.exp(there)), 3e-7),
            (lambda t, a, w: sign * (a**4 - there**4), 3e-7),
        ):
            found = self.first(mark)
            assert found == (pytest.approx(place, abs=digits), 0)

    @pytest.mark.parametrize("place", [1e-3, 0.03, 0.3, 0.77, 0.999, 1.0])
    def test_of_an_angle(self, place: float) -> None:
        found = self.first(lambda t, a, w: w, until_angle=1 + 2 * place)
        assert found == (pytest.approx(place, abs=1e-9), ANGLE)
        assert self.first(lambda t, a, w: w, until_angle=3.001) is None

    def test_is_the_first_of_all(self) -> None:
        marks = [lambda t, a, w, x=x: a - 1 - 2 * x for x in (0.7, 0.4, 0.2, 1.2)]
        assert self.first(*marks) == (pytest.approx(0.2, abs=1e-9), 2)
        assert self.first(*marks, until_angle=1.3) == (pytest.approx(0.15, abs=1e-9), ANGLE)
        assert self.first(marks[0], lambda t, a, w: (a - 1.8) * (a - 2.6)) == (pytest.approx(0.4, abs=1e-6), 1)

    @pytest.mark.parametrize("share", [0.0, 1e-11, -1e-11])
    def test_is_not_the_one_the_step_begins_with(self, share: float) -> None:
        """Within 1e-9 of its largest value a mark is at its own event, on either side; beyond that it has one."""
        assert self.first(lambda t, a, w: a - 1 - 2 * share) is None
        assert self.first(lambda t, a, w: 1e-6 * (1 + 2 * share - a)) is None
        back = self.first(lambda t, a, w: (a - 1 - 2 * share) * (2.2 - a))
        assert back == (pytest.approx(0.6, abs=1e-6), 0)
        assert self.first(lambda t, a, w: a - 1 - 2e-7) == (pytest.approx(1e-7, abs=1e-9), 0)
        assert self.first(lambda t, a, w: 1e6 * (a - 1 - 2e-7)) == (pytest.approx(1e-7, abs=1e-9), 0)

    @pytest.mark.parametrize("place", [0.003, 0.3333, 0.985])
    def test_of_a_mark_that_newton_cannot_follow(self, place: float) -> None:
        """A cube root sends Newton's method away twice as far: the straight line between two samples stands."""
        mark = lambda t, a, w: np.cbrt(a - 1 - 2 * place)  # noqa: E731
        low = math.floor(24 * place) / 24
        here, after = (math.copysign(abs(2 * (x - place)) ** (1 / 3), x - place) for x in (low, low + 1 / 24))
        line = low + here / (here - after) / 24
        moved = line - 3 * (line - place)
        found = self.first(mark)
        assert found is not None
        if not abs(moved - line) < 1 / 24 or moved <= 0:
            assert found[0] == pytest.approx(line, abs=1e-9)
        assert abs(found[0] - place) < 3 / 24
        assert found[0] > 0

    def test_a_jump_is_halved_no_further(self) -> None:
        """A mark that only jumps lies somewhere between two samples."""
        found = self.first(lambda t, a, w: np.where(a > 1.8, 2.0, -1.0))
        assert found is not None
        assert 9 / 24 <= found[0] <= 10 / 24


@pytest.mark.parametrize("noise", [0.0, 3e-13, 1e-9])
@pytest.mark.parametrize("acceleration", [decay, pendulum, stiff])
def test_the_work_told_is_what_was_asked_for(acceleration: Acceleration, noise: float) -> None:
    """Every acceleration at the nodes counts, whatever came of it; the one at the beginning of a step does not."""
    asked = 0

    def counted(t: np.ndarray, a: np.ndarray, w: np.ndarray) -> np.ndarray:
        nonlocal asked
        asked += len(t) if len(t) > 1 else 0
        return acceleration(t, a, w) * (1 + noise * np.sin(1e15 * w))

    done = follow(Phase(counted, rest_only, until_time=0.7, until_angle=4.0), State(0.0, 1.0, 8.0), 11, 1e-9, 0.3)
    assert done.evaluations == asked


def test_times_and_angles_are_no_numbers_of_marks() -> None:
    marks = watching(*[lambda t, a, w, x=x: 1.0 + x - a for x in range(5)])
    ends = [follow(Phase(decay, marks), State(0.0, 0.5 + k, 8.0), 7, 1e-8).reason for k in range(5)]
    assert ends == [0, 1, 2, 3, 4]
    never = watching(lambda t, a, w: w, lambda t, a, w: w, lambda t, a, w: w)
    assert follow(Phase(decay, never, until_angle=3.0), State(0.0, 1.0, 8.0), 7, 1e-8).reason == ANGLE < 0
    assert follow(Phase(decay, never, until_time=0.1), State(0.0, 1.0, 8.0), 7, 1e-8).reason == TIME < 0
    assert TIME != ANGLE
