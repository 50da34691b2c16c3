"""The design files that come with the project are sound, every kind has one, and none costs more work than it did."""

import json
import re
from pathlib import Path

import pytest
from support.command import ROOT, Done, ptmcalc
from support.examples import UPDATE, as_said, from_checks, keep, names, stored

from ptmcalc.engine.files import design_files
from ptmcalc.engine.registry import kind_names, load_kind
from ptmcalc.text.document import parse

SPECS = design_files(ROOT / "specs")


SCREEN = 52
"""Lines of a terminal that is not small."""
MOST_EVALUATIONS = {
    "conveyor.yaml": 15_000_000,
    "plant_conveyor.yaml": 7_000_000,
    "drivetrain.yaml": 25_000,
    "shaft.yaml": 60_000,
    "crusher_shaft.yaml": 1_200_000,
    "short_conveyor.yaml": 10,
    "reference/bw_02.yaml": 4_000_000,
    "conveyor/decline_conveyor.yaml": 4_000_000,
    "conveyor/hollow_conveyor.yaml": 18_000_000,
    "conveyor/steel_cord_strength.yaml": 3_000_000,
    "conveyor/two_drive_conveyor.yaml": 19_000_000,
    "conveyor/screw_takeup_conveyor.yaml": 8_000_000,
    "conveyor/tail_takeup_conveyor.yaml": 3_000_000,
    "conveyor/overland_conveyor.yaml": 22_000_000,
    "conveyor/grain_conveyor.yaml": 22_000_000,
    "conveyor/fluid_coupling_conveyor.yaml": 60_000_000,
    "conveyor/three_converters_conveyor.yaml": 100_000_000,
    "conveyor/two_loading_points.yaml": 10_000_000,
    "chain_drive.yaml": 100_000,
    "chain_drive/driven_tail.yaml": 3_000_000,
    "chain_drive/roller_drive.yaml": 10_000,
    "chain_drive/inclined_scraper.yaml": 100_000,
    "chain_drive/roller_chain_by_number.yaml": 10_000,
    "hoist.yaml": 30_000,
    "hoist/crane_hoist_converter.yaml": 20_000,
    "hoist/crane_hoist_m5.yaml": 40_000,
    "hoist/rope_proofs.yaml": 20,
    "hoist/winding_paper/height_25_rope_17_5.yaml": 10,
    "hoist/winding_paper/height_30_rope_17_5.yaml": 10,
    "hoist/winding_paper/height_35_rope_17_5.yaml": 10,
    "hoist/winding_paper/height_40_rope_13.yaml": 10,
    "hoist/winding_paper/height_40_rope_14_5.yaml": 10,
    "hoist/winding_paper/height_40_rope_16.yaml": 10,
    "hoist/winding_paper/height_40_rope_17_5.yaml": 10,
    "crane_slewing.yaml": 300,
    "crane_travelling.yaml": 200,
    "crane/portal_slewing.yaml": 1_000,
    "crane_overhead_stacker.yaml": 13_000,
    "crane_rack_stacker.yaml": 120_000,
    "crane/bridge_crane_runway.yaml": 400,
    "crane/container_gantry.yaml": 400,
    "crane/hoist_trolley.yaml": 400,
}
"""Work of all scenes of a file that its check may take: cells and stretches of motion carried on by a step."""


@pytest.fixture(scope="module")
def printed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("specs")


@pytest.fixture(scope="module")
def checked(printed: Path) -> Done:
    """All of them, checked once."""
    return ptmcalc(
        *("check", ROOT / "specs"),
        *("-o", f"table={printed / 'table.txt'}"),
        *("-o", f"json={printed / 'report.json'}"),
        *("-o", f"plain={printed / 'plain.txt'}"),
    )


def test_the_specs_as_a_whole_pass(checked: Done) -> None:
    assert (checked.status, checked.err) == (0, "")
    assert f"{len(SPECS)} file" in checked.out


def test_every_check_stays_within_its_work(checked: Done, printed: Path) -> None:
    assert checked.status == 0
    files = json.loads((printed / "report.json").read_text("utf-8"))["files"]
    work = {
        Path(file["path"]).relative_to(ROOT / "specs").as_posix(): sum(
            scene["health"]["evaluations"] for scene in file["scenes"]
        )
        for file in files
    }
    assert set(work) == set(MOST_EVALUATIONS), "every design file has a gate"
    assert {name: done for name, done in work.items() if not 0 < done <= MOST_EVALUATIONS[name]} == {}


def test_the_report_of_an_overland_conveyor_fits_one_screen(checked: Done, printed: Path) -> None:
    """That of each file begins with the line that names it; behind the last one stand two lines for all."""
    assert checked.status == 0
    titled = [
        part.splitlines()
        for part in re.split(r"^(?=\S*specs/)", (printed / "table.txt").read_text("utf-8"), flags=re.MULTILINE)
    ]
    reports = {Path(lines[0].split("  ")[0]).stem: lines for lines in titled if lines}
    assert sorted(reports) == sorted(path.stem for path in SPECS)
    lines = reports["overland_conveyor"]
    assert len(lines) + 2 <= SCREEN
    assert {"Loads", "Checks", "Effects", "Solvers"} <= {line.split("  ")[0] for line in lines}


@pytest.mark.parametrize("name", kind_names())
def test_explain_shows_what_they_say(checked: Done, printed: Path, name: str) -> None:
    """The examples of `explain`; see `test_explain.py` for those with a file of their own and how to write them."""
    assert checked.status == 0
    kind = load_kind(name)
    files = json.loads((printed / "report.json").read_text("utf-8"))["files"]
    lines = (printed / "plain.txt").read_text("utf-8").replace(f"{ROOT.as_posix()}/", "").splitlines()
    found, before = from_checks(kind, files, lines), stored(kind)
    if UPDATE:
        same = {
            one: before[one]
            for one, (command, line, _) in found.items()
            if one in before and before[one][0] == command and as_said(line, before[one][1])
        }
        keep(kind, {one: kept for one, kept in before.items() if kept[2] and one in names(kind)} | found | same)
        before = stored(kind)
    wrong = [
        one
        for one, (command, line, _) in found.items()
        if one not in before or before[one][0] != command or not as_said(line, before[one][1])
    ]
    assert wrong == [], "run `python tests/update.py examples`"
    assert [one for one, kept in before.items() if not kept[2] and one not in found] == []


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
