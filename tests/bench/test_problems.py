"""P1 to P6 of the performance study: what our kinds call beside RK45, DOP853, LSODA, Radau and BDF in one run.

`OPENBLAS_NUM_THREADS=1 python -m pytest tests/bench/test_problems.py --benchmark-enable -s -n 0 -m study` prints the
table of the README as markdown. Counts are the gates, here and in the benches of each problem.
"""

import math

import pytest
from support import problem_belts as belts
from support import problems
from support.peers import COLUMNS, METHODS, peer, ratio, rows, table
from support.peers import Ours as Found
from support.problems import PROBLEMS

from ptmcalc.numerics import glide


@pytest.mark.parametrize(
    ("name", "error"),
    [("P1", 1e-12), ("P3", 1e-12), ("P4 two masses", 1e-12), ("P4 beam", 1e-9), ("P5", 1e-5), ("P6", 1e-13)],
)
def test_ours_is_as_exact_as_it_says(name: str, error: float) -> None:
    problem = PROBLEMS[name]
    assert min(problem.error(work()) for _, work in problem.settings) <= error


def test_a_belt_with_friction_comes_to_a_thousandth() -> None:
    """Read where its grid has nodes: between two of them no reading shows where a front stands."""
    assert belts.P2.error(belts.P2.ours(350).run_on) <= 1e-3


@pytest.mark.parametrize(
    ("name", "method", "evaluations"),
    [
        ("P4 two masses", "DOP853", 3_000),
        ("P4 two masses", "LSODA", 1_000),
        ("P6", "DOP853", 1_000),
        ("P6", "BDF", 500),
    ],
)
def test_a_peer_agrees_and_evaluates_the_rates_so_often(name: str, method: str, evaluations: int) -> None:
    """The truth is ours, or that of extended precision: what a solver of another hand comes to is near it."""
    found = peer(PROBLEMS[name], method)
    assert found.error <= PROBLEMS[name].asked
    assert found.evaluations >= evaluations


def test_peers_begin_again_at_every_tooth() -> None:
    """25 teeth: each costs a solver a first step and all its stages."""
    found = problems.teeth_of_peer("DOP853", 1e-7, passes=25)
    expected = problems.teeth_exactly(problems.BESIDE, 25)
    assert abs(found.answer - expected).max() <= 1e-6 * abs(expected).max()
    assert found.evaluations >= 25 * 100


def test_the_beam_stays_within_its_work(monkeypatch: pytest.MonkeyPatch) -> None:
    """However fast its twentieth mode swings: once that has faded, panels are as long as the slowest allows, and tried
    nine times from one contact to the next."""
    tried: list[float] = []
    bands = glide.Glide.bands
    monkeypatch.setattr(glide.Glide, "bands", lambda self, *given: tried.append(given[0]) or bands(self, *given))
    course = problems.play(problems.beam(), problems.BEAM_END)
    assert len(tried) <= 300
    assert len(course.record.events) == 32
    assert course.system.w[-1] * problems.BEAM_END > 2e5
    assert course.record.steps <= 2_700
    assert course.residual < 1e-9


def test_a_ratio_is_that_of_the_cheapest_setting_which_is_no_less_accurate() -> None:
    own = [Found("coarse", 1e-2, 1.0), Found("fine", 1e-4, 10.0), Found("finest", 1e-6, 100.0)]
    found = peer(PROBLEMS["P6"], "RK45")
    assert ratio(found, [Found("exact", 0.0, found.units / 7)]) == pytest.approx(7)
    near = type(found)("RK45", 1e-3, 30.0, 1)
    assert ratio(near, own) == pytest.approx(3.0)
    assert ratio(type(found)("RK45", 1e-9, 30.0, 1), own) is None
    assert ratio(type(found)("RK45", math.inf, math.inf, 0), own) is None


def test_the_table_has_a_cell_for_every_peer() -> None:
    made = rows(PROBLEMS["P6"], repeats=1)
    assert len(made[-1]) == len(COLUMNS)
    assert all("times at" in cell for cell in made[-1][-len(METHODS) :])
    assert table(made).count("\n") == 1 + len(made)


@pytest.mark.study
def test_table_of_all_problems(request: pytest.FixtureRequest) -> None:
    timed = bool(request.config.getoption("--benchmark-enable", default=False))
    chosen = PROBLEMS.values() if timed else (problems.P4A, problems.P6)
    made = [row for problem in chosen for row in rows(problem)]
    print("", table(made), sep="\n")
    assert len(made) == sum(len(problem.settings) for problem in chosen)
