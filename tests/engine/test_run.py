"""Plan -> results: the ladder climbs only while something is undecided, and says what it did."""

import math
import sys
from dataclasses import replace
from typing import Any
from unittest import mock

import numpy as np
import pytest
from support.toy_kind import OVERLOAD, PULL, SHOCK, STATICS
from support.toys import (
    KN,
    LIMIT,
    Log,
    effect,
    effect_of,
    judgement,
    kind_of,
    loaded,
    planned,
    pull,
    report,
    scene_plan,
    solver,
)

from ptmcalc.base.diagnostic import Severity, Verdict
from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import ANYTHING, Estimate, Interval
from ptmcalc.base.units import FORCE
from ptmcalc.contract.effect import EffectState
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.report import FileReport, LoadReport, SceneReport
from ptmcalc.contract.result import Finding, Found, LoadInfo, Result
from ptmcalc.contract.solver import AnySolver, Fidelity
from ptmcalc.engine.plan import plan
from ptmcalc.engine.run import settle
from ptmcalc.engine.settled import Settled

WIDE = Interval(-3 * KN, 3 * KN)
NARROW = Interval(-0.1 * KN, 0.1 * KN)


def scene_of(found: FileReport) -> SceneReport:
    (scene,) = found.scenes
    return scene


def load_of(found: FileReport, name: str = "pull") -> LoadReport:
    return next(load for load in scene_of(found).loads if load.info.name == name)


def codes(found: FileReport) -> list[str]:
    return [diagnostic.code for diagnostic in found.diagnostics]


def settled(kind: AnyKind, budget: float = 60.0) -> Settled:
    spec = loaded(kind).spec
    assert spec is not None
    return settle(kind, spec, scene_plan(kind), budget=budget)


# -- the ladder -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("cheap", "verdict", "ran"),
    [
        (pull(8, 9), Verdict.PASS, ["cheap"]),
        (pull(11, 12), Verdict.FAIL, ["cheap"]),
        (pull(9.9), Verdict.PASS, ["cheap"]),
        (pull(9, 11), Verdict.PASS, ["cheap", "dear"]),
        (Estimate.unknown(9 * KN), Verdict.PASS, ["cheap", "dear"]),
    ],
)
def test_the_dear_solver_runs_only_while_the_cheap_one_leaves_it_open(
    cheap: Estimate, verdict: Verdict, ran: list[str]
) -> None:
    log = Log()
    kind = kind_of(
        solver("dear", pull(9.5), seconds=1.0, log=log, carries=("a",)),
        solver("cheap", cheap, log=log),
        effects=[effect("a", bound=Interval(0, 0))],
    )
    # no repair: it would run the ladder again
    kind = replace(kind, checks=(replace(OVERLOAD, repair=lambda spec, scene: ()),))
    assert judgement(report(kind)).verdict is verdict
    assert log.names == ran


def test_it_stops_at_the_first_level_that_decides() -> None:
    log = Log()
    halved = solver("fine", lambda carried, level: pull(9.6 - 1.2 / 2**level, 9.6 + 1.2 / 2**level), levels=6, log=log)
    assert judgement(report(kind_of(halved))).verdict is Verdict.PASS
    assert [level for _, _, level in log.runs] == [0, 1, 2]  # 9.6 ± 0.3 is the first below 10


def test_it_ends_undecided_at_the_top_when_nothing_decides() -> None:
    log = Log()
    found = report(kind_of(solver("fine", lambda carried, level: pull(9, 11), levels=3, log=log)))
    assert judgement(found).verdict is Verdict.UNDECIDED
    assert [level for _, _, level in log.runs] == [0, 1, 2]
    assert found.verdict == "undecided"


def test_levels_that_cannot_help_are_not_tried() -> None:
    """The bar is all model error: a finer setting of the same solver would not narrow it."""
    log = Log()
    fine = solver("fine", pull(9.6), levels=4, log=log)
    found = report(kind_of(fine, effects=[effect("a", bound=WIDE)]))
    assert judgement(found).verdict is Verdict.UNDECIDED
    assert len(log.runs) == 1


def test_a_verdict_is_bought_only_for_the_check_that_needs_it() -> None:
    """The other load is rough, but its own check stands: the solver that only refines it is not run."""
    log = Log()
    wind = LoadInfo("wind", "wind", FORCE)
    kind = kind_of(
        solver("both", lambda c, n: {"pull": pull(9), "wind": pull(1, 3)}, gives=("pull", "wind"), log=log),
        solver("gust", lambda c, n: {"wind": pull(2)}, gives=("wind",), seconds=1.0, log=log),
        loads=(PULL, wind),
        checks=(OVERLOAD, replace(OVERLOAD, code="TOY102", loads=("wind",))),
    )
    assert report(kind).verdict == "pass"
    assert log.names == ["both"]


