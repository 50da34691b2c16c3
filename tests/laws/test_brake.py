"""Brakes against integration of the turning body with an event at rest."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad, solve_ivp

from ptmcalc.laws import brake
from ptmcalc.laws.brake import EXPONENTIAL, LINEAR

steady = settings(derandomize=True, database=None, deadline=None, max_examples=60)
J, SPEED, TORQUE, DELAY, RISE = 3.2, 104.0, 700.0, 0.15, 0.3
OTHERS = [-300.0, -3000.0, 0.0, 250.0, 680.0]


def closing(t: float, torque: float, delay: float, rise: float, shape: str) -> float:
    """Torque of the brake written for one instant, apart from the law."""
    if t < delay:
        return 0.0
    if rise == 0:
        return torque
    if shape == EXPONENTIAL:
        return torque * (1 - 2.718281828459045 ** (-(t - delay) / rise))
    return torque if t > delay + rise else torque * (t - delay) / rise


def run_out(
    speed: float, torque: float, other: float, delay: float, rise: float, shape: str
) -> tuple[float, float, float]:
    """(time, angle, heat in the brake), integrated from corner to corner of the torque."""

    def rest(t: float, y: np.ndarray) -> float:
        return float(y[1])

    rest.terminal, rest.direction = True, -1.0  # type: ignore[attr-defined]
    state, start = np.array([0.0, speed, 0.0]), 0.0
    for end in [delay, delay + rise, 1e4]:
        if end <= start:
            continue
        middle = (start + end) / 2 if end < 1e4 else None

        def rate(
            t: float, y: np.ndarray, inside: float | None = middle, low: float = start, top: float = end
        ) -> list[float]:
            at = float(np.clip(t, np.nextafter(low, top), np.nextafter(top, low)))
            braked = closing(at, torque, delay, rise, shape)
            return [y[1], (other - braked) / J, braked * y[1]]

        run = solve_ivp(rate, (start, end), state, events=rest, rtol=1e-11, atol=1e-12)
        state, start = run.y[:, -1], run.t[-1]
        if run.status == 1:
            break
    return float(start), float(state[0]), float(state[2])


class TestTorque:
    @pytest.mark.parametrize("shape", [LINEAR, EXPONENTIAL])
    @pytest.mark.parametrize("rise", [0.0, 0.3])
    def test_closes_as_told(self, shape: str, rise: float) -> None:
        times = np.array([0.0, 0.1499, 0.15001, 0.2, 0.449, 0.46, 5.0])
        expected = [closing(float(t), TORQUE, DELAY, rise, shape) for t in times]
        assert brake.braking_torque(times, TORQUE, DELAY, rise, shape) == pytest.approx(expected, rel=1e-12)


class TestStop:
    @pytest.mark.parametrize("shape", [LINEAR, EXPONENTIAL])
    @pytest.mark.parametrize("other", OTHERS)
    @pytest.mark.parametrize("rise", [0.0, 0.3, 2.5])
    @pytest.mark.parametrize("delay", [0.0, 0.15])
    @pytest.mark.parametrize("speed", [0.5, 104.0])
    def test_time_angle_and_heat(self, shape: str, other: float, rise: float, delay: float, speed: float) -> None:
        """A brake that just opposes the load, one that finds the body at rest already, and all between."""
        time, angle, heat = run_out(speed, TORQUE, other, delay, rise, shape)
        found = brake.brake_stop(J, speed, TORQUE, other, delay, rise, shape)
        assert found == pytest.approx((time, angle), rel=1e-7)
        assert brake.stop_heat(J, speed, other, found[1]) == pytest.approx(heat, rel=1e-6, abs=1e-6)

    @pytest.mark.parametrize("shape", [LINEAR, EXPONENTIAL])
    def test_a_brake_too_weak_never_stops(self, shape: str) -> None:
        assert brake.brake_stop(J, SPEED, TORQUE, TORQUE, DELAY, RISE, shape) == (np.inf, np.inf)
        assert brake.brake_stop(J, SPEED, TORQUE, 900.0, DELAY, RISE, shape) == (np.inf, np.inf)

    def test_at_once_it_is_a_uniform_stop(self) -> None:
        time, angle = brake.brake_stop(J, SPEED, TORQUE, 0.0, 0.0, 0.0, LINEAR)
        assert time == pytest.approx(J * SPEED / TORQUE, rel=1e-14)
        assert brake.uniform_stop_time(angle, SPEED) == pytest.approx(time, rel=1e-14)

    def test_a_body_at_rest_stops_in_no_time_unless_a_load_pulls(self) -> None:
        for shape in (LINEAR, EXPONENTIAL):
            assert brake.brake_stop(J, 0.0, TORQUE, -5.0, DELAY, RISE, shape) == (0.0, 0.0)
            assert brake.brake_stop(J, 0.0, TORQUE, 0.0, 0.0, RISE, shape) == (0.0, 0.0)
            pulled = brake.brake_stop(J, 0.0, TORQUE, 250.0, DELAY, RISE, shape)
            assert pulled == pytest.approx(run_out(1e-14, TORQUE, 250.0, DELAY, RISE, shape)[:2], rel=1e-6)

    @given(
        st.floats(0.1, 50),
        st.floats(0, 1),
        st.one_of(st.just(0.0), st.floats(0.01, 1)),
        st.floats(-500, 600),
        st.sampled_from([LINEAR, EXPONENTIAL]),
    )
    @steady
    def test_momentum_is_the_integral_of_the_torques(
        self, speed: float, delay: float, rise: float, other: float, shape: str
    ) -> None:
        time, _ = brake.brake_stop(J, speed, TORQUE, other, delay, rise, shape)
        points = sorted({min(delay, time), min(delay + rise, time)})
        braked = sum(
            quad(closing, low, high, args=(TORQUE, delay, rise, shape), epsabs=1e-12, epsrel=1e-12)[0]
            for low, high in zip([0.0, *points], [*points, time], strict=True)
            if high > low
        )
        assert J * speed + other * time == pytest.approx(braked, rel=1e-6, abs=1e-6)


class TestTorqueForTime:
    @pytest.mark.parametrize("shape", [LINEAR, EXPONENTIAL])
    @pytest.mark.parametrize("other", [-300.0, 0.0, 250.0])
    @pytest.mark.parametrize(("delay", "rise"), [(0.0, 0.0), (0.15, 0.3), (0.15, 4.0)])
    @pytest.mark.parametrize("time", [0.3, 0.55, 0.9])
    def test_stops_in_that_time(self, shape: str, other: float, delay: float, rise: float, time: float) -> None:
        torque = brake.brake_torque_for_time(J, SPEED, time, other, delay, rise, shape)
        assert run_out(SPEED, torque, other, delay, rise, shape)[0] == pytest.approx(time, rel=1e-7)

    def test_none_where_friction_is_enough_and_none_that_would_do_before_it_acts(self) -> None:
        assert brake.brake_torque_for_time(J, SPEED, 1.2 * J * SPEED / 300, -300.0, DELAY, RISE, LINEAR) == 0.0
        assert brake.brake_torque_for_time(J, SPEED, 0.1, 0.0, DELAY, RISE, LINEAR) == np.inf


class TestReserve:
    def test_tells_whether_the_brake_holds(self) -> None:
        """At rest a load of torque M_st moves exactly where the reserve is below 1."""
        for torque, static in ((700.0, 400.0), (700.0, 699.0), (700.0, 701.0)):
            moves = static - min(static, torque) > 0
            assert (brake.brake_reserve(torque, static) < 1) == moves
        assert brake.brake_reserve(700.0, 400.0) * 400.0 == pytest.approx(700.0, rel=1e-15)
        assert brake.brake_reserve(700.0, 0.0) == np.inf


def test_slewing_brake_angle_in_printed_units() -> None:
    """15 degrees at 1.5 rpm: t = 60 beta/(pi n)."""
    n, beta = 1.5, np.pi / 12
    assert brake.uniform_stop_time(beta, 2 * np.pi * n / 60) == pytest.approx(60 * beta / (np.pi * n), rel=1e-14)
