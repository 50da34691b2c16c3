"""Strands whose ends move alike, against finite elements, sums over all modes and numbers worked out by hand."""

import math

import numpy as np
import pytest
from scipy.linalg import eigh
from support.held_fem import Bar, moved_by_ends, on_one_shaft, profile

from ptmcalc.laws import held_strands
from ptmcalc.laws.held_strands import HeldStrands
from ptmcalc.laws.loop_bounds import CARRY, RETURN

BACK, WORKING = Bar(30.0, 25.0, 6e7, 0.0), Bar(30.0, 100.0, 6e7, 0.0)
X = np.linspace(0.0, 1.0, 9)
FIXED = pytest.mark.parametrize("fixed", [False, True])
STRANDS = pytest.mark.parametrize("strand", [RETURN, CARRY])


def held(fixed: bool, drive: float | None = None) -> HeldStrands:
    """The strands above, a tail of 80 kg, and the speed imposed or a drive of a mass."""
    return HeldStrands(750.0, 3000.0, 80.0, drive or 0.0, 30 / 6e7, 30 / 6e7, fixed, drive is None)


def test_by_hand() -> None:
    """3 t of working strand at 1 m/s^2: 1.5 kN more where it enters, 1.5 kN less where it begins.

    The return strand of a gravity take-up: 750 N where it enters the tail. c = (6e7/100)^(1/2) = 774.6 m/s and
    w = pi c/30 m.
    """
    one = held(False)
    assert held_strands.quasi_static(one, CARRY, [0.0, 0.5, 1.0]).tolist() == [-1500.0, 0.0, 1500.0]
    assert held_strands.quasi_static(one, RETURN, [0.0, 1.0]).tolist() == [0.0, 750.0]
    assert held_strands.stray(one, CARRY, [0.0, 0.5, 1.0]).tolist() == [1500.0, 0.0, 1500.0]
    assert held_strands.lowest_frequency(one) == pytest.approx(81.12, rel=1e-4)
    assert held_strands.natural_frequencies(one, 1)[0] == pytest.approx(81.12, rel=1e-4)


@FIXED
@STRANDS
def test_modes_sum_up_to_what_is_known_without_them(fixed: bool, strand: int) -> None:
    one = held(fixed)
    w = held_strands.natural_frequencies(one, 6000)
    tensions, shapes = held_strands.modal_tensions(one, w, strand, X), held_strands.modal_shapes(one, w, strand, X)
    mass = one.mass_of(strand)
    assert tensions.sum(axis=0) == pytest.approx(held_strands.quasi_static(one, strand, X), abs=1e-3 * mass)
    green = (shapes**2).sum(axis=0) / one.belt_mass
    assert green == pytest.approx(held_strands.tension_green(one, strand, X), abs=1e-3 * mass)
    assert np.all(np.abs(tensions).sum(axis=0) <= held_strands.stray(one, strand, X) * (1 + 1e-9) + 1e-9 * mass)


@FIXED
@STRANDS
@pytest.mark.parametrize("count", [1, 2, 7, 30])
def test_the_rest_holds_all_modes_left_out(fixed: bool, strand: int, count: int) -> None:
    one = held(fixed)
    w = held_strands.natural_frequencies(one, 6000)
    left = np.abs(held_strands.modal_tensions(one, w, strand, X)[count:]).sum(axis=0)
    assert np.all(left <= held_strands.modal_rest(one, w[:count], strand, X) * (1 + 1e-9) + 1e-6)


@FIXED
def test_frequencies_are_those_of_finite_elements(fixed: bool) -> None:
    found = []
    for bar, free in ((BACK, not fixed), (WORKING, False)):
        mass, stiff = bar.matrices(300)
        inner = slice(0 if free else 1, 300)
        found += np.sqrt(eigh(stiff[inner, inner], mass[inner, inner], eigvals_only=True)[:8]).tolist()
    assert held_strands.natural_frequencies(held(fixed), 8) == pytest.approx(np.sort(found)[:8], rel=1e-4)