@pytest.mark.parametrize(("accuracy", "levels"), [(None, 1), ("50 %", 1), ("10 %", 2), ("1 %", 5), ("0.001 %", 8)])
def test_accuracy_is_bought_where_it_is_asked_for(accuracy: str | None, levels: int) -> None:
    """The verdict stands at once; the bar of 12.5 % is halved until it is as narrow as asked, or the ladder ends."""
    log = Log()
    halved = solver("fine", lambda c, n: pull(8 - 1 / 2**n, 8 + 1 / 2**n), levels=8, seconds=1e-9, log=log)
    found = report(kind_of(halved), **({"accuracy": accuracy} if accuracy else {}))
    assert judgement(found).verdict is Verdict.PASS
    assert len(log.runs) == levels


@pytest.mark.parametrize(("accuracy", "said"), [("10 %", []), ("0.001 %", ["NUM105"])])
def test_an_accuracy_that_is_not_reached_is_said(accuracy: str, said: list[str]) -> None:
    found = report(kind_of(solver("only", Estimate.within(5 * KN, 0.1 * KN))), accuracy=accuracy)
    assert codes(found) == said
    assert judgement(found).verdict is Verdict.PASS


@pytest.mark.parametrize(("headline", "runs"), [(True, 2), (False, 1)])
def test_accuracy_is_of_the_headline_loads(headline: bool, runs: int) -> None:
    log = Log()
    kind = kind_of(
        solver(
            "fine",
            lambda c, n: {"pull": pull(8), "aside": pull(1, 3) if n == 0 else pull(2)},
            levels=2,
            gives=("pull", "aside"),
            log=log,
        ),
        loads=(PULL, LoadInfo("aside", "aside", FORCE, headline=headline)),
    )
    report(kind, accuracy="1 %")
    assert len(log.runs) == runs


def test_the_load_with_the_smallest_bar_is_reported_with_its_solver() -> None:
    """The dearer run turns out worse: the cheaper one stands."""
    kind = kind_of(
        solver("cheap", pull(9.2, 10.2)),
        solver("dear", pull(7, 13), seconds=1.0, carries=("a",)),
        effects=[effect("a", bound=Interval(0, 0))],
    )
    found = load_of(report(kind))
    assert (found.estimate, found.solver) == (pull(9.2, 10.2), "cheap")


def test_a_rich_solver_that_is_too_coarse_at_first_is_refined() -> None:
    """Its first bar is wider than the bound it saves, its second decides: nothing is undecided while it can run."""
    log = Log()
    kind = kind_of(
        solver("rigid", pull(9.5), log=log),
        solver(
            "waves",
            lambda c, n: pull(7.5, 11.5) if n == 0 else pull(9.4, 9.6),
            carries=("waves",),
            levels=2,
            seconds=0.1,
            log=log,
        ),
        effects=[effect("waves", bound=Interval(-KN, KN))],
    )
    assert judgement(report(kind)).verdict is Verdict.PASS
    assert log.names == ["rigid", "waves", "waves"]


def test_the_next_rung_and_its_price_stand_in_the_report() -> None:
    solvers = scene_of(report(kind_of(solver("fine", pull(8), levels=2, seconds=0.2)))).solvers
    assert [(one.name, one.next and one.next.predicted_seconds) for one in solvers] == [("fine", pytest.approx(2.0))]


def test_work_of_all_runs_is_counted() -> None:
    found = report(kind_of(solver("fine", lambda c, n: pull(9, 11), levels=3)))
    assert scene_of(found).health["evaluations"] == 3


# -- effects --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("number", "bound", "state"),
    [
        (1.0, NARROW, EffectState.BOUNDED),
        (0.01, NARROW, EffectState.SKIPPED),
        (1.0, WIDE, EffectState.SIMULATED),
        (0.01, WIDE, EffectState.SIMULATED),  # small by its number, but its bound leaves the verdict open
        (1.0, ANYTHING, EffectState.SIMULATED),
    ],
)
def test_an_effect_is_simulated_only_where_its_bound_does_not_suffice(
    number: float, bound: Interval, state: EffectState
) -> None:
    log = Log()
    kind = kind_of(
        solver("rigid", pull(9), log=log),
        solver("waves", pull(9.5), carries=("waves",), seconds=1.0, log=log),
        effects=[effect("waves", number, bound)],
    )
    found = report(kind)
    assert judgement(found).verdict is Verdict.PASS
    assert effect_of(found, "waves").state is state
    assert log.names == (["rigid", "waves"] if state is EffectState.SIMULATED else ["rigid"])


