"""`sweep`: at every point what `check` says of a file with those values, where verdicts turn, and what is refused."""

import csv
import json
import math
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from support.command import Done, ptmcalc

from ptmcalc.cli import worker
from ptmcalc.engine import sweep as engine
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_file, load_text

SPEC = Path(__file__).parent / "specs" / "passing.yaml"
RUN = ("--scene", "run_loaded")


@pytest.fixture
def file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("yard.yaml").write_bytes(SPEC.read_bytes())
    return Path("yard.yaml")


def swept(*options: str, form: str = "json", scene: tuple[str, ...] = RUN) -> Done:
    return ptmcalc("sweep", "yard.yaml", *scene, "--format", form, *options)


def document(done: Done) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(done.out)
    return found


def checked(file: Path, changes: dict[str, str], *scene: str) -> dict[str, Any]:
    """What `check` says of the file with other values."""
    text = file.read_text("utf-8")
    for old, new in changes.items():
        assert old in text
        text = text.replace(old, new)
    Path("changed.yaml").write_text(text, encoding="utf-8")
    found: dict[str, Any] = json.loads(ptmcalc("check", "changed.yaml", *scene, "--format", "json").out)["files"][0]
    return found


def test_every_point_is_what_check_says_of_it(file: Path) -> None:
    found = document(swept("--vary", "takeup.tension=10 kN:40 kN:4", "--vary", "drive.drum.friction=0.2:0.4:3"))
    assert found["schema_version"] == "1"
    assert [(key["path"], key["unit"], key["line"], key["present"]) for key in found["keys"]] == [
        (["takeup", "tension"], "N", 25, 30e3),
        (["drive", "drum", "friction"], "1", 23, 0.35),
    ]
    assert [[one["value"] for one in row["values"]] for row in found["rows"]] == [
        [pytest.approx(tension), pytest.approx(friction)]
        for tension in (10e3, 20e3, 30e3, 40e3)
        for friction in (0.2, 0.3, 0.4)
    ]
    assert {row["verdict"] for row in found["rows"]} == {"pass", "fail"}
    for row in found["rows"][::2]:
        tension, friction = (repr(one["value"]) for one in row["values"])
        told = checked(
            file, {"tension: 30 kN": f"tension: {tension} N", "friction: 0.35": f"friction: {friction}"}, *RUN
        )
        (scene,) = told["scenes"]
        assert row["verdict"] == told["verdict"]
        assert [(one["code"], one["verdict"]) for one in row["checks"]] == [
            (one["code"], one["verdict"]) for one in scene["checks"]
        ]
        for mine, its in zip(row["checks"], scene["checks"], strict=True):
            assert (mine["value"], mine["limit"]) == pytest.approx((its["value"], its["limit"]), rel=1e-9)
            assert mine["margin"] == pytest.approx(its["margin"], rel=1e-9)
        loads = {load["name"]: load["value"] for load in scene["loads"]}
        assert len(row["loads"]) > 5
        assert {one["name"]: one["value"] for one in row["loads"]} == pytest.approx(
            {one["name"]: loads[one["name"]] for one in row["loads"]}, rel=1e-9
        )


def test_verdicts_turn_where_solve_says(file: Path) -> None:
    """The boundary between grid points against the bracketing solve of another command."""
    done = swept("--vary", "takeup.tension=10 kN:40 kN:301")
    one = next(one for one in document(done)["turnings"] if one["code"] == "CNV101")
    assert (one["code"], one["path"], one["passes_above"], one["passes_below"], one["lines"]) == (
        *("CNV101", ["takeup", "tension"]),
        *(1, 0, 1),
    )
    solved = ptmcalc("solve", "yard.yaml", "--check", "CNV101", "--vary", "takeup.tension", *RUN, "--format", "json")
    assert one["least"] == one["most"] == pytest.approx(json.loads(solved.out)["value"], rel=1e-3)
    table = swept("--vary", "takeup.tension=10 kN:40 kN:301", form="table")
    assert table.status == 0
    assert "yard.yaml:25  takeup.tension: 10 kN to 40 kN, now 30 kN" in table.out
    assert "limits of the verdicts" in table.out
    assert f"from {one['least'] / 1e3:.2f} kN" in table.out


