"""A comment on a pull request: the summary, what does not pass with its place and its fix, and every file in a line.

Checks that pass are counted, not listed: a comment is read, and its length is limited.
"""

import re

from ptmcalc.base.diagnostic import Severity, Verdict
from ptmcalc.contract.report import FileReport, count
from ptmcalc.report import words
from ptmcalc.report.entries import Entry, entries

_ACTIVE = re.compile(r"[\\`*_\[\]|~$<>&@#]|://|www\.", re.IGNORECASE)
_ENTITIES = {"<": "&lt;", ">": "&gt;", "&": "&amp;", "@": "&#64;", "#": "&#35;"}
_SIGNS = {"pass": "✅", "fail": "❌", "undecided": "❓", "invalid": "❌"}
_MOST_ROWS = 200
_MOST_LETTERS = 60_000
"""A comment of GitHub holds 65 536 characters."""
_LONGEST = 500
_HEAD = ("| Verdict | Finding | Place | Message |", "|---|---|---|---|")


def render(reports: tuple[FileReport, ...], *, width: int, color: bool, verbose: bool = False) -> str:
    """The comment."""
    shown = words.printable(reports)
    blocks = ["## ptmcalc", escape(words.summary(count(reports))), _files(shown)]
    left, length, more = _MOST_ROWS, sum(map(len, blocks)), 0
    for report in shown:
        rows = [entry for entry in entries(report) if entry.state not in (Verdict.PASS, Severity.NOTE)]
        told = []
        for row in map(_row, rows[:left]):
            length += len(row) + 1
            if length > _MOST_LETTERS:
                break
            told.append(row)
        if told:
            project = escape(", ".join(f"{label} {text}" for label, text in words.head(report)))
            head = [f"### {escape(_cut(report.path))}", *filter(None, [project])]
            blocks += [*head, "\n".join([*_HEAD, *told])]
            length += sum(map(len, head)) + len(_HEAD[0]) + len(_HEAD[1])
        more += len(rows) - len(told)
        left -= len(told)
    if more:
        blocks.append(f"{more} more findings are not shown; `ptmcalc check` prints them all.")
    return "\n\n".join(filter(None, blocks)) + "\n"


def escape(text: str) -> str:
    """Text that means nothing to Markdown: no markup, no HTML, no mention, no link, no end of a cell."""

    def inert(match: re.Match[str]) -> str:
        found = match[0]
        if found == "://":
            return "&#58;//"
        if len(found) > 1:
            return f"{found[:-1]}&#46;"
        return _ENTITIES.get(found, f"\\{found}")

    return _ACTIVE.sub(inert, text)


def code(text: str) -> str:
    """Text in the letters of code: between more backticks than it holds itself, and no end of a cell."""
    fence = "`" * (1 + max(map(len, re.findall("`+", text)), default=0))
    space = " " * (len(fence) > 1)
    return f"{fence}{space}{text.replace('|', chr(92) + '|')}{space}{fence}"


def _files(reports: tuple[FileReport, ...]) -> str:
    if not reports:
        return ""
    rows = ["| | File | Kind | Passed | Failed | Undecided | Not checked | Waived | Off |", f"|{'---|' * 9}"]
    for report in reports[:_MOST_ROWS]:
        counted = count((report,))
        numbers = (str(counted[key]) for key in ("pass", "fail", "undecided", "not_checked", "waived", "off"))
        cells = (_SIGNS[report.verdict], escape(_cut(report.path)), escape(report.kind), *numbers)
        rows.append(f"| {' | '.join(cells)} |")
    if len(reports) > _MOST_ROWS:
        rows.append(f"| | {len(reports) - _MOST_ROWS} more files |  |  |  |  |  |  |  |")
    return "\n".join(rows)


def _row(entry: Entry) -> str:
    said = (escape(_cut(entry.about)), words.place(entry.span), escape(_cut(entry.message)))
    return f"| **{entry.state.value}** | {' | '.join(said)} |"


def _cut(text: str) -> str:
    """A text of which nobody reads more than the beginning in a comment."""
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]}…"
