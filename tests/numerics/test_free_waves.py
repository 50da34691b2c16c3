"""How far the waves of a row of masses and springs can ever swing: no motion goes beyond, and some come as near to it
as one likes.

The motion is found without modes, by a leap-frog whose steps are a small part of the shortest period.
"""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest

from ptmcalc.numerics.free_waves import Row, swings

HELD = {"gravity": (-1,), "fixed": (0, -1), "inside": (3, -1)}
SPRINGS = 12
PERIODS = 16
"""Of the lowest mode."""


def _matrices(row: Row) -> tuple[np.ndarray, np.ndarray]:
    """Which masses are free, and the stiffness between all of them."""
    count = len(row.masses)
    free = np.ones(count, bool)
    free[list(row.held)] = False
    pulls = (np.eye(count)[1:] - np.eye(count)[:-1]) / np.sqrt(row.compliances)[:, None]
    return free, pulls.T @ pulls


def _energy_of_rates(row: Row) -> float:
    """Half the sums of m (v')^2 and S'^2 times the compliance."""
    free, _ = _matrices(row)
    stretch = np.diff(np.where(free, row.speeds, 0.0))
    forces = np.append(row.pulls, 0.0) - np.insert(row.pulls, 0, 0.0)
    rates = forces[free] ** 2 / row.masses[free]
    return float(rates.sum() + (stretch**2 / row.compliances).sum()) / 2


def _drawn(kind: str, seed: int, springs: int = SPRINGS) -> Row:
    """Masses and springs up to a factor of ten apart, in a smooth motion."""
    rng = np.random.default_rng((seed, sorted(HELD).index(kind)))
    masses, compliances = np.exp(rng.uniform(0, math.log(10), springs + 1)), np.exp(rng.uniform(-2, 0.3, springs))
    row = Row(masses, compliances, np.zeros(springs + 1), np.zeros(springs), HELD[kind], 0.0)
    free, _ = _matrices(row)
    x, y = np.arange(springs + 1) / springs, (np.arange(springs) + 0.5) / springs
    speeds = sum(rng.normal() * np.cos(k * math.pi * x + rng.uniform(0, 6)) / k for k in range(1, 4))
    pulls = sum(rng.normal() * np.sin(k * math.pi * y + rng.uniform(0, 6)) / k for k in range(1, 4))
    ends = sorted(at % (springs + 1) for at in HELD[kind])
    for first, last in itertools.pairwise(ends):  # what they hold between them keeps its length
        part = slice(first, last)
        pulls[part] -= pulls[part] @ compliances[part] / compliances[part].sum()
    row = replace(row, speeds=np.where(free, speeds, 0.0), pulls=np.asarray(pulls))
    return replace(row, rate_energy=_energy_of_rates(row))


def _moved(row: Row, periods: float = PERIODS, share: float = 0.04) -> np.ndarray:
    """Pulls over a long time, times by springs: each step moves the speeds by the pulls, then these by the speeds."""
    free, stiffness = _matrices(row)
    squares = np.linalg.eigvalsh(stiffness[np.ix_(free, free)] / np.sqrt(np.outer(row.masses[free], row.masses[free])))
    step = share / math.sqrt(squares[-1])
    count = math.ceil(periods * 2 * math.pi / math.sqrt(squares[0]) / step)
    speeds, pulls = row.speeds.copy(), row.pulls.copy()
    given = np.where(free, step / row.masses, 0.0)
    seen = np.empty((count, len(pulls)))
    padded = np.zeros(len(pulls) + 2)

    def kick(part: float) -> None:
        padded[1:-1] = pulls
        speeds[:] += part * given * np.diff(padded)

    kick(0.5)
    for k in range(count):
        seen[k] = pulls
        pulls += step * np.diff(speeds) / row.compliances
        kick(1.0)
    return seen


