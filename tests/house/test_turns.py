"""Samples take turns: after a few commits each test has run, and what takes turns exists."""

import re
from itertools import permutations

import pytest
from support import turns
from support.command import ROOT

EXTREME = 10
FILES = [f"tests/coverage/test_{name}.py" for name in "abcdefg"]
TESTS = [f"{file}::test[{k}]" for file in FILES for k in range(3)] + [
    *(f"tests/stability/test_zoo.py::test[{k}]" for k in range(EXTREME)),
    *(f"tests/laws/test_sag.py::test[{k}]" for k in range(turns.MANY)),
]
LONG = [f"tests/laws/test_sag.py::test_long[{k}]" for k in range(4 * turns.MANY - 1)]


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
    share = turns.BY_TEST["tests/stability"]
    assert sum("/stability/" in name for name in running) in (EXTREME // share, EXTREME // share + 1)
    files = {name.partition("::")[0] for name in running if "/coverage/" in name}
    share = turns.BY_FILE["tests/coverage"]
    assert len(files) in (len(FILES) // share, len(FILES) // share + 1), "whole files take turns"
    assert sum("/coverage/" in name for name in running) == 3 * len(files)


def test_the_cases_of_a_long_table_take_turns(monkeypatch: pytest.MonkeyPatch) -> None:
    """They are four parts of about equal size, but not in rooms whose tables run as a whole."""
    found = set()
    for commit in range(4):
        monkeypatch.setattr(turns, "commit", lambda commit=commit: commit)
        running = set(LONG) - turns.later(LONG, {})
        assert len(running) in (turns.MANY - 1, turns.MANY)
        found |= running
        whole = [name.replace("tests/laws", "tests/reference") for name in LONG]
        assert turns.later(whole, {}) == set()
    assert found == set(LONG)


def test_one_function_of_a_file_takes_turns_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """Not one whose name begins like its own; a class takes turns as a whole."""
    file = "tests/engine/test_points.py"
    names = [*(f"{file}::test_lanes[{k}]" for k in range(6)), f"{file}::test_lanes_too", f"{file}::TestA::test_lanes"]
    monkeypatch.setattr(turns, "MANY", 10)
    monkeypatch.setattr(turns, "BY_TEST", {f"{file}::test_lanes": 3})
    monkeypatch.setattr(turns, "commit", lambda: 1)
    assert turns.later(names, {}) == {names[k] for k in (0, 1, 3, 4)}
    monkeypatch.setattr(turns, "BY_TEST", {f"{file}::TestA": 2})
    assert turns.later(names, {}) == {names[-1]}


@pytest.mark.parametrize("turn", range(3))
def test_of_what_a_fixture_costs_much_for_one_in_so_many_is_made(turn: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(turns, "commit", lambda: turn)
    now = [one.values[0] for one in turns.share_of(3, "abcdefg") if not one.marks]
    assert now == list("abcdefg")[-turn % 3 :: 3]


@pytest.mark.parametrize("room", [*turns.BY_TEST, *turns.BY_FILE])
def test_what_takes_turns_exists(room: str) -> None:
    path, _, test = room.partition("::")
    assert (ROOT / path).exists()
    for name in test.split("::") if test else ():
        assert re.search(f"(def|class) {name}\\b", (ROOT / path).read_text("utf-8")), name


def test_no_test_takes_two_turns() -> None:
    """It would run where both fall on one commit, which may be never."""
    rooms = [*turns.BY_TEST, *turns.BY_FILE]
    assert not [(one, other) for one, other in permutations(rooms, 2) if one.startswith(other)]
