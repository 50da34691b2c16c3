"""The Radau rule against its published nodes, and what its parts make of polynomials."""

import math

import numpy as np
import pytest
from numpy.polynomial import Polynomial
from scipy.special import eval_legendre

from ptmcalc.numerics.collocation import gauss, integrals, radau, sampler

ORDERS = [1, 2, 3, 7, 12]
INSIDE = np.array([0.0, 0.13, 0.5, 0.871, 1.0])


def drawn(degree: int) -> Polynomial:
    return Polynomial(np.random.default_rng(degree).normal(size=degree + 1))


def test_nodes_of_three() -> None:
    """E. Hairer, G. Wanner, table 5.6: (4 - 6^(1/2))/10, (4 + 6^(1/2))/10, 1 and the weights of the last row."""
    rule = radau(3)
    root = math.sqrt(6)
    assert rule.nodes == pytest.approx([(4 - root) / 10, (4 + root) / 10, 1.0], rel=1e-15)
    assert rule.integral[-1] == pytest.approx([(16 - root) / 36, (16 + root) / 36, 1 / 9], rel=1e-14)
    assert rule.integral[0] == pytest.approx([(88 - 7 * root) / 360, (296 - 169 * root) / 1800, (-2 + 3 * root) / 225])
    assert rule.order == 3


@pytest.mark.parametrize("order", [12, 24])
def test_many_nodes_are_zeros_to_the_last_digits(order: int) -> None:
    x = 2 * radau(order).nodes - 1
    assert np.abs(eval_legendre(order - 1, x) - eval_legendre(order, x)).max() < 3e-14


@pytest.mark.parametrize("order", ORDERS)
class TestPolynomials:
    def test_are_themselves_by_their_coefficients(self, order: int) -> None:
        p, rule = drawn(order - 1), radau(order)
        coefficients = rule.to_legendre @ p(rule.nodes)
        whole = p.integ()
        assert rule.evaluate(coefficients, INSIDE) == pytest.approx(p(INSIDE), rel=1e-11, abs=1e-12)
        assert rule.integrate(coefficients, INSIDE) == pytest.approx(whole(INSIDE), rel=1e-12, abs=1e-14)
        assert rule.integral @ p(rule.nodes) == pytest.approx(whole(rule.nodes), rel=1e-12)
        spread = np.arange(1, 6) / 5
        assert sampler(order, 5) @ coefficients == pytest.approx(whole(spread), rel=1e-12)

    def test_integrals_at_the_nodes_are_polynomials_again(self, order: int) -> None:
        p, rule = drawn(order - 1), radau(order)
        again = rule.once_integrated @ (rule.to_legendre @ p(rule.nodes))
        assert rule.evaluate(again, rule.nodes) == pytest.approx(p.integ()(rule.nodes), rel=1e-12)

    def test_the_whole_is_exact_to_degree_two_n_less_two(self, order: int) -> None:
        rule = radau(order)
        for degree in range(2 * order - 1):
            assert rule.integral[-1] @ rule.nodes**degree == pytest.approx(1 / (degree + 1), rel=1e-13)
        assert abs(rule.integral[-1] @ rule.nodes ** (2 * order - 1) - 1 / (2 * order)) > 1e-3 * 4.0 ** (-2 * order)


def most_added(order: int) -> float:
    """What the last two coefficients, 2.3 each, add at most: int_0^x P_k = (P_(k+1) - P_(k-1))/(4 k + 2)."""
    x = np.linspace(-1, 1, 4001)
    at = [np.polynomial.legendre.Legendre.basis(k)(x) for k in range(order + 1)]
    k, last = order - 2, order - 1
    before = (at[k + 1] - at[k - 1]) / (4 * k + 2) if k else (x + 1) / 2
    return 2.3 * float((np.abs(before) + np.abs(at[last + 1] - at[last - 1]) / (4 * last + 2)).max())


@pytest.mark.parametrize("order", [4, 5, 7, 12, 16])
def test_the_tail_bounds_what_the_last_coefficients_add(order: int) -> None:
    """From four nodes on both together, whatever their signs, and it is no more than three times what they can add."""
    rule, dense = radau(order), np.linspace(0, 1, 2001)
    for last in ((2.3, 2.3), (2.3, -2.3), (-2.3, 0.0), (0.0, 2.3)):
        coefficients = np.zeros(order)
        coefficients[-2:] = last
        assert rule.tail(coefficients) == pytest.approx(2.3 / (2 * order - 1), rel=1e-14)
        assert np.abs(rule.integrate(coefficients, dense)).max() <= most_added(order) * (1 + 1e-12)
        assert most_added(order) <= rule.tail(coefficients)
    assert 3 * most_added(order) > 2.3 / (2 * order - 1)
    coefficients = np.zeros((2, order))
    coefficients[:, :-2] = 5.0
    assert np.all(rule.tail(coefficients) == 0.0)


@pytest.mark.parametrize(("order", "share"), [(2, 3.0), (3, 40 / 27)])
def test_with_fewer_nodes_the_last_coefficients_add_more_than_the_tail(order: int, share: float) -> None:
    tail = float(radau(order).tail(np.full(order, 2.3)))
    assert most_added(order) == pytest.approx(share * tail, rel=1e-6)


@pytest.mark.parametrize("order", [2, 8, 13])
def test_gauss_is_exact_to_degree_two_n_less_one(order: int) -> None:
    nodes, weights = gauss(order)
    for degree in range(2 * order):
        assert weights @ nodes**degree == pytest.approx(1 / (degree + 1), rel=1e-13)
    assert abs(weights @ nodes ** (2 * order) - 1 / (2 * order + 1)) > 0.1 * 16.0**-order


def test_integrals_of_legendre_polynomials() -> None:
    x = np.array([0.2, 0.77])
    expected = [x, x * (x - 1), 2 * x**3 - 3 * x**2 + x]
    assert pytest.approx(np.array(expected), rel=1e-14) == integrals(3, x).T
