"""A fork pushed against the rack, or caught by it: the motions integrated, with random masses and springs."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from ptmcalc.laws import fork

SEEDS = range(12)


def peak(
    mass: float, speed: float, stiffness: float, preload: float, drive: "tuple[float, float]", end: float
) -> float:
    """Largest force of a spring that a driven mass stretches: m x'' = P - h x' - (Q + K x), until it first stands."""
    force, slope = drive

    def rate(_: float, y: np.ndarray) -> list[float]:
        return [y[1], (force + slope * (speed - y[1]) - preload - stiffness * y[0]) / mass]

    def stands(_: float, y: np.ndarray) -> float:
        return float(y[1])

    stands.terminal, stands.direction = True, -1  # type: ignore[attr-defined]
    run = solve_ivp(rate, (0, end), [0.0, speed], method="DOP853", rtol=1e-11, atol=1e-14, events=stands)
    return preload + stiffness * float(run.y[0].max())


@pytest.mark.parametrize("seed", SEEDS)
def test_a_push_or_a_catch_by_a_constant_force(seed: int) -> None:
    rng = np.random.default_rng(seed)
    mass, stiffness, speed = 10 ** rng.uniform(2, 4), 10 ** rng.uniform(5, 7), rng.uniform(0.05, 0.6)
    weight, force = rng.uniform(0, 3e4), rng.uniform(3e4, 6e4)
    end = 10 * math.sqrt(mass / stiffness)
    pushed = peak(mass, speed, stiffness, 0.0, (force, 0.0), end)
    assert fork.push_force(force, stiffness, mass, speed) == pytest.approx(pushed, rel=1e-9)
    caught = peak(mass, speed, stiffness, weight, (force, 0.0), end)
    assert fork.caught_force(force, weight, stiffness, mass, speed) == pytest.approx(caught, rel=1e-9)


@pytest.mark.parametrize("share", [1e-9, 0.01, 0.2, 0.5, 0.9, 0.999])
def test_a_soft_motor(share: float) -> None:
    mass, stiffness, speed, weight = 9000.0, 9e5, 0.3, 15696.0
    slope = 2 * share * math.sqrt(stiffness * mass)
    expected = peak(mass, speed, stiffness, weight, (weight, slope), 300 * math.sqrt(mass / stiffness))
    found = fork.soft_caught_force(weight, stiffness, mass, speed, slope)
    assert found == pytest.approx(expected, rel=1e-9)
    assert found >= fork.stall_force(weight, slope, speed)
    assert fork.slope_number(slope, stiffness, mass) == pytest.approx(share)


def test_a_very_soft_motor_only_stalls() -> None:
    slope = 2.5 * math.sqrt(9e5 * 9000.0)
    assert fork.soft_caught_force(15696.0, 9e5, 9000.0, 0.3, slope) == fork.stall_force(15696.0, slope, 0.3)
    limits = [fork.soft_caught_force(15696.0, 9e5, 9000.0, 0.3, 2 * z * math.sqrt(9e5 * 9000.0)) for z in (1 - 1e-9, 1)]
    assert limits[0] == pytest.approx(limits[1], rel=1e-8)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_slipping_clutch(seed: int) -> None:
    """A motor of constant speed pushes through a clutch that gives way: mass behind it in two phases."""
    rng = np.random.default_rng(seed)
    mass, stiffness, speed, slips = 10 ** rng.uniform(1, 3), 10 ** rng.uniform(5, 7), rng.uniform(0.05, 0.6), 4e3
    way = slips / stiffness

    def rate(_: float, y: np.ndarray) -> list[float]:
        return [y[1], (slips - stiffness * y[0]) / mass]

    run = solve_ivp(rate, (0, 7 * math.sqrt(mass / stiffness)), [way, speed], rtol=1e-11, atol=1e-13, method="DOP853",
                    dense_output=True)  # fmt: skip
    times = np.linspace(0, run.t[-1], 200001)
    expected = stiffness * float(run.sol(times)[0].max())
    assert fork.clutch_push(slips, stiffness, mass, speed) == pytest.approx(expected, rel=1e-8)


