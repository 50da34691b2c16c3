"""Processes that work for a batch. Nothing of what they do is imported here, so that they can begin while the command
itself does: what both import takes as long as many a folder."""

import multiprocessing
import os
import shutil
import signal
import tempfile
import threading
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Executor, ProcessPoolExecutor
from functools import partial
from itertools import islice
from multiprocessing import forkserver
from multiprocessing.context import BaseContext
from multiprocessing.util import get_temp_dir
from pathlib import Path
from types import TracebackType

from ptmcalc import machines
from ptmcalc.cli.start import THREADS
from ptmcalc.engine.files import files_below, machine_in
from ptmcalc.text.source import beginning_of

_LONGEST_PLACE = 60
"""Bytes of the name of the temporary folder in which a server of forks finds room for its socket: a name of a socket
has at most 92 to 108, by system."""
_LOOKED_AT, _PEEK = 200, 1 << 12
"""Files, and bytes of each, that are looked at to see what machines there are."""


def begin(names: Iterable[str]) -> None:
    """Have the server of forks started for what the names on a command line, those of files and folders, seem to hold.

    It imports in the meantime what all of them need; where it was wrong about that, a process imports the rest.
    """
    kinds = dict.fromkeys(islice(_machines_in(names), _LOOKED_AT))
    if kinds and _context(kinds).get_start_method() == "forkserver":
        forkserver.ensure_running()


def pool(jobs: int, kinds: Iterable[str]) -> Callable[[], Executor]:
    """What makes executors of so many processes, which begin with the kinds of machines imported.

    A process works in one thread, leaves an interrupt to the command, and ends with it, however that ends.
    """
    context = _context(kinds)
    folder = get_temp_dir() if context.get_start_method() == "forkserver" else ""
    return partial(_Pool, jobs, mp_context=context, initializer=_begin, initargs=(folder,))


def _context(kinds: Iterable[str]) -> BaseContext:
    for name in THREADS:
        os.environ.setdefault(name, "1")
    short = len(os.fsencode(tempfile.gettempdir())) <= _LONGEST_PLACE
    if not (short and "forkserver" in multiprocessing.get_all_start_methods()):
        return multiprocessing.get_context("spawn")
    context = multiprocessing.get_context("forkserver")
    ours = [f"{machines.__name__}.{kind}" for kind in kinds]  # those that are not, it passes over
    context.set_forkserver_preload(["ptmcalc.cli.served", "ptmcalc.cli.main", "ptmcalc.cli.worker", *ours])
    return context


def _machines_in(names: Iterable[str]) -> Iterator[str]:
    for path in (path for name in names for path in files_below(Path(name))):
        try:
            found = machine_in(beginning_of(path, _PEEK))
        except OSError:
            found = b""
        if found:
            yield found.decode()


class _Pool(ProcessPoolExecutor):
    """Processes that end at once where the command breaks off."""

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> bool | None:
        if kind is not None:
            self.shutdown(wait=False, cancel_futures=True)
            for process in list((getattr(self, "_processes", None) or {}).values()):
                process.kill()
        return super().__exit__(kind, error, trace)


def _begin(folder: str) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_end_with, args=(parent.join, folder), daemon=True).start()


def _end_with(ended: Callable[[], None], folder: str) -> None:
    """A process whose command was killed would wait for work forever, and the folder in which the processes met,
    which the command would have deleted, would stay behind."""
    ended()
    if folder:
        shutil.rmtree(folder, ignore_errors=True)
    os._exit(1)
