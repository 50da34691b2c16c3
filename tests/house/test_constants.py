"""Every numeric constant of a module states its reason: unit, origin, and the effect of another value."""

import ast
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import TypeGuard

from support.command import ROOT

ROOMS = ("ptmcalc/engine", "ptmcalc/machines")
"""Folders whose constants are examined."""
Assignment = ast.Assign | ast.AnnAssign


def is_constant(node: ast.stmt) -> TypeGuard[Assignment]:
    """Whether a statement assigns numbers as written: nothing is called or deferred."""
    if not isinstance(node, ast.Assign | ast.AnnAssign) or node.value is None:
        return False
    parts = list(ast.walk(node.value))
    numbers = [one for one in parts if isinstance(one, ast.Constant) and type(one.value) in (int, float)]
    return bool(numbers) and not any(isinstance(one, ast.Call | ast.Lambda) for one in parts)


def is_text(node: ast.stmt | None) -> bool:
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)


def names_of(node: Assignment) -> str:
    targets = node.targets if isinstance(node, ast.Assign) else [node.target]
    return ", ".join(ast.unparse(target) for target in targets)


def without_reason(source: str) -> Iterator[tuple[int, str]]:
    """(line, names) of every constant with neither a text below it nor a comment on its last line."""
    lines = source.splitlines()
    for node, following in pairwise([*ast.parse(source).body, None]):
        if is_constant(node) and not is_text(following) and "#" not in lines[(node.end_lineno or node.lineno) - 1]:
            yield node.lineno, names_of(node)


def modules() -> Iterator[Path]:
    for room in ROOMS:
        yield from sorted((ROOT / room).rglob("*.py"))


def test_every_numeric_constant_of_a_module_states_its_reason() -> None:
    examples = "_A = 3.0\n_B = 1  # s\n_C: float = 2.0\n'''s; derived'''\n_D = f(1)\n_E, _F = 1, 2\n_G = {'a': (1, 2)}"
    assert list(without_reason(examples)) == [(1, "_A"), (6, "(_E, _F)"), (7, "_G")]
    found = [
        f"{path.relative_to(ROOT).as_posix()}:{line} {names}"
        for path in modules()
        for line, names in without_reason(path.read_text("utf-8"))
    ]
    assert found == []
