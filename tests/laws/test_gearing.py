"""The mesh rule against a gear with explicit tooth friction: balances of both shafts, loss by the sign of the power.

Reference: the mesh takes a loss torque from the fast shaft that always opposes the motion, (1/eta - 1)|T_out|/u when
the motor drives and (1 - eta_r)|T_out|/u when the load does; accelerations are found by bisection on the balance.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from ptmcalc.laws import gearing

steady = settings(derandomize=True, database=None, deadline=None, max_examples=150)
RATIO, ETA, ETA_BACK = 40.0, 0.85, 0.81
HOIST = (0.9, 400.0, RATIO, ETA, ETA_BACK)  # rotor, load on the drum
LOAD = 19620.0
MODES = [(60.0, 1.0), (-60.0, 1.0), (-60.0, -1.0), (60.0, -1.0)]  # hoist and lower, start and brake


def friction(output: float, way: float, forward: float = ETA, backward: float = ETA_BACK) -> float:
    """Loss torque on the fast shaft, against the motion."""
    lost = (1 / forward - 1) if output * way > 0 else (1 - backward)
    return way * lost * abs(output) / RATIO


def missing_torque(acceleration: float, way: float, torque: float, load: float, train: tuple[float, ...]) -> float:
    rotor, slow, ratio, forward, backward = train
    output = load + slow * acceleration / ratio
    return torque - rotor * acceleration - output / ratio - friction(output, way, forward, backward)


class TestReverseEfficiency:
    @pytest.mark.parametrize("eta", [0.3, 0.5, 0.7, 0.97, 1.0])
    def test_comes_from_the_same_loss_torque_both_ways(self, eta: float) -> None:
        """Per unit of output torque times ratio: the loss is 1/eta - 1 driven forward, 1 - eta_r driven backward."""
        assert 1 - gearing.reverse_efficiency(eta) == pytest.approx(1 / eta - 1, rel=1e-12, abs=1e-15)

    def test_a_worm_below_a_half_locks_itself(self) -> None:
        assert gearing.reverse_efficiency(0.5) == 0.0
        assert gearing.reverse_efficiency(0.4) < 0 < gearing.reverse_efficiency(0.6)


class TestInputTorque:
    @given(st.floats(-1e5, 1e5), st.sampled_from([-1.0, 1.0]), st.floats(0.3, 1.0), st.floats(-1.0, 1.0))
    @steady
    def test_is_lossless_torque_and_friction(self, output: float, way: float, eta: float, back: float) -> None:
        found = float(gearing.input_torque(output, way, RATIO, eta, back))
        assert found == pytest.approx(output / RATIO + friction(output, way, eta, back), rel=1e-10, abs=1e-10)

    @given(st.floats(-1e5, 1e5), st.sampled_from([-157.0, 157.0]))
    @steady
    def test_the_mesh_never_gives_power(self, output: float, speed: float) -> None:
        found = float(gearing.input_torque(output, speed, RATIO, ETA, ETA_BACK))
        assert found * speed >= output * speed / RATIO - 1e-9 * abs(output * speed)

    def test_a_self_locking_gear_has_to_be_pushed_down(self) -> None:
        torque = gearing.input_torque(1000.0, -1.0, 50.0, 0.4, gearing.reverse_efficiency(0.4))
        assert torque == pytest.approx(-10.0, rel=1e-12)  # 20 N m lossless, 30 N m friction


class TestMotorTorque:
    @pytest.mark.parametrize(("acceleration", "way"), MODES)
    def test_balances_both_shafts(self, acceleration: float, way: float) -> None:
        torque = float(gearing.motor_torque(acceleration, way, LOAD, *HOIST))
        assert missing_torque(acceleration, way, torque, LOAD, HOIST) == pytest.approx(0, abs=1e-9)

    @pytest.mark.parametrize("way", [1.0, -1.0])
    @pytest.mark.parametrize(("acceleration", "load"), [(70.0, 0.0), (-70.0, 0.0), (0.0, 5000.0)])
    def test_the_handbook_agrees_where_only_one_torque_acts(self, acceleration: float, load: float, way: float) -> None:
        exact = gearing.motor_torque(acceleration, way, load, *HOIST)
        assert gearing.motor_torque_seed_rule(acceleration, way, load, *HOIST) == pytest.approx(float(exact), rel=1e-13)

    @pytest.mark.parametrize(("acceleration", "way"), MODES)
    def test_the_handbook_errs_by_the_friction_it_counts_twice(self, acceleration: float, way: float) -> None:
        inertia = 400.0 * acceleration / RATIO
        one_sign = LOAD * inertia > 0
        exact = gearing.motor_torque(acceleration, way, LOAD, *HOIST)
        difference = gearing.motor_torque_seed_rule(acceleration, way, LOAD, *HOIST) - exact
        parts = friction(LOAD, way) + friction(inertia, way) - friction(LOAD + inertia, way)
        assert difference == pytest.approx(parts, abs=1e-9)
        expected = 0.0 if one_sign else (1 / ETA - ETA_BACK) / RATIO * abs(inertia)
        assert abs(float(difference)) == pytest.approx(expected, abs=1e-9)


class TestMotorAcceleration:
    @given(
        st.floats(-2e3, 2e3), st.sampled_from([-1.0, 1.0]), st.floats(-4e4, 4e4), st.floats(0.01, 5.0),
        st.floats(0.0, 2e3), st.floats(0.55, 1.0),
    )  # fmt: skip
    @steady
    def test_is_the_root_of_the_balance(
        self, torque: float, way: float, load: float, rotor: float, slow: float, eta: float
    ) -> None:
        train = (rotor, slow, RATIO, eta, gearing.reverse_efficiency(eta))
        found = float(gearing.motor_acceleration(torque, way, load, *train))
        root = brentq(missing_torque, -1e7, 1e7, args=(way, torque, load, train), xtol=1e-9, rtol=1e-13)
        assert found == pytest.approx(root, rel=1e-7, abs=1e-6)

    @pytest.mark.parametrize(("acceleration", "way"), MODES)
    def test_takes_back_what_the_torque_asked(self, acceleration: float, way: float) -> None:
        torque = gearing.motor_torque(acceleration, way, LOAD, *HOIST)
        assert gearing.motor_acceleration(torque, way, LOAD, *HOIST) == pytest.approx(acceleration, rel=1e-12)

    def test_a_start_in_time(self) -> None:
        """Motor torque falling with speed, load and gear: the speed after a second by an integrator on the balance."""

        def torque(speed: float) -> float:
            return 900.0 * (1 - speed / 157.0)

        def rate(t: float, y: np.ndarray) -> list[float]:
            speed = float(y[0])
            return [brentq(missing_torque, -1e5, 1e5, args=(1.0, torque(speed), LOAD, HOIST), rtol=1e-13)]

        def rate_by_law(t: float, y: np.ndarray) -> np.ndarray:
            return gearing.motor_acceleration(900.0 * (1 - y / 157.0), 1.0, LOAD, *HOIST)

        by_balance = solve_ivp(rate, (0, 0.2), [0.0], rtol=1e-9).y[0, -1]
        assert solve_ivp(rate_by_law, (0, 0.2), [0.0], rtol=1e-9).y[0, -1] == pytest.approx(by_balance, rel=1e-7)


class TestJams:
    @pytest.mark.parametrize("eta", [0.3, 0.4, 0.49, 0.6])
    @pytest.mark.parametrize("rotor", [0.01, 0.1, 0.5, 3.0])
    def test_where_the_balance_has_no_root_while_the_load_drives(self, eta: float, rotor: float) -> None:
        """Under a strong brake the mesh is driven by the load; without lock-up one deceleration fits."""
        slow, way, brake = 800.0, 1.0, -500.0
        train = (rotor, slow, RATIO, eta, gearing.reverse_efficiency(eta))
        rates = -np.geomspace(1e-3, 1e9, 400)
        balance = np.array([missing_torque(float(a), way, brake, 0.0, train) for a in rates])
        solvable = bool(np.any(balance > 0))  # at no deceleration the brake is in excess
        assert gearing.jams(rotor, slow, RATIO, gearing.reverse_efficiency(eta)) == (not solvable)
        found = float(gearing.motor_acceleration(brake, way, 0.0, *train))
        assert found < 0
        assert np.isfinite(found) == solvable

    @given(st.floats(0.01, 5), st.floats(0, 1e4), st.floats(0.501, 1.0))
    @steady
    def test_never_above_an_efficiency_of_a_half(self, rotor: float, slow: float, eta: float) -> None:
        assert not gearing.jams(rotor, slow, RATIO, gearing.reverse_efficiency(eta))

    def test_the_motor_driving_never_jams(self) -> None:
        train = (0.01, 800.0, RATIO, 0.4, gearing.reverse_efficiency(0.4))
        assert gearing.jams(0.01, 800.0, RATIO, gearing.reverse_efficiency(0.4))
        assert 0 < float(gearing.motor_acceleration(500.0, 1.0, 0.0, *train)) < np.inf
