"""Selection, wear and fatigue of chains against geometry, sums of vectors and counting."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ptmcalc.laws import chain_fatigue, chain_selection, chain_wear

steady = settings(derandomize=True, database=None, deadline=None, max_examples=100)
PITCH = 0.01905


def tangent_length(distance: float, one: int, two: int) -> float:
    """In pitches, round the pitch circles taken as circles of one pitch of arc per tooth."""
    radii = [z * PITCH / (2 * math.pi) for z in (one, two)]
    lean = math.asin((radii[1] - radii[0]) / distance)
    arcs = radii[0] * (math.pi - 2 * lean) + radii[1] * (math.pi + 2 * lean)
    return (2 * distance * math.cos(lean) + arcs) / PITCH


class TestLength:
    @given(st.integers(11, 60), st.integers(0, 90), st.floats(30.0, 80.0))
    @steady
    def test_is_that_of_the_tangents_but_for_its_error(self, one: int, more: int, distance: float) -> None:
        two = one + more
        c = distance * PITCH
        lean = math.asin(more / (2 * math.pi * distance))
        missing = tangent_length(c, one, two) - chain_selection.chain_pitches(c, PITCH, one, two)
        assert missing == pytest.approx(distance * lean**4 / 12, rel=0.2, abs=1e-10)

    @given(st.integers(3, 200), st.integers(3, 200), st.floats(1.0, 80.0))
    @steady
    def test_the_distance_is_the_inverse(self, one: int, two: int, factor: float) -> None:
        least = math.sqrt(2) * abs(two - one) / (2 * math.pi)  # where the length is smallest
        c = (least + factor) * PITCH
        pitches = chain_selection.chain_pitches(c, PITCH, one, two)
        assert chain_selection.centre_distance(pitches, PITCH, one, two) == pytest.approx(c, rel=1e-7)

    @pytest.mark.parametrize(("pitches", "even"), [(113.2, 114), (114.0, 114), (114.00000001, 114), (114.000001, 116)])
    def test_even(self, pitches: float, even: int) -> None:
        assert chain_selection.even_pitches(pitches) == even

    def test_length_of_a_chain_is_even_and_not_short(self) -> None:
        for pitches in np.linspace(60.0, 64.0, 41):
            found = chain_selection.even_pitches(float(pitches))
            assert found % 2 == 0
            assert pitches - 1e-6 <= found < pitches + 2

    def test_wrap_of_the_tangents(self) -> None:
        """The angle between the normals to both tangents, from coordinates of the points they touch."""
        c, one, two = 0.7, 0.06, 0.17
        lean = math.asin((two - one) / c)
        touching = [np.array([-math.sin(lean), side * math.cos(lean)]) for side in (1, -1)]
        assert chain_selection.wrap_angle(c, one, two) == pytest.approx(math.acos(float(touching[0] @ touching[1])))
        assert chain_selection.wrap_angle(c, one, one) == pytest.approx(math.pi)


class TestForces:
    def test_shaft_load_is_a_sum_of_vectors(self) -> None:
        for wrap in (0.0, 1.0, 2.4, math.pi):
            half = (math.pi - wrap) / 2
            pull = 4e3 * np.array([math.cos(half), math.sin(half)]) + 300 * np.array([math.cos(half), -math.sin(half)])
            assert float(chain_selection.shaft_load(4e3, 300.0, wrap)) == pytest.approx(np.linalg.norm(pull), rel=1e-12)

    def test_centrifugal_force_holds_a_ring_together(self) -> None:
        """Half a ring: m V^2/R on every piece of it, carried by two cuts."""
        angle = np.linspace(0, math.pi, 20001)
        radius, m, v = 0.7, 3.8, 6.0
        outward = np.trapezoid(m * v**2 / radius * np.sin(angle) * radius, angle)
        assert float(chain_selection.centrifugal_force(m, v)) == pytest.approx(outward / 2, rel=1e-8)

    def test_safety_and_pressure(self) -> None:
        assert chain_selection.chain_safety(5e5, [4e4, 0.0], 1.25) == pytest.approx([10.0, math.inf])
        assert float(chain_selection.articulation_pressure(4e3, 8e-3, 20e-3)) == pytest.approx(25e6)

    def test_power(self) -> None:
        assert chain_selection.tooth_factor(19, 1.08) == 1.0
        assert chain_selection.tooth_factor(17, 1.08) == pytest.approx(math.exp(1.08 * math.log(19 / 17)))
        assert chain_selection.tooth_factor(17, 1.08, 17) == 1.0
        assert chain_selection.tooth_factor(19, 1.08, 17) == pytest.approx(1 / chain_selection.tooth_factor(17, 1.08))
        assert chain_selection.design_power(9e3, 1.4, 1.1, 1.7) == pytest.approx(9e3 * 1.54 / 1.7)

    def test_application_factors_rise_with_the_shocks(self) -> None:
        """From 1 to 2.1 by equal steps of 0.4 for the machine, by 0.1 and 0.2 for the driver (ISO 10823:2004)."""
        for driver, more in (("smooth", 0.0), ("slight", 0.1), ("moderate", 0.3)):
            for machine, base in (("smooth", 1.0), ("moderate", 1.4), ("heavy", 1.8)):
                assert chain_selection.application_factor(driver, machine) == pytest.approx(base + more)

    @pytest.mark.parametrize(
        ("pitch", "feet_per_minute", "kind"),
        [(12.7, 299, "A"), (12.7, 301, "B"), (25.4, 1499, "B"), (25.4, 1501, "C"), (50.8, 101, "B"), (9.525, 301, "B"),
         (28.575, 159, "A"), (28.575, 161, "B"), (101.6, 99, "A"), (101.6, 1001, "C")],
    )  # fmt: skip
    def test_lubrication(self, pitch: float, feet_per_minute: float, kind: str) -> None:
        speed = feet_per_minute * 0.3048 / 60
        assert chain_selection.lubrication(pitch / 1e3, speed).startswith(f"type {kind}:")


class TestWear:
    IN, OUT = np.array([60e3, 14e3]), np.array([8e3, 15e3])
    PATH = np.full(2, chain_wear.sprocket_path(0.03, 8))

    def test_paths(self) -> None:
        """Pin radius times the angle between two links, on 8 teeth and on a circle through the pins."""
        links = [np.array([math.cos(a), math.sin(a)]) for a in (0.0, math.pi / 4)]
        assert self.PATH[0] == pytest.approx(0.015 * math.acos(float(links[0] @ links[1])), rel=1e-12)
        bend = 2 * math.asin(0.32 / (2 * 5.0))
        assert chain_wear.guide_path(0.03, 0.32, 5.0) == pytest.approx(0.015 * bend, rel=2e-4)

    def test_mean_is_half_of_the_sum(self) -> None:
        given = (self.IN, self.OUT, self.PATH, np.full(2, 0.64), np.full(2, 2.5e-12))
        whole = sum((a + b) * self.PATH[0] * 2.5e-12 * 0.64 for a, b in zip(self.IN, self.OUT, strict=True))
        assert chain_wear.wear_per_revolution(*given, "sum") == pytest.approx(whole, rel=1e-14)
        assert chain_wear.wear_per_revolution(*given, "mean") == pytest.approx(whole / 2, rel=1e-14)

    def test_textbook_and_archard_part_with_speed(self) -> None:
        """The same path at half the speed: twice the wear by the one, the same by the other."""
        area, k = 6e-4, 1e-15
        times = [chain_wear.contact_time(0.32, v) for v in (0.5, 0.25)]
        slow, fast = (
            chain_wear.wear_per_revolution(self.IN, self.OUT, self.PATH, np.full(2, t), np.full(2, 2e-12), "sum")
            for t in (times[1], times[0])
        )
        assert slow == pytest.approx(2 * fast)
        found = chain_wear.archard_wear(self.IN, self.OUT, self.PATH, area, k, 1e7, 1.0)
        assert found == pytest.approx(k * self.PATH[0] * (self.IN + self.OUT).sum() / area, rel=1e-14)

    @pytest.mark.parametrize("exponent", [1.0, 1.5, 3.0])
    def test_pressure_exponent(self, exponent: float) -> None:
        one = chain_wear.archard_wear(self.IN, self.OUT, self.PATH, 6e-4, 1e-15, 1e7, exponent)
        two = chain_wear.archard_wear(2 * self.IN, 2 * self.OUT, self.PATH, 6e-4, 1e-15, 1e7, exponent)
        assert two / one == pytest.approx(2**exponent, rel=1e-13)
        at_test = chain_wear.archard_wear([6e3], [6e3], [1.0], 6e-4, 1e-15, 1e7, exponent)
        assert at_test == pytest.approx(2e-8, rel=1e-13)

    def test_life(self) -> None:
        assert chain_wear.allowed_growth(0.32, 0.04) == pytest.approx(0.0128)
        life = chain_wear.chain_life(0.0128, [2e-9, 0.0], 82.0, 0.5)
        assert life == pytest.approx([0.0128 / 2e-9 * 164.0, math.inf])


class TestFatigue:
    def test_counts(self) -> None:
        """A chain of 100 pitches passes as many teeth per revolution."""
        life = 1e7
        turns, teeth = chain_fatigue.revolutions(life, 32.0, 0.5), chain_fatigue.tooth_passes(life, 0.32, 0.5)
        assert float(teeth) == pytest.approx(100 * float(turns))
        assert float(turns) * 64.0 == pytest.approx(life)

    def test_goodman(self) -> None:
        amplitude = chain_fatigue.stress_amplitude(7e4, 8e3, 16e-4)
        assert float(amplitude) == pytest.approx(31e3 / 16e-4)
        assert float(chain_fatigue.fatigue_utilisation(90e6, 0.0, 90e6, 6e8)) == 1.0
        assert float(chain_fatigue.fatigue_utilisation(0.0, 6e8, 90e6, 6e8)) == 1.0
        assert float(chain_fatigue.fatigue_utilisation(45e6, 3e8, 90e6, math.inf)) == 0.5
