"""The root of a guard between a place above 0 and one below it, and how often the guard is looked at for it."""

import math
from collections.abc import Callable
from itertools import pairwise

import pytest

from ptmcalc.numerics.pendulum.guards import _bracketed

FALLING: dict[str, tuple[Callable[[float], float], float]] = {
    "a line": (lambda x: 0.3 - x, 0.3),
    "a corner": (lambda x: 0.3 - x if x < 0.3 else 2 * (0.3 - x), 0.3),
    "the corner the other way": (lambda x: 2 * (0.3 - x) if x < 0.3 else 0.3 - x, 0.3),
    "a steep end": (lambda x: 0.5 - x**8, 0.5**0.125),
    "a steep beginning": (lambda x: (1 - x) ** 8 - 0.5, 1 - 0.5**0.125),
    "a root early": (lambda x: math.exp(-40 * x) - 0.7, -math.log(0.7) / 40),
}


@pytest.mark.parametrize("name", FALLING)
@pytest.mark.parametrize("size", [1e-6, 1.0, 1e6])
def test_is_met_to_the_noise_in_few_looks(name: str, size: float) -> None:
    function, root = FALLING[name]
    looks = []

    def value(x: float) -> float:
        looks.append(x)
        return size * function(x)

    found = _bracketed(value, 0.0, 1.0, 1e-13 * size)
    assert abs(function(found)) <= 1e-13
    assert found == pytest.approx(root, abs=1e-11)
    assert len(looks) <= (3 if name == "a line" else 16)


@pytest.mark.parametrize("ratio", [1e-8, 1e-5, 0.1, 7.0, 1e3, 1e5, 1e8])
@pytest.mark.parametrize("root", [0.1, 0.377, 0.9])
def test_a_corner_at_the_root_is_met_however_sharp(ratio: float, root: float) -> None:
    """To rounding of the place, where nothing is noise; 14 looks of false position at most, 52 halvings, both ends."""
    looks = []

    def value(x: float) -> float:
        looks.append(x)
        return (root - x) * (1 if x < root else ratio)

    assert _bracketed(value, 0.0, 1.0, 0.0) == pytest.approx(root, abs=2.3e-16)
    assert len(looks) <= 2 + 14 + 52


@pytest.mark.parametrize("jump", [0.2, 0.77])
def test_what_jumps_over_zero_ends_right_of_the_jump(jump: float) -> None:
    """Steps of false position towards either end gain next to nothing first: then the bracket is halved to its end."""
    looks = []

    def value(x: float) -> float:
        looks.append(x)
        return 1.0 if x < jump else -1e-3

    assert jump <= _bracketed(value, 0.0, 1.0, 1e-12) <= jump + 2.3e-16
    halves = looks[16:]
    assert looks[15] != pytest.approx(looks[13] / 2 + looks[14] / 2)
    assert len(halves) <= 52
    apart = [abs(after - before) for before, after in pairwise(halves)]
    assert [a / b for a, b in pairwise(apart)][:30] == pytest.approx([2.0] * 30)
