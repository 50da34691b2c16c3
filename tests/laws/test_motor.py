"""Torque of a start against work and power; of an induction motor against the currents of its circuit."""

import math
from dataclasses import dataclass, replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq, minimize_scalar

from ptmcalc.laws import motor

steady = settings(derandomize=True, database=None, deadline=None, max_examples=150)


def sawtooth(largest: float, smallest: float, steps: int, speed: float) -> float:
    """Torque of a rheostat start of equal steps over the share of the rated speed: straight falls and jumps up."""
    return largest - (largest - smallest) * (speed * steps % 1.0)


class TestMeanStartingTorque:
    @pytest.mark.parametrize("steps", [1, 3, 7])
    def test_does_the_work_of_the_steps(self, steps: int) -> None:
        largest, smallest = 900.0, 550.0
        work = sum(
            quad(lambda s: sawtooth(largest, smallest, steps, s), k / steps, (k + 1) / steps - 1e-15, limit=200)[0]
            for k in range(steps)
        )
        assert motor.mean_starting_torque(largest, smallest) == pytest.approx(work, rel=1e-9)

    @given(st.floats(0, 1e6), st.floats(0, 1e6))
    @steady
    def test_lies_between_both_and_does_not_care_for_their_order(self, one: float, other: float) -> None:
        mean = motor.mean_starting_torque(one, other)
        assert min(one, other) <= mean <= max(one, other)
        assert mean == motor.mean_starting_torque(other, one)

    def test_of_a_constant_torque_is_that_torque(self) -> None:
        assert motor.mean_starting_torque(730.0, 730.0) == 730.0


class TestRimForce:
    @pytest.mark.parametrize("seed", range(6))
    def test_carries_the_power_that_leaves_the_gear(self, seed: int) -> None:
        rng = np.random.default_rng(seed)
        torque, ratio, eta, radius = rng.uniform(10, 1e4), rng.uniform(1, 80), rng.uniform(0.5, 1), rng.uniform(0.1, 1)
        rotor_speed = 153.0
        rim_speed = rotor_speed / ratio * radius
        assert motor.rim_force(torque, ratio, eta, radius) * rim_speed == pytest.approx(
            eta * torque * rotor_speed, rel=1e-12
        )

    def test_direct_drive_is_the_lever_of_the_drum(self) -> None:
        assert motor.rim_force(120.0, 1.0, 1.0, 0.4) == pytest.approx(300.0, rel=1e-15)

    @given(st.floats(-1e5, 1e5), st.floats(1.0, 100.0), st.floats(0.3, 1.0), st.floats(0.05, 2.0))
    @steady
    def test_turns_with_the_torque_and_loses_by_the_gear(
        self, torque: float, ratio: float, eta: float, radius: float
    ) -> None:
        force = motor.rim_force(torque, ratio, eta, radius)
        assert motor.rim_force(-torque, ratio, eta, radius) == -force
        assert abs(force) <= abs(torque) * ratio / radius * (1 + 1e-12)


@dataclass(frozen=True)
class Circuit:
    """One phase of an induction motor, its magnetising branch at the terminals; all seen from the stator."""

    stator: float = 0.31
    """resistance"""
    rotor: float = 0.22
    """resistance"""
    stray: float = 1.4
    """reactance"""
    voltage: float = 230.0
    field: float = 157.0
    """synchronous speed"""

    def torque(self, slip: ArrayLike) -> NDArray[np.float64]:
        """Air-gap power over the speed of the field, by the current; the rotor resistance over no slip is endless."""
        s = np.asarray(slip, float)
        current = self.voltage * s / (self.stator * s + self.rotor + 1j * self.stray * s)  # times 1/s
        return np.asarray(3 * np.abs(current) ** 2 * self.rotor / self.field) / np.where(s == 0, 1.0, s)

    @property
    def ratio(self) -> float:
        return self.stator / self.rotor

    @property
    def curve(self) -> tuple[float, float, float]:
        """What the formula takes: breakdown torque, breakdown slip, stator ratio."""
        impedance = math.hypot(self.stator, self.stray)
        most = 1.5 * self.voltage**2 / self.field / (self.stator + impedance)
        return most, self.rotor / impedance, self.stator / self.rotor


