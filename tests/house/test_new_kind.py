"""A new kind of machine is one folder, or one package with an entry point: nothing else is edited.

The kind is `tests/support/toy_kind.py`. Every command is tried in one fresh process per way of adding it.
"""

import json
import re
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from support import toy_kind
from support.command import ROOT, Done, environment, python

DRIVER = """
import contextlib, io, json, sys
from ptmcalc.cli.main import main
done = {}
for name, arguments in json.loads(sys.argv[1]).items():
    sys.argv = ["ptmcalc", *arguments]
    out, err, status = io.StringIO(), io.StringIO(), 0
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            main()
        except SystemExit as stop:
            status = stop.code or 0
    done[name] = [status, out.getvalue(), err.getvalue()]
print(json.dumps(done))
"""

SOURCE = Path(toy_kind.__file__).read_text("utf-8")
SOUND = "kind: toy\nload: 8 kN\nstrength: 10 kN\nshock: 1.1\n"
OVERLOADED = "kind: toy\nload: 12 kN\nstrength: 10 kN\nshock: 1.1\n"


def folder(place: Path) -> list[Path]:
    """A copy of the package with one more folder in it."""
    shutil.copytree(ROOT / "ptmcalc", place / "ptmcalc", ignore=shutil.ignore_patterns("__pycache__"))
    toy = place / "ptmcalc" / "machines" / "toy"
    toy.mkdir()
    (toy / "__init__.py").write_text(SOURCE, encoding="utf-8")
    return [place]


def entry_point(place: Path) -> list[Path]:
    """A package of somebody else, as an installer leaves it, beside the package as it is."""
    (place / "far_machines").mkdir()
    (place / "far_machines" / "__init__.py").write_text(SOURCE, encoding="utf-8")
    info = place / "far_machines-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: far-machines\nVersion: 1.0\n", encoding="utf-8")
    (info / "entry_points.txt").write_text("[ptmcalc.machines]\ntoy = far_machines:KIND\n", encoding="utf-8")
    return [place, ROOT]


@pytest.fixture(scope="module", params=[folder, entry_point], ids=["folder", "entry point"])
def done(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Done]:
    """What each command left behind where the toy is installed."""
    place = tmp_path_factory.mktemp(request.param.__name__)
    add: Callable[[Path], list[Path]] = request.param
    paths = add(place)
    files = {"template": toy_kind.TEMPLATE, "sound": SOUND, "overloaded": OVERLOADED, "faulty": "kind: toi\n"}
    for name, text in files.items():
        (place / f"{name}.yaml").write_text(text, encoding="utf-8")
    commands = {
        "where": ["--version"],
        "kinds": ["kinds", "--format", "json"],
        "schema": ["schema"],
        "schema toy": ["schema", "toy"],
        "solvers": ["solvers", "--format", "json"],
        "explain check": ["explain", "TOY101"],
        "explain effect": ["explain", "swing"],
        "explain solver": ["explain", "hanging"],
        "explain where": ["explain", "TOY101", "--where"],
        "new": ["new", "toy"],
        "plan": ["plan", "sound.yaml", "--format", "json"],
        "solve": ["solve", "overloaded.yaml", "--check", "TOY101", "--vary", "load"],
    }
    commands["select"] = ["check", "sound.yaml", "--select", "TOY101", "--format", "plain"]
    commands |= {f"check {name}": ["check", f"{name}.yaml"] for name in files}
    result = python("-c", DRIVER, json.dumps(commands), cwd=place, env=environment(*paths))
    assert (result.status, result.err) == (0, "")
    found = {name: Done(*one) for name, one in json.loads(result.out).items()}
    for name, one in found.items():
        assert name.startswith("check ") or (one.status, one.err) == (0, ""), name
    return found


def test_it_stands_among_the_kinds(done: dict[str, Done]) -> None:
    rows = json.loads(done["kinds"].out)["rows"]
    assert {"kind": "toy", "title": "a weight on a hook"} in rows
    assert [row["kind"] for row in rows] == sorted(row["kind"] for row in rows)
    assert "conveyor" in {row["kind"] for row in rows}


