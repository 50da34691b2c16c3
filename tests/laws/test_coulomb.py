"""Dry friction against a walk from stop to stop and against work."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from ptmcalc.laws import coulomb

steady = settings(derandomize=True, database=None, deadline=None, max_examples=150)


def walk(mass: float, friction: float, pull: float, speed: float, until: float) -> float:
    """Path by events: each stretch of one direction is integrated until the speed is 0."""
    path, time = 0.0, 0.0
    while time < until:
        if speed == 0:
            if abs(pull) <= friction:
                return path
            way = math.copysign(1.0, pull)
        else:
            way = math.copysign(1.0, speed)

        def rate(t: float, y: np.ndarray, way: float = way) -> list[float]:
            return [y[1], (pull - way * friction) / mass]

        def stops(t: float, y: np.ndarray) -> float:
            return float(y[1])

        stops.terminal, stops.direction = True, -way  # type: ignore[attr-defined]
        run = solve_ivp(rate, (time, until), [path, speed], events=stops, rtol=1e-10, atol=1e-13)
        path, time = run.y[0, -1], run.t[-1]
        speed = 0.0 if run.status == 1 else run.y[1, -1]
    return path


class TestSlide:
    @pytest.mark.parametrize("pull", [-120.0, -50.0, -20.0, 0.0, 49.999, 50.0, 51.0, 120.0])
    @pytest.mark.parametrize("speed", [-2.0, 0.0, 1.0])
    def test_walks_from_stop_to_stop(self, pull: float, speed: float) -> None:
        for until in (0.3, 2.0, 9.0):
            found = float(coulomb.coulomb_slide(100.0, 50.0, pull, speed, until))
            assert found == pytest.approx(walk(100.0, 50.0, pull, speed, until), rel=1e-8, abs=1e-10)

    @given(st.floats(1e-3, 10), st.floats(1, 100), st.floats(0.1, 1e3))
    @steady
    def test_friction_eats_the_kinetic_energy(self, speed: float, friction: float, mass: float) -> None:
        path = float(coulomb.coulomb_slide(mass, friction, 0.0, speed, 1e9))
        assert friction * path == pytest.approx(mass * speed**2 / 2, rel=1e-10)

    def test_without_friction_it_is_a_free_fall(self) -> None:
        assert float(coulomb.coulomb_slide(2.0, 0.0, 6.0, 1.0, 4.0)) == pytest.approx(4 + 3 * 16 / 2, rel=1e-14)
        assert float(coulomb.coulomb_slide(2.0, 0.0, -6.0, 1.0, 4.0)) == pytest.approx(4 - 3 * 16 / 2, rel=1e-14)


def half_swings(x: float, kinetic: float, static: float, stiffness: float) -> tuple[int, float]:
    """From turn to turn by the energy: what the spring gives, friction eats on the way."""
    count = 0
    while stiffness * abs(x) > static:
        way = math.copysign(1.0, x)
        # c (x^2 - y^2)/2 = F (|x| - way y) with y the next turn: (c/2)(|x| + way y) = F
        x = way * (2 * kinetic / stiffness - abs(x))
        count += 1
    return count, x


class TestDecay:
    @pytest.mark.parametrize("displacement", [0.0, 0.001, 0.0037, -0.05, 0.3])
    @pytest.mark.parametrize("static", [20.0, 31.0])
    def test_turn_by_turn(self, displacement: float, static: float) -> None:
        count, rest = half_swings(displacement, 20.0, static, 1e4)
        found = coulomb.coulomb_decay(displacement, 20.0, static, 1e4, 4.0)
        assert found[0] == count
        assert found[1] == pytest.approx(rest, rel=1e-9, abs=1e-12)
        assert found[2] == pytest.approx(count * math.pi * 0.02, rel=1e-13)

    def test_by_integration(self) -> None:
        """Turns of the integrated motion with friction against the speed of each stretch."""
        c, m, friction, x, turns, time = 1e4, 4.0, 20.0, 0.0177, 0, 0.0
        while c * abs(x) > friction:
            way = math.copysign(1.0, x)

            def rate(t: float, y: np.ndarray, way: float = way) -> list[float]:
                return [y[1], (way * friction - c * y[0]) / m]

            def stops(t: float, y: np.ndarray) -> float:
                return float(y[1])

            stops.terminal, stops.direction = True, way  # type: ignore[attr-defined]
            run = solve_ivp(rate, (0, 1), [x, -1e-13 * way], events=stops, rtol=1e-11, atol=1e-14)
            x, time, turns = float(run.y[0, -1]), time + float(run.t[-1]), turns + 1
        assert coulomb.coulomb_decay(0.0177, friction, friction, c, m) == pytest.approx((turns, x, time), rel=1e-7)

    @given(st.integers(1, 10**6), st.sampled_from([0.1, 0.3, 0.7, 1.1]))
    @steady
    def test_counts_exactly_whatever_the_rounding(self, halves: int, force: float) -> None:
        """Just inside and just outside the last stop: k half swings and k + 1."""
        edge = (2 * halves + 1) * force  # c = 1: sticks from here on after `halves` half swings, up to rounding
        counts = [
            coulomb.coulomb_decay(x, force, force, 1.0, 1.0)[0]
            for x in (edge * (1 - 1e-15), math.nextafter(edge * (1 + 1e-15), math.inf))
        ]
        assert counts == [halves, halves + 1]

    @pytest.mark.parametrize(("displacement", "halves"), [(0.9, 1), (2.7, 4), (4.5, 7), (17.1, 28), (2.1, 3)])
    def test_a_spring_that_just_holds_holds(self, displacement: float, halves: int) -> None:
        """In floats (0.9 - 0.3)/0.6 is 1.0000000000000002, and its ceiling one half swing too many."""
        count, rest, _ = coulomb.coulomb_decay(displacement, 0.3, 0.3, 1.0, 1.0)
        assert count == halves
        assert abs(rest) == 0.3