EDGES = Path(__file__).parents[1] / "edges" / "tools"


def test_windows_between_resonances_are_listed_one_by_one() -> None:
    """From 0.2 to 0.25 m/s it fails, from 0.45 to 0.6 m/s it passes: between 0.29 and 0.84 m/s neither holds."""
    command = ("sweep", EDGES / "sweep-windows.yaml", "--vary", "speed=0.2 m/s:1.1 m/s:19", "--scene", "run_loaded")
    found = document(ptmcalc(*command, "--format", "json"))
    (one,) = (one for one in found["turnings"] if one["code"] == "CHN101")
    speeds = [row["values"][0]["value"] for row in found["rows"]]
    for speed, row in zip(speeds, found["rows"], strict=True):
        (said,) = (check["verdict"] for check in row["checks"] if check["code"] == "CHN101")
        assert [part["verdict"] for part in one["intervals"] if part["low"] <= speed <= part["high"]] == [said]
    for low, high, verdict in ((0.2, 0.25, "fail"), (0.45, 0.6, "pass")):
        assert [p["verdict"] for p in one["intervals"] if p["low"] <= low and high <= p["high"]] == [verdict]
    assert "passes 0.2898 m/s to 0.3121 m/s, 0.4223 m/s to 0.6243 m/s" in ptmcalc(*command, "--format", "table").out


def test_a_whole_number_varies_too() -> None:
    """Room for the rope on a drum of 3 m, at every number of layers as `check` has it."""
    done = ptmcalc("sweep", EDGES / "solve-layers.yaml", "--vary", "drum.layers=1:4:4", "--format", "json")
    rows = document(done)["rows"]
    assert [row["values"][0]["value"] for row in rows] == [1, 2, 3, 4]
    for row in rows:
        text = (EDGES / "solve-layers.yaml").read_text("utf-8")
        changed = load_text(text.replace("layers: 1", f"layers: {row['values'][0]['value']:.0f}").encode(), "")
        told = {one.code: one.verdict.value for _, one in check(changed, Options(repairs=False)).judgements}
        assert {one["code"]: one["verdict"] for one in row["checks"]} == told


def test_boundaries_of_a_grid_are_those_of_its_lines(file: Path) -> None:
    """A check that passes below a value; a boundary that lies elsewhere on every line."""
    found = document(
        swept("--vary", "takeup.tension=10 kN:200 kN:20", "--vary", "belt.strength=150 N/mm:600 N/mm:10:log")
    )
    turnings = {(one["code"], one["path"][-1]): one for one in found["turnings"]}
    strength = turnings["CNV102", "tension"]
    assert strength["passes_above"] == 0 < strength["passes_below"] <= strength["lines"] == 10
    assert strength["least"] < strength["most"]
    assert turnings["CNV102", "strength"]["passes_below"] == 0
    rows = found["rows"]
    ratios = np.diff(np.log([row["values"][1]["value"] for row in rows[:10]]))
    np.testing.assert_allclose(ratios, math.log(4) / 9, rtol=1e-9)


def test_a_latin_hypercube_has_a_point_in_every_part_of_every_key(file: Path) -> None:
    options = ("--vary", "takeup.tension=10 kN:40 kN", "--vary", "belt.mass=10 kg/m:20 kg/m:log", "--sample", "lhs")
    first, again = (swept(*options, "--points", "50", "--seed", "3") for _ in range(2))
    other = swept(*options, "--points", "50", "--seed", "4")
    assert first.out == again.out != other.out
    values = np.array([[one["value"] for one in row["values"]] for row in document(first)["rows"]])
    tension, mass = (values[:, 0] - 10e3) / 30e3, np.log(values[:, 1] / 10) / math.log(2)
    for part in (tension, mass):
        assert sorted(np.floor(part * 50).astype(int).tolist()) == list(range(50))
    assert document(first)["turnings"] == []