@FIXED
@pytest.mark.parametrize("sprockets", [400.0, 4000.0])
def test_modes_of_coupled_sprockets_are_those_of_finite_elements(fixed: bool, sprockets: float) -> None:
    """Frequencies and tensions of all modes that move the sprockets."""
    one, pieces = held(fixed, sprockets - 80.0), 200
    count = pieces + 1
    mass, stiff = np.zeros((2 * count, 2 * count)), np.zeros((2 * count, 2 * count))
    for k, bar in enumerate((BACK, WORKING)):
        part = slice(k * count, (k + 1) * count)
        mass[part, part], stiff[part, part] = bar.matrices(pieces)
    coupled = [pieces, count, 2 * count - 1] + ([0] if fixed else [])
    alone = [k for k in range(2 * count) if k not in coupled]
    gather = np.zeros((2 * count, len(alone) + 1))
    gather[alone, range(len(alone))] = 1
    gather[coupled, -1] = 1
    whole = gather.T @ mass @ gather
    whole[-1, -1] += sprockets
    squares, shapes = eigh(gather.T @ stiff @ gather, whole, subset_by_index=[1, 16])
    moves = np.abs(shapes[-1]) > 1e-2 * np.abs(shapes[-1]).max()
    w = held_strands.natural_frequencies(one, 5)
    assert w == pytest.approx(np.sqrt(squares[moves])[:5], rel=1e-3)
    assert held_strands.lowest_frequency(one) <= w[0]
    for strand, bar in ((RETURN, BACK), (CARRY, WORKING)):
        nodes = (gather @ shapes[:, moves])[strand * count : (strand + 1) * count]
        stretched = np.diff(nodes, axis=0) * bar.stiffness * pieces / bar.length
        middles = (np.arange(pieces) + 0.5) / pieces
        parts = one.total_mass * shapes[-1][moves] * stretched / squares[moves]
        found = held_strands.modal_tensions(one, w, strand, middles)
        assert found == pytest.approx(parts[:, :5].T, abs=5e-3 * one.mass_of(strand))


@FIXED
@STRANDS
@pytest.mark.parametrize("count", [1, 7, 30])
def test_modes_of_coupled_sprockets_sum_up_and_their_rest_is_held(fixed: bool, strand: int, count: int) -> None:
    one = held(fixed, 2000.0)
    w = held_strands.natural_frequencies(one, 6000)
    tensions = held_strands.modal_tensions(one, w, strand, X)
    assert tensions.sum(axis=0) == pytest.approx(
        held_strands.quasi_static(one, strand, X), abs=2e-3 * one.mass_of(strand)
    )
    left = np.abs(tensions[count:]).sum(axis=0)
    assert np.all(left <= held_strands.modal_rest(one, w[:count], strand, X) * (1 + 1e-9) + 1e-6)
    assert np.all(np.abs(tensions).sum(axis=0) <= held_strands.stray(one, strand, X) * (1 + 1e-9) + 1e-6)


@FIXED
def test_a_step_of_acceleration_strays_by_the_bound_at_most_and_reaches_it_at_the_ends(fixed: bool) -> None:
    one, times = held(fixed), np.arange(0.0, 1.0, 2e-4)
    moved = tuple(part[:, None] for part in profile("ramp", 10.0, 10.0, times))
    for strand, bar in ((RETURN, BACK), (CARRY, WORKING)):
        free = one.free_end(strand)
        found = moved_by_ends(bar, 40, 2e-4, None if free else moved, moved)[:, :, 0]
        at = np.concatenate([[0.0], (np.arange(40) + 0.5) / 40, [1.0]])
        off = np.abs(found - held_strands.quasi_static(one, strand, at)).max(axis=0)
        bound = held_strands.stray(one, strand, at)
        assert np.all(off <= bound + 0.03 * bar.length * bar.line_mass)
        assert off[-1] == pytest.approx(bound[-1], rel=0.05)


@FIXED
@pytest.mark.parametrize("sprockets", [400.0, 4000.0, 40000.0])
def test_a_step_of_force_on_coupled_sprockets_strays_by_the_bound_at_most(fixed: bool, sprockets: float) -> None:
    one, whole = held(fixed, sprockets - 80.0), sprockets + 3750.0
    assert one.total_mass == pytest.approx(whole)
    found = on_one_shaft((BACK, WORKING), not fixed, sprockets, 40, 2e-4, np.full(6000, whole))
    at = np.concatenate([[0.0], (np.arange(40) + 0.5) / 40, [1.0]])
    for strand, part in ((RETURN, found[0]), (CARRY, found[1])):
        off = np.abs(part - held_strands.quasi_static(one, strand, at)).max(axis=0)
        bound = held_strands.stray(one, strand, at)
        assert np.all(off <= bound + 0.03 * one.mass_of(strand) * math.sqrt(whole / sprockets))
        if strand == CARRY and sprockets > 10 * 3750.0:  # as if their speed were imposed
            assert off[-1] >= 0.8 * bound[-1]


# -- coupled sprockets and moved ends ---------------------------------------------------------------------------------


