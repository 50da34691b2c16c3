"""Measured records: CSV text -> columns of numbers in SI units, or one sentence with the line that is at fault."""

import csv
import math
from collections.abc import Mapping, Sequence
from itertools import pairwise
from pathlib import Path
from typing import NoReturn

from ptmcalc.base.errors import UsageError
from ptmcalc.base.units import Quantity, UnitError, unit_of, without_commas
from ptmcalc.base.words import quote, with_article
from ptmcalc.text.source import beginning_of

MAX_BYTES = 64 << 20


def read_columns(path: Path, wanted: Mapping[str, Quantity]) -> list[list[float]]:
    """The wanted columns of a CSV file, in their order, in SI units.

    The first line names the columns; a unit may stand behind a name in brackets, `speed [rpm]`, else it is the SI one.
    Other columns are left alone, empty lines are skipped, `#` begins a comment line.

    Raises:
        UsageError: the file cannot be read or a line is at fault; only the first fault is told.
    """
    lines = _lines(path)
    name = path.as_posix()
    if not lines:
        raise UsageError(f"{name}: the record is empty", f"the first line names the columns: {','.join(wanted)}")
    number, head = lines[0]
    columns = [_column(name, number, head, key, quantity) for key, quantity in wanted.items()]
    found: list[list[float]] = [[] for _ in columns]
    for number, cells in lines[1:]:
        if len(cells) != len(head):
            _fail(name, number, f"{len(cells)} values under {len(head)} columns", "give every line all columns")
        for values, (at, factor, key) in zip(found, columns, strict=True):
            values.append(_value(name, number, cells[at], key) * factor)
    return found


def _lines(path: Path) -> list[tuple[int, list[str]]]:
    """The lines that hold something, with their numbers, split at commas (or at semicolons, if the first line is)."""
    name = path.as_posix()
    try:
        raw = beginning_of(path, MAX_BYTES + 1)
    except OSError as error:
        raise UsageError(f"{name}: the record cannot be read: {error.strerror or error}", "check the path") from None
    if len(raw) > MAX_BYTES:
        raise UsageError(f"{name}: the record is larger than 64 MiB", "select the relevant part")
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        number = raw[: error.start].count(b"\n") + 1
        _fail(name, number, "the text is not UTF-8", "save the record as UTF-8 or ASCII")
    found = []
    separator = ""
    for number, line in enumerate(text.splitlines(), 1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        separator = separator or (";" if ";" in line else "\t" if "\t" in line and "," not in line else ",")
        try:
            (cells,) = csv.reader([line], delimiter=separator, strict=True)
        except (csv.Error, ValueError):
            _fail(name, number, "the line cannot be split into values", "numbers between commas")
        found.append((number, [cell.strip() for cell in cells]))
    return found


def _column(name: str, number: int, head: Sequence[str], key: str, quantity: Quantity) -> tuple[int, float, str]:
    """Index of a column, what its unit is in SI, and its name."""
    words = [title.partition("[")[0].strip().lower() for title in head]
    example = f"name the columns, e.g. `{key} [{quantity.si}]`"
    if key not in words:
        listed = ", ".join(quote(title) for title in head)
        _fail(name, number, f"there is no column `{key}` among {listed}", example)
    at = words.index(key)
    _, bracket, unit = head[at].partition("[")
    if not bracket:
        return at, 1.0, key
    text = unit.rstrip().removesuffix("]").strip()
    try:
        factor, dimension = unit_of(text)
    except UnitError as error:
        _fail(name, number, error.reason, error.hint)
    if dimension != quantity.dimension:
        _fail(name, number, f"{quote(text)} is no unit of {with_article(quantity.name)}", example)
    return at, factor, key


def _value(name: str, number: int, text: str, key: str) -> float:
    try:
        value = float(text)
    except ValueError:
        if not text:
            _fail(name, number, f"`{key}` is empty", "delete the line, or give the value")
        plain = without_commas(text)
        _fail(name, number, f"`{key}` is {quote(text)}, not a number", f"write {plain}" if plain else "a number")
    if not math.isfinite(value):
        _fail(name, number, f"`{key}` is {quote(text)}, not a finite number", "delete the line")
    return value


def _fail(name: str, number: int, reason: str, hint: str) -> NoReturn:
    raise UsageError(f"{name}:{number}: {reason}", hint)


def rising(path: Path, values: Sequence[float], key: str) -> None:
    """Make sure that a column rises from line to line.

    Raises:
        UsageError: it does not; the line is told.
    """
    for before, (here, after) in enumerate(pairwise(values)):
        if not after > here:
            numbers = [number for number, _ in _lines(path)]
            reason = f"`{key}` is {after:g}, not later than {here:g} in the line before"
            _fail(path.as_posix(), numbers[before + 2], reason, "sort the record, and give each time once")
