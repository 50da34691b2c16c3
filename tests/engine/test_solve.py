"""The value of one key at which a check just passes, on toys whose boundary is known in closed form."""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest
from support.toy_kind import OVERLOAD, SHOCK, STATICS
from support.toys import KN, LIMIT, effect, judgement, kind_of, loaded, pull, report, solver

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.errors import UsageError
from ptmcalc.base.estimate import ANYTHING, Estimate, Interval
from ptmcalc.base.span import KeyPath, key_path
from ptmcalc.contract.check import AnyCheck, Sense
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.result import Found, Result
from ptmcalc.engine.judge import decide
from ptmcalc.engine.solve import Solution, solve

HOOK = kind_of(STATICS)  # pull = shock x share x load, at most the strength


def solution(kind: AnyKind, key: str, check: AnyCheck = OVERLOAD, scene: str = "", **data: Any) -> Solution | None:
    return solve(loaded(kind, **data), check, key_path(key), scene)


def value(kind: AnyKind, key: str, check: AnyCheck = OVERLOAD, scene: str = "", **data: Any) -> float:
    found = solution(kind, key, check, scene, **data)
    assert found is not None
    return found.value


def finds(pull_of: Callable[[Any], Estimate]) -> AnyKind:
    """A toy whose solver makes its pull of the spec."""
    run = replace(
        solver("top", pull(0)), run=lambda spec, scene, carried, level: Result({"pull": Found(pull_of(spec))})
    )
    return kind_of(run)


@pytest.mark.parametrize(
    ("key", "data", "boundary", "rounded"),
    [
        ("load", {"load": "12 kN", "shock": 1.1}, 10e3 / 1.1, 9.09e3),
        ("load", {"load": "9 MN", "shock": 1}, 10e3, 10e3),
        ("strength", {"load": "12.34 kN", "shock": 1.1}, 13.574e3, 13.58e3),
        ("strength", {"load": "7 N", "shock": 1.1111, "strength": "3 N"}, 7.7777, 7.778),
        ("shock", {"load": "7 kN", "shock": 2}, 10 / 7, 1.428),
        ("shock", {"load": "12 kN", "shock": 1}, 10 / 12, 0.8333),
    ],
)
def test_the_boundary_is_found_to_four_digits_on_the_passing_side(
    key: str, data: dict[str, Any], boundary: float, rounded: float
) -> None:
    """`rounded` is the boundary cut or raised to 4 digits by hand."""
    found = value(HOOK, key, **data)
    assert found == pytest.approx(boundary, rel=1e-3)
    assert found == pytest.approx(rounded, rel=1e-12)


@pytest.mark.parametrize(("key", "towards"), [("load", -1), ("strength", 1), ("shock", -1)])
def test_the_value_passes_and_the_next_in_its_last_digit_does_not(key: str, towards: int) -> None:
    given: dict[str, Any] = {"load": "12 kN", "shock": 1.037}
    found = value(HOOK, key, **given)

    def verdict(number: float) -> Verdict:
        written = number if key == "shock" else f"{number:.17g} N"
        return judgement(report(HOOK, **given | {key: written})).verdict

    last_digit = 10 ** (math.floor(math.log10(found)) - 3)
    assert verdict(found) is Verdict.PASS
    assert verdict(found - towards * last_digit) is Verdict.FAIL


def test_a_check_from_below_is_solved_too() -> None:
    """At least 10 kN of ballast: the boundary lies above the present value."""
    ballast = replace(OVERLOAD, sense=Sense.AT_LEAST)
    assert value(replace(HOOK, checks=(ballast,)), "load", ballast, load="3 kN", shock=1.07) == pytest.approx(
        9.346 * KN, rel=1e-9
    )


def test_the_error_bar_is_included() -> None:
    """A bar of 5 % either way: its upper end, not the value, comes to the limit."""
    kind = finds(lambda spec: Estimate.within(spec.load, 0.05 * spec.load))
    assert value(kind, "load", load="20 kN") == pytest.approx(9.523 * KN, rel=1e-9)  # 10/1.05 = 9.5238...
    assert decide(Estimate.within(9523, 0.05 * 9523), Estimate.exact(10 * KN), Sense.AT_MOST) is Verdict.PASS


