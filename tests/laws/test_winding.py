"""Laws of multilayer winding: printed values, impulses by quadrature, bounds by DOP853."""

import math

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from ptmcalc.laws import winding

PRINTED = [
    (160.0, 114.0, 5.47),
    (140.0, 114.0, 5.848),
    (120.0, 114.0, 6.317),
    (100.0, 114.0, 6.92),
    (160.0, 94.5, 4.981),
    (160.0, 77.0, 4.496),
    (160.0, 61.0, 4.002),
]


@pytest.mark.parametrize(("length", "area", "printed"), PRINTED)
def test_the_seven_printed_frequencies(length: float, area: float, printed: float) -> None:
    found = winding.paper_frequency(2.1e11, area * 1e-6, 49050.0, length, 9.81)
    digits = len(str(printed).partition(".")[2])
    assert round(found, digits) == printed


class TestClimb:
    @pytest.mark.parametrize("speed", [0.3, 0.4 * math.pi, 8.0])
    def test_its_impulse_is_the_jump_of_speed(self, speed: float) -> None:
        amplitude, (slow, fast) = winding.climb_amplitude(speed, 0.015), winding.climb_rates(speed)
        impulse = quad(
            lambda t: amplitude * (math.exp(-slow * t) - math.exp(-fast * t)),
            0, 60 / slow, points=[1 / fast, 1 / slow, 8 / slow], epsabs=1e-14,
        )[0]  # fmt: skip
        assert impulse == pytest.approx(speed * 0.015, rel=1e-10)

    def test_its_constants(self) -> None:
        """Over the drum's angle; at 12 rpm the law of the paper, whose amplitude lacks a factor of 2.46."""
        assert winding.climb_amplitude(1.0, 1.0) == pytest.approx(2.464, abs=5e-4)
        assert winding.climb_rates(1.0) == pytest.approx((2.387, 76.39), abs=5e-3)
        assert winding.climb_rates(0.4 * math.pi) == pytest.approx((3.0, 96.0), rel=1e-14)
        assert winding.paper_amplitude(0.4 * math.pi, 0.0175) == pytest.approx(0.0276349, rel=2e-6)
        assert winding.climb_amplitude(0.4 * math.pi, 0.0175) == pytest.approx(0.0681016, rel=2e-6)
        assert winding.climb_amplitude(0.4 * math.pi, 0.0175 * math.sqrt(3) / 2) == pytest.approx(0.0589777, rel=2e-6)


class TestStress:
    def test_ratio_is_that_of_the_two_stresses(self) -> None:
        modulus, area, mass, falls, length, g, amplitude, c = 1.05e11, 1.14e-4, 5000.0, 4, 160.0, 9.81, 0.059, 1.57
        k2 = falls**2 * modulus * area / (mass * length)
        dynamic = float(winding.stretch_stress(modulus, c * amplitude / k2, length))
        mean = winding.fall_stress(mass * g, falls, area)
        assert winding.stress_ratio(c, amplitude, falls, 1, g) == pytest.approx(dynamic / mean, rel=1e-12)

    def test_a_twin_tackle_counts_by_the_speed_of_its_ropes(self) -> None:
        """Eight falls on two ropes move as four on one."""
        assert winding.stress_ratio(1.5, 0.05, 8, 2, 9.81) == winding.stress_ratio(1.5, 0.05, 4, 1, 9.81)
        assert winding.sudden_ratio(1.2, 0.015, 20.0, 8, 2, 9.81) == winding.sudden_ratio(1.2, 0.015, 20.0, 4, 1, 9.81)

    def test_of_the_worked_case(self) -> None:
        """C24: what 7 and 18 % would need, and the bound of a sudden climb."""
        assert winding.stress_ratio(1.02903, 0.667329, 1, 1, 9.81) == pytest.approx(0.07, rel=1e-5)
        assert winding.stress_ratio(1.02903, 1.71599, 1, 1, 9.81) == pytest.approx(0.18, rel=1e-5)
        step = 0.0175 * math.sqrt(3) / 2
        assert winding.sudden_ratio(0.4 * math.pi, step, 21.8815, 4, 1, 9.81) == pytest.approx(0.0106201, rel=1e-5)

    @pytest.mark.parametrize("seed", range(8))
    def test_no_climb_gives_more_than_a_sudden_one(self, seed: int) -> None:
        """Any rise of the rope's speed, here along a polynomial, on the load and its tackle."""
        rng = np.random.default_rng(seed)
        k, jump, rise = 20.0, 0.019, 10 ** rng.uniform(-3, 0)
        power = rng.uniform(0.5, 4)

        def acceleration(t: float) -> float:
            return jump * power * (t / rise) ** (power - 1) / rise if 0 < t < rise else 0.0

        run = solve_ivp(lambda t, y: [y[1], acceleration(t) - k * k * y[0]], (1e-9 * rise, rise), [0.0, 0.0], "DOP853",
                        rtol=1e-8, atol=1e-12)  # fmt: skip
        swing = max(np.abs(run.y[0]).max(), math.hypot(run.y[0, -1], run.y[1, -1] / k))
        assert swing <= jump / k * (1 + 1e-3)

    def test_crossovers_against_the_load(self) -> None:
        """0.46 with the frequency of the paper, 0.115 with the true one."""
        assert winding.crossover_ratio(2, 0.4 * math.pi, 5.47) == pytest.approx(0.46, abs=1e-3)
        assert winding.crossover_ratio(2, 0.4 * math.pi, 21.88) == pytest.approx(0.115, abs=2e-4)


