"""Closed forms of the two-mass hoist against the event-driven integration of its equations of motion."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import eigh
from support.twomass import stretch_history

from ptmcalc.laws import two_mass

DRIVE, LOAD, K = 18e3, 5e3, 1.2e6
Q = LOAD * 9.81
PERIOD = 2 * np.pi / np.sqrt(K * (1 / DRIVE + 1 / LOAD))


def refined(times: np.ndarray, forces: np.ndarray) -> tuple[float, float]:
    """Largest value and its time, through the parabola about the largest sample."""
    k = int(np.clip(np.argmax(forces), 1, len(forces) - 2))
    a, b, c = np.polyfit(times[k - 1 : k + 2] - times[k], forces[k - 1 : k + 2], 2)
    return float(c - b**2 / (4 * a)), float(times[k] - b / (2 * a))


class TestFrequency:
    @pytest.mark.parametrize(("one", "two"), [(18e3, 5e3), (1.0, 1.0), (1e3, 7.0)])
    def test_is_the_second_eigenvalue(self, one: float, two: float) -> None:
        square = eigh(K * np.array([[1, -1], [-1, 1]]), np.diag([one, two]), eigvals_only=True)
        assert two_mass.two_mass_frequency(K, one, two) == pytest.approx(np.sqrt(square[1]), rel=1e-12)


class TestTakeup:
    @pytest.mark.parametrize("pull", [0.7, 1.0, 1.6, 3.0])
    @pytest.mark.parametrize("speed", [0.0, 0.25, 1.5])
    @pytest.mark.parametrize("drive_mass", [900.0, 18e3, 1e6])
    def test_against_the_equations_of_motion(self, pull: float, speed: float, drive_mass: float) -> None:
        drive = pull * Q
        slow = 2 * np.pi * np.sqrt(drive_mass / K)
        times, forces, lift = stretch_history(
            drive_mass, LOAD, K, lambda t, v: drive, Q, (0.0, speed, 0.0), 1.2 * slow + PERIOD, grounded=True
        )
        found = two_mass.takeup(drive_mass, LOAD, K, drive, Q, speed)
        assert found.lifted
        assert found.time == pytest.approx(lift, rel=1e-7)
        first = forces[: int(np.argmax(np.diff(np.sign(np.diff(forces))) < 0)) + 3]  # up to the first maximum
        assert found.peak_force == pytest.approx(refined(times[: len(first)], first)[0], rel=2e-7)

    @pytest.mark.parametrize("speed", [0.0, 0.05])
    def test_a_drive_too_weak_swings_against_a_wall(self, speed: float) -> None:
        drive = 0.4 * Q
        until = 2 * np.pi * np.sqrt(DRIVE / K)
        times, forces, lift = stretch_history(
            DRIVE, LOAD, K, lambda t, v: drive, Q, (0.0, speed, 0.0), until, grounded=True
        )
        found = two_mass.takeup(DRIVE, LOAD, K, drive, Q, speed)
        assert np.isinf(lift)
        assert not found.lifted
        assert found.lift_off_speed == 0.0
        peak, when = refined(times, forces)
        assert found.peak_force == pytest.approx(peak, rel=1e-7)
        assert found.time == pytest.approx(when, rel=1e-6)

    def test_speed_lifts_what_force_could_not(self) -> None:
        weak = 0.4 * Q
        needed = np.sqrt(Q * (Q - 2 * weak) / (K * DRIVE))
        assert two_mass.takeup(DRIVE, LOAD, K, weak, Q, 1.001 * needed).lifted
        assert not two_mass.takeup(DRIVE, LOAD, K, weak, Q, 0.999 * needed).lifted

    def test_both_branches_meet_where_the_load_is_just_not_lifted(self) -> None:
        weak = 0.4 * Q
        needed = np.sqrt(Q * (Q - 2 * weak) / (K * DRIVE))
        exact = two_mass.takeup(DRIVE, LOAD, K, 2.0**15, 2.0**16, 0.0)  # from rest it just brings twice its force
        assert (exact.lifted, exact.peak_force, exact.lift_off_speed) == (False, 2.0**16, 0.0)
        above = two_mass.takeup(DRIVE, LOAD, K, weak, Q, needed * (1 + 1e-12))
        below = two_mass.takeup(DRIVE, LOAD, K, weak, Q, needed * (1 - 1e-12))
        assert above.peak_force == pytest.approx(Q, rel=1e-5)
        assert below.peak_force == pytest.approx(Q, rel=1e-5)
        assert above.time == pytest.approx(below.time, rel=1e-4)

    def test_a_load_that_weighs_nothing_is_lifted_at_once(self) -> None:
        found = two_mass.takeup(DRIVE, LOAD, K, 5e4, 0.0, 0.3)
        assert (found.time, found.lift_off_speed, found.lifted) == (0.0, pytest.approx(0.3, rel=1e-14), True)
        mu = DRIVE * LOAD / (DRIVE + LOAD)
        mean = 5e4 * LOAD / (DRIVE + LOAD)
        assert found.peak_force == pytest.approx(mean + np.sqrt(mean**2 + K * mu * 0.3**2), rel=1e-13)


class TestSpeedStep:
    def test_is_a_take_up_by_an_endless_drive_mass(self) -> None:
        times, forces, _ = stretch_history(1e12, LOAD, K, lambda t, v: 0.0, Q, (0.0, 0.25, 0.0), 0.7, grounded=True)
        assert two_mass.speed_step_force(0.25, K, LOAD, Q) == pytest.approx(refined(times, forces)[0], rel=1e-7)

    def test_is_an_instantaneous_stop_while_lowering(self) -> None:
        times, forces, _ = stretch_history(1e12, LOAD, K, lambda t, v: Q, Q, (Q / K, 0.0, -0.4), 0.5, grounded=False)
        assert two_mass.speed_step_force(0.4, K, LOAD, Q) == pytest.approx(refined(times, forces)[0], rel=1e-7)


class TestHangingStart:
    @pytest.mark.parametrize("pull", [1.6, 2.5])
    def test_of_a_force(self, pull: float) -> None:
        times, forces, _ = stretch_history(
            DRIVE, LOAD, K, lambda t, v: pull * Q, Q, (Q / K, 0.0, 0.0), PERIOD, grounded=False
        )
        assert two_mass.hanging_start_force(pull * Q, Q, DRIVE, LOAD) == pytest.approx(
            refined(times, forces)[0], rel=1e-7
        )

    def test_of_a_force_less_than_the_weight_unloads_the_rope(self) -> None:
        times, forces, _ = stretch_history(
            DRIVE, LOAD, K, lambda t, v: 0.5 * Q, Q, (Q / K, 0.0, 0.0), PERIOD, grounded=False
        )
        assert two_mass.hanging_start_force(0.5 * Q, Q, DRIVE, LOAD) == pytest.approx(
            -refined(times, -forces)[0], rel=1e-7
        )


class TestLoweringBrake:
    @pytest.mark.parametrize("delay", [0.0, 0.07, 0.18, 0.203, 0.3])
    @pytest.mark.parametrize("factor", [0.6, 1.0, 1.75, 2.5])
    def test_against_the_equations_of_motion(self, delay: float, factor: float) -> None:
        """The drive is kept from stopping by a high speed; the force is the rope's largest after the brake is on."""
        brake = factor * Q

        def force(t: float, v: float) -> float:
            return brake if t >= delay else 0.0

        start = (Q / K, -50.0, -50.0)
        if delay > 0:
            early = stretch_history(DRIVE, LOAD, K, lambda t, v: 0.0, Q, start, delay, grounded=False)
            assert early[1].max() <= Q * (1 + 1e-9)  # without a brake the rope only loses force
        times, forces, _ = stretch_history(DRIVE, LOAD, K, force, Q, start, delay + PERIOD, grounded=False)
        found = float(two_mass.lowering_brake_force(brake, Q, delay, DRIVE, LOAD, K))
        assert found == pytest.approx(max(refined(times, forces)[0], forces.max()), rel=2e-6)

    def test_worst_delay_is_half_a_period(self) -> None:
        forces = two_mass.lowering_brake_force(1.75 * Q, Q, np.linspace(0, PERIOD, 1001), DRIVE, LOAD, K)
        assert int(np.argmax(forces)) == 500
        assert forces[500] == pytest.approx(Q + 2 * 1.75 * Q * LOAD / (DRIVE + LOAD), rel=1e-12)


