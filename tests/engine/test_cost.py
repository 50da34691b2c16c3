"""What accuracy costs: settings measured with a clock of the test's own, errors only against another method."""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import count
from typing import Any

import pytest
from support.toy_kind import KIND
from support.toys import KN, Log, effect, kind_of, loaded, pull, solver

from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import ANYTHING, Estimate, Interval
from ptmcalc.base.memory import forgotten_with, remembered
from ptmcalc.base.units import FORCE
from ptmcalc.contract.cost import CostReport, Held, LoadCost, Outcome, Role, Setting
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.result import Finding, Found, LoadInfo, Result
from ptmcalc.contract.solver import Fidelity
from ptmcalc.engine.cost import MARGINS, MOST_RUNS, cost

FORMULA = {"fidelity": Fidelity.FORMULA}


def ticking(step: float = 1e-3) -> Callable[[], float]:
    """A clock that goes on by a step whenever it is read."""
    times = count()
    return lambda: step * next(times)


def costs(kind: AnyKind, *, budget: float = 100.0, step: float = 1e-3, **data: Any) -> CostReport:
    made = loaded(kind, **data)
    assert made.spec is not None
    return cost("toy.yaml", kind, made.spec, budget=budget, clock=ticking(step))


def row(found: CostReport, name: str) -> Setting:
    return next(one for one in found.settings if one.name == name)


def only_load(one: Setting) -> LoadCost:
    (load,) = one.loads
    return load


def within(low: float, high: float, **parts: Any) -> Any:
    return solver(parts.pop("name", "coarse"), pull(low, high), **parts)


# -- what is measured ------------------------------------------------------------------------------------------------


def test_every_setting_of_every_solver_is_a_row() -> None:
    kind = kind_of(
        solver("one", pull(8), carries=("wind",), levels=3), solver("two", pull(8)), effects=[effect("wind")]
    )
    names = [one.name for one in costs(kind).settings]
    assert sorted(names) == ["one 0", "one 1", "one 2", "two 0"]


def test_sets_of_effects_of_one_solver_are_told_apart() -> None:
    """With the effects the scene calls for, and with all that the solver can carry."""
    kind = kind_of(
        solver("one", pull(8), carries=("wind", "rain")),
        effects=[effect("wind", 1.0), effect("rain", 0.01, Interval(-1, 1))],
    )
    rows = {one.name: one.effects for one in costs(kind).settings}
    assert rows == {"one 0": ("wind",), "one 0 all": ("rain", "wind")}


@pytest.mark.parametrize(("step", "runs"), [(1e-4, MOST_RUNS), (0.15, 2), (0.6, 1)])
def test_repetition_is_bounded_by_what_a_run_takes(step: float, runs: int) -> None:
    log = Log()
    found = costs(kind_of(solver("one", pull(8), log=log)), step=step)
    assert len(log.runs) == runs == row(found, "one 0").runs
    assert row(found, "one 0").seconds == pytest.approx(step)


def test_the_shortest_of_the_runs_counts() -> None:
    times = iter([0.0, *(t for k in range(MOST_RUNS) for t in (k, k + 0.01 * (3 + (k - 2) ** 2))), 9.0])
    made = loaded(kind_of(solver("one", pull(8))))
    assert made.spec is not None
    assert made.kind is not None
    found = cost("toy.yaml", made.kind, made.spec, clock=lambda: next(times))
    assert row(found, "one 0").seconds == pytest.approx(0.03)


def test_nothing_is_remembered_from_run_to_run() -> None:
    """A run that finds its motion made already would be timed as free."""
    made, forgotten = [], []
    forgotten_with(lambda: forgotten.append(1))

    @remembered(8)
    def motion(key: int) -> int:
        made.append(key)
        return key

    def found(carried: frozenset[str], level: int) -> Estimate:
        return pull(motion(8))

    costs(kind_of(solver("one", found)))
    assert made == [8] * MOST_RUNS
    assert len(forgotten) >= MOST_RUNS


def test_what_is_beyond_the_budget_is_named_and_not_run() -> None:
    """The cheap settings go first; the budget counts predicted seconds of all scenes together."""
    log = Log()
    found = costs(kind_of(solver("one", pull(8), seconds=1.0, levels=3, log=log)), budget=12.0)
    assert {level for _, _, level in log.runs} == {0, 1}
    assert [one.outcome for one in found.settings] == [Outcome.MEASURED, Outcome.MEASURED, Outcome.NOT_RUN]
    assert row(found, "one 2").seconds is None


