"""`file:line:column: verdict CODE ...`, one line each, the worst first: for editors, logs and grep.

A kind's own tables follow as `file: table ...` lines.
"""

from ptmcalc.base.diagnostic import Severity
from ptmcalc.contract.report import FileReport, count
from ptmcalc.report import rows, words
from ptmcalc.report.entries import said


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
        because = said(judgement)
        lines.append(f"{where}: {judgement.verdict.value} {about}" + (f": {because}" if because else ""))
    return lines + [f"{report.path}: {line}" for table in report.tables for line in rows.lines(table)]
