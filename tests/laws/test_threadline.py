"""Transverse frequencies of a moving string, compared with the travel of a wave and with a sum of sines."""

import math

import numpy as np
import pytest

from ptmcalc.laws.threadline import transverse_frequency


def by_sines(length: float, mass: float, tension: float, speed: float, terms: int = 60) -> np.ndarray:
    """Natural frequencies of q (w_tt + 2 v w_xt + v^2 w_xx) = T w_xx with w = 0 at both ends, w a sum of sines.

    The Galerkin equations M a'' + G a' + K a = 0 of the whole tension T = P + q v^2 are solved as a linear system of
    first order.
    """
    n = np.arange(1, terms + 1)
    row, column = np.meshgrid(n, n, indexing="ij")
    odd = (row + column) % 2 == 1
    turning = np.where(odd, 4 * mass * speed * row * column / np.where(odd, row**2 - column**2, 1), 0.0)
    stiff = np.diag((tension + mass * speed**2 - mass * speed**2) * (n * math.pi) ** 2 / (2 * length))
    inert = mass * length / 2
    system = np.block([[np.zeros((terms, terms)), np.eye(terms)], [-stiff / inert, -turning / inert]])
    found = np.linalg.eigvals(system).imag
    return np.sort(found[found > 1e-9]) / (2 * math.pi)


@pytest.mark.parametrize("speed", [0.0, 1.0, 12.0, 30.0])
def test_by_a_sum_of_sines(speed: float) -> None:
    found = transverse_frequency([1, 2, 3], 0.9, 2.6, 2400.0, speed)
    assert found == pytest.approx(by_sines(0.9, 2.6, 2400.0, speed)[:3], rel=2e-3)


def test_period_is_the_travel_of_a_wave_there_and_back() -> None:
    length, mass, tension, speed = 1.3, 5.0, 900.0, 7.0
    wave = math.sqrt(tension / mass + speed**2)
    period = length / (wave + speed) + length / (wave - speed)
    assert float(transverse_frequency(1, length, mass, tension, speed)) == pytest.approx(1 / period, rel=1e-12)


def test_a_chain_at_rest_is_a_string() -> None:
    """A string of 1 m, 1 kg/m and 100 N: 5 Hz and its multiples."""
    assert transverse_frequency(np.arange(1, 5), 1.0, 1.0, 100.0, 0.0) == pytest.approx([5, 10, 15, 20])


def test_without_tension() -> None:
    assert transverse_frequency([1, 2], 1.0, 1.0, 0.0, 3.0) == pytest.approx([0.0, 0.0])
    assert transverse_frequency([1, 2], 1.0, 1.0, 0.0, 0.0) == pytest.approx([0.0, 0.0])
    assert float(transverse_frequency(1, 1.0, 1.0, -5.0, 0.0)) == 0.0
