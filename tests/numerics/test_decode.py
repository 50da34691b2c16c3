"""Speed records: against polynomials, against numpy's own least squares and against the scatter of seeded noise."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.special import gammaincinv

from ptmcalc.numerics import decode

CUBIC = np.polynomial.Polynomial([40.0, 6.0, -1.5, 0.25])
TIME = np.sort(np.random.default_rng(3).uniform(0.0, 8.0, 400))
"""At any times, as a counter of teeth tells them."""


def corner(noise: float, seed: int = 5) -> tuple[np.ndarray, np.ndarray]:
    """A run-up at 12 rad/s^2 that ends at once at 48 rad/s."""
    time = np.linspace(0.0, 8.0, 1601)
    return time, np.minimum(12.0 * time, 48.0) + noise * np.random.default_rng(seed).standard_normal(len(time))


@pytest.mark.parametrize("window", [None, 9, 57])
def test_a_cubic_is_read_off_as_it_is(window: int | None) -> None:
    found = decode.fit(TIME, CUBIC(TIME), window)
    np.testing.assert_allclose(found.speed, CUBIC(TIME), rtol=1e-9)
    np.testing.assert_allclose(found.acceleration, CUBIC.deriv()(TIME), rtol=1e-6, atol=1e-6)
    whole = CUBIC.integ()
    np.testing.assert_allclose(found.angle, whole(TIME) - whole(TIME[0]), rtol=1e-12)
    assert found.noise < 1e-12 * 40


def test_the_deviations_are_those_of_least_squares_on_the_same_samples() -> None:
    rough = CUBIC(TIME) + 0.3 * np.random.default_rng(1).standard_normal(len(TIME))
    found = decode.fit(TIME, rough, 39)
    for k in (0, 5, 120, 233, 399):
        first, last = found.first[k], found.last[k]
        assert last - first == 38
        assert first <= k <= last
        x = TIME[first : last + 1] - TIME[k]
        fitted, covariance = np.polyfit(x, rough[first : last + 1], 3, cov="unscaled")
        assert found.speed[k] == pytest.approx(fitted[-1], rel=1e-9)
        assert found.acceleration[k] == pytest.approx(fitted[-2], rel=1e-7, abs=1e-7)
        squared = found.noise**2
        assert found.speed_variance[k] == pytest.approx(squared * covariance[-1, -1], rel=1e-7)
        assert found.acceleration_variance[k] == pytest.approx(squared * covariance[-2, -2], rel=1e-7)
        assert found.covariance[k] == pytest.approx(squared * covariance[-1, -2], rel=1e-6, abs=1e-9 * squared)


def test_the_noise_is_that_of_the_samples() -> None:
    """Five standard deviations of the median of 4000 residuals over strongly overlapping stretches are 6 %."""
    time = np.linspace(0.0, 8.0, 4000)
    found = decode.fit(time, CUBIC(time) + 0.3 * np.random.default_rng(2).standard_normal(len(time)))
    assert found.noise == pytest.approx(0.3, rel=0.06)


@pytest.mark.parametrize("size", [5, 6, 11])
def test_residuals_are_counted_over_what_a_cubic_leaves_free(size: int) -> None:
    """Four of the samples of a stretch it goes through anyway."""
    rng = np.random.default_rng(size)
    time = np.sort(rng.uniform(0, 1, 40))
    speed = rng.normal(size=40)
    fits, variances = decode._at_all(time, speed, size)
    for k in (0, 17, 39):
        first, last = int(fits[5, k]), int(fits[6, k]) + 1
        assert last - first == size
        if k == 17:
            assert abs((k - first) - (last - 1 - k)) <= 1, "it stands in the middle of what is fitted around it"
        _, (squares, *_) = np.polynomial.Polynomial.fit(time[first:last], speed[first:last], 3, full=True)
        assert variances[k] == pytest.approx(float(squares[0]) / (size - 4), rel=1e-9)


def test_units_of_time_and_speed_change_no_choice() -> None:
    time, speed = corner(0.2)
    one, other = decode.fit(time, speed), decode.fit(time * 60.0, speed * 9.5)
    np.testing.assert_array_equal(one.first, other.first)
    np.testing.assert_array_equal(one.last, other.last)
    np.testing.assert_allclose(other.acceleration, one.acceleration * 9.5 / 60.0, rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(other.acceleration_variance, one.acceleration_variance * (9.5 / 60.0) ** 2, rtol=1e-6)
    np.testing.assert_allclose(other.covariance, one.covariance * 9.5**2 / 60.0, rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(other.angle, one.angle * 9.5 * 60.0, rtol=1e-9)


def test_stretches_are_as_long_as_the_motion_and_the_noise_let_them_be() -> None:
    """Two samples a hundredth of a second: far from the corner the longest stretch there is, beside it a short one, the
    longer the more noise there is."""
    beside = []
    for noise in (0.02, 0.2, 2.0):
        time, speed = corner(noise)
        found = decode.fit(time, speed)
        sizes, at = found.last - found.first + 1, np.abs(time - 4.0)
        assert np.median(sizes[at > 2.0]) == 555
        beside.append(np.median(sizes[at < 0.3]))
    assert beside[0] < beside[1] <= 121 < beside[2]


def test_the_acceleration_lies_within_its_deviation_beside_a_corner_too() -> None:
    """Three standard deviations hold at 97 % of the samples of every record, the corner with them."""
    for seed in range(4):
        time, speed = corner(0.2, seed)
        found = decode.fit(time, speed)
        true = np.where(time < 4.0, 12.0, 0.0)
        apart = np.abs(found.acceleration - true) / np.sqrt(found.acceleration_variance)
        assert np.mean(apart[time != 4.0] < 3.0) > 0.97


def test_fits_that_are_apart_share_no_sample() -> None:
    found = decode.fit(*corner(0.2))
    chosen = found.apart(100, 1500)
    assert len(chosen) >= 4
    assert found.first[chosen[0]] >= 100
    assert found.last[chosen[-1]] <= 1500
    assert (found.first[chosen[1:]] > found.last[chosen[:-1]]).all()


def test_every_fit_of_a_stretch_counts_from_the_first_to_the_last() -> None:
    """Stretches of a sample each; and some that overlap, of which the first in turn are taken."""
    found = decode.fit(*corner(0.2))
    each = np.arange(len(found.time))
    assert replace(found, first=each, last=each).apart(3, 9).tolist() == [3, 4, 5, 6, 7, 8, 9]
    some = replace(found, first=np.array([0, 0, 1, 3, 3, 5]), last=np.array([2, 2, 3, 4, 5, 5]))
    assert some.apart(0, 5).tolist() == [0, 3, 5]
    assert some.apart(1, 4).tolist() == [2]


def test_the_torque_and_its_deviation_follow_from_its_derivatives() -> None:
    """M = J eps + w^2 J'/2; the deviation by central differences in w and eps and the covariance of both."""
    found = decode.fit(*corner(0.2))
    n = len(found.time)
    inertia, slope = 2.0 + np.sin(np.arange(n) / 50.0), 0.04 * np.cos(np.arange(n) / 50.0)
    value, deviation = decode.torque(found, inertia, slope)
    np.testing.assert_allclose(value, inertia * found.acceleration + found.speed**2 * slope / 2, rtol=1e-12)

    def change(name: str) -> np.ndarray:
        up, down = (
            decode.torque(replace(found, **{name: getattr(found, name) + step}), inertia, slope)[0]
            for step in (1e-3, -1e-3)
        )
        return (up - down) / 2e-3

    by_speed, by_rate = change("speed"), change("acceleration")
    squared = (
        by_speed**2 * found.speed_variance
        + by_rate**2 * found.acceleration_variance
        + 2 * by_speed * by_rate * found.covariance
    )
    np.testing.assert_allclose(deviation, np.sqrt(squared), rtol=1e-6)


