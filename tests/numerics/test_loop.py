"""What goes into a loop of two strands: energies, grids and windows by hand."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics import sagging, strand
from ptmcalc.numerics.loop import MOST_STEPS, Drive, Extreme, Grid, Loop, Strand, match, panelled, refined, steps_of

CARRY, BACK = Strand(700.0, 130.0, 3.1e7, 2.1e4, 9.3e4), Strand(640.0, 41.0, 2.2e7, 1.4e4, 2.1e4)
GOLDEN = (1 + math.sqrt(5)) / 2


def strain_energy(strand: Strand) -> float:
    """int S^2/(2 EA) dx of the tension that is linear along the strand."""
    rise = strand.static_end - strand.static_start
    return float(quad(lambda x: (strand.static_start + rise * x) ** 2, 0, 1)[0]) * strand.length / strand.stiffness / 2


@pytest.mark.parametrize("strand", [CARRY, BACK])
def test_a_strand_at_rest_holds_the_energy_of_its_tension(strand: Strand) -> None:
    assert strand.rest_energy == pytest.approx(strain_energy(strand), rel=1e-12)
    assert strand.transit == pytest.approx(strand.length * math.sqrt(strand.line_mass / strand.stiffness), rel=1e-15)
    assert strand.static(np.array([0.0, 0.3, 1.0])) == pytest.approx(
        [strand.static_start, 0.7 * strand.static_start + 0.3 * strand.static_end, strand.static_end], rel=1e-15
    )


def test_an_exchange_of_1e_8_of_the_tensions_is_rounding() -> None:
    loop = Loop(CARRY, BACK, 1.0, 0.0, fixed_length=False)
    least = 1e-16 * (strain_energy(CARRY) + strain_energy(BACK))
    assert loop.least_energy == pytest.approx(least, rel=1e-12, abs=0)
    assert loop.impedances == pytest.approx((math.sqrt(130.0 * 3.1e7), math.sqrt(41.0 * 2.2e7)), rel=1e-15)
    even = Loop(CARRY, BACK, 1.0, 0.0, fixed_length=False, impedance_jump=False)
    assert even.impedances == pytest.approx((math.sqrt(130.0 * 3.1e7),) * 2, rel=1e-15)


@pytest.mark.parametrize(
    ("window", "steps", "share"),
    [
        (0.07, 7, 1.0),
        (0.0705, 8, 0.05),
        (0.0699999, 7, 0.99999),
        (0.07000005, 8, 5e-6),
        (0.004, 1, 0.4),
        (0.07 * (1 + 1e-12), 7, 1.0),
    ],
)
def test_a_window_ends_within_its_last_step(window: float, steps: int, share: float) -> None:
    found = steps_of(window, Grid(0.01, 10, 10, 0.0))
    assert found[0] == steps
    assert found[1] == pytest.approx(share, abs=1e-9)


def test_too_many_steps_are_refused() -> None:
    grid = Grid(1e-3, 10, 10, 0.0)
    assert steps_of(MOST_STEPS * 1e-3, grid)[0] == MOST_STEPS
    with pytest.raises(NumericsError, match="steps"):
        steps_of((MOST_STEPS + 1) * 1e-3, grid)


def test_finer_grids_have_the_same_travel_times() -> None:
    grid = match(1.33243, 0.52475, 50, 1e-5)
    for other, times in ((refined(grid), 2), (panelled(grid, 6), 6)):
        assert (other.carry, other.back) == (times * grid.carry, times * grid.back)
        assert other.step == pytest.approx(grid.step / times, rel=1e-15)
    assert panelled(grid, 6).panel == 6


def test_the_mismatch_is_that_of_the_worse_strand() -> None:
    first, second = 1.0, math.pi
    for at_most in (7, 12, 20):
        grid = match(first, second, 5, 1e-9, at_most)
        off = max(abs(grid.carry * grid.step / first - 1), abs(grid.back * grid.step / second - 1))
        assert grid.mismatch == pytest.approx(off, rel=1e-9)
        for carry in range(5, at_most + 1):
            back = round(carry * second / first)
            step = (first + second) / (carry + back)
            assert grid.mismatch <= max(abs(carry * step / first - 1), abs(back * step / second - 1)) + 1e-15
    assert match(1.0, 1e-9, 5, 1.0).back == 1


@pytest.mark.parametrize("first", [0.7, 1.0])
@pytest.mark.parametrize(("ratio", "tolerance"), [(2**0.5, 1e-7), (GOLDEN, 1e-7), (0.3141, 1e-12), (GOLDEN, 0)])
def test_the_coarsest_grid_that_is_good_enough_is_found_however_late_it_comes(
    ratio: float, tolerance: float, first: float
) -> None:
    """The number of cells of the first strand, tried one after the other; the best one where none is good enough."""

    def off(carry: int) -> tuple[float, int]:
        back = max(round(carry * ratio), 1)
        step = first * (1 + ratio) / (carry + back)
        return max(abs(carry * step / first - 1), abs(back * step / (first * ratio) - 1)), back

    most = 12_000
    good = [carry for carry in range(5, most + 1) if off(carry)[0] <= tolerance]
    expected = good[0] if good else min(range(5, most + 1), key=lambda carry: off(carry)[0])
    assert expected > 500
    found = match(first, first * ratio, 5, tolerance, most)
    assert (found.carry, found.back) == (expected, off(expected)[1])
    if not good:  # one cell more than it may have would be better
        assert match(first, first * ratio, 5, tolerance, expected - 1).carry < expected


def test_an_extreme_misses_nothing_unless_it_says_so() -> None:
    assert Extreme(7.0, 2.0, 3.0).moved(400.0) == Extreme(7.0, 2.0, 403.0, 0.0)
    assert Extreme(7.0, 2.0, 3.0, 0.5).moved(400.0) == Extreme(7.0, 2.0, 403.0, 0.5)


@pytest.mark.parametrize(("share", "turned"), [(-1e-8, False), (-1e-4, True), (1e-4, False)])
@pytest.mark.parametrize("pull", [6e4, 6e7])
def test_a_belt_turns_back_where_it_goes_a_millionth_of_its_speed_that_way(
    share: float, turned: bool, pull: float
) -> None:
    """Pulled back by a little first and forward then, by both marches: the motion is linear in the pull."""
    carry, back = Strand(1000.0, 245.0, 138e6, 5e5, 5e5), Strand(1000.0, 39.2, 138e6, 5e5, 5e5)
    belt = Loop(carry, back, 45_120.0, 0.0, fixed_length=False)
    drive = Drive(force=lambda t: pull * np.where(t < 1.0, share, np.minimum(t - 1.0, 1.0)))
    straight = strand.march(belt, drive, 3.0, match(carry.transit, back.transit, 40, 2e-7, at_most=4000))
    sags = sagging.march(belt, drive, 3.0, sagging.grid_of(belt, 40))
    for motion in (straight, sags):
        early = float(np.abs(motion.belt_speed[motion.times < 1]).max()) / float(motion.belt_speed.max())
        assert 0.1 * abs(share) < early < 10 * abs(share)
        assert motion.reversed is turned
