"""Start profiles against quadrature and differences; their phases against Duhamel's integral of many oscillators.

Reference of the phases: x'' + w^2 x = w^2 q(t) from rest gives x - q = -integral of cos w(t - s) dq(s), so an
oscillator answers with two running integrals of the slope of q (Gauss points inside the rise, its jumps by hand) and no
closed form of any shape is used.
"""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad, solve_ivp

from ptmcalc.laws import start_profile
from ptmcalc.laws.start_profile import COSINE, PARABOLIC, RAMP, STEP, Phase

steady = settings(derandomize=True, database=None, deadline=None, max_examples=150)
RISE = 3.0
SHAPES = [STEP, RAMP, COSINE, PARABOLIC]
STARTS = [(STEP, False), *((shape, imposed) for imposed in (False, True) for shape in (RAMP, COSINE, PARABOLIC))]


class TestRise:
    @pytest.mark.parametrize(
        ("shape", "at", "value"),
        [
            (STEP, 0.0, 1.0), (STEP, 5.0, 1.0),
            (RAMP, 0.0, 0.0), (RAMP, 0.75, 0.25), (RAMP, 3.0, 1.0), (RAMP, 9.0, 1.0),
            (COSINE, 0.0, 0.0), (COSINE, 1.0, 0.25), (COSINE, 1.5, 0.5), (COSINE, 2.0, 0.75), (COSINE, 3.0, 1.0),
            (COSINE, 50.0, 1.0),
            (PARABOLIC, 0.0, 0.0), (PARABOLIC, 0.75, 0.125), (PARABOLIC, 1.5, 0.5), (PARABOLIC, 2.25, 0.875),
            (PARABOLIC, 3.0, 1.0), (PARABOLIC, 8.0, 1.0),
        ],
    )  # fmt: skip
    def test_values_by_hand(self, shape: str, at: float, value: float) -> None:
        """cos 60 = 1/2: the cosine is at a quarter after a third of its rise."""
        assert start_profile.rise(shape, RISE, at) == pytest.approx(value, rel=1e-14, abs=1e-16)

    def test_cosine_is_the_speed_of_a_crank(self) -> None:
        """A point that turns half round at constant speed shows (1 - cos)/2 from the side."""
        times = np.linspace(0, RISE, 50)
        shadow = [(1 - (np.exp(1j * math.pi * t / RISE)).real) / 2 for t in times]
        assert start_profile.rise(COSINE, RISE, times) == pytest.approx(shadow, abs=1e-15)

    @given(st.sampled_from(SHAPES), st.floats(1e-3, 1e3), st.floats(0, 1e4), st.floats(0, 1e4))
    @steady
    def test_rises_from_0_to_1_and_never_falls(self, shape: str, rise_time: float, one: float, other: float) -> None:
        early, late = start_profile.rise(shape, rise_time, np.sort([one, other]))
        assert 0 <= early <= late <= 1

    @pytest.mark.parametrize("shape", [*SHAPES, ((0.0, 0.0), (0.4, 0.9), (1.0, 1.0))])
    def test_never_comes_to_more_than_the_whole(self, shape: start_profile.Shape) -> None:
        assert start_profile.time_of_share(shape, RISE, np.array([1.0, 1.001, 1.9, 30.0])).tolist() == [
            0.0 if shape == STEP else RISE, math.inf, math.inf, math.inf,
        ]  # fmt: skip

    @given(st.floats(0, 1))
    @steady
    def test_cosine_is_symmetric_about_its_middle(self, share: float) -> None:
        up, down = start_profile.rise(COSINE, RISE, np.array([share * RISE, (1 - share) * RISE]))
        assert up + down == pytest.approx(1.0, rel=1e-12)


