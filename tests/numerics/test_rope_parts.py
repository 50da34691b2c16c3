"""Panels, courses and laws of a hauled load: each against its formula, on both sides of every corner."""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.polynomial import Chebyshev
from scipy.optimize import brentq

from ptmcalc.numerics.rope import rule
from ptmcalc.numerics.rope.parts import (
    NONE,
    Course,
    Governed,
    Haul,
    Lines,
    Smooth,
    Stage,
    Tripped,
)

DENSE = np.linspace(0, 1, 20_001)


def drawn(seed: int, degree: int = 13) -> Chebyshev:
    rng = np.random.default_rng(seed)
    return Chebyshev(rng.normal(size=degree + 1) / (1 + np.arange(degree + 1)), domain=[0, 1])


@pytest.mark.parametrize("seed", range(8))
class TestPanel:
    def test_is_the_polynomial_through_its_nodes(self, seed: int) -> None:
        p = drawn(seed)
        values = p(rule.NODES)
        assert rule.COUNT == 14 == len(rule.NODES)
        assert (rule.NODES[0], rule.NODES[-1]) == (0.0, 1.0)
        assert rule.TO_SERIES @ values == pytest.approx(p.coef, abs=1e-13)
        assert rule.INTEGRAL @ values == pytest.approx(p.integ(lbnd=0)(rule.NODES), abs=1e-14)
        assert rule.DENSE @ values == pytest.approx(p(np.arange(57) / 56), abs=1e-13)
        places = np.array([0.0, 0.123, rule.NODES[4], 0.77, 1.0])
        assert rule.to(places) @ values == pytest.approx(p(places), abs=1e-13)
        assert rule.to(rule.NODES) == pytest.approx(np.eye(14), abs=1e-14)
        both = np.stack([values, 3 * values], axis=1)
        assert rule.tail(both) == pytest.approx(np.abs(p.coef[-2:]).max() * np.array([1, 3]), rel=1e-10)

    def test_largest_of_several(self, seed: int) -> None:
        panels = [drawn(10 * seed + k) for k in range(4)]
        dense = np.array([p(DENSE) for p in panels])
        value, panel, place = rule.largest(np.array([p(rule.NODES) for p in panels]))
        assert panel == int(dense.max(axis=1).argmax())
        assert value == pytest.approx(dense.max(), abs=1e-5)
        assert value == pytest.approx(float(panels[panel](place)), abs=1e-13)
        slope = panels[panel].deriv()
        turns = [x.real for x in slope.roots() if abs(x.imag) < 1e-12 and 0 < x.real < 1]
        assert value == pytest.approx(max(panels[panel](np.array([0.0, 1.0, *turns]))), abs=1e-11)

    def test_roots_to_their_last_digits(self, seed: int) -> None:
        p = drawn(seed, 5)
        p = p - float(p(0.4 + 0.05 * seed))
        places = np.linspace(0, 1, 41)
        falls = np.flatnonzero((p(places[:-1]) > 1e-6) & (p(places[1:]) < -1e-6))
        for low, high in zip(places[falls], places[falls + 1], strict=True):
            exact = brentq(p, low, high, xtol=1e-16)
            assert rule.root(p(rule.NODES), low, high) == pytest.approx(exact, abs=1e-13 / abs(p.deriv()(exact)))
        line = 0.3 + 1e-4 * seed - rule.NODES
        assert rule.root(line, 0.1, 1.0) == pytest.approx(0.3 + 1e-4 * seed, abs=2e-15)
        assert rule.root(line, 0.6, 1.0) == 0.6, "below 0 already"
        for exact in (1e-3, 3e-3, 0.02):  # digits of the place itself, not of the panel
            bent = (exact - rule.NODES) * (1 + (3 + seed) * rule.NODES) * np.exp(rule.NODES)
            assert rule.root(bent, 0.0, 1 / 56) == pytest.approx(min(exact, 1 / 56), rel=1e-12, abs=3e-16)
        steep = 1e9 * (0.7 - rule.NODES)
        assert rule.root(steep, 0.0, 1.0) == pytest.approx(0.7, abs=1e-15)


