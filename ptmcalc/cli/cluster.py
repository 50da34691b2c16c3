"""Work on a cluster: the workers of a scheduler of dask.distributed, through the door that a pool of processes uses.

Texts go out and records come back, so a worker needs this very program and no file system. dask gives what a worker
had under way when it was killed to another one; what comes back from nobody is done again.
"""

import logging
import re
import socket
import threading
from asyncio import CancelledError
from collections.abc import Callable, Sequence
from concurrent.futures import BrokenExecutor, Executor, Future, InvalidStateError
from contextlib import suppress
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar

from ptmcalc.base.errors import UsageError
from ptmcalc.engine.batch import Answer, GoneError, LostError, Work, edition
from ptmcalc.engine.check import Options

if TYPE_CHECKING:
    from distributed import Client

P = ParamSpec("P")
T = TypeVar("T")

_ADDRESS = re.compile(r"dask://(?P<place>[^/\s@]+:[0-9]{1,5})/?")
_PATIENCE = 10.0
"""Seconds that a scheduler may take to answer."""
_DEADLINE = 15.0
"""Seconds after which a connection that is begun is given up, whatever dask still waits for."""
_COUNT, _MOST_PARTS = 8, 1000
"""Bytes of the number of parts of a greeting, and more parts than any has: those of a text would be 1e18."""
_LOOK = 0.2
"""Seconds between two looks at a connection."""
_SAME = "install the same ptmcalc, and the same numpy, for the scheduler and its workers (docs/cluster.md)"
_AT_WORK = threading.Lock()
"""A process does one chunk at a time, however many threads its worker has: what is remembered of a machine between two
runs is not made for several."""


class Cluster:
    """What makes executors of a scheduler's workers.

    Raises:
        UsageError: nobody answers at the address, or dask.distributed is not installed.
    """

    def __init__(self, text: str) -> None:
        found = _ADDRESS.fullmatch(text)
        if found is None:
            raise UsageError(
                f"`--executor {text}` is not an executor", "write local, or dask://HOST:PORT of a scheduler"
            )
        self.place = found["place"]
        client = self._client()
        if client is None:
            hint = "start `dask scheduler`, and name where it runs"
            raise UsageError(f"no scheduler of dask answers at `{self.place}`", hint)
        self._ready: _OnCluster | None = _OnCluster(client)

    @property
    def threads(self) -> int:
        """How many tasks its workers take at a time, as far as they are there by now."""
        return sum(self._ready.client.nthreads().values()) if self._ready else 0

    def __call__(self) -> Executor:
        """An executor: the one that is there, or one of a connection made anew where that was lost.

        Raises:
            GoneError: nobody answers any more.
        """
        ready, self._ready = self._ready, None
        if ready is not None:
            return ready
        client = self._client()
        if client is None:
            raise GoneError(f"the scheduler of dask at `{self.place}` is gone", "what came back by then is kept")
        return _OnCluster(client)

    def _client(self) -> "Client | None":
        try:
            from distributed import Client
        except ImportError:
            raise UsageError(
                "a cluster needs dask.distributed, which is not installed", 'python -m pip install "ptmcalc[dask]"'
            ) from None
        _silence()
        host, _, port = self.place.rpartition(":")
        try:
            if not _speaks_first(host.strip("[]"), int(port)):
                return None
        except (OSError, OverflowError, ValueError):
            return None
        return _within(_DEADLINE, lambda: Client(f"tcp://{self.place}", timeout=_PATIENCE, set_as_default=False))


def _silence() -> None:
    """What dask and what it is built on log is said by us, as far as it matters. Its import gives several of its
    loggers levels of their own, so that of the topmost does not count."""
    for name in ("distributed", "tornado", "asyncio", *logging.root.manager.loggerDict):
        if name.partition(".")[0] in ("distributed", "tornado", "asyncio"):
            logging.getLogger(name).setLevel(logging.CRITICAL + 1)


def _speaks_first(host: str, port: int) -> bool:
    """Whether what listens at an address begins as dask does: the number of parts of its greeting, of which there are
    few, as eight bytes. dask itself would wait without end for a server that waits to be spoken to."""
    with socket.create_connection((host, port), _PATIENCE) as connection:
        connection.settimeout(_PATIENCE)
        begun = b""
        while len(begun) < _COUNT and (more := connection.recv(_COUNT - len(begun))):
            begun += more
    return len(begun) == _COUNT and 0 < int.from_bytes(begun, "little") <= _MOST_PARTS


def _within(seconds: float, make: Callable[[], T]) -> T | None:
    """What a function makes; None where it raises, or is not done in time: it goes on then in a thread that ends with
    the process."""
    made: list[T] = []

    def run() -> None:
        with suppress(Exception, CancelledError):
            made.append(make())

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    thread.join(seconds)
    return made[0] if made else None


class _OnCluster(Executor):
    """An executor of a connection to a scheduler, which ends with it.

    What is sent while a connection is being lost may be heard of by nobody, dask included: who waits for it is told
    as soon as the connection is given up, or has not come back within our patience.
    """

    def __init__(self, client: "Client") -> None:
        self.client, self._executor = client, client.get_executor(pure=False)
        self._waiting: set[Future[Any]] = set()
        self._over, self._lost = threading.Event(), False
        threading.Thread(target=self._watch, daemon=True).start()

    def submit(self, work: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> Future[T]:
        outer: Future[T] = Future()
        self._waiting.add(outer)
        outer.add_done_callback(self._waiting.discard)
        try:
            inner = self._executor.submit(_alone, edition(), work, *args, **kwargs)
        except Exception as error:  # the connection is closed: dask has no one word for it
            raise LostError(str(error)) from None
        inner.add_done_callback(lambda inner: _pass_on(inner, outer))
        if self._lost:
            _end(outer, LostError("the connection is lost"))
        return outer

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        self._over.set()
        if cancel_futures:
            self._executor.shutdown(wait=False)
        with suppress(Exception, CancelledError):  # a connection that is lost already has its own troubles
            self.client.close(timeout=_PATIENCE)

    def _watch(self) -> None:
        away = 0.0
        while away < _PATIENCE and self.client.status != "closed":
            if self._over.wait(_LOOK):
                return
            away = 0.0 if self.client.status == "running" else away + _LOOK
        self._lost = True
        for outer in tuple(self._waiting):
            _end(outer, LostError("the connection is lost"))


def _end(outer: "Future[Any]", error: BaseException) -> None:
    with suppress(InvalidStateError):  # it has ended on its own
        outer.set_exception(error)


def _pass_on(inner: "Future[Any]", outer: "Future[Any]") -> None:
    """What became of a task, in the words of a batch."""
    if inner.cancelled():
        _end(outer, LostError("the scheduler lost it"))
        return
    error = inner.exception()
    if error is None:
        with suppress(InvalidStateError):
            outer.set_result(inner.result())
    elif type(error).__name__ == "KilledWorker":
        _end(outer, BrokenExecutor(str(error)))
    elif isinstance(error, ImportError) or "deserialization of the task graph" in str(error):
        _end(outer, UsageError("the cluster cannot run ptmcalc", _SAME))
    else:
        _end(outer, error)


def _alone(program: bytes, work: Work, texts: Sequence[bytes], options: Options, patience: float) -> list[Answer]:
    """On a worker: the work, by the program that asks for it and no other.

    Raises:
        UsageError: the worker has another one, whose results might be others.
    """
    if edition() != program:
        raise UsageError("the cluster has another version of ptmcalc, or of numpy", _SAME)
    with _AT_WORK:
        return work(texts, options, patience)
