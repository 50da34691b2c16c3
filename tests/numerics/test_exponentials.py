"""Divided differences of exp against the corner of the exponential of a bidiagonal matrix (Opitz)."""

import numpy as np
import pytest
from scipy.linalg import expm

from ptmcalc.numerics.exponentials import differences, superposed

TIMES = np.array([0.0, 1e-6, 0.01, 0.2, 0.9, 1.1, 4.0])
POINTS = {
    "apart": (-1 + 5j, -1 - 5j, -3 + 0j, -96 + 0j),
    "undamped": (2j, -2j, -0.5 + 0j, -4 + 0j),
    "real": (-1 + 0j, -7 + 0j, -3 + 0j, -20 + 0j),
    "one point": (-3 + 0j, -3 + 0j, -3 + 0j, -3 + 0j),
    "nearly one point": (-3 + 1e-7j, -3 - 1e-7j, -3 + 0j, -3.0000001 + 0j),
    "two pairs": (-3 + 0j, -3 + 0j, -50 + 0j, -50 + 0j),
    "at rest": (0j, 0j, 0j, -2 + 0j),
}
SETS = ((0, 1, 2, 3), (1, 2, 3), (0, 1, 3), (0, 2), (1, 2), (2, 3), (1,), (3,))


@pytest.mark.parametrize("name", POINTS)
def test_are_the_corners_of_exponentials(name: str) -> None:
    points = POINTS[name]
    found = differences(points, SETS, TIMES)
    for chosen, values in zip(SETS, found, strict=True):
        order = len(chosen) - 1
        for t, value in zip(TIMES, values, strict=True):
            matrix = np.diag([points[i] * t for i in chosen]) + np.diag(np.ones(order), 1)
            expected = expm(matrix)[0, order]
            size = max(abs(expected), np.exp(max(points[i].real * t for i in chosen)))
            digits = 1e-9 if "nearly" in name else 1e-13  # the matrix has no more of points that nearly meet
            assert abs(value - expected) <= digits * size


@pytest.mark.parametrize("name", POINTS)
def test_are_real_where_their_points_are(name: str) -> None:
    points = POINTS[name]
    for chosen, values in zip(SETS, differences(points, SETS, TIMES), strict=True):
        paired = points[0].imag == 0 or (0 in chosen) == (1 in chosen)
        assert np.iscomplexobj(values) != paired


def test_of_no_times_are_none() -> None:
    assert [len(one) for one in differences(POINTS["apart"], SETS, np.empty(0))] == [0] * len(SETS)


@pytest.mark.parametrize("rate", [complex(0, 5.47), complex(-0.3, 11.0), complex(-9.0, 0.5)])
@pytest.mark.parametrize("count", [255, 256, 1000, 1024, 10_001])
@pytest.mark.parametrize("first", [0.0, 0.7, 5.002])
def test_evenly_spaced_times_are_a_rotation(rate: complex, count: int, first: float) -> None:
    """Both parts of one exponential, and a sum of two that leaves one of them."""
    times = np.linspace(first, first + 20.0, count)
    expected = np.exp(np.clongdouble(rate) * times.astype(np.longdouble))
    allowed = np.finfo(float).eps * (4 + 4 * abs(rate) * times) * np.abs(expected)
    weights = np.array([[1, 0], [-1j, 0], [0.5 + 2j, 0.5 + 2j]])
    one, other, both = superposed((rate, rate.conjugate()), weights, times)
    assert np.all(np.hypot(one - expected.real, other - expected.imag) <= allowed)
    assert np.all(np.abs(both - expected.real) <= 3 * allowed)


@pytest.mark.parametrize("unit", [1e-9, 1.0, 1e9])
@pytest.mark.parametrize("moved", [0, 17, 300, 599])
def test_uneven_times_have_exponentials_of_their_own(unit: float, moved: int) -> None:
    """Also where only one time is not in its place."""
    times = np.linspace(0.2, 0.8, 600) * unit
    times[moved] += 1e-6 * unit
    expected = np.exp(3j / unit * times)
    assert superposed((3j / unit,), np.array([[1], [-1j]]), times) == pytest.approx(
        np.array([expected.real, expected.imag]), abs=1e-15
    )


@pytest.mark.parametrize("name", POINTS)
@pytest.mark.parametrize("unit", [2.0**-20, 2.0**20])
def test_the_unit_of_time_does_not_matter(name: str, unit: float) -> None:
    """A power of two changes no digit: the points are exponents only with their times."""
    points = tuple(one / unit for one in POINTS[name])
    for one, other in zip(differences(POINTS[name], SETS, TIMES), differences(points, SETS, TIMES * unit), strict=True):
        assert np.array_equal(one, other)