def test_a_formula_and_a_reference_have_a_row_and_are_never_chosen() -> None:
    textbook = solver("book", pull(8), decides=False, **FORMULA)
    kind = kind_of(within(7, 9), textbook, seconding=lambda: (solver("seen", pull(8)),))
    found = costs(kind)
    assert {one.name: one.role for one in found.settings} == {
        "book 0": Role.FORMULA,
        "coarse 0": Role.LADDER,
        "seen 0": Role.REFERENCE,
    }
    assert {name for one in found.choices for name in one.settings} == {"coarse 0"}
    assert not any(one.front_of_bars for one in found.settings if one.role is not Role.LADDER)


def test_a_reference_runs_once_at_the_finest_setting_the_budget_has_room_for() -> None:
    seen = solver("seen", pull(8), seconds=1.0, levels=4)
    assert row(costs(kind_of(within(7, 9), seconding=lambda: (seen,)), budget=50.0), "seen 1").role is Role.REFERENCE


def test_a_reference_that_can_tell_nothing_says_why_where_no_other_one_can() -> None:
    dear, unfit = solver("dear", pull(8), seconds=99.0), solver("unfit", pull(8), valid=False)
    found = costs(kind_of(within(7, 9), seconding=lambda: (dear, unfit)))
    reasons = {one.name: one.reason for one in found.settings if one.role is Role.REFERENCE}
    assert set(reasons) == {"dear 0", "unfit 0"}
    assert reasons["dear 0"].endswith("a second method may take")
    assert all(one.outcome is Outcome.NOT_RUN for one in found.settings if one.role is Role.REFERENCE)
    found = costs(kind_of(within(7, 9), seconding=lambda: (dear, unfit, solver("seen", pull(8)))))
    assert [one.name for one in found.settings if one.role is Role.REFERENCE] == ["seen 0"]


# -- errors ----------------------------------------------------------------------------------------------------------


def test_the_error_is_the_distance_from_another_method() -> None:
    found = costs(kind_of(within(7, 9, name="coarse"), solver("fine", pull(8.4, 8.6))))
    load = only_load(row(found, "coarse 0"))
    assert (load.reference, load.reference_value) == ("fine 0", 8.5 * KN)
    assert load.error == pytest.approx(0.5 / 8.5)
    assert load.resolution == pytest.approx(0.1 / 8.5)
    assert load.bar == pytest.approx(1 / 8)
    assert load.resolved
    assert load.held is Held.YES


def test_a_method_is_never_held_against_itself() -> None:
    """Neither at a finer setting nor under another name."""
    twins = [solver(name, pull(7, 9), levels=2, method="the same code") for name in ("one", "two")]
    found = costs(kind_of(*twins))
    assert all(one.worst is None and one.held is None and one.references == () for one in found.settings)


def test_the_best_known_value_of_another_method_is_the_reference() -> None:
    rough, close = within(5, 12, name="rough"), within(7.9, 8.1, name="close")
    found = costs(kind_of(within(7, 9), rough, close))
    assert only_load(row(found, "coarse 0")).reference == "close 0"
    assert only_load(row(found, "close 0")).reference == "coarse 0"


@pytest.mark.parametrize(
    ("own", "other", "held"),
    [
        ((7, 9), (8.4, 8.6), Held.YES),
        ((7, 9), (8.8, 9.4), Held.OPEN),
        ((7, 9), (9.2, 9.4), Held.NO),
        ((7.95, 8.05), (6.0, 10.4), Held.OPEN),
    ],
)
def test_a_bar_that_misses_the_error_is_told(own: tuple[float, float], other: tuple[float, float], held: Held) -> None:
    """It holds the reference, or it does not, or the reference's own bar is too wide to say."""
    found = costs(kind_of(within(*own), within(*other, name="other")))
    assert only_load(row(found, "coarse 0")).held is held


def test_the_bounds_of_what_a_run_leaves_out_are_part_of_its_bar() -> None:
    wind = effect("wind", 1.0, Interval(-0.5 * KN, 1.5 * KN))
    kind = kind_of(solver("calm", pull(8)), solver("windy", pull(9), carries=("wind",)), effects=[wind])
    load = only_load(row(costs(kind), "calm 0"))
    assert (load.bar, load.held) == (pytest.approx(1.5 / 8), Held.YES)


def test_without_a_bound_there_is_an_error_but_no_bar() -> None:
    kind = kind_of(
        solver("calm", pull(8)), solver("windy", pull(9), carries=("wind",)), effects=[effect("wind", 1.0, ANYTHING)]
    )
    calm = row(costs(kind), "calm 0")
    assert calm.bar == math.inf
    assert (only_load(calm).bar, only_load(calm).held) == (None, None)
    assert only_load(calm).error == pytest.approx(1 / 9)
    assert row(costs(kind), "windy 0").worst is None, "what has no bound is no reference"


