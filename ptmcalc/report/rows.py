"""Tables of a kind's own as lines of text; the plain report, which needs no more, does not import what draws them."""

from ptmcalc.contract.report import Amount, Cell, TableReport
from ptmcalc.report import words


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