CIRCUITS = [Circuit(), Circuit(stator=1e-9), Circuit(stator=3.0, rotor=0.9), Circuit(rotor=2.5), Circuit(stray=0.05)]
SLIPS = [-2.0, -0.7, -0.11, -1e-3, 0.0, 1e-9, 0.02, 0.15, 0.5, 1.0, 1.8, 40.0]


def of_rating(rated_slip: float, overload: float, ratio: float, slip: float) -> float:
    """The full formula as it stands in the books, over the rated torque."""
    s_k = motor.breakdown_slip(rated_slip, overload, ratio)
    return overload * 2 * (1 + ratio * s_k) / (slip / s_k + s_k / slip + 2 * ratio * s_k)


@pytest.mark.parametrize("circuit", CIRCUITS)
def test_the_reference_has_its_largest_torque_where_it_says(circuit: Circuit) -> None:
    best = minimize_scalar(lambda s: -float(circuit.torque(s)), bounds=(1e-4, 60.0), method="bounded")
    assert -float(best.fun) == pytest.approx(circuit.curve[0], rel=1e-8)
    assert float(best.x) == pytest.approx(circuit.curve[1], rel=1e-3)  # a flat top: the search sees half the digits


class TestRating:
    def test_of_a_hoist_motor(self) -> None:
        """22 kW at 965 rpm of 1000, overload 2.5."""
        torque = motor.rated_torque(22e3, 965 * math.pi / 30)
        slip = float(motor.slip(965.0, 1000.0))
        assert torque == pytest.approx(217.704, rel=3e-6)
        assert slip == pytest.approx(0.035, rel=1e-14)
        assert motor.breakdown_slip(slip, 2.5) == pytest.approx(0.167695, rel=3e-6)

    def test_of_a_press_motor(self) -> None:
        """5.5 kW at 1440 rpm of 1500, overload 2.3."""
        torque = motor.rated_torque(5500.0, 1440 * math.pi / 30)
        assert torque == pytest.approx(36.473, rel=3e-6)
        s_k = motor.breakdown_slip(0.04, 2.3)
        assert s_k == pytest.approx(0.174849, rel=3e-6)
        at_rest = float(motor.kloss(1.0, 2.3 * torque, s_k))
        assert at_rest * 12 * 0.94 == pytest.approx(321.088, rel=3e-6)

    @pytest.mark.parametrize("slip", [0.01, 0.05, 0.3])
    @pytest.mark.parametrize("overload", [1.0, 1.0001, 1.6, 2.8, 12.0])
    @pytest.mark.parametrize("share", [0.0, 0.3, 0.999])
    def test_the_curve_goes_through_the_rated_point_below_breakdown(
        self, slip: float, overload: float, share: float
    ) -> None:
        ratio = share * motor.largest_stator_ratio(slip, overload)
        s_k = motor.breakdown_slip(slip, overload, ratio)
        assert of_rating(slip, overload, ratio, slip) == pytest.approx(1.0, rel=1e-12)
        assert s_k >= slip
        assert ratio * s_k < 1
        if share == 0:
            assert s_k == pytest.approx(slip * (overload + math.sqrt(overload**2 - 1)), rel=1e-12)

    @pytest.mark.parametrize("circuit", CIRCUITS)
    @pytest.mark.parametrize("share", [0.02, 0.2, 0.9])
    def test_finds_the_breakdown_slip_of_a_circuit(self, circuit: Circuit, share: float) -> None:
        most, s_k, ratio = circuit.curve
        rated_slip = share * s_k
        overload = most / float(circuit.torque(rated_slip))
        assert motor.breakdown_slip(rated_slip, overload, ratio) == pytest.approx(s_k, rel=1e-6)
        assert ratio < motor.largest_stator_ratio(rated_slip, overload)

    @pytest.mark.parametrize(("slip", "overload"), [(0.04, 2.3), (0.3, 1.2)])
    def test_the_largest_stator_ratio_is_that_of_a_motor_without_stray_field(
        self, slip: float, overload: float
    ) -> None:
        """There a s_k = R_1/hypot(R_1, 0) = 1; the overload of such a circuit is 1/4 (r + 2 + 1/r), r = R_1 s/R_2."""
        r = brentq(lambda r: (r + 2 + 1 / r) / 4 - overload, 1e-6, 1.0)
        assert motor.largest_stator_ratio(slip, overload) == pytest.approx(r / slip, rel=1e-9)

    def test_a_rating_of_no_motor_is_refused(self) -> None:
        with pytest.raises(ValueError, match="no induction motor"):
            motor.breakdown_slip(0.04, 2.3, 1.0001 * motor.largest_stator_ratio(0.04, 2.3))


