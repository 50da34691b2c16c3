"""The root of a guard between a place above 0 and one below it, and how often the guard is looked at for it."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import pytest

from ptmcalc.numerics.pendulum import guards as module
from ptmcalc.numerics.pendulum.guards import Guards, _bracketed
from ptmcalc.numerics.pendulum.track import PLACES

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


@dataclass(frozen=True)
class Given(Guards):
    """Guards of which the second is a function of the share of a step; it counts how often it is looked at."""

    function: Callable[[np.ndarray], np.ndarray]
    looks: list[float]

    def values(self, leg: object, time: np.ndarray, z: np.ndarray) -> tuple[list[str], np.ndarray]:
        self.looks.extend(z.tolist())
        return ["other", "this"], np.stack([1 + 0 * z, self.function(z)])


class Share:
    """A step whose states are its shares."""

    leg, start, length = None, 3.0, 0.5

    def looked_at(self) -> np.ndarray:
        return PLACES

    def states(self, places: np.ndarray) -> np.ndarray:
        return places


def polished(function: Callable[[np.ndarray], np.ndarray], share: float, noise: float) -> tuple[float, int]:
    guards = Given(1.0, 1.0, 1.0, 1.0, 1, function, [])
    found = guards._polished(Share(), 1, share, function(PLACES), noise)  # type: ignore[arg-type]
    return found, len(guards.looks)


SIZES = pytest.mark.parametrize("size", [1e-9, 1.0, 1e9])


@SIZES
@pytest.mark.parametrize("off", [0.0, 8e-6, -8e-6])
def test_a_root_nearly_right_is_made_exact_by_secants(size: float, off: float) -> None:
    root = math.log(2.0)
    found, looks = polished(lambda x: size * (2.0 - np.exp(x)), root + off, 1e-13 * size)
    assert found == pytest.approx(root, abs=1e-13)
    assert looks <= 6
    assert polished(lambda x: size * (-1e-20 - x), 0.0, 1e-13 * size) == (0.0, 0), "at the very start nothing is left"


@SIZES
@pytest.mark.parametrize("root", [0.31, 0.83])
def test_the_first_root_of_a_step_is_told_nearly_right_in_either_half(
    size: float, root: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A smooth guard needs no bracket: what the panel says is a share of the step, and some secants end it."""
    monkeypatch.setattr(module, "_bracketed", None)
    guards = Given(size, size, size, size, 1, lambda x: size * (math.exp(root) - np.exp(x)), [])
    share, name = guards.first(Share()) or (None, None)  # type: ignore[arg-type]
    assert name == "this"
    assert share == pytest.approx(root, abs=1e-13)


@SIZES
@pytest.mark.parametrize("root", [0.3, 0.62])
@pytest.mark.parametrize("off", [1e-3, -1e-3, 3e-5])
def test_a_root_on_a_corner_that_the_panel_misplaces_is_found_between_its_places(
    size: float, root: float, off: float
) -> None:
    found, _ = polished(lambda x: size * np.where(x < root, root - x, 50 * (root - x)), root + off, 1e-13 * size)
    assert found == pytest.approx(root, abs=1e-12)


@SIZES
def test_without_a_place_above_0_before_one_below_what_the_panel_says_stays(size: float) -> None:
    """A guard below 0 from the start, and one that is nowhere below by more than rounding."""
    for function in (lambda x: -size * (1 + x), lambda x: size * (0.0 * x - 1e-15)):
        found, _ = polished(function, 0.4, 1e-13 * size)
        assert found == pytest.approx(0.4, abs=2e-5)
