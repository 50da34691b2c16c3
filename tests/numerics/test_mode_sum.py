"""Sums of modes against DOP853 started again at every kink of the input, and against closed forms."""

import itertools
import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.mode_sum import Course, Modes, kicks, mode_sum, sampled

ZERO = np.zeros(3)
COURSES = {
    "step": Course.step(),
    "straight": Course.straight(np.array([0.0, 0.5, 1.0, 1.5]), np.array([0.0, 1.0, 0.2, 0.9])),
    "parabolas": Course(
        np.array([0.0, 0.4, 0.8]),
        np.array([0, 0.5, 1.0]),
        np.array([0, 2.5, 0]),
        np.array([6.25, -6.25, 0]),
        ZERO,
        ZERO,
    ),
    "sine at a natural frequency": Course(
        np.array([0.0, 1.2]),
        np.array([0.5, 1.0]),
        ZERO[:2],
        ZERO[:2],
        np.array([0.5, 0.0]),
        np.full(2, -np.pi / 2),
        10.0,
    ),
    "sine beside it": Course(
        np.array([0.0, 0.4]),
        np.array([0.5, 1.0]),
        ZERO[:2],
        ZERO[:2],
        np.array([0.5, 0.0]),
        np.full(2, -np.pi / 2),
        7.8,
    ),
}
W, ZETA = np.array([10.0, 30.0, 50.0, 10.0]), np.array([0.0, 0.05, 1.0, 2.0])
GAINS = np.array([[1.0, 0.3, 0.0], [0.2, -0.5, 0.3], [0.1, 0.2, -0.1], [0.0, 0.1, 0.2]])
WHOLE = np.array([1.5, 0.2, 0.4])
MODES = Modes(W, ZETA, GAINS, WHOLE, np.zeros(3))


def integrated(modes: Modes, course: Course, window: float) -> np.ndarray:
    """The sum at the places, densely, by the equations of motion in x: x'' + ... = w^2 q + 2 zeta w q'."""
    w, zeta, count = modes.frequencies, modes.damping_ratios, len(modes.frequencies)
    state, found, before = np.zeros(2 * count), [], 0.0
    for k, begins in enumerate(course.times):
        ends = min(course.times[k + 1], window) if k + 1 < len(course.times) else window
        v, s, b, a, p, o = (part[k] for part in (
            course.values, course.slopes, course.bends, course.swings, course.phases,
            np.full(len(course.times), course.frequency)))  # fmt: skip

        def q(
            t: np.ndarray, v: float = v, s: float = s, b: float = b, a: float = a, p: float = p, o: float = o
        ) -> np.ndarray:
            return v + s * t + b * t * t / 2 + a * np.sin(o * t + p)

        def rate(
            t: float, y: np.ndarray, s: float = s, b: float = b, a: float = a, p: float = p, o: float = o, q=q
        ) -> np.ndarray:
            slope = s + b * t + a * o * math.cos(o * t + p)
            x, u = y[:count], y[count:]
            return np.concatenate([u, w**2 * (q(t) - x) + 2 * zeta * w * (slope - u)])

        state[count:] += 2 * zeta * w * (float(q(0.0)) - before)  # a jump of q is a blow by the damper
        times = np.linspace(0, ends - begins, 6001)
        run = solve_ivp(rate, (0, ends - begins), state, "DOP853", times, rtol=1e-11, atol=1e-13)
        left = modes.whole - modes.gains.sum(axis=0)
        found.append(run.y[:count].T @ modes.gains + q(times)[:, None] * left)
        state, before = run.y[:, -1], float(q(times[-1]))
    return np.concatenate(found)