def test_when_a_record_begins_changes_nothing() -> None:
    time = np.linspace(0.0, 1.0, 65)
    speed = 3.0 + np.sin(3.0 * time)
    one = decode.fit(time, speed)
    for begin in (64.0, -0.5, 4096.0):
        other = decode.fit(time + begin, speed)
        assert other.speed == pytest.approx(one.speed, rel=1e-9)
        assert other.acceleration == pytest.approx(one.acceleration, rel=1e-7, abs=1e-7)
        assert other.acceleration_variance == pytest.approx(one.acceleration_variance, rel=1e-6)


def test_the_mean_of_two_points_scatters_by_half_their_distance() -> None:
    """chi^2 = 2 (d/2 s)^2 of one degree of freedom; two that agree have s/2^(1/2)."""
    assert decode.mean(np.array([0.0, 6.0]), np.full(2, 0.5)) == pytest.approx((3.0, 3.0), rel=1e-12)
    assert decode.mean(np.array([3.0, 3.1]), np.full(2, 0.5)) == pytest.approx((3.05, 0.5 / np.sqrt(2)), rel=1e-12)


class TestLine:
    def test_three_points_have_one_that_scatters(self) -> None:
        """y = 0, d, 0 at -1, 0, 1: off the line by -d/3, 2 d/3, -d/3, chi^2 = 2/3 (d/s)^2 of one degree of freedom."""
        found = decode.line(np.array([-1.0, 0.0, 1.0]), np.array([0.0, 6.0, 0.0]), np.full(3, 0.5))
        chi = np.sqrt(2 / 3) * 6.0 / 0.5
        assert (found.offset, found.slope) == pytest.approx((2.0, 0.0), abs=1e-12)
        assert found.offset_deviation == pytest.approx(chi * 0.5 / np.sqrt(3), rel=1e-12)
        assert found.slope_deviation == pytest.approx(chi * 0.5 / np.sqrt(2), rel=1e-12)

    X = np.array([0.0, 1.0, 2.0, 4.0, 7.0])
    DEVIATION = np.array([0.1, 0.2, 0.1, 0.4, 0.2])

    def test_points_that_scatter_less_than_they_may(self) -> None:
        y = 3.0 - 0.5 * self.X + 0.1 * self.DEVIATION * np.array([1, -1, 1, -1, 1])
        fitted, covariance = np.polyfit(self.X, y, 1, w=1 / self.DEVIATION, cov="unscaled")
        found = decode.line(self.X, y, self.DEVIATION)
        assert (found.slope, found.offset) == pytest.approx(tuple(fitted), rel=1e-12)
        deviations = (found.slope_deviation, found.offset_deviation)
        assert deviations == pytest.approx(tuple(np.sqrt(np.diag(covariance))), rel=1e-12)

    def test_points_that_scatter_more(self) -> None:
        """The covariance grows by chi^2/(n - 2), as that of `polyfit` does."""
        y = 3.0 - 0.5 * self.X + 5 * self.DEVIATION * np.array([1, -1, 1, -1, 1])
        covariance = np.polyfit(self.X, y, 1, w=1 / self.DEVIATION, cov=True)[1]
        found = decode.line(self.X, y, self.DEVIATION)
        deviations = (found.slope_deviation, found.offset_deviation)
        assert deviations == pytest.approx(tuple(np.sqrt(np.diag(covariance))), rel=1e-12)

    @pytest.mark.parametrize("scatter", [0.1, 5.0])
    def test_a_mean_is_a_line_without_a_slope(self, scatter: float) -> None:
        y = 3.0 + scatter * self.DEVIATION * np.array([1, -1, 1, -1, 1])
        fitted, covariance = np.polyfit(self.X, y, 0, w=1 / self.DEVIATION, cov=True if scatter > 1 else "unscaled")
        assert decode.mean(y, self.DEVIATION) == pytest.approx((fitted[0], np.sqrt(covariance[0, 0])), rel=1e-12)


