"""A line for each file: its verdict, and the check that governs it."""

from collections.abc import Iterator

from rich.console import Console

from ptmcalc.base.diagnostic import Severity
from ptmcalc.contract.check import Sense
from ptmcalc.contract.report import FileReport, count
from ptmcalc.report import words
from ptmcalc.report.drawing import STYLE, fill, new_table, printed, put

_SIGN = {Sense.AT_LEAST: "≥", Sense.AT_MOST: "≤"}
_COLUMNS = ("verdict", "file", "kind", "governs", "scene", "value", "limit", "margin")


def render(reports: tuple[FileReport, ...], *, width: int, color: bool, verbose: bool = False) -> str:
    """The table, and the summary line."""

    def write(console: Console) -> None:
        rows = [list(_cells(report)) for report in words.printable(reports)]
        if rows:
            put(console, fill(new_table("", *_COLUMNS), rows, console.width, [STYLE[verdict] for verdict, *_ in rows]))
        console.print(words.summary(count(reports)))

    return printed(write, width, color)


def _cells(report: FileReport) -> Iterator[str]:
    yield from (report.verdict, report.path, report.kind)
    scene, worst = next(iter(words.worst_first(report)), ("", None))
    if worst is None:
        said = next((d for d in report.diagnostics if d.severity is Severity.ERROR), None)
        yield f"{said.code} {said.message}" if said else ""
        yield from ("", "", "", "")
        return
    yield from (" ".join(filter(None, (worst.code, worst.element))), scene)
    yield words.value(worst)
    yield f"{_SIGN[worst.sense]} {words.amount(worst.limit, worst.quantity)}" if worst.limit else ""
    yield words.margin(worst)
