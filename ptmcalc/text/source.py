"""The bytes of a file that somebody else may have made: no more of them than are wanted, and of a file alone."""

import os
import stat
from pathlib import Path

_FLAGS = os.O_RDONLY | getattr(os, "O_BINARY", 0) | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_CLOEXEC", 0)
"""Without waiting for a writer where the file is a pipe."""
_USUAL = 1 << 14
"""Bytes of a usual file: room for the largest costs more than reading one."""


def beginning_of(path: Path, most: int) -> bytes:
    """At most so many bytes of a file from its beginning.

    Raises:
        OSError: it cannot be read, or is no file: a pipe and a device may never end, and are read twice by no batch.
    """
    number = os.open(path, _FLAGS)
    try:
        kind = os.fstat(number).st_mode
        if not stat.S_ISREG(kind):
            raise OSError("it is a folder" if stat.S_ISDIR(kind) else "it is a pipe or a device, not a file")
        with open(number, "rb", closefd=False) as file:
            raw = file.read(min(most, _USUAL))
            return raw if len(raw) < _USUAL else raw + file.read(most - len(raw))
    finally:
        os.close(number)