def test_the_bound_of_what_is_left_out_widens_the_load() -> None:
    kind = kind_of(solver("rigid", pull(8.9, 9.1)), effects=[effect("waves", bound=Interval(-0.2 * KN, 0.5 * KN))])
    estimate = load_of(report(kind)).estimate
    assert (estimate.value, estimate.low, estimate.high) == pytest.approx((9000, 8700, 9600))
    assert (estimate.numerical, estimate.model) == pytest.approx((100, 500))


def test_the_bounds_of_several_effects_add_up() -> None:
    kind = kind_of(solver("rigid", pull(9)), effects=[effect("a", bound=NARROW), effect("b", 0.01, bound=NARROW)])
    assert load_of(report(kind)).estimate.high == pytest.approx(9200)


def test_a_carried_effect_widens_nothing() -> None:
    kind = kind_of(solver("waves", pull(9.5), carries=("waves",)), effects=[effect("waves", bound=ANYTHING)])
    assert load_of(report(kind)).estimate == pull(9.5)


def test_a_part_of_what_is_left_out_is_inside_its_bound() -> None:
    effects = [effect("waves", bound=NARROW), effect("echo", bound=ANYTHING, part_of="waves")]
    found = report(kind_of(solver("rigid", pull(9)), effects=effects))
    assert load_of(found).estimate.high == pytest.approx(9100)
    assert judgement(found).verdict is Verdict.PASS


def test_several_active_effects_are_simulated_in_one_run() -> None:
    log = Log()
    kind = kind_of(
        solver("rich", pull(9.5), carries=("waves", "slip", "sag"), log=log),
        effects=[effect(name) for name in ("waves", "slip", "sag")],
    )
    found = report(kind)
    assert log.runs == [("rich", frozenset({"waves", "slip", "sag"}), 0)]
    assert {one.state for one in scene_of(found).effects} == {EffectState.SIMULATED}


def test_an_unbounded_effect_never_decides() -> None:
    found = report(kind_of(solver("rigid", pull(1)), effects=[effect("waves", 0.01, ANYTHING)]))
    assert judgement(found).verdict is Verdict.UNDECIDED
    assert not load_of(found).estimate.bounded


@pytest.mark.parametrize(("wish", "ran"), [("auto", ["rigid"]), ("on", ["rigid", "waves"])])
def test_an_effect_forced_on_is_simulated_though_its_bound_suffices(wish: str, ran: list[str]) -> None:
    log = Log()
    kind = kind_of(
        solver("rigid", pull(9), log=log),
        solver("waves", pull(9.05), carries=("waves",), seconds=1.0, log=log),
        effects=[effect("waves", 0.01, NARROW)],
    )
    line = effect_of(report(kind, effects={"waves": wish}), "waves")
    assert log.names == ran
    assert line.forced == (wish == "on")
    assert line.state is (EffectState.SIMULATED if wish == "on" else EffectState.SKIPPED)
    assert line.note == ("forced on by the file" if wish == "on" else "")


def test_an_effect_forced_on_is_simulated_once_not_refined() -> None:
    log = Log()
    kind = kind_of(
        solver("rigid", pull(9), log=log),
        solver("waves", pull(9, 9.1), carries=("waves",), levels=3, log=log),
        effects=[effect("waves", 0.01, NARROW)],
    )
    report(kind, effects={"waves": "on"})
    assert log.names == ["rigid", "waves"]


def test_an_effect_forced_off_is_never_carried_puts_no_bar_and_is_named() -> None:
    log = Log()
    kind = kind_of(
        solver("rigid", pull(9), log=log),
        solver("rich", pull(9.5), carries=("waves", "slip"), seconds=1.0, log=log),
        effects=[effect("waves", bound=ANYTHING), effect("slip", bound=WIDE)],
    )
    found = report(kind, effects={"waves": "off"})
    assert log.runs == [("rigid", frozenset(), 0), ("rich", frozenset({"slip"}), 0)]
    assert judgement(found).verdict is Verdict.PASS
    assert judgement(found).without == ("waves",)
    line = effect_of(found, "waves")
    assert (line.state, line.forced, line.note) == (EffectState.SKIPPED, True, "forced off by the file")


def test_a_verdict_says_without_only_of_what_the_file_forced_off() -> None:
    effects = [effect("waves", bound=NARROW), effect("sag", number=None, bound=ANYTHING)]
    found = report(kind_of(solver("rigid", pull(9)), effects=effects))
    assert judgement(found).without == ()
    assert "a required input is not given" in effect_of(found, "sag").note


