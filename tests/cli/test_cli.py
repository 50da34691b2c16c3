"""The commands as a shell sees them: exit statuses, options, and what each one prints."""

import json
import re
import shutil
import subprocess
import sys
from functools import cache
from pathlib import Path
from typing import Any

import pytest
import yaml
from jsonschema import Draft202012Validator
from support.command import ROOT, Done, environment, ptmcalc, python, unpainted
from support.machines import changed, template

from ptmcalc import __version__
from ptmcalc.engine import check as engine
from ptmcalc.engine.registry import kind_names, load_kind
from ptmcalc.machines.conveyor.machine.scenes import Start
from ptmcalc.text.document import parse

SPECS = Path(__file__).parent / "specs"
PASSING, SLIPPING, FAULTY = SPECS / "passing.yaml", SPECS / "slipping.yaml", SPECS / "faulty.yaml"
UNCHECKED, DISAGREEING = SPECS / "without_friction.yaml", SPECS / "disagreeing.yaml"


def answer(done: Done, status: int = 0) -> dict[str, Any]:
    """The JSON a command printed."""
    assert (done.status, done.err) == (status, "")
    found = json.loads(done.out)
    assert isinstance(found, dict)
    return found


def checked(*arguments: str | Path, status: int = 0) -> dict[str, Any]:
    """The JSON of the only file of `check`."""
    (found,) = answer(ptmcalc("check", *arguments, "--format", "json"), status)["files"]
    assert isinstance(found, dict)
    return found


def written(path: Path, data: dict[str, Any]) -> Path:
    path.write_text(yaml.safe_dump(data, sort_keys=False), encoding="utf-8")
    return path


# -- exit status ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("files", "status"),
    [
        ((PASSING,), 0),
        ((DISAGREEING,), 0),  # a finding is no verdict
        ((SLIPPING,), 1),
        ((FAULTY,), 2),
        ((SPECS / "absent.yaml",), 2),
        ((UNCHECKED,), 3),
        ((PASSING, UNCHECKED), 3),
        ((UNCHECKED, SLIPPING, PASSING), 1),
        ((PASSING, SLIPPING, UNCHECKED, FAULTY), 2),
        ((FAULTY, SLIPPING), 2),
    ],
    ids=lambda value: "+".join(path.stem for path in value) if isinstance(value, tuple) else str(value),
)
def test_the_worst_verdict_is_the_exit_status(files: tuple[Path, ...], status: int) -> None:
    assert ptmcalc("check", *files).status == status


def test_what_each_file_of_the_table_is_blamed_for() -> None:
    """The exit statuses above come from the verdicts the files are written for."""
    assert "25:15: fail CNV101 drive pulley traction reserve [run_loaded]" in ptmcalc("check", SLIPPING).out
    assert "not_checked CNV101 drive pulley traction reserve [run_loaded]: `drive.drum.friction` is not given" in (
        ptmcalc("check", UNCHECKED).out
    )
    assert re.findall("error ([A-Z]{3}[0-9]{3})", ptmcalc("check", FAULTY).out) == [
        "SPC106",
        "SPC104",
        "SPC107",
    ]


