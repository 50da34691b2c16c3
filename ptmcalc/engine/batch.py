"""Many design files: what is known of them already, what is left to do, and who does it.

Files go out as texts and come back as records, so a worker needs nothing but this program. What has come back is in the
store at once; which worker finishes first changes no result and no order.
"""

import hashlib
import math
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
from ptmcalc.engine.agenda import Agenda
from ptmcalc.engine.check import Options, broken, check, check_file, guarded, planned_for
from ptmcalc.engine.files import machine_in
from ptmcalc.engine.forecast import foresee
from ptmcalc.engine.load import load_text
from ptmcalc.engine.plan import Plan
from ptmcalc.engine.run import NO_MEMORY
from ptmcalc.engine.store import Record, Store, packed
from ptmcalc.text.document import MAX_BYTES
from ptmcalc.text.source import beginning_of

ALONE = 3.0
"""Predicted seconds of a batch below which one process computes it. A numerical choice: several processes must start
first. A larger value delays medium batches; a smaller one delays small ones."""
_AROUND = 0.003
"""Seconds of reading, judging and reporting a file, in addition to its runs. A numerical choice: a wrong value changes
the distribution of files, no result."""


@dataclass(frozen=True, slots=True)
class Answer:
    """What became of a text: its record, and the predicted seconds of what was run for it; without a record those that
    it would take, which are more than it was given."""

    seconds: float
    record: Record | None = None


Work = Callable[[Sequence[bytes], Options, float], list[Answer]]
"""What is done to some texts, each within so many predicted seconds or not at all; it must be to be found by its name
in another process."""


def fresh(raw: bytes, options: Options) -> FileReport:
    """The report of one text."""
    report = fresh_within(raw, options, math.inf)
    assert not isinstance(report, float)
    return report


def fresh_within(raw: bytes, options: Options, patience: float) -> FileReport | float:
    """The report of one text; or its predicted seconds, where those are more than `patience`."""

    def made() -> FileReport | float:
        loaded = load_text(raw, "", options.effects, options.accuracy)
        planned = planned_for(loaded, options)
        if planned is not None and _most(planned, options) > patience:
            seconds = _foreseen(planned, options)
            if seconds > patience:
                return seconds
        return check(loaded, options, planned)

    return guarded("", made)


def _most(planned: Plan, options: Options) -> float:
    """Seconds of all that may be run for a plan, which costs nothing to know."""
    return sum(min(sum(rung.seconds for rung in scene.rungs), options.budget) for scene in planned.scenes)


def _foreseen(planned: Plan, options: Options) -> float:
    """Seconds that a plan may take: none where our own program breaks down on it, which is told when it is done."""
    try:
        return _AROUND + sum(coming.seconds for coming in foresee(planned, budget=options.budget))
    except Exception:
        return _AROUND


def predicted(raw: bytes, options: Options) -> float:
    """Seconds that a text may take, by its plan; only what surrounds the runs where there is none."""
    loaded = load_text(raw, "", options.effects, options.accuracy)
    planned = planned_for(loaded, options)
    return _foreseen(planned, options) if planned is not None else _AROUND


def spent(report: FileReport) -> float:
    """Predicted seconds of all that was run for a report."""
    return _AROUND + sum(one.predicted_seconds for scene in report.scenes for one in scene.solvers)


def record_of(report: FileReport, raw: bytes, today: date, text: bytes = b"", *, whole: bool = True) -> Record:
    """What is kept of the report of a text. That of a file with waivers, however it writes the word, holds today.

    Where its JSON is all that will be asked for, the report need not be kept `whole`.
    """
    dated = b"waive" in raw or any(j.verdict is Verdict.WAIVED for _, j in report.judgements)
    dated = dated or any(d.path[:1] == ("waive",) for d in report.diagnostics)
    counted = tally(report)
    kept = packed(report) if whole or counted.broken else b""
    if any(d.code == "NUM103" and NO_MEMORY in d.message for d in report.diagnostics):
        return Record(counted, kept, text, _NO_DAY)
    return Record(counted, kept, text, today.isoformat() if dated else "")


