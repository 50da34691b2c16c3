"""Polynomials through Gauss-Lobatto nodes against numpy's polynomials and dense sampling."""

import math

import numpy as np
import pytest
from numpy.polynomial import Polynomial
from scipy.integrate import quad
from scipy.optimize import brentq

from ptmcalc.numerics import panels

DENSE = np.linspace(0.0, 1.0, 20001)


def random_polynomial(seed: int) -> Polynomial:
    """Of degree 8, with what happens inside [0, 1]."""
    rng = np.random.default_rng(seed)
    return Polynomial(rng.normal(size=9) * rng.choice([0.1, 1.0, 3.0], 9), domain=[0, 1], window=[-1, 1]).convert()


class TestNodes:
    def test_weights_and_symmetry(self) -> None:
        assert math.fsum(panels.WEIGHTS) == pytest.approx(1.0, rel=1e-15)
        assert np.abs(panels.NODES + panels.NODES[::-1] - 1).max() < 2e-15
        assert (panels.NODES[0], panels.NODES[-1]) == (0.0, 1.0)

    @pytest.mark.parametrize("degree", range(16))
    def test_quadrature_is_exact_to_degree_15(self, degree: int) -> None:
        assert panels.WEIGHTS @ panels.NODES**degree == pytest.approx(1 / (degree + 1), rel=1e-14)

    def test_quadrature_of_degree_16_is_not(self) -> None:
        error = panels.WEIGHTS @ panels.NODES**16 - 1 / 17
        assert abs(error) > 1e-12

    @pytest.mark.parametrize("count", [3, 4, 5, 12])
    def test_any_number_of_nodes(self, count: int) -> None:
        nodes, weights = panels.lobatto(count)
        exact = quad(lambda x: x ** (2 * count - 3), 0, 1)[0]
        assert weights @ nodes ** (2 * count - 3) == pytest.approx(exact, rel=1e-13)

    def test_slopes_are_those_of_the_polynomial(self) -> None:
        p = random_polynomial(1)
        assert panels.SLOPES @ p(panels.NODES) == pytest.approx(p.deriv()(panels.NODES), rel=1e-11, abs=1e-11)

    def test_between_the_nodes(self) -> None:
        p = random_polynomial(2)
        coefficients = (panels.TO_CHEBYSHEV @ p(panels.NODES)).tolist()
        found = [panels.at(coefficients, x) for x in DENSE[::500]]
        assert found == pytest.approx(p(DENSE[::500]), rel=1e-13, abs=1e-13)


class TestRoot:
    @pytest.mark.parametrize("place", [1e-12, 1e-3, 0.21, 0.5, 0.999, 1 - 1e-12])
    @pytest.mark.parametrize("steep", [1.0, 1e-6, 1e9])
    def test_of_a_line(self, place: float, steep: float) -> None:
        assert panels.root(steep * (place - panels.NODES), 0.0, 1.0) == pytest.approx(place, abs=1e-15)

    @pytest.mark.parametrize("size", [1e-9, 1.0, 1e9])
    def test_what_does_not_change_its_sign_has_its_ends(self, size: float) -> None:
        assert panels.root(size * (1.7 - panels.NODES), 0.1, 0.9) == 0.9
        assert panels.root(size * (panels.NODES - 1.7), 0.1, 0.9) == 0.1

    @pytest.mark.parametrize("seed", range(40))
    def test_of_random_polynomials(self, seed: int) -> None:
        p = random_polynomial(seed)
        p = p - p(0.3 + 0.01 * seed)
        if p(0.0) < 0:
            p = -p
        right = DENSE[p(DENSE) < -1e-9]
        if not len(right):  # it only touches 0 from above
            assert panels.root(p(panels.NODES), 0.0, 1.0) in (1.0, pytest.approx(0.3 + 0.01 * seed, abs=1e-6))
            return
        found = panels.root(p(panels.NODES), 0.0, float(right[0]))
        exact = brentq(p, 0.0, right[0], xtol=1e-16)
        slope = abs(p.deriv()(exact))
        assert found == pytest.approx(exact, abs=1e-13 * (1 + np.abs(p(panels.NODES)).max() / slope))

    def test_says_where_it_already_is(self) -> None:
        assert panels.root(-1 - panels.NODES, 0.2, 1.0) == 0.2
        assert panels.root(1 + panels.NODES, 0.2, 0.9) == 0.9

    def test_a_steep_fall_does_not_hold_up_false_position(self) -> None:
        exact = 0.5 ** (1 / 8)
        assert panels.root(0.5 - panels.NODES**8, 0.0, 1.0) == pytest.approx(exact, abs=4e-16)

    @pytest.mark.parametrize("back", [1e-6, 1e-3, 0.01, 0.7])
    def test_up_from_zero_and_back(self, back: float) -> None:
        """At both ends at most 0, above it in between, however early it is back."""
        nodes = panels.NODES * (back - panels.NODES)
        left = panels.above(nodes, 0.0, 1.0)
        assert 0 < left < back
        assert panels.root(nodes, left, 1.0) == pytest.approx(back, abs=1e-15 / back)

    def test_nowhere_above(self) -> None:
        assert panels.above(-panels.NODES, 0.25, 1.0) == 0.25


