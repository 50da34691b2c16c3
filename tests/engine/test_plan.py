"""Spec -> plan: which effects a scene calls for, and the ladder of runs."""

import math
from dataclasses import replace

import pytest
from support.toy_kind import Hang
from support.toys import effect, kind_of, loaded, planned, pull, scene_plan, solver

from ptmcalc.engine.plan import plan

ANY = pull(9.0)


@pytest.mark.parametrize(
    ("number", "wish", "active", "excluded", "forced"),
    [
        (0.2, None, True, False, False),
        (0.1, None, True, False, False),  # the threshold itself calls for it
        (math.nextafter(0.1, 0.0), None, False, False, False),
        (math.inf, None, True, False, False),
        (0.2, "auto", True, False, False),
        (0.05, "auto", False, False, False),
        (0.05, "on", True, False, True),
        (0.2, "off", False, True, True),
        (0.05, "off", False, True, True),
        (None, None, False, True, False),  # an input it needs is not given
        (None, "off", False, True, True),
    ],
)
def test_the_number_or_the_file_decides_about_an_effect(
    number: float | None, wish: str | None, active: bool, excluded: bool, forced: bool
) -> None:
    kind = kind_of(solver("only", ANY), effects=[effect("waves", number, threshold=0.1)])
    found = planned(scene_plan(kind, **({"effects": {"waves": wish}} if wish else {})), "waves")
    assert (found.active, found.excluded, found.forced) == (active, excluded, forced)
    assert found.must_run == (forced and not excluded)


@pytest.mark.parametrize("wish", ["auto", "on", "off"])
def test_what_lacks_an_input_is_never_carried(wish: str) -> None:
    kind = kind_of(solver("rich", ANY, carries=("waves", "sag")), effects=[effect("waves"), effect("sag", number=None)])
    scene = scene_plan(kind, effects={"sag": wish})
    assert {rung.carried for rung in scene.rungs} == {frozenset({"waves"})}
    assert scene.excluded == {"sag"}


def test_an_effect_is_planned_only_in_its_scenes() -> None:
    kind = kind_of(solver("only", ANY), effects=[replace(effect("waves"), scenes=frozenset())])
    assert scene_plan(kind).effects == ()


def test_rungs_go_from_cheap_to_dear_whatever_the_order_of_the_kind() -> None:
    kind = kind_of(solver("dear", ANY, seconds=1.0), solver("cheap", ANY, seconds=0.1, levels=3))
    rungs = scene_plan(kind).rungs
    assert [(rung.solver.name, rung.level) for rung in rungs] == [
        ("cheap", 0),
        ("dear", 0),
        ("cheap", 1),
        ("cheap", 2),
    ]
    assert [rung.seconds for rung in rungs] == pytest.approx([0.1, 1.0, 1.0, 10.0])


def test_a_solver_is_offered_with_the_active_effects_and_with_all_it_can_carry() -> None:
    effects = [effect("active", 1.0), effect("small", 0.01), effect("foreign", 1.0)]
    kind = kind_of(solver("rich", ANY, carries=("active", "small")), effects=effects)
    carried = [rung.carried for rung in scene_plan(kind).rungs]
    assert carried == [{"active"}, {"active", "small"}]


def test_equal_sets_of_effects_are_offered_once() -> None:
    kind = kind_of(solver("rich", ANY, carries=("a", "b")), effects=[effect("a"), effect("b")])
    assert [rung.carried for rung in scene_plan(kind).rungs] == [{"a", "b"}]


def test_a_solver_that_carries_effects_is_not_run_without_any() -> None:
    kind = kind_of(solver("rich", ANY, carries=("a",)), effects=[effect("a")])
    assert scene_plan(kind, effects={"a": "off"}).rungs == ()


def test_a_part_brings_its_whole_along() -> None:
    effects = [effect("waves", 0.01), effect("echo", 1.0, part_of="waves")]
    kind = kind_of(solver("rich", ANY, carries=("waves", "echo")), effects=effects)
    assert all(rung.carried == {"waves", "echo"} for rung in scene_plan(kind).rungs)


def test_a_part_is_not_carried_where_its_whole_is_forced_off() -> None:
    effects = [effect("waves", 1.0), effect("echo", 1.0, part_of="waves"), effect("slip", 1.0)]
    kind = kind_of(solver("rich", ANY, carries=("waves", "echo", "slip")), effects=effects)
    carried = {rung.carried for rung in scene_plan(kind, effects={"waves": "off"}).rungs}
    assert carried <= {frozenset({"slip"})}


def test_a_formula_that_never_decides_is_no_rung() -> None:
    scene = scene_plan(kind_of(solver("top", ANY), solver("textbook", ANY, decides=False)))
    assert [rung.solver.name for rung in scene.rungs] == ["top"]
    assert [one.name for one in scene.formulas] == ["textbook"]


def test_a_solver_outside_its_range_or_scene_is_not_offered() -> None:
    kind = kind_of(
        solver("top", ANY),
        solver("outside", ANY, valid=False),
        solver("formula outside", ANY, valid=False, decides=False),
        solver("other scene", ANY, scenes=frozenset()),
    )
    scene = scene_plan(kind)
    assert [rung.solver.name for rung in scene.rungs] == ["top"]
    assert scene.formulas == ()


def test_scenes_may_be_chosen() -> None:
    kind = kind_of(solver("top", ANY))
    spec = loaded(kind, scenes=[{"type": "hang", "name": "calm"}, {"type": "hang", "name": "gust"}]).spec
    assert spec is not None
    assert [scene.scene.label for scene in plan(kind, spec).scenes] == ["calm", "gust"]
    assert [scene.scene.label for scene in plan(kind, spec, spec.all_scenes[1:]).scenes] == ["gust"]


def test_planning_runs_nothing() -> None:
    def must_not_run(carried: frozenset[str], level: int) -> None:
        raise AssertionError("a plan is made without running a solver")

    scene = scene_plan(kind_of(solver("top", must_not_run, levels=2), solver("shown", must_not_run, decides=False)))  # type: ignore[arg-type]
    assert scene.scene == Hang()
    assert len(scene.rungs) == 2