@pytest.mark.parametrize("size", [1e-60, 1.0, 1e60])
def test_a_deviation_counts_down_to_a_millionth_of_a_millionth(size: float) -> None:
    """Of the largest value; where all of them say nothing, they weigh alike."""
    y = size * np.array([1.0, 1.0, 1.0, 1.0])
    for deviation, counts in ((1e-10, 1e-10), (1e-11, 1e-11), (1e-14, 1e-12), (0.0, 1e-12)):
        value, spread = decode.mean(y, np.full(4, deviation * size))
        assert value == pytest.approx(size, rel=1e-14)
        assert spread == pytest.approx(counts * size / 2, rel=1e-12)


def test_a_shaft_that_turns_evenly_has_no_torque() -> None:
    """To the last digit: neither its torques nor their deviations are anything but 0."""
    found = decode.fit(np.linspace(0.0, 1.0, 50), np.full(50, 3.0))
    value, deviation = decode.torque(found, np.full(50, 2.0), np.zeros(50))
    assert decode.mean(value, deviation)[0] == 0.0
    line = decode.line(np.arange(50.0), value, deviation)
    assert (line.offset, line.slope) == (0.0, 0.0)
    assert 0 <= line.slope_deviation < 1e-90


@pytest.mark.parametrize(("apart", "taken"), [(3.99, 1), (4.01, 0)])
def test_stretches_are_taken_as_long_as_twice_their_deviations_have_a_value_in_common(apart: float, taken: int) -> None:
    fits = np.ones((3, 7, 40))
    fits[:, 1] = np.array([0.3, 0.3 + apart * 0.7 * 1.1, 50.0])[:, None]
    fits[:, 3] = 1.1**2
    assert decode._chosen(fits, 0.7).tolist() == [taken] * 40


