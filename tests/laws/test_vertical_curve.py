"""Vertical curves against a polygon of masses, and strains across the belt against the lengths of fibres on arcs."""

import math

import numpy as np
import pytest
from scipy import integrate

from ptmcalc.laws import vertical_curve

G = 9.81


def polygon_reaction(tension: float, radius: float, mass: float, speed: float, slope: float, convex: bool) -> float:
    """Force of one of many idlers on a belt of short straight spans, per length: the force that is missing when the
    momentum of the belt turns from one span to the next."""
    turn = 1e-4
    pitch = 2 * radius * math.sin(turn / 2)
    sign = -1.0 if convex else 1.0
    before = np.array([math.cos(slope - sign * turn / 2), math.sin(slope - sign * turn / 2)])
    after = np.array([math.cos(slope + sign * turn / 2), math.sin(slope + sign * turn / 2)])
    pulled = tension * (after - before)
    weight = np.array([0.0, -mass * pitch * G])
    momentum = mass * speed**2 * (after - before)  # mass flow times change of velocity
    idler = momentum - pulled - weight
    return float(idler @ [-math.sin(slope), math.cos(slope)]) / pitch


class TestLiftOff:
    @pytest.mark.parametrize("convex", [False, True])
    @pytest.mark.parametrize("speed", [0.0, 6.0])
    def test_polygon(self, convex: bool, speed: float) -> None:
        slope = math.radians(9)
        load = vertical_curve.idler_line_load(60e3, 250.0, 22.0, speed, G, math.cos(slope), convex)
        assert load == pytest.approx(polygon_reaction(60e3, 250.0, 22.0, speed, slope, convex), rel=1e-6)

    @pytest.mark.parametrize("speed", [0.0, 6.0])
    def test_nothing_is_left_on_the_idlers(self, speed: float) -> None:
        cosine = math.cos(math.radians(9))
        radius = float(vertical_curve.lift_off_radius(60e3, 22.0, speed, G, cosine))
        assert vertical_curve.idler_line_load(60e3, radius, 22.0, speed, G, cosine, False) == pytest.approx(
            0.0, abs=1e-9
        )
        assert vertical_curve.lift_off_tension(radius, 22.0, speed, G, cosine) == pytest.approx(60e3)

    def test_speed_presses_the_belt_down(self) -> None:
        still, fast = (float(vertical_curve.lift_off_radius(60e3, 22.0, v, G, 1.0)) for v in (0.0, 6.0))
        assert still - fast == pytest.approx(36.0 / G)
        assert vertical_curve.lift_off_radius(100.0, 22.0, 6.0, G, 1.0) == 0.0

    def test_a_free_belt_is_a_catenary(self) -> None:
        """A hanging belt has just this radius at its lowest point: H/(rho g)."""
        a = 120.0  # y = a cosh(x/a)
        tension = 22.0 * G * a
        curvature = float(np.gradient(np.gradient(a * np.cosh(np.linspace(-1, 1, 2001) / a), 1e-3), 1e-3)[1000])
        assert vertical_curve.lift_off_radius(tension, 22.0, 0.0, G, 1.0) == pytest.approx(1 / curvature, rel=1e-4)


class TestIdlers:
    def test_bears_what_it_may(self) -> None:
        radius = float(vertical_curve.idler_radius(90e3, 180.0, G, 0.98, 0.8, 3000.0))
        load = float(vertical_curve.idler_line_load(90e3, radius, 180.0, 0.0, G, 0.98, True))
        assert 0.8 * load == pytest.approx(3000.0)

    def test_overloaded_on_a_straight(self) -> None:
        assert vertical_curve.idler_radius(90e3, 180.0, G, 1.0, 2.0, 3000.0) == math.inf


class TestAcross:
    C, S, TROUGH, EA = 0.4, 0.38, math.radians(40), 2.4e7

    def fibre_heights(self) -> np.ndarray:
        y = (np.arange(20000) + 0.5) / 20000 * (self.C + 2 * self.S) - (self.C / 2 + self.S)
        return np.maximum(np.abs(y) - self.C / 2, 0.0) * math.sin(self.TROUGH)

    def test_neutral_line(self) -> None:
        heights = self.fibre_heights()
        edge, middle = vertical_curve.trough_heights(self.C, self.S, self.TROUGH)
        assert middle == pytest.approx(heights.mean(), rel=1e-6)
        assert edge + middle == pytest.approx(self.S * math.sin(self.TROUGH), rel=1e-14)

    @pytest.mark.parametrize("convex", [True, False])
    def test_tensions_of_fibres_on_arcs(self, convex: bool) -> None:
        """Every fibre on its own arc; the mean tension shifts the zero. At the radius asked for, the worst fibre has
        the allowed tension and the sum over all is T."""
        width, tension = self.C + 2 * self.S, 90e3
        edge, middle = vertical_curve.trough_heights(self.C, self.S, self.TROUGH)
        up, down = (edge, middle) if convex else (middle, edge)
        for wanted in ("largest", "least"):
            limit = 110e3 if wanted == "largest" else 40e3
            law = vertical_curve.radius_for_largest if wanted == "largest" else vertical_curve.radius_for_least
            radius = float(law(tension, width, self.EA, up if wanted == "largest" else down, limit))
            arcs = radius + (1 if convex else -1) * self.fibre_heights()
            stretched = self.EA / width * (arcs / arcs.mean() - 1)
            line = tension / width + stretched
            assert line.mean() * width == pytest.approx(tension)
            worst = line.max() if wanted == "largest" else line.min()
            assert worst - tension / width == pytest.approx(limit - tension / width, rel=0.3 / radius + 2e-4)

    def test_no_radius_helps(self) -> None:
        assert vertical_curve.radius_for_largest(9e4, 1.0, 2e7, 0.1, 8e4) == math.inf
        assert vertical_curve.radius_for_least(9e4, 1.0, 2e7, 0.1, 1e5) == math.inf

    def test_mean_height_by_quadrature(self) -> None:
        area, _ = integrate.quad(lambda y: y * math.sin(self.TROUGH), 0, self.S)
        _, middle = vertical_curve.trough_heights(self.C, self.S, self.TROUGH)
        assert middle == pytest.approx(2 * area / (self.C + 2 * self.S), rel=1e-13)