@pytest.mark.parametrize(("carries", "note"), [(("waves",), "its bound is calibrated"), (("waves", "echo"), "")])
def test_a_bar_that_rests_on_a_calibrated_bound_says_so(carries: tuple[str, ...], note: str) -> None:
    effects = [effect("waves"), replace(effect("echo", bound=NARROW, part_of="waves"), calibrated=True)]
    found = report(kind_of(solver("rich", pull(9), carries=carries), effects=effects))
    assert effect_of(found, "echo").note == note


def test_what_is_not_checked_says_without_nothing() -> None:
    kind = kind_of(solver("rigid", pull(9)), effects=[effect("waves")])
    assert judgement(report(kind, effects={"waves": "off"}, strength=None)).without == ()


def test_an_effect_forced_on_that_lacks_an_input_is_refused() -> None:
    kind = kind_of(
        solver("rich", pull(9), carries=("waves", "sag")), effects=[effect("waves"), effect("sag", number=None)]
    )
    found = report(kind, effects={"sag": "on"})
    assert [(one.code, one.severity) for one in found.diagnostics] == [("SPC205", Severity.ERROR)]
    assert "a required input is not given" in found.diagnostics[0].message
    assert (found.verdict, found.scenes) == ("invalid", ())


# -- effects near their threshold -----------------------------------------------------------------------------------


def near_kind(number: float, log: Log) -> AnyKind:
    """The effect adds 0.5 kN to the 9 kN that the rest of the physics makes."""
    return kind_of(
        solver(
            "rich", lambda carried, level: pull(9.5 if "sag" in carried else 9.0), carries=("waves", "sag"), log=log
        ),
        effects=[effect("waves", 50.0), effect("sag", number, threshold=0.1)],
    )


@pytest.mark.parametrize("number", [0.05, 0.1, 0.2])
def test_an_effect_near_its_threshold_is_left_out_once_and_the_change_is_told(number: float) -> None:
    log = Log()
    found = report(near_kind(number, log), effects={"sag": "on"})
    assert [carried for _, carried, _ in log.runs] == [{"waves", "sag"}, {"waves"}]
    change = effect_of(found, "sag").change
    assert change is not None
    assert (change.load, change.relative) == ("pull", pytest.approx(9 / 9.5 - 1))
    assert change.clear
    assert load_of(found).estimate == pull(9.5)


@pytest.mark.parametrize("number", [0.049, 0.201, 5.0])
def test_an_effect_far_from_its_threshold_is_not_run_again(number: float) -> None:
    log = Log()
    found = report(near_kind(number, log), effects={"sag": "on"})
    assert len(log.runs) == 1
    assert effect_of(found, "sag").change is None


def test_what_an_effect_changes_is_told_by_the_coarsest_run_that_carried_it() -> None:
    """The verdict asks for a finer one; the two runs whose loads are compared have the same grid."""
    log = Log()

    def refined(carried: frozenset[str], level: int) -> Estimate:
        middle = (9.5 if "sag" in carried else 9.0) + (0.2 if level == 0 else 0.0)
        return pull(middle - 1 / (1 + 9 * level), middle + 1 / (1 + 9 * level))

    found = report(kind_of(solver("rich", refined, carries=("sag",), levels=2, log=log), effects=[effect("sag", 0.15)]))
    assert judgement(found).verdict is Verdict.PASS
    assert [(set(carried), level) for _, carried, level in log.runs] == [({"sag"}, 0), ({"sag"}, 1), (set(), 0)]
    change = effect_of(found, "sag").change
    assert change is not None
    assert change.relative == pytest.approx(9.2 / 9.7 - 1)


@pytest.mark.parametrize(("without", "clear"), [(pull(8.9, 9.09), True), (pull(8.9, 9.11), False), (pull(9.3), False)])
def test_a_change_is_clear_where_the_bars_do_not_meet(without: Estimate, clear: bool) -> None:
    kind = kind_of(
        solver("rich", lambda carried, level: pull(9.1, 9.5) if "sag" in carried else without, carries=("sag",)),
        effects=[effect("sag", 0.15)],
    )
    change = effect_of(report(kind), "sag").change
    assert change is not None
    assert change.clear is clear


@pytest.mark.parametrize(("gale", "told"), [(2.2, "gale"), (2.0, "pull")], ids=["clear", "rounding"])
def test_a_clear_change_is_told_before_a_larger_one_within_the_bars(gale: float, told: str) -> None:
    """The pull changes by half, but nobody knows it so well; the gale without a bar by a tenth, or by rounding."""
    info = LoadInfo("gale", "gale", FORCE)

    def found_loads(carried: frozenset[str], level: int) -> dict[str, Estimate]:
        if "sag" in carried:
            return {"pull": pull(2, 6), "gale": pull(2.0)}
        return {"pull": pull(4, 8), "gale": pull(gale * (1 + 1e-15))}

    kind = kind_of(
        solver("rich", found_loads, carries=("sag",), gives=("pull", "gale")),
        effects=[effect("sag", 0.15)],
        loads=(PULL, info),
        checks=(OVERLOAD, replace(OVERLOAD, code="TOY102", loads=("gale",))),
    )
    change = effect_of(report(kind), "sag").change
    assert change is not None
    assert change.load == told
    assert change.clear is (told == "gale")