@pytest.mark.parametrize("name", COURSES)
def test_extremes_are_those_of_the_equations_of_motion(name: str) -> None:
    expected = integrated(MODES, COURSES[name], 3.0)
    together = mode_sum(MODES, COURSES[name], 3.0)
    for place in range(3):
        only = slice(place, place + 1)
        found = mode_sum(Modes(W, ZETA, GAINS[:, only], WHOLE[only], np.zeros(1)), COURSES[name], 3.0)
        largest, smallest = max(expected[:, place].max(), 0.0), min(expected[:, place].min(), 0.0)
        sampled = 1e-5  # the reference has samples, not summits
        assert found.largest[0] == pytest.approx(largest, abs=sampled)
        assert found.smallest[0] == pytest.approx(smallest, abs=sampled)
        assert found.largest_low[0] - sampled <= largest <= found.largest_high[0] + 1e-9
        assert found.smallest_low[0] - 1e-9 <= smallest <= found.smallest_high[0] + sampled
        assert together.largest_low[place] <= largest + sampled
        assert largest <= together.largest_high[place] + 1e-9
        assert together.smallest_low[place] - 1e-9 <= smallest
        assert found.largest_high[0] == pytest.approx(together.largest_high[place], rel=1e-4, abs=1e-9)


@pytest.mark.parametrize("name", COURSES)
def test_samples_are_those_of_the_equations_of_motion(name: str) -> None:
    course = COURSES[name]
    kinks = [*course.times.tolist(), 3.0]
    times = np.concatenate([np.linspace(a, b, 6001) for a, b in itertools.pairwise(kinks)])
    found, truth = sampled(MODES, course, times), integrated(MODES, course, 3.0)
    inner = np.isin(times, course.times[1:], invert=True)  # a jump has two values
    close = 5e-6 if name == "sine at a natural frequency" else 1e-8  # which is moved off it by a ten-millionth
    assert found[inner] == pytest.approx(truth[inner], rel=1e-7, abs=close)


@pytest.mark.parametrize("name", COURSES)
def test_the_extremes_are_among_the_samples(name: str) -> None:
    peaks = mode_sum(MODES, COURSES[name], 3.0)
    place = int(peaks.largest.argmax())
    at = float(peaks.largest_time[place])
    found = sampled(MODES, COURSES[name], np.unique([0.0, at / 2, at, 3.0]))
    assert found[:, place].max() == pytest.approx(peaks.largest[place], rel=1e-12)


@pytest.mark.parametrize("name", COURSES)
def test_modes_left_out_are_within_the_bars(name: str) -> None:
    """The third mode is the fastest: with and without it."""
    course, gains = COURSES[name], GAINS[:3]
    whole = gains.sum(axis=0)
    three = mode_sum(Modes(W[:3], ZETA[:3], gains, whole, np.zeros(3)), course, 3.0)
    two = mode_sum(Modes(W[:2], ZETA[:2], gains[:2], whole, np.abs(gains[2])), course, 3.0)
    assert np.all(three.largest <= two.largest_high)
    assert np.all(two.largest_low <= three.largest_high)
    assert np.all(two.smallest_low <= three.smallest)
    assert np.all(three.smallest_low <= two.smallest_high)
    assert np.all(two.largest_high - two.largest_low >= 2 * np.abs(gains[2]) * kicks(course, 3.0)[0])


def test_a_step_without_damping_is_twice_its_mean() -> None:
    one = Modes(np.array([7.0]), np.zeros(1), np.array([[3.0]]), np.array([3.0]), np.zeros(1))
    found = mode_sum(one, Course.step(), 40.0)
    assert found.largest[0] == pytest.approx(6.0, rel=1e-9)
    assert found.largest_high[0] == pytest.approx(6.0, rel=2e-2)
    assert found.smallest[0] == 0.0
    assert found.largest_time[0] % (2 * math.pi / 7) == pytest.approx(math.pi / 7, rel=1e-3)


def test_a_slow_mode_under_an_input_without_swings_asks_for_samples_of_its_own_period_only() -> None:
    """A window of one wave is looked at as often, however long a wave is."""
    samples = []
    for frequency in (1e-4, 1.0, 1e4):
        one = Modes(np.array([frequency]), np.zeros(1), np.ones((1, 1)), np.ones(1), np.zeros(1))
        ramp = Course.straight(np.array([0.0, 1.0]) / frequency, np.array([0.0, 1.0]))
        samples.append([mode_sum(one, course, 6.0 / frequency).samples for course in (Course.step(), ramp)])
    assert samples[0] == samples[1] == samples[2]