class TestCourse:
    COURSE = Course((0.0, 0.5, 2.0), (1.0, -3.0, 4.0), (2.0, 0.7, -1.0), decay=5.0, constant=0.3, since=0.5)

    @staticmethod
    def by_hand(t: float, piece: int, decays: bool) -> float:
        start, value, slope = ((0.0, 1.0, 2.0), (0.5, -3.0, 0.7), (2.0, 4.0, -1.0))[piece]
        return value + slope * (t - start) + (5.0 * math.exp(-(t - 0.5) / 0.3) if decays else 0.0)

    @pytest.mark.parametrize(("begin", "piece"), [(0.0, 0), (0.3, 0), (0.5, 1), (1.9, 1), (2.0, 2), (7.0, 2)])
    def test_is_what_it_says_from_each_corner_on(self, begin: float, piece: int) -> None:
        times = begin + np.array([0.0, 0.05, 0.1])
        expected = [self.by_hand(t, piece, piece > 0) for t in times]
        assert self.COURSE.at(begin, times) == pytest.approx(expected, rel=1e-14)
        just = begin * (1 - 2e-16) if begin else 0.0  # rounding of a corner is that corner
        assert self.COURSE.at(just, times) == pytest.approx(expected, rel=1e-14)

    def test_rounding_of_a_late_corner_is_that_corner(self) -> None:
        """1e-13 of the time and of a second, on either side of it: a piece and a decay begin there."""
        late = Course((0.0, 5e3), (1.0, 4.0), (0.0, 0.0), decay=2.0, constant=1.0, since=5e3)
        times = np.array([5e3])
        assert late.at(5e3 - 4e-10, times) == pytest.approx([6.0])
        assert late.at(5e3 - 6e-10, times) == pytest.approx([1.0])
        assert late.at(5e3 + 6e-10, times) == pytest.approx([6.0])

    def test_before_its_first_corner_it_is_its_first_piece(self) -> None:
        late = Course((1.0, 2.0), (3.0, 5.0), (0.5, 0.0))
        assert late.at(0.2, np.array([0.2])) == pytest.approx([3.0 - 0.4])
        assert late.breaks == (2.0,)
        assert self.COURSE.breaks == (0.5, 2.0, 0.5)
        assert NONE.breaks == ()

    def test_of_a_limiter_that_trips(self) -> None:
        both = Tripped(Course(values=(3.0,)), self.COURSE)
        assert both.at(2.0, 1.9, np.array([1.95])) == pytest.approx([3.0])
        assert both.at(2.0, 2.0, np.array([2.2])) == pytest.approx([self.by_hand(0.2, 0, False)])
        assert both.at(2.0, 2.6, np.array([2.7])) == pytest.approx([self.by_hand(0.7, 1, True)])
        assert Tripped(Course(values=(3.0,))).at(2.0, 2.6, np.array([2.7])) == pytest.approx([3.0])


KNOTS, VALUES = np.array([-1.0, 0.5, 2.0, 2.5]), np.array([3.0, -2.0, 4.0, 4.5])
NOW = np.zeros(1)


@pytest.mark.parametrize("speed", [-3.0, 0.0, 0.7, 1.0, 4.0])
def test_a_line_through_two_knots_goes_on_straight(speed: float) -> None:
    law = Lines(np.array([0.0, 1.0]), np.array([5.0, 2.0]), True)
    assert law.force(law.piece(speed), 0.0, NOW, np.array([speed])) == pytest.approx([5.0 - 3.0 * speed], rel=1e-13)