class TestRiseIntegral:
    @pytest.mark.parametrize("shape", [*SHAPES, ((0.0, 0.1), (0.4, 0.9), (0.8, 0.7), (1.0, 1.0))])
    @pytest.mark.parametrize("until", [0.0, 0.4, 1.512, 1.7, 3.0, 3.1, 20.0])
    def test_by_quadrature(self, shape: str, until: float) -> None:
        inside = quad(lambda t: start_profile.rise(shape, RISE, t), 0, min(until, RISE), epsabs=1e-14, epsrel=1e-13)[0]
        beyond = max(until - RISE, 0.0)  # the factor is 1 there
        assert start_profile.rise_integral(shape, RISE, until) == pytest.approx(inside + beyond, rel=1e-12, abs=1e-14)

    @pytest.mark.parametrize("shape", SHAPES[1:])
    def test_a_symmetric_rise_is_half_a_rise_time_late(self, shape: str) -> None:
        assert start_profile.rise_integral(shape, RISE, 10.0) == pytest.approx(10.0 - RISE / 2, rel=1e-14)

    @given(st.sampled_from(SHAPES), st.floats(1e-2, 1e2), st.floats(0, 1e3), st.floats(1e-3, 10))
    @steady
    def test_grows_by_no_less_than_the_first_value_and_no_more_than_the_last(
        self, shape: str, rise_time: float, start: float, length: float
    ) -> None:
        ends = np.array([start, start + length])
        low, high = start_profile.rise(shape, rise_time, ends) * length
        first, last = start_profile.rise_integral(shape, rise_time, ends)
        assert low - 1e-12 * last <= last - first <= high + 1e-12 * last


class TestTimeOfShare:
    @given(st.sampled_from(SHAPES[1:]), st.floats(1e-2, 1e2), st.floats(0, 1))
    @steady
    def test_is_the_inverse_of_the_rise(self, shape: str, rise_time: float, share: float) -> None:
        time = start_profile.time_of_share(shape, rise_time, share)
        assert 0 <= time <= rise_time * (1 + 1e-15)
        assert start_profile.rise(shape, rise_time, time) == pytest.approx(share, abs=1e-12)

    def test_a_parabola_on_both_sides_of_its_middle(self) -> None:
        """q = 2 x^2 up to a half, 1 - 2 (1 - x)^2 from there on."""
        share = np.linspace(0.49, 0.51, 21)
        expected = np.where(share < 0.5, (share / 2) ** 0.5, 1 - ((1 - share) / 2) ** 0.5)
        assert start_profile.time_of_share("parabolic", 1.0, share) == pytest.approx(expected, rel=1e-14)

    def test_the_first_time_where_a_table_rests(self) -> None:
        points = ((0.0, 0.2), (0.25, 0.5), (0.75, 0.5), (1.0, 1.0))
        times = start_profile.time_of_share(points, 8.0, [-1.0, 0.1, 0.2, 0.35, 0.5, 0.75, 1.0])
        assert times == pytest.approx([0.0, 0.0, 0.0, 1.0, 2.0, 7.0, 8.0])


class TestTimeToMomentum:
    @pytest.mark.parametrize("shape", SHAPES)
    @pytest.mark.parametrize("speed", [0.1, 1.0, 30.0])
    def test_an_integrated_body_is_that_fast_then(self, shape: str, speed: float) -> None:
        force, resistance, mass = 9e3, 4e3, 1200.0
        held = 0.0 if shape == "step" else float(start_profile.time_of_share(shape, RISE, resistance / force))
        found = float(start_profile.time_to_momentum(shape, RISE, force, resistance, held, mass * speed))

        def pull(time: float) -> float:
            return force * float(start_profile.rise(shape, RISE, held + time)) - resistance

        corner = [RISE - held] if 0 < RISE - held < found else None
        gathered = quad(pull, 0, found, points=corner, epsabs=1e-6, epsrel=1e-12, limit=200)[0]
        assert gathered == pytest.approx(mass * speed, rel=1e-9)