def test_no_single_sample_stands_out_by_chance() -> None:
    """The median over fifteen: seven in a row change nothing, eight do."""
    for count, taken in ((7, 0), (8, 1)):
        fits = np.zeros((2, 7, 60))
        fits[:, 3] = 1.0
        fits[1, 1] = 5.0
        fits[1, 1, 20 : 20 + count] = 0.0
        assert int(decode._chosen(fits, 1.0).max()) == taken


def test_the_median_of_residuals_is_that_of_chi_squared() -> None:
    """Nine samples less the four numbers of a cubic leave five degrees of freedom."""
    assert pytest.approx(2 * float(gammaincinv(2.5, 0.5)) / 5, rel=1e-3) == decode._MEDIAN


def test_what_a_stretch_does_not_follow_is_twice_what_it_has_changed_by() -> None:
    time, speed = corner(0.2)
    found = decode.fit(time, speed)
    sizes = (found.last - found.first + 1).tolist()
    whole = sorted(set(sizes))
    assert len(whole) >= 4
    alone = {size: decode.fit(time, speed, size) for size in {9, 13, 19, 27, 39, 57, 83, 121, 177, 259, 379, 555}}
    shorter = dict(zip(sorted(alone)[1:], sorted(alone), strict=False))
    looked = 0
    for k in range(0, len(time), 37):
        one = alone[sizes[k]]
        assert found.acceleration[k] == pytest.approx(one.acceleration[k], rel=1e-12)
        if sizes[k] > 9:
            changed = one.acceleration[k] - alone[shorter[sizes[k]]].acceleration[k]
            plain = one.acceleration_variance[k]
            assert found.acceleration_variance[k] == pytest.approx(plain + 4 * changed**2, rel=1e-9)
            looked += 1
    assert looked > 20


def test_a_sample_stands_in_the_middle_of_every_stretch() -> None:
    """So that an even power about it leaves its acceleration alone; each stretch is about half as long again."""
    time = np.linspace(-1.0, 1.0, 601)
    for size in decode._SIZES:
        fits = decode._at_all(time, time**4, size)[0]
        assert fits[1, 300] == pytest.approx(0.0, abs=1e-10)
        assert fits[5, 300] + fits[6, 300] == 600
    sizes = np.array(decode._SIZES)
    np.testing.assert_allclose(sizes[1:] / sizes[:-1], 1.46, rtol=0.03)


def test_a_window_too_short_for_a_cubic_is_made_long_enough() -> None:
    found = decode.fit(TIME, CUBIC(TIME) + np.sin(40 * TIME), 2)
    assert set((found.last - found.first).tolist()) == {4}
    assert set((decode.fit(TIME[:12], TIME[:12], 99).last + 1).tolist()) == {12}