def test_leaving_out_a_whole_leaves_out_its_parts() -> None:
    log = Log()
    kind = kind_of(
        solver("rich", pull(9), carries=("waves", "echo", "slip"), log=log),
        effects=[effect("waves", 0.15), effect("echo", 50.0, part_of="waves"), effect("slip", 50.0)],
    )
    report(kind)
    assert [carried for _, carried, _ in log.runs] == [{"waves", "echo", "slip"}, {"slip"}]


def test_a_run_without_an_effect_that_breaks_down_tells_no_change() -> None:
    def fragile(carried: frozenset[str], level: int) -> Estimate:
        if "sag" not in carried:
            raise NumericsError("NUM101", "it does not converge without sag")
        return pull(9)

    found = report(kind_of(solver("rich", fragile, carries=("sag",)), effects=[effect("sag", 0.15)]))
    assert judgement(found).verdict is Verdict.PASS
    assert effect_of(found, "sag").change is None


def test_a_load_known_only_without_the_effect_makes_no_change_and_no_trouble() -> None:
    """The run that carries the effect finds no number for one of the loads; the run without it does."""
    wind = LoadInfo("wind", "wind", FORCE)

    def found_loads(carried: frozenset[str], level: int) -> dict[str, Estimate]:
        return {"pull": pull(9), "wind": Estimate.exact(math.nan) if "sag" in carried else pull(1)}

    kind = kind_of(
        solver("rich", found_loads, carries=("sag",), gives=("pull", "wind")),
        effects=[effect("sag", 0.15)],
        loads=(PULL, wind),
        checks=(OVERLOAD, replace(OVERLOAD, code="TOY102", loads=("wind",))),
    )
    found = report(kind)
    assert {one.code: one.verdict for _, one in found.judgements} == {
        "TOY101": Verdict.PASS,
        "TOY102": Verdict.UNDECIDED,
    }


# -- textbook formulas ----------------------------------------------------------------------------------------------


def test_a_textbook_formula_stands_beside_the_load_and_never_decides() -> None:
    kind = kind_of(
        solver("top", pull(9)),
        solver("textbook", Estimate.unknown(12 * KN), decides=False, fidelity=Fidelity.FORMULA),
    )
    found = report(kind)
    formula = load_of(found).formula
    assert formula is not None
    assert (formula.name, formula.value, formula.ratio) == ("textbook", 12 * KN, pytest.approx(0.75))
    assert judgement(found).verdict is Verdict.PASS
    assert [(one.name, one.decides) for one in scene_of(found).solvers] == [("top", True), ("textbook", False)]


def test_a_textbook_alone_decides_nothing() -> None:
    found = report(kind_of(solver("textbook", pull(9), decides=False)))
    assert judgement(found).verdict is Verdict.UNDECIDED


def test_a_textbook_formula_of_zero_has_no_ratio() -> None:
    kind = kind_of(solver("top", pull(9)), solver("textbook", Estimate.unknown(0.0), decides=False))
    formula = load_of(report(kind)).formula
    assert formula is not None
    assert formula.ratio is None


def test_a_textbook_formula_that_breaks_down_does_not_stop_the_check() -> None:
    def broken(carried: frozenset[str], level: int) -> Estimate:
        raise NumericsError("NUM102", "the textbook does not know this")

    found = report(kind_of(solver("top", pull(9)), solver("textbook", broken, decides=False)))
    assert judgement(found).verdict is Verdict.PASS


# -- numerics that fail ---------------------------------------------------------------------------------------------


def test_a_load_that_is_not_a_number_is_a_finding_and_undecided() -> None:
    found = report(kind_of(solver("top", Estimate.exact(math.nan))))
    assert codes(found) == ["NUM101"]
    assert "`pull` is not a number" in found.diagnostics[0].message
    assert found.diagnostics[0].severity is Severity.WARNING
    assert judgement(found).verdict is Verdict.UNDECIDED
    assert scene_of(found).loads == ()


