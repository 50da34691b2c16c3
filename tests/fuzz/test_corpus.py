"""Hostile files made by hand, through the command line: each refused with its codes, or a machine for all that."""

import json
from pathlib import Path

import pytest
from support.command import ptmcalc
from support.corpus import CASES
from support.fuzz import said, watched

from ptmcalc.base.diagnostic import CODES, Severity
from ptmcalc.engine.load import load_text


def test_the_corpus_has_two_hundred_cases_each_for_a_reason_of_its_own() -> None:
    assert len(CASES) >= 200
    assert len({case.reason for case in CASES}) == len({case.raw for case in CASES}) == len(CASES)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.reason[:60])
def test_a_hostile_file_is_refused_with_its_codes_or_is_a_machine(case: tuple[str, bytes, tuple[str, ...]]) -> None:
    _, raw, codes = case
    answer = said(raw)
    assert answer.valid is not bool(codes)
    errors = [d.code for d in load_text(raw, "fuzz.yaml").diagnostics if d.severity is Severity.ERROR]
    assert tuple(dict.fromkeys(errors)) == codes
    assert set(codes) <= CODES.keys()


def test_a_folder_of_all_of_them_ends_with_a_line_for_each_and_no_bug(tmp_path: Path) -> None:
    """Through the entry point, in which a traceback would be status 4."""
    for number, case in enumerate(CASES):
        (tmp_path / f"{number:03}.yaml").write_bytes(case.raw)
    with watched(60):
        done = ptmcalc("check", tmp_path, "--budget", "1 ms", "--no-repairs", "--format", "json")
    assert (done.status, done.err) == (2, "")
    files = json.loads(done.out)["files"]
    assert [Path(file["path"]).stem for file in files] == [f"{number:03}" for number in range(len(CASES))]
    assert [file["verdict"] == "invalid" for file in files] == [bool(case.codes) for case in CASES]
    assert "BUG" not in done.out
    assert "Traceback" not in done.out