class TestHoistingStop:
    def smallest(self, drive: float, brake: float, speed: float) -> float:
        """The drive runs out under brake and rope; where its speed is 0 the brake holds it and the load swings on."""

        def running(t: float, s: np.ndarray) -> list[float]:  # stretch, speeds of drive and load
            return [s[1] - s[2], -(brake + K * s[0]) / drive, (K * s[0] - Q) / LOAD]

        def held(t: float, s: np.ndarray) -> list[float]:
            return [-s[1], (K * s[0] - Q) / LOAD]

        def stops(t: float, s: np.ndarray) -> float:
            return float(s[1])

        stops.terminal = True  # type: ignore[attr-defined]
        accuracy = {"rtol": 1e-10, "atol": 1e-12, "dense_output": True, "max_step": 0.01}
        run = solve_ivp(running, (0, 5.0), [Q / K, speed, speed], events=stops, **accuracy)
        swing = solve_ivp(held, (0, 0.6), run.y[[0, 2], -1], **accuracy)
        stretches = [run.sol(np.linspace(0, run.t[-1], 20001))[0], swing.sol(np.linspace(0, 0.6, 20001))[0]]
        return K * float(min(stretch.min() for stretch in stretches))

    @pytest.mark.parametrize("drive", [8e4, 2e4])
    @pytest.mark.parametrize("brake", [1.2, 2.5])
    @pytest.mark.parametrize("speed", [0.01, 0.05, 0.3, 2.0])
    def test_bounds_the_rope_from_below(self, drive: float, brake: float, speed: float) -> None:
        bound = two_mass.hoisting_stop_force(speed, brake * Q, Q, drive, LOAD, K)
        found = self.smallest(drive, brake * Q, speed)
        assert found >= bound - 1e-6 * Q

    def test_is_reached_by_a_long_stop_and_by_an_instantaneous_one(self) -> None:
        long = two_mass.hoisting_stop_force(3.0, 1.5 * Q, Q, 8e4, LOAD, K)
        assert self.smallest(8e4, 1.5 * Q, 3.0) == pytest.approx(long, rel=1e-6)
        short = two_mass.hoisting_stop_force(0.1, 1e9, Q, 1e4, LOAD, K)
        assert self.smallest(1e4, 1e9, 0.1) == pytest.approx(short, rel=1e-5)