class TestKloss:
    @pytest.mark.parametrize("circuit", CIRCUITS)
    def test_is_the_torque_of_the_circuit(self, circuit: Circuit) -> None:
        """Driving, braking against the field and generating, far beyond breakdown."""
        assert motor.kloss(SLIPS, *circuit.curve) == pytest.approx(circuit.torque(SLIPS), rel=1e-9, abs=0)

    @pytest.mark.parametrize("slip", [0.0, 1e-300])
    def test_at_the_synchronous_speed(self, slip: float) -> None:
        assert motor.kloss(slip, 1000.0, 0.15) == pytest.approx(2 * 1000.0 / 0.15 * slip, rel=1e-14, abs=0)

    def test_without_a_stator_resistance_is_the_simplified_formula(self) -> None:
        """M = 2 M_k/(s/s_k + s_k/s), and M_k (s_k^2 - s^2) 2 s_k/(s^2 + s_k^2)^2."""
        s, s_k, most = np.linspace(0.01, 1.0, 25), 0.15, 1000.0
        assert motor.kloss(s, most, s_k) == pytest.approx(2 * most / (s / s_k + s_k / s), rel=1e-13, abs=0)
        slope = 2 * most * s_k * (s_k**2 - s**2) / (s**2 + s_k**2) ** 2
        assert motor.kloss_slope(s, most, s_k) == pytest.approx(slope, rel=1e-12, abs=1e-9)

    def test_generates_more_than_it_drives_by_the_stator_resistance(self) -> None:
        most, s_k, a = CIRCUITS[0].curve
        lowest = minimize_scalar(lambda s: float(CIRCUITS[0].torque(s)), bounds=(-1.0, -1e-3), method="bounded")
        assert -most * (1 + a * s_k) / (1 - a * s_k) == pytest.approx(float(lowest.fun), rel=1e-9)
        assert motor.kloss(-s_k, most, s_k, a) == pytest.approx(float(lowest.fun), rel=1e-9)

    @pytest.mark.parametrize("circuit", CIRCUITS)
    def test_slope(self, circuit: Circuit) -> None:
        for slip in SLIPS:
            step = 1e-5 * max(abs(slip), circuit.curve[1])
            around = circuit.torque([slip - 2 * step, slip - step, slip + step, slip + 2 * step])
            difference = float(around @ [1, -8, 8, -1]) / (12 * step)
            size = circuit.curve[0] / max(abs(slip), circuit.curve[1])
            assert motor.kloss_slope(slip, *circuit.curve) == pytest.approx(difference, rel=1e-7, abs=1e-8 * size)

    def test_slope_is_level_at_breakdown(self) -> None:
        assert motor.kloss_slope(0.2, 700.0, 0.2, 1.5) == 0.0

    @pytest.mark.parametrize("circuit", CIRCUITS)
    @pytest.mark.parametrize("share", [-1.0, -0.6, -1e-6, 0.0, 1e-9, 0.3, 0.97, 1.0])
    def test_slip_of_a_torque(self, circuit: Circuit, share: float) -> None:
        most, s_k, a = circuit.curve
        load = share * most
        found = float(motor.kloss_slip(load, most, s_k, a))
        flat = 1e-4 * s_k if abs(share) == 1 else 0.0  # where the torque does not tell the slip
        exact = brentq(lambda s: float(circuit.torque(s)) - load * (1 - 1e-12), -s_k, s_k, xtol=1e-15, rtol=1e-14)
        assert found == pytest.approx(exact, rel=1e-9, abs=flat + 1e-14)

    def test_beyond_breakdown_there_is_no_slip(self) -> None:
        most, s_k, a = CIRCUITS[0].curve
        deepest = -most * (1 + a * s_k) / (1 - a * s_k)
        assert motor.kloss_slip(0.999999 * deepest, most, s_k, a) > -s_k
        for torque in (1.000001 * most, 1.000001 * deepest):
            with pytest.raises(ValueError, match="breakdown"):
                motor.kloss_slip([0.0, torque], most, s_k, a)

    def test_a_hoist_takes_up_its_slack_rope(self) -> None:
        """The motor pulls its own mass through 50 mm of slack; numbers of two independent integrations."""
        torque, radius = 217.704, 0.2 / (40 * 2)
        v_synchronous, mass = 1000 * math.pi / 30 * radius, 1.1 * 0.85 / radius**2

        def right(_: float, y: NDArray[np.float64]) -> list[float]:
            slip = motor.slip(y[1], v_synchronous)
            return [y[1], float(motor.kloss(slip, 2.5 * torque, 0.167695)) * 0.85 / radius / mass]

        def taut(_: float, y: NDArray[np.float64]) -> float:
            return float(y[0]) - 0.05

        taut.terminal = True  # type: ignore[attr-defined]
        run = solve_ivp(right, (0, 2), [0.0, 0.0], method="DOP853", rtol=1e-10, atol=1e-12, events=taut)
        assert run.t[-1] == pytest.approx(0.41903, rel=2e-5)
        assert run.y[1, -1] == pytest.approx(0.261032, rel=2e-5)