@pytest.mark.parametrize(
    ("level", "file", "status"),
    [
        ("error", DISAGREEING, 0),
        ("warning", DISAGREEING, 1),
        ("note", DISAGREEING, 1),
        ("warning", PASSING, 0),
        ("warning", UNCHECKED, 3),
        ("warning", FAULTY, 2),
        ("warning", SLIPPING, 1),
    ],
    ids=lambda value: value.stem if isinstance(value, Path) else str(value),
)
def test_findings_weigh_only_as_much_as_asked(level: str, file: Path, status: int) -> None:
    assert ptmcalc("check", file, "--fail-level", level).status == status


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("check",), "Missing argument"),
        (("check", PASSING, "--format", "xml"), "xml"),
        (("check", PASSING, "--fail-level", "loud"), "loud"),
        (("check", PASSING, "--scene", "stop"), "unknown scene `stop` (scenes: run_loaded, start_empty)"),
        (("check", PASSING, "-o", "json"), "`json` is not FORMAT=FILE"),
        (("check", PASSING, "-o", "json="), "`json=` is not FORMAT=FILE"),
        (("check", PASSING, "-o", "xml=report.xml"), "formats: table, plain, json"),
        (("check", PASSING, "--effects", "belt_wave"), "`belt_wave` is not NAME=on|off|auto"),
        (("check", PASSING, "--effects", "belt_wave=maybe"), "`belt_wave=maybe` is not NAME=on|off|auto"),
        (("new", "airship"), "unknown machine kind `airship` (kinds: "),
        (("schema", "airship"), "unknown machine kind `airship`"),
        (("solvers", "airship"), "unknown machine kind `airship`"),
        (("solve", PASSING, "--check", "CNV999", "--vary", "speed"), "a conveyor has no check `CNV999`"),
        (("solve", PASSING, "--check", "CNV101", "--vary", "name"), "`name` is not a number that can be varied"),
        (
            ("solve", PASSING, "--check", "CNV101", "--vary", "speed", "--scene", "stop"),
            "unknown scene `stop`",
        ),
        (("explain", "CNV1O4"), "did you mean `CNV104`?"),
        (("explain", "belt_waves"), "did you mean `belt_wave`?"),
        (("explain", "xyzzy"), "unknown name `xyzzy`"),
        (("frobnicate",), "frobnicate"),
    ],
)
def test_wrong_usage_says_what_is_wrong_and_exits_2(arguments: tuple[str | Path, ...], said: str) -> None:
    done = ptmcalc(*arguments)
    assert done.status == 2
    assert said in unpainted(done.err)
    assert done.out == ""


def test_an_output_that_cannot_be_written_is_wrong_usage(tmp_path: Path) -> None:
    done = ptmcalc("check", PASSING, "-o", f"json={tmp_path / 'nowhere' / 'report.json'}")
    assert done.status == 2
    assert "cannot write" in done.err


def test_our_own_bug_exits_4_and_asks_for_a_report(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*arguments: object) -> None:
        raise ZeroDivisionError("float division by zero")

    monkeypatch.delenv("PTMCALC_TRACEBACK", raising=False)
    monkeypatch.setattr(engine, "check_paths", broken)
    done = ptmcalc("check", PASSING)
    assert done.status == 4
    assert "internal error: ZeroDivisionError: float division by zero" in done.err
    assert "Please report it" in done.err
    assert "Traceback" not in done.err


def test_a_traceback_is_to_be_had(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*arguments: object) -> None:
        raise ZeroDivisionError

    monkeypatch.setenv("PTMCALC_TRACEBACK", "1")
    monkeypatch.setattr(engine, "check_paths", broken)
    with pytest.raises(ZeroDivisionError):
        ptmcalc("check", PASSING)


