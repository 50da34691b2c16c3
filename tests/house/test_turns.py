"""Samples take turns: after a few commits each test has run, and what takes turns exists."""

import pytest
from support import turns
from support.command import ROOT

FILES = [f"tests/coverage/test_{name}.py" for name in "abcdefg"]
TESTS = [f"{file}::test[{k}]" for file in FILES for k in range(3)] + [
    *(f"tests/stability/test_zoo.py::test[{k}]" for k in range(10)),
    *(f"tests/laws/test_rail.py::test[{k}]" for k in range(10)),
]


def at(commit: int, monkeypatch: pytest.MonkeyPatch) -> set[str]:
    """The tests that run at a commit."""
    monkeypatch.setattr(turns, "commit", lambda: commit)
    return set(TESTS) - turns.later(TESTS, {FILES[0]: 80.0, FILES[1]: 60.0})


def test_every_test_has_its_turn(monkeypatch: pytest.MonkeyPatch) -> None:
    rounds = max(*turns.BY_TEST.values(), *turns.BY_FILE.values())
    assert set.union(*(at(commit, monkeypatch) for commit in range(rounds))) == set(TESTS)


@pytest.mark.parametrize("commit", range(5))
def test_a_share_of_each_sample_runs_at_a_commit_and_all_else_always(
    commit: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    running = at(commit, monkeypatch)
    assert {name for name in TESTS if "/laws/" in name} <= running
    assert sum("/stability/" in name for name in running) in (2, 3)
    files = {name.partition("::")[0] for name in running if "/coverage/" in name}
    assert len(files) in (2, 3), "whole files take turns"
    assert sum("/coverage/" in name for name in running) == 3 * len(files)


@pytest.mark.parametrize("room", [*turns.BY_TEST, *turns.BY_FILE])
def test_what_takes_turns_exists(room: str) -> None:
    assert (ROOT / room).exists()
