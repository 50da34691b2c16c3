"""`ptmcalc scale`: rows, tables and faults as a shell sees them."""

import json
from pathlib import Path
from typing import Any

import pytest
from support.command import Done, ptmcalc, unpainted

from ptmcalc.cli.options import Law
from ptmcalc.engine.registry import kind_names, load_kind
from ptmcalc.laws import similarity

SPECS = Path(__file__).parent / "specs"
PASSING, FAULTY = SPECS / "passing.yaml", SPECS / "faulty.yaml"


def scaled(*arguments: str | Path) -> dict[str, Any]:
    done = ptmcalc("scale", *arguments, "--format", "json")
    assert (done.status, done.err) == (0, "")
    found = json.loads(done.out)
    assert isinstance(found, dict)
    return found


def rows(found: dict[str, Any], scene: str = "run_loaded") -> dict[str, dict[str, Any]]:
    return {row["load"]: row for row in found["rows"] if row["scene"] == scene}


def checked(path: Path) -> dict[tuple[str, str], float]:
    (file,) = json.loads(ptmcalc("check", path, "--format", "json").out)["files"]
    return {(scene["name"], load["name"]): load["value"] for scene in file["scenes"] for load in scene["loads"]}


def test_the_laws_are_those_of_similarity() -> None:
    assert {law.value for law in Law} == {similarity.FULL, similarity.GEOMETRIC, similarity.BALLAST}


@pytest.mark.parametrize("law", Law)
@pytest.mark.parametrize("kind", kind_names())
def test_every_kind_has_a_model_by_every_law(kind: str, law: Law, tmp_path: Path) -> None:
    file = tmp_path / f"{kind}.yaml"
    file.write_text(load_kind(kind).template, encoding="utf-8")
    found = scaled(file, "--length", "1:10", "--law", law)
    assert found["schema_version"] == "1"
    assert set(found["scales"]) >= {"length", "force", "mass", "stiffness", "frequency", "time", "velocity", "moment"}
    assert found["distortions"]
    prototype = checked(file)
    names = {(row["scene"], row["load"]) for row in found["rows"]}
    assert {name for _, name in set(prototype) - names} <= {"energy_residual"}  # of the numerics, not of a machine
    for row in found["rows"]:
        assert row["prototype"] == pytest.approx(prototype[row["scene"], row["load"]], rel=1e-9)
        if row["scale"] is None:
            assert law == Law.GEOMETRIC
            assert row["distorted"] is True
        elif row["prototype"] is not None:
            assert row["model"] == pytest.approx(row["prototype"] * row["scale"], rel=1e-9)
            assert row.get("unbounded") or row["low"] <= row["model"] <= row["high"]


def test_the_model_of_a_run_by_hand() -> None:
    """C_E = C_rho = 1, 1:10. Static resistance (f C + slope) m g L: its mass is 1e-3 that of the prototype, where
    forces are to be 1e-2; mounting tension and inertia are the builder's."""
    found = rows(scaled(PASSING, "--length", "1:10", "--law", "geometric"))
    resistance, tension = found["static_resistance"], found["tension_run_off_min"]
    assert (resistance["scale"], resistance["unit"]) == (None, "N")
    assert resistance["model"] == pytest.approx(1e-3 * resistance["prototype"], rel=1e-9)
    assert resistance["similar"] == pytest.approx(1e-2 * resistance["prototype"], rel=1e-9)
    assert tension["scale"] == pytest.approx(1e-2)
    assert (tension["prototype"], tension["model"]) == pytest.approx((30e3, 300))
    assert "distorted" not in tension
    assert found["sag_relative_max"]["distorted"] is True  # w l/(8 S)
    by_hand = scaled(PASSING, "--length", "0.1", "--law", "geometric", "--gravity", "10")
    assert all(row["scale"] is not None for row in by_hand["rows"])


def test_what_gravity_distorts_is_named() -> None:
    said = scaled(PASSING, "--length", "1:10", "--law", "geometric", "--scene", "run_loaded")["distortions"]
    (named,) = (text for text in said if text.startswith("gravity affects"))
    assert "`sag_relative_max`" in named
    assert "`static_resistance`" in named
    assert "tension_run_off_min" not in named
    assert "0.1 times its gravity" in named


