"""Heating over a cycle against the temperature of a warm body, and the heat of a start against the currents in it."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad, solve_ivp

from ptmcalc.laws import duty

steady = settings(derandomize=True, database=None, deadline=None, max_examples=150)


def mean_temperature(losses: list[float], cooling: list[float], times: list[float]) -> float:
    """Of a body that loses k (T - T_0), averaged over the cooling, in the cycle after very many: by marching.

    The heat capacity is so large that the temperature hardly swings within a cycle.
    """
    capacity = 4000 * sum(times)
    warm = 0.0
    for _ in range(60_000):
        for loss, k, time in zip(losses, cooling, times, strict=True):
            rest = loss / k
            warm = rest + (warm - rest) * math.exp(-k * time / capacity)
    return warm


class TestEquivalentTorque:
    @pytest.mark.parametrize("seed", range(4))
    def test_heats_as_much_as_the_cycle(self, seed: int) -> None:
        """The constant torque, with full cooling, brings the body to the same temperature."""
        rng = np.random.default_rng(seed)
        torques, times, cooling = rng.uniform(-9, 9, 4), rng.uniform(0.5, 3, 4), rng.uniform(0.3, 1, 4)
        equivalent = duty.rms_torque(torques, times, cooling)
        warm = mean_temperature((torques**2).tolist(), cooling.tolist(), times.tolist())
        assert equivalent**2 == pytest.approx(warm, rel=2e-3)

    @pytest.mark.parametrize("seed", range(4))
    def test_of_straight_lines_is_the_mean_of_the_square(self, seed: int) -> None:
        rng = np.random.default_rng(seed)
        before, after, times = rng.uniform(-9, 9, 5), rng.uniform(-9, 9, 5), rng.uniform(0.1, 3, 5)
        area = sum(
            quad(lambda t, a=a, b=b, span=span: (a + (b - a) * t / span) ** 2, 0, span)[0]
            for a, b, span in zip(before, after, times, strict=True)
        )
        cooled = float(np.sum(times * [1, 1, 1, 1, 0.4]))
        found = duty.equivalent_torque(before, after, times, [1, 1, 1, 1, 0.4])
        assert found == pytest.approx(math.sqrt(area / cooled), rel=1e-12)

    def test_rest_counts_by_its_cooling(self) -> None:
        """A crane: 4 s at 300 N m, 16 s at rest."""
        torques, times = [300.0, 0.0], [4.0, 16.0]
        assert duty.rms_torque(torques, times) == pytest.approx(300 * math.sqrt(4 / 20), rel=1e-12)
        careful = duty.REST_COOLING["self_ventilated"]
        expected = 300 * math.sqrt(4 / (4 + 0.33 * 16))
        assert duty.rms_torque(torques, times, [1.0, careful]) == pytest.approx(expected, rel=1e-12)
        assert duty.rms_torque(torques, times, [1.0, 0.0]) == pytest.approx(300.0, rel=1e-12)

    @given(st.lists(st.tuples(st.floats(-1e4, 1e4), st.floats(1e-3, 1e3)), min_size=1, max_size=8))
    @steady
    def test_lies_between_the_mean_and_the_largest(self, pieces: list[tuple[float, float]]) -> None:
        torques, times = np.array(pieces).T
        found = duty.rms_torque(torques, times)
        assert found >= abs(float(np.sum(torques * times) / np.sum(times))) * (1 - 1e-12)
        assert found <= float(np.max(np.abs(torques))) * (1 + 1e-12)

    def test_of_a_motor_that_gives_nothing_is_nothing(self) -> None:
        assert duty.rms_torque([0.0, 0.0], [3.0, 4.0]) == 0.0


class TestDutyFactor:
    def test_is_the_share_of_the_cycle(self) -> None:
        assert duty.duty_factor(4.0, 6.0) == pytest.approx(0.4, rel=1e-15)
        assert (duty.duty_factor(4.0, 0.0), duty.duty_factor(0.0, 6.0)) == (1.0, 0.0)

    def test_the_short_form(self) -> None:
        assert duty.permissible_torque(400.0, 0.4, 0.25) == pytest.approx(400 * math.sqrt(0.4 / 0.25), rel=1e-12)
        assert duty.permissible_torque(400.0, 0.4, 0.4) == pytest.approx(400.0, rel=1e-15)

    @pytest.mark.parametrize("rated", [1.0, 0.6, 0.25])
    @pytest.mark.parametrize("other", [0.15, 0.4, 0.8])
    @pytest.mark.parametrize(("ratio", "cooling"), [(0.0, 1.0), (0.0, 0.33), (0.5, 0.5)])
    def test_heats_as_much_as_the_rated_duty(self, rated: float, other: float, ratio: float, cooling: float) -> None:
        """Losses of 1 with the torque at the rating, and constant ones beside them; on and off in turn."""
        try:
            share = duty.permissible_torque(1.0, rated, other, ratio, cooling)
        except ValueError:
            assert ratio > 0
            assert other > rated
            share = 0.0
        warm = [
            mean_temperature([ratio + torque**2, 0.0], [1.0, cooling], [ed, 1 - ed + 1e-12])
            for torque, ed in ((1.0, rated), (share, other))
        ]
        assert warm[1] >= warm[0] if share == 0 else warm[1] == pytest.approx(warm[0], rel=2e-3)

    def test_a_motor_with_its_own_fan_gains_less_from_rest(self) -> None:
        assert duty.permissible_torque(1.0, 1.0, 0.25) == pytest.approx(2.0)
        assert duty.permissible_torque(1.0, 1.0, 0.25, 0.0, 0.33) == pytest.approx(1.41, abs=5e-3)


class TestSwitching:
    @pytest.mark.parametrize(("slips", "load"), [((1.0, 0.0), 0.0), ((1.0, 0.05), 0.4), ((2.0, 1.0), -0.3)])
    def test_heat_of_a_change_of_speed(self, slips: tuple[float, float], load: float) -> None:
        """What the field gives less what the shaft gets is lost in the rotor, the stator loses a times that.

        The torque of the motor falls with its speed; the load is a share of it.
        """
        inertia, field, ratio = 1.7, 157.0, 0.8

        def right(_: float, y: list[float]) -> list[float]:
            torque = 300 * (1 + y[0] / field) ** 2 / 4 + 50
            return [torque * (1 - load) / inertia, torque * field, torque * y[0]]

        def there(_: float, y: list[float]) -> float:
            return y[0] - field * (1 - slips[1])

        there.terminal = True  # type: ignore[attr-defined]
        run = solve_ivp(right, (0, 100), [field * (1 - slips[0]), 0, 0], events=there, rtol=1e-11, atol=1e-9)
        rotor = float(run.y[1, -1] - run.y[2, -1])
        found = duty.switching_heat(inertia, field, *slips, ratio, load)
        assert found == pytest.approx(rotor * (1 + ratio), rel=1e-8)

    def test_a_start_leaves_the_energy_of_the_mass_in_the_rotor_and_a_reversal_four_times_that(self) -> None:
        energy = 1.7 * 157.0**2 / 2
        assert duty.switching_heat(1.7, 157.0, 1.0, 0.0) == pytest.approx(energy, rel=1e-15)
        assert duty.switching_heat(1.7, 157.0, 2.0, 0.0) == pytest.approx(4 * energy, rel=1e-15)

    @pytest.mark.parametrize(("on", "cooling"), [(0.25, 0.33), (0.9, 0.5), (1.0, 1.0)])
    def test_as_often_as_permitted_the_motor_gets_as_warm_as_at_its_rating(self, on: float, cooling: float) -> None:
        rated, running, heat = 900.0, 500.0, 2e4
        rate = duty.permissible_switching_rate(rated, running, on, cooling, heat)
        losses = [running + rate * heat / on, 0.0]
        assert mean_temperature(losses, [1.0, cooling], [on, 1 - on]) == pytest.approx(rated, rel=2e-3)

    def test_there_is_nothing_left_for_starts_where_running_heats_too_much(self) -> None:
        assert duty.permissible_switching_rate(900.0, 2000.0, 0.9, 0.33, 2e4) == 0.0


class TestLoadFactor:
    @pytest.mark.parametrize(("load", "constant", "cooling"), [(0.0, 0.4, 0.5), (0.6, 0.25, 0.33), (0.9, 0.5, 1.0)])
    def test_starts_and_running_warm_as_much_as_the_rating(self, load: float, constant: float, cooling: float) -> None:
        """No-load starts of half an hour at rest give the heat of a start; running with load leaves the rest."""
        no_load = 50.0
        heat = (0.5 * (1 - constant) + 0.5 * cooling) / no_load
        starts = no_load * duty.load_factor(load, constant, cooling)
        assert starts * heat + constant + (1 - constant) * load**2 == pytest.approx(1.0)

    def test_running_at_the_rating_leaves_nothing(self) -> None:
        assert duty.load_factor(1.0, 0.4, 0.5) == 0.0
        assert duty.load_factor(1.3, 0.4, 0.5) == 0.0


class TestDutyTypes:
    def test_are_those_of_the_standard(self) -> None:
        assert list(duty.DUTY_TYPES) == [f"S{number}" for number in range(1, 11)]
        rests = {name for name, one in duty.DUTY_TYPES.items() if one.at_rest}
        assert rests == {"S2", "S3", "S4", "S5", "S9", "S10"}
        assert {name for name, one in duty.DUTY_TYPES.items() if "never at rest" in one.meaning} == {"S6", "S7", "S8"}
        starts = {name for name, one in duty.DUTY_TYPES.items() if one.counts_starts}
        assert starts == {"S4", "S5", "S7", "S8", "S9"}

    def test_say_what_is_compared(self) -> None:
        for name, one in duty.DUTY_TYPES.items():
            assert " with " in one.compared or " and " in one.compared, name

    def test_cooling_at_rest_is_never_better_than_at_speed(self) -> None:
        assert all(0 < share <= 1 for share in duty.REST_COOLING.values())
        assert next(iter(duty.REST_COOLING)) == min(duty.REST_COOLING, key=lambda way: duty.REST_COOLING[way])
