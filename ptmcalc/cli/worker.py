"""What a process of a batch does: texts in, records out. Importing this module imports all that a check needs."""

import multiprocessing
import os
import shutil
import signal
import tempfile
import threading
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import Executor, ProcessPoolExecutor
from datetime import date
from functools import partial
from multiprocessing.util import get_temp_dir
from types import TracebackType

from ptmcalc import machines
from ptmcalc.engine.batch import fresh, record_of
from ptmcalc.engine.check import Options
from ptmcalc.engine.registry import kind_names
from ptmcalc.engine.store import Record
from ptmcalc.report import json

_LONGEST_PLACE = 60
"""Bytes of the name of the temporary folder in which a server of forks finds room for its socket: a name of a socket
has at most 92 to 108, by system."""
_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


def with_text(texts: Sequence[bytes], options: Options) -> list[Record]:
    """Records of some design files with their JSON."""
    return _records(texts, options)


def only_text(texts: Sequence[bytes], options: Options) -> list[Record]:
    """The JSON of some design files, and of their records no more than that needs."""
    return _records(texts, options, whole=False)


def without_text(texts: Sequence[bytes], options: Options) -> list[Record]:
    """Records of some design files."""
    return _records(texts, options, in_json=False)


def _records(texts: Sequence[bytes], options: Options, *, in_json: bool = True, whole: bool = True) -> list[Record]:
    today, records = options.today or date.today(), []
    for raw in texts:
        report = fresh(raw, options)
        text = json.part_of(report).encode() if in_json else b""
        records.append(record_of(report, raw, today, text, whole=whole))
    return records


def pool(jobs: int, kinds: Iterable[str]) -> Callable[[], Executor]:
    """What makes executors of so many processes, which begin with the kinds of machines imported.

    A process works in one thread, leaves an interrupt to the command, and ends with it, however that ends.
    """
    for name in _THREADS:
        os.environ.setdefault(name, "1")
    short = len(os.fsencode(tempfile.gettempdir())) <= _LONGEST_PLACE
    start = "forkserver" if short and "forkserver" in multiprocessing.get_all_start_methods() else "spawn"
    context = multiprocessing.get_context(start)
    if start == "forkserver":
        known = kind_names()
        ours = [f"{machines.__name__}.{kind}" for kind in kinds if kind in known]
        context.set_forkserver_preload(["ptmcalc.cli.app", __name__, *ours])
    folder = get_temp_dir() if start == "forkserver" else ""
    return partial(_Pool, jobs, mp_context=context, initializer=_begin, initargs=(folder,))


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
