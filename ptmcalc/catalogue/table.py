"""Reader of the tables of this package."""

import csv
from collections.abc import Mapping
from functools import cache
from importlib import resources
from types import MappingProxyType


@cache
def rows(table: str) -> tuple[Mapping[str, str], ...]:
    """The rows of a table by the names of its columns; lines that begin with `#` are comments.

    Args:
        table: name of the file in this folder, without `.csv`.

    Returns:
        The rows in the order of the file.
    """
    text = resources.files(__package__).joinpath(f"{table}.csv").read_text("utf-8")
    lines = [line for line in text.splitlines() if line and not line.startswith("#")]
    return tuple(MappingProxyType(row) for row in csv.DictReader(lines))