class TestRiseRate:
    @pytest.mark.parametrize("shape", SHAPES[1:])
    def test_by_differences(self, shape: str) -> None:
        times = np.concatenate([np.linspace(0.01, RISE - 0.01, 60), np.linspace(RISE + 0.01, 2 * RISE, 20)])
        h = 1e-3
        points = [start_profile.rise(shape, RISE, times + k * h) for k in (-2, -1, 1, 2)]
        slope = (points[0] - 8 * points[1] + 8 * points[2] - points[3]) / (12 * h)
        assert start_profile.rise_rate(shape, RISE, times) == pytest.approx(slope, abs=1e-11)

    @pytest.mark.parametrize("shape", SHAPES[1:])
    def test_adds_up_to_the_whole_rise(self, shape: str) -> None:
        whole = quad(lambda t: start_profile.rise_rate(shape, RISE, t), 0, RISE)[0]
        assert whole == pytest.approx(1.0, rel=1e-12)

    def test_at_its_ends(self) -> None:
        """At the end of the rise the slope from the left; nothing after it. The cosine leaves and arrives smoothly."""
        assert start_profile.rise_rate(RAMP, RISE, RISE) == pytest.approx(1 / RISE, rel=1e-15)
        assert start_profile.rise_rate(RAMP, RISE, np.nextafter(RISE, 4)) == 0.0
        assert start_profile.rise_rate(COSINE, RISE, 0.0) == 0.0
        assert abs(start_profile.rise_rate(COSINE, RISE, RISE)) < 1e-15

    @pytest.mark.parametrize(("shape", "rise_time"), [(shape, time) for shape in SHAPES[1:] for time in (0.3, 40.0)])
    def test_peak_is_the_largest_of_a_dense_sample(self, shape: str, rise_time: float) -> None:
        values = start_profile.rise(shape, rise_time, np.linspace(0, 1.5 * rise_time, 30001))
        steepest = float(np.max(np.diff(values))) / (1.5 * rise_time / 30000)
        corner = 1e-4 if shape == PARABOLIC else 1e-7  # a corner is missed by half a sample's way
        assert start_profile.peak_rate(shape, rise_time) == pytest.approx(steepest, rel=corner)


# --- phases -----------------------------------------------------------------------------------------------------


def load_slope(shape: str, imposed_speed: bool, share: np.ndarray) -> np.ndarray:
    """dq/d(t/t_s) inside the rise: q is the factor itself (torque), or its slope over its peak (speed)."""
    if shape == RAMP:
        return np.zeros_like(share) if imposed_speed else np.ones_like(share)
    if shape == PARABOLIC:
        return np.where(share < 0.5, 2.0, -2.0) if imposed_speed else 4 * np.minimum(share, 1 - share)
    angle = np.pi * share
    return np.pi * np.cos(angle) if imposed_speed else np.pi / 2 * np.sin(angle)


def jumps(shape: str, imposed_speed: bool) -> tuple[float, float]:
    """Jumps of q at the start and at the end of the rise."""
    if shape == RAMP and imposed_speed:
        return 1.0, -1.0
    return 0.0, 0.0


PANELS = 160
GAUSS_X, GAUSS_W = np.polynomial.legendre.leggauss(4)


