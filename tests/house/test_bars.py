"""Every solver that decides and every effect has its bars held by a coverage test: none is forgotten."""

import ast
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from ptmcalc.engine.registry import kind_names, load_kind

COVERAGE = Path(__file__).parents[1] / "coverage"
NEEDED = {"misses", "wide", "opposites", "near"}
"""What a module asks of the bars it holds; of exact values `misses` and `opposites`."""


@cache
def modules() -> dict[str, ast.Module]:
    return {path.name: ast.parse(path.read_text("utf-8")) for path in sorted(COVERAGE.glob("test_*.py"))}


def said(name: str, word: str) -> dict[str, Any]:
    """What a module says of itself in a constant: names of solvers and effects by kind."""
    for node in modules()[name].body:
        if isinstance(node, ast.Assign) and any(isinstance(one, ast.Name) and one.id == word for one in node.targets):
            value = ast.literal_eval(node.value)
            assert isinstance(value, dict)
            return value
    return {}


def held(kind: str) -> set[str]:
    """Solvers and effects of a kind that some module holds."""
    return {
        one for name in modules() for word in ("ON_TRIAL", "WITHOUT_BARS") for one in said(name, word).get(kind, ())
    }


def asked(name: str) -> set[str]:
    """What a module calls of the harness."""
    calls = [node.func for node in ast.walk(modules()[name]) if isinstance(node, ast.Call)]
    return {one.attr for one in calls if isinstance(one, ast.Attribute)} | {
        one.id for one in calls if isinstance(one, ast.Name)
    }


def pieces(kind: str) -> set[str]:
    """Effects, and solvers whose loads decide."""
    family = load_kind(kind)
    return {
        piece.name
        for one in family.types or (family,)
        for piece in (*one.effects, *(solver for solver in one.solvers if solver.decides))
    }


@pytest.mark.parametrize("kind", kind_names())
def test_every_solver_and_effect_is_held(kind: str) -> None:
    missing = pieces(kind) - held(kind)
    assert missing == set(), (
        "name them in a module in tests/coverage: in ON_TRIAL if they have error bars, in WITHOUT_BARS if their values"
        " are exact; tests/coverage/test_bend_tensions.py is a short example"
    )


def test_what_is_said_to_be_held_is_there() -> None:
    stale = {kind: held(kind) - pieces(kind) for kind in kind_names()}
    assert {kind: names for kind, names in stale.items() if names} == {}


def test_a_module_that_holds_bars_asks_all_there_is_to_ask() -> None:
    for name in modules():
        if said(name, "ON_TRIAL"):
            assert asked(name) >= NEEDED, name
        elif said(name, "WITHOUT_BARS"):
            assert asked(name) >= {"misses", "opposites"}, name
