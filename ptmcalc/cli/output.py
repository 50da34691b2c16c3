"""What the commands print, on streams that may be closed early or cannot show every character."""

import os
import re
import sys
from io import TextIOWrapper

import typer

_COMMAND = re.compile(r"^[^\S\n]*::|##(?=\w*\[)", re.MULTILINE)
"""Of GitHub; of GitHub, Azure and TeamCity."""


def steady_streams() -> None:
    """What a stream cannot encode is printed as `?` and ends no run; a pipe gets UTF-8 unless somebody chose else."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            chosen = stream.isatty() or "PYTHONIOENCODING" in os.environ
            stream.reconfigure(encoding=None if chosen else "utf-8", errors="replace")


def say(text: str, *, err: bool = False, commands: bool = False) -> None:
    """Print a text. A reader that has gone away (`| head`) changes no exit status.

    CI servers read what is printed: a line that begins as a command to them, of a file or a machine that is called
    so, gets a backslash in front of it, unless the text holds `commands` of ours.
    """
    if not commands:
        text = _COMMAND.sub(r"\\\g<0>", text)
    try:
        typer.echo(text, nl=False, err=err)
    except BrokenPipeError:
        gone = sys.stderr if err else sys.stdout
        os.dup2(os.open(os.devnull, os.O_WRONLY), gone.fileno())
