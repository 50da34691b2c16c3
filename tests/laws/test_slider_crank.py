"""The slider-crank against the positions of its bodies, differentiated numerically, and against the textbook series."""

import math
from collections.abc import Callable

import numpy as np
import pytest

from ptmcalc.laws import slider_crank

SHAPES = [(0.06, 0.42, 0.0), (0.06, 0.42, 0.05), (0.06, 0.42, -0.05), (0.3, 0.31, 0.005), (0.1, 50.0, 1.0)]
ANGLES = np.linspace(-7.0, 7.0, 57)


def pin(angle: float, shape: tuple[float, float, float]) -> complex:
    """The crank pin as a complex number."""
    return shape[0] * complex(math.cos(angle), math.sin(angle))


def slider(angle: float, shape: tuple[float, float, float]) -> complex:
    """The slider on its line, a rod length from the pin, on the far side."""
    at = pin(angle, shape)
    return complex(at.real + math.sqrt(shape[1] ** 2 - (at.imag - shape[2]) ** 2), shape[2])


def slope(function: Callable[[float], complex], angle: float) -> complex:
    """Central difference of fourth order."""
    h = 1e-3
    return (8 * (function(angle + h) - function(angle - h)) - function(angle + 2 * h) + function(angle - 2 * h)) / (
        12 * h
    )


@pytest.mark.parametrize("shape", SHAPES)
class TestKinematics:
    def test_the_rod_keeps_its_length(self, shape: tuple[float, float, float]) -> None:
        x = slider_crank.slider_position(ANGLES, *shape)
        for angle, position in zip(ANGLES, x, strict=True):
            assert abs(complex(position, shape[2]) - pin(angle, shape)) == pytest.approx(shape[1], rel=1e-12)

    def test_the_velocity_is_the_slope_of_the_position(self, shape: tuple[float, float, float]) -> None:
        for angle in ANGLES:
            wanted = slope(lambda phi: slider(phi, shape), angle).real
            assert slider_crank.slider_velocity(angle, *shape) == pytest.approx(wanted, abs=1e-7 * shape[0])

    def test_the_dead_centres_are_where_it_turns(self, shape: tuple[float, float, float]) -> None:
        reach = slider_crank.slider_position(np.linspace(0, 2 * np.pi, 20001), *shape)
        for far, extreme in ((True, reach.max()), (False, reach.min())):
            x, angle = slider_crank.dead_centre(*shape, far)
            assert x == pytest.approx(float(extreme), rel=1e-7)
            assert slider_crank.slider_position(angle, *shape) == pytest.approx(x, rel=1e-12)
            assert abs(float(slider_crank.slider_velocity(angle, *shape))) < 1e-12

    def test_the_angles_of_a_position_are_those_of_both_ways(self, shape: tuple[float, float, float]) -> None:
        far, _ = slider_crank.dead_centre(*shape, True)
        near, _ = slider_crank.dead_centre(*shape, False)
        for share in (0.01, 0.3, 0.5, 0.99):
            x = near + share * (far - near)
            out, back = slider_crank.crank_angles(x, *shape)
            assert out < back
            for angle in (out, back):
                assert slider_crank.slider_position(angle, *shape) == pytest.approx(x, rel=1e-10)
            assert slider_crank.slider_velocity(out, *shape) > 0 > slider_crank.slider_velocity(back, *shape)

    def test_beyond_a_dead_centre_both_angles_are_its_own(self, shape: tuple[float, float, float]) -> None:
        x, angle = slider_crank.dead_centre(*shape, True)
        assert slider_crank.crank_angles(x * 1.1, *shape) == pytest.approx((angle, angle), abs=0.02)


MASSES = (180.0, 35.0, 0.3, 0.6)


