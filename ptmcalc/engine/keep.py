"""Results of files whose chunk is still worked on: each is in the store within a moment of its end.

A chunk comes back as a whole, and one slow file holds up those that were done before it. A process that is killed
meanwhile would take them with it.
"""

from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from threading import Lock, Timer
from types import TracebackType
from typing import Self

from ptmcalc.base.errors import UsageError
from ptmcalc.engine.batch import Keys
from ptmcalc.engine.check import Options
from ptmcalc.engine.store import Record, Store

MOMENT = 0.3
"""Seconds that a result waits for others before it is stored. A numerical choice: a larger value needs fewer
transactions and loses more work where a process is killed."""


class Keeper:
    """Adds results to a store from a thread of its own, while the process works on the next file.

    The chunk brings the same results back when it ends, so that a store that cannot be written to is told there.
    """

    def __init__(self, place: str, options: Options) -> None:
        self._place, self._keys, self._lock = Path(place), Keys(options), Lock()
        self._waiting: list[tuple[bytes, Record]] = []
        self._timer: Timer | None = None

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        with self._lock:
            timer, self._timer = self._timer, None
        if timer is not None:
            timer.cancel()
            timer.join()

    def add(self, raw: bytes, record: Record) -> None:
        """Have the result of a text kept soon; not what our own program broke down on."""
        if record.tally.broken:
            return
        with self._lock:
            self._waiting.append((self._keys.of(raw), record))
            if self._timer is None:
                self._timer = Timer(MOMENT, self._write)
                self._timer.daemon = True
                self._timer.start()

    def _write(self) -> None:
        with self._lock:
            waiting: Sequence[tuple[bytes, Record]] = self._waiting
            self._waiting, self._timer = [], None
        with suppress(UsageError), Store(self._place) as store:
            store.add(waiting)
