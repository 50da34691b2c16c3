"""What the commands print, on streams that may be closed early or cannot show every character."""

import os
import sys
from io import TextIOWrapper
from typing import TextIO

PLAIN = (
    (" ±", "+-"),
    ("≥ ", ">="),
    ("≤ ", "<="),
    *zip("±≥≤×─│▁▂▃▄▅▆▇█·²³µ–—−", "~><x-|_.:-=+*#*23u---", strict=True),
)
"""What stands for the signs of a table where only ASCII can be shown; no column shifts."""


def steady_streams() -> None:
    """What a stream cannot encode ends no run; a pipe gets UTF-8 unless somebody chose else."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            chosen = stream.isatty() or "PYTHONIOENCODING" in os.environ
            stream.reconfigure(encoding=None if chosen else "utf-8", errors="replace")


def _in_its_signs(text: str, stream: TextIO) -> str:
    """A text as a stream can show it; what it still cannot is printed as `?`."""
    try:
        text.encode(stream.encoding or "utf-8")
    except UnicodeEncodeError:
        for sign, other in PLAIN:
            text = text.replace(sign, other)
    return text


def say(text: str, *, err: bool = False) -> None:
    """Print a text as it is. A reader that has gone away (`| head`) changes no exit status."""
    stream = sys.stderr if err else sys.stdout
    try:
        stream.write(_in_its_signs(text, stream))
        stream.flush()
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
