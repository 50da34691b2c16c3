"""What the commands print, on streams that may be closed early or cannot show every character."""

import errno
import os
import re
import sys
from collections.abc import Iterable
from contextlib import suppress
from io import TextIOWrapper
from typing import TextIO

from ptmcalc.base.errors import UsageError

PLAIN = (
    (" ±", "+-"),
    ("≥ ", ">="),
    ("≤ ", "<="),
    *zip("±≥≤×─│▁▂▃▄▅▆▇█·²³µ–—−", "~><x-|_.:-=+*#*23u---", strict=True),
)
"""What stands for the signs of a table where only ASCII can be shown; no column shifts."""

_COMMAND = re.compile(r"^[^\S\n]*::|##(?=\w*\[)", re.MULTILINE)
"""Of GitHub; of GitHub, Azure and TeamCity."""


_FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO, errno.EBADF)
"""How a system says that what is written has no place to go: full, over a quota, too large, broken, closed."""


def steady_streams() -> None:
    """What a stream cannot encode ends no run; a pipe gets UTF-8 unless somebody chose else.

    Raises:
        UsageError: there is no standard output.
    """
    for number in range(3):
        _occupied(number)
    if sys.stdout is None:
        raise UsageError("standard output is closed", "leave it open, or write `> /dev/null`")
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
    except OSError as error:
        raise _unwritten(error) from None


def say(text: str, *, err: bool = False, as_it_is: bool = False) -> None:
    """Print a text. A reader that has gone away (`| head`) changes no exit status, nor do messages that nobody takes.

    Raises:
        UsageError: standard output takes no more.
    """
    stream: TextIO | None = sys.stderr if err else sys.stdout
    if stream is None:
        return
    try:
        stream.write(_in_its_signs(text, stream, as_it_is=as_it_is))
        stream.flush()
    except BrokenPipeError:
        _let_go(stream)
    except OSError as error:
        if not err:
            raise _unwritten(error) from None
        _let_go(stream)


def is_full(error: OSError) -> bool:
    """Whether it is a place to write to that failed, which is no fault of the program."""
    return error.errno in _FULL


def let_go_of_all() -> None:
    """What is still to be printed goes nowhere: its stream takes nothing, and the end of the process would say so."""
    for stream in (sys.stdout, sys.stderr):
        if stream is not None:
            with suppress(OSError):
                _let_go(stream)


def _unwritten(error: OSError) -> UsageError:
    _let_go(sys.stdout)
    return UsageError(f"cannot write to standard output: {error.strerror}", "what it printed so far is not whole")


def _let_go(stream: TextIO) -> None:
    other = os.open(os.devnull, os.O_WRONLY)
    os.dup2(other, stream.fileno())
    os.close(other)


def _occupied(number: int) -> None:
    """Give a closed standard stream its number back: else the next file that is opened takes it, and its text."""
    try:
        os.fstat(number)
    except OSError:
        other = os.open(os.devnull, os.O_RDWR)
        if other != number:
            os.dup2(other, number)
            os.close(other)
