"""Special resistances against momentum, quadrature and numbers worked out by hand; CEMA in pounds and feet."""

import math

import numpy as np
import pytest
from scipy import integrate

from ptmcalc.laws import belt_resistance

G = 9.81


class TestLoading:
    def test_material_sliding_until_it_keeps_up(self) -> None:
        """A stream of particles, each pulled by friction: time, way, and the momentum the belt gives per second."""
        rate, v, start, friction = 420.0, 3.5, 0.8, 0.6
        slide = integrate.solve_ivp(
            lambda t, y: [y[1], friction * G], (0, 10), [0.0, start], events=_reaches(v), rtol=1e-11, atol=1e-12
        )
        way, time = slide.y_events[0][0][0], slide.t_events[0][0]
        assert belt_resistance.acceleration_length(v, start, friction, G) == pytest.approx(way, rel=1e-9)
        on_belt = rate * time  # mass that is still sliding
        force = on_belt * friction * G
        assert belt_resistance.loading_resistance(rate, v, start) == pytest.approx(force, rel=1e-9)

    def test_a_faster_feed_needs_no_length_and_pushes(self) -> None:
        assert belt_resistance.acceleration_length(2.0, 3.0, 0.6, G) == 0.0
        assert belt_resistance.loading_resistance(100.0, 2.0, 3.0) == -100.0

    def test_pressure_on_two_plates(self) -> None:
        """Integrated over the height of the material."""
        rate, rho, v, b, length, mu = 500.0, 900.0, 2.5, 0.8, 4.0, 0.6
        height = rate / (rho * v * b)
        side, _ = integrate.quad(lambda z: rho * G * (height - z), 0, height)
        assert belt_resistance.skirt_resistance(rate, rho, v, b, length, mu, G) == pytest.approx(
            2 * mu * side * length, rel=1e-12
        )


def _reaches(speed: float):  # type: ignore[no-untyped-def]
    def event(_t: float, y: np.ndarray) -> float:
        return float(y[1] - speed)

    event.terminal = True  # type: ignore[attr-defined]
    return event


class TestParts:
    def test_by_hand(self) -> None:
        assert belt_resistance.scraper_resistance(0.012, 5e4, 0.6) == pytest.approx(360.0)
        assert belt_resistance.bearing_resistance(80e3, 0.14, 0.8, 0.005) == pytest.approx(70.0)
        tilted = belt_resistance.idler_tilt_resistance(0.4, 0.35, 100.0, 150.0, G, 1.0, math.radians(2))
        assert tilted == pytest.approx(0.4 * 0.35 * 100 * 150 * G * 0.0348994967, rel=1e-9)

    @pytest.mark.parametrize(("carcass", "a", "c"), [("fabric", 9, 140), ("steel_cord", 12, 200)])
    def test_wrap_as_printed(self, carcass: str, a: float, c: float) -> None:
        """a B (c + 0.01 F/B) d/D."""
        width, tension, d, diameter = 1.2, 90e3, 0.018, 0.8
        found = belt_resistance.wrap_resistance(
            width, tension, d, diameter, *belt_resistance.WRAP_COEFFICIENTS[carcass]
        )
        assert found == pytest.approx(a * width * (c + 0.01 * tension / width) * d / diameter, rel=1e-12)

    def test_secondary_share(self) -> None:
        assert belt_resistance.secondary_resistance(4e4, 500.0) == pytest.approx(8e3)
        assert belt_resistance.secondary_resistance(4e4, 3000.0) == pytest.approx(2e3)
        with pytest.raises(ValueError, match="80 m"):
            belt_resistance.secondary_resistance(4e4, 79.0)

    def test_secondary_share_is_what_the_parts_of_a_usual_conveyor_add_up_to(self) -> None:
        """500 m, 1 m wide, 1000 t/h at 2.5 m/s: loading, skirts, four wraps, bearings and a scraper, one by one."""
        rate, v = 1000 / 3.6, 2.5
        main = 0.02 * G * 500 * (2 * 15 + rate / v + 25)
        parts = belt_resistance.loading_resistance(rate, v, 0.0)
        parts += belt_resistance.skirt_resistance(rate, 900.0, v / 2, 0.6, 0.6, 0.6, G)
        parts += belt_resistance.skirt_resistance(rate, 900.0, v, 0.6, 3.0, 0.6, G)
        parts += belt_resistance.scraper_resistance(0.012, 5e4, 0.6)
        parts += 4 * belt_resistance.wrap_resistance(1.0, 3e4, 0.012, 0.63, 1260.0, 0.09)
        parts += 4 * belt_resistance.bearing_resistance(6e4, 0.12, 0.63, 0.005)
        assert float(parts) == pytest.approx(belt_resistance.secondary_resistance(main, 500.0), rel=0.25)


