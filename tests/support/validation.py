"""The validation page: what is printed, what is computed, the difference and the tolerance of every worked case."""

import ast
import inspect
import linecache
import math
import os
import re
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from support.command import ROOT

PAGE = ROOT / "docs" / "validation.md"
UPDATE = bool(os.environ.get("PTMCALC_UPDATE"))
PASSED = pytest.StashKey[bool]()
Row = tuple[str, str, str, str, str]
"""What, expected, computed, difference, tolerance."""

_APPROX = pytest.approx
_LONGEST = 6
"""A list with more numbers is one row: its worst."""
_NOISE = 1e-9
"""A smaller relative difference is rounding's, and not the same on every machine."""
_HEAD = """\
# Validation

Every number of a worked case that a test in `tests/reference/` compares, as that test wrote it here: what was expected
(printed in the literature to that many digits, or a closed form), what ptmcalc computes, the difference, and the
tolerance of the test. Differences below 1e-9 are rounding and written as such. Each test fails when its rows on this
page are not what it finds; `python tests/update.py validation` writes the page anew.

The sources are named in the texts of the tests; `BW`, `CH` and `ST` are cases of belts, chains and stops, `C` those of
cranes, hoists, drives and shafts. A comparison without a number on one side (an order of events, a verdict) is in the
tests alone.
"""
_written: dict[str, dict[str, list[str]]] = {}


def recorder(rows: list[Row]) -> Callable[..., Any]:
    """A `pytest.approx` that keeps what it is compared with."""

    class Approx:
        def __init__(self, expected: Any, rel: float | None = None, abs: float | None = None) -> None:  # noqa: A002
            self.expected, self.rel, self.abs = expected, rel, abs
            self.inner = _APPROX(expected, rel=rel, abs=abs)

        def __eq__(self, found: object) -> bool:
            same = bool(found == self.inner)
            if same:
                rows.extend(_rows(_asked(), found, self.expected, self.rel, self.abs))
            return same

        __hash__ = None  # type: ignore[assignment]
        __array_ufunc__ = None
        __array_priority__ = 100

        def __repr__(self) -> str:
            return repr(self.inner)

    return Approx


def _asked() -> str:
    """The left side of the comparison in the test, as it is written there."""
    frame = sys._getframe(2)
    while frame is not None and "/tests/reference/" not in Path(frame.f_code.co_filename).as_posix():
        frame = frame.f_back  # type: ignore[assignment]
    return _left(frame.f_code.co_filename, frame.f_lineno) if frame is not None else ""


@cache
def _left(file: str, line: int) -> str:
    tree = _tree(file)
    best = ""
    for node in ast.walk(tree):
        if isinstance(node, ast.Assert) and node.lineno <= line <= (node.end_lineno or node.lineno):
            test = node.test
            best = ast.unparse(test.left) if isinstance(test, ast.Compare) else ast.unparse(test)
    return re.sub(r"\s+", " ", best)[:90]


@cache
def _tree(file: str) -> ast.Module:
    return ast.parse("".join(linecache.getlines(file)))


def _rows(what: str, found: Any, expected: Any, rel: float | None, tolerance: float | None) -> list[Row]:
    allowed = _allowed(rel, tolerance)
    if isinstance(expected, dict):
        return [_row(f"{what}: {key}", found[key], expected[key], allowed) for key in expected]
    ours, theirs = np.ravel(np.asarray(found, float)), np.ravel(np.asarray(expected, float))
    if theirs.size == 0 or ours.size != theirs.size:
        return []
    if theirs.size == 1:
        return [_row(what, float(ours[0]), float(theirs[0]), allowed)]
    if theirs.size <= _LONGEST:
        return [
            _row(f"{what}, {k + 1}", float(a), float(b), allowed)
            for k, (a, b) in enumerate(zip(ours, theirs, strict=True))
        ]
    worst = int(np.argmax(np.abs(ours - theirs)))
    return [_row(f"{what}, worst of {theirs.size}", float(ours[worst]), float(theirs[worst]), allowed)]


def _row(what: str, found: float, expected: float, allowed: str) -> Row:
    return what, _digits(expected), _digits(found, expected), _difference(found, expected), allowed


def _digits(value: float, beside: float | None = None) -> str:
    if beside is not None and beside == 0 and abs(value) < _NOISE:
        return "0"
    return f"{value:.6g}"


def _difference(found: float, expected: float) -> str:
    if math.isinf(expected) or found == expected:
        return "0"
    if expected == 0:
        return f"{found:.0e}" if abs(found) >= _NOISE else "below 1e-9"
    share = found / expected - 1
    return f"{share:+.0e}" if abs(share) >= _NOISE else "below 1e-9"


