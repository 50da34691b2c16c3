"""Layout of tables on a terminal."""

import re
import textwrap
from collections.abc import Callable, Sequence
from io import StringIO

from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from ptmcalc.base.diagnostic import Severity, Verdict
from ptmcalc.base.units import UNITS

STYLE = {
    Verdict.FAIL.value: "bold red",
    Verdict.UNDECIDED.value: "yellow",
    Verdict.NOT_CHECKED.value: "yellow",
    Verdict.WAIVED.value: "cyan",
    Verdict.PASS.value: "green",
    Verdict.OFF.value: "cyan",
    "invalid": "bold red",
    Severity.ERROR.value: "bold red",
    Severity.WARNING.value: "yellow",
    Severity.NOTE.value: "cyan",
}
"""Of verdicts, of files and of findings."""

GAP = 3
"""Between two columns."""

_EDGES = 2
"""Left and right of a table that has an edge."""

GLUE = "\xa0"
"""A blank at which no line is broken; no printable text holds one."""


def printed(write: Callable[[Console], None], width: int, color: bool) -> str:
    """What is written to a console, without spaces at the ends of lines."""
    out = StringIO()
    as_written = Console(  # `[red]` in a name is a name
        file=out, width=width, force_terminal=color, no_color=not color, highlight=False, markup=False, emoji=False
    )
    write(as_written)
    return "\n".join(line.rstrip() for line in out.getvalue().split("\n"))


def new_table(title: str, *columns: str, edge: bool = True) -> Table:
    """An empty table, with its title above it; without an edge, to save lines, in place of the first heading."""
    table = Table(
        title=title or None if edge else None,
        title_justify="left",
        title_style="bold",
        box=box.SIMPLE_HEAD,
        pad_edge=False,
        show_edge=edge,
    )
    for column in columns if edge else (title, *columns[1:]):
        table.add_column(column, overflow="fold")
    return table


def put(console: Console, table: Table) -> None:
    """A table with an empty line behind it."""
    console.print(table)
    if not table.show_edge:
        console.print()


def glued(amount: str) -> str:
    """A number that keeps its unit and its bar in its line; an interval may go on in the next."""
    return re.sub(r" (?![\[(×])", GLUE, amount)


_FACTOR = rf"(?:{'|'.join(sorted(map(re.escape, UNITS), key=len, reverse=True))})(?:\^\d)?"
_BEFORE_UNIT = re.compile(rf"(?<=\d) (?=(?!1)(?:±|{_FACTOR}(?:[*/]{_FACTOR})*(?![\w^])))|(?<=[≤≥±]) (?=[-\d])")


def together(text: str) -> str:
    """A text in which numbers keep their units, their bars and their `≤` in their line."""
    return _BEFORE_UNIT.sub(GLUE, text)


def wrapped(text: str, width: int) -> str:
    """A text in lines of this width, broken at blanks as far as the words allow."""
    return "\n".join(paragraph(text, width))


def paragraph(text: str, width: int, first: str = "", others: str = "") -> list[str]:
    """The lines of a text, with what the first and the others begin with."""
    lines = textwrap.wrap(
        together(text), max(width, 1), initial_indent=first, subsequent_indent=others, break_on_hyphens=False
    )
    return [line.replace(GLUE, " ") for line in lines]


def tell(console: Console, text: Text, others: str = "   ") -> None:
    """A text in lines that part no number from its unit; what it has in styles of their own stands in the first."""
    first, *rest = paragraph(text.plain, console.width, others=others)
    console.print(Text(first, style=text.style, spans=text.spans))
    for line in rest:
        console.print(Text(line, style=text.style))


def widths(cells: Sequence[Sequence[str]], width: int) -> list[int]:
    """Widths of columns that leave words whole as far as the screen allows, the rest where it saves most lines."""
    columns = list(zip(*cells, strict=True))
    wide = [max(len(word) for cell in column for word in (*cell.split(" "), "")) for column in columns]
    while sum(wide) + GAP * len(wide) > width and max(wide) > 1:
        wide[wide.index(max(wide))] -= 1
    longest = [max(map(len, column)) for column in columns]
    while sum(wide) + GAP * len(wide) < width:
        lines = [long / own if long > own else 0.0 for long, own in zip(longest, wide, strict=True)]
        if not max(lines):
            break
        wide[lines.index(max(lines))] += 1
    return wide


def fill(table: Table, rows: Sequence[Sequence[str]], width: int, styles: Sequence[str] = ()) -> Table:
    """Rows put into a table of so wide a screen, numbers whole; `styles` are those of the first cells."""
    headings = [str(column.header) for column in table.columns]
    rows = [list(map(together, row)) for row in rows]
    wide = widths([headings, *rows], width + GAP - _EDGES * table.show_edge)
    for column, own in zip(table.columns, wide, strict=True):
        column.width = own
        column.header = Text(wrapped(str(column.header), own))
    for index, row in enumerate(rows):
        cells = [Text(wrapped(cell, own)) for cell, own in zip(row, wide, strict=True)]
        if styles:
            cells[0].stylize(styles[index])
        table.add_row(*cells)
    return table