_NO_DAY = "no other run"
"""The day of what a run with more memory would find otherwise."""


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
    """A run over many files: `entries` are those whose state is known, `missing` the number of those to do."""

    files: Sequence[Path]
    options: Options
    store: Store
    work: Work
    entries: list[Entry] = field(default_factory=list)
    missing: int = 0
    told: Sequence[FileReport] = ()
    """of what is no file"""
    broken: dict[bytes, FileReport] = field(default_factory=dict)
    """reports of texts that our own program broke down on, which are told and not kept"""
    _agenda: Agenda = field(init=False)
    _keys: Keys = field(init=False)

    def __post_init__(self) -> None:
        self._keys = Keys(self.options)
        kind_of: dict[bytes, tuple[int, bytes]] = {}
        names: dict[bytes, bytes] = {}
        for index, path in enumerate(self.files):
            name = path.as_posix()
            raw = _read(path)
            if raw is None:
                self.entries.append(Entry(name, b"", check_file(path, self.options)))
                continue
            key = self._keys.of(raw)
            self.entries.append(Entry(name, key))
            if key not in kind_of:  # of equal texts the first one is worked on
                kind = machine_in(raw)
                kind_of[key] = index, names.setdefault(kind, kind)
        known = self.store.tallies(list(kind_of), self.today.isoformat())
        self._agenda = Agenda(dict(found for key, found in kind_of.items() if key not in known))
        self.missing = len(kind_of) - len(known)

    @property
    def today(self) -> date:
        """The day of the run."""
        return self.options.today or date.today()

    @property
    def kinds(self) -> Iterator[str]:
        """The kinds and types of machines there is work for, as far as their first keys say."""
        return (name.decode() for name in self._agenda.kinds if name)

    @property
    def expected(self) -> float:
        """Predicted seconds of all that is to do, as far as they can be told by what is done."""
        return self._agenda.expected

    @property
    def reused(self) -> int:
        """How many files are known from before."""
        return len(self.entries) - self.missing

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

    def run(
        self, executor: Callable[[], Executor] | None, jobs: int = 1, alone: float = 0.0
    ) -> Iterator[tuple[int, float]]:
        """Do what is missing; tells after each chunk how many files and predicted seconds were done.

        `executor` makes an executor of `jobs` workers, and another one where one breaks; without it, and as long as
        all of it is not expected to take more than `alone` seconds, the work is done here. A chunk that breaks an
        executor is tried again file by file, each on its own, so that a file that kills its worker is found and told,
        and stops no other.
        """
        self.options = replace(self.options, today=self.today)  # one day for all, whatever the clock of a worker says
        while executor is None or self.expected < alone:
            chunk = self._next(jobs)
            if chunk is None:
                return
            patience = chunk.patience if executor is not None else math.inf
            yield self._keep(chunk, self.work(chunk.texts, self.options, patience))
        while True:
            lost: list[_Chunk] = []
            with executor() as pool:
                yield from self._shared(pool, lost, jobs)
            if not lost:
                return
            yield from self._one_by_one(lost, executor)

    def _shared(self, pool: Executor, lost: "list[_Chunk]", jobs: int) -> Iterator[tuple[int, float]]:
        """Chunks through an executor until there are none or it breaks; those that were under way then are `lost`."""
        running: dict[Future[list[Answer]], _Chunk] = {}
        most = jobs + max(jobs // 2, 1)  # those at work, and some ready
        sound = True
        try:
            while True:
                while sound and len(running) < most:
                    chunk = self._next(jobs, looking=any(one.is_new for one in running.values()))
                    if chunk is None:
                        break
                    try:
                        running[pool.submit(self.work, chunk.texts, self.options, chunk.patience)] = chunk
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
        waiting = deque(_Chunk([item], math.inf) for chunk in lost for item in chunk.items)
        while waiting:
            with executor() as pool:
                able = _works(pool, self.work, self.options)
                while waiting:
                    chunk = waiting.popleft()
                    if not able:
                        yield self._keep(chunk, self.work(chunk.texts, self.options, math.inf))
                        continue
                    try:
                        answers = pool.submit(self.work, chunk.texts, self.options, math.inf).result()
                    except LostError:
                        waiting.appendleft(chunk)
                        break
                    except BrokenExecutor:
                        ((index, key, _),) = chunk.items
                        self.broken[key] = broken(self.entries[index].name, "the process that worked on it was ended")
                        self._agenda.is_done(index, 0.0)
                        yield 1, 0.0
                        break
                    yield self._keep(chunk, answers)

    def _keep(self, chunk: "_Chunk", answers: Iterable[Answer]) -> tuple[int, float]:
        """Results to the store; not what our own program broke down on."""
        sound, files, before = [], 0, self._agenda.done
        for (index, key, _), answer in zip(chunk.items, answers, strict=True):
            record = answer.record
            if record is None:
                self._agenda.came_back(index, answer.seconds)
                continue
            files += 1
            self._agenda.is_done(index, answer.seconds)
            self.entries[index] = Entry(self.entries[index].name, key)
            if record.tally.broken:
                self.broken[key] = record.report
            else:
                sound.append((key, record))
        if sound:
            self.store.add(sound)
        return files, self._agenda.done - before

    def _next(self, jobs: int, *, looking: bool = False) -> "_Chunk | None":
        """Files that go out next, with their texts as they are now."""
        while (portion := self._agenda.next(jobs, looking=looking)) is not None:
            chunk = _Chunk([], portion.patience)
            for index in portion.files:
                raw = _read(self.files[index])
                if raw is not None:
                    chunk.items.append((index, self._keys.of(raw), raw))
                    continue
                report = check_file(self.files[index], self.options)  # gone meanwhile
                self.entries[index] = replace(self.entries[index], report=report)
                self._agenda.is_done(index, 0.0)
            if chunk.items:
                return chunk
        return None


@dataclass(slots=True)
class _Chunk:
    """Files that go out together, index, key and text of each; those that would take longer than `patience` come
    back."""

    items: list[tuple[int, bytes, bytes]]
    patience: float

    @property
    def is_new(self) -> bool:
        """Whether nobody has looked at them."""
        return math.isfinite(self.patience)

    @property
    def texts(self) -> list[bytes]:
        """The texts."""
        return [raw for _, _, raw in self.items]


def _works(pool: Executor, work: Work, options: Options) -> bool:
    """Whether an executor begins at all."""
    try:
        pool.submit(work, [], options, math.inf).result()
    except LostError:
        return True  # it did; another one is asked for
    except BrokenExecutor:
        return False
    return True


def _failed(future: Future[list[Answer]]) -> bool:
    return future.cancelled() or future.exception() is not None


def _read(path: Path) -> bytes | None:
    try:
        return beginning_of(path, MAX_BYTES + 1)
    except OSError:
        return None
