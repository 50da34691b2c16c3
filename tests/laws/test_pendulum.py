"""The laws of a swinging load: against scipy's elliptic integrals, equations of motion and equilibria written anew."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipkm1

from ptmcalc.laws import pendulum

G = 9.81


def exact(
    length: float, push: Callable[[float], float], breaks: tuple[float, ...], start: tuple[float, float] = (0.0, 0.0)
) -> tuple[np.ndarray, np.ndarray]:
    """Angles behind a pivot, L theta'' = -g sin(theta) + a cos(theta), at many times, and the last state."""
    y, before, seen = np.array(start), 0.0, [start[0]]
    for stop in breaks:
        a = push((before + stop) / 2)
        run = solve_ivp(
            lambda t, y, a: [y[1], (a * math.cos(y[0]) - G * math.sin(y[0])) / length],
            (before, stop), y, "DOP853", rtol=1e-13, atol=1e-15, args=(a,), dense_output=True,
        )  # fmt: skip
        seen += run.sol(np.linspace(before, stop, 3000))[0].tolist()
        y, before = run.y[:, -1], stop
    return np.array(seen), y


def amplitude(length: float, state: np.ndarray) -> float:
    energy = 2 * math.sin(state[0] / 2) ** 2 + length * state[1] ** 2 / (2 * G)
    return 2 * math.asin(math.sqrt(energy / 2)) if energy < 2 else math.pi


class TestPeriods:
    @pytest.mark.parametrize("angle", [0.0, 1e-9, 0.1, 1.0, 2.5, 3.14])
    def test_the_elliptic_integral(self, angle: float) -> None:
        wanted = 4 * math.sqrt(7 / G) * ellipkm1(math.cos(angle / 2) ** 2)
        assert float(pendulum.swing_period(7.0, G, angle)) == pytest.approx(wanted, rel=1e-12)

    def test_a_small_swing_has_the_frequency(self) -> None:
        assert float(pendulum.swing_period(7.0, G, 0.0) * pendulum.swing_frequency(7.0, G)) == pytest.approx(math.tau)
        longer = float(pendulum.swing_period(7.0, G, 0.1) / pendulum.swing_period(7.0, G, 0.0))
        assert longer == pytest.approx(1 + 0.1**2 / 16, abs=1e-6)

    @pytest.mark.parametrize("ratio", [1e-9, 0.3, 5.0])
    def test_a_free_trolley(self, ratio: float) -> None:
        """The eigenvalue of both equations of motion."""
        m, length = 2e3, 6.0
        load = ratio * m
        mass = np.array([[m + load, load * length], [load * length, load * length**2]])
        stiff = np.array([[0.0, 0.0], [0.0, load * G * length]])
        values = np.linalg.eigvals(np.linalg.solve(mass, stiff))
        assert float(pendulum.driven_frequency(length, G, load, m)) ** 2 == pytest.approx(max(values.real), rel=1e-12)


class TestStarts:
    @pytest.mark.parametrize("a", [0.01, 0.4, 3.0, 9.81, 40.0])
    def test_a_sudden_acceleration(self, a: float) -> None:
        seen, _ = exact(5.0, lambda t: a, (9.0,))
        assert float(pendulum.largest_lean(a, G)) == pytest.approx(seen.max(), rel=1e-6)
        assert float(pendulum.steady_lean(a, G)) == pytest.approx(seen.max() / 2, rel=1e-6)

    @pytest.mark.parametrize("ratio", [0.1, 1.0, 8.0])
    @pytest.mark.parametrize("push", [0.3, 6.0])
    def test_a_force_on_the_trolley_leans_it_as_far_as_the_acceleration_of_both(
        self, push: float, ratio: float
    ) -> None:
        length = 4.0

        def rate(t: float, y: np.ndarray) -> list[float]:
            sine, cosine = math.sin(y[0]), math.cos(y[0])  # ahead; force per trolley mass push (1 + M/m)
            matrix = [[1 + ratio, ratio * length * cosine], [cosine, length]]
            right = [push * (1 + ratio) + ratio * length * y[1] ** 2 * sine, -G * sine]
            return [y[1], float(np.linalg.solve(matrix, right)[1])]

        run = solve_ivp(rate, (0, 8), [0, 0], "DOP853", rtol=1e-11, atol=1e-13, dense_output=True)
        assert float(pendulum.largest_lean(push, G)) == pytest.approx(
            -run.sol(np.linspace(0, 8, 5000))[0].min(), rel=1e-5
        )

    @pytest.mark.parametrize("ratio", [0.2, 2.0])
    def test_a_light_trolley_leads_and_lags(self, ratio: float) -> None:
        a, omega = 0.01, float(pendulum.driven_frequency(6.0, G, ratio, 1.0))

        def rate(t: float, y: np.ndarray) -> list[float]:  # masses 1 and ratio, small angles, tension ratio g
            pull = ratio * G * (y[2] - y[0]) / 6.0
            return [y[1], a * (1 + ratio) + pull, y[3], -pull / ratio]

        run = solve_ivp(rate, (0, 12), [0, 0, 0, 0], "DOP853", rtol=1e-12, atol=1e-14, dense_output=True)
        t = np.linspace(0, 12, 4000)
        assert pendulum.driven_slow_down(a, omega, ratio) == pytest.approx((run.sol(t)[1] - a * t).max(), rel=1e-5)

    @pytest.mark.parametrize("a", [0.01, 1.0, 3.7, 3.72, 5.0, 30.0])
    def test_the_force_on_the_pivot(self, a: float) -> None:
        length = 3.0
        run = solve_ivp(
            lambda t, y: [y[1], (a * math.cos(y[0]) - G * math.sin(y[0])) / length],
            (0, 4), [0, 0], "DOP853", rtol=1e-12, atol=1e-14, dense_output=True,
        )  # fmt: skip
        angle, rate = run.sol(np.linspace(0, 4, 200_000))
        tension = G * np.cos(angle) + a * np.sin(angle) + length * rate**2
        assert pendulum.swing_force(700.0, a, G) == pytest.approx(
            700 * float((tension * np.sin(angle)).max()), rel=1e-8
        )
        assert tension.min() > G * (1 - 1e-6)


class TestRamps:
    @pytest.mark.parametrize("a", [1e-3, 0.4, 4.0, 9.0])
    @pytest.mark.parametrize("time", [1e-3, 0.3, 1.9, 2.4, 3.7, 6.0, 40.0])
    def test_of_any_angle(self, a: float, time: float) -> None:
        seen, state = exact(7.0, lambda t: a, (time,))
        left = amplitude(7.0, state)
        largest, residual = pendulum.ramp_swing(a, G, 7.0, time)
        assert residual == pytest.approx(left, rel=1e-9, abs=1e-11)
        assert largest == pytest.approx(max(left, float(seen.max())), rel=1e-5)

    @pytest.mark.parametrize("time", [1e-6, 0.4, 3.0, 5.307, 77.0])
    def test_small_angles_are_its_limit(self, time: float) -> None:
        omega = float(pendulum.swing_frequency(7.0, G))
        small = float(pendulum.ramp_residual(1e-7, G, omega, time))
        assert pendulum.ramp_swing(1e-7, G, 7.0, time)[1] == pytest.approx(small, rel=1e-7, abs=1e-18)

    @pytest.mark.parametrize("halves", [1.0 + 1e-6, 1.005, 1.02, 2.3])
    def test_a_ramp_of_half_a_swing_or_more_comes_to_twice_the_tilt(self, halves: float) -> None:
        a, length = 0.3 * G, 7.0
        frequency = math.sqrt(math.hypot(a, G) / length)
        half = 2 * float(ellipkm1(math.cos(math.atan(0.3) / 2) ** 2)) / frequency
        assert pendulum.ramp_swing(a, G, length, halves * half)[0] >= 2 * math.atan(0.3) * (1 - 1e-12)

    @pytest.mark.parametrize("time", [0.4, 77.0])
    def test_without_acceleration_nothing_swings(self, time: float) -> None:
        assert pendulum.ramp_swing(0.0, G, 7.0, time) == (0.0, 0.0)

    def test_a_load_that_goes_over_the_top(self) -> None:
        assert pendulum.ramp_swing(60.0, G, 7.0, 0.9)[1] == math.pi

    @pytest.mark.parametrize("seed", range(6))
    def test_start_and_stop(self, seed: int) -> None:
        v, t1, tr, t2 = np.random.default_rng(seed).uniform(0.1, 9, 4).tolist()
        omega = 1.3
        t = np.linspace(0, t1, 20_001), np.linspace(t1 + tr, t1 + tr + t2, 20_001)
        wave = [np.trapezoid(np.exp(1j * omega * one), one) for one in t]
        wanted = omega / G * abs(v / t1 * wave[0] - v / t2 * wave[1])
        assert pendulum.start_stop_residual(v, G, omega, t1, tr, t2) == pytest.approx(wanted, rel=1e-5)

    def test_jumps_and_equal_ramps(self) -> None:
        v, omega = 0.8, 1.3
        jumped = pendulum.start_stop_residual(v, G, omega, 0.0, math.pi / omega, 0.0)
        assert jumped == pytest.approx(2 * v * omega / G)
        assert pendulum.start_stop_residual(v, G, omega, 3.0, 2 * math.tau / omega - 3.0, 3.0) == pytest.approx(
            0, abs=1e-15
        )

    def test_the_ramp_that_leaves_nothing(self) -> None:
        period = float(pendulum.swing_period(7.0, G, 0.0))
        assert pendulum.cancelling_ramp(1.0, 0.1, period) == pytest.approx(2 * period)
        assert pendulum.cancelling_ramp(1.0, 90.0, period) == period
        assert pendulum.cancelling_ramp(1.0, 1 / (3 * period), period) == pytest.approx(3 * period)
        _, left = pendulum.ramp_swing(1 / period, G, 7.0, period)
        assert 0 < left < 1e-4  # at finite angles the swing is a little longer than the ramp


class TestHoisting:
    @pytest.mark.parametrize("speed", [0.05, 0.6, 4.0])
    @pytest.mark.parametrize(("l0", "l1"), [(20.0, 3.0), (3.0, 20.0)])
    def test_the_interval_holds_every_phase_and_is_not_much_too_wide(self, l0: float, l1: float, speed: float) -> None:
        v = math.copysign(speed, l1 - l0)

        def rate(t: float, y: np.ndarray) -> list[float]:
            return [y[1], -(2 * v * y[1] + G * y[0]) / (l0 + v * t)]

        found = []
        for phase in np.linspace(0, math.pi, 24, endpoint=False):
            start = [0.01 * math.cos(phase), 0.01 * math.sin(phase) * math.sqrt(G / l0)]
            end = solve_ivp(rate, (0, (l1 - l0) / v), start, "DOP853", rtol=1e-11, atol=1e-14).y[:, -1]
            found.append(math.hypot(end[0], end[1] / math.sqrt(G / l1)))
        low, high = pendulum.hoisted_angle_bounds(0.01, l0, l1, v, G)
        assert low <= min(found)
        assert max(found) <= high
        slow = float(pendulum.hoisted_angle(0.01, l0, l1))
        third = [slow * (one / slow) ** (1 / 3) for one in (low, high)]
        assert min(found) < third[0] or max(found) > third[1]

    def test_the_interval_by_hand(self) -> None:
        """From e = 4/3 on 1/4 of the rope to e = 2/3 on all of it: asinh(1/2) + asinh(1/4) + 1/8, g L/V^2 = 9/4."""
        low, high = pendulum.hoisted_angle_bounds(0.01, 1.0, 4.0, 4.0, 9.0)
        exponent = math.log(0.5 + math.sqrt(1.25)) + math.log(0.25 + math.sqrt(1.0625)) + 0.125
        assert low == pytest.approx(0.01 * 0.25**0.75 * math.exp(-exponent), rel=1e-13)
        assert high == pytest.approx(0.01 * 0.25**0.75 * math.exp(exponent), rel=1e-13)


class TestSlewing:
    @pytest.mark.parametrize("speed", [1e-6, 0.2, 1.0, 1.1, 9.0])
    @pytest.mark.parametrize("radius", [1e-9, 0.3, 40.0])
    def test_equilibrium(self, speed: float, radius: float) -> None:
        theta = pendulum.slewing_lean(speed, radius, 8.0, G)
        pull = speed**2 * (radius + 8 * math.sin(theta))
        assert G * math.sin(theta) == pytest.approx(pull * math.cos(theta), rel=1e-9)
        assert 0 < theta < math.pi / 2

    def test_under_the_axis(self) -> None:
        assert pendulum.slewing_lean(1.0, 0.0, 8.0, G) == 0.0
        assert math.cos(pendulum.slewing_lean(2.0, 0.0, 8.0, G)) == pytest.approx(G / 32)


class TestSmallAngles:
    def test_the_bound_holds_the_linear_swing_and_a_third_of_it_would_not(self) -> None:
        rng, used = np.random.default_rng(3), []
        for k in range(80):
            length, a, time = 10 ** rng.uniform(0, 1.3), rng.uniform(0.1, 2.5), rng.uniform(0.5, 6.0)
            first = 0.0
            if k % 2:  # let go at an angle
                a, first, time = 0.0, rng.uniform(0.05, 0.5), rng.uniform(0.05, 2.0)
            omega = math.sqrt(G / length)
            _, state = exact(length, lambda t, a=a: a, (time,), (first, 0.0))
            off, turn = first - a / G, omega * time
            linear = np.array([a / G + off * math.cos(turn), -off * math.sin(turn)])
            largest = max(first, a / G * (2 if turn > math.pi else 1 - math.cos(turn)))
            bound = pendulum.small_angle_error(largest, turn, omega / G * a * time)
            missed = math.hypot(state[0] - linear[0], state[1] / omega - linear[1])
            assert missed <= bound
            used.append(missed / bound)
        assert max(used) > 1 / 3

    @pytest.mark.parametrize("reach", [0.05, 0.5, 1.5])
    def test_the_smaller_root_up_to_where_both_are_one(self, reach: float) -> None:
        """Without a push H^3 - 3 r^2 H + 3 r^2 A = 0, phase = 2/r^2: H = 2 r sin(arcsin(3 A/2 r)/3)."""
        for share in (0.3, 0.99, 1 - 1e-5, 1 - 1e-8):
            angle = 2 / 3 * reach * share
            root = 2 * reach * math.sin(math.asin(share) / 3)
            assert pendulum.small_angle_error(angle, 2 / reach**2, 0.0) == pytest.approx(root - angle, rel=1e-9)
        assert pendulum.small_angle_error(2 / 3 * reach * (1 + 1e-8), 2 / reach**2, 0.0) == math.inf

    def test_no_bound_for_large_angles(self) -> None:
        assert pendulum.small_angle_error(1.0, 50.0, 3.0) == math.inf
        assert pendulum.small_angle_error(0.0, 50.0, 3.0) == 0.0


@pytest.mark.parametrize(("exponent", "known"), [(99.9, True), (100.5, False)])
def test_a_bound_of_a_swing_by_e_to_the_hundredth_is_none(exponent: float, known: bool) -> None:
    """Lengths alike: 2 asinh(3 e/8) = x for e = 8 sinh(x/2)/3."""
    speed = 8 / 3 * math.sinh(exponent / 2) * math.sqrt(G * 5.0)
    low, high = pendulum.hoisted_angle_bounds(0.01, 5.0, 5.0, speed, G)
    assert low == pytest.approx(0.01 * math.exp(-exponent), rel=1e-9)
    assert high == (pytest.approx(0.01 * math.exp(exponent), rel=1e-9) if known else math.inf)


@pytest.mark.parametrize("turns", [(0.4, 0.7), (0.995, 0.5), (1.005, 0.5), (0.5, 1.005), (1.005, 1.3), (2.3, 0.995)])
def test_what_two_ramps_leave_is_the_sum_of_two_turned_jumps(turns: tuple[float, float]) -> None:
    """e_1 - e_2 exp(i w (t_1/2 + t_r + t_2/2)) as a complex number, on both sides of where a ramp cancels itself."""
    w = 1.7
    t1, t2 = (2 * math.pi * turn / w for turn in turns)
    one, two = (math.sin(w * t / 2) / (w * t / 2) for t in (t1, t2))
    for run in (0.0, 0.9, 2.5):
        phase = w * (t1 / 2 + run + t2 / 2)
        left = abs(one - two * complex(math.cos(phase), math.sin(phase)))
        found = pendulum.start_stop_residual(2.0, G, w, t1, run, t2)
        assert found == pytest.approx(2.0 * w / G * left, rel=1e-10)
