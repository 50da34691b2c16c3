"""Tables of a kind's own: what several scenes together come to."""

from rich.console import Console
from rich.text import Text

from ptmcalc.contract.report import Amount, Cell, FileReport, TableReport
from ptmcalc.report import words
from ptmcalc.report.drawing import new_table, put


def draw(console: Console, report: FileReport, *, whole: bool) -> None:
    """All tables of a file; their details and their notes in the whole report, in the short one the notes too."""
    for table in report.tables:
        shown = [index for index, column in enumerate(table.columns) if whole or not column.detail]
        drawn = new_table("", *(table.columns[index].heading for index in shown))
        for row in table.rows:
            drawn.add_row(*(cell(row[index]) for index in shown))
        console.print(Text(table.title, style="bold"))
        put(console, drawn)
        for note in table.notes:
            console.print(Text(f" note: {note}"))
        if table.notes:
            console.print()


def lines(table: TableReport) -> list[str]:
    """A table as lines of text: its row's first cell, then each other cell behind its heading."""
    told = []
    for first, *others in table.rows:
        named = zip(table.columns[1:], others, strict=True)
        told.append(f"{cell(first)}: " + "; ".join(f"{column.heading} {cell(one)}" for column, one in named if one))
    return [f"table {table.name} {line}" for line in told] + [
        f"table {table.name} note: {note}" for note in table.notes
    ]


def cell(one: Cell) -> str:
    """A cell as text."""
    if isinstance(one, Amount):
        return words.amount(one.estimate, one.quantity)
    return ", ".join(one) if isinstance(one, tuple) else one
