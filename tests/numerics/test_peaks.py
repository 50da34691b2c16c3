"""Extremes of sampled signals against the signals themselves."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ptmcalc.numerics.peaks import gap, largest, smallest


@pytest.mark.parametrize("shift", np.linspace(0, 0.999, 7))
def test_smooth_peak_between_samples(shift: float) -> None:
    step = 0.05
    times = np.arange(200) * step
    signal = np.sin(times + shift * step)
    value, time = largest(signal, step)
    assert value == pytest.approx(1.0, abs=2e-6)
    assert np.sin(time + shift * step) == pytest.approx(1.0, abs=1e-4)


@pytest.mark.parametrize("shift", np.linspace(0, 0.999, 7))
def test_corner_between_samples(shift: float) -> None:
    """Two straight lines that meet between two samples: their crossing is found exactly."""
    step = 0.1
    corner = 3.0 + shift * step
    times = np.arange(80) * step
    value, time = largest(np.where(times < corner, times, 5 * corner - 4 * times), step)
    assert value == pytest.approx(corner, rel=1e-12)
    assert time == pytest.approx(corner, rel=1e-9)


def test_corner_on_a_sample_is_exact() -> None:
    times = np.arange(101) * 0.1
    value, time = largest(-np.abs(times - 5.0), 0.1)
    assert (value, time) == pytest.approx((0.0, 5.0), abs=1e-12)


def test_order_at_smooth_peaks() -> None:
    """The error falls at least with the third power of the step."""
    errors = []
    for n in (40, 80, 160, 320):
        times = np.linspace(0, 4, n + 1)
        errors.append(abs(largest(np.exp(-((times - 1.7371) ** 2) * 3), 4 / n)[0] - 1.0))
    orders = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    assert np.median(orders) > 2.5


@given(st.lists(st.floats(-1e6, 1e6), min_size=1, max_size=40))
def test_never_below_the_samples(values: list[float]) -> None:
    samples = np.array(values)
    assert largest(samples, 1.0)[0] >= samples.max()
    assert smallest(samples, 1.0)[0] <= samples.min()


def test_ends_of_the_window_count() -> None:
    ramp = np.arange(20.0)
    assert largest(ramp, 1.0) == (19.0, 19.0)
    assert smallest(ramp, 1.0) == (0.0, 0.0)


@pytest.mark.parametrize("seed", range(60))
def test_two_parabolas_that_meet_within_a_cell_are_seen_exactly(seed: int) -> None:
    """A rising one and a falling one, each bent downward: their crossing, or the vertex of either beside it."""
    rng = np.random.default_rng(seed)
    step, corner, height = 10 ** rng.uniform(-2, 1), rng.uniform(5.05, 8.95), rng.normal()
    up, down = rng.uniform(0.05, 3.0, 2)
    bend, other = -(10 ** rng.uniform(-3, 0, 2))
    x = np.arange(15.0)

    def signal(at: np.ndarray) -> np.ndarray:
        t = at - corner
        return height + np.where(t < 0, up * t + bend * t * t, -down * t + other * t * t)

    value, time = largest(signal(x), step)
    assert value == pytest.approx(height, rel=1e-11, abs=1e-11)
    assert time == pytest.approx(corner * step, rel=1e-7)
    assert smallest(-signal(x), step) == (-value, time)


@pytest.mark.parametrize("seed", range(30))
def test_the_vertex_of_one_parabola_is_exact_to_rounding(seed: int) -> None:
    rng = np.random.default_rng(seed)
    step, top, height, bend = 10 ** rng.uniform(-2, 1), rng.uniform(3.02, 10.98), rng.normal(), -rng.uniform(0.1, 3)
    value, time = largest(height + bend * (np.arange(15.0) - top) ** 2, step)
    assert value == pytest.approx(height, rel=1e-12, abs=1e-12)
    assert time == pytest.approx(top * step, rel=1e-7)


def test_a_side_that_bends_upward_goes_on_straight() -> None:
    """Left of the corner t + t^2/4 from below: the last cord, not the parabola, which would overshoot."""
    x = np.arange(14.0)
    corner = 6.4
    signal = np.where(x < corner, 0.05 * x**2, 4.0 - 0.5 * (x - corner))
    left = 0.05 * 36 + 0.05 * (36 - 25) * (np.linspace(0, 1, 200_001))
    right = 4.0 - 0.5 * (6 + np.linspace(0, 1, 200_001) - corner)
    expected = np.minimum(left, right).max()
    assert largest(signal, 1.0)[0] == pytest.approx(max(expected, signal.max()), rel=1e-5)


@given(st.lists(st.floats(-1e3, 1e3), min_size=6, max_size=30), st.integers(-60, 60))
def test_the_unit_of_a_signal_does_not_matter(values: list[float], power: int) -> None:
    samples = np.round(np.array(values), 3)
    for read in (largest, smallest):
        value, time = read(samples, 0.5)
        assert read(samples * 2.0**power, 0.5) == (value * 2.0**power, time)


def test_six_samples_tell_what_is_between_the_middle_ones() -> None:
    """A parabola with its vertex there."""
    value, time = largest(2.0 - 0.3 * (np.arange(6.0) - 2.4) ** 2, 0.5)
    assert (value, time) == pytest.approx((2.0, 1.2), rel=1e-12)


def test_few_samples_are_what_is_known() -> None:
    assert largest(np.array([0.0, 3.0, 3.1, 0.2, 0.0]), 0.5) == (3.1, 1.0)
    assert largest(np.array([0.0, 3.0, 3.1, 0.2, 0.0, -0.1]), 0.5)[0] >= 3.1


def test_the_distance_from_the_range_of_others_beside() -> None:
    others = np.array([0.0, 1.0, 4.0, 2.0, -3.0, 0.5])
    assert gap(others, others, 0) == 0.0
    assert gap(others[[1, 1, 2, 2, 4, 4]] + 0.3, others, 1) == pytest.approx(0.3, rel=1e-12)  # 4.3 over 1 to 4
    assert gap(others - 7.0, others, 0) == pytest.approx(7.0, rel=1e-15)
    assert gap(np.array([9.0, 0, 0, 0, 0, 0]), others, 2) == pytest.approx(5.0, rel=1e-15)  # over 0, 1 and 4
    assert gap(np.array([9.0, 0, 0, 0, 0, 0]), others, 1) == pytest.approx(8.0, rel=1e-15)


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("mirrored", [False, True])
def test_a_vertex_beside_a_corner_in_its_cell_is_seen_exactly(seed: int, mirrored: bool) -> None:
    """A parabola turns, and breaks off before the next sample."""
    rng = np.random.default_rng(seed)
    top, bend, height = 6 + rng.uniform(0.15, 0.4), -rng.uniform(0.2, 2.0), rng.normal()
    corner, down, other = 6 + rng.uniform(0.6, 0.9), rng.uniform(3.0, 9.0), -rng.uniform(0.01, 0.3)
    x = np.arange(14.0)
    behind = height + bend * (corner - top) ** 2 - down * (x - corner) + other * (x - corner) ** 2
    signal = np.where(x < corner, height + bend * (x - top) ** 2, behind)
    value, time = largest(signal[::-1] if mirrored else signal, 0.25)
    assert value == pytest.approx(height, rel=1e-11, abs=1e-11)
    assert time == pytest.approx(0.25 * (13 - top if mirrored else top), rel=1e-6)
