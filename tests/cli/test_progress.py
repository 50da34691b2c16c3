"""What a terminal shows while one file is computed: a line that is gone before the report comes."""

import os
import re
import signal
import sys
import time
from pathlib import Path

import pytest
from support.command import ROOT, python

from ptmcalc.base.progress import followed, step

pty = pytest.importorskip("pty")
LONG = ROOT / "specs" / "conveyor" / "two_drive_conveyor.yaml"


def on_a_terminal(*arguments: str, until: bytes = b"$^") -> tuple[bytes, float]:
    """What a terminal gets from a command, and the seconds until its first letter; `until` ends the command."""
    began, first, said = time.monotonic(), 0.0, b""
    process, end = pty.fork()
    if process == 0:
        os.execv(sys.executable, [sys.executable, "-m", "ptmcalc", *arguments])
    while True:
        try:
            some = os.read(end, 65536)
        except OSError:
            break
        if not some:
            break
        first = first or time.monotonic() - began
        said += some
        if re.search(until, said):
            os.kill(process, signal.SIGKILL)
    os.waitpid(process, 0)
    os.close(end)
    return said, first


def test_a_check_says_which_scene_and_assumption_it_computes_and_takes_it_away() -> None:
    said, _ = on_a_terminal("check", "--no-repairs", LONG.as_posix())
    lines, report = said.decode().rsplit("\r\x1b[2K", 1)
    assert re.search(r"scene \w+ \(\d of \d\)|assumption [\w.]+ = ", lines)
    assert "\x1b[2K" not in report
    assert "CNV101" in report


def test_a_search_says_which_value_it_tries() -> None:
    line = rb"\d s  takeup.tension = [\d.]+ kN, CNV101"
    said, _ = on_a_terminal("solve", LONG.as_posix(), "--check", "CNV101", "--vary", "takeup.tension", until=line)
    assert re.search(line, said)


def test_improve_says_which_value_it_tries(tmp_path: Path) -> None:
    file = tmp_path / "weak.yaml"
    text = (ROOT / "specs" / "hoist.yaml").read_text("utf-8")
    file.write_text(text.replace("mean_starting_torque: 75 N*m", "mean_starting_torque: 45 N*m"), "utf-8")
    line = rb"\d s  motor.mean_starting_torque = [\d.]+ N\*m"
    said, _ = on_a_terminal("improve", file.as_posix(), "--keys", "motor.mean_starting_torque", until=line)
    assert re.search(line, said)


def test_nothing_is_shown_where_nobody_looks() -> None:
    """Standard error of the tests is a pipe."""
    run = python("-m", "ptmcalc", "check", (ROOT / "specs" / "conveyor.yaml").as_posix())
    assert run.err == ""
    assert "\x1b" not in run.out


def test_steps_are_said_to_those_who_follow_and_only_while_they_do() -> None:
    heard: list[str] = []
    with followed(heard.append):
        step("one")
    step("two")
    assert heard == ["one"]