def test_its_checks_can_be_chosen(done: dict[str, Done]) -> None:
    assert "pass TOY101" in done["select"].out


def test_it_has_a_schema_of_its_own(done: dict[str, Done]) -> None:
    properties = json.loads(done["schema toy"].out)["properties"]
    assert set(properties) >= {"kind", "load", "strength", "shock", "scenes", "name", "effects", "checks"}
    assert properties["load"]["examples"] == ["12 kN"]
    assert properties["load"]["description"] == "weight on the hook"


def test_it_is_one_of_the_machines_of_the_common_schema(done: dict[str, Done]) -> None:
    schema = json.loads(done["schema"].out)
    assert {"$ref": "#/$defs/toy"} in schema["oneOf"]
    assert {"$ref": "#/$defs/conveyor"} in schema["oneOf"]
    assert schema["$defs"]["toy.Hang"]["properties"]["type"]["const"] == "hang"


def test_its_solver_is_listed_with_its_cost(done: dict[str, Done]) -> None:
    (row,) = (row for row in json.loads(done["solvers"].out)["rows"] if row["kind"] == "toy")
    assert (row["solver"], row["scene"], row["predicted_seconds"]) == ("hanging", "hang", 1e-5)
    assert row["error"] == "exact for that model."


@pytest.mark.parametrize(
    ("command", "said"),
    [
        ("explain check", "TOY101: weight on the hook   (toy; scenes: hang)"),
        ("explain effect", "swing: swing of the weight   (toy)"),
        ("explain solver", "hanging: force of a weight set down   (toy)"),
    ],
)
def test_its_parts_are_explained(done: dict[str, Done], command: str, said: str) -> None:
    assert done[command].out.startswith(said)
    assert "**Range**" in done[command].out


def test_the_lines_of_its_check_are_found(done: dict[str, Done]) -> None:
    lines = SOURCE.splitlines()
    path = r"(?:ptmcalc/machines/toy|far_machines)/__init__\.py"
    (check, limit) = re.findall(
        rf"^{path}:([0-9]+): (?:check TOY101, toy|limit of TOY101, .*)$", done["explain where"].out, re.M
    )
    assert "Check(" in lines[int(check) - 1]
    assert lines[int(limit) - 1].startswith("def ")


def test_its_template_is_printed_and_passes(done: dict[str, Done]) -> None:
    assert done["new"].out == toy_kind.TEMPLATE
    assert done["check template"].status == 0
    assert "pass TOY101" in done["check template"].out


@pytest.mark.parametrize(
    ("name", "status", "line"),
    [
        ("sound", 0, "sound.yaml:2:7: pass TOY101 weight on the hook [hang]: 8.8 [8.79, 8.82] kN"),
        (
            "overloaded",
            1,
            "overloaded.yaml:2:7: fail TOY101 weight on the hook [hang]: 13.2 [13.19, 13.23] kN",
        ),
        ("faulty", 2, "did you mean `toy`?"),
    ],
)
def test_its_design_files_are_checked(done: dict[str, Done], name: str, status: int, line: str) -> None:
    assert done[f"check {name}"].status == status
    assert line in done[f"check {name}"].out


def test_the_value_that_passes_is_told(done: dict[str, Done]) -> None:
    """With the swing's bound inside: 10 kN over 1.1 + 0.0025 is 9.0703 kN."""
    assert "passes with load = 9.07 kN" in done["check overloaded"].out
    assert done["solve"].out == "load: 9.07 kN   TOY101 just passes\n"


def test_its_effect_stands_in_the_plan(done: dict[str, Done]) -> None:
    (row,) = json.loads(done["plan"].out)["rows"]
    assert (row["effect"], row["state"], row["solver"]) == ("swing", "skipped", "hanging")
    assert row["criterion"]["value"] == pytest.approx(0.0025)


def test_the_package_itself_knows_nothing_of_it() -> None:
    """What was added to a copy, or named by somebody else's package, is in no file of ours."""
    files = [path for path in (ROOT / "ptmcalc").rglob("*.py") if "toy" in path.read_text("utf-8").lower().split()]
    assert files == []
