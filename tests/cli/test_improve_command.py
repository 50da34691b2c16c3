"""`ptmcalc improve`: what to change so that a file passes. Each value that is told is put into the file and checked."""

import json
from functools import cache
from pathlib import Path
from typing import Any

import pytest
import yaml
from support.command import ROOT, Done, ptmcalc

from ptmcalc.spec.machine import MachineSpec

SPECS = ROOT / "specs"
HOIST = SPECS / "hoist.yaml"
MAST = ROOT / "tests" / "edges" / "crane" / "mast-repair.yaml"
WEAK = "mean_starting_torque: 75 N*m", "mean_starting_torque: 45 N*m"


def answer(done: Done) -> Any:
    assert done.status in (0, 1, 3), done.err
    return json.loads(done.out)


@cache
def changed(path: Path, *changes: tuple[str, str]) -> str:
    """The text of a file with other values."""
    text = path.read_text("utf-8")
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    return text


def written(folder: Path, path: Path, *changes: tuple[str, str]) -> Path:
    file = folder / "changed.yaml"
    file.write_text(changed(path, *changes), "utf-8")
    return file


def verdicts(file: Path) -> dict[tuple[str, str], str]:
    """What a check says, by scene and code; the worst of several parts."""
    report = answer(ptmcalc("check", file, "--no-repairs", "--format", "json"))
    ranks = ("fail", "undecided", "pass")
    found: dict[tuple[str, str], str] = {}
    for scene in report["files"][0]["scenes"]:
        for one in scene["checks"]:
            key = (scene["name"], one["code"])
            found[key] = min(found.get(key, "pass"), one["verdict"], key=ranks.index)
    return found


def with_answer(file: Path, one: dict[str, Any]) -> Path:
    """The file with the values of an answer, by PyYAML alone."""
    data = yaml.safe_load(file.read_text("utf-8"))
    for change in one["changes"]:
        for path in change["paths"]:
            node = data
            for step in path[:-1]:
                node = node[step]
            unit = "" if change["unit"] == "1" else f" {change['unit']}"
            value = change["value"]
            node[path[-1]] = f"{value!r}{unit}" if unit else value
    new = file.with_name("improved.yaml")
    new.write_text(yaml.safe_dump(data), "utf-8")
    return new


def keys_of(one: dict[str, Any]) -> tuple[str, ...]:
    return tuple(change["key"] for change in one["changes"])


def holds(file: Path, found: dict[str, Any]) -> None:
    """Every answer passes what it says, and makes worse what it says: by a check of the changed file."""
    before = verdicts(file)
    assert found["answers"]
    for one in found["answers"]:
        after = verdicts(with_answer(file, one))
        for key in one["passes"]:
            assert after[key["scene"], key["code"]] == "pass"
        worse = {(w["scene"], w["code"]) for w in one["worse"] if w["verdict"] != "pass"}
        assert {key for key, verdict in after.items() if before.get(key) == "pass" and verdict != "pass"} == worse


def improved(file: Path, *arguments: str) -> dict[str, Any]:
    done = ptmcalc("improve", file, "--format", "json", *arguments)
    found: dict[str, Any] = answer(done)
    assert done.status == (0 if found["solved"] else 1)
    return found


def test_a_belt_that_slips_takes_tension_or_a_longer_start(tmp_path: Path) -> None:
    file = written(tmp_path, SPECS / "conveyor.yaml", ("230 kN", "190 kN"), ("time: 30 s", "time: 6 s"))
    found = improved(file, "--keys", "takeup.tension,scenes[*].profile.time,belt.strength")
    assert found["solved"]
    assert {keys_of(one) for one in found["answers"]} == {("takeup.tension",), ("scenes[*].profile.time",)}
    assert found["no_influence"] == ["belt.strength"]
    (time,) = (one for one in found["answers"] if keys_of(one) == ("scenes[*].profile.time",))
    assert time["changes"][0]["paths"] == [["scenes", 1, "profile", "time"], ["scenes", 2, "profile", "time"]]
    assert all(change["relative"] > 0 for one in found["answers"] for change in one["changes"])
    holds(file, found)


def test_a_mast_that_swings_too_long_takes_another_ramp_never_a_longer_wait(tmp_path: Path) -> None:
    """The ramp of one period of the loaded column, about 0.75 s, leaves hardly any swing."""
    file = written(tmp_path, MAST)
    found = improved(file)
    assert [(key["code"], key["verdict"]) for key in found["wanted"]] == [("CRN253", "fail")]
    first = found["answers"][0]
    assert keys_of(first) == ("travel.ramp_rise",)
    assert 0.5 < first["changes"][0]["value"] < 0.8
    assert "settling" not in json.dumps(found)
    holds(file, found)


