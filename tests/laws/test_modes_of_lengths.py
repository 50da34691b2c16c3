"""Natural frequencies of belts with lengths of different mass, against lumped masses and against uniform strands."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import eigh

from ptmcalc.laws import belt_modes
from ptmcalc.laws.loop_bounds import LoopMasses

ELEMENTS = 80
CASES = [
    (fixed, imposed, weight)
    for fixed, imposed, weight in itertools.product((False, True), (False, True), (0.0, 6000.0))
    if not (fixed and weight)
]


def drawn(index: int) -> tuple[LoopMasses, list[np.ndarray]]:
    rng = np.random.default_rng((31, index))
    parts = [rng.uniform(*ends, int(rng.integers(1, 5))) for ends in ((2e3, 2e4), (2e3, 6e4))]
    compliances = [rng.uniform(2e-6, 3e-5, len(masses)) for masses in parts]
    loop = LoopMasses(
        float(parts[0].sum()),
        float(parts[1].sum()),
        float(rng.uniform(100, 3e3)),
        float(rng.uniform(2e3, 2e4)),
        float(compliances[0].sum()),
        float(compliances[1].sum()),
        False,
        False,
    )
    return loop, [parts[0], compliances[0], parts[1], compliances[1]]


def lumped(loop: LoopMasses, columns: list[np.ndarray], weight: float, count: int) -> np.ndarray:
    masses = np.concatenate([np.repeat(columns[k] / ELEMENTS, ELEMENTS) for k in (0, 2)])
    stiffs = np.concatenate([np.repeat(ELEMENTS / columns[k], ELEMENTS) for k in (1, 3)])
    nodes, tail = len(masses) + 1, len(columns[0]) * ELEMENTS
    mass, stiff = np.zeros((nodes, nodes)), np.zeros((nodes, nodes))
    for k, (m, s) in enumerate(zip(masses, stiffs, strict=True)):
        mass[[k, k + 1], [k, k + 1]] += m / 2
        stiff[k : k + 2, k : k + 2] += s * np.array([[1, -1], [-1, 1]])
    mass[tail, tail] += loop.tail_mass
    mass[-1, -1] += loop.drive_mass
    ends = np.ix_([0, -1], [0, -1])
    mass[ends] += weight / 4 * np.array([[1, -1], [-1, 1]])
    keep = np.eye(nodes)
    if loop.fixed_length:
        keep[0, 0], keep[0, -1] = 0.0, 1.0
        keep = keep[:, 1:]
    if loop.imposed_speed:
        keep = keep[:, :-1]
    first = 0 if loop.imposed_speed else 1
    squares = eigh(keep.T @ stiff @ keep, keep.T @ mass @ keep, eigvals_only=True, subset_by_index=[0, count])
    return np.sqrt(np.abs(squares))[first : first + count]


@pytest.mark.parametrize(("fixed", "imposed", "weight"), CASES)
@pytest.mark.parametrize("index", range(3))
def test_frequencies_are_those_of_lumped_masses(index: int, fixed: bool, imposed: bool, weight: float) -> None:
    loop, columns = drawn(index)
    loop = replace(loop, fixed_length=fixed, imposed_speed=imposed)
    found = belt_modes.natural_frequencies_of_lengths(loop, *columns, weight, 3)
    assert found == pytest.approx(lumped(loop, columns, weight, 3), rel=1e-3)


@pytest.mark.parametrize(("fixed", "imposed", "weight"), CASES)
def test_lengths_of_a_uniform_strand_have_its_frequencies(fixed: bool, imposed: bool, weight: float) -> None:
    loop, _ = drawn(7)
    loop = replace(loop, fixed_length=fixed, imposed_speed=imposed)
    shares = np.array([0.2, 0.5, 0.3])
    columns = [
        shares * whole for whole in (loop.return_mass, loop.return_compliance, loop.carry_mass, loop.carry_compliance)
    ]
    found = belt_modes.natural_frequencies_of_lengths(loop, *columns, weight, 4)
    assert found == pytest.approx(belt_modes.natural_frequencies(loop, weight, 4), rel=1e-11)
