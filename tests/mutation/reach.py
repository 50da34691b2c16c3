"""Which test runs which function of `laws` and `numerics`, and at what price: told by the functions themselves.

A copy of the package gets one statement in front of each function, which notes its name; as a plugin of pytest this
module keeps what each test noted. A function behind a cache notes only its first caller: whoever chooses tests takes
whole files, not single tests.
"""

import ast
import builtins
import json
import os
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

NOTED = "__noted__"
KEPT = "PTMCALC_MUTATION_KEPT"
CHOSEN = "PTMCALC_MUTATION_CHOSEN"

_found: dict[str, tuple[float, list[str]]] = {}


def name_of(path: Path, inside: str) -> str:
    """The name of a function: its module, without the package, and the functions and classes around it."""
    return f"{path.parent.name}.{path.stem}:{inside}"


def speaking(path: Path) -> str:
    """The source of a module with each of its functions noting its name when it runs."""

    def mark(node: ast.AST, inside: str) -> None:
        for child in ast.iter_child_nodes(node):
            if not isinstance(child, ast.FunctionDef | ast.ClassDef):
                mark(child, inside)
                continue
            name = f"{inside}.{child.name}" if inside else child.name
            mark(child, name)
            if isinstance(child, ast.FunctionDef):
                place = int(ast.get_docstring(child) is not None)
                child.body[place:place] = ast.parse(f"{NOTED}.add({name_of(path, name)!r})").body

    tree = ast.parse(path.read_text("utf-8"))
    mark(tree, "")
    return ast.unparse(ast.fix_missing_locations(tree))


def make_speak(package: Path) -> None:
    """Rewrites `laws` and `numerics` of a copy of the package."""
    start = package / "__init__.py"
    start.write_text(
        f"{start.read_text('utf-8')}\nimport builtins\n\nbuiltins.__dict__.setdefault({NOTED!r}, set())\n", "utf-8"
    )
    for room in ("laws", "numerics"):
        for path in (package / room).rglob("*.py"):
            path.write_text(speaking(path), "utf-8")


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Iterator[None]:
    noted: set[str] = builtins.__dict__.setdefault(NOTED, set())
    noted.clear()
    start = time.process_time()
    result = yield
    _found[item.nodeid] = (time.process_time() - start, sorted(noted))
    return result


def pytest_sessionfinish() -> None:
    if KEPT in os.environ and _found:
        Path(os.environ[KEPT], f"reach-{os.getpid()}.json").write_text(json.dumps(_found), "utf-8")


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Only the tests that were chosen, in the order they are named in."""
    if CHOSEN in os.environ:
        turn = {test: k for k, test in enumerate(json.loads(Path(os.environ[CHOSEN]).read_text("utf-8")))}
        config.hook.pytest_deselected(items=[item for item in items if item.nodeid not in turn])
        items[:] = sorted((item for item in items if item.nodeid in turn), key=lambda item: turn[item.nodeid])