def test_an_overloaded_wheel_has_one_value_for_all_scenes(tmp_path: Path) -> None:
    file = written(tmp_path, SPECS / "crane_travelling.yaml", ("rating: 120 kN", "rating: 91 kN"))
    found = improved(file, "--keys", "trolley.nearest,drive.acceleration")
    assert len({key["scene"] for key in found["wanted"]}) >= 3
    first = found["answers"][0]
    assert keys_of(first) == ("trolley.nearest",)
    assert first["passes_all"]
    assert "wheels.rating" not in json.dumps(found)
    holds(file, found)


def test_a_weak_hoist_takes_a_stronger_motor_and_is_told_what_else_would_break(tmp_path: Path) -> None:
    file = written(tmp_path, HOIST, WEAK)
    found = improved(file, "--keys", "motor.mean_starting_torque,drum.diameter,gearbox.ratio")
    first = found["answers"][0]
    assert keys_of(first) == ("motor.mean_starting_torque",)
    assert first["worse"] == []
    drum = next(one for one in found["answers"] if keys_of(one) == ("drum.diameter",))
    assert {one["code"] for one in drum["worse"] if one["verdict"] == "fail"} >= {"HST107", "HST108"}
    (gear,) = (one for one in found["answers"] if keys_of(one) == ("gearbox.ratio",))
    assert any("the file states" in note for note in gear["notes"])
    holds(file, found)


def test_the_value_is_the_nearest_one(tmp_path: Path) -> None:
    """A weaker motor by 3 % does not do."""
    file = written(tmp_path, HOIST, WEAK)
    (one,) = improved(file, "--keys", "motor.mean_starting_torque")["answers"]
    one["changes"][0]["value"] *= 0.97
    assert "fail" in verdicts(with_answer(file, one)).values()


def test_where_no_key_suffices_pairs_are_told(tmp_path: Path) -> None:
    file = written(tmp_path, HOIST, WEAK, ("breaking_force: 168 kN", "breaking_force: 40 kN"))
    found = improved(file, "--keys", "rope.breaking_force,motor.mean_starting_torque,drum.dead_wraps")
    assert found["solved"]
    assert set(keys_of(found["answers"][0])) == {"rope.breaking_force", "motor.mean_starting_torque"}
    assert [one["passes_all"] for one in found["answers"]] == [True, False, False]
    holds(file, found)
    text = ptmcalc("improve", file, "--keys", "rope.breaking_force,motor.mean_starting_torque").out
    assert "2 of 2" in text
    assert "1 of 2" in text
    assert " and " in text


def test_of_a_file_that_passes_nothing_is_changed() -> None:
    done = ptmcalc("improve", HOIST)
    assert (done.status, done.err) == (0, "")
    assert done.out.endswith("hoist.yaml: all checks pass: nothing to change\n")
    assert answer(ptmcalc("improve", HOIST, "--format", "json"))["answers"] == []


def test_a_check_may_be_named(tmp_path: Path) -> None:
    file = written(tmp_path, HOIST, WEAK, ("breaking_force: 168 kN", "breaking_force: 40 kN"))
    found = improved(file, "--check", "hst101", "--keys", "rope.breaking_force")
    assert [key["code"] for key in found["wanted"]] == ["HST101"]
    assert found["solved"]
    assert "HST102 passes: nothing to change" in ptmcalc("improve", file, "--check", "HST102").out


def test_where_nothing_helps_the_status_says_so(tmp_path: Path) -> None:
    file = written(tmp_path, HOIST, WEAK)
    done = ptmcalc("improve", file, "--keys", "rope.breaking_force")
    assert done.status == 1
    assert "No key that was tried passes any of them" in done.out
    assert "1 key without influence on them: rope.breaking_force" in done.out


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--keys", "motor.tork"), "`motor.tork` is not a number of this file"),
        (("--keys", "name"), "`name` is not a number of this file"),
        (("--check", "CNV101"), "a hoist has no check `CNV101`"),
        (("--scene", "fly"), "unknown scene `fly`"),
    ],
)
def test_what_cannot_be_asked_is_told(arguments: tuple[str, ...], message: str) -> None:
    done = ptmcalc("improve", HOIST, *arguments)
    assert done.status == 2
    assert message in done.err


def test_an_invalid_file_is_told(tmp_path: Path) -> None:
    file = written(tmp_path, HOIST, ("kind: hoist", "kind: hoist\nropes: 3"))
    done = ptmcalc("improve", file)
    assert done.status == 2
    assert "ropes" in done.err


@pytest.mark.parametrize("kind", ["conveyor", "chain_drive/driven_tail", "hoist", "crane_travelling"])
def test_the_keys_that_a_kind_names_are_numbers_of_its_files(kind: str) -> None:
    """One at least stands in the spec of the kind: a key that was renamed would be left out without notice."""
    from ptmcalc.engine.levers import _named
    from ptmcalc.engine.load import load_file

    loaded = load_file(SPECS / f"{kind}.yaml", kind)
    assert isinstance(loaded.spec, MachineSpec)
    assert loaded.kind is not None
    assert any(_named(loaded, name) is not None for name in loaded.kind.levers)