class TwoMasses:
    """A drive s on a spring to a carriage w, which leans on another spring; one-sided where it says so."""

    def __init__(self, seed: int) -> None:
        rng = np.random.default_rng(seed)
        self.drive, self.carriage = 10 ** rng.uniform(2.5, 4), 10 ** rng.uniform(2, 3.6)
        self.stiffness, self.behind = 10 ** rng.uniform(5, 6.5), 10 ** rng.uniform(5, 7)
        self.speed, self.weight = rng.uniform(0.05, 0.6), rng.uniform(5e3, 3e4)
        self.force = self.weight * rng.uniform(1, 2.5)
        self.end = 40 * max(math.sqrt(self.drive / self.stiffness), math.sqrt(self.carriage / self.behind))

    def largest(self, caught: bool) -> tuple[float, float]:
        """Largest forces of both springs."""
        weight, start = (self.weight, self.speed) if caught else (0.0, 0.0)

        def forces(y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            first = np.maximum(weight + self.stiffness * (y[0] - y[1]), 0.0)
            second = self.behind * (np.maximum(y[1], 0.0) if caught else y[1])
            return first, second

        def rate(_: float, y: np.ndarray) -> list[float]:
            first, second = forces(y)
            return [y[2], y[3], float(self.force - first) / self.drive, float(first - weight - second) / self.carriage]

        run = solve_ivp(rate, (0, self.end), [0, 0, self.speed, start], rtol=1e-8, atol=1e-10, max_step=self.end / 2000)
        first, second = forces(run.y)
        return float(first.max()), float(second.max())


@pytest.mark.parametrize("seed", SEEDS)
def test_bounds_of_a_caught_fork(seed: int) -> None:
    one = TwoMasses(seed)
    rope, rack = one.largest(caught=True)
    given = (one.force, one.weight, one.stiffness, one.behind, one.drive, one.carriage, one.speed)
    assert rope <= fork.caught_bound(*given)
    assert rack <= fork.rack_bound(*given)
    assert rope > fork.caught_bound(*given) / 3  # not a bound that says nothing


@pytest.mark.parametrize("seed", SEEDS)
def test_bound_of_a_push(seed: int) -> None:
    one = TwoMasses(seed)
    bound = fork.push_bound(one.force, one.stiffness, one.behind, one.drive, one.speed)
    pushed = one.largest(caught=False)[0]
    assert bound / 3 < pushed <= bound
    least = fork.push_least(one.force, one.stiffness, one.behind, one.drive, one.carriage, one.speed)
    if least > one.force:  # the balance of energy it stands on
        ratio, share = one.drive / one.carriage, one.stiffness / one.behind
        lost = 4 * share * least * (least - one.force)
        if ratio > 1 - one.force / least:
            lost = share * (least * (1 + ratio) - one.force) ** 2 / ratio
        left = least * (least - 2 * one.force) + lost
        assert left == pytest.approx(one.stiffness * one.drive * one.speed**2, rel=1e-6, abs=1e-9 * least**2)
    assert one.force <= least <= pushed * (1 + 1e-6)


def test_limits_of_the_bounds() -> None:
    """A rigid rack and a carriage without mass: the closed form; nothing gives way behind a fork: the same."""
    closed = fork.caught_force(2e4, 1.5e4, 9e5, 9e3, 0.3)
    assert fork.caught_bound(2e4, 1.5e4, 9e5, math.inf, 9e3, 0.0, 0.3) == pytest.approx(closed, rel=1e-14)
    held = 5e3 + math.hypot(5e3, 0.3 * math.sqrt(7e5 * (9e3 + 4e3)))  # a stiff rope: 5 kN and all masses on the rack
    assert fork.rack_bound(2e4, 1.5e4, math.inf, 7e5, 9e3, 4e3, 0.3) == pytest.approx(held, rel=1e-14)
    pushed = fork.push_force(4e3, 5e5, 300.0, 0.4)
    assert fork.push_bound(4e3, 5e5, math.inf, 300.0, 0.4) == pytest.approx(pushed, rel=1e-14)
    for carriage in (10.0, 1e4):
        assert fork.push_least(4e3, 5e5, math.inf, 300.0, carriage, 0.4) == pytest.approx(pushed, rel=1e-14)


def test_catching_number() -> None:
    assert fork.catching_number(15696.0, 15696.0, 9e5, 9000.0, 0.3) == pytest.approx(1.72018, rel=1e-5)
    assert fork.catching_number(2.2 * 15696.0, 15696.0, 9e5, 9000.0, 1e-3) == pytest.approx(1.2, rel=1e-12)