class TestRadius:
    def test_climbs_once_and_crosses_over(self) -> None:
        corners = winding.winding_radius(0.15, 0.015, 0.002, 2, 1.0, 2.0)
        assert corners[:3] == pytest.approx(np.array([[0.0, 0.15], [0.5, 0.15], [1.5, 0.165]]), rel=1e-14)
        assert np.all(np.diff(corners[:, 0]) > 0)
        bumps = corners[corners[:, 1] > 0.165 + 1e-9]
        assert bumps[:, 0] == pytest.approx(1.0 + math.pi * np.arange(1, 4), rel=1e-14)
        assert bumps[:, 1] == pytest.approx(0.167)
        assert corners[-1].tolist() == pytest.approx([0.5 + 4 * math.pi, 0.165])

    def test_square_turns_cross_over_without_rising(self) -> None:
        rise = winding.crossover_rise(0.0175, 0.0175)
        corners = winding.winding_radius(0.15, 0.0175, rise, 2, 1.0, 3.0)
        assert rise == 0.0
        assert corners[:, 1].max() == pytest.approx(0.1675)
        assert len(corners) == 4

    def test_nested_turns_rise_by_what_the_step_lacks(self) -> None:
        d = 0.0175
        assert winding.crossover_rise(d, d * math.sqrt(3) / 2) == pytest.approx(0.134 * d, rel=1e-3)


@pytest.mark.parametrize(("turns", "bumps"), [(0.2, 0), (0.5, 0), (0.51, 1), (1.0, 1), (2.2, 4)])
def test_a_climb_and_the_crossovers_behind_it_corner_by_corner(turns: float, bumps: int) -> None:
    """Two crossovers a turn, each over 60 deg; the first is the climb. Even up to where the next one would be."""
    arc = math.pi / 3
    found = winding.winding_radius(0.15, 0.015, 2e-3, 2, arc, turns)
    expected = [(0.0, 0.15), (arc / 2, 0.15), (1.5 * arc, 0.165)]
    for k in range(1, bumps + 1):
        expected += [(arc / 2 + k * math.pi + part * arc / 2, 0.165 + (part == 1) * 2e-3) for part in range(3)]
    expected.append((arc / 2 + (bumps + 1) * math.pi, 0.165))
    assert found == pytest.approx(np.array(expected), rel=1e-14)
    flat = winding.winding_radius(0.15, 0.015, 0.0, 2, arc, turns)
    assert flat == pytest.approx(np.array([*expected[:3], expected[-1]]), rel=1e-14)