def test_a_run_that_finds_no_memory_is_beyond_the_budget_and_undecided() -> None:
    def greedy(carried: frozenset[str], level: int) -> Estimate:
        raise MemoryError

    found = report(kind_of(solver("top", greedy)))
    assert (codes(found), judgement(found).verdict) == (["NUM103"], Verdict.UNDECIDED)
    assert "top: the computation takes more memory than 2 GiB" in found.diagnostics[0].message
    spared = report(kind_of(solver("low", pull(9)), solver("top", greedy, decides=False)))
    assert judgement(spared).verdict is Verdict.PASS


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="other systems do not limit the data of a process")
def test_a_run_beyond_the_memory_budget_is_given_up_and_nothing_after_it_is_limited() -> None:
    def greedy(carried: frozenset[str], level: int) -> Estimate:
        return Estimate.exact(float(np.ones(1 << 24)[-1]))

    with mock.patch("ptmcalc.base.memory.MEMORY_BUDGET", 64 << 20):
        found = report(kind_of(solver("top", greedy)))
    assert (codes(found), judgement(found).verdict) == (["NUM103"], Verdict.UNDECIDED)
    assert judgement(report(kind_of(solver("top", greedy)))).verdict is Verdict.PASS


def test_a_run_that_breaks_down_is_a_finding_and_undecided() -> None:
    def broken(carried: frozenset[str], level: int) -> Estimate:
        raise NumericsError("NUM102", "the rope is slack")

    found = report(kind_of(solver("top", broken)))
    assert codes(found) == ["NUM102"]
    assert found.diagnostics[0].message == "scene `hang`, top: the rope is slack"
    assert judgement(found).verdict is Verdict.UNDECIDED
    assert found.valid
    assert found.verdict == "undecided"


@pytest.mark.parametrize("breakdown", ["nan", "error"])
def test_another_solver_may_still_decide_after_a_breakdown(breakdown: str) -> None:
    def broken(carried: frozenset[str], level: int) -> Estimate:
        if breakdown == "error":
            raise NumericsError("NUM101", "no convergence")
        return Estimate.exact(math.nan)

    found = report(kind_of(solver("broken", broken), solver("sound", pull(9), seconds=1.0)))
    assert codes(found) == ["NUM101"]
    assert judgement(found).verdict is Verdict.PASS
    assert load_of(found).solver == "sound"


def test_a_breakdown_does_not_take_back_what_is_known() -> None:
    def fragile(carried: frozenset[str], level: int) -> Estimate:
        if level:
            raise NumericsError("NUM101", "no convergence")
        return pull(7, 9)

    found = report(kind_of(solver("fine", fragile, levels=2)), accuracy="1 %")
    assert codes(found) == ["NUM101", "NUM105"]
    assert load_of(found).estimate == pull(7, 9)
    assert judgement(found).verdict is Verdict.PASS


def test_what_a_solver_says_of_its_own_numbers_is_told_once() -> None:
    remark = Finding("NUM104", "the rope was slack for a moment")
    top = replace(
        solver("fine", pull(9), levels=3),
        run=lambda spec, scene, carried, level: Result(
            {"pull": Found(pull(9 - 2 / (level + 1), 9 + 2 / (level + 1)))}, findings=(remark,)
        ),
    )
    found = report(kind_of(top))
    assert [d.message for d in found.diagnostics] == [remark.message]


# -- the budget -----------------------------------------------------------------------------------------------------


def rough(carried: frozenset[str], level: int) -> Estimate:
    return pull(9, 11) if level == 0 else pull(9.5)


@pytest.mark.parametrize(
    ("budget", "verdict", "found"),
    [(11.0, Verdict.PASS, []), (10.9, Verdict.UNDECIDED, ["NUM103"]), (0.5, Verdict.UNDECIDED, ["NUM103"])],
)
def test_predicted_work_is_held_against_the_budget(budget: float, verdict: Verdict, found: list[str]) -> None:
    """Two runs of 1 s and 10 s: the sum counts."""
    result = settled(kind_of(solver("fine", rough, levels=2, seconds=1.0)), budget)
    assert [ruling.verdict for ruling in result.rulings] == [verdict]
    assert [finding.code for finding in result.findings] == found


def test_beyond_the_budget_nothing_runs_and_the_report_says_so() -> None:
    log = Log()
    found = report(kind_of(solver("fine", rough, levels=2, seconds=30.0, log=log)))
    assert len(log.runs) == 1
    assert codes(found) == ["NUM103"]
    assert "fine" in found.diagnostics[0].message
    assert judgement(found).verdict is Verdict.UNDECIDED
    assert found.verdict == "undecided"


def test_a_dear_rung_that_nothing_needs_is_no_finding() -> None:
    found = report(kind_of(solver("cheap", pull(9)), solver("huge", pull(9.1), seconds=1e6)))
    assert (codes(found), found.verdict) == ([], "pass")


# -- values that were assumed ---------------------------------------------------------------------------------------


def shocked(**data: object) -> FileReport:
    """The toy as it is: pull = shock x load against 10 kN, with a shock of 1.1 assumed between 1.0 and 1.2."""
    return report(kind_of(STATICS, assumptions=(SHOCK,)), **data)


