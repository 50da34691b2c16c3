"""Shares of the modes in the motion of a drive, against finite elements."""

import numpy as np
import pytest
from scipy.linalg import eigh
from support import chain_fem

from ptmcalc.laws import belt_modes, chain_resonance
from ptmcalc.laws.loop_bounds import LoopMasses


@pytest.mark.parametrize("fixed", [False, True])
def test_mobilities_are_those_of_finite_elements(fixed: bool) -> None:
    strands = chain_fem.Strand(20.0, 60.0, 2e7), chain_fem.Strand(20.0, 25.0, 2e7)
    loop = LoopMasses(500.0, 1200.0, 80.0, 900.0, 1e-6, 1e-6, fixed, False)
    mass, stiff = chain_fem.matrices(chain_fem.Chain(strands, 80.0), 400, lumped=True)
    mass[0, 0] += 900.0
    if fixed:
        join = np.eye(len(mass), len(mass) - 1)
        join[-1, 0] = 1.0
        mass, stiff = join.T @ mass @ join, join.T @ stiff @ join
    squares, shapes = eigh(stiff, mass, subset_by_index=[0, 6])
    w = belt_modes.natural_frequencies(loop, 0.0, 6)
    shares, rest = chain_resonance.drive_mobilities(loop, w)
    assert w == pytest.approx(np.sqrt(squares[1:]), rel=1e-3)
    assert shares == pytest.approx(shapes[0, 1:] ** 2, rel=5e-3, abs=1e-8)
    assert shares.sum() + rest == pytest.approx(1 / 900.0 - 1 / 2680.0)
