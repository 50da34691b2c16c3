"""What a baseline knows: no other scene, no other element, no worse value, no lost bound, no stricter limit."""

import json
import math
from dataclasses import replace
from pathlib import Path

import pytest

from ptmcalc.base.diagnostic import Diagnostic, Severity, Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import Span
from ptmcalc.base.units import FORCE
from ptmcalc.contract.check import Sense
from ptmcalc.contract.report import FileReport, Judgement, Place, SceneReport
from ptmcalc.engine.baseline import apart_from, baseline_of, read_baseline

INF = math.inf
PLACE = Place(("rope", "strength"), Span(1, 1))
FAIL, UNDECIDED, NOT_CHECKED = Verdict.FAIL, Verdict.UNDECIDED, Verdict.NOT_CHECKED


def judged(
    value: Estimate | None = None,
    verdict: Verdict = FAIL,
    limit: float = 4.0,
    sense: Sense = Sense.AT_LEAST,
    element: str = "",
    found: bool = False,
) -> Judgement:
    margin = None if value is None or found else value.value - limit
    ends = Estimate.exact(limit)
    return Judgement("TOY101", "strength", verdict, value, ends, sense, FORCE, margin, PLACE, element)


def report(*checks: Judgement, scene: str = "run", said: tuple[str, ...] = (), file: str = "a.yaml") -> FileReport:
    warnings = tuple(Diagnostic("NUM101", one, severity=Severity.WARNING) for one in said)
    return FileReport(file, diagnostics=warnings, scenes=(SceneReport(scene, "run", (), (), (), checks, {}),))


def against(now: FileReport, then: FileReport, folder: Path) -> FileReport:
    path = folder / "known.json"
    here = (replace(one, path=str(folder / one.path)) for one in (then, now))
    then, now = here
    path.write_text(baseline_of([then], folder), encoding="utf-8")
    (found,), _ = apart_from([now], read_baseline(path), folder)
    return found


def waived(now: Judgement, then: Judgement, folder: Path) -> bool:
    (found,) = (one for _, one in against(report(now), report(then), folder).judgements)
    return found.verdict is Verdict.WAIVED


BAR = Estimate(3.0, 2.9, 3.1)


@pytest.mark.parametrize(
    ("now", "then", "known"),
    [
        (judged(BAR), judged(BAR), True),
        (judged(Estimate(3.3, 3.2, 3.4)), judged(BAR), True),
        (judged(Estimate(2.75, 2.65, 2.95)), judged(BAR), True),
        (judged(Estimate(2.7, 2.65, 2.85)), judged(BAR), False),
        (judged(Estimate.exact(3.0 * (1 - 1e-12))), judged(Estimate.exact(3.0)), True),
        (judged(Estimate.exact(3.0 * (1 - 1e-6))), judged(Estimate.exact(3.0)), False),
        (judged(BAR, limit=4.5), judged(BAR), False),
        (judged(BAR, limit=3.5), judged(BAR), True),
        (judged(Estimate(5.0, 4.9, 5.1), sense=Sense.AT_MOST), judged(Estimate.exact(4.8), sense=Sense.AT_MOST), False),
        (judged(Estimate(4.6, 4.5, 4.7), sense=Sense.AT_MOST), judged(Estimate.exact(4.8), sense=Sense.AT_MOST), True),
        (judged(BAR, sense=Sense.AT_MOST, limit=1), judged(BAR, sense=Sense.AT_MOST, limit=2), False),
        (judged(BAR), judged(BAR, UNDECIDED), False),
        (judged(Estimate(3.9, 3.8, 4.1), UNDECIDED), judged(BAR), True),
        (judged(Estimate(3.9, -INF, 4.1), UNDECIDED), judged(Estimate(3.9, 3.8, 4.1), UNDECIDED), False),
        (judged(Estimate(3.9, -INF, 4.1), UNDECIDED), judged(Estimate(3.9, -INF, 4.1), UNDECIDED), True),
        (judged(Estimate.exact(-INF)), judged(BAR), False),
        (judged(Estimate(math.nan, -INF, INF), UNDECIDED), judged(Estimate(math.nan, -INF, INF), UNDECIDED), True),
        (judged(None, NOT_CHECKED), judged(None, NOT_CHECKED), True),
        (judged(None, UNDECIDED), judged(BAR, UNDECIDED), False),
        (judged(BAR, found=True), judged(BAR, found=True), True),
        (judged(BAR, found=True), judged(BAR), False),
        (judged(BAR, element="rope 2"), judged(BAR, element="rope 1"), False),
    ],
)
def test_what_is_no_worse_beyond_the_bars_is_known(
    now: Judgement, then: Judgement, known: bool, tmp_path: Path
) -> None:
    assert waived(now, then, tmp_path) is known


def test_another_scene_or_file_is_not_known(tmp_path: Path) -> None:
    assert against(report(judged(BAR), scene="stop"), report(judged(BAR)), tmp_path).verdict == "fail"
    assert against(report(judged(BAR), file="b.yaml"), report(judged(BAR)), tmp_path).verdict == "fail"


def test_both_numbers_are_told(tmp_path: Path) -> None:
    (same,) = (one for _, one in against(report(judged(BAR)), report(judged(BAR)), tmp_path).judgements)
    assert same.reason == "fail, known from the baseline: 3 N [2.9 N, 3.1 N] then, 3 N [2.9 N, 3.1 N] now"
    now = judged(Estimate.exact(1.185), limit=5.0)
    (worse,) = (one for _, one in against(report(now), report(judged(BAR)), tmp_path).judgements)
    assert worse.verdict is FAIL
    assert worse.reason == ("worse than in the baseline: 3 N [2.9 N, 3.1 N] then, 1.185 N now; limit 4 N then, 5 N now")


def test_a_warning_is_known_for_its_scenes_only(tmp_path: Path) -> None:
    then = report(said=("scenes `a`, `b`: it did not converge at 3 s",))
    assert against(report(said=("scene `b`, elements: it did not converge at 7 s",)), then, tmp_path).diagnostics == ()
    assert len(against(report(said=("scenes `b`, `c`: it did not converge",)), then, tmp_path).diagnostics) == 1
    assert len(against(report(said=("it did not converge",)), then, tmp_path).diagnostics) == 1


def test_a_baseline_is_plain_json_whatever_the_numbers(tmp_path: Path) -> None:
    def refuse(word: str) -> float:
        raise ValueError(word)

    text = baseline_of([report(judged(Estimate.exact(INF)), judged(Estimate(1.0, -INF, 2.0)))], tmp_path)
    assert json.loads(text, parse_constant=refuse)["schema_version"] == "2"