@pytest.mark.parametrize("kind", HELD)
@pytest.mark.parametrize("seed", range(3))
def test_no_pull_and_no_sum_of_pulls_ever_goes_beyond(kind: str, seed: int) -> None:
    """The steps shift every frequency by a few millionths and amplitudes by as much."""
    row = _drawn(kind, seed)
    found, seen = swings(row), _moved(row)
    assert found.rest <= 1e-6 * found.pulls.max()
    assert np.all(np.abs(seen).max(axis=0) <= found.pulls * (1 + 1e-3))
    assert np.all(np.abs(seen).max(axis=0) >= found.pulls / 3)
    rng = np.random.default_rng(seed)
    for _ in range(5):
        one, other = rng.choice(SPRINGS, 2, replace=False).tolist()
        weights = {one: float(rng.normal()), other: float(rng.normal())}
        together = sum(weight * seen[:, spring] for spring, weight in weights.items())
        most = found.together(weights)
        assert np.abs(together).max() <= most * (1 + 1e-3)
        assert most <= sum(abs(weight) * found.pulls[spring] for spring, weight in weights.items()) * (1 + 1e-12)


@pytest.mark.parametrize("kind", HELD)
def test_no_mass_strays_farther_than_its_way(kind: str) -> None:
    row = _drawn(kind, 7)
    seen = _moved(row)
    places = np.zeros((len(seen), len(row.masses)))
    places[:, 1:] = np.cumsum(seen * row.compliances, axis=1)
    places -= places[:, [-1]]
    assert np.all(np.abs(places).max(axis=0) <= swings(row).ways * (1 + 1e-3) + 1e-9)


@pytest.mark.parametrize("kind", HELD)
@pytest.mark.parametrize("moving", [False, True])
def test_one_mode_alone_comes_to_its_bound(kind: str, moving: bool) -> None:
    """Of the lowest mode, from rest or from a row without pulls."""
    row = _drawn(kind, 3)
    free, stiffness = _matrices(row)
    scale = 1 / np.sqrt(row.masses[free])
    _, shapes = np.linalg.eigh(stiffness[np.ix_(free, free)] * np.outer(scale, scale))
    shape = np.zeros(len(row.masses))
    shape[free] = shapes[:, 0] * scale
    none = np.zeros_like
    row = replace(row, speeds=shape if moving else none(shape))
    row = replace(row, pulls=none(row.pulls) if moving else np.diff(shape) / row.compliances)
    row = replace(row, rate_energy=_energy_of_rates(row))
    seen, found = _moved(row, 2.0), swings(row)
    assert np.abs(seen).max(axis=0) == pytest.approx(found.pulls, rel=1e-3, abs=1e-6 * float(found.pulls.max()))
    one, other = np.argsort(found.pulls)[-2:].tolist()
    apart = np.abs(seen[:, one] - 0.4 * seen[:, other]).max()
    assert apart == pytest.approx(found.together({one: 1.0, other: -0.4}), rel=1e-3)


def _smooth(springs: int) -> Row:
    """A uniform belt whose end is stopped while all of it accelerates as one body, in so many springs."""
    masses = np.full(springs + 1, 1.0 / springs)
    masses[[0, -1]] /= 2
    y = (np.arange(springs) + 0.5) / springs
    return Row(masses, np.full(springs, 1.0 / springs), np.zeros(springs + 1), y, (-1,), 0.5)


def test_a_coarse_row_still_holds_the_waves_it_cannot_see() -> None:
    """The pull rises evenly to the held end, as under one acceleration: its modes meet there at once and come to 1.
    What a coarse row leaves out its rest makes up."""
    fine = swings(_smooth(400)).pulls
    assert fine[-1] == pytest.approx(1.0, rel=0.02)
    for springs in (4, 8, 16, 32):
        coarse = swings(_smooth(springs))
        at = ((np.arange(springs) + 0.5) / springs * 400).astype(int)
        assert np.all(coarse.pulls >= fine[at] * (1 - 0.02)), springs
        assert coarse.rest <= 1.0


def test_a_row_at_rest_stays_so() -> None:
    row = replace(_drawn("gravity", 1), rate_energy=0.0)
    found = swings(replace(row, speeds=0 * row.speeds, pulls=0 * row.pulls))
    assert np.all(found.pulls == 0)
    assert np.all(found.ways == 0)
    assert found.together({0: 1.0, 5: -2.0}) == 0
