"""`check --history`: loads over time in the JSON, in a file, and how the word behind it is read."""

import csv
import json
import math
from pathlib import Path
from typing import Any

import pytest
from support.command import ROOT, Done, ptmcalc, python

from ptmcalc.cli.options import history_with_its_value

PASSING = Path(__file__).parent / "specs" / "passing.yaml"
HOIST = ROOT / "specs" / "hoist.yaml"
"""Lifting evenly it is all numbers, and no course."""

TORQUE, INERTIAS, DURATION = 100.0, (2.0, 3.0), 0.5  # N*m, kg*m^2, s
TRAIN = """\
kind: drivetrain
name: two discs
inertias:
  motor: {inertia: 2 kg*m^2}
  load: {inertia: 3 kg*m^2}
links:
  shaft: {between: [motor, load], stiffness: 20 kN*m/rad, damping: 40 N*m*s/rad, limit: 200 N*m}
torques:
  drive: {at: motor, type: constant, torque: 100 N*m}
scenes:
  - {type: run, duration: 0.5 s}
  - {type: run, name: longer, duration: 0.6 s}
"""


@pytest.fixture
def train(tmp_path: Path) -> Path:
    file = tmp_path / "train.yaml"
    file.write_text(TRAIN, encoding="utf-8")
    return file


def loads(done: Done) -> dict[str, dict[str, Any]]:
    """The loads of the first scene of the first file of a JSON."""
    return {load["name"]: load for load in json.loads(done.out)["files"][0]["scenes"][0]["loads"]}


# -- the word behind it ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("words", "read"),
    [
        ("check a.yaml --history", "check a.yaml --history=json"),
        ("check a.yaml --history x.csv", "check a.yaml --history=x.csv"),
        ("check --history x.csv a.yaml", "check --history=x.csv a.yaml"),
        ("check --history X.CSV a.yaml", "check --history=X.CSV a.yaml"),
        ("check --history a.yaml", "check --history=json a.yaml"),
        ("check --history --format json a.yaml", "check --history=json --format json a.yaml"),
        ("check --history=x.csv a.yaml", "check --history=x.csv a.yaml"),
        ("check --history=json x.csv", "check --history=json x.csv"),
        ("check --history --history x.csv a.yaml", "check --history=json --history=x.csv a.yaml"),
        ("check --history x.csv y.csv", "check --history=x.csv y.csv"),
        ("check -- --history x.csv", "check -- --history x.csv"),
        ("check --history -- x.csv", "check --history=json -- x.csv"),
        ("check x.csv", "check x.csv"),
        ("", ""),
    ],
)
def test_the_word_behind_it_is_a_file_or_a_path(words: str, read: str) -> None:
    assert history_with_its_value(words.split()) == read.split()


def test_a_path_to_check_behind_it_is_checked(train: Path) -> None:
    done = ptmcalc("check", "--format", "json", "--history", train)
    assert done.status == 0
    assert "history" in loads(done)["torque_peak[shaft]"]


@pytest.mark.parametrize("name", ["courses.txt", "courses", ""])
def test_any_other_file_is_refused(name: str, train: Path) -> None:
    done = ptmcalc("check", train, f"--history={name}")
    assert (done.status, done.out) == (2, "")
    assert done.err == f"ptmcalc: `--history={name}` names no .csv file (write `--history`, or `--history FILE.csv`)\n"


# -- in the JSON ----------------------------------------------------------------------------------------------------


def test_loads_carry_their_history_only_when_asked(train: Path) -> None:
    plain = ptmcalc("check", train, "--format", "json")
    asked = ptmcalc("check", train, "--format", "json", "--history")
    assert (plain.status, plain.err, asked.status, asked.err) == (0, "", 0, "")
    assert all("history" not in load for load in loads(plain).values())
    without = loads(asked)
    courses = {name: load.pop("history") for name, load in without.items() if "history" in load}
    assert without == loads(plain)
    assert set(courses) >= {"torque_peak[shaft]", "speed_max[motor]", "speed_max[load]"}
    for name, course in courses.items():
        times = course["t"]
        assert len(times) == len(course["value"]) > 10, name
        assert times == sorted(times), name
        assert (times[0], times[-1]) == (0.0, pytest.approx(DURATION)), name
        assert course["unit"] == without[name]["unit"], name