@pytest.mark.parametrize("extends", [False, True])
@pytest.mark.parametrize("speed", [-4.0, -1.0, -0.3, 0.5, 1.9, 2.0, 2.4, 2.5, 8.0])
def test_lines_over_the_speed(speed: float, extends: bool) -> None:
    """Interpolated; beyond the ends constant or straight on; guards above 0 inside, one below beyond an end."""
    law = Lines(KNOTS, VALUES, extends)
    expected = float(np.interp(speed, KNOTS, VALUES))
    if extends and speed < -1:
        expected = 3.0 - 5 / 1.5 * (speed + 1.0)
    if extends and speed > 2.5:
        expected = 4.5 + (speed - 2.5)
    piece = law.piece(speed)
    assert law.force(piece, 0.0, NOW, np.array([speed])) == pytest.approx([expected], rel=1e-13)
    assert all(value[0] >= 0 for _, value, _ in law.guards(piece, 0.0, NOW, np.array([speed])))
    for other in (speed - 1.1, speed + 1.1):
        fired = [follows for _, value, follows in law.guards(piece, 0.0, NOW, np.array([other])) if value[0] < 0]
        after = law.piece(other)
        assert len(fired) == (after != piece)
        if abs(after - piece) == 1:
            assert fired == [after]


@pytest.mark.parametrize("speed", [-3.0, -0.6, -0.4, 2.0, 4.4, 4.6, 9.0])
def test_a_control_is_clipped(speed: float) -> None:
    law = Governed(Course((0.0, 1.0), (2.0, 2.6), (0.6, 0.0)), 6.0, 15.0)
    at = np.array([speed])
    free = 6.0 * (2.0 - speed)
    piece = law.piece(speed)
    assert law.force(piece, 0.0, NOW, at) == pytest.approx([np.clip(free, -15, 15)])
    assert all(value[0] > 0 for _, value, _ in law.guards(piece, 0.0, NOW, at))
    assert law.force(0, 0.5, np.array([0.5]), at) == pytest.approx([6.0 * (2.3 - speed)])
    inside = law.guards(0, 0.0, NOW, at)
    assert [(float(value[0]), follows) for _, value, follows in inside] == [
        (pytest.approx(15 - free), 1), (pytest.approx(15 + free), -1)]  # fmt: skip
    for side in (1, -1):
        ((_, value, follows),) = law.guards(side, 0.0, NOW, at)
        assert (float(value[0]), follows) == (pytest.approx(side * free - 15), 0)


def test_corners_of_all_parts_are_told_once_and_in_order() -> None:
    smooth = Smooth(lambda v: 2 * v)
    assert (smooth.piece(3.0), smooth.guards(0, 0.0, NOW, NOW)) == (0, [])
    assert smooth.force(0, 0.0, NOW, np.array([1.5])) == pytest.approx([3.0])
    control = Governed(Course((0.0, 0.8), (1.0, 2.0), (0.0, 0.0)), 6.0, 15.0)
    one = Haul(
        1.0, 2.0, 3.0, 4.0, (1.0, 1.0), (1.0, 1.0), None, False, 0.0, 0.0, 1,
        set_speed=Course((0.0, 0.2), (1.0, 1.0), (0.0, 0.0)), capacity=Course((0.0, 0.7), (1.0, 1.0), (0.0, 0.0)),
        stages=(Stage(control, until=1.0), Stage(smooth, until_time=0.4)),
        gate=Tripped(Course(values=(1.0,)), Course((0.0, 0.05), (1.0, 0.0), (0.0, 0.0))),
        motor_brake=Tripped(Course((0.0, 0.2, 0.9), (0.0, 0.0, 1.0), (0.0,) * 3)),
        drum_brake=Tripped(NONE, Course((0.0, 0.01), (0.0, 1.0), (0.0, 0.0), decay=1.0, constant=1.0, since=0.03)),
    )  # fmt: skip
    assert one.breaks == (0.2, 0.4, 0.7, 0.8, 0.9)
    early = Course((0.0, 0.01), (1.0, 1.0), (0.0, 0.0), decay=1.0, constant=1.0, since=0.0)
    assert replace(one, capacity=early).breaks == (0.01, 0.2, 0.4, 0.8, 0.9), "the beginning is none"
    assert one.breaks_after_the_trip == (0.01, 0.03, 0.05)
