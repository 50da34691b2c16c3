"""Drives and brakes are called by one word: the names of loads and the paths of keys are read by it."""

import copy
from typing import Any

import pytest
import yaml
from support.machines import template

from ptmcalc.base.diagnostic import Diagnostic
from ptmcalc.contract.result import family
from ptmcalc.engine.load import load_text

BAD = ("a]b", "a[b", "slow drum", "two.5", "head:left", "]", " ", "a,b")
GOOD = ("head", "b2", "2", "slow-drum", "slow_drum", "привод", "Antrieb_Süd")


def text_with(block: str, *names: str) -> str:
    data = copy.deepcopy(template())
    part: dict[str, Any] = {"torque": "10 kN*m"}
    if block == "drives":
        part = data.pop("drive")
    data[block] = {name: copy.deepcopy(part) for name in names}
    return yaml.safe_dump(data, sort_keys=False, allow_unicode=True)


def problems(text: str) -> list[Diagnostic]:
    return list(load_text(text.encode(), "case.yaml").diagnostics)


@pytest.mark.parametrize("block", ["drives", "brakes"])
@pytest.mark.parametrize("name", BAD)
def test_a_name_that_makes_loads_ambiguous_is_refused_at_its_place(block: str, name: str) -> None:
    text = text_with(block, name)
    (problem,) = problems(text)
    assert (problem.code, problem.path) == ("SPC113", (block, name))
    assert problem.span is not None
    line = text.splitlines()[problem.span.line - 1]
    assert problem.span.column == 3
    assert name in line


@pytest.mark.parametrize("name", BAD)
def test_the_fix_can_be_copied(name: str) -> None:
    """The word it proposes is accepted, and is no other part's."""
    (problem,) = problems(text_with("drives", "slow_drum", "a_b", name))
    word = problem.hint.removeprefix("write `").removesuffix(":`")
    assert word not in {"slow_drum", "a_b"}
    assert problems(text_with("drives", "slow_drum", "a_b", word)) == []


@pytest.mark.parametrize("name", GOOD)
def test_a_word_is_a_name(name: str) -> None:
    assert problems(text_with("drives", name)) == []
    assert problems(text_with("brakes", name)) == []
    assert family(f"slip_heat[{name}]") == "slip_heat"


def test_all_bad_names_are_said_at_once() -> None:
    found = problems(text_with("brakes", "one", "a b", "a.b"))
    assert [problem.path for problem in found] == [("brakes", "a b"), ("brakes", "a.b")]
    assert len({problem.hint for problem in found}) == 2, "two names must not become one"


def test_a_curve_that_no_motor_has_is_said_where_the_start_asks_for_it() -> None:
    data = template()
    data["scenes"] = [{"type": "start", "profile": {"shape": "curve"}}]
    text = yaml.safe_dump(data, sort_keys=False)
    problem = load_text(text.encode(), "case.yaml").diagnostics[0]
    assert problem.path == ("scenes", 0, "profile", "shape")
    assert problem.span is not None
    assert "shape: curve" in text.splitlines()[problem.span.line - 1]