@pytest.mark.parametrize(
    ("load", "verdict", "reason"),
    [
        ("8 kN", Verdict.PASS, ""),  # 8 to 9.6 kN
        ("8.5 kN", Verdict.UNDECIDED, "fail if `shock` is 1.2: give its value"),
        ("9.5 kN", Verdict.UNDECIDED, "pass if `shock` is 1: give its value"),
        ("10.5 kN", Verdict.FAIL, ""),
    ],
)
def test_a_verdict_that_flips_within_an_assumption_is_undecided(load: str, verdict: Verdict, reason: str) -> None:
    found = judgement(shocked(load=load))
    assert found.verdict is verdict
    assert found.reason == reason
    if reason:
        assert found.blame.path == ("shock",)


def test_the_value_reported_is_the_one_assumed() -> None:
    found = shocked(load="8.5 kN")
    assert load_of(found).estimate.value == pytest.approx(9350)
    assert [(a.path, a.value, a.interval) for a in found.assumed] == [(("shock",), 1.1, Interval(1.0, 1.2))]
    assert found.assumed[0].source == SHOCK.source


def test_a_value_that_is_written_is_not_assumed() -> None:
    found = shocked(load="8.5 kN", shock=1.1)
    assert found.assumed == ()
    assert judgement(found).verdict is Verdict.PASS


def test_both_ends_of_an_assumption_are_tried() -> None:
    log = Log()

    report(kind_of(solver("top", pull(9), log=log), assumptions=(SHOCK,)))
    assert len(log.runs) == 3  # the value itself, and either end


def test_the_ends_of_an_assumption_are_for_verdicts_not_for_digits() -> None:
    """The accuracy asked for refines the machine as it is; either end settles its verdict at the first level."""
    log = Log()
    fine = solver("fine", lambda carried, level: pull(9 - 0.4 / 2**level, 9 + 0.4 / 2**level), levels=6, log=log)
    found = report(kind_of(fine, assumptions=(SHOCK,)), accuracy="1 %")
    assert [level for _, _, level in log.runs] == [0, 1, 2, 3, 0, 0]  # 9 ± 0.05 is the first within 0.09
    assert judgement(found).verdict is Verdict.PASS


def test_what_is_open_as_it_stands_is_not_settled_at_the_ends() -> None:
    log = Log()
    found = report(kind_of(solver("fine", lambda carried, level: pull(9, 11), levels=3, log=log), assumptions=(SHOCK,)))
    assert judgement(found).verdict is Verdict.UNDECIDED
    assert len(log.runs) == 3


def test_what_one_end_has_changed_is_not_settled_at_the_other() -> None:
    log = Log()
    ends = solver("top", pull(9), log=log)
    asked = replace(
        ends, run=lambda spec, scene, *rest: (ends.run(spec, scene, *rest), STATICS.run(spec, scene, *rest))[1]
    )
    unrepaired = replace(OVERLOAD, repair=lambda spec, scene: ())
    found = judgement(report(kind_of(asked, assumptions=(SHOCK,), checks=(unrepaired,)), load="9.5 kN"))
    assert found.reason == "pass if `shock` is 1: give its value"
    assert len(log.runs) == 2


def test_an_end_climbs_until_its_verdict_stands() -> None:
    log = Log()
    narrowing = solver("fine", lambda carried, level: pull(9.6 - 1.2 / 2**level, 9.6 + 1.2 / 2**level), levels=6)
    ends = replace(
        solver("top", pull(9), levels=6, log=log),
        run=lambda spec, scene, carried, level: (
            log.runs.append(("end", carried, level)) or narrowing.run(spec, scene, carried, level)
            if spec.shock == 1.2
            else Result({"pull": Found(pull(9))})
        ),
    )
    assert judgement(report(kind_of(ends, assumptions=(SHOCK,)))).verdict is Verdict.PASS
    assert [level for _, _, level in log.runs] == [0, 1, 2]


def test_an_end_that_leaves_it_open_is_told_too() -> None:
    top = replace(
        solver("top", pull(9)),
        run=lambda spec, scene, carried, level: Result(
            {"pull": Found(pull(9, 9 if spec.shock == 1.1 else 11, value=9))}
        ),
    )
    found = judgement(report(kind_of(top, assumptions=(SHOCK,))))
    assert found.verdict is Verdict.UNDECIDED
    assert "`shock`" in found.reason


# -- restrictions of a settlement -----------------------------------------------------------------------------------


