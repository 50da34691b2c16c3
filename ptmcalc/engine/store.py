"""What was found out about design files, kept by their content: a batch goes on where it was stopped.

A store is a SQLite file. Results are added in transactions, so that a process killed at any moment leaves every result
that was added before it whole; several processes may use one store. Tally, report and text of a record carry checksums
and count as absent where those do not hold. The file holds data only: reading one constructs nothing but reports.
"""

import json
import os
import sqlite3
import zlib
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from functools import cache, lru_cache
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from pydantic import TypeAdapter
from pydantic_core import to_json

from ptmcalc.base.errors import UsageError
from ptmcalc.contract.report import FileReport, Tally

_OURS = 0x70746D63
"""Application number of a store, the letters `ptmc`: it distinguishes a store from other SQLite files. Another number
rejects all existing stores."""
_FORM = 1
"""Version of the table below, kept as `user_version`. Another number rejects all existing stores: increase it with
every change of the table."""
_TABLE = """
create table if not exists result (
    key blob primary key, day text not null, tally text not null, checksum integer not null, report blob not null,
    text_checksum integer not null, text blob not null
)
"""
_PAGE = 1 << 14
"""Bytes of a page of the store. A numerical choice: the report of a file then takes a few pages. A larger value wastes
space of short reports; a smaller one reads more pages."""
_ASKED = 500
"""Keys of one query. A numerical choice: more need fewer queries; SQLite limits their number."""
_WAIT = 60.0
"""Seconds that another process may lock the store. A numerical choice: a smaller value refuses a store in use; a larger
one delays the message of a process that does not end."""


@dataclass(frozen=True, slots=True)
class Record:
    """What is kept of one file: its tally, its report without the path, and its part of the JSON document, which is
    empty where nobody asked for it. `day` is the day a report holds for that depends on it, as waivers do."""

    tally: Tally
    packed: bytes
    text: bytes = b""
    day: str = ""

    @property
    def report(self) -> FileReport:
        """The report, without the path of its file."""
        return _adapter().validate_json(self.packed)


def packed(report: FileReport) -> bytes:
    """A report as it is kept: all but its path."""
    return to_json(replace(report, path=""), inf_nan_mode="constants")


@cache
def _adapter() -> TypeAdapter[FileReport]:
    return TypeAdapter(FileReport)