def _allowed(rel: float | None, tolerance: float | None) -> str:
    parts = [f"{rel:.0e}"] if rel is not None else []
    parts += [f"{tolerance:.0e} absolute"] if tolerance is not None else []
    return " or ".join(parts) or "1e-06"


def hold(item: pytest.Item, rows: list[Row]) -> None:
    """Compares the rows of a test with those of the page, or keeps them for the next one."""
    module, title, lines = Path(item.path).stem, heading(item), [_line(row) for row in _worst(rows)]
    if UPDATE:
        _written.setdefault(module, {})[title] = lines
        return
    on_page = sections().get(module, {}).get(title)
    assert on_page is not None, f"docs/validation.md has no `{title}` of {module}"
    assert len(on_page) == len(lines), f"docs/validation.md has other rows: {lines}"
    for shown, line in zip(on_page, lines, strict=True):
        assert alike(shown, line), f"docs/validation.md has {shown}"


def alike(shown: str, line: str) -> bool:
    """Whether a row is the shown one but for rounding, which may also choose another worst one of a loop."""
    (what, *old, allowed), (now, *new, other) = (_cells(one) for one in (shown, line))
    if (what, allowed) != (now, other):
        return False
    sizes = [0.0 if one[2].startswith("below") else abs(float(one[2])) for one in (old, new)]
    if max(sizes) > 1e-7 and max(sizes) > 3 * min(sizes):
        return False
    close = all(
        math.isclose(float(a), float(b), rel_tol=3e-6, abs_tol=1e-9) for a, b in zip(old[:2], new[:2], strict=True)
    )
    return close or "worst of" in what


def _cells(line: str) -> list[str]:
    return [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]


def _worst(rows: list[Row]) -> list[Row]:
    """Of what is compared several times, in a loop, the row that is nearest to its tolerance."""
    groups: dict[str, list[Row]] = {}
    for row in rows:
        groups.setdefault(row[0], []).append(row)
    kept = []
    for what, of_it in groups.items():
        one = max(of_it, key=lambda row: abs(float(row[3])) if row[3][0] != "b" else 0.0)
        kept.append((f"{what}, worst of {len(of_it)}" if len(of_it) > 1 else what, *one[1:]))
    return kept


def heading(item: pytest.Item) -> str:
    """A test in words behind its case."""
    return words(item.nodeid.partition("::")[2])


def words(name: str) -> str:
    """`TestBW03::test_run_on[1.0]` as `BW03: run on [1.0]`."""
    *case, test = name.split("::")
    plain, bracket, parameters = test.partition("[")
    said = plain.removeprefix("test_").replace("_", " ") + (f" {bracket}{parameters}" if bracket else "")
    return ": ".join([*(one.removeprefix("Test") for one in case), said])


def _line(row: Row) -> str:
    cells = [f"`{row[0]}`".replace("|", "\\|"), *row[1:]]
    return f"| {' | '.join(cells)} |"


@cache
def sections() -> dict[str, dict[str, list[str]]]:
    """The rows of the page by module and test."""
    found: dict[str, dict[str, list[str]]] = {}
    module = title = ""
    for line in PAGE.read_text("utf-8").splitlines() if PAGE.exists() else ():
        if line.startswith("## "):
            module = re.findall(r"`(\w+)\.py`", line)[0]
        elif line.startswith("**"):
            title = line.strip("*")
            found.setdefault(module, {})[title] = []
        elif line.startswith("| `"):
            found[module][title].append(line)
    return found


def write() -> None:
    """The page, from the rows of all tests; nothing where none was asked for."""
    if not _written:
        return
    parts = [_HEAD]
    for module in sorted(_written):
        source = ast.parse((ROOT / "tests" / "reference" / f"{module}.py").read_text("utf-8"))
        about = inspect.cleandoc(ast.get_docstring(source) or "")
        parts.append(f"## {about.splitlines()[0].rstrip('.')} (`{module}.py`)\n")
        if rest := "\n".join(about.splitlines()[1:]).strip():
            parts.append(f"{rest}\n")
        told: set[str] = set()
        for title, lines in _written[module].items():
            case = title.partition(":")[0]
            if case not in told and (text := _about(source, case)):
                parts.append(f"### {case}\n\n{text}\n")
            told.add(case)
            parts.append(f"**{title}**\n\n| compared | expected | computed | difference | tolerance |")
            parts.append("| --- | --- | --- | --- | --- |\n" + "\n".join(lines) + "\n")
    PAGE.write_text("\n".join(parts), encoding="utf-8")


def _about(source: ast.Module, case: str) -> str:
    found = next((one for one in source.body if isinstance(one, ast.ClassDef) and one.name == f"Test{case}"), None)
    return ast.get_docstring(found) or "" if found else ""
