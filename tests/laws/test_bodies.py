"""Moments of inertia against the integral of r^2 dm, taken numerically over each body's own shape."""

import math
from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import dblquad, quad

from ptmcalc.laws import bodies

TIGHT = 1e-10


def turned(density: float, profile: Callable[[float], float], inner: float, outer: float) -> tuple[float, float]:
    """Mass and moment of inertia of a body of revolution whose width at radius r is profile(r)."""
    mass = quad(lambda r: 2 * math.pi * r * density * profile(r), inner, outer)[0]
    return mass, quad(lambda r: 2 * math.pi * r**3 * density * profile(r), inner, outer)[0]


def rod(mass: float, place: Callable[[float], float]) -> float:
    """Moment of inertia of a line of mass whose point at share s of its length is place(s) from the axis."""
    return quad(lambda s: mass * place(s) ** 2, 0, 1)[0]


class TestCylinders:
    @pytest.mark.parametrize(("outer", "inner"), [(0.5, 0.0), (0.5, 0.3), (2.0, 1.99)])
    def test_full_and_hollow(self, outer: float, inner: float) -> None:
        mass, inertia = turned(7850.0, lambda r: 0.8, inner / 2, outer / 2)
        assert bodies.hollow_cylinder(mass, outer, inner) == pytest.approx(inertia, rel=TIGHT)
        if inner == 0:
            assert bodies.solid_cylinder(mass, outer) == pytest.approx(inertia, rel=TIGHT)

    @pytest.mark.parametrize("wall", [1e-4, 0.01, 0.1])
    def test_a_thin_ring_is_light_by_the_square_of_its_wall_over_its_diameter(self, wall: float) -> None:
        mean = 0.8
        mass, inertia = turned(7850.0, lambda r: 1.0, mean / 2 * (1 - wall), mean / 2 * (1 + wall))
        assert inertia / bodies.thin_ring(mass, mean) == pytest.approx(1 + wall**2, rel=1e-10)


class TestRings:
    def test_of_a_stepped_wheel(self) -> None:
        """Hub, web and rim as one profile of width over radius, integrated with its steps as break points."""
        radii, widths = [0.03, 0.06, 0.21, 0.25], [0.08, 0.012, 0.06]
        parts = [turned(7850.0, lambda r, b=b: b, r, R) for r, R, b in zip(radii, radii[1:], widths, strict=False)]
        found = bodies.rings(7850.0, np.array(radii[1:]), np.array(radii[:-1]), np.array(widths))
        assert found == pytest.approx(tuple(map(sum, zip(*parts, strict=True))), rel=TIGHT)

    def test_cut_finer_stay_the_same(self) -> None:
        edges = np.linspace(0.1, 0.4, 31)
        whole = bodies.rings(7850.0, np.array([0.4]), np.array([0.1]), np.array([0.2]))
        assert bodies.rings(7850.0, edges[1:], edges[:-1], np.full(30, 0.2)) == pytest.approx(whole, rel=1e-13)

    def test_drum_as_one_profile(self) -> None:
        outer, inner, length, disc, shaft = 0.52, 0.48, 1.2, 0.02, 0.1

        def width(r: float) -> float:
            return length if r < shaft / 2 or r > inner / 2 else 2 * disc

        edges = [0.0, shaft / 2, inner / 2, outer / 2]
        parts = [turned(7850.0, width, lower + 1e-15, upper) for lower, upper in pairwise(edges)]
        mass, inertia = (sum(values) for values in zip(*parts, strict=True))
        assert bodies.drum(7850.0, outer, inner, length, disc, shaft) == pytest.approx((mass, inertia), rel=TIGHT)

    @pytest.mark.parametrize(
        ("shape", "body"),
        [
            (bodies.DRUM_SHAPE, lambda: (*bodies.drum(7850.0, 0.52, 0.48, 1.2, 0.02, 0.1), 0.26)),
            (
                bodies.SHEAVE_SHAPE,
                lambda: (
                    *bodies.rings(
                        7850.0,
                        np.array([0.25, 0.21, 0.06]),
                        np.array([0.21, 0.06, 0.03]),
                        np.array([0.06, 0.012, 0.08]),
                    ),
                    0.25,
                ),
            ),
        ],
        ids=["drum", "sheave"],
    )
    def test_a_typical_body_lies_within_the_estimate(
        self, shape: tuple[float, float], body: Callable[[], tuple[float, float, float]]
    ) -> None:
        mass, inertia, radius = body()
        low, high = (bodies.estimated_body(mass, radius, k) for k in shape)
        assert low < inertia < high

    def test_the_ends_of_the_estimate_are_cylinder_and_hoop(self) -> None:
        assert bodies.estimated_body(40.0, 0.3, 0.5) == pytest.approx(
            turned(40 / 0.09, lambda r: 1 / math.pi, 0, 0.3)[1]
        )
        assert bodies.estimated_body(40.0, 0.3, 1.0) == pytest.approx(40 * 0.3**2, rel=1e-15)