def test_a_step_ends_where_no_extreme_can_follow() -> None:
    """A damped swing of a long window costs no more than its first waves."""
    one = Modes(np.array([7.0]), np.array([0.1]), np.array([[3.0]]), np.array([3.0]), np.zeros(1))
    long, short = mode_sum(one, Course.step(), 10_000.0), mode_sum(one, Course.step(), 1000.0)
    assert long.largest[0] == pytest.approx(3 * (1 + math.exp(-0.1 * math.pi / math.sqrt(0.99))), rel=1e-2)
    assert long.samples <= 2 * 1024
    assert short.samples <= 2 * 1024
    zero = np.zeros(1)
    for height in (0.04, 25.0):  # the equations are linear
        other = mode_sum(one, Course(zero, np.array([height]), zero, zero, zero, zero), 10_000.0)
        assert other.samples == long.samples
        assert other.largest == pytest.approx(height * long.largest, rel=1e-12)


def test_the_state_before_counts() -> None:
    """An input that is always positive never brings the sum below 0 before it begins."""
    one = Modes(np.array([7.0]), np.array([0.9]), np.array([[3.0]]), np.array([3.0]), np.zeros(1))
    found = mode_sum(one, Course.straight(np.array([0.0, 5.0]), np.array([0.0, 1.0])), 5.0)
    assert found.smallest[0] == 0.0
    assert found.largest[0] == pytest.approx(3.0, rel=0.1)


def test_kicks_are_jumps_and_changes_of_slope() -> None:
    jumps, variation = kicks(COURSES["straight"], 3.0)
    assert jumps == pytest.approx(0.0, abs=1e-12)
    assert variation == pytest.approx(2.0 + 3.6 + 3.0 + 1.4)
    assert kicks(COURSES["step"], 3.0) == (1.0, 0.0)


def test_too_long_a_window_says_so() -> None:
    one = Modes(np.array([1e6]), np.zeros(1), np.ones((1, 1)), np.ones(1), np.zeros(1))
    with pytest.raises(NumericsError, match="samples"):
        mode_sum(one, COURSES["straight"], 1e6)


def test_four_million_samples_are_the_most() -> None:
    """Half a radian of the fastest mode apart; a swing that has faded needs only the first of them."""
    one = Modes(np.array([2.0]), np.array([0.1]), np.ones((1, 1)), np.ones(1), np.zeros(1))
    most = 0.25 * (4_000_000 - 1)
    assert mode_sum(one, Course.step(), most * (1 - 1e-12)).samples < 5000
    with pytest.raises(NumericsError, match="4000001 samples"):
        mode_sum(one, Course.step(), most * (1 + 1e-12))


