"""Load sections against quadrature of the outline, transitions against the lengths of fibres."""

import math

import numpy as np
import pytest
from scipy import integrate, optimize

from ptmcalc.laws import belt_section

TROUGHS = [(0.9, 0.38, 35.0, 20.0), (0.9, 0.38, 45.0, 10.0), (0.67, 0.0, 20.0, 15.0), (0.9, 0.0, 0.0, 15.0)]


def outline(b: float, roll: float, trough: float, surcharge: float) -> tuple[float, float]:
    """Areas under and over the line between the edges, by quadrature over the breadth."""
    side = (b - roll) / 2
    half = roll / 2 + side * math.cos(trough)
    depth = side * math.sin(trough)

    def bottom(x: float) -> float:
        return max(abs(x) - roll / 2, 0.0) * math.tan(trough)

    def top(x: float) -> float:
        """Parabola with the slope tan(theta) at the edge."""
        return math.tan(surcharge) / (2 * half) * (half**2 - x**2)

    corners = [-roll / 2, roll / 2]
    under, _ = integrate.quad(lambda x: depth - bottom(x), -half, half, points=corners, epsabs=1e-13)
    over, _ = integrate.quad(top, -half, half)
    return under, over


class TestSection:
    @pytest.mark.parametrize(("b", "roll", "trough", "surcharge"), TROUGHS)
    def test_outline(self, b: float, roll: float, trough: float, surcharge: float) -> None:
        angles = math.radians(trough), math.radians(surcharge)
        under, over = outline(b, roll, *angles)
        assert belt_section.water_section(b, roll, angles[0]) == pytest.approx(under, rel=1e-10, abs=1e-15)
        assert belt_section.surcharge_section(b, roll, *angles) == pytest.approx(over, rel=1e-10)

    def test_printed_section_of_a_common_belt(self) -> None:
        """B = 1200 mm, three rolls of 465 mm, 35 and 20 degrees: handbooks print 0.17 to 0.19 m2."""
        b = float(belt_section.usable_width(1.2))
        whole = belt_section.water_section(b, 0.465, math.radians(35)) + belt_section.surcharge_section(
            b, 0.465, math.radians(35), math.radians(20)
        )
        assert b == pytest.approx(1.03)
        assert 0.16 < float(whole) < 0.19

    def test_a_narrow_load_lies_flat_on_the_middle_roll(self) -> None:
        assert belt_section.water_section(0.3, 0.4, 0.6) == 0.0
        assert belt_section.surcharge_section(0.3, 0.4, 0.6, 0.2) == belt_section.surcharge_section(0.3, 0.4, 0.0, 0.2)

    def test_usable_width(self) -> None:
        widths = np.array([0.02, 0.5, 1.0, 2.0, 2.0 + 1e-12, 2.4])
        assert belt_section.usable_width(widths) == pytest.approx([0.0, 0.4, 0.85, 1.75, 1.75, 2.15])

    def test_material_slides_back_on_a_slope_like_its_own(self) -> None:
        """On a belt that climbs by delta the surface leans across by beta until its steepest line is as steep as the
        material bears; the section shrinks as tan(beta)."""
        theta = math.radians(20)
        for delta in map(math.radians, (0.0, 5.0, 12.0, 18.0)):
            up = np.array([math.sin(delta), 0.0, math.cos(delta)])  # the vertical, seen from the belt

            def too_flat(beta: float, up: np.ndarray = up) -> float:
                return float(up @ [0.0, -math.sin(beta), math.cos(beta)]) - math.cos(theta)

            beta = optimize.brentq(too_flat, 0.0, 0.5, xtol=1e-14)
            left = math.tan(beta) / math.tan(theta)
            assert belt_section.slope_reduction(delta, theta) == pytest.approx(left, rel=1e-9)
            assert belt_section.slope_reduction(-delta, theta) == pytest.approx(left, rel=1e-9)
        assert belt_section.slope_reduction(theta, theta) == 0.0
        assert belt_section.slope_reduction(0.5, theta) == 0.0
        assert belt_section.slope_reduction(0.1, 0.0) == 0.0


