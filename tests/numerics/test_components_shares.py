"""What finds a component in a state and who sees it: against the motion itself, taken apart by hand.

Reference: scipy's exponential, and modes that are known without an eigenvalue solver.
"""

import math

import numpy as np
import pytest
from scipy.linalg import expm

from ptmcalc.numerics.components import components

APART = np.array([-3.0, -70.0, 0.0])


def two_decays(effect: tuple[float, float] = (2.0, -5.0), input_rate: float = -0.5) -> np.ndarray:
    """x' = -3 x + 4 y + 2 u, y' = -70 y - 5 u, u' = -0.5 u: y moves by itself, x is stirred by both."""
    return np.array([[-3.0, 4.0, effect[0]], [0.0, -70.0, effect[1]], [0.0, 0.0, input_rate]])


class TestDecays:
    ROWS = np.array([[1.0, 0.0, 0.0], [0.3, -2.0, 7.0]])

    def test_amplitudes_fade_each_at_its_own_rate(self) -> None:
        """a_k(exp(A t) z) = exp(lambda_k t) a_k(z), with an input along."""
        rate = two_decays()
        found = components(rate, self.ROWS, 2)
        states = np.random.default_rng(3).normal(size=(5, 3))
        later = states @ expm(0.02 * rate).T
        assert found.amplitudes(later) == pytest.approx(
            found.amplitudes(states) * np.exp(0.02 * found.values), rel=1e-12, abs=1e-13
        )
        assert sorted(found.values.real) == pytest.approx([-70.0, -3.0])
        assert found.posed.all()

    def test_shapes_put_a_motion_of_its_own_together_again(self) -> None:
        """Without an input what the rows see is the sum of amplitudes times shapes."""
        found = components(two_decays(), self.ROWS, 2)
        for state in (np.array([1.0, 0.0, 0.0]), np.array([-0.4, 2.0, 0.0])):
            assert (found.amplitudes(state) @ found.shapes).real == pytest.approx(self.ROWS @ state, rel=1e-12)

    def test_a_wave_is_one_of_two_conjugates_and_seen_as_both(self) -> None:
        """x'' + 2 d w x' + w^2 x = 0 beside a decay: x and x' at any time, by the closed form."""
        w, d = 24.0, 0.1
        damped = w * math.sqrt(1 - d * d)
        rate = np.array([[0.0, 1.0, 0.0], [-w * w, -2 * d * w, 0.0], [0.0, 0.0, -3.0]])
        found = components(rate, np.eye(3), 3)
        assert sorted(found.values.tolist(), key=abs) == pytest.approx([-3.0, complex(-d * w, damped)])
        assert found.sights == pytest.approx(np.abs(found.shapes))
        state = np.array([0.3, -2.0, 5.0])
        for t in (0.0, 0.05, 0.4):
            a, b = 0.3, (-2.0 + d * w * 0.3) / damped
            x = math.exp(-d * w * t) * (a * math.cos(damped * t) + b * math.sin(damped * t))
            seen = (found.amplitudes(state) * np.exp(found.values * t) @ found.shapes).real
            assert seen[[0, 2]] == pytest.approx([x, 5 * math.exp(-3 * t)], rel=1e-12)

    def test_what_an_input_holds_up_is_no_component(self) -> None:
        """Moving with the input alone, x = a u, y = b u with (-0.5 + 70) b = -5 and (-0.5 + 3) a = 4 b + 2."""
        b = -5 / 69.5
        a = (4 * b + 2) / 2.5
        found = components(two_decays(), self.ROWS, 2)
        assert found.amplitudes(np.array([a, b, 1.0])).tolist() == [0.0, 0.0]
        assert np.abs(found.amplitudes(np.array([a, b, 1.001]))).min() > 1e-6

    def test_rounding_of_what_adds_up_is_none(self) -> None:
        """64 last digits of what a share adds up: less is set to 0, a little more is not."""
        found = components(np.array([[-3.0, 0.0], [0.0, -70.0]]), np.eye(2), 2)
        mixed = components(np.array([[-3.0, 67.0], [0.0, -70.0]]), np.eye(2), 2)  # x + y, and y
        slow = int(np.argmin(mixed.speeds))
        eps = np.finfo(float).eps
        for digits, there in ((60, False), (68, True)):
            amplitude = mixed.amplitudes(np.array([1.0, -1.0 + 2 * digits * eps]))[slow]
            assert (amplitude != 0) == there
        assert np.abs(found.amplitudes(np.array([1.0, 1e-15]))).min() > 0, "each by itself keeps the smallest"