def stray_of_modes(shape: str, imposed_speed: bool, frequencies: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Largest |x - q| of each undamped mode in the rise (t_s = 1) and in the two periods after it."""
    points = ((np.arange(PANELS)[:, None] + (GAUSS_X + 1) / 2) / PANELS).ravel()
    weights = np.tile(GAUSS_W / 2 / PANELS, PANELS) * load_slope(shape, imposed_speed, points)
    first, last = jumps(shape, imposed_speed)
    wave = np.exp(1j * frequencies[:, None] * points) * weights  # integral of e^{iws} dq(s)
    running = first + np.cumsum(wave.reshape(len(frequencies), PANELS, 4).sum(axis=2), axis=1)
    running = np.concatenate([np.full((len(frequencies), 1), first), running], axis=1)
    times = np.arange(PANELS + 1) / PANELS
    in_rise = (np.exp(-1j * frequencies[:, None] * times) * running).real
    end = running[:, -1] + last * np.exp(1j * frequencies)
    later = 1 + np.linspace(0, 4 * np.pi, 120) / frequencies[:, None]
    after = (np.exp(-1j * frequencies[:, None] * later) * end[:, None]).real
    return np.max(np.abs(in_rise), axis=1), np.max(np.abs(after), axis=1)


def random_frequencies(lowest: float, count: int, seed: int) -> np.ndarray:
    """Frequencies at and above the lowest one, up to where the quadrature is still exact to twelve digits."""
    rng = np.random.default_rng(seed)
    return lowest * np.exp(np.append(rng.uniform(0, math.log(max(120 / lowest, 1.5)), count), 0.0))


LOWEST = np.exp(np.linspace(math.log(0.05), math.log(100), 41)).tolist()


class TestReference:
    """The running integrals themselves against an ODE solver."""

    @pytest.mark.parametrize(("shape", "imposed_speed"), STARTS[1:])
    @pytest.mark.parametrize("frequency", [0.7, 3.3, 17.0])
    def test_running_integrals_are_the_motion_of_the_oscillator(
        self, shape: str, imposed_speed: bool, frequency: float
    ) -> None:
        def load(t: float) -> float:
            if shape == PARABOLIC:
                return 2 * min(t, 1 - t) if imposed_speed else 2 * t * t if t < 0.5 else 1 - 2 * (1 - t) ** 2
            if not imposed_speed:
                return t if shape == RAMP else (1 - math.cos(math.pi * t)) / 2
            return 1.0 if shape == RAMP else math.sin(math.pi * t)

        times = np.arange(PANELS + 1) / PANELS
        motion = solve_ivp(
            lambda t, y: [y[1], frequency**2 * (load(t) - y[0])],
            (0, 1), [0.0, 0.0], method="DOP853", t_eval=times, rtol=1e-12, atol=1e-13,
        )  # fmt: skip
        swing = np.max(np.abs(motion.y[0] - [load(t) for t in times]))
        in_rise, after = stray_of_modes(shape, imposed_speed, np.array([frequency]))
        assert in_rise[0] == pytest.approx(swing, rel=1e-9)
        rest = 0.0 if imposed_speed else 1.0
        amplitude = math.hypot(motion.y[0, -1] - rest, motion.y[1, -1] / frequency)
        assert after[0] == pytest.approx(amplitude, rel=6e-3)  # sampled 60 times a period


class TestPhases:
    @pytest.mark.parametrize(("shape", "imposed_speed"), STARTS[1:])
    @pytest.mark.parametrize("lowest", LOWEST)
    def test_no_mode_above_the_lowest_frequency_strays_further(
        self, shape: str, imposed_speed: bool, lowest: float
    ) -> None:
        claimed = start_profile.phases(shape, imposed_speed, RISE, lowest / RISE)
        in_rise, after = stray_of_modes(shape, imposed_speed, random_frequencies(lowest, 60, seed=3))
        assert in_rise.max() <= claimed[0].stray * (1 + 1e-9)
        assert after.max() <= claimed[1].stray * (1 + 1e-9)

    @pytest.mark.parametrize(("shape", "imposed_speed"), STARTS[1:])
    @pytest.mark.parametrize("lowest", LOWEST[::4])
    def test_is_at_most_twice_the_worst_mode_over_the_whole_start(
        self, shape: str, imposed_speed: bool, lowest: float
    ) -> None:
        claimed = max(phase.stray for phase in start_profile.phases(shape, imposed_speed, RISE, lowest / RISE))
        frequencies = lowest * np.exp(np.linspace(0, math.log(max(120 / lowest, 3)), 800))
        worst = max(part.max() for part in stray_of_modes(shape, imposed_speed, frequencies))
        assert worst <= claimed * (1 + 1e-9)
        assert claimed <= 2 * worst

    def test_a_torque_step_swings_by_the_whole_plateau(self) -> None:
        """x = 1 - cos w t for every mode: between 0 and 2, whatever the frequency."""
        for frequency in (1e-6, 0.3, 50.0):
            assert start_profile.phases(STEP, False, 0.0, frequency) == (Phase(1.0, 1.0, 1.0),)

    @pytest.mark.parametrize(("shape", "imposed_speed"), STARTS[1:])
    def test_quasi_static_range_holds_the_load_of_each_phase(self, shape: str, imposed_speed: bool) -> None:
        """The load over its plateau (torque) or over its peak (speed), from the profile by differences."""
        first, second = start_profile.phases(shape, imposed_speed, RISE, 1.0)
        times = np.linspace(1e-3, 2 * RISE - 1e-3, 2001)
        factor = start_profile.rise(shape, RISE, times)
        h = 1e-4
        slope = (start_profile.rise(shape, RISE, times + h) - start_profile.rise(shape, RISE, times - h)) / (2 * h)
        peak = {RAMP: 1.0, COSINE: math.pi / 2, PARABOLIC: 2.0}[shape] / RISE
        load = slope / peak if imposed_speed else factor
        for phase, part in ((first, times < RISE - h), (second, times > RISE + h)):
            assert (phase.low, phase.high) == pytest.approx((load[part].min(), load[part].max()), abs=2e-3)
            assert np.all(load[part] >= phase.low - 1e-6)
            assert np.all(load[part] <= phase.high + 1e-6)

    @given(st.sampled_from(STARTS[1:]), st.floats(1e-3, 1e3), st.floats(1e-3, 1e3), st.floats(1.0, 10.0))
    @steady
    def test_never_grows_with_frequency_or_rise_time(
        self, start: tuple[str, bool], rise_time: float, frequency: float, more: float
    ) -> None:
        base = [phase.stray for phase in start_profile.phases(*start, rise_time, frequency)]
        for changed in (
            start_profile.phases(*start, rise_time, frequency * more),
            start_profile.phases(*start, rise_time * more, frequency),
        ):
            assert all(phase.stray <= old for phase, old in zip(changed, base, strict=True))

    @pytest.mark.parametrize(("shape", "imposed_speed"), [start for start in STARTS[1:] if start != (RAMP, True)])
    def test_a_slow_rise_is_quasi_static(self, shape: str, imposed_speed: bool) -> None:
        """Only the jump of a linear ramp of speed rings on, however slow it is."""
        assert max(phase.stray for phase in start_profile.phases(shape, imposed_speed, 1e6, 1.0)) < 1e-5
        jump = start_profile.phases(RAMP, True, 1e6, 1.0)
        assert [phase.stray for phase in jump] == [1.0, 2.0]

    @pytest.mark.parametrize("shape", SHAPES[1:])
    def test_a_torque_that_rises_at_once_is_a_step(self, shape: str) -> None:
        assert [phase.stray for phase in start_profile.phases(shape, False, 0.0, 3.0)] == [1.0, 1.0]

    def test_bounds_by_hand(self) -> None:
        """w t_s = 10 for the formulas, hardly any rise for their caps."""
        b = math.pi / 10
        for shape, imposed_speed, formulas, caps in (
            (RAMP, False, (0.1, 0.2), (1, 1)),
            (RAMP, True, (1, 2), (1, 2)),
            (PARABOLIC, False, (0.16, 0.16), (1, 1)),
            (PARABOLIC, True, (0.6, 0.8), (2, 2)),
            (COSINE, False, (b * b / (1 - b * b),) * 2, (1, 1)),
            (COSINE, True, (b / (1 - b), 2 * b / (1 - b * b)), (2, 2)),
        ):
            for x, expected in ((10.0, formulas), (1e-3, caps)):
                found = [phase.stray for phase in start_profile.phases(shape, imposed_speed, 2.0, x / 2)]
                assert found == pytest.approx(expected, rel=1e-12), (shape, imposed_speed)

    def test_a_table_of_two_points_is_a_ramp(self) -> None:
        """A ramp of speed rings by the same jumps, as a table or by its name; one of torque by both of its corners."""
        ramp = ((0.0, 0.0), (1.0, 1.0))
        assert start_profile.phases(ramp, True, RISE, 5.0) == start_profile.phases(RAMP, True, RISE, 5.0)
        corners = 2 / (RISE * 5.0)
        assert start_profile.phases(ramp, False, RISE, 5.0) == (Phase(0.0, 1.0, corners), Phase(1.0, 1.0, corners))

    def test_a_step_of_speed_is_refused(self) -> None:
        with pytest.raises(ValueError, match="infinite force"):
            start_profile.phases(STEP, True, 0.0, 1.0)


class TestResidual:
    @pytest.mark.parametrize("imposed", [False, True])
    @pytest.mark.parametrize("shape", [RAMP, COSINE, PARABOLIC])
    @pytest.mark.parametrize("frequency", [0.4, 1.3, math.pi / RISE, 2 * math.pi / RISE, 7.9])
    def test_is_what_an_oscillator_is_left_with(self, shape: str, imposed: bool, frequency: float) -> None:
        """x'' + w^2 x = q (torque), or = q' (speed), by integration to the end of the rise; its amplitude then, over
        the 1/w^2 of a step of torque and the 1/w of a blow."""

        def rate(time: float, state: np.ndarray) -> list[float]:
            load = start_profile.rise_rate if imposed else start_profile.rise
            return [state[1], float(load(shape, RISE, time)) - frequency**2 * state[0]]

        state = np.zeros(2)
        for begin, end in ((0.0, RISE / 2), (RISE / 2, RISE)):
            state = solve_ivp(rate, (begin, end), state, rtol=1e-11, atol=1e-13).y[:, -1]
        rest = 0.0 if imposed else 1 / frequency**2
        swing = math.hypot(state[0] - rest, state[1] / frequency)
        step = 1 / frequency if imposed else 1 / frequency**2
        assert start_profile.residual(shape, RISE, frequency) == pytest.approx(swing / step, abs=1e-8)

    def test_a_ramp_of_whole_periods_leaves_nothing(self) -> None:
        periods = 2 * math.pi / RISE * np.arange(1, 5)
        assert start_profile.residual(RAMP, RISE, periods) == pytest.approx(0, abs=1e-15)

    def test_a_step_leaves_all(self) -> None:
        assert start_profile.residual(STEP, RISE, np.array([0.1, 3.0])) == pytest.approx([1.0, 1.0])


# --- points -----------------------------------------------------------------------------------------------------


def some_points(seed: int, imposed_speed: bool = True) -> tuple[tuple[float, float], ...]:
    """A random table: from 0, or from somewhere above it for a torque, to 1."""
    rng = np.random.default_rng(seed)
    count = int(rng.integers(2, 8))
    shares = np.concatenate([[0.0], np.cumsum(rng.uniform(0.05, 1.0, count - 1))])
    factors = np.concatenate([[0.0 if imposed_speed else rng.uniform(0, 0.5)], rng.uniform(0, 1.0, count - 1)])
    factors = np.maximum.accumulate(factors)
    factors[-1] = 1.0
    return tuple(zip((shares / shares[-1]).tolist(), factors.tolist(), strict=True))


def oscillator(points: tuple[tuple[float, float], ...], imposed_speed: bool, frequency: float) -> tuple[float, float]:
    """Largest |x - q| in the rise and after it, by an ODE solver from corner to corner."""
    shares, factors = np.array(points).T
    slopes = np.diff(factors) / np.diff(shares)
    state, worst = [0.0, 0.0], 0.0
    for k, slope in enumerate(slopes):

        def load(t: float, k: int = k, slope: float = slope) -> float:
            return slope / slopes.max() if imposed_speed else factors[k] + slope * (t - shares[k])

        times = np.linspace(shares[k], shares[k + 1], 200)
        motion = solve_ivp(
            lambda t, y, load=load: [y[1], frequency**2 * (load(t) - y[0])],
            (shares[k], shares[k + 1]), state, method="DOP853", t_eval=times, rtol=1e-10, atol=1e-12,
        )  # fmt: skip
        worst = max(worst, float(np.max(np.abs(motion.y[0] - [load(t) for t in times]))))
        state = [float(motion.y[0, -1]), float(motion.y[1, -1])]
    rest = 0.0 if imposed_speed else 1.0
    return worst, math.hypot(state[0] - rest, state[1] / frequency)


class TestPoints:
    @pytest.mark.parametrize("seed", range(12))
    def test_area_and_slope_are_those_of_the_factor(self, seed: int) -> None:
        points = some_points(seed, imposed_speed=False)
        corners = [share * RISE for share, _ in points]
        for until in (0.1, 1.0, 2.7, 3.0, 5.0):
            ends = sorted({0.0, until, *(corner for corner in corners if corner < until)})
            area = sum(
                quad(lambda t: float(start_profile.rise(points, RISE, t)), a, b)[0] for a, b in itertools.pairwise(ends)
            )
            assert start_profile.rise_integral(points, RISE, until) == pytest.approx(area, rel=1e-12)
        middles = np.array([(a + b) / 2 for a, b in itertools.pairwise(corners)])
        h = 1e-5
        slope = (start_profile.rise(points, RISE, middles + h) - start_profile.rise(points, RISE, middles - h)) / (
            2 * h
        )
        assert start_profile.rise_rate(points, RISE, middles) == pytest.approx(slope, abs=1e-9)
        assert start_profile.peak_rate(points, RISE) == pytest.approx(slope.max(), rel=1e-8)
        assert start_profile.rise_rate(points, RISE, 4.0) == 0.0

    @pytest.mark.parametrize("shape", [RAMP, COSINE, PARABOLIC])
    def test_many_points_along_another_shape_are_that_shape(self, shape: str) -> None:
        shares = np.linspace(0, 1, 2001)
        points = tuple(zip(shares.tolist(), start_profile.rise(shape, 1.0, shares).tolist(), strict=True))
        times = np.linspace(0, 4, 37)
        for law in (start_profile.rise, start_profile.rise_integral):
            assert law(points, RISE, times) == pytest.approx(law(shape, RISE, times), abs=1e-6)
        for frequency in (0.3, 1.7, 9.0):
            left = start_profile.residual(shape, RISE, frequency)
            assert start_profile.residual(points, RISE, frequency) == pytest.approx(left, abs=1e-6)

    @pytest.mark.parametrize("imposed_speed", [False, True])
    @pytest.mark.parametrize("seed", range(15))
    def test_no_oscillator_strays_further_than_its_corners_let_it(self, seed: int, imposed_speed: bool) -> None:
        points = some_points(seed, imposed_speed)
        for lowest in (0.5, 4.0, 30.0):
            claimed = start_profile.phases(points, imposed_speed, RISE, lowest / RISE)
            for frequency in (lowest, 1.6 * lowest, 3.1 * lowest):
                in_rise, after = oscillator(points, imposed_speed, frequency)
                assert in_rise <= claimed[0].stray * (1 + 1e-9)
                assert after <= claimed[1].stray * (1 + 1e-9)

    @pytest.mark.parametrize("seed", range(6))
    def test_swing_left_behind_is_that_of_the_oscillator(self, seed: int) -> None:
        points = some_points(seed, imposed_speed=False)
        for frequency in (0.7, 3.3, 17.0):
            _, after = oscillator(points, False, frequency)
            assert start_profile.residual(points, 1.0, frequency) == pytest.approx(after, abs=1e-8)


@pytest.mark.parametrize("shape", SHAPES)
def test_a_force_that_is_not_above_the_resistance_never_gathers_a_momentum(shape: str) -> None:
    """Nor does it where others beside it do, whose times stay as they are alone."""
    found = start_profile.time_to_momentum(shape, RISE, [5e3, 4e3, 9e3], 5e3, 0.0, 7e4)
    assert np.isinf(found[:2]).all()
    assert found[2] == start_profile.time_to_momentum(shape, RISE, 9e3, 5e3, 0.0, 7e4)
    assert np.isfinite(found[2])