class TestEditions:
    @pytest.mark.parametrize(
        ("width", "roll", "trough", "surcharge"), [(1.2, 0.465, 35.0, 20.0), (0.8, 0.0, 20.0, 5.0)]
    )
    def test_outlines_by_quadrature(self, width: float, roll: float, trough: float, surcharge: float) -> None:
        """DIN 22101: straight slopes that meet in the middle. CEMA: a circle that meets the edges under the angle."""
        lam, theta = math.radians(trough), math.radians(surcharge)

        def chord(b: float) -> float:
            return roll + (b - roll) * math.cos(lam)

        def triangle(x: float, w: float) -> float:
            return (w / 2 - abs(x)) * math.tan(theta)

        def arc(x: float, w: float) -> float:
            radius = w / 2 / math.sin(theta)
            return math.sqrt(radius**2 - x**2) - radius * math.cos(theta)

        edges = {"din_22101": 0.9 * width - 0.05, "cema": width - 2 * (0.055 * width + 0.9 * 0.0254)}
        for edition, top in (("din_22101", triangle), ("cema", arc)):
            loaded_width, surcharge_section = belt_section.EDITIONS[edition]
            b = float(loaded_width(width))
            assert b == pytest.approx(edges[edition], rel=1e-12)
            area, _ = integrate.quad(top, -chord(b) / 2, chord(b) / 2, args=(chord(b),), points=[0.0])
            assert surcharge_section(b, roll, lam, theta) == pytest.approx(area, rel=1e-9)

    def test_the_arc_of_a_small_angle(self) -> None:
        """The series below 1e-3 rad continues the closed form, whose rounding is 1e-9 there: theta/6 per chord."""
        for theta in (0.0, 1e-9, 0.999e-3, 1.001e-3):
            area = belt_section.arc_surcharge_section(0.9, 0.9, 0.0, theta)
            assert area == pytest.approx(0.81 * theta / 6 * (1 + 2 * theta**2 / 15), rel=1e-8, abs=1e-300)

    def test_today_s_section_is_that_of_iso_5048(self) -> None:
        assert belt_section.EDITIONS["iso_5048"] == (belt_section.usable_width, belt_section.surcharge_section)


class TestFlow:
    def test_mass_goes_round(self) -> None:
        section, speed, density = 0.17, 3.2, 850.0
        flow = float(belt_section.capacity(section, speed, density))
        assert belt_section.load_line_mass(flow, speed) == pytest.approx(section * density)
        assert belt_section.fill_share(0.8 * flow, flow) == pytest.approx(0.8)
        assert belt_section.fill_share(1.0, 0.0) == math.inf


class TestBelt:
    def test_safety(self) -> None:
        assert belt_section.belt_safety(1.25e6, 1.0, 125e3) == pytest.approx(10.0)
        assert belt_section.belt_safety(1.25e6, 1.0, 0.0) == math.inf

    def test_pulley(self) -> None:
        assert belt_section.minimum_pulley_diameter("polyester", 0.0058) == pytest.approx(0.6264)
        factors = list(belt_section.PULLEY_FACTORS.values())
        assert factors == sorted(factors)  # stiffer fibres need larger pulleys
        with pytest.raises(ValueError, match="polyester"):
            belt_section.minimum_pulley_diameter("rubber", 0.005)

    @pytest.mark.parametrize("lift", [0.0, 0.03, 0.09, 0.2])
    @pytest.mark.parametrize("length", [3.0, 300.0])
    def test_lengths_of_fibres(self, lift: float, length: float) -> None:
        """Each fibre runs straight from the face of the pulley to its place on the rolls; strains are small."""
        c, s, trough = 0.4, 0.38, math.radians(40)

        def strain(y: float) -> float:
            """y over the corner of the trough; the middle is y = 0."""
            start = np.array([0.0, y, lift])
            end = np.array([length, y * math.cos(trough), y * math.sin(trough)])
            return float(np.linalg.norm(end - start)) / length - 1

        sides, _ = integrate.quad(strain, 0, s)
        mean = (c * strain(0.0) + 2 * sides) / (c + 2 * s)
        most, least = belt_section.transition_strains(length, c, s, trough, lift)
        fibres = np.array([strain(float(y)) for y in np.linspace(0, s, 4001)])
        small = np.abs(fibres).max() ** 2 + 4e-16
        assert most == pytest.approx(fibres.max() - mean, rel=0, abs=small)
        assert least == pytest.approx(mean - fibres.min(), rel=0, abs=small)
        assert most > 0
        assert least > 0

    def test_length_gives_the_strain_it_was_asked_for(self) -> None:
        trough = math.radians(35)
        for lift in (0.0, 0.07, 0.3):
            length = belt_section.transition_length(0.002, 0.4, 0.38, trough, lift)
            most, _ = belt_section.transition_strains(length, 0.4, 0.38, trough, lift)
            assert most == pytest.approx(0.002, rel=1e-12)
        assert belt_section.transition_length(0.002, 0.4, 0.38, 0.0, 0.3) == 0.0

    def test_a_lifted_pulley_needs_less(self) -> None:
        """A pulley a third of the trough's depth above the middle roll: the usual saving."""
        trough = math.radians(35)
        low, high = (
            belt_section.transition_length(0.002, 0.4, 0.38, trough, lift)
            for lift in (0.0, 0.38 * math.sin(trough) / 3)
        )
        assert 0.6 < high / low < 0.9
