"""Stops against integration of the motion and against the worked cases ST-01, ST-02."""

import math

import numpy as np
import pytest
from scipy import integrate

from ptmcalc.laws import stopping

G = 9.81
ROUTE = {"length": 60.0, "load_line_mass": 1500 / G, "strand_line_mass": 800 / G, "gravity": G}
GEAR = {"drum_diameter": 0.65, "ratio": 40.0, "efficiency": 0.9}
MASS = (1500 + 2 * 800) / G * 60


def resistance(slope_degrees: float, coefficient: float) -> float:
    return float(stopping.moving_resistance(slope=math.radians(slope_degrees), coefficient=coefficient, **ROUTE))


class TestHolding:
    """ST-01."""

    def test_worked_case(self) -> None:
        slope = math.radians(20)
        force = stopping.rollback_force(slope=slope, coefficient=0.08, **ROUTE)
        torque = stopping.backstop_torque(force, 0.65, 1.0)
        assert torque == pytest.approx(5459.74, rel=1e-6)
        assert stopping.torque_on_motor_shaft(torque, 40.0, 0.9) == pytest.approx(122.844, rel=1e-5)
        assert stopping.critical_coefficient(slope, 1500 / G, 800 / G) == pytest.approx(0.176115, rel=1e-5)
        assert resistance(20, 0.08) == pytest.approx(44764.4, rel=1e-6)
        assert stopping.critical_coefficient(math.radians(9.38798), 1500, 800) == pytest.approx(0.08, rel=1e-5)

    def test_strand_by_strand(self) -> None:
        """Both strands hang on the drum; each is held up by its own friction."""
        slope, f, run = math.radians(14), 0.03, 60.0
        carry = (2300 * math.sin(slope) - f * 2300 * math.cos(slope)) * run
        back = (800 * math.sin(slope) + f * 800 * math.cos(slope)) * run
        assert stopping.rollback_force(slope=slope, coefficient=f, **ROUTE) == pytest.approx(carry - back, rel=1e-12)

    def test_friction_holds_it(self) -> None:
        force = stopping.rollback_force(slope=math.radians(3), coefficient=0.08, **ROUTE)
        assert force < 0
        assert stopping.backstop_torque(force, 0.65, 1.5) == 0.0
        assert stopping.backstop_torque(100.0, 0.65, 1.5) == pytest.approx(1.5 * 32.5)


def stop(mass: float, w: float, v: float, torque: float, rotor: float) -> float:
    """Way to rest, the gear's loss put on the side of the mesh that gives."""
    radius, i, eta = 0.325, 40.0, 0.9

    def acceleration(_t: float, y: np.ndarray) -> list[float]:
        """Force f of the drive on the rim, against the motion: rotor and belt share one acceleration."""
        for gear in (eta, 1 / eta):
            a = -(w + torque * i / (radius * gear)) / (mass + rotor * i**2 / (radius**2 * gear))
            f = -mass * a - w
            if (f >= 0) == (gear == eta):
                break
        return [y[1], a]

    def at_rest(_t: float, y: np.ndarray) -> float:
        return float(y[1])

    at_rest.terminal = True  # type: ignore[attr-defined]
    run = integrate.solve_ivp(acceleration, (0, 100), [0.0, v], events=at_rest, rtol=1e-10, atol=1e-12)
    return float(run.y_events[0][0][0])


