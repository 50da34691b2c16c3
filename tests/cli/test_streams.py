"""Standard streams that are closed or full: wrong usage, in one message at most, and never a bug of ours."""

import os
import shlex
import subprocess
import sys
from pathlib import Path

import pytest
from support.command import ROOT, environment

pytestmark = pytest.mark.skipif(not os.path.exists("/dev/full"), reason="the system has no device that is full")
SPEC = Path(__file__).parent / "specs" / "passing.yaml"
FULL, CLOSED = "cannot write to standard output: ", "standard output is closed"


@pytest.mark.parametrize(
    ("words", "streams", "status", "said"),
    [
        (f"check {SPEC}", ">&-", 2, CLOSED),
        (f"check {SPEC}", ">/dev/full", 2, FULL),
        (f"check {SPEC} --format json", ">/dev/full", 2, FULL),
        (f"check {SPEC} --jobs 2 --format table -v", "<&- >/dev/full", 2, FULL),
        (f"check {SPEC} -o json=/dev/full", ">/dev/null", 2, "cannot write `/dev/full`"),
        (f"check {SPEC} --store /dev/full", ">/dev/null", 2, "cannot be used as a store of results"),
        ("kinds", ">/dev/full", 2, FULL),
        ("--version", ">&-", 2, CLOSED),
        ("--help", ">/dev/full", 2, "cannot write: "),
        ("check -", "<&-", 2, "standard input is closed"),
        (f"check {SPEC}", "<&- >/dev/null", 0, ""),
        (f"check {SPEC}", "2>&- >/dev/null", 0, ""),
        (f"check {SPEC}", "2>/dev/full >&-", 2, ""),
        ("check nowhere --format none", "2>/dev/full", 2, ""),
        (f"check {SPEC}", ">&- 2>&- <&-", 2, ""),
    ],
    ids=str,
)
def test_a_stream_that_takes_nothing_is_wrong_usage(words: str, streams: str, status: int, said: str) -> None:
    command = f"{shlex.quote(sys.executable)} -m ptmcalc {words} {streams}"
    done = subprocess.run(
        ["sh", "-c", command], cwd=ROOT, env=environment(ROOT), stderr=subprocess.PIPE, text=True, check=False
    )
    assert (done.returncode, done.stderr.count("\n")) == (status, int(bool(said)))
    assert said in done.stderr


def test_names_in_a_list_need_not_be_utf_8(tmp_path: Path) -> None:
    (tmp_path / os.fsdecode(b"belt-\xff.yaml")).write_bytes(SPEC.read_bytes())
    done = subprocess.run(
        [sys.executable, "-m", "ptmcalc", "check", "-", "--format", "plain"],
        cwd=tmp_path,
        env=environment(ROOT),
        input=b"belt-\xff.yaml\n",
        capture_output=True,
        timeout=60,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, b"")
