"""Which of many inputs a run takes: the first, or another part at every commit; the nightly run takes all of them."""

import os
import subprocess
from collections.abc import Sequence
from functools import cache
from typing import Any

import pytest

from support.command import ROOT


@cache
def commit() -> int:
    """A number that changes with every commit: `PTMCALC_TURN`, else the commit's hash; 0 outside a repository."""
    if given := os.environ.get("PTMCALC_TURN"):
        return int(given)
    command = ["git", "-C", str(ROOT), "rev-parse", "HEAD"]
    try:
        return int(subprocess.run(command, capture_output=True, text=True, check=True).stdout, 16)
    except (OSError, subprocess.CalledProcessError):
        return 0


def in_turn(parts: Sequence[Any]) -> list[Any]:
    """Parameters of a test: the part whose turn it is, and the others as a study."""
    turn = commit() % len(parts)
    return [pytest.param(part, marks=() if k == turn else pytest.mark.study) for k, part in enumerate(parts)]


def first_of(count: int, inputs: Sequence[Any]) -> list[Any]:
    """Parameters of a test: the first inputs, and the others as a study."""
    return [*inputs[:count], *(pytest.param(one, marks=pytest.mark.study) for one in inputs[count:])]
