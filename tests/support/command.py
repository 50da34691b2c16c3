"""The command line for tests: in this process, or in one of its own."""

import io
import os
import re
import subprocess
import sys
from collections.abc import Mapping
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from unittest import mock

from ptmcalc.cli.main import main
from ptmcalc.contract.report import FileReport
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_file
from support.kept_runs import kept_runs

ROOT = Path(__file__).parents[2]


@dataclass(frozen=True)
class Done:
    """What a command left behind."""

    status: int
    out: str
    err: str


def ptmcalc(*arguments: str | Path) -> Done:
    """The entry point in this process: every exit status goes through it. Runs of solvers are kept from one to the
    next (`support.kept_runs`)."""
    out, err, status = io.StringIO(), io.StringIO(), 0
    words = mock.patch.object(sys, "argv", ["ptmcalc", *map(str, arguments)])
    screen = mock.patch.dict(os.environ, {"COLUMNS": "120"})
    with words, screen, kept_runs(), redirect_stdout(out), redirect_stderr(err):
        try:
            main()
        except SystemExit as stop:
            status = stop.code if isinstance(stop.code, int) else int(stop.code is not None)
    return Done(status, out.getvalue(), err.getvalue())


def unpainted(text: str) -> str:
    """What Typer writes itself, help and usage errors, on one line: without the frames and the colours some CI asks."""
    return " ".join(re.sub("[│╭╮╰╯─]", " ", re.sub(r"\x1b\[[0-9;]*m", "", text)).split())


def environment(*paths: Path, **changes: str) -> dict[str, str]:
    """The environment of a fresh process that finds its packages in `paths` first; nothing widens or colours."""
    kept = {key: value for key, value in os.environ.items() if key not in ("COLUMNS", "PTMCALC_TRACEBACK")}
    return kept | {"PYTHONPATH": os.pathsep.join(map(str, paths)), "PYTHONDONTWRITEBYTECODE": "1"} | changes


def python(*arguments: str | Path, cwd: Path = ROOT, env: Mapping[str, str] | None = None) -> Done:
    """A fresh interpreter, by default in the top folder of the project, where it finds this very `ptmcalc`."""
    done = subprocess.run(
        [sys.executable, *map(str, arguments)],
        cwd=cwd,
        env=env or environment(ROOT),
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=False,
    )
    return Done(done.returncode, done.stdout, done.stderr)


@cache
def report_of_file(path: str) -> FileReport:
    """The report of a file of the project, named from its top folder; made once, as it is immutable."""
    with kept_runs():
        return check(load_file(ROOT / path, path), Options(ledger=True))