def test_the_csv_has_a_line_for_every_point(file: Path) -> None:
    options = ("--vary", "takeup.tension=10 kN:40 kN:4")
    rows = list(csv.DictReader(StringIO(swept(*options, form="csv").out)))
    found = document(swept(*options))["rows"]
    assert len(rows) == 4
    for row, point in zip(rows, found, strict=True):
        assert (row["point"], row["verdict"]) == (str(point["point"]), point["verdict"])
        assert float(row["takeup.tension [N]"]) == point["values"][0]["value"]
        for one in point["checks"]:
            name = f"{one['scene']} {one['code']}"
            assert (row[name], float(row[f"{name} margin [{one['unit']}]"])) == (one["verdict"], one["margin"])
        for one in point["loads"]:
            assert float(row[f"{one['scene']} {one['name']} [{one['unit']}]"]) == one["value"]


def test_what_closed_forms_leave_open_goes_through_the_batch(file: Path) -> None:
    options = ("--vary", "takeup.tension=25 kN:35 kN:3")
    done = swept(*options, "--store", "results", scene=())
    assert (done.status, done.err) == (0, "ptmcalc: 0 of 3 files known from `results`\n")
    found = document(done)
    assert {one["scene"] for one in found["rows"][0]["checks"]} == {"run_loaded", "start_empty"}
    for row in found["rows"]:
        told = checked(file, {"tension: 30 kN": f"tension: {row['values'][0]['value']!r} N"})
        its = [(s["name"], one["code"], one["verdict"], one["margin"]) for s in told["scenes"] for one in s["checks"]]
        mine = [(one["scene"], one["code"], one["verdict"], one["margin"]) for one in row["checks"]]
        assert [one[:3] for one in mine] == [one[:3] for one in its]
        assert [one[3] for one in mine] == pytest.approx([one[3] for one in its], rel=1e-9)
    again = swept(*options, "--store", "results", scene=())
    assert again.out == done.out
    assert "3 of 3 files known" in again.err


def test_what_is_beyond_the_budget_is_told_and_not_guessed(file: Path) -> None:
    done = swept("--vary", "takeup.tension=25 kN:35 kN:3", "--budget", "0 s", scene=())
    assert done.status == 3
    assert "0 of 3 open points are computed one by one in start_empty" in done.err
    found = document(done)
    assert [row["verdict"] for row in found["rows"]] == ["not_computed"] * 3
    assert {one["scene"] for one in found["rows"][0]["checks"]} == {"run_loaded"}


