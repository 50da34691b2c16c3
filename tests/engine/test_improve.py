"""What to change, on toys whose boundary is known in closed form: pull = shock x share x load, at most the strength."""

from dataclasses import replace
from typing import Any

import pytest
from support.toy_kind import OVERLOAD, SHOCK, STATICS
from support.toys import kind_of, loaded

from ptmcalc.base.errors import UsageError
from ptmcalc.base.progress import followed
from ptmcalc.contract.check import at
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.improve import Improvement, improve
from ptmcalc.engine.levers import chosen, offered
from ptmcalc.engine.load import Loaded

TIGHT = replace(OVERLOAD, code="TOY102", limit=lambda spec, scene: OVERLOAD.limit(spec, scene), repair=at("strength"))
HOOK = kind_of(STATICS, checks=(OVERLOAD, TIGHT))
OPTIONS = Options(repairs=False)


def found(toy: Loaded, keys: str = "", **settings: Any) -> Improvement:
    report = check(toy, OPTIONS)
    return improve(toy, report, chosen(toy, keys, offered(toy, report)), OPTIONS, **settings)


def values(one: Improvement) -> dict[str, float]:
    return {answer.moves[0].lever.name: answer.moves[0].value for answer in one.answers if answer.whole}


@pytest.mark.parametrize("shock", [1.0, 1.25])
def test_the_values_lie_just_behind_the_boundary(shock: float) -> None:
    """12 kN x shock on a hook of 10 kN: at most 10 kN/shock, or a hook of at least 12 kN x shock."""
    answers = values(found(loaded(HOOK, load="12 kN", shock=shock)))
    assert 0.95 * 10e3 / shock <= answers["load"] <= 10e3 / shock
    assert 12e3 * shock <= answers["strength"] <= 1.05 * 12e3 * shock


def test_an_assumed_value_is_tried_at_both_ends_and_is_no_lever() -> None:
    """The shock is assumed from 1 to 1.2: 11 kN fail with 1.2 alone."""
    toy = loaded(kind_of(STATICS, assumptions=(SHOCK,)), load="9 kN", strength="10 kN")
    answers = values(found(toy))
    assert 0.95 * 10e3 / 1.2 <= answers["load"] <= 10e3 / 1.2
    assert "shock" not in answers


def test_what_passes_in_one_scene_alone_is_no_answer() -> None:
    """The hook bears twice the load in the second scene."""
    scenes = [{"type": "hang"}, {"type": "hang", "name": "twice", "share": 2.0}]
    one = found(loaded(HOOK, load="12 kN", shock=1.0, scenes=scenes))
    assert len(one.wanted) == 4
    assert 0.95 * 5e3 <= values(one)["load"] <= 5e3


def test_keys_without_work_budget_are_named() -> None:
    one = found(loaded(HOOK, load="12 kN", shock=1.0), seconds=(0.0, 0.0))
    assert {lever.name for lever in one.untried} == {"load", "strength"}
    assert not one.answers
    assert not one.solved


def test_keys_are_restricted_and_added() -> None:
    toy = loaded(HOOK, load="12 kN", shock=1.25)
    assert set(values(found(toy, "strength"))) == {"strength"}
    assert set(values(found(toy, "+shock"))) == {"load", "strength", "shock"}
    with pytest.raises(UsageError, match="`name` is not a number"):
        found(toy, "name")


def test_each_step_names_the_key_and_the_value() -> None:
    said: list[str] = []
    with followed(said.append):
        found(loaded(HOOK, load="12 kN", shock=1.0))
    assert any(text.startswith("load = ") and text.endswith("kN") for text in said)
    assert any(text.startswith("strength = ") and text.endswith(": all checks") for text in said)