def test_the_error_bar_is_included_from_below() -> None:
    ballast = replace(OVERLOAD, sense=Sense.AT_LEAST)
    kind = replace(finds(lambda spec: Estimate.within(spec.load, 0.05 * spec.load)), checks=(ballast,))
    assert value(kind, "load", ballast, load="2 kN") == pytest.approx(10.53 * KN, rel=1e-9)  # 10/0.95 = 10.526...


@pytest.mark.parametrize("power", [0.3, 1.0, 3.0, 9.0])
@pytest.mark.parametrize("boundary", [1.0007, 4.5678, 9.9993])
@pytest.mark.parametrize("start", ["150 kN", "20 kN"])
def test_a_curved_boundary_is_found_as_well(power: float, boundary: float, start: str) -> None:
    """Pull = 10 kN (load/boundary)^power: the value passes, and lies within 4 digits of the boundary."""
    kind = finds(lambda spec: Estimate.exact(LIMIT * (spec.load / (boundary * KN)) ** power))
    found = value(kind, "load", load=start)
    assert found <= boundary * KN
    assert found >= boundary * KN * (1 - 1.3e-3)  # a bracket of 3e-4, and one unit of the last digit


@pytest.mark.parametrize("start", ["3.4 kN", "12 kN", "90 kN"])
def test_the_edge_of_a_count_is_found_as_well(start: str) -> None:
    """So many pieces of 3.3 kN as the load takes, at most two: the clearance is 0 or a whole number everywhere."""
    kind = finds(lambda spec: Estimate.exact(LIMIT / 2 * math.ceil(spec.load / (3.3 * KN))))
    assert value(kind, "load", load=start) == pytest.approx(6.6 * KN, rel=6e-4)


@pytest.mark.parametrize("fine", [1e-4, 3e-3])
def test_what_a_step_the_wrong_way_passes_too_is_no_answer(fine: float) -> None:
    """Pull = 10 kN (load/5 kN)^(1/20), known to 0.4 % by the runs of the search: that alone ends 8 % below 5 kN.

    By all refinements it passes up to 5 kN (1 + fine)^(-20), and 1 % beyond the answer it does not.
    """

    def run(spec: Any, scene: Any, carried: frozenset[str], level: int) -> Result:
        pulls = LIMIT * (spec.load / (5 * KN)) ** (1 / 20)
        return Result({"pull": Found(Estimate.within(pulls, (4e-3 if level < 3 else fine) * pulls))})

    found = value(kind_of(replace(solver("top", pull(0)), run=run, levels=4)), "load", load="6 kN")
    edge = 5 * KN * (1 + fine) ** -20
    assert edge * (1 - 0.0101) <= found <= edge


@pytest.mark.parametrize("power", [1, -1])
def test_a_key_that_all_refinements_let_be_anything_has_no_boundary(power: int) -> None:
    """A pull of 9 kN whatever the load: what 5 kN of it bounds is the bar of the runs of the search alone."""

    def run(spec: Any, scene: Any, carried: frozenset[str], level: int) -> Result:
        bar = KN * (spec.load / (5 * KN)) ** power if level < 3 else 0.0
        return Result({"pull": Found(Estimate.within(9 * KN, bar))})

    assert solution(kind_of(replace(solver("top", pull(0)), run=run, levels=4)), "load", load="6 kN") is None


def test_the_bound_of_an_effect_is_included() -> None:
    swinging = kind_of(STATICS, effects=[effect("swing", bound=Interval(0, KN))])
    assert value(swinging, "load", load="12 kN", shock=1) == pytest.approx(9 * KN, rel=1e-9)


@pytest.mark.parametrize(
    "pull_of",
    [
        lambda spec: Estimate.exact(20 * KN),  # the key does not move it
        lambda spec: Estimate.unknown(1.0),
        lambda spec: Estimate.exact(math.nan),
        lambda spec: Estimate.exact(math.inf),
    ],
    ids=["constant", "no bound", "nan", "infinite"],
)
def test_there_is_none_when_no_value_passes(pull_of: Callable[[Any], Estimate]) -> None:
    assert solution(finds(pull_of), "load", load="12 kN") is None


@pytest.mark.parametrize(("load", "found"), [("9 MN", True), ("11 MN", False)])
def test_three_decades_are_searched(load: str, found: bool) -> None:
    assert (solution(HOOK, "load", load=load, shock=1) is not None) == found


def test_there_is_none_when_an_input_is_missing() -> None:
    assert solution(HOOK, "load", strength=None, load="12 kN") is None


