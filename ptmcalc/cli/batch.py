"""What `ptmcalc check` does with many files: who works on them, what is kept, and what is seen of it meanwhile."""

import os
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from shutil import get_terminal_size
from types import TracebackType
from typing import TYPE_CHECKING, Self

from ptmcalc.base.diagnostic import Diagnostic
from ptmcalc.base.errors import UsageError
from ptmcalc.cli.output import say
from ptmcalc.contract.report import FileReport, Tally, tally, total
from ptmcalc.engine import check as engine
from ptmcalc.engine.check import Options
from ptmcalc.engine.files import Chosen, Excludes, chosen_files, part
from ptmcalc.report import Format, json, render

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from rich.console import Console

    from ptmcalc.engine.batch import Batch, GoneError

FEW = 8
"""Files below which they are checked one after the other without being predicted, unless somebody asks for more."""
LOCAL = "local"
"""The executor that is no cluster."""
_AHEAD = 8
"""Chunks a cluster is given at a time at least: it may grow while it works."""
_WORTH_SHOWING = 2.0
"""Predicted seconds from which progress is shown."""


class Run:
    """One run of `check`: its results are there until it is left.

    `in_json` says that their JSON will be asked for, `whole` that the reports themselves will.
    """

    def __init__(
        self, options: Options, jobs: str, store: str, *, in_json: bool, whole: bool = True, executor: str = LOCAL
    ) -> None:
        self.options, self.jobs, self.store, self.executor = options, _jobs(jobs), store, executor
        self.in_json, self.whole = in_json, whole or bool(store)
        if executor != LOCAL and self.jobs is not None:
            raise UsageError(
                "`--jobs` counts processes here, `--executor` has the work done elsewhere", "leave one out"
            )
        self.interrupted = False
        self.files = 0
        """what the command line names, in all shards together"""
        self.left_out = 0
        """design files that `--exclude` or `.gitignore` kept out of folders"""
        self.broken_off: GoneError | None = None
        """what ended the run before its end; what was done by then is in its results"""
        self._open = ExitStack()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._open.close()

    def reports(
        self, paths: Sequence[str], exclude: Sequence[str], shard: str, *, gitignore: bool
    ) -> Sequence[FileReport]:
        """The reports of what the command line names."""
        chosen = chosen_files(paths, Excludes(tuple(exclude), gitignore), _listed() if "-" in paths else ())
        self.left_out = chosen.excluded
        if chosen.excluded:
            files = "1 design file is" if chosen.excluded == 1 else f"{chosen.excluded} design files are"
            say(f"ptmcalc: {files} left out by --exclude or .gitignore\n", err=True)
        named, told = chosen.files, _told(chosen)
        self.files = len(named) + len(told)
        if shard:
            named = part(named, shard)
            told = told if shard.startswith("1/") else []
        if not named and not told:
            said = f"part {shard} of the run holds no file: it has {_files(len(chosen.files))}" if shard else ""
            say(f"ptmcalc: {said or 'the list names no file'}; nothing was checked\n", err=True)
        if len(named) < FEW and not self.store and self.jobs is None and self.executor == LOCAL:
            return (*told, *self._few(named))
        return self.batch(named, told)

    def _few(self, paths: Sequence[Path]) -> tuple[FileReport, ...]:
        """The reports of some files, with a progress line on a terminal."""
        if sys.stderr is None or not sys.stderr.isatty():
            return engine.check_paths(paths, self.options)
        from ptmcalc.cli.progress import shown  # for terminals

        with shown():
            return engine.check_paths(paths, self.options)

    def processes(self, number: int) -> int:
        """Processes of this machine for so many things to do that take as long as a process takes to begin."""
        return self.jobs or (_cores() if number >= FEW else 1)

    def batch(self, files: Sequence[Path], told: Sequence[FileReport]) -> Sequence[FileReport]:
        """The reports of files, as far as the run gets."""
        from ptmcalc.cli.processes import pool
        from ptmcalc.cli.worker import only_text, with_text, without_text
        from ptmcalc.engine.batch import ALONE, Batch, GoneError, Work
        from ptmcalc.engine.store import Store

        kept = self._open.enter_context(Store(Path(self.store) if self.store else None))
        chosen = without_text if not self.in_json else with_text if self.whole else only_text
        place = os.path.abspath(self.store) if self.store and self.executor == LOCAL else ""
        work: Work = partial(chosen, place=place) if place else chosen
        batch = Batch(files, self.options, kept, work, told=told)
        executor: Callable[[], Executor] | None
        if self.executor != LOCAL:
            executor, jobs = self._cluster()
            alone = 0.0
        else:
            jobs = min(self.jobs or _cores(), batch.missing)
            executor = pool(jobs, batch.kinds) if jobs > 1 else None
            alone = ALONE if self.jobs is None else 0.0
        gone: GoneError | None = None
        try:
            follow(batch, batch.run(executor, jobs, alone))
        except KeyboardInterrupt:
            self.interrupted = True
        except GoneError as error:
            self.interrupted, gone = True, error
        results = batch.results(whole=not self.interrupted)
        if self.interrupted:
            rest = "the same command goes on from there" if self.store else "with --store the next run would go on"
            said = f"interrupted after {len(results)} of {len(files)} files; {rest}"
            if gone is not None:
                self.broken_off = GoneError(gone.message, said)
            else:
                say(f"ptmcalc: {said}\n", err=True)
        elif self.store:
            say(f"ptmcalc: {batch.reused} of {len(files)} files known from `{self.store}`\n", err=True)
        return results

    def _cluster(self) -> "tuple[Callable[[], Executor], int]":
        """A cluster, and how many chunks it takes at a time."""
        from ptmcalc.cli.cluster import Cluster

        cluster = Cluster(self.executor)
        if not (threads := cluster.threads):
            say(f"ptmcalc: the scheduler at `{cluster.place}` has no worker yet; waiting for one\n", err=True)
        return cluster, max(threads, _AHEAD)


