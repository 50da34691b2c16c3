"""Observed order of the discretised belts against the echo series, a closed form without grid or modes."""

from itertools import pairwise

import numpy as np
import pytest
from support import echoes

from ptmcalc.numerics import loop, sagging, strand

FORCE, WINDOW = 60_000.0, 9.0
CARRY = loop.Strand(1000.0, 245.0, 138e6, 5e5, 5e5)
RETURN = loop.Strand(1000.0, 0.16 * 245.0, 138e6, 5e5, 5e5)  # 0.4 of the travel time: both fit one grid
BELT = loop.Loop(CARRY, RETURN, 45_120.0, 0.0, fixed_length=False)


def _errors(march: object, grids: list[loop.Grid]) -> list[float]:
    """Largest error of the run-on tension over the whole window, per grid."""
    drive = loop.Drive(force=lambda t: np.full_like(t, FORCE))
    z = BELT.impedances
    found = []
    for grid in grids:
        motion = march(BELT, drive, WINDOW, grid)  # type: ignore[operator]
        exact = echoes.run_on(FORCE, z, BELT.drum_mass, (CARRY.transit, RETURN.transit), motion.times)
        found.append(float(np.abs(motion.run_on - 5e5 - exact).max()))
    return found


def _orders(errors: list[float]) -> list[float]:
    return [float(np.log2(one / other)) for one, other in pairwise(errors)]


def test_characteristics_are_of_second_order_through_every_echo() -> None:
    grid = loop.match(CARRY.transit, RETURN.transit, 40, 2e-7, at_most=4000)
    grids = [grid, loop.refined(grid), loop.refined(loop.refined(grid))]
    errors = _errors(strand.march, grids)
    assert errors[-1] < 5e-4 * FORCE
    assert _orders(errors) == pytest.approx([2.0, 2.0], abs=0.15)


def test_the_staggered_grid_converges_through_corners_at_first_order_or_better() -> None:
    """Corners of the solution travel between the nodes of a grid whose wave speed depends on the tension."""
    grids = [sagging.grid_of(BELT, cells) for cells in (50, 100, 200)]
    errors = _errors(sagging.march, grids)
    assert errors[-1] < 0.02 * FORCE
    assert min(_orders(errors)) > 0.9


def test_the_waves_of_a_straight_belt_are_the_same_by_both() -> None:
    """What leaves drum, tail, tail and run-off, on a loop of one length and on one with a take-up."""
    drive = loop.Drive(force=lambda t: FORCE * np.minimum(t / 1.5, 1.0))
    for belt in (BELT, loop.Loop(CARRY, RETURN, 45_120.0, 3000.0, fixed_length=True)):
        grid = loop.match(CARRY.transit, RETURN.transit, 40, 2e-7, at_most=4000)
        exact, rough = strand.march(belt, drive, 6.0, grid), sagging.march(belt, drive, 6.0, sagging.grid_of(belt, 60))
        for one, other in zip(exact.waves, rough.waves, strict=True):
            assert np.abs(np.interp(exact.times, rough.times, other) - one).max() < 0.03 * FORCE
            assert np.abs(one).max() > 0.3 * FORCE
