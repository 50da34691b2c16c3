"""The numbers that decide, as CSV: a line for each verdict, all digits, SI units; and one for each invalid file."""

import csv
from collections.abc import Iterable, Iterator
from io import StringIO
from typing import Any

from ptmcalc.base.diagnostic import Severity
from ptmcalc.base.span import dotted
from ptmcalc.contract.report import FileReport
from ptmcalc.report import words
from ptmcalc.report.json import finite

COLUMNS = (
    *("file", "kind", "name", "verdict", "code", "title", "scene", "part"),
    *("value", "low", "high", "limit", "margin", "relative_margin", "unit", "key", "line", "governs"),
)
_FORMULA = ("=", "+", "-", "@", "\t", "\r")


def render(reports: Iterable[FileReport], *, width: int, color: bool, verbose: bool = False) -> str:
    """The whole of it."""
    return "".join(pieces(reports))


def pieces(reports: Iterable[FileReport]) -> Iterator[str]:
    """The lines of each file, under their heading; the line that governs a file is its first and says 1."""
    yield _text([COLUMNS])
    for report in reports:
        yield _text(_rows(report))


def _text(rows: Iterable[Iterable[Any]]) -> str:
    out = StringIO()
    csv.writer(out, lineterminator="\n").writerows(rows)
    return out.getvalue()


def _rows(report: FileReport) -> Iterator[tuple[Any, ...]]:
    about = (safe(report.path), safe(report.kind), safe(report.name))
    if not report.valid:
        for said in (one for one in report.diagnostics if one.severity is Severity.ERROR):
            key, line = safe(dotted(said.path)), said.span.line if said.span else ""
            yield (*about, "invalid", said.code, safe(said.message), *[""] * 9, key, line, "")
    for index, (scene, one) in enumerate(words.worst_first(report)):
        value, limit = one.value, one.limit
        numbers = (value.value, value.low, value.high) if value else (None, None, None)
        relative = words.relative_margin(one) if one.margin is not None else None
        yield (
            *about,
            one.verdict.value,
            one.code,
            one.title,
            safe(scene),
            safe(one.element),
            *map(finite, (*numbers, limit.value if limit else None, one.margin, relative)),
            one.quantity.si,
            safe(dotted(one.blame.path)),
            one.blame.span.line,
            1 if index == 0 else "",
        )


def safe(text: str) -> str:
    """A text that a spreadsheet does not take for a formula."""
    shown = str(words.printable(text))
    return f"'{shown}" if shown.startswith(_FORMULA) else shown