class TestBraking:
    """ST-02."""

    def torque(self, slope: float, form: str = "signed", distance: float = 0.1) -> float:
        return stopping.brake_torque_for_distance(
            MASS, resistance(slope, 0.05), 0.5, distance, **GEAR, rotor_inertia=0.35, form=form
        )

    def test_worked_case(self) -> None:
        assert pytest.approx(18960.2, rel=1e-5) == MASS
        assert resistance(-12, 0.05) == pytest.approx(-9615.28, rel=1e-6)
        assert resistance(12, 0.05) == pytest.approx(27808.8, rel=1e-5)
        assert self.torque(-12) == pytest.approx(297.466, rel=1e-5)
        assert self.torque(12) == pytest.approx(16.7554, rel=1e-4)
        assert self.torque(-12, "notes") == pytest.approx(243.62 + 53.8462, rel=1e-5)

    def test_form_of_the_notes(self) -> None:
        assert self.torque(-12, "notes") == pytest.approx(self.torque(-12), rel=1e-13)
        assert self.torque(12, "notes") > self.torque(12)
        strong = self.torque(4, distance=0.03)
        more = 2 * resistance(4, 0.05) * 0.325 * 0.9 / 40
        assert self.torque(4, "notes", 0.03) == pytest.approx(strong + more, rel=1e-12)
        with pytest.raises(ValueError, match="signed or notes"):
            self.torque(4, "seed")

    @pytest.mark.parametrize("slope", [-12.0, 0.0, 12.0])
    @pytest.mark.parametrize("distance", [0.03, 0.08, 0.1])
    def test_stops_where_it_should(self, slope: float, distance: float) -> None:
        torque, w = self.torque(slope, distance=distance), resistance(slope, 0.05)
        assert torque > 0
        assert stop(MASS, w, 0.5, torque, 0.35) == pytest.approx(distance, rel=1e-8)
        assert stopping.stopping_distance(MASS, w, 0.5, torque, **GEAR, rotor_inertia=0.35) == pytest.approx(
            distance, rel=1e-12
        )

    def test_stops_shorter_by_itself(self) -> None:
        assert self.torque(12, distance=0.2) == 0.0
        alone = stopping.stopping_distance(MASS, resistance(12, 0.05), 0.5, 0.0, **GEAR, rotor_inertia=0.35)
        assert alone < 0.2
        assert alone == pytest.approx(stop(MASS, resistance(12, 0.05), 0.5, 0.0, 0.35), rel=1e-8)

    def test_a_brake_that_does_not_hold(self) -> None:
        just = 9615.28 * 0.325 * 0.9 / 40
        for torque, holds in ((0.99 * just, False), (1.01 * just, True)):
            way = stopping.stopping_distance(MASS, resistance(-12, 0.05), 0.5, torque, **GEAR, rotor_inertia=0.35)
            assert math.isfinite(way) == holds

    def test_overload(self) -> None:
        """2 (M_T i/eta - M)/D, the torque of the rotor left out, is m v^2/(2 s)."""
        force = float(stopping.braking_force(MASS, 0.5, 0.1))
        assert force == pytest.approx(23700.3, rel=1e-5)
        without_rotor = self.torque(-12) - 0.35 * 1.25 * 40 / 0.325
        torque = without_rotor * 40 / 0.9 - 9615.28 * 0.325
        assert 2 * torque / 0.65 == pytest.approx(force, rel=1e-6)

    def test_fixed_loop(self) -> None:
        m1, m2, a = 2300 / G * 60, 800 / G * 60, 1.25
        rise, drop = stopping.fixed_loop_braking(m1, m2, a)
        assert (rise, drop) == pytest.approx((8983.18, 14717.1), rel=1e-5)
        pieces = 20000
        mass = np.concatenate((np.full(pieces, m2 / pieces), np.full(pieces, m1 / pieces)))
        change = -a * (np.cumsum(mass) - mass / 2)  # along the belt from run-off to run-on
        change -= change.mean()  # no total elongation
        assert (change[0], -change[-1]) == pytest.approx((rise, drop), rel=1e-3)
        assert rise + drop == pytest.approx(a * (m1 + m2))