def elements(one: HeldStrands, bars: tuple[Bar, Bar], pieces: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Mass and stiffness of strands on sprockets that are one mass, and where their nodes are gathered."""
    count = pieces + 1
    mass, stiff = np.zeros((2 * count, 2 * count)), np.zeros((2 * count, 2 * count))
    for k, bar in enumerate(bars):
        part = slice(k * count, (k + 1) * count)
        mass[part, part], stiff[part, part] = bar.matrices(pieces)
    coupled = [pieces, count, 2 * count - 1] + ([0] if one.fixed_length else [])
    alone = [k for k in range(2 * count) if k not in coupled]
    gather = np.zeros((2 * count, len(alone) + 1))
    gather[alone, range(len(alone))] = 1
    gather[coupled, -1] = 1
    whole = gather.T @ mass @ gather
    whole[-1, -1] += one.tail_mass + one.drive_mass
    return whole, gather.T @ stiff @ gather, gather


PAIRS = pytest.mark.parametrize("bars", [(BACK, WORKING), (WORKING, WORKING)])


def of_bars(bars: tuple[Bar, Bar], fixed: bool, sprockets: float) -> HeldStrands:
    masses, springs = ([one.length * one.line_mass for one in bars], [one.length / one.stiffness for one in bars])
    return HeldStrands(*masses, 80.0, sprockets - 80.0, *springs, fixed, False)


@FIXED
@PAIRS
@pytest.mark.parametrize("sprockets", [400.0, 4000.0])
def test_all_modes_of_coupled_sprockets_are_those_of_finite_elements(
    fixed: bool, bars: tuple[Bar, Bar], sprockets: float
) -> None:
    """Frequencies, mobilities, and the products of tensions B_k(s) B_k(r), whose sums over equal frequencies do not
    depend on the choice of the modes."""
    one, pieces, modes = of_bars(bars, fixed, sprockets), 120, 8
    whole, stiff, gather = elements(one, bars, pieces)
    squares, shapes = eigh(stiff, whole, subset_by_index=[1, modes])
    w = held_strands.all_frequencies(one, modes)
    assert w == pytest.approx(np.sqrt(squares), rel=2e-3)
    places, stretched, found = (np.arange(pieces) + 0.5) / pieces, [], []
    for strand, bar in ((RETURN, bars[0]), (CARRY, bars[1])):
        nodes = (gather @ shapes)[strand * (pieces + 1) : (strand + 1) * (pieces + 1)]
        stretched.append(np.diff(nodes, axis=0) * bar.stiffness * pieces / bar.length / squares)
        found.append(held_strands.modal_shapes(one, w, strand, places).T / math.sqrt(one.belt_mass))
    felt, known = np.concatenate(found), np.concatenate(stretched)
    groups = np.split(np.arange(modes), np.flatnonzero(np.diff(w) > 1e-3 * w[:-1]) + 1)
    for group in groups[:-1]:  # the last one may continue
        assert felt[:, group] @ felt[:, group].T == pytest.approx(
            known[:, group] @ known[:, group].T, abs=1e-2 * one.belt_mass
        )
    shares, rest = held_strands.drive_mobilities(one, held_strands.natural_frequencies(one, 3))
    moved = shapes[-1][np.abs(shapes[-1]) > 1e-2 * np.abs(shapes[-1]).max()] ** 2
    assert shares[: len(moved)] == pytest.approx(moved[:3], rel=1e-2)
    assert rest == pytest.approx(1 / sprockets - 1 / one.total_mass - shares.sum(), rel=1e-9)


@FIXED
@STRANDS
@PAIRS
def test_all_modes_of_coupled_sprockets_sum_up_to_the_green_function(
    fixed: bool, strand: int, bars: tuple[Bar, Bar]
) -> None:
    one = of_bars(bars, fixed, 2000.0)
    shapes = held_strands.modal_shapes(one, held_strands.all_frequencies(one, 3000), strand, X)
    green = (shapes**2).sum(axis=0) / one.belt_mass
    assert green == pytest.approx(held_strands.tension_green(one, strand, X), abs=1e-3 * one.mass_of(strand))


@FIXED
@STRANDS
def test_the_energy_of_accelerations_bounds_the_tension(fixed: bool, strand: int) -> None:
    """Random sums of modes that move the sprockets; close to the bound for the field that reaches it."""
    one, rng = of_bars((BACK, Bar(30.0, 60.0, 6e7, 0.0)), fixed, 2000.0), np.random.default_rng(3)
    w = held_strands.natural_frequencies(one, 400)
    shares, _ = held_strands.drive_mobilities(one, w)
    gains = held_strands.modal_tensions(one, w, strand, X) / one.total_mass  # tension per d_k
    bound = held_strands.swung_mass(one, strand, X)
    for _ in range(50):
        d = rng.normal(size=400) / np.arange(1, 401)
        rigid = float(rng.normal())
        twice = one.total_mass * rigid**2 + float(shares @ d**2)
        swung = rigid * held_strands.quasi_static(one, strand, X) + d @ gains
        assert np.all(swung**2 <= twice * bound * (1 + 1e-9) + 1e-9)
    best = one.total_mass * (held_strands.quasi_static(one, strand, X) / one.total_mass) ** 2
    best = best + np.sum(gains**2 / shares[:, None], axis=0)
    assert best == pytest.approx(bound, abs=2e-3 * one.mass_of(strand))
