"""Collocation and the closed cycle against equations with known solutions, and against scipy's integrator."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from ptmcalc.numerics.collocation import gauss, radau
from ptmcalc.numerics.cycle import Grid, Orbit, solve

TURN = 2 * math.pi


class TestRule:
    @pytest.mark.parametrize("order", [3, 7, 12, 16])
    def test_the_last_node_is_the_end_and_polynomials_are_exact(self, order: int) -> None:
        rule = radau(order)
        assert rule.nodes[-1] == 1.0
        assert np.all(np.diff(rule.nodes) > 0)
        for power in range(2 * order - 1):
            assert rule.integral[-1] @ rule.nodes**power == pytest.approx(1 / (power + 1), rel=1e-12)
        for power in range(order):
            assert rule.integral @ rule.nodes**power == pytest.approx(
                rule.nodes ** (power + 1) / (power + 1), rel=1e-12
            )

    @pytest.mark.parametrize("order", [4, 9])
    def test_values_and_integrals_of_an_interpolant(self, order: int) -> None:
        rule = radau(order)
        values = np.cos(rule.nodes)
        coefficients = rule.to_legendre @ values
        assert rule.evaluate(coefficients, rule.nodes) == pytest.approx(values, rel=1e-12)
        tolerance = 3 * 10.0 ** (-order + 1)
        places = np.linspace(0, 1, 7)
        assert rule.evaluate(coefficients, places) == pytest.approx(np.cos(places), abs=tolerance)
        assert rule.integrate(coefficients, places) == pytest.approx(np.sin(places), abs=tolerance)
        assert rule.tail(coefficients) < 10 * tolerance

    def test_gauss_nodes_lie_between_and_weights_sum_to_one(self) -> None:
        nodes, weights = gauss(9)
        assert weights.sum() == pytest.approx(1.0, rel=1e-14)
        assert weights @ nodes**17 == pytest.approx(1 / 18, rel=1e-12)


def grid(stretches: int, order: int = 12) -> Grid:
    return Grid(np.linspace(0, TURN, stretches + 1), order)


class TestKnownMotions:
    @pytest.mark.parametrize("size", [1e-9, 0.01, 3e6])
    def test_the_unit_of_energy_does_not_matter(self, size: float) -> None:
        """The cycle of below, so many times as large, and its extremes to the last digits."""
        k, g = 0.7, grid(8)
        rates = lambda e: (-k * (e - 5 * size) + size * np.cos(g.angles), np.full(e.shape, -k))  # noqa: E731
        swing = 1 / math.sqrt(1 + k * k)
        for start in (None, size * (5 + k / (1 + k * k))):
            orbit = solve(g, rates, np.full(g.angles.shape, 0.6 * size), start)
            assert orbit is not None
            (low, _), (high, at_high) = orbit.extremes()
            assert (low / size, high / size) == pytest.approx((5 - swing, 5 + swing), rel=1e-13)
            assert at_high == pytest.approx(math.atan2(1, k), abs=1e-6)

    def test_a_linear_equation_closes_on_its_known_cycle(self) -> None:
        """de/dphi = -k (e - 5) + cos phi: e = 5 + (k cos phi + sin phi)/(1 + k^2)."""
        k, g = 0.7, grid(8)
        orbit = solve(
            g, lambda e: (-k * (e - 5) + np.cos(g.angles), np.full(e.shape, -k)), np.full(g.angles.shape, 3.0)
        )
        assert orbit is not None
        exact = 5 + (k * np.cos(g.angles) + np.sin(g.angles)) / (1 + k * k)
        assert orbit.nodes == pytest.approx(exact, rel=1e-13)
        assert orbit.multiplier == pytest.approx(math.exp(-k * TURN), rel=1e-10)
        anywhere = np.linspace(0, TURN, 33)
        assert orbit.at(anywhere) == pytest.approx(
            5 + (k * np.cos(anywhere) + np.sin(anywhere)) / (1 + k * k), rel=1e-13
        )
        (low, at_low), (high, at_high) = orbit.extremes()
        swing = 1 / math.sqrt(1 + k * k)
        assert (low, high) == pytest.approx((5 - swing, 5 + swing), rel=1e-13)
        top = math.atan2(1, k)
        assert (at_low, at_high) == pytest.approx((top + math.pi, top), abs=1e-6)

    @pytest.mark.parametrize("beyond", [-1e-3, -1e-6, 0.0, 1e-6, 1e-3])
    def test_a_summit_beside_an_edge_belongs_to_the_stretch_it_lies_in(self, beyond: float) -> None:
        """Whichever side of the edge has the larger sample, rounding decides where both are the same."""
        k, top = 0.7, math.atan2(1, 0.7)
        g = Grid(np.array([0.0, top / 2, top - beyond, 2.0, 3.0, 4.5, TURN]), 12)
        rates = lambda e: (-k * (e - 5) + np.cos(g.angles), np.full(e.shape, -k))  # noqa: E731
        orbit = solve(g, rates, np.full(g.angles.shape, 3.0))
        assert orbit is not None
        for start in (orbit.start, orbit.start * (1 + 1e-16 * np.arange(6)), orbit.start * (1 - 2e-16 * np.arange(6))):
            (_, _), (high, at_high) = replace(orbit, start=start).extremes()
            assert high == pytest.approx(5 + 1 / math.sqrt(1 + k * k), rel=3e-15)
            assert at_high == pytest.approx(top, abs=1e-6)

    @pytest.mark.parametrize("stiffness", [1.0, 1e3, 1e7])
    def test_however_stiff_it_is_the_end_is_met(self, stiffness: float) -> None:
        g = grid(40)
        rates = lambda e: (-stiffness * (e - 5 - np.sin(g.angles)), np.full(e.shape, -stiffness))  # noqa: E731
        orbit = solve(g, rates, np.full(g.angles.shape, 1.0))
        assert orbit is not None
        slow = 5 + (stiffness**2 * np.sin(g.angles) - stiffness * np.cos(g.angles)) / (1 + stiffness**2)
        assert orbit.nodes == pytest.approx(slow, rel=1e-9)

    def test_from_a_start_it_is_an_initial_value_problem(self) -> None:
        g = grid(10)
        orbit = solve(g, lambda e: (-0.3 * np.sqrt(e), -0.15 / np.sqrt(e)), np.full(g.angles.shape, 9.0), start=9.0)
        assert orbit is not None
        assert orbit.at(TURN) == pytest.approx((3 - 0.15 * TURN) ** 2, rel=1e-12)
        assert orbit.multiplier == pytest.approx((3 - 0.15 * TURN) / 3, rel=1e-10)

    def test_a_motion_that_comes_to_rest_is_none(self) -> None:
        g = grid(10)
        assert (
            solve(g, lambda e: (np.full(e.shape, -1.0), np.zeros(e.shape)), np.full(g.angles.shape, 3.0), 3.0) is None
        )

    def test_what_never_closes_is_none(self) -> None:
        g = grid(4)
        assert solve(g, lambda e: (np.full(e.shape, 1.0), np.zeros(e.shape)), np.full(g.angles.shape, 3.0)) is None

    def test_a_guess_below_zero_is_refused(self) -> None:
        g = grid(4)
        assert solve(g, lambda e: (-e, -np.ones(e.shape)), np.full(g.angles.shape, -1.0)) is None


def test_a_motor_and_a_load_against_the_poincare_map_of_an_integrator() -> None:
    """J w' = 60 - 4 w - 30 (1 + sin phi) + a jump of the load, by e = w^2/2 here and by w over time there."""
    edges = np.unique(np.concatenate([np.linspace(0, TURN, 13), [2.0, 3.5]]))
    g = Grid(edges, 12)
    middle = (edges[1:] + edges[:-1])[:, None] / 2  # the last node of a stretch lies on its end
    jump = np.where((middle > 2.0) & (middle < 3.5), 20.0, 0.0)

    def rates(e: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        w = np.sqrt(2 * e)
        return (60 - 4 * w - 30 * (1 + np.sin(g.angles)) - jump) / 2, -2 / w

    orbit = solve(g, rates, np.full(g.angles.shape, 30.0))
    assert orbit is not None

    def once(w: float) -> float:
        for low, high, extra in ((0.0, 2.0, 0.0), (2.0, 3.5, 20.0), (3.5, TURN, 0.0)):

            def of(phi: float, y: list[float], extra: float = extra) -> list[float]:
                return [(60 - 4 * y[0] - 30 * (1 + math.sin(phi)) - extra) / 2 / y[0]]

            w = float(solve_ivp(of, (low, high), [w], method="DOP853", rtol=1e-12, atol=1e-13).y[0, -1])
        return w

    guess = math.sqrt(2 * float(orbit.at(0.0)))
    start = brentq(lambda w: once(w) - w, 0.9 * guess, 1.1 * guess, xtol=1e-13)
    assert math.sqrt(2 * float(orbit.at(0.0))) == pytest.approx(start, rel=1e-10)
    slope = (once(start + 1e-4) - once(start - 1e-4)) / 2e-4
    assert orbit.multiplier == pytest.approx(slope, rel=1e-4)


def test_a_quadrature_over_the_motion_sees_all_of_it() -> None:
    slopes = radau(6).to_legendre @ np.zeros((6,))
    orbit = Orbit(Grid(np.array([0.0, 1.0, TURN]), 6), np.array([2.0, 2.0]), np.array([slopes, slopes]), 1.0)
    angles, e, weights = orbit.sample(5)
    assert np.all(e == 2.0)
    assert np.sum(weights) == pytest.approx(TURN, rel=1e-14)
    assert np.sum(np.sin(angles / 2) * weights) == pytest.approx(4.0, rel=1e-4)


def test_what_a_motion_says_of_its_slope() -> None:
    """de/dphi = -k (e - 5) + cos phi again, at nodes, at those of a quadrature, and how far off it may be."""
    k = 0.7
    for order, tolerance in ((4, 1e-3), (6, 1e-5), (12, 1e-12)):
        g = grid(8).with_order(order)
        assert (g.order, g.angles.shape) == (order, (8, order))
        orbit = solve(
            g, lambda e, g=g: (-k * (e - 5) + np.cos(g.angles), np.full(e.shape, -k)), np.full(g.angles.shape, 3.0)
        )
        assert orbit is not None

        def exact(phi: np.ndarray) -> np.ndarray:
            return 5 + (k * np.cos(phi) + np.sin(phi)) / (1 + k * k)

        def slope(phi: np.ndarray) -> np.ndarray:
            return (np.cos(phi) - k * np.sin(phi)) / (1 + k * k)

        assert orbit.multiplier == pytest.approx(math.exp(-k * TURN), rel=10 * tolerance)
        assert orbit.rates == pytest.approx(slope(g.angles), abs=3 * tolerance)
        assert orbit.rates == pytest.approx(-k * (orbit.nodes - 5) + np.cos(g.angles), abs=1e-12)
        angles, energies, weights = orbit.sample(7)
        assert orbit.derivative(7) == pytest.approx(slope(angles), abs=3 * tolerance)
        assert energies == pytest.approx(exact(angles), abs=tolerance)
        assert weights.sum(axis=1) == pytest.approx(g.lengths, rel=1e-14)
        places = np.linspace(0, 1, 41)
        away = np.abs(orbit.within(places) - exact(g.edges[:-1, None] + g.lengths[:, None] * places)).max(axis=1)
        assert np.all(away <= orbit.tail() + 1e-13)
        if order < 12:
            assert np.all(orbit.tail() <= 3000 * away)


def test_a_corner_at_an_edge_is_the_summit_and_nothing_beyond_it() -> None:
    """e rises and falls in straight lines: the largest is that of the edge between them, the smallest those outside."""
    g = Grid(np.array([0.0, 1.3, 2.9]), 5)
    slopes = np.array([0.7, -0.4])[:, None]
    for sign in (1.0, -1.0):
        rates = np.broadcast_to(sign * slopes, g.angles.shape)
        orbit = solve(g, lambda e, rates=rates: (rates.copy(), np.zeros(e.shape)), np.full(g.angles.shape, 4.0), 4.0)
        assert orbit is not None
        low, high = orbit.extremes()
        if sign < 0:
            low, high = high, low
        assert high == pytest.approx((4.0 + sign * 0.91, 1.3), rel=1e-13)
        assert low == pytest.approx((4.0, 0.0), rel=1e-13)


@pytest.mark.parametrize("stretches", [2, 3, 8])
@pytest.mark.parametrize("phase", [0.0, 0.4, 2.2])
def test_summits_between_the_places_looked_at_are_exact(stretches: int, phase: float) -> None:
    """e = 5 + cos(phi - p - q)/(1 + k^2)^(1/2), tan q = 1/k, for de/dphi = -k (e - 5) + cos(phi - p)."""
    k, g = 0.7, grid(stretches, 24)
    orbit = solve(
        g, lambda e: (-k * (e - 5) + np.cos(g.angles - phase), np.full(e.shape, -k)), np.full(g.angles.shape, 3.0)
    )
    assert orbit is not None
    (low, low_at), (high, high_at) = orbit.extremes()
    size, late = 1 / math.sqrt(1 + k * k), phase + math.atan(1 / k)
    assert (low, high) == pytest.approx((5 - size, 5 + size), rel=1e-13)
    assert high_at % TURN == pytest.approx(late % TURN, abs=3e-7)
    assert low_at % TURN == pytest.approx((late + math.pi) % TURN, abs=3e-7)


@pytest.mark.parametrize("stretches", [6, 8])
@pytest.mark.parametrize("phase", [0.0, 0.37, 1.1, 2.2, 3.9])
@pytest.mark.parametrize("size", [1e-5, 1.0, 1e5])
def test_the_angle_of_a_summit_is_that_of_a_slope_of_nothing(size: float, stretches: int, phase: float) -> None:
    """A skew summit, e/size = 5 + sin(phi - p) + sin(2 (phi - p))/3: where its slope, to 1e-11 of it, is 0."""
    g = grid(stretches, 24)

    def slope(phi: np.ndarray) -> np.ndarray:
        return np.cos(phi - phase) + 2 / 3 * np.cos(2 * (phi - phase))

    def bend(phi: float) -> float:
        return -math.sin(phi - phase) - 4 / 3 * math.sin(2 * (phi - phase))

    wanted = 5 + np.sin(g.angles - phase) + np.sin(2 * (g.angles - phase)) / 3
    rates = lambda e: (size * (wanted + slope(g.angles)) - e, -np.ones(e.shape))  # noqa: E731
    orbit = solve(g, rates, np.full(wanted.shape, 5.0 * size))
    assert orbit is not None
    for value, angle in orbit.extremes():
        assert abs(float(slope(np.array(angle)))) <= 2e-10 * abs(bend(angle))
        expected = 5 + math.sin(angle - phase) + math.sin(2 * (angle - phase)) / 3
        assert value == pytest.approx(size * expected, rel=1e-13)


def test_a_summit_takes_few_looks(monkeypatch: pytest.MonkeyPatch) -> None:
    """False position on the slope: some fifteen evaluations for each extreme, no fewer than its digits need."""
    g, looks = grid(8, 24), []
    orbit = solve(
        g, lambda e: (-0.7 * (e - 5) + np.cos(g.angles - 0.4), np.full(e.shape, -0.7)), np.full(g.angles.shape, 3.0)
    )
    assert orbit is not None
    kind = type(radau(24))
    evaluate = kind.evaluate
    monkeypatch.setattr(kind, "evaluate", lambda self, *given: (looks.append(1), evaluate(self, *given))[1])
    orbit.extremes()
    assert 10 <= len(looks) <= 34


def test_a_summit_that_would_lie_behind_a_corner_is_the_corner() -> None:
    """e rises towards a vertex 0.5 % of the stretch behind its end, where it begins to fall: nothing lies beyond."""
    g = Grid(np.array([0.0, 1.3, 2.9]), 5)
    slopes = np.array([1.005 * 1.3 - g.angles[0], np.full(5, -0.4)])
    for mirrored in (False, True):
        way = -slopes[::-1, ::-1] if mirrored else slopes
        here = Grid(2.9 - g.edges[::-1], 5) if mirrored else g
        if mirrored:
            way = np.array([np.full(5, 0.4), (here.angles[1] - here.edges[1]) * -1 - 0.005 * 1.3])
        orbit = solve(here, lambda e, way=way: (way.copy(), np.zeros(e.shape)), np.full(way.shape, 4.0), 4.0)
        assert orbit is not None
        top = 4.0 + (0.4 * 1.6 if mirrored else 1.3**2 * 0.505)
        assert orbit.extremes()[1] == pytest.approx((top, float(here.edges[1])), rel=1e-13)


def test_how_far_a_stretch_may_be_off_goes_with_its_length() -> None:
    g = Grid(np.array([0.0, 0.02, 1.3, 6.0]), 6)
    slopes = np.random.default_rng(4).normal(size=(3, 6))
    last = np.abs(slopes[:, -2:]).max(axis=1)
    assert Orbit(g, np.ones(3), slopes, 1.0).tail() == pytest.approx(last / 11 * g.lengths, rel=1e-14)


class TestNewton:
    """Calls of the rate: one for each step and one for the slopes at the end."""

    @staticmethod
    def calls(noise: float, power: float, guess: float = 9.0, size: float = 1.0) -> tuple[Orbit | None, int]:
        """With x = e/size: x' = -0.3 x^power from 9 on, every other call by a trifle more."""
        g, count = grid(10), 0

        def rate(e: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            nonlocal count
            count += 1
            x = e / size
            return -0.3 * size * x**power * (1 + noise * (-1) ** count), -0.3 * power * x ** (power - 1)

        return solve(g, rate, np.full(g.angles.shape, guess * size), start=9.0 * size), count

    @pytest.mark.parametrize("size", [1e-7, 1.0, 1e7])
    def test_a_linear_equation_is_solved_at_once(self, size: float) -> None:
        orbit, count = self.calls(0.0, 1.0, size=size)
        assert count == 3, "one that solves it, one to see it, one for the slopes"
        assert orbit is not None
        assert orbit.at(TURN) == pytest.approx(9 * size * math.exp(-0.3 * TURN), rel=1e-12)

    @pytest.mark.parametrize("size", [1e-7, 1.0, 1e7])
    def test_another_one_doubles_its_digits(self, size: float) -> None:
        for guess in (9.0, 3.0, 30.0):
            orbit, count = self.calls(0.0, 0.5, guess, size)
            assert orbit is not None
            assert count <= 8
            assert orbit.at(TURN) / size == pytest.approx((3 - 0.15 * TURN) ** 2, rel=1e-13)
            assert orbit.rates / size == pytest.approx(-0.3 * np.sqrt(orbit.nodes / size), rel=1e-13)

    @pytest.mark.parametrize(
        ("noise", "stands"), [(3e-14, True), (1e-12, True), (9e-11, True), (1.3e-10, False), (1e-8, False)]
    )
    def test_noise_ends_it_where_it_is_small_and_is_refused_where_it_is_not(self, noise: float, stands: bool) -> None:
        orbit, count = self.calls(noise, 0.5)
        assert (orbit is not None) == stands
        assert (count <= 9) == stands
        if orbit is not None:
            assert orbit.at(TURN) == pytest.approx((3 - 0.15 * TURN) ** 2, rel=10 * noise + 1e-13)

    def test_a_step_falls_no_deeper_than_to_a_tenth(self) -> None:
        """From far above Newton's step would lead below 0: the next e is a tenth there, then it goes on."""
        seen = []
        g = grid(10)

        def rate(e: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            seen.append(float(e.min()))
            return -0.002 * e**2, -0.004 * e

        orbit = solve(g, rate, np.full(g.angles.shape, 4000.0), start=9.0)
        assert orbit is not None
        assert orbit.at(TURN) == pytest.approx(1 / (1 / 9 + 0.002 * TURN), rel=1e-12)
        assert min(later / earlier for earlier, later in itertools.pairwise(seen)) == pytest.approx(0.1)
