"""Radau collocation: a differential equation made exact at the nodes of a polynomial, stable however stiff it is.

On a stretch of length h the derivative f of the solution is the polynomial through its values at the n nodes; the
solution is its integral, of degree n. At the end of the stretch the error is of order 2n - 1, inside of order n + 1.
The tail of the Legendre coefficients of f says how far the polynomial is from the solution.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Rule:
    """Nodes on (0, 1], the last one at 1, and the matrices that belong to them."""

    nodes: FloatArray
    integral: FloatArray
    """integrals from 0 to each node from node values, shape (n, n)"""
    to_legendre: FloatArray
    """Legendre coefficients from node values, shape (n, n)"""
    once_integrated: FloatArray
    """Legendre coefficients of the polynomial through the integrals at the nodes, from those of the function, (n, n)"""

    @property
    def order(self) -> int:
        """Number of nodes."""
        return len(self.nodes)

    def integrate(self, coefficients: FloatArray, place: ArrayLike) -> FloatArray:
        """Integral from 0 to places in [0, 1] of functions given by their Legendre coefficients, shape (..., n).

        Returns shape (..., places).
        """
        return np.asarray(coefficients @ integrals(self.order, np.asarray(place, float)).T)

    def evaluate(self, coefficients: FloatArray, place: ArrayLike) -> FloatArray:
        """Values at places in [0, 1] of functions given by their Legendre coefficients."""
        basis = np.stack(_legendre(2 * np.asarray(place, float) - 1, self.order - 1), axis=-1)
        return np.asarray(coefficients @ basis.T)

    def tail(self, coefficients: FloatArray) -> FloatArray:
        """What the last two coefficients of a derivative add to the solution at most, per length of the stretch.

        **Range** from four nodes on; of three they may add 40/27 of it, of two three times as much.
        """
        last = np.abs(coefficients[..., -2:]).max(axis=-1)
        return np.asarray(last / (2 * self.order - 1))


def integrals(order: int, place: FloatArray) -> FloatArray:
    """Integrals from 0 to places in [0, 1] of the first Legendre polynomials on [0, 1], shape (places, order)."""
    x = 2 * np.asarray(place, float) - 1
    p = _legendre(x, order)
    found = [(x + 1) / 2] + [(p[k + 1] - p[k - 1]) / (2 * (2 * k + 1)) for k in range(1, order)]
    return np.stack(found, axis=-1)


def _legendre(x: FloatArray, degree: int) -> list[FloatArray]:
    """Legendre polynomials of degree 0 to some degree, by their recurrence."""
    p = [np.ones(x.shape), x]
    for k in range(1, degree):
        p.append(((2 * k + 1) * x * p[k] - k * p[k - 1]) / (k + 1))
    return p[: degree + 1]


@lru_cache
def radau(order: int) -> Rule:
    """The right Radau rule with so many nodes.

    **Source** nodes: zeros of P_(n-1)(2x - 1) - P_n(2x - 1) (E. Hairer and G. Wanner, Solving ordinary differential
    equations II, Springer 1996, section IV.5: Radau IIA).
    """
    series = np.zeros(order + 1)
    series[-2:] = 1.0, -1.0
    polynomial = np.polynomial.legendre.Legendre(series)
    slope = polynomial.deriv()
    x = np.sort(polynomial.roots().real)
    for _ in range(3):  # the zeros of a companion matrix are good to ten digits
        x = x - polynomial(x) / slope(x)
    nodes = (x + 1) / 2
    nodes[-1] = 1.0
    to_legendre = np.asarray(np.linalg.inv(np.polynomial.legendre.legvander(2 * nodes - 1, order - 1)), float)
    at_nodes = integrals(order, nodes)
    return Rule(nodes, at_nodes @ to_legendre, to_legendre, np.asarray(to_legendre @ at_nodes, float))


@lru_cache
def sampler(order: int, count: int) -> FloatArray:
    """`integrals` at places spread evenly over (0, 1], shape (count, order)."""
    return integrals(order, np.linspace(0.0, 1.0, count + 1)[1:])


@lru_cache
def gauss(order: int) -> tuple[FloatArray, FloatArray]:
    """Gauss-Legendre nodes on [0, 1] and their weights: the quadrature of the energy balance, at places of its own."""
    x, w = np.polynomial.legendre.leggauss(order)
    return (x + 1) / 2, w / 2
