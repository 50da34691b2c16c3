"""What the engine makes of relations between loads, failures found by runs, and windows that end too early."""

import math
from dataclasses import replace
from typing import Any

import pytest
from support.toy_kind import PULL, Hang
from support.toys import KN, judgement, kind_of, pull, report, solver

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.base.units import FORCE
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.relation import Relation, computed, ordered
from ptmcalc.contract.report import FileReport
from ptmcalc.contract.result import Failure, Found, LoadInfo, Result
from ptmcalc.engine.relate import narrowed, related

HANGING = frozenset({Hang})
TOP = LoadInfo("top", "pull at the top", FORCE)
LARGER = ordered("top", "pull", HANGING, "the pull at the top is at least that on the hook")


def two_loads(on_hook: Estimate, at_top: Estimate, *relations: Relation) -> AnyKind:
    finds = solver("both", lambda carried, level: {"pull": on_hook, "top": at_top}, gives=("pull", "top"))
    return kind_of(finds, loads=(PULL, TOP), relations=relations)


def load(found: FileReport, name: str) -> Estimate:
    (scene,) = found.scenes
    return next(one.estimate for one in scene.loads if one.info.name == name)


def codes(found: FileReport) -> list[str]:
    return [one.code for one in found.diagnostics]


@pytest.mark.parametrize(
    ("interval", "expected"),
    [
        (Interval(0, 20), (8, 9, 10)),
        (Interval(9.5, 20), (9.5, 9.5, 10)),
        (Interval(0, 8.5), (8, 8.5, 8.5)),
        (Interval(8.2, 9.8), (8.2, 9, 9.8)),
    ],
)
def test_intervals_intersect(interval: Interval, expected: tuple[float, ...]) -> None:
    inside = narrowed(Estimate(9, 8, 10, numerical=1), interval)
    assert inside is not None
    assert (inside.low, inside.value, inside.high) == expected
    assert inside.numerical <= max(inside.high - inside.value, inside.value - inside.low)


def test_intervals_that_miss_each_other_have_no_common_part() -> None:
    assert narrowed(Estimate.exact(9.0), Interval(9.1, math.inf)) is None
    assert narrowed(Estimate.exact(9.0), Interval(9.0 * (1 + 1e-12), math.inf)) == Estimate.exact(9.0), "rounding"


def test_a_relation_narrows_the_error_bars_of_a_report() -> None:
    found = report(two_loads(pull(9.0), pull(6, 12), LARGER))
    assert (load(found, "top").low, load(found, "top").high) == (9 * KN, 12 * KN)
    assert found.verdict == "pass"


def test_loads_that_contradict_each_other_make_their_checks_undecided() -> None:
    found = report(two_loads(pull(9.0), pull(7, 8), LARGER))
    assert codes(found) == ["NUM111"]
    assert judgement(found).verdict is Verdict.UNDECIDED
    assert LARGER.why in judgement(found).reason
    assert report(two_loads(pull(9.0), pull(7, 8))).verdict == "pass", "without the relation nothing is seen"


def test_a_computed_load_lies_between_the_corners_of_the_others() -> None:
    half = computed("top", ("pull",), lambda spec, scene, loads: loads["pull"] / 2, HANGING, "half of the pull")
    found = report(two_loads(pull(8, 9), pull(1, 20), half))
    assert (load(found, "top").low, load(found, "top").high) == (4 * KN, 4.5 * KN)


def test_a_relation_holds_for_each_part_of_a_family() -> None:
    loads = {"pull[a]": pull(9.0), "top[a]": pull(7, 8), "pull[b]": pull(9.0), "top[b]": pull(8, 11), "pull": pull(1.0)}
    kind = two_loads(pull(9.0), pull(9.0), LARGER)
    found, broken = related(kind, None, Hang(), loads)  # type: ignore[arg-type]
    assert set(broken) == {"pull[a]", "top[a]"}
    assert found["top[b]"].low == 9 * KN


def test_runs_whose_error_bars_do_not_intersect_leave_the_check_undecided() -> None:
    """The rough run bounds the pull to 8 to 12 kN, the fine one to 7 kN: one of them is wrong."""
    kind = kind_of(solver("rough", pull(8, 12)), solver("fine", pull(7), seconds=1.0))
    found = report(kind)
    assert codes(found) == ["NUM111"]
    assert judgement(found).verdict is Verdict.UNDECIDED


# -- failures and windows -------------------------------------------------------------------------------------------


def found_by(name: str, estimate: Estimate, **parts: Any) -> AnyKind:
    def run(spec: Any, scene: Any, carried: frozenset[str], level: int) -> Result:
        return Result({"pull": Found(estimate)}, work=1, window=(0.0, 4.0), **parts)

    return kind_of(replace(solver(name, estimate), run=run))


def test_what_a_run_finds_is_a_failed_check_whatever_its_number() -> None:
    failure = Failure("TOY101", "the hook opens at 1.2 s", ("strength",), "choose a latch")
    one = judgement(report(found_by("opens", pull(9.0), failures=(failure,))))
    assert (one.verdict, one.reason) == (Verdict.FAIL, "the hook opens at 1.2 s; choose a latch")
    assert one.blame.path == ("strength",)
    assert one.margin is None, "the number does not decide"


def test_a_failure_of_another_check_changes_nothing() -> None:
    assert report(found_by("opens", pull(9.0), failures=(Failure("TOY999", "no"),))).verdict == "pass"


def test_loads_that_can_still_grow_are_undecided_with_the_state_at_the_end() -> None:
    found = report(found_by("short", pull(9.0), beyond={"pull": Interval(0, math.inf)}, open_end="hook at 1 of 3 m/s"))
    one = judgement(found)
    assert one.verdict is Verdict.UNDECIDED
    assert "computed to 4 s, hook at 1 of 3 m/s" in one.reason
    assert codes(found) == ["NUM112"]


def test_loads_that_exceed_the_limit_already_fail_although_the_window_is_open() -> None:
    found = report(found_by("short", pull(11.0), beyond={"pull": Interval(0, math.inf)}, open_end="swinging"))
    assert judgement(found).verdict is Verdict.FAIL


def test_a_repair_is_not_offered_for_a_failure_that_no_value_cures() -> None:
    failure = Failure("TOY101", "the hook opens", ("strength",))
    one = judgement(report(found_by("opens", pull(9.0), failures=(failure,))))
    assert one.repair is None
    assert one.tried == "no value of strength from 10 N to 10 MN passes"


def test_a_failure_of_no_single_number_is_repaired_by_the_key_of_its_check() -> None:
    kind = found_by("opens", pull(9.0), failures=(Failure("TOY101", "the hook opens", ("scenes",)),))
    one = judgement(report(kind))
    assert one.blame.path == ("scenes",)
    assert one.tried == "no value of load from 8 N to 8 MN passes"
