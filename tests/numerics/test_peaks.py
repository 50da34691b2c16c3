"""Extremes of sampled signals against the signals themselves."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ptmcalc.numerics.peaks import largest, smallest


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
