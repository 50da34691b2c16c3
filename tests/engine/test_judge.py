"""Loads -> verdicts: what a bar, a missing input and a switched-off check come to."""

import math
from dataclasses import replace

import pytest
from support import toys
from support.toy_kind import OVERLOAD, Hang
from support.toys import KN, judgement, kind_of, loaded, pull, report, solver

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.check import Sense
from ptmcalc.engine.judge import Ruling, decide, judge, rule
from ptmcalc.spec.scene import Scene

ONE = math.nextafter(1.0, 2.0)
LEAST, MOST = Sense.AT_LEAST, Sense.AT_MOST


def bar(low: float, high: float) -> Estimate:
    return Estimate((low + high) / 2, low, high)


@pytest.mark.parametrize(
    ("sense", "value", "verdict"),
    [
        (LEAST, Estimate.exact(1.0), Verdict.PASS),  # equal to the limit without a bar
        (LEAST, Estimate.exact(ONE), Verdict.PASS),
        (LEAST, Estimate.exact(math.nextafter(1.0, 0.0)), Verdict.FAIL),
        (LEAST, bar(1.0, 1.2), Verdict.PASS),  # the bar touches the limit from the sound side
        (LEAST, bar(0.8, 1.0), Verdict.UNDECIDED),  # it touches from the bad side: equality would pass
        (LEAST, bar(0.9, 1.2), Verdict.UNDECIDED),
        (LEAST, bar(0.8, 0.9), Verdict.FAIL),
        (LEAST, Estimate.exact(math.inf), Verdict.PASS),
        (LEAST, Estimate.exact(-math.inf), Verdict.FAIL),
        (MOST, Estimate.exact(1.0), Verdict.PASS),
        (MOST, Estimate.exact(ONE), Verdict.FAIL),
        (MOST, bar(0.8, 1.0), Verdict.PASS),
        (MOST, bar(1.0, 1.2), Verdict.UNDECIDED),
        (MOST, bar(0.9, 1.2), Verdict.UNDECIDED),
        (MOST, bar(1.1, 1.2), Verdict.FAIL),
        (MOST, Estimate.exact(math.inf), Verdict.FAIL),
        (MOST, Estimate(0.9, -math.inf, 0.95), Verdict.PASS),  # bounded on the side that matters
        (MOST, Estimate(0.9, 0.85, math.inf), Verdict.UNDECIDED),
    ],
)
def test_a_whole_bar_decides(sense: Sense, value: Estimate, verdict: Verdict) -> None:
    assert decide(value, Estimate.exact(1.0), sense) is verdict


@pytest.mark.parametrize("sense", list(Sense))
@pytest.mark.parametrize("value", [0.5, 1.0, 2.0, math.nan])
def test_a_number_without_a_provable_bar_never_decides(sense: Sense, value: float) -> None:
    assert decide(Estimate.unknown(value), Estimate.exact(1.0), sense) is Verdict.UNDECIDED


@pytest.mark.parametrize("sense", list(Sense))
def test_what_is_not_a_number_never_decides(sense: Sense) -> None:
    assert decide(Estimate.exact(math.nan), Estimate.exact(1.0), sense) is Verdict.UNDECIDED


@pytest.mark.parametrize(
    ("sense", "value", "verdict"),
    [
        (LEAST, 1.2, Verdict.PASS),
        (LEAST, 1.1, Verdict.UNDECIDED),
        (LEAST, 0.9, Verdict.UNDECIDED),
        (LEAST, 0.8, Verdict.FAIL),
        (MOST, 0.8, Verdict.PASS),
        (MOST, 0.9, Verdict.UNDECIDED),
        (MOST, 1.2, Verdict.FAIL),
    ],
)
def test_the_bar_of_the_limit_counts_too(sense: Sense, value: float, verdict: Verdict) -> None:
    assert decide(Estimate.exact(value), bar(0.85, 1.15), sense) is verdict


EXACT = kind_of(solver("exact", pull(9.0)))


def test_a_missing_input_is_named_and_not_checked() -> None:
    found = judgement(report(EXACT, strength=None))
    assert found.verdict is Verdict.NOT_CHECKED
    assert found.blame.path == ("strength",)
    assert "`strength` is not given" in found.reason
    assert (found.value, found.limit, found.margin) == (None, None, None)


def test_a_check_without_its_input_makes_the_file_undecided() -> None:
    assert report(EXACT, strength=None).verdict == "undecided"


def test_a_check_switched_off_with_a_reason_is_not_missed() -> None:
    off = {"TOY101": {"off": "a show piece"}}
    found = report(EXACT, strength=None, checks=off)
    assert [(one.verdict, one.reason) for _, one in found.judgements] == [(Verdict.OFF, "a show piece")]
    assert found.verdict == "undecided", "a file that checked nothing has not passed"
    assert [one.code for one in found.diagnostics] == ["SPC204"]
    assert loaded(EXACT, checks=off).spec.settings.switched_off("TOY101") == "a show piece"  # type: ignore[union-attr]


def test_a_load_that_no_solver_gave_is_undecided() -> None:
    spec = loaded(EXACT).spec
    assert spec is not None
    ruling = rule(OVERLOAD, spec, Hang(), {})
    assert ruling.verdict is Verdict.UNDECIDED
    assert ruling.value is None
    assert ruling.limit == Estimate.exact(toys.LIMIT)
    assert "no solver could compute pull" in ruling.reason


def test_the_bad_side_is_undecided_with_the_reason() -> None:
    found = judgement(report(kind_of(solver("rough", pull(9, 11)))))
    assert found.verdict is Verdict.UNDECIDED
    assert found.reason == "the error bar straddles the limit"


def test_a_sound_verdict_needs_no_reason() -> None:
    assert judgement(report(EXACT)).reason == ""


@pytest.mark.parametrize(
    ("sense", "value", "margin"),
    [(MOST, 9.0, 1 * KN), (MOST, 12.0, -2 * KN), (LEAST, 12.0, 2 * KN), (LEAST, 9.0, -1 * KN)],
)
def test_the_margin_is_positive_on_the_sound_side(sense: Sense, value: float, margin: float) -> None:
    held = replace(OVERLOAD, sense=sense)
    ruling = Ruling(held, Verdict.PASS, pull(value), pull(10.0), ())
    assert ruling.margin == pytest.approx(margin)


def test_a_check_may_make_its_value_of_several_loads() -> None:
    both = replace(
        OVERLOAD,
        loads=("pull", "wind"),
        value=lambda spec, scene, loads: Estimate.exact(loads["pull"].value + loads["wind"].value),
    )
    spec = loaded(EXACT).spec
    assert spec is not None
    ruling = rule(both, spec, Hang(), {"pull": pull(6.0), "wind": pull(4.5)})
    assert (ruling.verdict, ruling.value) == (Verdict.FAIL, pull(10.5))
    assert rule(both, spec, Hang(), {"pull": pull(6.0)}).reason == "no solver could compute wind"


class Fly(Scene):
    """A scene that no check of the toy knows."""

    type: str = "fly"


def test_a_check_is_held_against_its_own_scenes_only() -> None:
    spec = loaded(EXACT).spec
    assert spec is not None
    assert [one.check.code for one in judge(EXACT, spec, Hang(), {"pull": pull(9.0)})] == ["TOY101"]
    assert judge(EXACT, spec, Fly(), {"pull": pull(9.0)}) == ()
