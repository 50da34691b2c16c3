"""Slip heat against quadrature and a braking flywheel, and two drums against an equilibrium searched for."""

import math

import numpy as np
import pytest
from scipy import integrate, optimize

from ptmcalc.laws import slip_heat


class TestHeat:
    def test_linear_change_by_quadrature(self) -> None:
        heat, _ = integrate.quad(lambda t: (3e4 - 5e3 * t) * (2.0 - 0.5 * t), 0, 3)
        assert slip_heat.slip_heat_of_linear_change(3.0, 3e4, 1.5e4, 2.0, 0.5) == pytest.approx(heat, rel=1e-13)
        assert slip_heat.slip_heat_of_linear_change(3.0, 2e4, 2e4, 2.0, 0.0) == pytest.approx(6e4)

    def test_history_by_quadrature(self) -> None:
        time = np.array([0.0, 0.3, 0.35, 1.0, 2.2])
        force, rim, belt = np.random.default_rng(2).uniform(0, 5, (3, 5))

        def power(t: float) -> float:
            return float(np.interp(t, time, force) * (np.interp(t, time, rim) - np.interp(t, time, belt)))

        heat, _ = integrate.quad(power, 0, 2.2, points=list(time[1:-1]), epsabs=1e-12)
        way, _ = integrate.quad(
            lambda t: abs(np.interp(t, time, rim - belt)), 0, 2.2, points=list(time[1:-1]), limit=400
        )
        assert slip_heat.slip_heat(time, force, rim, belt) == pytest.approx(heat, rel=1e-10)
        assert slip_heat.slip_distance(time, rim, belt) == pytest.approx(way, rel=1e-6)

    def test_energy_of_a_drum_that_catches_its_belt(self) -> None:
        """A heavy drum at 5 m/s and a belt of mass m at rest, dragged along by a constant force: what is missing from
        the kinetic energy at the end is the heat."""
        drum, belt, force = 4e3, 9e3, 2e4
        end = 5.0 / (force / drum + force / belt)
        time = np.array([0.0, end])
        rim, moved = 5.0 - force / drum * time, force / belt * time
        assert rim[1] == pytest.approx(moved[1])
        lost = drum * 25 / 2 - (drum + belt) * rim[1] ** 2 / 2
        assert slip_heat.slip_heat(time, np.full(2, force), rim, moved) == pytest.approx(lost, rel=1e-12)
        assert slip_heat.slip_distance(time, rim, moved) * force == pytest.approx(lost, rel=1e-12)

    def test_slip_that_turns_round(self) -> None:
        time, rim = np.array([0.0, 3.0]), np.array([2.0, -1.0])
        assert slip_heat.slip_distance(time, rim, np.zeros(2)) == pytest.approx(2.5)

    def test_a_worked_slip(self) -> None:
        """BW-10, T0 = 100 kN: 4.0482 MJ over 20.2123 m, S_off (e - 1) all along."""
        first, second = slip_heat.largest_drum_forces(100e3, 0.0, math.log(3.00284))
        assert first == 0.0
        assert second * 20.2123 == pytest.approx(4048200.0, rel=1e-5)

    def test_temperature(self) -> None:
        """4 MJ into 8 mm of lagging on 1.5 m by 1 m of drum: 14 kg of rubber."""
        mass = 1150.0 * 0.008 * 1.5 * 1.0
        rise = float(slip_heat.temperature_rise(4e6, mass, 1700.0))
        assert rise * mass * 1700 == pytest.approx(4e6)
        assert rise == pytest.approx(170, rel=0.02)


def search(force: float, share: float, slack: float, e1: float, e2: float) -> tuple[float, float]:
    """Drives that share the load: among all splits that both drums bear the one nearest to what was wanted, else the
    largest sum."""
    if force >= slack * (e1 * e2 - 1):
        return slack * e2 * (e1 - 1), slack * (e2 - 1)

    def spare(second: float) -> float:
        return min(slack * (e2 - 1) - second, (slack + second) * (e1 - 1) - (force - second))

    wanted = (1 - share) * force
    if spare(wanted) >= 0:
        return share * force, wanted
    low, high = (wanted, force) if slack * (e2 - 1) >= wanted else (0.0, wanted)
    inside = optimize.minimize_scalar(lambda x: -spare(x), bounds=(low, high), method="bounded").x
    edge = low if spare(low) < 0 and low == wanted else high
    second = optimize.brentq(spare, edge, inside, xtol=1e-9)
    return force - second, second


class TestTwoDrums:
    E = math.exp(0.3 * math.pi)
    MU_A = 0.3 * math.pi

    def test_worked_case(self) -> None:
        """BW-10, two drums of 180 degrees."""
        share = float(slip_heat.best_share(self.MU_A, self.MU_A))
        assert 300e3 * share == pytest.approx(215880.0, rel=1e-5)
        assert share / (1 - share) == pytest.approx(self.E, rel=1e-12)  # equal wraps
        first, second, missing = slip_heat.drum_forces_in_slip(300e3, 2 / 3, 60e3, self.MU_A, self.MU_A, False)
        assert first == pytest.approx(200e3)
        assert second == pytest.approx(60e3 * (self.E - 1))  # drum 2 slips: margin below 1
        assert missing == pytest.approx(300e3 - first - second)
        first, second, missing = slip_heat.drum_forces_in_slip(300e3, 2 / 3, 60e3, self.MU_A, self.MU_A, True)
        assert first + second == pytest.approx(300e3)
        assert missing == 0.0

    @pytest.mark.parametrize("share", [0.2, 0.5, 2 / 3, 0.72, 0.8, 0.95])
    @pytest.mark.parametrize("force", [100e3, 250e3, 300e3, 325e3, 400e3])
    @pytest.mark.parametrize("e1", [1.6, 2.566])
    def test_shared_load(self, share: float, force: float, e1: float) -> None:
        e2, slack = 2.566, 60e3
        first, second, missing = slip_heat.drum_forces_in_slip(
            force, share, slack, math.log(e1), math.log(e2), load_sharing=True
        )
        assert (first, second) == pytest.approx(search(force, share, slack, e1, e2), rel=1e-6)
        assert missing == pytest.approx(max(force - slack * (e1 * e2 - 1), 0.0), abs=1e-6)

    @pytest.mark.parametrize("share", [0.2, 0.5, 0.8, 0.95])
    def test_each_for_itself(self, share: float) -> None:
        """Fixed torques: each drum carries what it was given, or what it grips at the tension behind it."""
        e1, e2, slack, force = 1.9, 2.4, 60e3, 170e3
        second = min((1 - share) * force, slack * (e2 - 1))
        first = min(share * force, (slack + second) * (e1 - 1))
        found = slip_heat.drum_forces_in_slip(force, share, slack, math.log(e1), math.log(e2), load_sharing=False)
        assert found == pytest.approx((first, second, force - first - second), abs=1e-6)

    def test_most_of_both(self) -> None:
        first, second = slip_heat.largest_drum_forces(60e3, self.MU_A, self.MU_A)
        assert first + second == pytest.approx(60e3 * (math.exp(2 * self.MU_A) - 1))
        assert first / (first + second) == pytest.approx(float(slip_heat.best_share(self.MU_A, self.MU_A)))
