"""Tables of a kind's own: what several scenes together come to."""

from rich.console import Console
from rich.text import Text

from ptmcalc.contract.report import Amount, Cell, FileReport
from ptmcalc.report.drawing import fill, glued, new_table, put, tell
from ptmcalc.report.rows import cell


def draw(console: Console, report: FileReport, *, whole: bool) -> None:
    """All tables of a file; their details and their notes in the whole report, in the short one the notes too."""
    for table in report.tables:
        shown = [index for index, column in enumerate(table.columns) if whole or not column.detail]
        drawn = new_table("", *(table.columns[index].heading for index in shown))
        cells = [[_text(row[index]) for index in shown] for row in table.rows]
        console.print(Text(table.title, style="bold"))
        put(console, fill(drawn, cells, console.width))
        for note in table.notes:
            tell(console, Text(f" note: {note}"))
        if table.notes:
            console.print()


def _text(one: Cell) -> str:
    return glued(cell(one)) if isinstance(one, Amount) else cell(one)
