"""The root of a guard between a place above 0 and one below it, and how often the guard is looked at for it."""

import math
from collections.abc import Callable

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


def test_what_jumps_over_zero_ends_right_of_the_jump() -> None:
    for jump in (0.2, 0.77):
        found = _bracketed(lambda x, jump=jump: 1.0 if x < jump else -1.0, 0.0, 1.0, 1e-12)
        assert jump <= found <= jump + 1e-9
