"""Sprocket, polygon effect and equalising drive against coordinates of the joints, quadrature and integration."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad, solve_ivp
from scipy.special import zeta

from ptmcalc.laws import equalising, polygon, sprocket

steady = settings(derandomize=True, database=None, deadline=None, max_examples=80)
PITCH, SPEED = 0.32, 0.5
TEETH = [3, 4, 6, 8, 17, 120]
teeth = st.integers(3, 400)


def joint(teeth: int, angle: float) -> np.ndarray:
    """Where a pin is on the sprocket, (along, across) the strand, from the side of one chord per pitch."""
    radius = PITCH / 2 / math.sin(math.pi / teeth)
    return radius * np.array([math.sin(angle), math.cos(angle)])


class TestSprocket:
    @pytest.mark.parametrize("z", TEETH)
    def test_neighbouring_pins_are_one_pitch_apart(self, z: int) -> None:
        assert sprocket.pitch_radius(PITCH, z) == pytest.approx(np.linalg.norm(joint(z, 0.7)), rel=1e-14)
        apart = np.linalg.norm(joint(z, 0.7) - joint(z, 0.7 + 2 * math.pi / z))
        assert apart == pytest.approx(PITCH, rel=1e-13)

    @pytest.mark.parametrize("z", TEETH)
    def test_speeds_of_the_seated_joint(self, z: int) -> None:
        """Differences of its place; the joint that leads the strand goes from -pi/z to pi/z."""
        omega = sprocket.sprocket_speed(SPEED, PITCH, z)
        assert omega * z * PITCH / (2 * math.pi) == pytest.approx(SPEED, rel=1e-14)
        small = 1e-5
        moved = [(joint(z, at + small) - joint(z, at - small)) / (2 * small) * omega for at in (0.0, math.pi / z)]
        slowest, fastest = sprocket.speed_extremes(SPEED, z)
        assert moved[0][0] == pytest.approx(fastest, rel=1e-8)
        assert moved[1][0] == pytest.approx(slowest, rel=1e-8)
        assert abs(moved[1][1]) == pytest.approx(sprocket.transverse_speed(SPEED, z), rel=1e-8)
        assert sprocket.speed_ripple(z, "largest") == pytest.approx((fastest - slowest) / fastest, rel=1e-9)
        assert sprocket.speed_ripple(z, "mean") == pytest.approx((fastest - slowest) / SPEED, rel=1e-9)
        travel = joint(z, 0.0)[1] - joint(z, math.pi / z)[1]
        assert sprocket.transverse_travel(PITCH, z) == pytest.approx(travel, rel=1e-9)

    @pytest.mark.parametrize("z", TEETH)
    def test_a_joint_meets_its_tooth(self, z: int) -> None:
        """Velocity of the tooth less that of the joint: of the seated joint, or of it along the strand alone."""
        omega, half = sprocket.sprocket_speed(SPEED, PITCH, z), math.pi / z

        def velocity(angle: float) -> np.ndarray:
            x, y = joint(z, angle)
            return omega * np.array([y, -x])

        seated, tooth = velocity(half), velocity(-half)
        assert sprocket.engagement_speed(SPEED, z, "translating") == pytest.approx(np.linalg.norm(tooth - seated))
        along = np.array([seated[0], 0.0])
        assert sprocket.engagement_speed(SPEED, z, "guided") == pytest.approx(np.linalg.norm(tooth - along))
        assert sprocket.engagement_energy(9.0, 0.4, 0.5) == pytest.approx(9.0 * 0.2**2 / 2)

    @pytest.mark.parametrize(("pitches", "place"), [(3.0, 0.0), (3.25, 0.25), (0.75, 0.75)])
    def test_place_at_the_other_end(self, pitches: float, place: float) -> None:
        assert sprocket.pitch_fraction(pitches * 0.5, 0.5) == place

    @pytest.mark.parametrize("z", [6, 8, 10, 17, 19, 25])
    def test_ripple_of_handbooks(self, z: int) -> None:
        printed = {6: 13.4, 8: 7.6, 10: 4.9, 17: 1.70, 19: 1.36, 25: 0.79}[z]
        assert 100 * sprocket.speed_ripple(z, "largest") == pytest.approx(printed, abs=0.05 if printed > 2 else 0.005)


class TestMotion:
    @given(teeth, st.floats(-0.5, 0.5))
    @steady
    def test_is_that_of_the_pin_less_its_mean(self, z: int, x: float) -> None:
        half = math.pi / z
        u = joint(z, 2 * half * x)[0] - PITCH * x
        scale = PITCH / z**2
        assert float(polygon.polygon_displacement(x, PITCH, z)) == pytest.approx(u, abs=1e-10 * scale + 3e-16)

    @pytest.mark.parametrize("z", TEETH)
    def test_speed_and_acceleration_are_its_derivatives(self, z: int) -> None:
        x = np.linspace(-0.45, 0.45, 19)
        d = 1e-4
        rate = SPEED / PITCH  # of x

        def slope(values: np.ndarray, below: np.ndarray) -> np.ndarray:
            return (values - below) / (2 * d) * rate

        speed = slope(polygon.polygon_displacement(x + d, PITCH, z), polygon.polygon_displacement(x - d, PITCH, z))
        scale = SPEED / z**2
        assert polygon.polygon_speed(x, SPEED, z) == pytest.approx(speed, abs=1e-6 * scale)
        acceleration = slope(polygon.polygon_speed(x + d, SPEED, z), polygon.polygon_speed(x - d, SPEED, z))
        peak = float(polygon.peak_acceleration(SPEED, PITCH, z))
        assert polygon.polygon_acceleration(x, SPEED, PITCH, z) == pytest.approx(acceleration, abs=1e-6 * peak)

    @pytest.mark.parametrize("z", TEETH)
    def test_jumps_at_an_engagement(self, z: int) -> None:
        peak = float(polygon.peak_acceleration(SPEED, PITCH, z))
        after, before = polygon.polygon_acceleration(np.array([0.5, 0.5 - 1e-13]), SPEED, PITCH, z)
        assert after == pytest.approx(peak, rel=1e-14)
        assert before == pytest.approx(-peak, rel=1e-12)
        assert polygon.polygon_displacement([-0.5, 0.0, 0.5, 7.5], PITCH, z) == pytest.approx(0.0, abs=1e-15 * PITCH)

    def test_many_teeth_keep_their_digits(self) -> None:
        """u -> (p/6) (pi/z)^2 x (1 - 4 x^2): a difference of nearly equal sines."""
        z, x = 10**7, 0.3
        expected = PITCH / 6 * (math.pi / z) ** 2 * x * (1 - 4 * x**2)
        assert float(polygon.polygon_displacement(x, PITCH, z)) == pytest.approx(expected, rel=1e-12)
        mean = (math.pi / z) ** 2 / 6 * (1 - 12 * x**2) * SPEED
        assert float(polygon.polygon_speed(x, SPEED, z)) == pytest.approx(mean, rel=1e-12)

    @pytest.mark.parametrize("epsilon", [0.0, 0.7, -0.15])
    def test_a_sprocket_that_speeds_up(self, epsilon: float) -> None:
        z, omega = 8, 1.3
        times = polygon.engagement_times(omega, epsilon, z, 6)
        turned = omega * times + epsilon * times**2 / 2
        assert turned == pytest.approx(2 * math.pi / z * np.arange(7), rel=1e-12, abs=1e-15)
        assert polygon.engagement_times(omega, 0.0, 40, 6) == pytest.approx(math.pi / 20 / omega * np.arange(7))
        radius, d = sprocket.pitch_radius(PITCH, z), 1e-4
        t = np.linspace(0.01, 0.4, 9)

        def place(at: np.ndarray) -> np.ndarray:
            return radius * np.sin(omega * at + epsilon * at**2 / 2 - math.pi / z)

        expected = (place(t + d) - 2 * place(t) + place(t - d)) / d**2
        phi = omega * t + epsilon * t**2 / 2 - math.pi / z
        found = polygon.ramped_acceleration(phi, omega + epsilon * t, epsilon, PITCH, z)
        assert found == pytest.approx(expected, abs=1e-6)

    def test_from_rest(self) -> None:
        assert polygon.engagement_times(0.0, 0.5, 8, 2) == pytest.approx(
            [0.0, math.sqrt(math.pi), math.sqrt(2 * math.pi)]
        )


class TestHarmonics:
    @pytest.mark.parametrize("z", TEETH)
    @pytest.mark.parametrize("n", [1, 2, 3, 8])
    def test_are_the_integrals(self, z: int, n: int) -> None:
        def product(x: float) -> float:
            return float(polygon.polygon_acceleration(x, SPEED, PITCH, z)) * math.sin(2 * math.pi * n * x)

        expected = 2 * quad(product, -0.5, 0.4999999999999, epsabs=1e-13, epsrel=1e-12)[0]
        found = polygon.acceleration_harmonics(np.array([float(n)]), SPEED, PITCH, z)[0]
        assert found == pytest.approx(expected, rel=1e-9)

    @pytest.mark.parametrize("z", TEETH)
    def test_add_up_to_the_acceleration(self, z: int) -> None:
        n = np.arange(1.0, 20001.0)
        x = np.array([0.13, -0.31])
        found = np.sin(2 * np.pi * x[:, None] * n) @ polygon.acceleration_harmonics(n, SPEED, PITCH, z)
        peak = float(polygon.peak_acceleration(SPEED, PITCH, z))
        assert found == pytest.approx(polygon.polygon_acceleration(x, SPEED, PITCH, z), abs=1e-4 * peak)

    @given(teeth, st.integers(1, 200), st.floats(0.3, 4.0))
    @steady
    def test_the_tail_is_a_bound_and_not_a_loose_one(self, z: int, last: int, falloff: float) -> None:
        n = np.arange(last + 1.0, last + 40001.0)
        terms = float(np.abs(polygon.acceleration_harmonics(n, SPEED, PITCH, z)) @ n**-falloff)
        beyond = float(zeta(1 + falloff, last + 40001.0))  # of n^-(1 + s), exactly; 1 - (n z)^-2 is 1 there
        further = float(polygon.peak_acceleration(SPEED, PITCH, z)) * 2 / math.pi * beyond
        bound = polygon.harmonic_tail(last, falloff, SPEED, PITCH, z)
        assert terms <= bound <= (terms + further) * (1 + 2 * (1 + falloff) / last) ** (1 + falloff)


class TestTextbook:
    def test_table(self) -> None:
        assert [polygon.return_share(x) for x in (1.0, 25.0, 25.1, 59.9, 60.0, 400.0)] == [2, 2, 1.5, 1.5, 1, 1]
        assert polygon.nearest_threshold(26.0) == pytest.approx((25.0, 0.04))
        assert polygon.nearest_threshold(58.0) == pytest.approx((60.0, -1 / 30))
        assert abs(polygon.nearest_threshold(26.3)[1]) > 0.05

    def test_origin_of_the_factor_three(self) -> None:
        """-m a_max before the tooth, a step of 2 m a_max doubled: an undamped oscillator at rest there."""
        run = solve_ivp(lambda t, y: [y[1], 1 - y[0]], (0, 4), [-1.0, 0.0], rtol=1e-10, atol=1e-12, max_step=0.01)
        assert polygon.textbook_polygon_force(1.0, 1.0) == pytest.approx(run.y[0].max(), rel=1e-5)


class TestEqualisingDrive:
    @pytest.mark.parametrize("z", [3, 6, 8, 17])
    def test_the_chain_runs_evenly(self, z: int) -> None:
        """omega = V/(R cos phi), integrated over a pitch."""
        radius = sprocket.pitch_radius(PITCH, z)
        half = math.pi / z
        run = solve_ivp(
            lambda t, y: SPEED / radius / np.cos(y),
            (0, PITCH / SPEED),
            [-half],
            rtol=1e-11,
            atol=1e-13,
            dense_output=True,
        )
        x = np.linspace(-0.499, 0.499, 11)
        phi = run.sol((x + 0.5) * PITCH / SPEED)[0]
        assert equalising.equalising_angle(x, z) == pytest.approx(phi, abs=1e-8)
        assert equalising.equalising_speed(x, SPEED, PITCH, z) == pytest.approx(SPEED / radius / np.cos(phi), rel=1e-7)
        for pitches in (-2, 1, 7):
            assert equalising.equalising_angle(x + pitches, z) == pytest.approx(phi, abs=1e-8)
        ends = equalising.equalising_speed([0.0, 0.4999999999], SPEED, PITCH, z)
        assert equalising.equalising_ratio(z) == pytest.approx(ends[1] / ends[0], rel=1e-8)
        d = 1e-6
        near = equalising.equalising_speed([0.5 - 3 * d, 0.5 - d], SPEED, PITCH, z)
        slope = (near[1] - near[0]) / (2 * d) * SPEED / PITCH
        assert equalising.equalising_acceleration(SPEED, PITCH, z) == pytest.approx(slope, rel=1e-4)