def test_an_interrupt_exits_130(monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(*arguments: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(engine, "check_paths", interrupted)
    done = ptmcalc("check", PASSING)
    assert done.status == 130
    assert "Traceback" not in done.err


@pytest.fixture(scope="module")
def unread() -> tuple[int, str]:
    """Exit status and standard error where nobody reads the output, as with `ptmcalc check ... | true`."""
    running = subprocess.Popen(
        [sys.executable, "-m", "ptmcalc", "check", PASSING],
        cwd=ROOT,
        env=environment(ROOT),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert running.stdout is not None
    running.stdout.close()
    _, error = running.communicate()
    return running.returncode, error


def test_output_that_nobody_reads_is_no_traceback(unread: tuple[int, str]) -> None:
    assert unread[1] == ""


def test_output_that_nobody_reads_is_no_failed_check(unread: tuple[int, str]) -> None:
    assert unread[0] == 0


# -- check: what is printed and written -----------------------------------------------------------------------------


def test_lines_are_plain_where_there_is_no_terminal() -> None:
    assert ptmcalc("check", PASSING).out == ptmcalc("check", PASSING, "--format", "plain").out


@pytest.mark.parametrize(
    ("form", "first"),
    [("table", "{file}  conveyor  Yard conveyor  PASS\n"), ("plain", "{file}:25:34: pass CNV103 "), ("json", "{{\n")],
    ids=["table", "plain", "json"],
)
def test_every_format_can_be_printed(form: str, first: str) -> None:
    done = ptmcalc("check", PASSING, "--format", form)
    assert (done.status, done.err) == (0, "")
    assert done.out.startswith(first.format(file=PASSING.as_posix()))
    assert done.out.endswith("\n")


def test_formats_are_written_to_files_besides_what_is_printed(tmp_path: Path) -> None:
    outputs = {form: tmp_path / f"report.{form}" for form in ("json", "plain", "table")}
    arguments = [word for form, path in outputs.items() for word in ("-o", f"{form}={path}")]
    done = ptmcalc("check", SLIPPING, *arguments, "--format", "plain")
    assert done.status == 1
    assert outputs["plain"].read_text("utf-8") == done.out
    assert json.loads(outputs["json"].read_text("utf-8"))["summary"]["fail"] == 1
    assert "CNV101 drive pulley traction reserve" in outputs["table"].read_text("utf-8")


@pytest.mark.parametrize("option", ["--verbose", "-v"])
def test_the_whole_table_is_to_be_had(option: str, tmp_path: Path) -> None:
    """On the screen and in a file; the other formats do not know it."""
    file = tmp_path / "report.txt"
    short = ptmcalc("check", PASSING, "--format", "table").out
    done = ptmcalc("check", PASSING, "--format", "table", option, "-o", f"table={file}")
    assert (done.status, done.err) == (0, "")
    assert file.read_text("utf-8") == done.out
    assert len(done.out.splitlines()) > len(short.splitlines())
    assert short.splitlines()[-1].startswith("Further output with --verbose: ")
    assert ptmcalc("check", PASSING, option).out == ptmcalc("check", PASSING).out


def test_one_scene_may_be_checked() -> None:
    scenes = checked(PASSING, "--scene", "run_loaded")["scenes"]
    assert [scene["name"] for scene in scenes] == ["run_loaded"]


def test_several_scenes_may_be_checked() -> None:
    scenes = checked(PASSING, "--scene", "start_empty", "--scene", "run_loaded")["scenes"]
    assert {scene["name"] for scene in scenes} == {"run_loaded", "start_empty"}


def worst_bar(found: dict[str, Any]) -> float:
    """The widest relative bar of the loads whose bars the accuracy is for."""
    loads = {info.name for info in load_kind("conveyor").loads if info.headline}
    return max(
        max(load["high"] - load["value"], load["value"] - load["low"]) / abs(load["value"])
        for scene in found["scenes"]
        for load in scene["loads"]
        if load["name"] in loads and load["high"] > load["low"]
    )


def test_accuracy_is_bought_on_the_command_line() -> None:
    slow = "--effects", "moving_belt=off"  # its bound is wider than that
    rough, fine = checked(PASSING, *slow), checked(PASSING, "--accuracy", "1%", *slow)
    assert worst_bar(rough) > 0.05
    assert worst_bar(fine) <= 0.01
    assert rough["verdict"] == fine["verdict"] == "pass"


@pytest.mark.parametrize(
    ("accuracy", "code"),
    [
        ("soon", "SPC114"),
        ("0", "SPC110"),
        ("-1 %", "SPC110"),
        ("200 %", "SPC110"),
        ("1 mm", "SPC105"),
        ("nan", "SPC109"),
    ],
)
def test_a_bad_accuracy_is_refused(accuracy: str, code: str) -> None:
    done = ptmcalc("check", PASSING, "--accuracy", accuracy)
    assert done.status == 2
    assert f"error {code} `accuracy`" in done.out


def test_a_budget_of_nothing_decides_nothing_and_says_what_the_next_run_would_take() -> None:
    found = checked(PASSING, "--budget", "0 s", status=3)
    assert found["verdict"] == "undecided"
    over = [finding["message"] for finding in found["diagnostics"] if finding["code"] == "NUM103"]
    assert len(over) == len(found["scenes"])
    assert all("predicted to take" in message for message in over)
    assert checked(PASSING, "--budget", "60 s") == checked(PASSING)


def test_repairs_are_looked_for_or_not() -> None:
    with_them, without = checked(SLIPPING, status=1), checked(SLIPPING, "--no-repairs", status=1)
    repairs = [
        [check.get("repair") for scene in found["scenes"] for check in scene["checks"]]
        for found in (with_them, without)
    ]
    assert any(repairs[0])
    assert not any(repairs[1])
    assert with_them["verdict"] == without["verdict"] == "fail"


@pytest.mark.parametrize("budget", ["2", "2 mm", "-1 s", "nan s", "much"])
def test_a_bad_budget_is_refused(budget: str) -> None:
    done = ptmcalc("check", PASSING, "--budget", budget)
    assert done.status == 2
    assert "--budget" in done.err
    assert "Traceback" not in done.err


def effects_of(found: dict[str, Any]) -> dict[str, Any]:
    return {effect["name"]: effect for scene in found["scenes"] for effect in scene["effects"]}


@pytest.mark.parametrize(("wish", "state"), [("off", "skipped"), ("on", "simulated")])
def test_an_effect_is_forced_on_the_command_line(wish: str, state: str) -> None:
    found = checked(PASSING, "--effects", f"belt_wave={wish}")
    wave = effects_of(found)["belt_wave"]
    assert (wave["state"], wave["forced"]) == (state, True)
    start = next(scene for scene in found["scenes"] if scene["type"] == "start")
    assert all(("belt_wave" in check.get("without", [])) == (wish == "off") for check in start["checks"])


def test_the_command_line_overrules_the_file(tmp_path: Path) -> None:
    file = tmp_path / "off.yaml"
    text = PASSING.read_text("utf-8").replace("takeup_mass: off", "belt_wave: off, slip: off")
    file.write_text(text, encoding="utf-8")
    effects = effects_of(checked(file, "--effects", "belt_wave=auto"))
    assert {name for name, effect in effects.items() if effect["forced"]} == {"slip"}


def test_a_wrong_name_of_an_effect_is_told_with_the_right_one() -> None:
    done = ptmcalc("check", PASSING, "--effects", "wave=off")
    assert done.status == 2
    assert "error SPC104 unknown effect `wave`; did you mean `belt_wave`?" in done.out


def test_waves_that_are_switched_off_are_in_no_number(tmp_path: Path) -> None:
    """A drum that slips calls for a simulation; the waves add 110 % to the static tension of this start."""
    data = changed(
        template(),
        drive__drum__friction=0.10,
        scenes=[{"type": "start", "load": "empty"}],
        checks={"CNV101": {"off": "the belt slips here on purpose"}},
    )
    file = written(tmp_path / "slipping.yaml", data)

    def tension(*arguments: str) -> float:
        (scene,) = checked(file, *arguments, status=ptmcalc("check", file, *arguments).status)["scenes"]
        found = next(load["value"] for load in scene["loads"] if load["name"] == "tension_max")
        assert isinstance(found, float)
        return found

    assert tension("--effects", "belt_wave=off") != pytest.approx(tension(), rel=1e-3)


def test_waves_near_their_threshold_change_something() -> None:
    """The ledger tells what leaving the waves out changes: not nothing, where they are simulated at all."""
    wave = effects_of(checked(PASSING, "--effects", "belt_wave=on", "--ledger"))["belt_wave"]
    assert wave["criterion"]["threshold"] / 2 <= wave["criterion"]["value"] <= wave["criterion"]["threshold"] * 2
    assert abs(wave["change_without"]["relative"]) > 1e-4
    wave = effects_of(checked(PASSING, "--effects", "belt_wave=on"))["belt_wave"]
    assert "change_without" not in wave, "a run of its own, made only where somebody asks for it"


# -- check: files and folders ---------------------------------------------------------------------------------------


def test_folders_are_searched_recursively_and_sorted(tmp_path: Path) -> None:
    for name in ("z.yaml", "b/x.yml", "b/deep/er/a.yaml", "a.yaml", ".hidden/h.yaml", "b/.git/g.yaml"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(PASSING, tmp_path / name)
    for name in ("notes.txt", "b/data.json"):
        (tmp_path / name).write_text("not a design file", encoding="utf-8")
    files = [file["path"] for file in answer(ptmcalc("check", tmp_path, "--format", "json"))["files"]]
    found = [Path(file).relative_to(tmp_path).as_posix() for file in files]
    assert found == ["a.yaml", "b/deep/er/a.yaml", "b/x.yml", "z.yaml"]


def test_one_broken_file_does_not_stop_the_others(tmp_path: Path) -> None:
    shutil.copy(PASSING, tmp_path / "b.yaml")
    (tmp_path / "a.yaml").write_text("kind: [", encoding="utf-8")
    (tmp_path / "c.yaml").write_bytes(b"kind: \xff")
    found = answer(ptmcalc("check", tmp_path, "--format", "json"), status=2)
    assert [file["verdict"] for file in found["files"]] == ["invalid", "pass", "invalid"]


def test_paths_keep_the_order_of_the_command_line() -> None:
    found = answer(ptmcalc("check", SLIPPING, PASSING, "--format", "json"), status=1)
    assert [Path(file["path"]).name for file in found["files"]] == ["slipping.yaml", "passing.yaml"]


def test_a_folder_without_design_files_is_a_fault(tmp_path: Path) -> None:
    done = ptmcalc("check", tmp_path)
    assert done.status == 2
    assert "error TXT102" in done.out


def test_a_missing_file_is_named() -> None:
    done = ptmcalc("check", SPECS / "absent.yaml")
    assert f"{(SPECS / 'absent.yaml').as_posix()}: error TXT101" in done.out


@pytest.mark.parametrize("form", ["json", "table"])
def test_two_processes_print_the_same_bytes(form: str) -> None:
    """Sets and dictionaries are hashed with another seed in each process."""
    arguments = ("-m", "ptmcalc", "check", "tests/cli/specs", "--format", form)
    first, second = (python(*arguments, env=environment(ROOT, PYTHONHASHSEED=seed)) for seed in ("1", "4711"))
    assert first == second
    assert first.status == 2
    assert "slipping" in first.out


# -- plan, solve ----------------------------------------------------------------------------------------------------


def test_a_plan_has_a_row_for_every_effect_of_every_scene() -> None:
    found = answer(ptmcalc("plan", PASSING, "--format", "json"))
    assert found["schema_version"] == "1"
    rows = found["rows"]
    assert {row["scene"] for row in rows} == {"run_loaded", "start_empty"}
    started = [row for row in rows if row["scene"] == "start_empty"]
    assert {row["effect"] for row in started} == {
        one.name for one in load_kind("conveyor").effects if Start in one.scenes
    }
    for row in rows:
        assert row["predicted_seconds"] > 0
        assert row["solver"] in {solver.name for solver in load_kind("conveyor").solvers}
    assert {row["state"] for row in started} <= {"skipped", "bounded", "simulated"}
    without = [row["effect"] for row in started if row["criterion"] is None]
    assert without == ["belt_damping"], "the file does not give it"
    given = [row["criterion"] for row in started if row["criterion"] is not None]
    assert all(set(one) >= {"symbol", "value", "threshold", "meaning"} for one in given)


def test_a_plan_is_what_check_then_does() -> None:
    planned = answer(ptmcalc("plan", PASSING, "--scene", "start_empty", "--format", "json"))["rows"]
    done = effects_of(checked(PASSING, "--scene", "start_empty"))
    assert {row["effect"]: row["state"] for row in planned} == {name: effect["state"] for name, effect in done.items()}


def test_a_plan_follows_forced_effects_and_accuracy() -> None:
    (wave,) = (
        row
        for row in answer(ptmcalc("plan", PASSING, "--effects", "belt_wave=on", "--format", "json"))["rows"]
        if row["effect"] == "belt_wave"
    )
    assert (wave["state"], wave["forced"], wave["solver"]) == ("simulated", True, "characteristics")
    fine = answer(ptmcalc("plan", PASSING, "--accuracy", "1%", "--scene", "start_empty", "--format", "json"))["rows"]
    assert {row["solver"] for row in fine} == {"characteristics"}


def test_a_plan_as_a_table_names_scene_solver_and_number() -> None:
    done = ptmcalc("plan", PASSING)
    assert done.status == 0
    assert "start_empty: rigid, predicted" in done.out
    assert "E = 0.0429 < 0.05" in done.out


def test_a_plan_of_a_faulty_file_exits_2() -> None:
    done = ptmcalc("plan", FAULTY)
    assert done.status == 2
    assert "SPC106" in done.err


def test_solve_prints_key_value_and_unit() -> None:
    arguments = ("solve", SLIPPING, "--check", "CNV101", "--vary", "takeup.tension", "--scene", "run_loaded")
    found = answer(ptmcalc(*arguments, "--format", "json"))
    # (S - rho v^2)(exp(mu alpha) - 1) = k_T W: 0.10 over 200 deg, 28.82 kN, 15 kg/m at 2.5 m/s
    del found["checks"]  # what the others say there: test_solve_command
    assert found == {"path": ["takeup", "tension"], "value": pytest.approx(82.8e3, rel=1e-3), "unit": "N"}
    assert ptmcalc(*arguments).out.startswith("takeup.tension: 82.8 kN   CNV101 just passes in run_loaded\n")


@pytest.mark.parametrize(("tension", "verdict"), [("82.8 kN", "pass"), ("82.7 kN", "fail")])
def test_what_solve_prints_is_the_least_that_passes_in_the_file(tension: str, verdict: str, tmp_path: Path) -> None:
    text = SLIPPING.read_text("utf-8")
    file = tmp_path / "mended.yaml"
    file.write_text(text.replace("tension: 30 kN", f"tension: {tension}"), encoding="utf-8")
    line = next(line for line in ptmcalc("check", file, "--scene", "run_loaded").out.splitlines() if "CNV101" in line)
    assert f": {verdict} CNV101" in line


def test_solve_exits_1_when_no_value_changes_the_verdict() -> None:
    done = ptmcalc("solve", SLIPPING, "--check", "CNV101", "--vary", "belt.strength", "--scene", "run_loaded")
    assert done.status == 1
    assert "within three decades no value of `belt.strength` changes the verdict of CNV101" in done.err
    assert done.out == ""


def test_solve_of_a_faulty_file_exits_2() -> None:
    assert ptmcalc("solve", FAULTY, "--check", "CNV101", "--vary", "takeup.tension").status == 2


# -- explain, schema, new, kinds, solvers ---------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "parts"),
    [
        ("CNV101", ("drive pulley traction reserve", "Formula", "Limit:", "**Range**", "Source:")),
        ("cnv101", ("CNV101: drive pulley traction reserve",)),
        ("belt_wave", ("When it matters", "Change if it is neglected", "**Error**")),
        ("sag", ("Part of: belt_wave",)),
        ("characteristics", ("Simulated effects: belt_wave", "**Source**")),
        ("first_wave", ("never decides",)),
        ("SPC106", ("missing unit", "Corrective action:")),
    ],
)
def test_explain_has_formula_range_error_and_source(name: str, parts: tuple[str, ...]) -> None:
    done = ptmcalc("explain", name)
    assert (done.status, done.err) == (0, "")
    for part in parts:
        assert part in done.out


@cache
def schema(*arguments: str) -> dict[str, Any]:
    """The schema a command prints, a schema itself; looked at only, as it is made once."""
    found = answer(ptmcalc("schema", *arguments))
    Draft202012Validator.check_schema(found)
    return found


@pytest.mark.parametrize("path", sorted(ROOT.glob("specs/**/*.yaml")), ids=lambda path: path.stem)
def test_the_schema_accepts_the_specs_of_the_project(path: Path) -> None:
    data = parse(path.read_bytes(), path.name).data
    assert isinstance(data, dict)
    assert Draft202012Validator(schema()).is_valid(data)
    assert Draft202012Validator(schema(data["kind"])).is_valid(data)


@pytest.mark.parametrize("kind", kind_names())
def test_the_schema_of_a_kind_accepts_no_other_kind(kind: str) -> None:
    validator = Draft202012Validator(schema(kind))
    for other in kind_names():
        assert validator.is_valid(yaml.safe_load(load_kind(other).template)) == (other == kind)


@pytest.mark.parametrize(
    "change",
    [
        {"takeup": None, "take_up": {"type": "gravity", "tension": "30 kN"}},
        {"drive__drum__frictoin": 0.3},
        {"speed": 2.5},
        {"takeup__type": "spring"},
        {"kind": "airship"},
    ],
    ids=["misspelt", "misspelt inside", "no unit", "no choice", "no kind"],
)
@pytest.mark.parametrize("arguments", [(), ("conveyor",)])
def test_the_schema_rejects_what_check_rejects(
    arguments: tuple[str, ...], change: dict[str, Any], tmp_path: Path
) -> None:
    validator = Draft202012Validator(schema(*arguments))
    assert validator.is_valid(template())
    faulty = changed(template(), **change)
    assert not validator.is_valid(faulty)
    assert ptmcalc("check", written(tmp_path / "faulty.yaml", faulty)).status == 2


def properties(node: Any, place: str = "") -> list[tuple[str, dict[str, Any]]]:
    """Every property of a schema with its place."""
    found = []
    if isinstance(node, dict):
        for name, value in node.get("properties", {}).items() if isinstance(node.get("properties"), dict) else ():
            found.append((f"{place}.{name}", value))
        for key, value in node.items():
            found += properties(value, f"{place}.{key}")
    if isinstance(node, list):
        for index, value in enumerate(node):
            found += properties(value, f"{place}[{index}]")
    return found


@pytest.mark.parametrize("kind", kind_names())
def test_the_schema_describes_every_key(kind: str) -> None:
    found = properties(schema(kind))
    assert len(found) > 20
    silent = [
        place
        for place, value in found
        if "description" not in value and place.rsplit(".", 1)[-1] not in ("kind", "type")
    ]
    assert silent == []


@pytest.mark.parametrize("kind", kind_names())
def test_the_schema_shows_a_unit_to_copy_wherever_one_is_needed(kind: str) -> None:
    def measures(node: Any) -> list[dict[str, Any]]:
        inner = node.values() if isinstance(node, dict) else node if isinstance(node, list) else ()
        here = [node] if isinstance(node, dict) and "x-quantity" in node else []
        return here + [one for child in inner for one in measures(child)]

    found = measures(schema(kind))
    assert len(found) > 10
    for measure in found:
        assert measure["examples"]
        if measure["type"] == "string":
            assert re.fullmatch(r"[0-9.]+(e-?[0-9]+)? \S+", measure["examples"][0]), measure


@pytest.mark.parametrize("kind", kind_names())
def test_new_prints_the_template(kind: str) -> None:
    done = ptmcalc("new", kind)
    assert (done.status, done.err) == (0, "")
    first, *others = load_kind(kind).types or (load_kind(kind),)
    assert done.out.endswith(first.template)
    said = done.out.removesuffix(first.template)
    assert all(f"ptmcalc new {kind} {other.type}" in said for other in others)
    assert bool(said) == bool(others)
    assert f"kind: {kind}" in done.out


def test_kinds_have_rows() -> None:
    rows = answer(ptmcalc("kinds", "--format", "json"))["rows"]
    assert [row["kind"] for row in rows] == list(kind_names())
    assert all(row["title"] for row in rows)
    assert all(name in ptmcalc("kinds").out for name in kind_names())


@pytest.mark.parametrize("kind", kind_names())
def test_solvers_have_rows_with_scene_cost_error_and_source(kind: str) -> None:
    rows = answer(ptmcalc("solvers", kind, "--format", "json"))["rows"]
    assert {row["solver"] for row in rows} == {solver.name for solver in load_kind(kind).solvers}
    assert any(row["predicted_seconds"] for row in rows)
    for row in rows:
        assert row["kind"] == kind
        assert row["scene"]
        assert row["error"]
        assert row["source"]


def test_all_solvers_are_listed_without_a_kind() -> None:
    rows = answer(ptmcalc("solvers", "--format", "json"))["rows"]
    assert {row["kind"] for row in rows} == set(kind_names())


def test_no_word_of_the_table_of_solvers_is_cut_off() -> None:
    out = ptmcalc("solvers").out
    rows = answer(ptmcalc("solvers", "--format", "json"))["rows"]
    words = {word for row in rows for text in (row["source"], row["error"]) for word in text.split()}
    whole = {word for word in words if len(word) <= 12}  # longer ones may be folded
    assert {word for word in whole if word not in out} == set()


# -- the rest -------------------------------------------------------------------------------------------------------


def test_the_version() -> None:
    assert ptmcalc("--version") == Done(0, f"ptmcalc {__version__}\n", "")


@pytest.mark.parametrize("option", ["--help", "-h"])
def test_help_names_every_command(option: str) -> None:
    done = ptmcalc(option)
    assert done.status == 0
    listed = done.out.partition("Commands:\n")[2]
    for command in ("check", "plan", "solve", "scale", "new", "explain", "schema", "kinds", "solvers"):
        assert re.search(rf"^ +{command} +[A-Z]", listed, re.MULTILINE), command


def test_nothing_asked_is_wrong_usage_with_the_help() -> None:
    done = ptmcalc()
    assert done.status == 2
    assert "[OPTIONS] COMMAND [ARGS]" in unpainted(done.out + done.err)