class TestCoasting:
    @pytest.mark.parametrize("rate", [0.0, 1e-6, 3.0, 900.0, 5e4])
    def test_integrated(self, rate: float) -> None:
        mass, w, v = 18e3, 2e3, 2.5

        def motion(_t: float, y: np.ndarray) -> list[float]:
            return [y[1], -(w + rate * y[1]) / mass]

        def at_rest(_t: float, y: np.ndarray) -> float:
            return float(y[1])

        at_rest.terminal = True  # type: ignore[attr-defined]
        run = integrate.solve_ivp(motion, (0, 100), [0.0, v], events=at_rest, rtol=1e-11, atol=1e-12, method="DOP853")
        way, time = stopping.coasting(mass, w, rate, v)
        assert way == pytest.approx(run.y_events[0][0][0], rel=1e-8)
        assert time == pytest.approx(run.t_events[0][0], rel=1e-8)

    def test_continuous_where_the_series_ends(self) -> None:
        below, above = (stopping.coasting(1.0, 1.0, b, 1.0)[0] for b in (0.1 * (1 - 1e-13), 0.1))
        assert below == pytest.approx(above, rel=1e-12)

    def test_textbook_form(self) -> None:
        """s = v^2/(2 g k f) and t = 2 s/v on the level; k only on friction."""
        v, k, f = 1.6, 1.2, 0.03
        way, time = stopping.coasting(MASS, resistance(0, k * f), 0.0, v)
        assert way == pytest.approx(v**2 / (2 * G * k * f), rel=1e-12)
        assert time == pytest.approx(2 * way / v, rel=1e-14)
        slope, q_load, q_both = math.radians(4), 1500.0, 3100.0
        up = v**2 * q_both / (2 * G * (k * q_both * f * math.cos(slope) + q_load * math.sin(slope)))
        assert stopping.coasting(MASS, resistance(4, k * f), 0.0, v)[0] == pytest.approx(up, rel=1e-12)

    def test_the_rotor_carries_it_further(self) -> None:
        """J i^2 eta/R^2 more mass on the same resistance: 25 % in the worked conveyor."""
        w = resistance(0, 0.05)
        alone, geared = (stopping.coasting(m, w, 0.0, 0.5)[0] for m in (MASS, MASS + 0.35 * 40**2 * 0.9 / 0.325**2))
        assert geared / alone == pytest.approx(0.567 / 0.453, rel=2e-3)
        assert geared == pytest.approx(
            stopping.stopping_distance(MASS, w, 0.5, 0.0, 0.65, 40.0, 1.0, 0.35 * 0.9), rel=1e-12
        )

    def test_does_not_stop_downhill(self) -> None:
        assert stopping.coasting(1e3, -5.0, 0.0, 1.0) == (math.inf, math.inf)
        assert stopping.coasting(1e3, -5.0, 10.0, 1.0) == (math.inf, math.inf)
        assert stopping.coasting(1e3, 0.0, 0.0, 1.0) == (math.inf, math.inf)
        assert stopping.coasting(1e3, 0.0, 10.0, 1.0) == (100.0, math.inf)
        assert stopping.coasting(1e3, -5.0, 10.0, 0.0) == (0.0, 0.0)


class TestCoastDown:
    @pytest.mark.parametrize("slope", [-1.0, 0.0, 5.0])
    def test_finds_what_it_coasted_with(self, slope: float) -> None:
        beta, turn, f = math.radians(slope), 1.15, 0.035
        way, _ = stopping.coasting(MASS, resistance(slope, turn * f), 0.0, 1.8)
        lift, normal = 1500 * 60 * math.sin(beta), 3100 * 60 * math.cos(beta)
        found, _ = stopping.coast_down_coefficient(MASS, lift, normal, turn, 1.8, way, 0.0, 0.0)
        assert found == pytest.approx(f, rel=1e-12)

    def test_deviation_of_many_measurements(self) -> None:
        rng = np.random.default_rng(6)
        v, s = 1.8 + 0.02 * rng.normal(size=200000), 4.0 + 0.05 * rng.normal(size=200000)
        found = (MASS * v**2 / (2 * s) - 3e3) / (1.1 * 1.8e5)
        value, deviation = stopping.coast_down_coefficient(MASS, 3e3, 1.8e5, 1.1, 1.8, 4.0, 0.02, 0.05)
        assert value == pytest.approx(found.mean(), rel=1e-3)
        assert deviation == pytest.approx(found.std(), rel=1e-2)
