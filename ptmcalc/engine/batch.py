"""Many design files: what is known of them already, what is left to do, and who does it.

Files go out as texts and come back as records, so a worker needs nothing but this program. What has come back is in the
store at once; which worker finishes first changes no result and no order.
"""

import hashlib
import re
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from dataclasses import dataclass, field, fields, replace
from datetime import date
from functools import cache
from importlib import metadata
from pathlib import Path

import numpy as np

import ptmcalc
from ptmcalc import __version__
from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.errors import UsageError
from ptmcalc.contract.report import FileReport, Tally, tally
from ptmcalc.engine.check import Options, broken, check, check_file, chosen_scenes, guarded
from ptmcalc.engine.load import load_text
from ptmcalc.engine.plan import plan
from ptmcalc.engine.run import foresee
from ptmcalc.engine.store import Record, Store, packed
from ptmcalc.text.document import MAX_BYTES
from ptmcalc.text.source import beginning_of

CHUNK = 0.5
"""Predicted seconds of work that go out together: enough to make the way worth while, little enough to share evenly."""
ALONE = 3.0
"""Predicted seconds below which one process is as quick as several, which must start first."""
_MOST_IN_CHUNK = 500
_WAITING = 2
"""Chunks a worker has before it: one at work, one ready."""
_TRIED = 3
"""Files of a kind that are planned to see what one of its kind may take."""
_AROUND = 0.003
"""Seconds of reading, judging and reporting a file, beside its runs."""
_KIND = re.compile(rb"^kind:[ \t]*[\"']?([a-z_]+)", re.MULTILINE)

Work = Callable[[Sequence[bytes], Options], list[Record]]
"""What is done to some texts; it must be to be found by its name in another process."""


def fresh(raw: bytes, options: Options) -> FileReport:
    """The report of one text."""
    return guarded("", lambda: check(load_text(raw, "", options.effects, options.accuracy), options))


def record_of(report: FileReport, raw: bytes, today: date, text: bytes = b"", *, whole: bool = True) -> Record:
    """What is kept of the report of a text. That of a file with waivers, however it writes the word, holds today.

    Where its JSON is all that will be asked for, the report need not be kept `whole`.
    """
    dated = b"waive" in raw or any(j.verdict is Verdict.WAIVED for _, j in report.judgements)
    dated = dated or any(d.path[:1] == ("waive",) for d in report.diagnostics)
    counted = tally(report)
    kept = packed(report) if whole or counted.broken else b""
    return Record(counted, kept, text, today.isoformat() if dated else "")


# -- keys -----------------------------------------------------------------------------------------------------------


