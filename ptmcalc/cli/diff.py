"""What `ptmcalc diff` prints: what changed between two states of design files."""

import json as reader
import os
import sys
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from shutil import get_terminal_size
from typing import Any

from ptmcalc.base.diagnostic import BROKEN
from ptmcalc.base.errors import UsageError
from ptmcalc.base.span import KeyPath, dotted
from ptmcalc.cli.batch import Run
from ptmcalc.cli.merge import read_report
from ptmcalc.cli.output import say
from ptmcalc.engine.check import Options
from ptmcalc.engine.load import keys_as_known
from ptmcalc.report import diff, json
from ptmcalc.report.compare import Entry, FileChange, KeyChange, Pair, Turn, compared, pairs
from ptmcalc.text.document import MAX_BYTES, Document, parse
from ptmcalc.text.source import beginning_of


@dataclass(frozen=True, slots=True)
class _State:
    """What is known of one side: the part of the JSON document for each file, with the file where there is one."""

    entries: tuple[Entry, ...]
    folder: Path | None = None
    """in which the paths of the entries are; None of a report, whose files may be others by now"""


def show_diff(old: str, new: str, options: Options, jobs: str, store: str, form: str, *, repairs: bool) -> int:
    """Print what changed; the exit status. `repairs` are looked for where a check fails that did not."""
    before, after = (_state(Path(path), options, jobs, store) for path in (old, new))
    couples = [_with_keys(pair, before, after) for pair in pairs(before.entries, after.entries)]
    changes = [compared(couple) for couple in couples]
    if repairs:
        changes = list(_with_repairs(couples, changes, after, options, jobs, store))
    say(_text(changes, form))
    if any(d["code"] == BROKEN for entry in after.entries for d in entry["diagnostics"]):
        return 4
    if any(change.new == "invalid" for change in changes):
        return 2
    return int(any(change.turned(Turn.WORSE) or change.turn is Turn.WORSE or _bad(change) for change in changes))


def _bad(change: FileChange) -> bool:
    """Whether there is something new that does not pass."""
    new = [check.either for check in change.turned(Turn.NEW)]
    return (change.turn is Turn.NEW and change.new != "pass") or any(c["verdict"] not in _GOOD for c in new)


_GOOD = ("pass", "waived")


def _text(changes: list[FileChange], form: str) -> str:
    if form == "json":
        return diff.document(changes)
    if form == "markdown":
        return diff.markdown(changes)
    color = sys.stdout.isatty() and "NO_COLOR" not in os.environ and os.environ.get("TERM") != "dumb"
    return diff.table(changes, width=get_terminal_size((120, 40)).columns, color=color)


def _state(path: Path, options: Options, jobs: str, store: str) -> _State:
    if path.is_file() and path.suffix.lower() == ".json":
        return _State(tuple(read_report(path)["files"]))
    if not path.exists():
        raise UsageError(f"there is no `{path}`", "name two design files, two folders of them, or two JSON reports")
    folder = path if path.is_dir() else Path()
    return _State(tuple(_entries([os.fspath(path)], folder, options, jobs, store)), folder)


def _entries(paths: list[str], folder: Path, options: Options, jobs: str, store: str) -> Iterator[Entry]:
    """The parts of the JSON document of some files, by their paths inside a folder."""
    with Run(options, jobs, store, in_json=True) as run:
        reports = run.reports(paths, (), "", gitignore=True)
        if run.interrupted:
            raise KeyboardInterrupt
        for report in reports:
            inside = report.path if folder == Path() else Path(report.path).relative_to(folder).as_posix()
            yield {"path": inside} | reader.loads(f"{{{json.part_of(report)}")


def _with_repairs(
    couples: list[Pair], changes: list[FileChange], after: _State, options: Options, jobs: str, store: str
) -> Iterator[FileChange]:
    """The changes; of files with a check that fails now, and did not, with the values at which it would pass."""
    failing = [change.path for change in changes if _newly_failing(change)]
    if not failing or after.folder is None:
        yield from changes
        return
    places = {couple.path: couple.new["path"] for couple in couples if couple.new is not None}
    paths = [os.fspath(after.folder / places[path]) for path in failing]
    found = _entries(paths, after.folder, replace(options, repairs=True), jobs, store)
    mended = {entry["path"]: entry for entry in found}
    for couple, change in zip(couples, changes, strict=True):
        entry = mended.get(places.get(couple.path, "")) if change.path in failing else None
        yield compared(replace(couple, new=entry)) if entry is not None else change


def _newly_failing(change: FileChange) -> bool:
    return any(check.either["verdict"] == "fail" for check in change.turned(Turn.WORSE))


def _with_keys(pair: Pair, before: _State, after: _State) -> Pair:
    """A pair with the keys that are written otherwise now, where both files are at hand."""
    if pair.old is None or pair.new is None or before.folder is None or after.folder is None:
        return pair
    documents = [
        _document(side.folder / e["path"]) for side, e in ((before, pair.old), (after, pair.new)) if side.folder
    ]
    return replace(pair, keys=tuple(_keys(*documents)))


def _document(path: Path) -> Document:
    try:
        return keys_as_known(parse(beginning_of(path, MAX_BYTES + 1), path.as_posix()))
    except OSError:
        return Document(path.as_posix(), None)


def _keys(old: Document, new: Document) -> Iterator[KeyChange]:
    was, now = dict(_leaves(old.data)), dict(_leaves(new.data))
    for path in dict.fromkeys((*now, *was)):
        if was.get(path) != now.get(path):
            line = new.value_span(path).line if path in now else None
            yield KeyChange(dotted(path), was.get(path), now.get(path), line)


def _leaves(node: Any, path: KeyPath = ()) -> Iterator[tuple[KeyPath, str]]:
    """Every value with its key, as text."""
    if isinstance(node, dict) and node:
        for key, value in node.items():
            yield from _leaves(value, (*path, key))
    elif isinstance(node, list) and node:
        for index, value in enumerate(node):
            yield from _leaves(value, (*path, index))
    elif path:
        yield path, node if isinstance(node, str) else reader.dumps(node, default=str)
