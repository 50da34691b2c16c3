"""The design files that come with the project are sound, and every kind has one."""

from pathlib import Path

import pytest
from support.command import ROOT, ptmcalc

from ptmcalc.engine.check import design_files
from ptmcalc.engine.registry import kind_names
from ptmcalc.text.document import parse

SPECS = design_files(ROOT / "specs")


def test_the_specs_as_a_whole_pass() -> None:
    done = ptmcalc("check", ROOT / "specs")
    assert (done.status, done.err) == (0, "")
    assert f"{len(SPECS)} file" in done.out


@pytest.mark.parametrize("kind", kind_names())
def test_every_kind_has_a_design_file(kind: str) -> None:
    documents = [parse(path.read_bytes(), path.name).data for path in SPECS]
    assert any(isinstance(data, dict) and data.get("kind") == kind for data in documents)


@pytest.mark.parametrize("kind", kind_names())
def test_what_new_prints_passes(kind: str, tmp_path: Path) -> None:
    file = tmp_path / f"{kind}.yaml"
    file.write_text(ptmcalc("new", kind).out, encoding="utf-8")
    done = ptmcalc("check", file)
    assert (done.status, done.err) == (0, "")
    assert " error " not in done.out
    assert " warning " not in done.out


@pytest.mark.parametrize("path", SPECS, ids=lambda path: path.stem)
def test_a_design_file_says_what_it_describes(path: Path) -> None:
    """A newcomer reads these first: a comment on top, and a name."""
    assert path.read_text("utf-8").startswith("# ")
    data = parse(path.read_bytes(), path.name).data
    assert isinstance(data, dict)
    assert data.get("name")
