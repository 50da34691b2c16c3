"""Entry point of the command line: what can go wrong, by exit status."""

import copy
import os
import sys
from collections.abc import Sequence
from typing import NoReturn

import typer

from ptmcalc.base.errors import UsageError
from ptmcalc.base.words import shown
from ptmcalc.cli.app import app
from ptmcalc.cli.options import history_with_its_value
from ptmcalc.cli.output import is_full, let_go_of_all, say, steady_streams

EXIT_USAGE, EXIT_BUG = 2, 4


def main() -> None:
    """Entry point: maps what can go wrong to exit statuses."""
    try:
        steady_streams()
        sys.argv[1:] = history_with_its_value(sys.argv[1:])
        _with_one_command(sys.argv[1:])()
    except UsageError as error:
        _fail(error)
    except KeyboardInterrupt:
        sys.exit(130)
    except Exception as error:
        if isinstance(error, OSError) and is_full(error):  # help and usage are printed by typer
            say(f"ptmcalc: cannot write: {error.strerror}\n", err=True)
            let_go_of_all()
            sys.exit(EXIT_USAGE)
        if os.environ.get("PTMCALC_TRACEBACK"):
            raise
        say(
            f"ptmcalc: internal error: {type(error).__name__}: {shown(str(error))}\n"
            "This is an error of ptmcalc, not of the file. Please report it with the file and the output of the same"
            " command under PTMCALC_TRACEBACK=1.\n",
            err=True,
        )
        sys.exit(EXIT_BUG)


def _with_one_command(words: Sequence[str]) -> typer.Typer:
    """The command line with the command that is called alone: typer reads the options of every one it has."""
    called = [one for one in app.registered_commands if one.callback and [one.callback.__name__] == list(words[:1])]
    if not called:
        return app
    alone = copy.copy(app)
    alone.registered_commands = called
    return alone


def _fail(error: UsageError) -> NoReturn:
    say(f"ptmcalc: {shown(error.message)}" + (f" ({shown(error.hint)})" if error.hint else "") + "\n", err=True)
    sys.exit(EXIT_USAGE)