@pytest.mark.parametrize("shape", SHAPES)
class TestInertia:
    def test_it_is_twice_the_kinetic_energy_at_unit_speed(self, shape: tuple[float, float, float]) -> None:
        m_slider, m_rod, centre, about = MASSES

        def rod_centre(phi: float) -> complex:
            return pin(phi, shape) + centre * (slider(phi, shape) - pin(phi, shape))

        def lean(phi: float) -> complex:
            rod = slider(phi, shape) - pin(phi, shape)
            return complex(math.atan2(rod.imag, rod.real), 0)

        for angle in ANGLES:
            energy = m_slider * abs(slope(lambda phi: slider(phi, shape), angle)) ** 2
            energy += m_rod * abs(slope(rod_centre, angle)) ** 2 + about * slope(lean, angle).real ** 2
            found = float(slider_crank.reduced_inertia(angle, *shape, *MASSES))
            assert found == pytest.approx(energy, rel=1e-7, abs=1e-9)

    def test_a_rod_that_is_a_point_and_one_that_only_turns(self, shape: tuple[float, float, float]) -> None:
        """Speeds by differences of where the parts are, without a slider that weighs."""

        def point(phi: float) -> complex:
            return pin(phi, shape) + 0.3 * (slider(phi, shape) - pin(phi, shape))

        def rod(phi: float) -> complex:
            across = slider(phi, shape) - pin(phi, shape)
            return complex(math.atan2(across.imag, across.real), 0)

        for angle in ANGLES:
            moved, turned = abs(slope(point, angle)) ** 2, slope(rod, angle).real ** 2
            for mass, about in ((9.0, 0.0), (0.0, 2.0), (9.0, 2.0)):
                found = float(slider_crank.reduced_inertia(angle, *shape, 0.0, mass, 0.3, about))
                assert found == pytest.approx(mass * moved + about * turned, rel=1e-7, abs=1e-9)

    def test_its_slope_is_its_slope(self, shape: tuple[float, float, float]) -> None:
        def value(phi: float) -> complex:
            return complex(float(slider_crank.reduced_inertia(phi, *shape, *MASSES)), 0)

        scale = max(abs(value(phi)) for phi in ANGLES)
        for angle in ANGLES:
            found = float(slider_crank.reduced_inertia_slope(angle, *shape, *MASSES))
            assert found == pytest.approx(slope(value, angle).real, abs=1e-6 * scale)

    @pytest.mark.parametrize("masses", [(180.0, 0.0, 0.3, 0.0), (0.0, 35.0, 0.3, 0.0), (0.0, 0.0, 0.3, 0.6)])
    def test_each_part_has_the_slope_of_its_own_inertia(
        self, shape: tuple[float, float, float], masses: tuple[float, float, float, float]
    ) -> None:
        """By where slider, rod centre and rod are, in 3 + 3 differences."""
        m_slider, m_rod, centre, about = masses

        def place(phi: float) -> complex:
            across = slider(phi, shape) - pin(phi, shape)
            if about:
                return complex(math.atan2(across.imag, across.real), 0)
            return slider(phi, shape) if m_slider else pin(phi, shape) + centre * across

        def inertia(phi: float) -> complex:
            return complex((m_slider + m_rod + about) * abs(slope(place, phi)) ** 2, 0)

        scale = max(abs(inertia(phi)) for phi in ANGLES)
        for angle in ANGLES:
            found = float(slider_crank.reduced_inertia_slope(angle, *shape, *masses))
            assert found == pytest.approx(slope(inertia, angle).real, abs=1e-5 * scale)

    @pytest.mark.parametrize("inclination", [0.0, 0.7, math.pi / 2])
    def test_heights_and_lifts(self, shape: tuple[float, float, float], inclination: float) -> None:
        """The slide points down by the inclination: along it one falls, across it one rises."""
        turned = complex(math.cos(-inclination), math.sin(-inclination))

        def height(phi: float) -> complex:
            at = pin(phi, shape) + 0.3 * (slider(phi, shape) - pin(phi, shape))
            return complex((at * turned).imag, 0)

        for angle in ANGLES:
            found = float(slider_crank.rod_centre_height(angle, *shape, 0.3, inclination))
            assert found == pytest.approx(height(angle).real, abs=1e-9)
            lift = float(slider_crank.rod_centre_lift(angle, *shape, 0.3, inclination))
            assert lift == pytest.approx(slope(height, angle).real, abs=1e-7)


def test_a_long_rod_moves_the_slider_as_a_cosine() -> None:
    """x - l = r cos phi + O(r^2/l)."""
    x = slider_crank.slider_position(ANGLES, 0.1, 1e6, 0.0) - 1e6
    assert x == pytest.approx(0.1 * np.cos(ANGLES), abs=1e-7)


def test_the_inertia_of_a_textbook_press_by_its_series() -> None:
    """m r^2 (sin phi + lambda/2 sin 2 phi)^2 is good to lambda^3 at r/l = 1/8."""
    r, length, mass = 0.06, 0.48, 420.0
    series = mass * r**2 * (np.sin(ANGLES) + r / length / 2 * np.sin(2 * ANGLES)) ** 2
    found = slider_crank.reduced_inertia(ANGLES, r, length, 0.0, mass, 0.0, 0.3, 0.0)
    assert found == pytest.approx(series, abs=mass * r**2 * (r / length) ** 3)