def test_one_check_may_be_settled_alone() -> None:
    log = Log()
    other = replace(OVERLOAD, code="TOY102", loads=("wind",))
    kind = kind_of(
        solver("cheap", pull(9), log=log),
        solver("gust", lambda c, n: {"wind": pull(1)}, gives=("wind",), seconds=1.0, log=log),
        loads=(PULL, LoadInfo("wind", "wind", FORCE)),
        checks=(OVERLOAD, other),
    )
    spec = loaded(kind).spec
    assert spec is not None
    result = settle(kind, spec, scene_plan(kind), only=OVERLOAD)
    assert [ruling.check.code for ruling in result.rulings] == ["TOY101"]
    assert log.names == ["cheap"]


def test_a_prediction_stops_in_front_of_the_rung_it_would_run() -> None:
    log = Log()
    kind = kind_of(solver("fine", rough, levels=2, log=log))
    spec = loaded(kind).spec
    assert spec is not None
    result = settle(kind, spec, scene_plan(kind), until=lambda rung: rung.level == 0)
    assert len(log.runs) == 1
    assert result.next_rung is not None
    assert result.next_rung.level == 1


def test_the_limit_of_every_toy_is_ten_kilonewtons() -> None:
    """The other tests of this file lean on it."""
    assert judgement(report(kind_of(solver("top", pull(9))))).limit == Estimate.exact(LIMIT)
    assert planned(scene_plan(kind_of(effects=[effect("a")])), "a").active


# -- what an accuracy would cost -------------------------------------------------------------------------------------


def halved_to(levels: int, **parts: Any) -> AnySolver:
    """A bar of 1 kN about 8 kN, halved at each level; each costs ten times the one before."""
    return solver("fine", lambda c, n: pull(8 - 1 / 2**n, 8 + 1 / 2**n), levels=levels, **parts)


def test_an_accuracy_beyond_the_budget_says_what_it_would_cost() -> None:
    """Levels of 1, 10 and 100 s: the second is within a budget of 12 s, the third and all that may help are priced."""
    made = loaded(kind_of(halved_to(4, seconds=1.0)), accuracy="2 %")
    assert made.kind is not None
    assert made.spec is not None
    (scene,) = plan(made.kind, made.spec).scenes
    (said,) = settle(made.kind, made.spec, scene, budget=12.0).findings
    assert said.code == "NUM103"
    for part in (
        "predicted to take 100 s, beyond the budget of 12 s",
        "all 2 that may help would take 1.1e+03 s",
        "`pull` to 2 %: the widest bar is 6.2 %",
    ):
        assert part in said.message


def test_an_accuracy_out_of_reach_says_how_close_the_best_comes() -> None:
    (said,) = report(kind_of(halved_to(3, seconds=1e-6)), accuracy="1 %").diagnostics
    assert said.code == "NUM105"
    assert said.message.endswith("brings `pull` to 1 %: the widest bar is 3.1 %")


def test_a_budget_bounds_the_predicted_work_whatever_is_asked() -> None:
    for budget, levels in ((0.5, 0), (1.0, 1), (10.9, 1), (11.0, 2), (111.0, 3)):
        log = Log()
        made = loaded(kind_of(halved_to(3, seconds=1.0, log=log)), accuracy="0.001 %")
        assert made.kind is not None
        assert made.spec is not None
        (scene,) = plan(made.kind, made.spec).scenes
        done = settle(made.kind, made.spec, scene, budget=budget)
        assert len(log.runs) == levels
        assert sum(run.rung.seconds for run in done.runs) <= budget


def test_the_price_of_the_next_solver_is_in_the_report() -> None:
    found = report(kind_of(halved_to(2, seconds=1e-3)))
    (scene,) = found.scenes
    (ran,) = scene.solvers
    assert ran.next is not None
    assert (ran.next.name, ran.next.predicted_seconds) == ("fine", pytest.approx(1e-2))


def test_a_bound_that_cannot_be_sharpened_gives_way_to_a_computation_that_carries_as_much() -> None:
    """Both carry the swing; the bound has one setting, and its bar straddles the limit. Alone it would stay open."""
    swing = effect("swing")
    bound = solver("bound", pull(8, 12), carries=("swing",), seconds=1e-3)
    computed = solver("computed", pull(8.9, 9.1), carries=("swing",), seconds=1e-2)
    assert judgement(report(kind_of(bound, effects=[swing]))).verdict is Verdict.UNDECIDED
    found = report(kind_of(bound, computed, effects=[swing]))
    assert judgement(found).verdict is Verdict.PASS
    assert [one.name for one in found.scenes[0].solvers] == ["bound", "computed"]
    decided = report(kind_of(solver("bound", pull(8, 9), carries=("swing",), seconds=1e-3), computed, effects=[swing]))
    assert [one.name for one in decided.scenes[0].solvers] == ["bound"], "nothing is open, nothing is computed"
