"""Codes name their kind: none but that is imported to know one."""

import json

import pytest
from support.command import python

from ptmcalc import machines
from ptmcalc.engine import registry
from ptmcalc.engine.registry import begins_a_code, kind_names, load_kind

LOADED = """
import json, sys
from ptmcalc.cli.main import main
try:
    main()
except SystemExit as stop:
    assert stop.code == 0, stop.code
kinds = {name.split(".")[2] for name in sys.modules if name.startswith("ptmcalc.machines.")}
print(json.dumps(sorted(kinds)))
"""


def test_every_code_of_a_kind_begins_with_its_prefix() -> None:
    assert set(machines.PREFIXES) == set(kind_names())
    for name, prefix in machines.PREFIXES.items():
        kind = load_kind(name)
        assert {check.code[:3] for one in (kind, *kind.types) for check in one.checks} == {prefix}


@pytest.mark.parametrize(("word", "known"), [("C", True), ("CRN1", True), ("CRN999", False), ("X", False)])
def test_a_code_is_known_by_its_beginning(word: str, known: bool) -> None:
    assert begins_a_code(word) is known


def test_a_kind_without_a_prefix_is_asked_itself(monkeypatch: pytest.MonkeyPatch) -> None:
    fewer = {name: prefix for name, prefix in machines.PREFIXES.items() if name != "shaft"}
    monkeypatch.setattr(machines, "PREFIXES", fewer)
    assert [begins_a_code(word) for word in ("SHF101", "S", "SHF999", "CNV101")] == [True, True, False, True]


def test_one_kind_is_not_loaded_for_the_codes_of_another(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[str] = []
    monkeypatch.setattr(registry, "_has", lambda name, word: asked.append(name) or True)
    assert begins_a_code("HST")
    assert asked == []
    assert begins_a_code("HST101")
    assert asked == ["hoist"]


def test_a_run_with_a_choice_imports_the_kinds_of_its_files_only() -> None:
    words = ["ptmcalc", "check", "specs/conveyor.yaml", "--no-repairs", "--select", "CNV101", "--ignore", "SPC,CNV102"]
    done = python("-c", f"import sys; sys.argv = {words!r}\n{LOADED}")
    assert (done.status, done.err) == (0, "")
    assert json.loads(done.out.splitlines()[-1]) == ["conveyor"]
