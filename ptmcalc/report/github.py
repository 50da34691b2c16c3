"""Workflow commands of GitHub Actions: every finding is shown at its line in the files of a pull request.

**Source** GitHub Docs, Workflow commands for GitHub Actions: `::error file=,line=,col=,title=::message`, in which a
message escapes `%`, CR and LF, and a property the colon and the comma as well.
"""

from ptmcalc.base.diagnostic import Severity, Verdict
from ptmcalc.contract.report import FileReport, count
from ptmcalc.report import words
from ptmcalc.report.entries import Entry, entries

_COMMANDS = {
    Severity.ERROR: "error",
    Severity.WARNING: "warning",
    Verdict.FAIL: "error",
    Verdict.UNDECIDED: "warning",
    Verdict.NOT_CHECKED: "warning",
    Verdict.WAIVED: "notice",
    Verdict.OFF: "notice",
}
"""What passes is not said, nor are notes, which need the table beside them."""


def render(reports: tuple[FileReport, ...], *, width: int, color: bool, verbose: bool = False) -> str:
    """A command for every finding, and a summary."""
    lines = [
        _command(report.path, entry)
        for report in words.printable(reports)
        for entry in entries(report)
        if entry.state in _COMMANDS
    ]
    return "\n".join([*lines, words.summary(count(reports))]) + "\n"


def _command(path: str, entry: Entry) -> str:
    properties = {"file": path}
    if entry.span:
        properties |= {"line": str(entry.span.line), "col": str(entry.span.column)}
    properties["title"] = f"{entry.state.value} {entry.about}"
    written = ",".join(f"{name}={_property(value)}" for name, value in properties.items())
    return f"::{_COMMANDS[entry.state]} {written}::{_message(entry.message)}"


def _message(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _message(text).replace(":", "%3A").replace(",", "%2C")