class TestBetweenSamples:
    """Numbers between which a sum lies, where all that is missed can be told by hand."""

    @staticmethod
    def watching(course: Course, window: float, frequency: float = 3.0, zeta: float = 0.1) -> tuple[object, float]:
        """Two places that see the input itself, the first larger; and the second's bar."""
        modes = Modes(
            np.array([frequency]), np.array([zeta]), np.zeros((1, 2)), np.array([2.0, 1.0]), np.zeros(2)
        )  # fmt: skip
        found = mode_sum(modes, course, window)
        return found, float(found.largest_high[1] - found.largest[1])

    @pytest.mark.parametrize(("omega", "frequency"), [(7.8, 3.0), (3.0, 11.0), (0.4, 3.0)])
    def test_a_sine_bends_by_its_square(self, omega: float, frequency: float) -> None:
        """|S''| <= a omega^2 and a straight line between samples misses no more than h^2/8 of it."""
        course = Course(ZERO[:1], ZERO[:1], ZERO[:1], ZERO[:1], np.array([0.5]), ZERO[:1], omega)
        window = 2.3 * 2 * math.pi / omega
        found, bar = self.watching(course, window, frequency)
        step = window / (math.ceil(max(omega, frequency) * window / 0.5) + 1)
        assert bar == pytest.approx(0.5 * omega**2 * step**2 / 8, rel=1e-9)
        assert found.largest_high[1] >= 0.5
        assert found.largest[0] == pytest.approx(1.0, rel=1e-9), "the largest place is a summit"
        assert found.samples == math.ceil(max(omega, frequency) * window / 0.5) + 1

    @pytest.mark.parametrize("chunks", [0.7, 1.0, 1.6, 3.2])
    def test_nothing_is_seen_behind_the_window(self, chunks: float) -> None:
        """A ramp is largest at its end, however many samples are looked at at once."""
        ramp = Course(ZERO[:1], ZERO[:1], np.array([2.0]), ZERO[:1], ZERO[:1], ZERO[:1])
        count = round(1024 * chunks)
        window = (count - 1.5) * 0.5 / 3.0
        found, _ = self.watching(ramp, window)
        assert found.samples == count
        assert found.largest[1] == pytest.approx(2.0 * window, rel=1e-12)

    def test_a_step_leaves_out_what_it_jumps_by_and_no_more(self) -> None:
        modes = Modes(np.array([3.0]), np.array([0.1]), np.zeros((1, 2)), np.array([2.0, 1.0]), np.array([0.0, 0.3]))
        found = mode_sum(modes, Course.step(), 5.0)
        assert found.largest_high - found.largest == pytest.approx([0.0, 0.3], abs=1e-12)

    def test_a_parabola_bends_as_it_does(self) -> None:
        course = Course(ZERO[:1], ZERO[:1], np.array([2.0]), np.array([-1.5]), ZERO[:1], ZERO[:1])
        _, bar = self.watching(course, 2.0, 4.0)
        step = 2.0 / (math.ceil(4.0 * 2.0 / 0.5) + 1)
        assert bar == pytest.approx(1.5 * step**2 / 8, rel=1e-9)

    @pytest.mark.parametrize("zeta", [0.0, 0.3, 1.0, 2.5])
    def test_a_free_mode_bends_by_its_energy(self, zeta: float) -> None:
        """After a step d = -1, d' = 2 z w - 0: |d''| <= w^2 (1 + 2 z) (d^2 + (d'/w)^2)^(1/2)."""
        w = 5.0
        modes = Modes(np.array([w]), np.array([zeta]), np.array([[3.0, 1.0]]), np.array([3.0, 1.0]), np.zeros(2))
        found = mode_sum(modes, Course.step(), 2.0)
        step = 2.0 / (math.ceil(w * 2.0 / 0.5) + 1)
        bend = w * w * (1 + 2 * zeta) * math.hypot(1.0, 2 * zeta)
        assert found.largest_high[1] - found.largest[1] <= bend * step**2 / 8 * (1 + 1e-12)
        assert found.largest_high[1] - found.largest[1] >= bend * step**2 / 8 - 0.02, "the summit of the other place"
        times = np.linspace(0, 2, 20_001)
        x = integrated(modes, Course.step(), 2.0)[:, 1]
        assert x.max() <= found.largest_high[1]
        assert len(times) > len(x)

    def test_what_an_input_drives_adds_to_the_energy(self) -> None:
        """A sine far from the mode: E grows by a omega^2/w per time at most, from what it begins with."""
        w, zeta, omega, a, window = 5.0, 0.2, 1.3, 0.4, 1.9
        course = Course(ZERO[:1], ZERO[:1], ZERO[:1], ZERO[:1], np.array([a]), ZERO[:1], omega)
        modes = Modes(np.array([w]), np.array([zeta]), np.array([[3.0, 1.0]]), np.array([3.0, 1.0]), np.zeros(2))
        found = mode_sum(modes, course, window)
        step = window / (math.ceil(w * window / 0.5) + 1)
        driven = a * omega**2
        energy = a * omega / w + driven / w * window  # at the start d = 0, d' = -q'
        bend = w * w * (1 + 2 * zeta) * energy + 2 * driven
        assert found.largest_high[1] - found.largest[1] == pytest.approx(bend * step**2 / 8, rel=1e-9)
