"""Which of many inputs a run takes: the first, or another part at every commit; the nightly run takes all of them."""

import os
import subprocess
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from pathlib import PurePosixPath
from typing import Any

import pytest

from support.command import ROOT

BY_TEST = {
    "tests/stability": 4,
    "tests/edges/test_error_bars_meet.py": 4,
    "tests/edges/test_forced_effects.py": 4,
    "tests/edges/test_found_is_said.py": 4,
    "tests/edges/test_longer_windows.py": 4,
    "tests/edges/test_motor_curves.py": 4,
    "tests/edges/test_relations.py": 4,
    "tests/numerics/test_belt_march.py": 4,
    "tests/numerics/test_rope.py": 4,
    "tests/house/test_docs.py": 3,
}
"""Samples of random or extreme machines, and pages whose commands run: one test in so many runs at each commit."""
BY_FILE = {"tests/coverage": 3}
"""The same of whole files, whose tests share one sample."""


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


def later(tests: Iterable[str], seconds: Mapping[str, float]) -> set[str]:
    """Of the names of tests, those of `BY_TEST` and `BY_FILE` whose turn is at another commit.

    Files take their turns in the order of their seconds: each turn takes about as long.
    """
    places: dict[str, list[str]] = {}
    for name in tests:
        places.setdefault(name.partition("::")[0], []).append(name)
    found: set[str] = set()
    for room, turns in BY_FILE.items():
        files = sorted((file for file in places if _within(file, room)), key=lambda file: (-seconds.get(file, 0), file))
        found.update(name for k, file in enumerate(files) if (k + commit()) % turns for name in places[file])
    for room, turns in BY_TEST.items():
        names = [name for file in sorted(places) if _within(file, room) for name in places[file]]
        found.update(name for k, name in enumerate(names) if (k + commit()) % turns)
    return found


def _within(file: str, room: str) -> bool:
    return PurePosixPath(file).is_relative_to(room)
