"""On which side of 0 a guard goes on: signs of its first derivative that is more than rounding, in any unit."""

from dataclasses import dataclass, field

import numpy as np
import pytest

from ptmcalc.numerics.motion import Curve, Look, Motion

CHAIN = np.eye(4, k=1)
"""z_k' = z_(k+1): the k-th derivative of z_0 is z_k."""
GUARDS = np.array([[1.0, 0.0, 0.0, 0.0], [-1.0, 0.0, 0.0, 0.0], [0.5, 2.0, 0.0, 0.0]])


@dataclass
class Still:
    """As much of a system as a look asks for."""

    told: Motion
    own: int = 4
    scale: np.ndarray = field(default_factory=lambda: np.ones(4))

    def motion(self, mode: object) -> Motion:
        return self.told


def linear() -> Motion:
    return Motion(CHAIN, np.zeros((4, 0)), GUARDS, np.eye(4))


@pytest.mark.parametrize("size", [1e-30, 1e-9, 1.0, 1e25])
@pytest.mark.parametrize(
    ("state", "sides"),
    [
        ([0.3, 0.0, 0.0, 0.0], [1, -1, 1]),
        ([0.0, -0.3, 0.0, 0.0], [-1, 1, -1]),
        ([0.0, 0.0, 0.3, 0.0], [1, -1, 1]),
        ([0.0, 0.0, 0.0, -0.3], [-1, 1, -1]),
        ([-0.4, 0.1, 0.0, 0.0], [-1, 1, 1]),  # 0.5 z_0 + 2 z_1 = 0, its slope 0.5 z_1
        ([1e-17, 0.0, -0.3, 0.0], [1, -1, 1]),  # a small value is no rounding where nothing larger is added
        ([0.0, 0.0, 0.0, 0.0], [0, 0, 0]),
    ],
)
def test_the_first_derivative_that_is_not_0_decides(state: list[float], sides: list[int], size: float) -> None:
    assert Look(Still(linear()), size * np.array(state)).sides("any").tolist() == sides


def test_what_is_rounding_of_its_parts_does_not() -> None:
    """0.5 z_0 + 2 z_1 of parts of 0.2: 16 eps of them is nothing, 40 are something."""
    eps = float(np.finfo(float).eps)
    for ulps, side in ((3, 1), (30, -1)):
        state = np.array([-0.4, 0.1 - ulps * 0.2 * eps, 0.0, 0.0])
        assert Look(Still(linear()), state).sides("any")[2] == side


def test_what_is_dust_beside_the_largest_state_does_not() -> None:
    """In variables of like size: the first state is counted in millionths."""
    system = Still(linear(), scale=np.array([1e-6, 1.0, 1.0, 1.0]))
    for dust, side in ((0.3e-28, -1), (3e-28, 1)):
        assert Look(system, np.array([dust, 0.0, -1.0, 0.0])).sides("any")[0] == side


@pytest.mark.parametrize("size", [1e-12, 1.0, 1e12])
def test_a_curve_counts_with_its_tangent(size: float) -> None:
    """x'' = n(y) - 3 u, n the cube of x': a guard on x that starts at rest goes as n does, or as its slope."""
    cube = Curve(
        np.array([[0.0, 1.0, 0.0, 0.0]]),
        lambda y: size * (y[0] / size) ** 3,
        lambda y: 3 * (y[0] / size) ** 2,
        1.0,
        0.1,
    )
    rate = np.array([[0.0, 1.0, 0.0, 0.0], [0.0, 0.0, -3.0, 0.0], [0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0]])
    gain = np.array([[0.0], [1.0], [0.0], [0.0]])
    guards = np.array([[1.0, 0.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0, -1.0]])
    told = Motion(rate, gain, guards, np.eye(5)[:1], (cube,))
    for state, sides in (
        ([0.0, 2.0, 0.0, 0.0], [1, -1]),  # x' = 2; x' - n = 2 - 8
        ([0.0, 0.5, 0.0, 0.0], [1, 1]),
        ([0.0, -0.5, 0.0, 0.0], [-1, -1]),
        ([0.0, 0.0, 1.0, 0.0], [-1, -1]),  # x'' = -3
        ([0.0, 1.0, 1 / 3, 0.0], [1, 0]),  # n = 1 = 3 u: nothing moves
        ([0.0, 1.0, 0.1, 0.0], [1, -1]),  # x'' = 0.7, n' = 2.1
        ([0.0, 1.0, 0.9, 0.0], [1, 1]),
    ):
        assert Look(Still(told), size * np.array(state)).sides("any").tolist() == sides, state


@pytest.mark.parametrize("order", [0, 1, 2, 3, 4, 5])
@pytest.mark.parametrize("curved", [False, True])
def test_a_guard_may_rest_up_to_its_fourth_derivative(order: int, curved: bool) -> None:
    """A chain of six, and the same with a curve that is still at 0 and drives its last state."""
    rate, guard = np.eye(6, k=1), np.eye(6)[:1]
    told = Motion(rate, np.zeros((6, 0)), guard, guard)
    if curved:
        still = Curve(np.eye(6)[:1], lambda y: 0.0 * y[0], lambda y: 0.0, 1.0, 0.1)
        told = Motion(rate, np.eye(6)[:, -1:], np.array([[1.0, 0, 0, 0, 0, 0, 0]]), np.zeros((1, 7)), (still,))
    for sign in (1, -1):
        look = Look(Still(told, own=6, scale=np.ones(6)), sign * 0.7 * np.eye(6)[order])
        assert look.sides("any").tolist() == [sign]
