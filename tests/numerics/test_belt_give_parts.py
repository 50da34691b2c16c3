"""What nodes give, one at a time: work and length of a span in closed form, and what costs no more than it must."""

import math
from dataclasses import replace

import numpy as np
import pytest

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.belt.course import Course, Reach, lay_out
from ptmcalc.numerics.belt.give import Give, Rubber

EA, RHO, LENGTH = 1e7, 50.0, 100.0


def course_of(span: float, cells: int = 20, climb: float = 0.0, other: float | None = None) -> Course:
    back = replace(Reach.even(LENGTH, RHO, EA, climb=-climb), span=span)
    carry = replace(Reach.even(LENGTH, RHO, EA, climb=climb), span=span if other is None else other)
    return lay_out((back, carry), 1, cells)


def pulled(give: Give, course: Course, tensions: np.ndarray) -> float:
    """Draw all nodes through tensions of the waves on both sides; what they gave."""
    quiet, given = np.zeros(course.cells - 1), 0.0
    for tension in tensions:
        waves = np.full(course.cells - 1, float(tension))
        before, behind = give.pass_on(waves, waves, quiet, quiet)
        given += float((behind - before).sum()) * course.step
    return given


@pytest.mark.parametrize(("span", "first", "last"), [(900.0, 5e3, 50e3), (1.0, 100.0, 600.0), (900.0, 50e3, 5e3)])
def test_a_slow_pull_works_against_the_sag_and_loses_next_to_nothing(span: float, first: float, last: float) -> None:
    """e = -k/S^2: int S de = 2 k (1/S0 - 1/S1), and it gave e1 - e0. The lightest spans are spans too."""
    course = course_of(span)
    give = Give(course, None, EA)
    give.begin(np.full(course.cells - 1, first))
    assert give.lost == 0.0
    k, stored, length = span**2 / 24 * 2 * LENGTH, give.stored, give.length
    assert length == pytest.approx(-k / first**2, rel=1e-12)
    given = pulled(give, course, np.concatenate([np.linspace(first, last, 1000), np.full(200, last)]))
    work, longer = 2 * k * (1 / first - 1 / last), k * (1 / first**2 - 1 / last**2)
    assert given == pytest.approx(longer, rel=1e-4)
    assert give.length - length == pytest.approx(longer, rel=1e-4)
    assert give.stored - stored == pytest.approx(work, rel=1e-4)
    assert 0 <= give.lost < 1e-3 * abs(work)


def test_gravity_has_its_part_in_the_work_of_a_span() -> None:
    """A slow pull on a hill: what is passed on beside gravity does int (S - climb) de at every node."""
    course, first, last = course_of(900.0, climb=80.0), 20e3, 60e3
    give = Give(course, None, EA)
    give.begin(np.full(course.cells - 1, first))
    stored = give.stored
    pulled(give, course, np.concatenate([np.linspace(first, last, 1000), np.full(200, last)]))
    climb = course.climb[1:-1]
    halves = np.full(course.cells - 1, 1.0)
    tail = course.tail - 1
    halves[[0, -1, tail - 1, tail + 1]] = 1.5  # beside head and tail, whose own places give nothing
    halves[tail] = 0.0
    k = 900.0**2 / 24 * 2 * LENGTH / course.cells * halves
    low, high = first + climb, last + climb
    work = (2 * k * (1 / low - 1 / high) - climb * k * (1 / low**2 - 1 / high**2)).sum()
    assert give.stored - stored == pytest.approx(work, rel=1e-4)
    assert 0 <= give.lost < 1e-3 * work


@pytest.mark.parametrize("jump", [1.001, 1.1, 2.0, 8.0, 0.999, 0.9, 0.5, 0.125])
def test_a_step_loses_next_to_nothing_of_what_it_does(jump: float) -> None:
    """The mean tension 2/(1/S- + 1/S+) does exactly the work of a span. Without a front 2 % of what the end is above it
    are passed on besides and lost, whatever the change: so the equation of the step is solved to its digits."""
    course, first = course_of(900.0), 20e3
    give = Give(course, None, EA)
    give.begin(np.full(course.cells - 1, first))
    stored, length, k = give.stored, give.length, 900.0**2 / 24 * 2 * LENGTH
    pulled(give, course, np.array([first * jump]))
    work, longer = give.stored - stored, give.length - length
    reached = 1 / math.sqrt(1 / first**2 - longer / k)
    assert 0 < give.lost < 0.03 * abs(reached - work / longer) * abs(longer)