class TestEffectiveTensionAndPower:
    def test_losses_come_from_where_the_power_comes(self) -> None:
        """What goes in is what comes out and what the gear loses, motoring or braking."""
        for force in (4e4, -4e4, 0.0, 1e-3, -1e-3):
            shaft = float(belt_resistance.shaft_power(force, 2.5))
            motor = float(belt_resistance.motor_power(shaft, 0.9))
            put_in, out = (motor, shaft) if force >= 0 else (-shaft, -motor)
            assert out == pytest.approx(0.9 * put_in)

    def test_sum(self) -> None:
        assert belt_resistance.effective_tension(3e4, 1.2, 2e3, -5e4) == pytest.approx(-12e3)

    def test_cycle(self) -> None:
        assert belt_resistance.cycle_time(2030.0, 3.5) == pytest.approx(580.0)


class TestTakeup:
    def test_elongation_span_by_span(self) -> None:
        lengths, tensions = np.array([400.0, 900.0, 700.0]), np.array([30e3, 34e3, 80e3, 150e3])
        stiffness, mounting = 1.2e7, 25e3
        stretch = 0.0
        for run, first, last in zip(lengths, tensions, tensions[1:], strict=False):
            part, _ = integrate.quad(lambda x, a=first, b=last: (a + (b - a) * x - mounting) / stiffness, 0, 1)
            stretch += run * part
        mean = belt_resistance.mean_tension(lengths, tensions)
        travel = belt_resistance.takeup_travel(2000.0, mean, mounting, stiffness, 0.004, 2)
        assert travel == pytest.approx((stretch + 0.004 * 2000) / 2, rel=1e-12)

    def test_weight_holds_its_falls(self) -> None:
        mass = float(belt_resistance.takeup_mass(35e3, 2, G))
        assert mass * G == pytest.approx(2 * 35e3)
        assert belt_resistance.takeup_mass(35e3, 4, G) == pytest.approx(2 * mass)


class TestCema:
    FT, LB = 0.3048, 0.45359237

    def test_in_pounds_and_feet(self) -> None:
        """A conveyor of 2000 ft, 75 ft lift, 36 in wide, written out in the book's own units."""
        wb, wm, length, lift, ky, spacing = 10.0, 88.9, 2000.0, 75.0, 0.0243, 4.0
        kx = 0.00068 * (wb + wm) + 1.5 / spacing
        pounds = length * (kx + ky * wb + 0.015 * wb) + wm * (length * ky + lift) + 700.0
        to_line_mass, newton, g = self.LB / self.FT, belt_resistance.POUND_FORCE, 9.80665
        ours = belt_resistance.cema_idler_resistance(
            wb * to_line_mass,
            wm * to_line_mass,
            g,
            belt_resistance.CEMA_IDLER_DRAG["6in"],
            spacing * self.FT,
        )
        assert ours == pytest.approx(kx * newton / self.FT, rel=1e-12)
        tension = belt_resistance.cema_effective_tension(
            length * self.FT,
            lift * self.FT,
            wb * to_line_mass,
            wm * to_line_mass,
            g,
            1.0,
            ours,
            ky,
            700 * newton,
        )
        assert tension == pytest.approx(pounds * newton, rel=1e-12)

    def test_acceleration_of_the_material_is_the_same_law(self) -> None:
        """T_am = 2.8755e-4 Q (V - V_0), Q in short tons per hour, V in feet per minute, T in lbf."""
        q, v, start = 1600.0, 500.0, 100.0
        ours = belt_resistance.loading_resistance(q * 2000 * self.LB / 3600, v * self.FT / 60, start * self.FT / 60)
        assert ours / belt_resistance.POUND_FORCE == pytest.approx(2.8755e-4 * q * (v - start), rel=1e-3)

    def test_near_the_other_method_on_a_usual_conveyor(self) -> None:
        """1000 m level, f = 0.02: within a quarter."""
        belt, load, idlers = 16.0, 120.0, 25.0
        iso = 1.09 * 0.02 * G * 1000 * (2 * belt + load + idlers)
        kx = belt_resistance.cema_idler_resistance(belt, load, G, belt_resistance.CEMA_IDLER_DRAG["6in"], 1.2)
        cema = belt_resistance.cema_effective_tension(1000.0, 0.0, belt, load, G, 1.0, kx, 0.02, 0.0)
        assert cema == pytest.approx(iso, rel=0.25)
