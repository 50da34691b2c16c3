"""How tables look on a terminal."""

from collections.abc import Callable
from io import StringIO

from rich import box
from rich.console import Console
from rich.table import Table

from ptmcalc.base.diagnostic import Severity, Verdict

STYLE = {
    Verdict.FAIL.value: "bold red",
    Verdict.UNDECIDED.value: "yellow",
    Verdict.NOT_CHECKED.value: "yellow",
    Verdict.WAIVED.value: "cyan",
    Verdict.PASS.value: "green",
    "invalid": "bold red",
    Severity.ERROR.value: "bold red",
    Severity.WARNING.value: "yellow",
    Severity.NOTE.value: "cyan",
}
"""Of verdicts, of files and of findings."""

GAP = 3
"""Between two columns."""


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