class TestRods:
    MASS, LENGTH, AWAY = 60.0, 3.0, 0.5

    def test_across_the_axis(self) -> None:
        assert bodies.rod_about_end(self.MASS, self.LENGTH) == pytest.approx(
            rod(self.MASS, lambda s: s * self.LENGTH), rel=TIGHT
        )
        assert bodies.rod_about_centre(self.MASS, self.LENGTH) == pytest.approx(
            rod(self.MASS, lambda s: (s - 0.5) * self.LENGTH), rel=TIGHT
        )
        assert bodies.rod_radial(self.MASS, self.LENGTH, self.AWAY) == pytest.approx(
            rod(self.MASS, lambda s: self.AWAY + s * self.LENGTH), rel=TIGHT
        )

    @pytest.mark.parametrize("angle", [0.0, 0.3, math.radians(35), math.pi / 2])
    def test_inclined(self, angle: float) -> None:
        point = np.array([math.sin(angle), math.cos(angle)])  # off the axis, along it
        expected = rod(self.MASS, lambda s: float((s * self.LENGTH * point)[0]))
        assert bodies.rod_inclined(self.MASS, self.LENGTH, angle) == pytest.approx(expected, rel=TIGHT, abs=1e-12)

    @pytest.mark.parametrize("radius", [0.0, 0.2])
    def test_parallel(self, radius: float) -> None:
        """The disc of its section, in polar coordinates about its own centre."""
        if radius == 0:
            expected = rod(self.MASS, lambda s: self.AWAY)
        else:
            density = self.MASS / (math.pi * radius**2)
            expected = dblquad(
                lambda r, p: density * r * ((self.AWAY + r * math.cos(p)) ** 2 + (r * math.sin(p)) ** 2),
                0, 2 * math.pi, 0, radius,
            )[0]  # fmt: skip
        assert bodies.rod_parallel(self.MASS, self.AWAY, radius) == pytest.approx(expected, rel=TIGHT)


class TestPoints:
    def test_a_cloud_of_points_about_another_axis(self) -> None:
        rng = np.random.default_rng(4)
        masses, places = rng.uniform(1, 5, 40), rng.normal(size=(40, 2))
        places -= masses @ places / masses.sum()
        central = float(masses @ (places**2).sum(axis=1))
        away = np.array([0.7, -1.1])
        moved = float(masses @ ((places + away) ** 2).sum(axis=1))
        assert bodies.parallel_axis(central, float(masses.sum()), float(np.hypot(*away))) == pytest.approx(
            moved, rel=1e-12
        )

    def test_a_far_body_is_nearly_a_point(self) -> None:
        mass, inertia = turned(7850.0, lambda r: 0.1, 0, 0.05)
        far = bodies.parallel_axis(inertia, mass, 50.0)
        assert bodies.point_mass(mass, 50.0) == pytest.approx(far, rel=1e-6)
        assert bodies.point_mass(mass, 50.0) < far


class TestGD2:
    def test_of_a_rotor_by_its_radius_of_gyration(self) -> None:
        """A catalogue's D is twice the radius at which all the mass would have the same inertia."""
        mass, inertia = turned(7850.0, lambda r: 0.3 - r, 0.02, 0.15)
        diameter = 2 * math.sqrt(inertia / mass)
        assert bodies.inertia_of_gd2(mass * diameter**2, bodies.GYRATION) == pytest.approx(inertia, rel=TIGHT)

    def test_of_a_cylinder_by_its_outer_diameter(self) -> None:
        mass, inertia = turned(7850.0, lambda r: 0.3, 0.0, 0.15)
        assert bodies.inertia_of_gd2(mass * 0.3**2, bodies.OUTER_DIAMETER) == pytest.approx(inertia, rel=TIGHT)
        kilogram_force, g = mass, 9.81  # the technical system of old tables: J in kgf m s^2
        assert bodies.inertia_of_gd2(mass * 0.3**2, bodies.OUTER_DIAMETER) == pytest.approx(
            g * (kilogram_force * 0.3**2 / (8 * g)), rel=1e-14
        )