def test_energy_is_the_work_of_what_is_passed_on() -> None:
    """Tension times what a node gives, step by step, is what is stored and lost."""
    for rubber in (None, Rubber(0.3, 0.02)):
        course = course_of(900.0)
        give = Give(course, rubber, EA)
        give.begin(np.full(course.cells - 1, 20e3))
        rub, drag = np.full(course.cells - 1, 50.0), np.full(course.cells - 1, 7e3)
        rng = np.random.default_rng(4)
        work, start = 0.0, give.stored + give.lost
        for _ in range(40):
            into, out = rng.uniform(15e3, 40e3, (2, course.cells - 1))
            before, behind = give.pass_on(into, out, rub, drag)
            passed = out - give.after * behind
            rubs = np.where(before != 0, rub * np.sign(before), passed - into)  # friction is before what gives
            assert (np.abs(rubs) <= rub).all()
            assert passed == pytest.approx(into + (give.before + drag) * before + rubs, rel=1e-9)
            work += float(passed @ (behind - before)) * course.step
        assert give.stored + give.lost - start == pytest.approx(work, rel=1e-9)
        assert give.lost > 0


@pytest.mark.parametrize("tail", [1, 2, 3, 5, 10, 11])
def test_all_that_cells_would_give_is_given_beside_head_and_tail(tail: int) -> None:
    """Nothing at the tail, which has its own station; wherever it is, beside a strand of one cell too."""
    back = replace(Reach.even(5.0 * tail, RHO, EA), span=900.0)
    carry = replace(Reach.even(5.0 * (12 - tail), RHO, EA), span=300.0)
    course = lay_out((back, carry), 1, 12)
    assert (course.tail, course.cells) == (tail, 12)
    give = Give(course, Rubber(0.3, 0.02), EA)
    give.begin(np.full(11, 1e4))
    k = (900.0**2 * 5.0 * tail + 300.0**2 * 5.0 * (12 - tail)) / 24
    assert give.length == pytest.approx(60.0 * 1e4 * 0.3 / 1.3 / EA - k / 1e4**2, rel=1e-12)
    lengths = dict.fromkeys(range(1, 12), 0.0)
    for cell in range(12):
        inner = [node for node in (cell, cell + 1) if node not in (0, tail, 12)]
        beside = [2 if tail == 1 else 10]  # of a strand of one cell the next node of the other
        for node in (inner * 2)[:2] or beside * 2:
            lengths[node] += 2.5
    assert give.yields * EA / 0.3 * 1.3 == pytest.approx(list(lengths.values()), rel=1e-12)
    waves = np.full(11, 2e4)
    before, behind = give.pass_on(waves, waves, np.zeros(11), np.zeros(11))
    gives = behind - before
    assert gives[tail - 1] == 0.0
    assert (np.delete(gives, tail - 1) > 0).all()


def test_spans_that_hang_slack_at_the_start_are_refused_however_light_they_are() -> None:
    for span in (900.0, 0.3):
        give = Give(course_of(span), None, EA)
        with pytest.raises(NumericsError, match="slack"):
            give.begin(np.full(19, -1e-3))
        give.begin(np.full(19, 1e-3))
    give = Give(course_of(0.0), None, EA)
    give.begin(np.full(19, -1e3))  # what does not sag may be slack


def test_friction_that_is_not_overcome_holds_a_node_entirely() -> None:
    course = course_of(900.0)
    give = Give(course, Rubber(0.3, 0.02), EA)
    give.begin(np.full(19, 20e3))
    into, out, hold = np.full(19, 20e3), np.full(19, 20.5e3), np.full(19, 600.0)
    before, behind = give.pass_on(into, out, hold, np.zeros(19))
    assert (before == 0.0).all()
    assert (behind != 0.0).any()


def test_spans_in_a_front_are_damped_by_the_impedance_over_the_root_of_what_they_give() -> None:
    """q = Z/sqrt(f), f = dz/dS of the lump over that of its cell; a front is a jump over two nodes as large as the
    tension, what is smaller counts by its share, and beside head, tail and a belt that does not sag there is none."""
    course = course_of(900.0, cells=40, other=0.0)
    give = Give(course, None, EA)
    tension = np.full(39, 20e3)
    tension[8:] = 26e3
    tension[13:] = 90e3
    tension[30:] = 20e3
    give.begin(tension)
    share = np.zeros(39)
    share[[7, 8]] = 6e3 / 20e3, 6e3 / 26e3
    share[[12, 13]] = 1.0, 64e3 / 90e3
    k, z = 900.0**2 / 24 * LENGTH / 20, math.sqrt(EA * RHO)
    sags = np.where(np.arange(39) < 19, k, 0.0)
    more = 2 * sags / tension**3 / (LENGTH / 20 / EA)
    damping = np.divide(z * share, np.sqrt(more), out=np.zeros(39), where=more > 0)
    assert give.viscous[1:18] == pytest.approx(damping[1:18] * k / course.step, rel=1e-9)
    assert (give.viscous[18:] == 0.0).all()


def test_a_step_takes_few_rounds() -> None:
    """Two where nothing changes; with the slopes as they are, digits double from there on."""
    course = course_of(900.0)
    give = Give(course, Rubber(0.3, 0.02), EA)
    found = []
    for jump in (1.0, 1.01, 1.3, 0.7, 4.0, 0.25):
        give.begin(np.full(19, 20e3))
        pulled(give, course, np.array([20e3 * jump]))
        found.append(give.rounds)
    assert found[0] == 2
    assert all(one <= most for one, most in zip(found, (2, 3, 4, 4, 6, 5), strict=True)), found