class TestMeanOfKloss:
    @pytest.mark.parametrize("circuit", CIRCUITS)
    @pytest.mark.parametrize("ends", [(1.0, 0.0), (1.0, 0.03), (2.0, 1.0), (0.2, 0.20001), (0.1, -0.1), (0.0, -0.6)])
    def test_against_adaptive_quadrature(self, circuit: Circuit, ends: tuple[float, float]) -> None:
        area = quad(lambda s: float(circuit.torque(s)), *ends, epsabs=1e-9, epsrel=1e-12, limit=300)[0]
        mean = motor.mean_kloss_torque(*ends, *circuit.curve)
        size = 1e-10 * circuit.curve[0]
        nearest_pole = circuit.curve[1] * circuit.curve[2] > 0.9 and min(ends) < 0
        assert mean == pytest.approx(area / (ends[1] - ends[0]), rel=2e-6 if nearest_pole else 1e-9, abs=size)

    @pytest.mark.parametrize("s_k", [1e-12, 0.02, 0.4, 1.0, 30.0, 1e9])
    def test_of_a_whole_start_in_closed_form(self, s_k: float) -> None:
        """M_k s_k ln(1 + 1/s_k^2) for the simplified formula."""
        exact = 700.0 * s_k * (math.log1p(s_k**-2) if s_k > 1e-9 else -2 * math.log(s_k))
        assert motor.mean_kloss_torque(1.0, 0.0, 700.0, s_k) == pytest.approx(exact, rel=1e-12)

    def test_over_no_range_it_is_the_torque_there(self) -> None:
        assert motor.mean_kloss_torque(0.3, 0.3, 700.0, 0.2, 0.5) == pytest.approx(
            float(motor.kloss(0.3, 700.0, 0.2, 0.5)), rel=1e-14
        )