class TestSpan:
    @pytest.mark.parametrize("share", [0.9, 1.1])
    @pytest.mark.parametrize("faded", [1e-11, 1e-3])
    def test_is_of_what_is_seen_above_a_share(self, faded: float, share: float) -> None:
        """A row sees both alike; beside the slow one the fast one counts from a share of all that adds up there."""
        found = components(np.diag([-3.0, -70.0]), np.array([[1.0, 1.0]]), 2)
        state = np.array([1.0, share * faded])
        assert found.span(state, faded, np.zeros(0)) == (3.0, 70.0 if share > 1 else 3.0)
        assert found.span(state[::-1], faded, np.zeros(0)) == (3.0 if share > 1 else 70.0, 70.0)

    @pytest.mark.parametrize("share", [0.9, 1.1])
    def test_sizes_stand_for_signals_that_were_larger_before(self, share: float) -> None:
        """The sizes are those of the last rows; a guard before them keeps its own."""
        found = components(np.diag([-3.0, -70.0]), np.array([[1.0, 0.0], [0.0, 1.0]]), 2)
        state = np.array([1.0, share * 1e-3])
        assert found.span(state, 1e-3, np.array([1.0]))[1] == (70.0 if share > 1 else 3.0)
        assert found.span(state, 1e-3, np.array([1e-9]))[1] == 70.0
        assert found.span(state, 1e-3, np.array([2000.0, 1.0]))[0] == (70.0 if share > 1 else math.inf)

    def test_of_nothing(self) -> None:
        found = components(np.diag([-3.0, -70.0]), np.eye(2), 2)
        assert found.span(np.zeros(2), 1e-11, np.zeros(0)) == (math.inf, 0.0)
        none = components(np.zeros((1, 1)), np.ones((1, 1)), 0)
        assert none.span(np.ones(1), 1e-11, np.zeros(0)) == (math.inf, 0.0)


@pytest.mark.parametrize(("distance", "posed"), [(0.9e-6, False), (1.1e-6, True)])
def test_how_near_vectors_and_inputs_may_come(distance: float, posed: bool) -> None:
    near = components(np.array([[-3.0, 1.0], [0.0, -3.0 - distance]]), np.eye(2), 2)
    assert near.posed.tolist() == [posed, posed]
    driven = components(np.array([[-3.0, 1.0], [0.0, -3.0 * (1 + distance)]]), np.eye(2), 1)
    assert driven.posed.tolist() == [posed]
    slow = components(np.diag([-3.0, -3.0 * distance]), np.eye(2), 2)
    assert slow.posed.tolist() == [True, posed], "one that hardly moves beside the fastest is as one that stands"


def test_a_free_mass_is_always_there() -> None:
    """x'' = 0 beside an oscillator of 24 rad/s: not posed, seen in any state, its speed 0 no slowest one."""
    rate = np.zeros((4, 4))
    rate[0, 1], rate[2, 3], rate[3, 2] = 1.0, 1.0, -576.0
    found = components(rate, np.eye(4), 4)
    assert sorted(found.posed) == [False, False, True]
    assert found.span(np.array([0.0, 0.0, 1.0, 0.0]), 1e-11, np.zeros(0)) == pytest.approx((24.0, 24.0))
    assert found.span(np.array([1.0, 0.0, 0.0, 0.0]), 1e-11, np.zeros(0)) == (math.inf, 0.0)


def test_oscillators_of_one_frequency_are_not_told_apart() -> None:
    rate = np.zeros((4, 4))
    rate[0, 1], rate[2, 3], rate[1, 0], rate[3, 2] = 1.0, 1.0, -576.0, -576.0
    found = components(rate, np.eye(4), 4)
    for state in (np.array([1.0, 0.0, 0.5, 0.0]), np.array([0.0, 0.0, 0.5, 3.0])):
        assert found.span(state, 1e-11, np.zeros(0)) == pytest.approx((24.0, 24.0))


@pytest.mark.parametrize("unit", [1e-15, 1e15])
def test_the_unit_of_time_does_not_matter(unit: float) -> None:
    """Two decays and a free swing in another unit: the same shares, each as fast in its own unit."""
    rate = np.zeros((4, 4))
    rate[:2, :2], rate[2, 3], rate[3, 2] = [[-3.0, 4.0], [0.0, -70.0]], 24.0, -24.0
    one, other = components(rate, np.eye(4), 4), components(unit * rate, np.eye(4), 4)
    assert other.posed.all()
    state = np.array([1.0, 0.3, 1e-5, 0.0])
    for faded in (1e-12, 1e-3):
        slowest, fastest = one.span(state, faded, np.zeros(0))
        assert other.span(state, faded, np.zeros(0)) == pytest.approx((unit * slowest, unit * fastest))