def test_a_history_is_that_of_the_motion(train: Path) -> None:
    """Two discs from rest under a torque on one: link torque by the closed form of the damped mode."""
    course = loads(ptmcalc("check", train, "--format", "json", "--history"))["torque_peak[shaft]"]["history"]
    motor, load = INERTIAS
    stiffness, damping = 20e3, 40.0
    reduced = motor * load / (motor + load)
    decay, square = damping / (2 * reduced), stiffness / reduced
    omega = math.sqrt(square - decay**2)
    rest = TORQUE / motor / square  # twist the link swings about

    def torque(time: float) -> float:
        fade, phase = math.exp(-decay * time), omega * time
        twist = rest * (1 - fade * (math.cos(phase) + decay / omega * math.sin(phase)))
        speed = rest * fade * math.sin(phase) * square / omega
        return stiffness * twist + damping * speed

    for time, value in zip(course["t"], course["value"], strict=True):
        assert abs(value) == pytest.approx(torque(time), abs=1e-6 * TORQUE)


def test_the_load_is_the_largest_of_its_history(train: Path) -> None:
    peak = loads(ptmcalc("check", train, "--format", "json", "--history"))["torque_peak[shaft]"]
    assert max(map(abs, peak["history"]["value"])) == pytest.approx(peak["value"], rel=0.02)
    assert max(map(abs, peak["history"]["value"])) <= peak["value"] * (1 + 1e-9)


@pytest.mark.parametrize("form", ["plain", "table"])
def test_where_no_json_is_asked_for_it_says_where_histories_are(form: str, train: Path) -> None:
    done = ptmcalc("check", train, "--format", form, "--history")
    assert done.status == 0
    assert done.err == "ptmcalc: a history is in the JSON (--format json) or in a file (--history FILE.csv)\n"
    assert done.out == ptmcalc("check", train, "--format", form).out


def test_a_json_file_carries_them(train: Path, tmp_path: Path) -> None:
    target = tmp_path / "report.json"
    done = ptmcalc("check", train, "--history", "-o", f"json={target}")
    assert (done.status, done.err) == (0, "")
    assert '"history"' in target.read_text("utf-8")


# -- in a file ------------------------------------------------------------------------------------------------------


def test_a_file_holds_every_moment_of_the_json(train: Path, tmp_path: Path) -> None:
    target = tmp_path / "courses.csv"
    done = ptmcalc("check", train, "--history", target, "--format", "json")
    assert (done.status, done.err) == (0, "")
    with target.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert list(rows[0]) == ["file", "scene", "load", "unit", "time", "value", "over"]
    assert {row["file"] for row in rows} == {train.as_posix()}
    expected = [
        (scene["name"], load["name"], load["history"]["unit"], time, value)
        for scene in json.loads(done.out)["files"][0]["scenes"]
        for load in scene["loads"]
        if "history" in load
        for time, value in zip(load["history"]["t"], load["history"]["value"], strict=True)
    ]
    found = [(row["scene"], row["load"], row["unit"], float(row["time"]), float(row["value"])) for row in rows]
    assert found == expected
    assert {scene for scene, *_ in found} == {"run", "longer"}


def test_the_report_is_the_same_beside_a_file(train: Path, tmp_path: Path) -> None:
    done = ptmcalc("check", train, "--history", tmp_path / "courses.csv")
    assert done == ptmcalc("check", train)


def test_several_files_may_be_named(train: Path, tmp_path: Path) -> None:
    one, other = tmp_path / "one.csv", tmp_path / "other.csv"
    assert ptmcalc("check", train, "--history", one, "--history", other).status == 0
    assert one.read_bytes() == other.read_bytes() != b""


def test_a_file_that_cannot_be_written_is_wrong_usage(train: Path, tmp_path: Path) -> None:
    done = ptmcalc("check", train, "--history", tmp_path / "nowhere" / "courses.csv")
    assert done.status == 2
    assert "cannot write" in done.err


def test_an_invalid_file_has_no_histories(tmp_path: Path) -> None:
    faulty, target = tmp_path / "faulty.yaml", tmp_path / "courses.csv"
    faulty.write_text("kind: drivetrain\n", encoding="utf-8")
    assert ptmcalc("check", faulty, "--history", target).status == 2
    assert target.read_text("utf-8") == "file,scene,load,unit,time,value,over\n"


def test_the_words_of_a_shell_are_read_the_same(train: Path, tmp_path: Path) -> None:
    """In a process of its own, with the file behind the option and the machine behind it."""
    target = tmp_path / "courses.csv"
    done = python("-m", "ptmcalc", "check", "--history", target, train)
    assert (done.status, done.err) == (0, "")
    assert target.read_text("utf-8").startswith("file,scene,load,unit,time,value,over\n")
    assert "1 file" in done.out


def test_a_machine_without_histories_gives_the_heading_alone(tmp_path: Path) -> None:
    target = tmp_path / "courses.csv"
    assert ptmcalc("check", HOIST, "--scene", "run_loaded", "--history", target).status == 0
    assert target.read_text("utf-8") == "file,scene,load,unit,time,value,over\n"