class TestRheostat:
    @pytest.mark.parametrize("circuit", CIRCUITS)
    @pytest.mark.parametrize("factor", [1.0, 1.7, 12.0])
    def test_a_stage_is_the_circuit_with_more_resistance(self, circuit: Circuit, factor: float) -> None:
        most, s_k, a = circuit.curve
        stage = replace(circuit, rotor=factor * circuit.rotor)
        wider = motor.stage_breakdown_slip(s_k, factor)
        assert motor.kloss(SLIPS, most, wider, a / factor) == pytest.approx(stage.torque(SLIPS), rel=1e-9, abs=0)

    @pytest.mark.parametrize("swing", [(0.9, 0.5), (0.7, 0.45), (0.99, 0.2)])
    @pytest.mark.parametrize("circuit", CIRCUITS[:2])
    def test_the_torque_swings_between_both(self, circuit: Circuit, swing: tuple[float, float]) -> None:
        most, s_k, a = circuit.curve
        high, low = swing[0] * most, swing[1] * most
        slips = motor.kloss_slip([high, low], most, s_k, a)
        factors = motor.rheostat_factors(*slips)
        speeds = motor.switching_speed(factors, float(slips[1]), circuit.field)
        stages = [replace(circuit, rotor=float(f) * circuit.rotor) for f in (*factors, 1.0)]
        assert np.all(np.diff([*factors, 1.0]) < 0)
        assert stages[0].torque(1.0) == pytest.approx(high, rel=1e-9)
        for before, after, speed in zip(stages[:-1], stages[1:], speeds, strict=True):
            slip = 1 - speed / circuit.field
            assert before.torque(slip) == pytest.approx(low, rel=1e-9)
            if after is stages[-1]:
                assert low < after.torque(slip) <= high * (1 + 1e-9)
            else:
                assert after.torque(slip) == pytest.approx(high, rel=1e-9)

    def test_steps_that_end_on_the_natural_curve_have_no_step_too_many(self) -> None:
        for steps in range(1, 9):
            factors = motor.rheostat_factors(0.1, 0.1 ** (1 + 1 / steps))
            assert len(factors) == steps
            assert factors == pytest.approx(10.0 ** (1 - np.arange(steps) / steps), rel=1e-12)
            assert len(motor.rheostat_factors(0.1, 0.1 ** (1 + (1 - 1e-6) / steps))) == steps + 1


class TestLinear:
    def test_has_half_the_torque_at_half_the_speed_and_brakes_above(self) -> None:
        assert motor.linear_torque([0.0, 75.0, 150.0, 300.0, -150.0], 80.0, 150.0).tolist() == [80, 40, 0, -80, 160]

    def test_comes_up_as_its_closed_form(self) -> None:
        inertia = 0.7
        run = solve_ivp(
            lambda _, w: motor.linear_torque(w, 80.0, 150.0) / inertia, (0, 2), [0.0], rtol=1e-10, atol=1e-12
        )
        assert run.y[0, -1] == pytest.approx(-150 * math.expm1(-2 * 80 / 150 / inertia), rel=1e-8)


class TestConverter:
    def test_reference(self) -> None:
        times = [-1.0, 0.0, 1.0, 4.0, 9.0]
        assert motor.converter_reference(times, 120.0, 4.0).tolist() == [0, 0, 30, 120, 120]
        assert motor.converter_reference(times, 120.0, 0.0).tolist() == [0, 120, 120, 120, 120]

    def test_torque_is_that_of_a_spring_of_speed_within_its_limit(self) -> None:
        speeds = [0.0, 90.0, 99.0, 100.0, 101.0, 200.0]
        assert motor.converter_torque(speeds, 100.0, 5.0, 40.0).tolist() == [40, 40, 5, 0, -5, -40]

    def test_droops_by_the_load_and_drags_behind_the_ramp_by_the_inertia(self) -> None:
        inertia, load, stiffness, ramp = 2.0, 20.0, 8.0, 30.0

        def right(t: float, w: NDArray[np.float64]) -> NDArray[np.float64]:
            reference = motor.converter_reference(t, 120.0, 4.0)
            return (motor.converter_torque(w, reference, stiffness, 100.0) - load) / inertia

        run = solve_ivp(right, (0, 4), [0.0], rtol=1e-9, atol=1e-10)
        assert 120.0 - run.y[0, -1] == pytest.approx((load + inertia * ramp) / stiffness, rel=1e-5)
        end = solve_ivp(right, (4, 12), run.y[:, -1], rtol=1e-9, atol=1e-10)
        assert 120.0 - end.y[0, -1] == pytest.approx(load / stiffness, rel=1e-6)
