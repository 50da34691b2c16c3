"""What the commands print, on streams that may be closed early or cannot show every character."""

import os
import sys
from collections.abc import Iterable
from io import TextIOWrapper
from typing import TextIO

import typer


def steady_streams() -> None:
    """What a stream cannot encode is printed as `?` and ends no run; a pipe gets UTF-8 unless somebody chose else."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            chosen = stream.isatty() or "PYTHONIOENCODING" in os.environ
            stream.reconfigure(encoding=None if chosen else "utf-8", errors="replace")


def say_all(pieces: Iterable[str]) -> None:
    """Print texts one after the other, as `say` does."""
    if sys.stdout.isatty():
        for piece in pieces:
            say(piece)
        return
    try:
        sys.stdout.writelines(pieces)
        sys.stdout.flush()
    except BrokenPipeError:
        _let_go(sys.stdout)


def say(text: str, *, err: bool = False) -> None:
    """Print a text as it is. A reader that has gone away (`| head`) changes no exit status."""
    try:
        typer.echo(text, nl=False, err=err)
    except BrokenPipeError:
        _let_go(sys.stderr if err else sys.stdout)


def _let_go(stream: TextIO) -> None:
    os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