def follow(batch: "Batch", steps: Iterable[tuple[int, float]], console: "Console | None" = None) -> None:
    """Go through the steps of a batch; on a terminal with what is done, in predicted seconds, where that is long."""
    visible = sys.stderr is not None and sys.stderr.isatty()
    done, seconds = batch.reused, 0.0
    for files, more in steps:
        done, seconds = done + files, seconds + more
        if console is not None or (visible and batch.expected > _WORTH_SHOWING):
            break
    else:
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

    columns = (TextColumn("{task.fields[files]} files"), BarColumn(), TimeElapsedColumn(), TimeRemainingColumn())
    with Progress(*columns, console=console or Console(stderr=True), transient=True) as progress:
        task = progress.add_task("", total=batch.expected, files=_of(done, batch))
        progress.update(task, completed=seconds)
        for files, more in steps:
            done += files
            progress.update(task, advance=more, total=batch.expected, files=_of(done, batch))


def _of(done: int, batch: "Batch") -> str:
    return f"{done} of {len(batch.files)}"


def _files(number: int) -> str:
    return "1 file" if number == 1 else f"{number} files"


def rendered(
    form: Format,
    reports: Sequence[FileReport],
    verbose: bool,
    *,
    to_terminal: bool,
    run: json.RunInfo | None = None,
) -> Iterator[str]:
    """The reports in one format, bit by bit where the format allows it; JSON also with what is known of the run."""
    if form is Format.JSON:
        return json.pieces(total(tallies_of(reports)), _parts(reports), run)
    if form is Format.CSV:
        from ptmcalc.report import csv

        return csv.pieces(reports)
    if not to_terminal:
        return iter([render(form, reports, verbose=verbose)])
    color = "NO_COLOR" not in os.environ and os.environ.get("TERM") != "dumb"
    width = get_terminal_size((120, 40)).columns
    return iter([render(form, reports, width=width, color=color, verbose=verbose)])


def tallies_of(reports: Sequence[FileReport]) -> Iterable[Tally]:
    """What a summary needs of each file; of a batch without taking every report from the store."""
    if isinstance(reports, tuple):
        return map(tally, reports)
    from ptmcalc.engine.batch import Results

    return reports.tallies() if isinstance(reports, Results) else map(tally, reports)


def _parts(reports: Sequence[FileReport]) -> Iterator[tuple[str, str]]:
    """Each file with its part of the JSON; of a batch as the store has it."""
    if not isinstance(reports, tuple):
        from ptmcalc.engine.batch import Results

        if isinstance(reports, Results):
            for index, (name, text) in enumerate(reports.texts()):
                yield name, text.decode() if text else json.part_of(reports[index])
            return
    yield from ((report.path, json.part_of(report)) for report in reports)


def write(path: Path, pieces: Iterable[str]) -> None:
    """Write a file bit by bit.

    Raises:
        UsageError: it cannot be written.
    """
    try:
        with path.open("w", encoding="utf-8", errors="replace") as file:
            file.writelines(pieces)
    except OSError as error:
        raise UsageError(f"cannot write `{path}`: {error.strerror}") from None


def _told(chosen: Chosen) -> list[FileReport]:
    """Reports of folders and patterns that hold no design file, and of links that are not followed."""
    told = []
    for word in chosen.empty:
        what = "the folder holds no design file" if Path(word).is_dir() else "no design file has this name"
        left_out = f"; {chosen.excluded} are left out" * bool(chosen.excluded)
        problem = Diagnostic("TXT102", what + left_out, hint="design files end in .yaml or .yml")
        told.append(FileReport(word, diagnostics=(problem,)))
    for path in chosen.outside:
        problem = Diagnostic("TXT113", "the link leads out of the folder that is checked", hint="name the file itself")
        told.append(FileReport(path.as_posix(), diagnostics=(problem,)))
    return told


def _listed() -> list[str]:
    """Names from standard input: one a line, or with a NUL behind each.

    Raises:
        UsageError: it is closed, or cannot be read.
    """
    if sys.stdin is None:
        raise UsageError("standard input is closed, and `-` reads a list of files from it", "pipe one in")
    try:
        bytes_of_it = getattr(sys.stdin, "buffer", None)  # names of files need not be UTF-8
        text = os.fsdecode(bytes_of_it.read()) if bytes_of_it is not None else sys.stdin.read()
    except OSError as error:
        raise UsageError(f"standard input cannot be read: {error.strerror}", "pipe a list of files in") from None
    names = text.split("\0") if "\0" in text else text.splitlines()
    return [name for name in names if name.strip()]


def _jobs(text: str) -> int | None:
    """A number of processes; None where it is left to us."""
    if text == "auto":
        return None
    if not text.isdecimal() or not 1 <= int(text) <= 1024:
        raise UsageError(f"`--jobs {text}` is not a number of processes", "write auto, or a number from 1 up")
    return int(text)


def _cores() -> int:
    """Cores this process may use."""
    allowed = getattr(os, "sched_getaffinity", None)
    return len(allowed(0)) if allowed else os.cpu_count() or 1
