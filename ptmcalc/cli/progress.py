"""Progress line on a terminal during a long computation; it is erased before the report."""

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
    """Show the current step and the elapsed time; nothing if standard error is no terminal."""
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
    """The progress line: current step and elapsed time."""

    def __init__(self, stream: TextIO) -> None:
        self.stream, self.text, self.since = stream, "reading", time.monotonic()
        self.done = threading.Event()

    def say(self, text: str) -> None:
        """Change the current step."""
        self.text = text

    def run(self) -> None:
        """Update the line until the computation ends, then erase it."""
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
