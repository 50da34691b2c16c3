"""Reaches cut into cells: what acts along a belt is neither lost nor moved, and waves keep their time."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ptmcalc.numerics.belt.course import Course, Reach, lay_out

EA = 138e6


def reach_of(length: float, line_mass: float, shares: list[float], sums: tuple[list[float], ...]) -> Reach:
    """A reach with marks at shares of its length, and sums of friction, drag and climb there."""
    marks = np.concatenate([[0.0], np.sort(shares) * length, [length]])
    friction, drag, climb = (np.concatenate([[0.0], np.cumsum(steps)]) for steps in sums)
    return Reach(line_mass, EA, marks, friction, drag, climb)


@st.composite
def reaches(draw: st.DrawFn) -> tuple[Reach, ...]:
    found = []
    for _ in range(draw(st.integers(2, 5))):
        marks = draw(st.integers(0, 3))
        shares = draw(st.lists(st.floats(0.05, 0.95), min_size=marks, max_size=marks, unique=True))
        step = st.floats(0.0, 1e4)
        sums = tuple(draw(st.lists(part, min_size=marks + 1, max_size=marks + 1)) for part in (step, step))
        climbs = draw(st.lists(st.floats(-1e5, 1e5), min_size=marks + 1, max_size=marks + 1))
        length, line_mass = draw(st.floats(50.0, 3000.0)), draw(st.floats(10.0, 800.0))
        found.append(reach_of(length, line_mass, shares, (*sums, climbs)))
    return tuple(found)


def counts(course: Course, given_reaches: tuple[Reach, ...]) -> list[int]:
    """Cells of every reach, by where their middles are."""
    ends = np.cumsum([0.0, *(reach.length for reach in given_reaches)])
    return np.histogram(course.middles, ends)[0].tolist()


@given(reaches(), st.integers(2, 200), st.data())
def test_sums_along_the_belt_are_kept(belt: tuple[Reach, ...], cells: int, data: st.DataObject) -> None:
    after = data.draw(st.integers(1, len(belt) - 1))
    course = lay_out(belt, after, cells)
    assert course.friction.sum() == pytest.approx(sum(reach.friction[-1] for reach in belt), rel=1e-12, abs=1e-9)
    assert course.drag.sum() == pytest.approx(sum(reach.drag[-1] for reach in belt), rel=1e-12, abs=1e-9)
    assert course.climb[0] == 0.0
    assert course.climb[-1] == pytest.approx(sum(reach.climb[-1] for reach in belt), rel=1e-9, abs=1e-6)
    assert course.places[-1] == pytest.approx(sum(reach.length for reach in belt), rel=1e-12)
    assert course.places[course.tail] == pytest.approx(sum(reach.length for reach in belt[:after]), rel=1e-12)
    assert (np.diff(course.places) > 0).all()
    assert course.middles == pytest.approx((course.places[1:] + course.places[:-1]) / 2)
    assert (course.friction >= 0).all()
    assert (course.drag >= 0).all()
    assert len(course.places) == course.cells + 1 == len(course.before) == len(course.after)


@given(reaches(), st.integers(2, 200))
def test_every_wave_takes_its_time_to_within_half_a_step(belt: tuple[Reach, ...], cells: int) -> None:
    course = lay_out(belt, 1, cells)
    whole = sum(reach.transit for reach in belt)
    assert course.step * course.cells == pytest.approx(whole, rel=1e-12)
    each = counts(course, belt)
    assert sum(each) == course.cells
    assert min(each) >= 1
    off = [abs(n * course.step / reach.transit - 1) for n, reach in zip(each, belt, strict=True)]
    assert course.mismatch == pytest.approx(max(off), rel=1e-9, abs=1e-12)
    if all(n > 1 for n in each):
        late = max(abs(n * course.step - reach.transit) for n, reach in zip(each, belt, strict=True))
        assert late <= (0.5 + len(belt) / 2 / course.cells * max(each)) * course.step


@given(reaches(), st.integers(2, 100))
def test_impedances_on_either_side_of_a_node(belt: tuple[Reach, ...], cells: int) -> None:
    course = lay_out(belt, 1, cells)
    assert (course.before[1:] == course.cell_impedance).all()
    assert (course.after[:-1] == course.cell_impedance).all()
    assert course.before[course.tail] == belt[0].impedance
    assert course.after[course.tail] == belt[1].impedance
    for reach in belt:
        assert reach.impedance == pytest.approx(math.sqrt(reach.line_mass * EA), rel=1e-14)
        assert reach.transit == pytest.approx(reach.length / math.sqrt(EA / reach.line_mass), rel=1e-14)


def test_a_node_has_the_friction_of_half_a_cell_to_either_side() -> None:
    """Marks inside a cell: 100 N over the first 30 m of 100 m, 700 N over the rest, in cells of 25 m."""
    one = Reach(50.0, EA, np.array([0.0, 30.0, 100.0]), np.array([0.0, 100.0, 800.0]), np.zeros(3), np.zeros(3))
    two = Reach.even(100.0, 50.0, EA, 4.0)
    course = lay_out((one, two), 1, 8)
    assert course.cells == 8
    first = 12.5 * 100 / 30
    second = 17.5 * 100 / 30 + 7.5 * 10
    assert course.friction[:2] == pytest.approx([first, second])
    assert course.friction[2:4] == pytest.approx([250.0, 250.0])
    assert course.friction[4] == pytest.approx(125.0 + 50.0)
    assert course.friction[5:] == pytest.approx([100.0, 100.0, 100.0, 50.0])


def test_gravity_is_read_at_nodes_and_in_the_middle_of_cells() -> None:
    """Down 10 N/m, then up 30 N/m with the rise in its second half only."""
    down = Reach.even(100.0, 50.0, EA, climb=-10.0)
    up = Reach(50.0, EA, np.array([0.0, 50.0, 100.0]), np.zeros(3), np.zeros(3), np.array([0.0, 0.0, 1500.0]))
    course = lay_out((down, up), 1, 8)
    assert course.climb == pytest.approx([0, -250, -500, -750, -1000, -1000, -1000, -250, 500])
    assert course.climb_within == pytest.approx([-125, -375, -625, -875, -1000, -1000, -625, 125])


def test_an_even_reach_has_the_same_all_along() -> None:
    reach = Reach.even(200.0, 50.0, EA, 3.0, -7.0)
    assert reach.length == 200.0
    assert np.interp(80.0, reach.marks, reach.friction) == 240.0
    assert np.interp(80.0, reach.marks, reach.climb) == -560.0
    assert (reach.drag == 0).all()


def test_every_reach_has_a_cell_however_few_are_wanted() -> None:
    belt = (Reach.even(1000.0, 38.0, EA), Reach.even(10.0, 245.0, EA, 60.0), Reach.even(990.0, 245.0, EA, 60.0))
    course = lay_out(belt, 1, 1)
    assert counts(course, belt) == [1, 1, 1]
    assert course.tail == 1
    assert course.friction.sum() == pytest.approx(60_000.0)


def test_more_cells_never_fit_worse_by_much() -> None:
    """Of the counts up to a quarter more than wanted, the best: travel times of BW-02 to 2e-5 with 400 cells."""
    belt = (Reach.even(1000.0, 38.0, EA), Reach.even(1000.0, 245.0, EA))
    assert lay_out(belt, 1, 400).mismatch < 2e-5
    for cells in (50, 100, 200, 400, 800):
        course = lay_out(belt, 1, cells)
        assert cells - 1 <= course.cells <= 1.25 * cells + 2
        assert course.mismatch < 0.5 / cells


@pytest.mark.parametrize(
    ("cells", "lengths", "taken"),
    [(8, (3.0, 7.0), 10), (8, (4.0, 7.0), 8), (2, (1.0, 3.0), 3)],
    ids=["a quarter more fits exactly", "what would fit is beyond a quarter", "one more at least is looked at"],
)
def test_of_all_counts_up_to_a_quarter_more_the_best_is_taken(
    cells: int, lengths: tuple[float, float], taken: int
) -> None:
    course = lay_out((Reach.even(lengths[0], 50.0, EA), Reach.even(lengths[1], 50.0, EA)), 1, cells)
    assert course.cells == taken
    assert (course.mismatch < 1e-12) is (taken == 10)


def test_spans_and_what_goes_with_the_belt_are_those_of_each_reach() -> None:
    """(w l)^2 h/24 of a cell, by its own length h; a straight belt has none of the first and goes with all its mass."""
    one, two = Reach.even(90.0, 40.0, EA), Reach.even(60.0, 160.0, EA)
    course = lay_out((replace(one, span=700.0, goes=0.75), replace(two, span=1900.0, goes=0.5)), 1, 20)
    cells = np.diff(course.places)
    here = course.middles < 90.0
    assert course.sag == pytest.approx(np.where(here, 700.0, 1900.0) ** 2 * cells / 24, rel=1e-12)
    assert course.goes.tolist() == np.where(here, 0.75, 0.5).tolist()
    plain = lay_out((one, two), 1, 20)
    assert (plain.sag == 0.0).all()
    assert (plain.goes == 1.0).all()
    assert one.marks[0] == 0.0