class Store:
    """A file of results; without a path one without a name, which is gone with the process however that ends."""

    def __init__(self, path: Path | None = None) -> None:
        self.path = path
        try:
            self._base = sqlite3.connect(path or "", timeout=_WAIT, isolation_level=None, check_same_thread=False)
            self._base.text_factory = _lenient
            self._prepare(lasting=path is not None)
        except sqlite3.Error as error:
            raise _unusable(path, error) from None

    def _prepare(self, *, lasting: bool) -> None:
        base = self._base
        base.execute(f"pragma synchronous = {'normal' if lasting else 'off'}")
        (mark,), (form,) = base.execute("pragma application_id"), base.execute("pragma user_version")
        (tables,) = base.execute("select count(*) from sqlite_master")
        if tables[0] and (mark[0], form[0]) != (_OURS, _FORM):
            raise sqlite3.DatabaseError("it holds something else")
        if tables[0]:
            return
        base.execute(f"pragma page_size = {_PAGE}")
        base.execute("begin immediate")
        base.execute(_TABLE)
        base.execute(f"pragma application_id = {_OURS}")
        base.execute(f"pragma user_version = {_FORM}")
        base.execute("commit")

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Let go of the file."""
        self._base.close()

    def add(self, records: Iterable[tuple[bytes, Record]]) -> None:
        """Keep results under their keys, all of them or none."""
        rows = [_row(key, record) for key, record in records]
        try:
            self._base.execute("begin immediate")
            self._base.executemany("insert or replace into result values (?, ?, ?, ?, ?, ?, ?)", rows)
            self._base.execute("commit")
        except sqlite3.Error as error:
            raise _unusable(self.path, error) from None

    def get(self, key: bytes) -> Record | None:
        """The result under a key, without its text; None where there is none, or a damaged one."""
        row = self._one("select day, tally, checksum, report from result where key = ?", key)
        return _record(key, row) if row else None

    def tally(self, key: bytes, day: str) -> Tally | None:
        """The tally of the result under a key that holds on a day."""
        row = self._one("select day, tally from result where key = ?", key)
        return _tally_of(key, *row) if row and row[0] in ("", day) else None

    def tallies(self, keys: Sequence[bytes], day: str) -> dict[bytes, Tally]:
        """The tallies that there are under keys, and that hold on a day."""
        found = {}
        for begin in range(0, len(keys), _ASKED):
            some = keys[begin : begin + _ASKED]
            marks = ", ".join("?" * len(some))
            for key, its_day, text in self._all(f"select key, day, tally from result where key in ({marks})", some):
                tally = _tally_of(key, its_day, text) if its_day in ("", day) else None
                if tally is not None:
                    found[key] = tally
        return found

    def text(self, key: bytes) -> bytes:
        """The JSON of a result; empty where there is none, or a damaged one."""
        row = self._one("select text, text_checksum from result where key = ?", key)
        if row is None or not isinstance(row[0], bytes):
            return b""
        return row[0] if _text_checksum(key, row[0]) == row[1] else b""

    def __len__(self) -> int:
        row = self._one("select count(*) from result")
        assert row is not None
        return int(row[0])

    def items(self) -> Iterator[tuple[bytes, Record]]:
        """All results that are whole, with their keys and texts."""
        try:
            for key, *row in self._base.execute("select key, day, tally, checksum, report from result order by key"):
                record = _record(key, row)
                if record is not None:
                    yield bytes(key), replace(record, text=self.text(key))
        except sqlite3.Error as error:
            raise _unusable(self.path, error) from None

    def _one(self, question: str, *values: Any) -> Sequence[Any] | None:
        return next(iter(self._all(question, values)), None)

    def _all(self, question: str, values: Sequence[Any]) -> list[Any]:
        try:
            return self._base.execute(question, values).fetchall()
        except sqlite3.Error as error:
            raise _unusable(self.path, error) from None


def is_store(path: Path) -> bool:
    """Whether a file is a SQLite file, which a report never is."""
    try:
        with path.open("rb") as file:
            return file.read(16) == b"SQLite format 3\0"
    except OSError:
        return False


def _unusable(path: Path | None, error: sqlite3.Error) -> UsageError:
    name = os.fspath(path) if path else "a file without a name in the temporary folder"
    return UsageError(f"`{name}` cannot be used as a store of results: {error}", "name another, or delete the file")


def _lenient(raw: bytes) -> str:
    """Damaged letters fail the checksum of their record, not the whole store."""
    return raw.decode("utf-8", "replace")


def _row(key: bytes, record: Record) -> tuple[Any, ...]:
    tally, report = json.dumps(asdict(record.tally)), zlib.compress(record.packed, 1)
    sealed = f"{_seal(key, record.day, tally)} {tally}"
    checksum = _checksum(record.day, sealed, report)
    return key, record.day, sealed, checksum, report, _text_checksum(key, record.text), record.text


def _seal(key: bytes, day: str, tally: str) -> str:
    """The checksum of a tally, which is read without the report beside it."""
    return f"{zlib.crc32(tally.encode(), zlib.crc32(day.encode(), zlib.crc32(key))):08x}"


def _text_checksum(key: bytes, text: bytes) -> int:
    return zlib.crc32(text, zlib.crc32(key))


def _checksum(day: str, tally: str, report: bytes) -> int:
    return zlib.crc32(report, zlib.crc32(f"{day}\n{tally}\n".encode()))


def _record(key: bytes, row: Sequence[Any]) -> Record | None:
    day, sealed, checksum, report = row
    tally = _tally_of(key, day, sealed)
    try:
        whole = tally is not None and _checksum(day, sealed, report) == checksum
        return Record(tally, zlib.decompress(report), day=day) if tally is not None and whole else None
    except (ValueError, TypeError, zlib.error):
        return None


def _tally_of(key: bytes, day: Any, sealed: Any) -> Tally | None:
    """A tally as it is kept; None of a damaged one, or one of an earlier form without a checksum of its own."""
    try:
        seal, _, text = sealed.partition(" ")
        return _tally(text) if _seal(key, day, text) == seal else None
    except (ValueError, TypeError, AttributeError):
        return None


@lru_cache(maxsize=1000)
def _tally(text: str) -> Tally:
    """Of many files most tallies are equal: they are one."""
    return Tally(**json.loads(text))