class TestCrossing:
    @pytest.mark.parametrize("order", range(9))
    def test_bernstein_coefficients_of_one_bernstein_polynomial(self, order: int) -> None:
        x = panels.NODES
        found = panels.TO_BERNSTEIN @ (math.comb(8, order) * x**order * (1 - x) ** (8 - order))
        assert found == pytest.approx(np.eye(9)[order], abs=1e-11)

    @pytest.mark.parametrize("seed", range(60))
    def test_the_polynomial_lies_above_its_smallest_coefficient(self, seed: int) -> None:
        p = random_polynomial(seed)
        assert (panels.TO_BERNSTEIN @ p(panels.NODES)).min() <= p(DENSE).min() + 1e-12

    @pytest.mark.parametrize("seed", range(60))
    def test_first_of_smooth_signals(self, seed: int) -> None:
        """Sines as slow as panels show them, against dense sampling."""
        rng = np.random.default_rng(seed)
        level, speed, phase, drift = rng.uniform([-1, 0.1, 0, -1], [1, 0.8, 2 * math.pi, 1])

        def signal(x: np.ndarray) -> np.ndarray:
            return np.sin(speed * x + phase) + drift * speed * x - level

        shown = panels.crossing(signal(panels.NODES), 1e-15)
        dense = signal(DENSE)
        below = np.flatnonzero((dense[1:] < 0) & (dense[:-1] >= 0))
        if len(below):
            exact = brentq(signal, DENSE[below[0]], DENSE[below[0] + 1], xtol=1e-16)
            assert shown == pytest.approx(exact, abs=1e-9)
        elif dense[0] < 0:
            assert shown == 0.0
        else:
            assert shown is None

    @pytest.mark.parametrize("depth", [1e-2, 1e-5, 1e-9])
    @pytest.mark.parametrize("place", [0.01, 0.2, 0.43, 0.5, 0.97])
    def test_at_a_dip(self, depth: float, place: float) -> None:
        nodes = (panels.NODES - place) ** 2
        assert panels.crossing(nodes + depth, 1e-15) is None
        exact = max(place - math.sqrt(depth), 0.0)
        assert panels.crossing(nodes - depth, 1e-15) == pytest.approx(exact, abs=1e-15 / math.sqrt(depth) + 1e-15)


class TestHighest:
    @pytest.mark.parametrize("seed", range(40))
    def test_of_random_polynomials(self, seed: int) -> None:
        p = random_polynomial(seed)
        dense = p(DENSE)
        (value,), (place,) = panels.highest(p(panels.NODES)[None])
        size = np.abs(dense).max()
        assert value >= dense.max() - 2e-14 * size
        digits = 1e-15 * np.abs(p.coef).sum()  # those of the powers themselves
        assert value == pytest.approx(p(place), abs=digits)
        turns = [x.real for x in p.deriv().roots() if abs(x.imag) < 1e-12 and 0 < x.real < 1]
        assert value == pytest.approx(max(p(np.array([0.0, 1.0, *turns]))), abs=1e-12 * size)

    @pytest.mark.parametrize("beyond", [-0.02, -0.004, 0.0, 1.0, 1.004, 1.02])
    def test_a_summit_beyond_an_end_counts_at_the_end(self, beyond: float) -> None:
        (value,), (place,) = panels.highest((3.0 - (panels.NODES - beyond) ** 2)[None])
        end = min(max(beyond, 0.0), 1.0)
        assert place == pytest.approx(end, abs=1e-12)
        assert value == pytest.approx(3.0 - (end - beyond) ** 2, abs=1e-14)

    def test_dips_between_nodes(self) -> None:
        """Where it falls at a node and rises at the next, the minimum between is that of the polynomial."""
        seen = 0
        for p in map(random_polynomial, range(40)):
            digits = 1e-15 * np.abs(p.coef).sum()
            slopes = p.deriv()(panels.NODES)
            for i in np.flatnonzero((slopes[:-1] < 0) & (slopes[1:] > 0)):
                left, right = panels.NODES[i], panels.NODES[i + 1]
                low, place = panels.dip(p(panels.NODES), left, right)
                exact = brentq(p.deriv(), left, right, xtol=1e-15)
                assert left <= place <= right
                assert (low, p(place)) == pytest.approx((p(exact), p(exact)), abs=digits)
                seen += 1
        assert seen > 10

    def test_several_signals_at_once(self) -> None:
        nodes = np.array([np.sin(3 * panels.NODES), panels.NODES, -panels.NODES, 0 * panels.NODES])
        values, places = panels.highest(nodes)
        assert values == pytest.approx([1.0, 1.0, 0.0, 0.0], abs=1e-6)
        assert places[:3] == pytest.approx([math.pi / 6, 1.0, 0.0], abs=1e-5)