def test_a_load_next_to_nothing_is_measured_against_the_large_ones() -> None:
    both = {"pull": pull(8), "aside": pull(0, 0.001)}
    loads = (*KIND.loads, LoadInfo("aside", "aside", FORCE, governing=True))
    kind = kind_of(solver("one", lambda c, n: both, gives=("pull", "aside")), loads=loads)
    (load,) = [one for one in row(costs(kind), "one 0").loads if one.name == "aside"]
    assert load.bar == pytest.approx(0.0005 / (1e-3 * 8))


def failing(carried: frozenset[str], level: int) -> Estimate:
    raise NumericsError("NUM101", "it does not converge")


def test_a_method_that_fails_is_no_point() -> None:
    found = costs(kind_of(solver("broken", failing), within(7, 9)))
    broken = row(found, "broken 0")
    assert (broken.outcome, broken.seconds, broken.loads) == (Outcome.FAILED, None, ())
    assert "does not converge" in broken.reason
    assert not broken.front_of_bars
    assert row(found, "coarse 0").worst is None


def test_a_number_that_is_none_is_a_failure() -> None:
    found = costs(kind_of(solver("broken", Estimate.unknown()), within(7, 9)))
    assert row(found, "broken 0").outcome is Outcome.FAILED


def test_a_run_that_says_it_left_its_range_is_a_failure() -> None:
    def run(spec: Any, scene: Any, carried: frozenset[str], level: int) -> Result:
        return Result({"pull": Found(Estimate.unknown(8 * KN))}, findings=(Finding("NUM102", "the belt goes slack"),))

    found = costs(kind_of(replace(solver("slack", pull(8)), run=run)))
    assert row(found, "slack 0").outcome is Outcome.FAILED
    assert "goes slack" in row(found, "slack 0").reason


# -- the front, and what to choose -----------------------------------------------------------------------------------


def stepped(widths: list[float], **parts: Any) -> Any:
    return solver("fine", lambda c, n: pull(8 - widths[n], 8 + widths[n]), levels=len(widths), **parts)


def dearer() -> Iterator[float]:
    """A clock by which every setting takes longer than the one before."""
    now, step = 0.0, 1e-4
    while True:
        yield now
        now += step
        step *= 1.1


def slowly(kind: AnyKind, **data: Any) -> CostReport:
    made, clock = loaded(kind, **data), dearer()
    assert made.spec is not None
    return cost("toy.yaml", kind, made.spec, most_runs=1, clock=lambda: next(clock))


def test_the_front_is_what_nothing_beats() -> None:
    """A dearer setting that proves no more is not on it."""
    found = slowly(kind_of(stepped([2.0, 1.0, 1.0, 0.5])))
    assert [one.front_of_bars for one in found.settings] == [True, True, False, True]


def test_the_cheapest_setting_that_proves_an_accuracy_is_named() -> None:
    found = slowly(kind_of(stepped([2.0, 0.3, 0.05, 0.01])))
    chosen = {one.target: one.settings for one in found.choices}
    assert chosen == {"5 %": ("fine 1",), "1 %": ("fine 2",), "0.1 %": (), MARGINS: ("fine 0",)}
    (short,) = found.chosen("0.1 %")
    assert (short.reached, short.missing, short.seconds) == (False, ("pull",), None)


def test_the_margins_of_the_file_ask_for_no_more_than_they_need() -> None:
    """8 kN within a bar of 2 kN: known to bear with a limit of 10.1 kN, not with one of 9.9 kN."""
    found = slowly(kind_of(stepped([2.0, 0.3])), strength="9.9 kN")
    assert found.chosen(MARGINS)[0].settings == ("fine 1",)
    found = slowly(kind_of(stepped([2.0, 0.3])), strength="10.1 kN")
    assert found.chosen(MARGINS)[0].settings == ("fine 0",)


def test_margins_that_nothing_decides_are_told() -> None:
    found = slowly(kind_of(stepped([2.0, 1.5])), strength="8.1 kN")
    (choice,) = found.chosen(MARGINS)
    assert not choice.reached
    assert choice.missing


def test_the_accuracy_of_the_file_is_priced_too() -> None:
    found = slowly(kind_of(stepped([2.0, 0.3])), accuracy="20 %")
    assert [one.settings for one in found.chosen("20 %")] == [("fine 1",)]


def test_the_closest_check_is_named_with_its_margin() -> None:
    found = slowly(kind_of(stepped([0.0])))
    assert found.closest is not None
    assert found.closest[1] == pytest.approx(0.2)
