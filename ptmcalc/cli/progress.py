"""One line on a terminal that says what a long computation does; it is gone when the report is printed."""

import os
import shutil
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TextIO

from ptmcalc.base.progress import followed

_WAIT, _EVERY = 0.2, 0.2
"""Seconds until the line appears, and between two of its states. Engineering choices: a short run shows nothing, and a
reader follows five states a second at most."""
_CLEAR = "\r\x1b[2K"


@contextmanager
def shown() -> Iterator[None]:
    """Show what is computed while it takes; nothing where standard error is no terminal."""
    stream = sys.stderr
    if stream is None or not stream.isatty() or os.environ.get("TERM") == "dumb":
        yield
        return
    line = _Line(stream)
    thread = threading.Thread(target=line.run, daemon=True)
    thread.start()
    try:
        with followed(line.say):
            yield
    finally:
        line.done.set()
        thread.join()


class _Line:
    """The line: what is computed, and for how long already."""

    def __init__(self, stream: TextIO) -> None:
        self.stream, self.text, self.since = stream, "reading", time.monotonic()
        self.done = threading.Event()

    def say(self, text: str) -> None:
        """What is computed from now on."""
        self.text = text

    def run(self) -> None:
        """Write the line anew until the computation is done, then take it away."""
        wait, written = _WAIT, False
        while not self.done.wait(wait):
            wait, written = _EVERY, True
            told = f"{time.monotonic() - self.since:3.0f} s  {self.text}"
            width = shutil.get_terminal_size().columns - 1
            self._write(_CLEAR + told.encode("ascii", "replace").decode()[:width])
        if written:
            self._write(_CLEAR)

    def _write(self, text: str) -> None:
        try:
            self.stream.write(text)
            self.stream.flush()
        except (OSError, ValueError):  # the terminal is gone; the report matters more
            self.done.set()