def test_scales_and_the_ratio_that_follows() -> None:
    found = scaled(PASSING, "--length", "1:4", "--law", "full")
    assert (found["law"], found["follows"]) == ("full", "modulus")
    assert {name: found["scales"][name] for name in ("length", "modulus", "density", "gravity", "force", "mass")} == (
        pytest.approx({"length": 1 / 4, "modulus": 1 / 4, "density": 1, "gravity": 1, "force": 1 / 64, "mass": 1 / 64})
    )
    assert found["scales"]["time"] == pytest.approx(0.5)
    assert scaled(PASSING, "--length", "1:4", "--law", "ballast")["follows"] is None


def test_ratios_may_be_given() -> None:
    arguments = ("--length", "1 : 4", "--law", "full", "--modulus", "1:2", "--gravity", "1")
    found = scaled(PASSING, *arguments)
    assert found["follows"] == "density"
    assert found["scales"]["density"] == pytest.approx(2)
    assert scaled(PASSING, *arguments, "--density", "2")["scales"] == found["scales"]


@pytest.mark.parametrize("length", ["1:10", "0.1", "1e-1", "2:20", ".5:5", " 1 : 10 "])
def test_a_length_may_be_written_in_several_ways(length: str) -> None:
    found = scaled(PASSING, "--length", length, "--law", "ballast", "--scene", "run_loaded")
    assert found["scales"]["length"] == pytest.approx(0.1)


def test_one_scene_may_be_chosen() -> None:
    found = scaled(PASSING, "--length", "1:2", "--law", "ballast", "--scene", "start_empty")
    assert {row["scene"] for row in found["rows"]} == {"start_empty"}


def test_a_machine_of_its_own_size_is_its_own_model() -> None:
    found = scaled(PASSING, "--length", "1", "--law", "geometric")
    assert all(row["model"] == row["prototype"] for row in found["rows"])
    assert all(value == pytest.approx(1) for value in found["scales"].values())


# -- the table ------------------------------------------------------------------------------------------------------


def test_the_table_shows_scales_loads_and_distortions() -> None:
    done = ptmcalc("scale", PASSING, "--length", "1:10", "--law", "geometric", "--scene", "run_loaded")
    assert (done.status, done.err) == (0, "")
    lines = [" ".join(line.split()) for line in done.out.splitlines()]
    assert lines[0] == f"{PASSING.as_posix()} conveyor Yard conveyor"
    assert lines[1] == "model by the law `geometric`: length 0.1, modulus 1, density 1, gravity 1"
    headings = [line for line in lines if line in ("Scales", "Loads", "What this model distorts")]
    assert headings == ["Scales", "Loads", "What this model distorts"]
    assert "frequency 10" in lines
    assert "run_loaded T2 leaving drive pulley, minimum 30 kN 0.01 300 N" in lines
    assert any(line.startswith("run_loaded belt sag ratio h/a, maximum") and " distorted " in line for line in lines)
    text = " ".join(lines)
    for part in ("damping ratio", "friction coefficients", "slope of a motor curve", "clearance due to tolerances"):
        assert part in text, part
    assert max(map(len, done.out.splitlines())) <= 120
    assert all(line == line.rstrip() for line in done.out.splitlines())


def test_the_table_says_which_ratio_follows() -> None:
    out = ptmcalc("scale", PASSING, "--length", "1:10", "--law", "full").out
    assert "model by the law `full`: length 0.1, modulus 0.1 (follows), density 1, gravity 1\n" in out
    assert " distorted " not in out


def test_an_unprintable_name_does_not_reach_the_terminal(tmp_path: Path) -> None:
    file = tmp_path / "odd.yaml"
    text = PASSING.read_text("utf-8").replace("name: Yard conveyor", 'name: "a\\e[31mred"')
    file.write_text(text, encoding="utf-8")
    out = ptmcalc("scale", file, "--length", "1:10", "--law", "ballast", "--scene", "run_loaded").out
    assert "\x1b" not in out
    assert "\\x1b[31mred" in out


