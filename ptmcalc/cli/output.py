"""What the commands print, on streams that may be closed early or cannot show every character."""

import os
import re
import sys
from collections.abc import Iterable
from io import TextIOWrapper
from typing import TextIO

PLAIN = (
    (" ±", "+-"),
    ("≥ ", ">="),
    ("≤ ", "<="),
    *zip("±≥≤×─│▁▂▃▄▅▆▇█·²³µ–—−", "~><x-|_.:-=+*#*23u---", strict=True),
)
"""What stands for the signs of a table where only ASCII can be shown; no column shifts."""

_COMMAND = re.compile(r"^[^\S\n]*::|##(?=\w*\[)", re.MULTILINE)
"""Of GitHub; of GitHub, Azure and TeamCity."""


def steady_streams() -> None:
    """What a stream cannot encode ends no run; a pipe gets UTF-8 unless somebody chose else."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            chosen = stream.isatty() or "PYTHONIOENCODING" in os.environ
            stream.reconfigure(encoding=None if chosen else "utf-8", errors="replace")


def _in_its_signs(text: str, stream: TextIO, *, as_it_is: bool) -> str:
    """A text as a stream can show it; what it still cannot is printed as `?`.

    CI servers read what is printed: a line that begins as a command to them, of a file or a machine that is called
    so, gets a backslash in front of it. A text that goes out `as_it_is` holds no commands but ours.
    """
    if not as_it_is and ("::" in text or "##" in text):
        text = _COMMAND.sub(r"\\\g<0>", text)
    encoding = stream.encoding or "utf-8"
    try:
        if encoding != "utf-8":
            text.encode(encoding)
    except UnicodeEncodeError:
        for sign, other in PLAIN:
            text = text.replace(sign, other)
    return text


def say_all(pieces: Iterable[str], *, as_it_is: bool = False) -> None:
    """Print texts one after the other, as `say` does."""
    if sys.stdout.isatty():
        for piece in pieces:
            say(piece, as_it_is=as_it_is)
        return
    try:
        sys.stdout.writelines(_in_its_signs(piece, sys.stdout, as_it_is=as_it_is) for piece in pieces)
        sys.stdout.flush()
    except BrokenPipeError:
        _let_go(sys.stdout)


def say(text: str, *, err: bool = False, as_it_is: bool = False) -> None:
    """Print a text. A reader that has gone away (`| head`) changes no exit status."""
    stream = sys.stderr if err else sys.stdout
    try:
        stream.write(_in_its_signs(text, stream, as_it_is=as_it_is))
        stream.flush()
    except BrokenPipeError:
        _let_go(stream)


def _let_go(stream: TextIO) -> None:
    os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
