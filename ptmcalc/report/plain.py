"""`file:line:column: verdict CODE ...`, one line each, the worst first: for editors, logs and grep.

A kind's own tables follow as `file: table ...` lines.
"""

from ptmcalc.base.diagnostic import Severity
from ptmcalc.contract.check import Sense
from ptmcalc.contract.report import FileReport, Judgement, count
from ptmcalc.report import tables, words

_RELATION = {Sense.AT_LEAST: "at least", Sense.AT_MOST: "at most"}


def render(reports: tuple[FileReport, ...], *, width: int, color: bool, verbose: bool = False) -> str:
    """All lines, and a summary."""
    lines = [line for report in words.printable(reports) for line in _lines(report)]
    return "\n".join([*lines, words.summary(count(reports))]) + "\n"


def _lines(report: FileReport) -> list[str]:
    lines = []
    for diagnostic in report.diagnostics:
        if diagnostic.severity is Severity.NOTE:  # of the table and the JSON, which show what it is about
            continue
        where = f"{report.path}:{words.place(diagnostic.span)}" if diagnostic.span else report.path
        hint = f"; {diagnostic.hint}" if diagnostic.hint else ""
        lines.append(f"{where}: {diagnostic.severity.value} {diagnostic.code} {diagnostic.message}{hint}")
    for scene, judgement in words.worst_first(report):
        where = f"{report.path}:{words.place(judgement.blame.span)}"
        about = f"{judgement.code} {words.subject(judgement)} [{scene}]"
        lines.append(f"{where}: {judgement.verdict.value} {about}{_said(judgement)}")
    return lines + [f"{report.path}: {line}" for table in report.tables for line in tables.lines(table)]


def _said(judgement: Judgement) -> str:
    parts = []
    if judgement.value is not None and judgement.limit is not None:
        limit = words.amount(judgement.limit, judgement.quantity)
        parts.append(
            f"{words.amount(judgement.value, judgement.quantity)}, {_RELATION[judgement.sense]} {limit} is sound"
        )
    parts.append(words.remark(judgement))
    return ": " + "; ".join(filter(None, parts)) if any(parts) else ""