def test_a_remark_of_the_numerics_stands_below(tmp_path: Path) -> None:
    file = tmp_path / "fine.yaml"
    file.write_text(PASSING.read_text("utf-8") + "\naccuracy: 0.000001 %\n", encoding="utf-8")
    arguments = ("scale", file, "--length", "1:10", "--law", "ballast", "--scene", "start_empty")
    assert "\nNUM105 scene `start_empty`: " in ptmcalc(*arguments).out
    assert {one["code"] for one in scaled(*arguments[1:])["findings"]} == {"NUM105"}


# -- faults ---------------------------------------------------------------------------------------------------------

LENGTH, LAW = ("--length", "1:10"), ("--law", "ballast")


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--length", "0,1", *LAW), "--length `0,1` is not a ratio (write `0.1`)"),
        (("--length", "1:10:2", *LAW), "--length `1:10:2` is not a ratio (write model to prototype, 1:10 or 0.1)"),
        (("--length", "100 mm", *LAW), "--length `100 mm` is not a ratio"),
        (("--length", "", *LAW), "--length `` is not a ratio"),
        (("--length", "nan", *LAW), "--length `nan` is not a ratio"),
        (("--length", "0", *LAW), "--length `0` is out of range (a ratio of model to prototype is 1e-06 to 1e+06)"),
        (("--length", "1:0", *LAW), "--length `1:0` is out of range"),
        (("--length", "-1:10", *LAW), "--length `-1:10` is out of range"),
        (("--length", "-1:-10", *LAW), "--length `-1:-10` is out of range"),
        (("--length", "1e-9", *LAW), "--length `1e-9` is out of range"),
        (("--length", "1e999", *LAW), "--length `1e999` is out of range"),
        (("--length", "1e999:1e999", *LAW), "--length `1e999:1e999` is out of range"),
        (("--length", "2", *LAW), "the copy weighs 2 times what it should; ballast cannot be taken off it"),
        ((*LENGTH, *LAW, "--modulus", "soft"), "--modulus `soft` is not a ratio"),
        ((*LENGTH, *LAW, "--density", "0"), "--density `0` is out of range"),
        ((*LENGTH, *LAW, "--gravity", "-1"), "--gravity `-1` is out of range"),
        (
            (*LENGTH, "--law", "full", "--modulus", "1", "--density", "1", "--gravity", "1"),
            "full similarity needs a density scale of 10, not 1 (of modulus, density and gravity one that is left out"
            " follows)",
        ),
        ((*LENGTH, *LAW, "--scene", "stop"), "unknown scene `stop` (scenes: run_loaded, start_empty)"),
    ],
)
def test_a_fault_is_one_message(arguments: tuple[str, ...], said: str) -> None:
    done = ptmcalc("scale", PASSING, *arguments)
    assert (done.status, done.out) == (2, "")
    assert done.err.startswith(f"ptmcalc: {said}")
    assert done.err.count("\n") == 1


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ((PASSING, *LAW), "--length"),
        ((PASSING, *LENGTH), "--law"),
        ((PASSING, *LENGTH, "--law", "half"), "half"),
        ((PASSING, *LENGTH, *LAW, "--format", "xml"), "xml"),
        (LENGTH + LAW, "Missing argument"),
    ],
)
def test_what_is_missing_or_unknown_is_wrong_usage(arguments: tuple[str | Path, ...], said: str) -> None:
    done = ptmcalc("scale", *arguments)
    assert (done.status, done.out) == (2, "")
    assert said in unpainted(done.err)


@pytest.mark.parametrize(("path", "code"), [(FAULTY, "SPC106"), (SPECS / "absent.yaml", "TXT101")])
def test_a_file_that_cannot_be_read_is_explained(path: Path, code: str) -> None:
    done: Done = ptmcalc("scale", path, *LENGTH, *LAW)
    assert (done.status, done.out) == (2, "")
    assert f"error {code}" in done.err