@cache
def edition() -> bytes:
    """What else results depend on besides texts and options: the program to its last line, numpy, kinds of others."""
    digest = hashlib.sha256(f"{__version__} numpy {np.__version__}".encode())
    for place in ptmcalc.__path__:
        for path in sorted(Path(place).rglob("*.py")):
            digest.update(path.relative_to(place).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    for entry in metadata.entry_points(group="ptmcalc.machines"):
        digest.update(f"{entry.value} {entry.dist.version if entry.dist else ''}\0".encode())
    return digest.digest()


class LostError(BrokenExecutor):
    """What was under way is gone with the connection to those who did it; it killed nobody, and is done again."""


class GoneError(UsageError):
    """Those who did the work are gone for good; what came back from them is kept."""


class Keys:
    """The keys under which results are kept: of the text, the options, and the program."""

    def __init__(self, options: Options) -> None:
        chosen = {one.name: getattr(options, one.name) for one in fields(options) if one.name != "today"}
        chosen["effects"] = sorted(options.effects.items())
        self._common = hashlib.sha256(edition() + repr(sorted(chosen.items())).encode())

    def of(self, raw: bytes) -> bytes:
        """The key of a text."""
        digest = self._common.copy()
        digest.update(raw)
        return digest.digest()


# -- results --------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Entry:
    """A file of a batch: its key in the store, or the report of one that is not kept: unreadable, or beyond us."""

    name: str
    key: bytes
    report: FileReport | None = None


class Results(Sequence[FileReport]):
    """The reports of a batch in the order of its files, each taken from the store when it is looked at.

    A record that turns out to be damaged is made again from its file.
    """

    def __init__(self, entries: Sequence[Entry], store: Store, options: Options, day: str) -> None:
        self._entries, self._store, self._options, self._day = entries, store, options, day
        self._tallies: list[Tally] = []

    def __len__(self) -> int:
        return len(self._entries)

    def __getitem__(self, index):  # type: ignore[no-untyped-def]
        if isinstance(index, slice):
            return Results(self._entries[index], self._store, self._options, self._day)
        entry = self._entries[index]
        if entry.report is not None:
            return entry.report
        record = self._store.get(entry.key)
        if record is not None:
            try:
                return replace(record.report, path=entry.name)
            except ValueError:  # written by other hands
                pass
        return check_file(Path(entry.name), self._options)

    def tallies(self) -> list[Tally]:
        """The tally of each file."""
        if not self._tallies:
            known = self._store.tallies([one.key for one in self._entries if one.report is None], self._day)
            for index, entry in enumerate(self._entries):
                found = known.get(entry.key) if entry.report is None else None
                self._tallies.append(found or tally(self[index]))
        return self._tallies

    def texts(self) -> Iterator[tuple[str, bytes]]:
        """Of each file its name and what the store has of its JSON; empty where it has nothing."""
        for entry in self._entries:
            yield entry.name, b"" if entry.report is not None else self._store.text(entry.key)


# -- batches --------------------------------------------------------------------------------------------------------


@dataclass(slots=True)
class Batch:
    """A run over many files: `entries` are those whose state is known, `missing` the indices of those to do."""

    files: Sequence[Path]
    options: Options
    store: Store
    work: Work
    entries: list[Entry] = field(default_factory=list)
    missing: list[int] = field(default_factory=list)
    seconds: list[float] = field(default_factory=list)
    """predicted for each missing file"""
    told: Sequence[FileReport] = ()
    """of what is no file"""
    broken: dict[bytes, FileReport] = field(default_factory=dict)
    """reports of texts that our own program broke down on, which are told and not kept"""

    def __post_init__(self) -> None:
        keys = Keys(self.options)
        kind_of: dict[bytes, tuple[int, bytes]] = {}
        for index, path in enumerate(self.files):
            name = path.as_posix()
            raw = _read(path)
            if raw is None:
                self.entries.append(Entry(name, b"", check_file(path, self.options)))
                continue
            key = keys.of(raw)
            self.entries.append(Entry(name, key))
            if key not in kind_of:  # of equal texts the first one is worked on
                found = _KIND.search(raw)
                kind_of[key] = index, found[1] if found else b""
        known = self.store.tallies(list(kind_of), self.today.isoformat())
        kinds: dict[bytes, list[int]] = {}
        for key, (index, kind) in kind_of.items():
            if key not in known:
                self.missing.append(index)
                kinds.setdefault(kind, []).append(index)
        self._predict(kinds)

    @property
    def today(self) -> date:
        """The day of the run."""
        return self.options.today or date.today()

    @property
    def kinds(self) -> Iterator[str]:
        """The kinds of machines there is work for, as far as the first lines say."""
        found = (_KIND.search(_read(self.files[index]) or b"") for index in self.missing[:_MOST_IN_CHUNK])
        return iter(dict.fromkeys(match[1].decode() for match in found if match))

    @property
    def reused(self) -> int:
        """How many files are known from before."""
        return len(self.entries) - len(self.missing)

    def _predict(self, kinds: dict[bytes, list[int]]) -> None:
        """The seconds of every missing file, from the plans of some of its kind spread over the list."""
        expected: dict[int, float] = {}
        for indices in kinds.values():
            step = max(len(indices) // _TRIED, 1)
            tried = [predicted(_read(self.files[index]) or b"", self.options) for index in indices[::step][:_TRIED]]
            mean = sum(tried) / len(tried)
            expected |= dict.fromkeys(indices, mean)
        self.seconds = [expected[index] for index in self.missing]

    def results(self, *, whole: bool = True) -> Results:
        """What there is; of an interrupted batch, which is not whole, of the files whose results are there."""
        day = self.today.isoformat()
        found = [replace(one, report=self.broken[one.key]) if one.key in self.broken else one for one in self.entries]
        found = [replace(one, report=replace(one.report, path=one.name)) if one.report else one for one in found]
        if not whole:
            known = self.store.tallies([one.key for one in found if one.report is None], day)
            found = [one for one in found if one.report is not None or one.key in known]
        found += [Entry(report.path, b"", report) for report in self.told]
        return Results(found, self.store, self.options, day)

    def run(self, executor: Callable[[], Executor] | None, jobs: int = 1) -> Iterator[tuple[int, float]]:
        """Do what is missing; tells after each chunk how many files and predicted seconds it was.

        `executor` makes an executor of `jobs` workers, and another one where one breaks; without it the work is done
        here. A chunk that breaks an executor is tried again file by file, each on its own, so that a file that kills
        its worker is found and told, and stops no other.
        """
        self.options = replace(self.options, today=self.today)  # one day for all, whatever the clock of a worker says
        if executor is None:
            for chunk in self._chunks(CHUNK):
                yield self._keep(chunk, self.work([raw for _, _, raw in chunk.items], self.options))
            return
        chunks = self._chunks(CHUNK)
        while True:
            lost: list[_Chunk] = []
            with executor() as pool:
                yield from self._shared(pool, chunks, lost, jobs * _WAITING)
            if not lost:
                return
            yield from self._one_by_one(lost, executor)

    def _shared(
        self, pool: Executor, chunks: "Iterator[_Chunk]", lost: "list[_Chunk]", most: int
    ) -> Iterator[tuple[int, float]]:
        """Chunks through an executor until there are none or it breaks; those that were under way then are `lost`."""
        running: dict[Future[list[Record]], _Chunk] = {}
        ready: deque[_Chunk] = deque()
        sound = True
        try:
            while sound or running:
                while sound and len(running) < most:
                    chunk = ready.popleft() if ready else next(chunks, None)
                    if chunk is None:
                        break
                    try:
                        running[pool.submit(self.work, [raw for _, _, raw in chunk.items], self.options)] = chunk
                    except BrokenExecutor:
                        lost.append(chunk)
                        sound = False
                if not running:
                    return
                done, _ = wait(running, return_when=FIRST_COMPLETED)
                for future in sorted(done, key=_failed):  # what is there is kept before anything is raised
                    chunk = running.pop(future)
                    try:
                        yield self._keep(chunk, future.result())
                    except BrokenExecutor:
                        lost.append(chunk)
                        sound = False
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise

    def _one_by_one(self, lost: "Sequence[_Chunk]", executor: Callable[[], Executor]) -> Iterator[tuple[int, float]]:
        """Files one after the other: the one at work where an executor breaks is the one that breaks it. Where no
        executor can work at all, they are done here."""
        waiting = deque(_Chunk([i], [s]) for chunk in lost for i, s in zip(chunk.items, chunk.seconds, strict=True))
        while waiting:
            with executor() as pool:
                able = _works(pool, self.work, self.options)
                while waiting:
                    chunk = waiting.popleft()
                    if not able:
                        yield self._keep(chunk, self.work([chunk.items[0][2]], self.options))
                        continue
                    ((index, key, raw),) = chunk.items
                    try:
                        records = pool.submit(self.work, [raw], self.options).result()
                    except LostError:
                        waiting.appendleft(chunk)
                        break
                    except BrokenExecutor:
                        name = self.entries[index].name
                        self.broken[key] = broken(name, "the process that worked on it was ended")
                        yield 1, sum(chunk.seconds)
                        break
                    yield self._keep(chunk, records)

    def _keep(self, chunk: "_Chunk", records: Iterable[Record]) -> tuple[int, float]:
        """Results to the store; not what our own program broke down on."""
        sound = []
        for (index, key, _), record in zip(chunk.items, records, strict=True):
            self.entries[index] = Entry(self.entries[index].name, key)
            if record.tally.broken:
                self.broken[key] = record.report
            else:
                sound.append((key, record))
        self.store.add(sound)
        return len(chunk.items), sum(chunk.seconds)

    def _chunks(self, most: float) -> Iterator["_Chunk"]:
        """The missing files with their texts as they are now, in portions of so many predicted seconds."""
        keys, chunk = Keys(self.options), _Chunk([], [])
        for index, seconds in zip(self.missing, self.seconds, strict=True):
            raw = _read(self.files[index])
            if raw is None:  # gone meanwhile
                report = check_file(self.files[index], self.options)
                self.entries[index] = replace(self.entries[index], report=report)
                continue
            chunk.items.append((index, keys.of(raw), raw))
            chunk.seconds.append(seconds)
            if sum(chunk.seconds) >= most or len(chunk.items) >= _MOST_IN_CHUNK:
                yield chunk
                chunk = _Chunk([], [])
        if chunk.items:
            yield chunk


@dataclass(slots=True)
class _Chunk:
    """Files that go out together: index, key and text of each, and its predicted seconds."""

    items: list[tuple[int, bytes, bytes]]
    seconds: list[float]


def _works(pool: Executor, work: Work, options: Options) -> bool:
    """Whether an executor begins at all."""
    try:
        pool.submit(work, [], options).result()
    except LostError:
        return True  # it did; another one is asked for
    except BrokenExecutor:
        return False
    return True


def _failed(future: Future[list[Record]]) -> bool:
    return future.cancelled() or future.exception() is not None


def predicted(raw: bytes, options: Options) -> float:
    """Seconds that a text may take, by its plans; only what surrounds the runs where there are none."""
    try:
        loaded = load_text(raw, "", options.effects, options.accuracy)
        if loaded.kind is None or loaded.spec is None or not options.run:
            return _AROUND
        made = plan(loaded.kind, loaded.spec, chosen_scenes(loaded.spec, options.scenes))
        return _AROUND + sum(coming.seconds for coming in foresee(made, budget=options.budget))
    except UsageError:
        raise
    except Exception:  # it will be told when the file is done
        return _AROUND


def _read(path: Path) -> bytes | None:
    try:
        return beginning_of(path, MAX_BYTES + 1)
    except OSError:
        return None