@pytest.mark.parametrize(
    ("options", "reason"),
    [
        ((), "nothing varies"),
        (("--vary", "takeup.tension"), "is not a range"),
        (("--vary", "takeup.tension=1 kN:2 kN"), "write KEY=from:to:n, e.g. `takeup.tension=20 kN:60 kN:21`"),
        (("--vary", "takeup.tension=1 kN:2 kN:many"), "`many` is not a number of points"),
        (("--vary", "takeup.tension=1 kN:2 kN:0"), "`0` is not a number of points"),
        (("--vary", "takeup.tension=1 kN:2 kN:1000001"), "is not a number of points (write how many, at most 1000000"),
        (("--vary", "takeup.tension=1 kN:2 kN:" + "9" * 5000), "is not a number of points (write how many, at most"),
        (("--vary", "takeup.tension=1 kN:2 kN", "--sample", "lhs", "--points", "1000001"), "from 1 to 1000000"),
        (("--vary", "speed=1 m/s:2 m/s:1") * 21, "21 keys vary (at most 20 in one sweep)"),
        (("--vary", "takeup.tension=1 kN:2 kN:3:4"), "is not a range"),
        (("--vary", "=1:2:3"), "is not a range"),
        (("--vary", "takeup.tenson=1 kN:2 kN:3"), "of this file (did you mean `takeup.tension`?)"),
        (("--vary", "takeup.tension=1:2:3"), "`takeup.tension`: `1` has no unit"),
        (("--vary", "takeup.tension=1 kN:2 m:3"), "`2 m` is a length, not a force"),
        (("--vary", "takeup.tension=0 kN:2 kN:3"), "out of range: it must be greater than 0 N"),
        (("--vary", "takeup.tension=nan kN:2 kN:3"), "is not a finite number"),
        (("--vary", "route.lift=-1 m:2 m:3:log"), "equal ratios need values above 0"),
        (("--vary", "belt.mass=1 kg/m:2 kg/m:3", "--vary", "belt.mass=1 kg/m:2 kg/m:3"), "`belt.mass` varies twice"),
        (("--vary", "belt.mass=1 kg/m:2 kg/m:1001", "--vary", "speed=1 m/s:2 m/s:1000"), "that makes 1001000 points"),
        (("--vary", "belt.mass=1 kg/m:2 kg/m:3", "--points", "4"), "leave --points out"),
        (("--vary", "belt.mass=1 kg/m:2 kg/m", "--sample", "lhs"), "add e.g. --points 200"),
        (("--vary", "belt.mass=1 kg/m:2 kg/m:3", "--sample", "lhs", "--points", "4"), "is not a range"),
        (("--vary", "belt.mass=1 kg/m:2 kg/m", "--sample", "lhs", "--points", "0"), "`--points 0` is not a number"),
        (("--vary", "belt.mass=1 kg/m:2 kg/m:3", "--scene", "stop"), "unknown scene `stop`"),
        (("--vary", "belt.mass=1 kg/m:2 kg/m:3", "--budget", "4"), "--budget"),
    ],
)  # fmt: skip
def test_what_cannot_be_swept_is_refused(file: Path, options: tuple[str, ...], reason: str) -> None:
    done = swept(*options)
    assert (done.status, done.out) == (2, "")
    assert reason in done.err
    assert "Traceback" not in done.err


def test_a_file_that_is_none_is_told_at_its_line(file: Path) -> None:
    file.write_text(file.read_text("utf-8").replace("30 kN", "30"), encoding="utf-8")
    done = swept("--vary", "takeup.tension=10 kN:40 kN:4")
    assert (done.status, done.out) == (2, "")
    assert "yard.yaml:25:" in done.err


def test_the_ends_of_a_range_are_its_values(file: Path) -> None:
    loaded = load_file(file, "yard.yaml")
    for text in ("takeup.tension=10.1 kN:33.3 kN:7", "takeup.tension=10.1 kN:33.3 kN:7:log", "speed=3 m/s:1 m/s:2"):
        one = engine.axis(loaded, text, counted=True)
        values = engine.grid([one])[:, 0]
        assert (values[0], values[-1], values.size) == (pytest.approx(one.start), pytest.approx(one.end), one.count)
        assert min(values) >= min(one.start, one.end)
        assert max(values) <= max(one.start, one.end), "rounding leads out of no range"


def test_an_interrupt_prints_what_is_done(file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Two of four points that need a run of their own, then Ctrl-C."""
    done_so_far, work = [], worker.without_text

    def interrupted(texts: Any, options: Any, patience: Any) -> Any:
        if len(done_so_far) == 2:
            raise KeyboardInterrupt
        done_so_far.append(texts)
        return work(texts, options, patience)

    monkeypatch.setattr(worker, "without_text", interrupted)
    monkeypatch.setattr("ptmcalc.engine.agenda.MOST_IN_CHUNK", 1)
    done = swept("--vary", "takeup.tension=25 kN:35 kN:4", "--jobs", "1", scene=())
    assert done.status == 130
    assert "interrupted after 2 of 4 files" in done.err
    verdicts = [row["verdict"] for row in document(done)["rows"]]
    assert sorted(verdicts) == ["not_computed", "not_computed", "pass", "pass"], "in no particular order"
