"""Clearances by geometry, and the blow through a gap against integration of the motor and both masses."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.twomass import stretch_history

from ptmcalc.laws import backlash

J1, C, M = 1.0, 5e3, 120.0


class TestClearances:
    def test_new_gears_step_by_the_preferred_numbers(self) -> None:
        """50, 80, 130 are steps of the R5 series, 10^(1/5) = 1.585, rounded; the cube root doubles over 8 times the
        distance."""
        classes = [backlash.new_clearance(0.25, k) for k in (2, 3, 4)]
        assert classes[1] / classes[0] == pytest.approx(10**0.2, rel=0.03)
        assert classes[2] / classes[1] == pytest.approx(10**0.2, rel=0.03)
        for k in (2, 3, 4):
            assert backlash.new_clearance(2.0, k) == pytest.approx(2 * backlash.new_clearance(0.25, k), rel=1e-14)

    def test_one_metre_by_hand(self) -> None:
        """The cube root of 1000 is 10: 500, 800, 1300 micrometres."""
        assert [backlash.new_clearance(1.0, k) for k in (2, 3, 4)] == pytest.approx([5e-4, 8e-4, 1.3e-3], rel=1e-14)

    @pytest.mark.parametrize("both", [False, True])
    def test_wear_widens_the_gap_by_what_the_teeth_lose(self, both: bool) -> None:
        """A rack of pitch pi m: gap and tooth fill it, when new the tooth takes half less the clearance."""
        module, new, share = 0.008, 4e-4, 0.2
        thickness = math.pi * module / 2
        lost = share * thickness
        gap = math.pi * module - (thickness - lost)  # of one rack, beside its worn tooth
        other = thickness - new - (lost if both else 0.0)  # the tooth of the other rack in it
        free = gap - other
        assert backlash.worn_clearance(new, share, module, both) == pytest.approx(free, rel=1e-12)
        assert backlash.wear_share(lost, module) == pytest.approx(share, rel=1e-14)

    def test_angle_is_the_turn_of_the_pitch_circle(self) -> None:
        clearance, radius, pressure = 5e-4, 0.14, math.radians(20)
        turn = backlash.clearance_angle(clearance, radius, 0.0)
        moved = radius * np.array([math.cos(turn) - 1, math.sin(turn)])
        assert moved[1] == pytest.approx(clearance, rel=1e-5)
        turn = backlash.clearance_angle(clearance, radius, pressure)
        flank = np.array([math.sin(pressure), math.cos(pressure)])  # its normal, against the tangent
        moved = radius * np.array([math.cos(turn) - 1, math.sin(turn)])
        assert moved @ flank == pytest.approx(clearance, rel=2e-3)

    def test_on_the_motor_shaft_is_what_the_motor_turns_until_the_last_gap_is_closed(self) -> None:
        """The train as shafts that follow only beyond their gap, driven slowly from the motor."""
        gaps, stages = np.array([0.002, 0.004, 0.003]), np.array([4.0, 5.0, 3.0])  # on the input shaft of each stage
        cumulative = np.concatenate([[1.0], np.cumprod(stages)[:-1]])

        def last_shaft(motor: float) -> float:
            angle = motor
            for gap, ratio in zip(gaps, stages, strict=True):
                angle = max(angle - gap, 0.0) / ratio
            return angle

        total = backlash.clearance_on_motor_shaft(gaps, cumulative)
        assert last_shaft(total * (1 - 1e-9)) == 0.0
        assert last_shaft(total * (1 + 1e-6)) > 0.0


class TestGapClosing:
    @pytest.mark.parametrize("limit", [np.inf, 20.0, 3.0])
    def test_by_integration(self, limit: float) -> None:
        gap = 0.9

        def run(t: float, s: np.ndarray) -> list[float]:
            return [min(s[1], limit), M / J1]

        def closed(t: float, s: np.ndarray) -> float:
            return s[0] - gap

        closed.terminal = True  # type: ignore[attr-defined]
        done = solve_ivp(run, (0, 10), [0.0, 0.0], events=closed, rtol=1e-10, atol=1e-12, max_step=1e-3)
        speed, time = backlash.gap_closing(M, gap, J1, limit)
        assert time == pytest.approx(done.t[-1], rel=1e-6)
        assert speed == pytest.approx(min(done.y[1, -1], limit), rel=1e-6)

    def test_energy(self) -> None:
        speed, _ = backlash.gap_closing(M, 0.02, J1, np.inf)
        assert J1 * speed**2 / 2 == pytest.approx(M * 0.02, rel=1e-14)


def simulated_peak(gap: float, load_inertia: float, static: float, limit: float = np.inf) -> float:
    """First peak behind the gap: free run by energy, then the train with the load held until the shaft beats M_s."""
    speed = min(math.sqrt(2 * M * gap / J1), limit)
    until = 2.5 * math.pi / math.sqrt(C / J1)
    _, torques, _ = stretch_history(
        J1, load_inertia, C, lambda t, v: M, static, (0.0, speed, 0.0), until, grounded=static > 0
    )
    falls = np.flatnonzero(np.diff(torques) < 0)
    return float(torques[: falls[0] + 1].max() if len(falls) else torques.max())


class TestPeak:
    @pytest.mark.parametrize("load_inertia", [0.5, 7.0])
    @pytest.mark.parametrize("gap", [0.0, 0.0015, 0.05])
    def test_without_static_load(self, gap: float, load_inertia: float) -> None:
        number = backlash.backlash_number(M, gap, C, J1, load_inertia)
        without = simulated_peak(0.0, load_inertia, 0.0)
        ratio = simulated_peak(gap, load_inertia, 0.0) / without
        assert float(backlash.backlash_peak_ratio(number)) == pytest.approx(ratio, rel=1e-5)
        peak = backlash.backlash_peak_torque(M, gap, C, J1, load_inertia, 0.0, np.inf)
        assert peak == pytest.approx(ratio * without, rel=1e-5)

    @pytest.mark.parametrize("static", [30.0, 100.0])
    @pytest.mark.parametrize("limit", [np.inf, 1.0])
    def test_with_static_load_and_a_limited_speed(self, static: float, limit: float) -> None:
        peak = backlash.backlash_peak_torque(M, 0.02, C, J1, 2.0, static, limit)
        assert peak == pytest.approx(simulated_peak(0.02, 2.0, static, limit), rel=1e-5)

    @pytest.mark.parametrize("seed", range(20))
    def test_the_ratio_bounds_trains_with_static_load(self, seed: int) -> None:
        rng = np.random.default_rng(seed)
        load, gap, static = 10 ** rng.uniform(-1, 1), 10 ** rng.uniform(-4, -1), rng.uniform(0.1, 1.5) * M
        bound = float(backlash.backlash_peak_ratio(backlash.backlash_number(M, gap, C, J1, load)))
        assert simulated_peak(gap, load, static) / simulated_peak(0.0, load, static) <= bound * (1 + 1e-6)


class TestImpactLoss:
    @pytest.mark.parametrize("restitution", [0.0, 0.4, 1.0])
    def test_is_the_kinetic_energy_that_is_gone(self, restitution: float) -> None:
        inertias, before = np.array([1.3, 4.0]), np.array([9.0, 2.0])
        speeds = np.linalg.solve(
            np.array([inertias, [1.0, -1.0]]), [inertias @ before, -restitution * (before[0] - before[1])]
        )
        lost = float(inertias @ (before**2 - speeds**2) / 2)
        found = backlash.impact_loss(1.3, 4.0, float(before[0] - before[1]), restitution)
        assert found == pytest.approx(lost, rel=1e-12, abs=1e-12)