def test_there_is_none_when_no_scene_is_held_against_the_check() -> None:
    assert solution(HOOK, "load", replace(OVERLOAD, scenes=frozenset()), load="12 kN") is None


def test_a_check_switched_off_has_no_solution() -> None:
    assert solution(HOOK, "load", load="12 kN", checks={"TOY101": {"off": "a show piece"}}) is None


def test_no_value_outside_the_range_of_its_key_is_tried() -> None:
    tried: list[float] = []

    def noted(spec: Any) -> Estimate:
        tried.append(spec.accuracy)
        return Estimate.exact(20 * KN)

    assert solution(finds(noted), "accuracy", accuracy="50 %") is None  # above 0, at most 1
    assert min(tried) < 0.5
    assert max(tried) == 0.8891  # 0.5 x 10^0.25 in four digits; the next step up would be 1.58


def test_from_a_value_that_passes_the_boundary_is_found_too() -> None:
    """Strength 10 kN over a shock of 1.1 carries 9.09 kN, from whichever side one comes."""
    found = value(HOOK, "load", load="8 kN", shock=1.1)
    assert found == pytest.approx(10 * KN / 1.1, rel=1e-3)
    assert found <= 10 * KN / 1.1


@pytest.mark.parametrize(
    "key",
    ["name", "kind", "nothing", "load.value", "checks", "scenes", "scenes[0]", "scenes[3].share", "effects", "shock"],
)
def test_a_key_that_is_no_number_of_the_file_is_refused(key: str) -> None:
    with pytest.raises(UsageError, match="is not a number that can be varied"):
        solution(HOOK, key, load="12 kN", name="hook", scenes=[{"type": "hang"}])


def test_a_key_inside_a_list_can_be_varied() -> None:
    scenes = [{"type": "hang", "name": "calm"}, {"type": "hang", "name": "gust", "share": 3}]
    found = solution(HOOK, "scenes[1].share", load="8 kN", shock=1, scenes=scenes)
    assert found is not None
    assert (found.path, found.value) == (("scenes", 1, "share"), pytest.approx(1.25))


SCENES = [{"type": "hang", "name": "calm", "share": 0.5}, {"type": "hang", "name": "gust", "share": 2}]


@pytest.mark.parametrize(("scene", "expected"), [("", 5.0), ("gust", 5.0), ("calm", 20.0)])
def test_the_worst_of_the_scenes_counts_or_the_one_that_is_named(scene: str, expected: float) -> None:
    assert value(HOOK, "load", scene=scene, load="50 kN", shock=1, scenes=SCENES) == pytest.approx(expected * KN)


def test_the_answer_carries_its_key_and_quantity() -> None:
    found = solution(HOOK, "load", load="12 kN", shock=1)
    assert found is not None
    path: KeyPath = ("load",)
    assert (found.path, found.quantity.si) == (path, "N")


def test_the_repair_of_a_failed_check_is_that_value() -> None:
    repair = judgement(report(HOOK, load="12 kN", shock=1.1)).repair
    assert repair is not None
    assert (repair.path, repair.value) == (("load",), pytest.approx(9.09 * KN))


@pytest.mark.parametrize(
    "data", [{"load": "8 kN", "shock": 1}, {"load": "12 kN", "shock": 1, "strength": None}], ids=["pass", "not checked"]
)
def test_only_a_failed_check_is_repaired(data: dict[str, Any]) -> None:
    assert judgement(report(HOOK, **data)).repair is None


def test_a_check_without_a_repair_key_fails_without_one() -> None:
    kind = replace(HOOK, checks=(replace(OVERLOAD, repair=lambda spec, scene: ()),))
    found = judgement(report(kind, load="12 kN"))
    assert (found.verdict, found.repair) == (Verdict.FAIL, None)


def test_unbounded_effects_leave_no_solution() -> None:
    kind = kind_of(STATICS, effects=[effect("swing", bound=ANYTHING)])
    assert solution(kind, "load", load="12 kN") is None


def test_the_value_passes_whatever_is_assumed() -> None:
    """A shock of 1.1 is assumed and may be 1.2: a weight that passes at 1.1 alone would leave the file undecided."""
    kind = kind_of(STATICS, assumptions=(SHOCK,))
    repair = judgement(report(kind, load="12 kN")).repair
    assert repair is not None
    assert judgement(report(kind, load=f"{repair.value} N")).verdict is Verdict.PASS
