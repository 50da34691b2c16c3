"""Faulty files through the command line: each fault at its place with a reason and a way out, and never a traceback.

The table says what a person sees: the line, and the words in it that are wrong. Each file is sound but for its fault.
"""

import json
import math
import subprocess
import sys
import warnings
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from support.command import ROOT, Done, environment, ptmcalc, python
from support.machines import template

from ptmcalc.base.diagnostic import CODES
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_text
from ptmcalc.report import Format, render

FILES = Path(__file__).parent / "files"

Fault = tuple[str, int, str | int | None]
"""Code, line, and the words at fault; a column where there are no words, None where any column of the line will do."""

FAULTS: dict[str, list[Fault]] = {
    # the text
    "alias_bomb.yaml": [("TXT108", 7, None)],
    "colon_in_value.yaml": [("TXT105", 3, ": BC-1")],
    "control_character.yaml": [("TXT105", 3, "\x1b")],
    "duplicate_key.yaml": [("TXT106", 18, "speed")],
    "empty.yaml": [("TXT104", 1, 1)],
    "explicit_tag.yaml": [("TXT107", 18, "!!python")],
    "key_is_a_list.yaml": [("TXT111", 19, "[effects")],
    "list_at_top.yaml": [("TXT112", 2, "- kind")],
    "missing_space.yaml": [("TXT105", 5, "lift:18")],
    "not_utf8.yaml": [("TXT103", 3, "\ufffd")],
    "not_utf8_after_mark.yaml": [("TXT103", 1, "\ufffd")],
    "only_comments.yaml": [("TXT104", 1, 1)],
    "open_brace.yaml": [("TXT105", 3, "]")],
    "open_quote.yaml": [("TXT105", 3, "'")],
    "tab_indentation.yaml": [("TXT105", 5, "\t")],
    "too_deep.yaml": [("TXT108", 3, len("description: ") + 100)],  # the hundredth bracket opens level 101
    "two_documents.yaml": [("TXT109", 4, "---")],
    "unknown_alias.yaml": [("TXT110", 5, "*height")],
    "utf16.yaml": [("TXT103", 1, 1)],
    "word_at_top.yaml": [("TXT112", 2, "conveyor")],
    # the kind
    "empty_kind.yaml": [("SPC102", 2, len("kind:") + 1)],
    "missing_kind.yaml": [("SPC101", 2, "route")],
    "unknown_kind.yaml": [("SPC102", 2, "conveyer")],
    # keys
    "missing_block.yaml": [("SPC103", 2, "kind")],
    "missing_key.yaml": [("SPC103", 16, "gear")],
    "missing_scene_type.yaml": [("SPC103", 21, "load")],
    "misspelt_block.yaml": [("SPC104", 14, "resistanse")],
    "misspelt_key.yaml": [("SPC104", 5, "lfit")],
    "misspelt_required_key.yaml": [("SPC104", 4, "lenght")],
    "unknown_check.yaml": [("SPC104", 21, "CNV999")],
    "unknown_effect.yaml": [("SPC104", 19, "belt_vawe")],
    # numbers
    "bare_number.yaml": [("SPC106", 5, "18")],
    "decimal_comma.yaml": [("SPC107", 13, "2,5")],
    "decimal_comma_in_braces.yaml": [("SPC107", 16, "24,8")],
    "digit_groups.yaml": [("SPC114", 17, "1 200")],
    "efficiency_above_one.yaml": [("SPC110", 16, "105 %")],
    "frequency_for_speed.yaml": [("SPC105", 15, "25 Hz")],
    "half_a_motor.yaml": [("SPC111", 15, "1.5")],
    "huge_number.yaml": [("SPC109", 4, "1e400")],
    "infinite.yaml": [("SPC109", 16, ".inf")],
    "infinite_with_unit.yaml": [("SPC109", 8, "inf N")],
    "nan.yaml": [("SPC109", 13, ".nan")],
    "nan_with_unit.yaml": [("SPC109", 5, "nan m")],
    "negative_mass.yaml": [("SPC110", 7, "-15")],
    "no_motor.yaml": [("SPC110", 15, "0,")],
    "not_a_number.yaml": [("SPC114", 5, "eighteen")],
    "unknown_unit.yaml": [("SPC108", 18, "3 ton")],
    "wrong_dimension.yaml": [("SPC105", 7, "15 kg")],
    "zero_length.yaml": [("SPC110", 4, "0 m")],
    # forms and words
    "block_for_value.yaml": [("SPC111", 14, "belt")],
    "neither_way.yaml": [("SPC113", 6, "belt")],
    "no_scenes.yaml": [("SPC110", 19, "[]")],
    "same_scene_twice.yaml": [("SPC113", 22, "type")],
    "scene_is_a_word.yaml": [("SPC111", 21, "start")],
    "two_ways_at_once.yaml": [("SPC113", 10, "modulus")],
    "unknown_scene_type.yaml": [("SPC112", 22, "strat")],
    "unknown_word.yaml": [("SPC112", 18, "gravty")],
    "value_for_block.yaml": [("SPC111", 12, "coal")],
    # several at once, in the order of the file
    "seven_faults.yaml": [
        ("SPC106", 5, "18"),
        ("SPC105", 7, "15 kg"),
        ("SPC110", 10, "-18"),
        ("SPC104", 14, "coefficent"),
        ("SPC107", 15, "2,5"),
        ("SPC103", 18, "gear"),
        ("TXT106", 21, "speed"),
    ],
    "seven_more_faults.yaml": [
        ("TXT107", 3, "!!str"),
        ("SPC108", 5, "15 lb/m"),
        ("SPC109", 5, ".inf"),
        ("SPC114", 12, "1 200"),
        ("SPC112", 13, "gravty"),
        ("SPC111", 14, "25 kg*m^2"),
        ("SPC104", 15, '"größe"'),
    ],
}


def column_of(file: str, line: int, at: str | int | None) -> int | None:
    """The column at which the words stand in their line, as an editor counts."""
    if not isinstance(at, str):
        return at
    text = (FILES / file).read_bytes().decode("utf-8-sig", "replace").split("\n")[line - 1]
    assert text.count(at) == 1, f"{at!r} is not once in {text!r}"
    return text.index(at) + 1


@cache
def checked(file: str, form: str) -> Done:
    return ptmcalc("check", FILES / file, "--format", form)


def diagnostics_of(file: str) -> list[dict[str, Any]]:
    (report,) = json.loads(checked(file, "json").out)["files"]
    found: list[dict[str, Any]] = report["diagnostics"]
    return found


def test_every_file_is_in_the_table() -> None:
    assert sorted(path.name for path in FILES.iterdir()) == sorted(FAULTS)


@pytest.mark.parametrize("file", FAULTS)
def test_each_fault_is_named_once_at_its_place(file: str) -> None:
    expected = [(code, line, column_of(file, line, at)) for code, line, at in FAULTS[file]]
    found = [(d["code"], d["line"], d["column"]) for d in diagnostics_of(file)]
    if expected[0][2] is None:
        found = [(code, line, None) for code, line, _ in found]
    assert found == expected


@pytest.mark.parametrize("file", FAULTS)
def test_each_fault_has_a_reason_and_a_hint(file: str) -> None:
    for diagnostic in diagnostics_of(file):
        assert diagnostic["severity"] == "error"
        assert diagnostic["code"] in CODES
        assert len(diagnostic["message"].split()) >= 3
        assert diagnostic["hint"]


@pytest.mark.parametrize("form", ["plain", "json", "table"])
@pytest.mark.parametrize("file", FAULTS)
def test_a_faulty_file_is_wrong_input_and_no_bug_of_ours(file: str, form: str) -> None:
    done = checked(file, form)
    assert done.status == 2
    assert done.err == ""
    assert "Traceback" not in done.out
    assert "internal error" not in done.out


@pytest.mark.parametrize("file", FAULTS)
def test_a_plain_line_leads_an_editor_to_the_place(file: str) -> None:
    *lines, summary = checked(file, "plain").out.splitlines()
    path = (FILES / file).as_posix()
    assert len(lines) == len(diagnostics_of(file))
    for line, d in zip(lines, diagnostics_of(file), strict=True):
        hint = f"; {d['hint']}" if d["hint"] else ""
        assert line == f"{path}:{d['line']}:{d['column']}: error {d['code']} {d['message']}{hint}"
    assert summary == "1 file, 0 checks passed, 1 invalid"


@pytest.mark.parametrize("file", ["seven_faults.yaml", "seven_more_faults.yaml"])
def test_seven_faults_are_seven_diagnostics(file: str) -> None:
    found = diagnostics_of(file)
    assert len(found) == 7
    assert len({d["code"] for d in found}) == 7
    assert len({(d["line"], d["column"]) for d in found}) == 7


@pytest.mark.parametrize(
    "file", ["alias_bomb.yaml", "empty.yaml", "not_utf8.yaml", "seven_more_faults.yaml", "too_deep.yaml"]
)
def test_a_process_of_its_own_says_the_same(file: str) -> None:
    path = (FILES / file).relative_to(ROOT)
    done = python("-m", "ptmcalc", "check", path)
    assert (done.status, done.err) == (2, "")
    for code, line, at in FAULTS[file]:
        column = column_of(file, line, at)
        place = f"{path.as_posix()}:{line}:{column}" if column else ""
        assert f"{place}: error {code} " in done.out


def test_a_tag_runs_nothing(tmp_path: Path) -> None:
    file = tmp_path / "evil.yaml"
    file.write_text('kind: conveyor\nname: !!python/object/apply:os.system ["touch built_by_a_tag"]\n', "utf-8")
    done = python("-m", "ptmcalc", "check", file, cwd=tmp_path)
    assert done.status == 2
    assert ":2:7: error TXT107 " in done.out
    assert [path.name for path in tmp_path.iterdir()] == ["evil.yaml"]


# --- paths -----------------------------------------------------------------------------------------------------------


def faults_without_place(*arguments: Path) -> list[tuple[str, str, int | None]]:
    """Name of the path and code of every diagnostic, which has no place: there is no text to point into."""
    done = ptmcalc("check", *arguments, "--format", "json")
    assert (done.status, done.err) == (2, "")
    return [
        (Path(file["path"]).name, d["code"], d["line"])
        for file in json.loads(done.out)["files"]
        for d in file["diagnostics"]
    ]


def test_a_path_that_does_not_exist(tmp_path: Path) -> None:
    assert faults_without_place(tmp_path / "nowhere.yaml") == [("nowhere.yaml", "TXT101", None)]
    line = ptmcalc("check", tmp_path / "nowhere.yaml", "--format", "plain").out.splitlines()[0]
    assert line.startswith(f"{(tmp_path / 'nowhere.yaml').as_posix()}: error TXT101 ")


def test_a_folder_without_design_files(tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("kind: conveyor\n", "utf-8")
    (tmp_path / ".hidden").mkdir()
    (tmp_path / ".hidden" / "conveyor.yaml").write_text("kind: conveyor\n", "utf-8")
    assert faults_without_place(tmp_path) == [(tmp_path.name, "TXT102", None)]


def test_an_empty_folder_beside_a_missing_file(tmp_path: Path) -> None:
    (tmp_path / "empty").mkdir()
    found = faults_without_place(tmp_path / "empty", tmp_path / "nowhere.yaml")
    assert found == [("empty", "TXT102", None), ("nowhere.yaml", "TXT101", None)]


def test_all_files_of_a_folder_are_reported() -> None:
    done = ptmcalc("check", FILES, "--format", "json")
    assert done.status == 2
    files = json.loads(done.out)["files"]
    assert [Path(file["path"]).name for file in files] == sorted(FAULTS)
    assert {file["verdict"] for file in files} == {"invalid"}


# --- one broken file among good ones ---------------------------------------------------------------------------------


def written(path: Path, data: dict[str, Any]) -> Path:
    path.write_text(json.dumps(data), "utf-8")
    return path


@pytest.mark.parametrize(
    "broken", ["alias_bomb.yaml", "empty.yaml", "not_utf8.yaml", "too_deep.yaml", "unknown_kind.yaml", "nan.yaml"]
)
def test_a_broken_file_does_not_stop_the_others(broken: str, tmp_path: Path) -> None:
    machine = template() | {"scenes": [{"type": "run"}]}
    written(tmp_path / "a_good.yaml", machine)
    (tmp_path / "b_broken.yaml").write_bytes((FILES / broken).read_bytes())
    written(tmp_path / "c_good.yaml", machine)
    done = ptmcalc("check", tmp_path, "--format", "json")
    document = json.loads(done.out)
    alone = json.loads(ptmcalc("check", tmp_path / "c_good.yaml", "--format", "json").out)
    assert done.status == 2
    assert [file["verdict"] for file in document["files"]] == ["pass", "invalid", "pass"]
    assert document["files"][2] == alone["files"][0]
    assert (document["summary"]["files"], document["summary"]["invalid"]) == (3, 1)
    assert document["summary"]["pass"] == 2 * alone["summary"]["pass"] > 0


def test_an_invalid_file_weighs_more_than_a_failed_check(tmp_path: Path) -> None:
    weak = template() | {"scenes": [{"type": "run"}], "takeup": {"type": "gravity", "tension": "1 kN"}}
    file = written(tmp_path / "weak.yaml", weak)
    assert ptmcalc("check", file).status == 1
    assert ptmcalc("check", file, FILES / "empty.yaml").status == 2
    assert ptmcalc("check", FILES / "empty.yaml", file).status == 2


# --- hostile and absurd ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("form", [Format.PLAIN, Format.TABLE])
@pytest.mark.parametrize("key", ["\x1b[31mred", "a\nb", "a\rb", "\x07bell", "[/bold]", "[red]x", "\u202ereversed"])
def test_a_key_of_the_file_cannot_steer_the_terminal(key: str, form: Format) -> None:
    """YAML writes any character by an escape between quotes; a report must not send it on."""
    loaded = load_text(json.dumps(template() | {key: 1}).encode(), "hostile.yaml")
    printed = render(form, [check(loaded, Options())])
    assert not [char for char in printed if not char.isprintable() and char != "\n"]
    assert key in printed or not key.isprintable()
    if form is Format.PLAIN:
        assert len(printed.splitlines()) == 2


@pytest.mark.parametrize("form", [Format.PLAIN, Format.TABLE])
def test_no_text_of_the_file_or_of_its_path_can_steer_the_terminal(form: Format) -> None:
    hostile = "\x1b[2J\n\u202eevil"
    machine = template() | {"name": hostile, "scenes": [{"type": "run"}], "checks": {"CNV103": {"off": hostile}}}
    printed = render(form, [check(load_text(json.dumps(machine).encode(), f"{hostile}.yaml"), Options())])
    assert not [char for char in printed if not char.isprintable() and char != "\n"]
    assert "\\x1b[2J\\n\\u202eevil" in printed


def test_json_keeps_the_text_of_the_file() -> None:
    hostile = "\x1b[2J\n\u202eevil"
    loaded = load_text(json.dumps(template() | {"name": hostile, hostile: 1}).encode(), "hostile.yaml")
    (file,) = json.loads(render(Format.JSON, [check(loaded, Options())]))["files"]
    assert (file["name"], file["diagnostics"][0]["path"]) == (hostile, [hostile])


@pytest.mark.parametrize("form", ["table", "plain", "json"])
@pytest.mark.parametrize("encoding", ["cp1252", "cp437", "utf-16"])
def test_what_a_stream_cannot_encode_is_no_bug_of_ours(form: str, encoding: str, tmp_path: Path) -> None:
    machine = template() | {"name": "Förderband 重 😀", "scenes": [{"type": "run"}], "x😀": 1}
    file = tmp_path / "name.yaml"
    file.write_text(json.dumps(machine, ensure_ascii=False), "utf-8")
    done = subprocess.run(
        [sys.executable, "-m", "ptmcalc", "check", file, "--format", form],
        env=environment(ROOT, PYTHONIOENCODING=encoding),
        capture_output=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (2, b"")
    assert "SPC104" in done.stdout.decode(encoding)


def test_a_pipe_gets_utf8_where_nobody_chose_an_encoding(tmp_path: Path) -> None:
    file = tmp_path / "size.yaml"
    file.write_text("kind: größe\n", "utf-8")
    plain = environment(ROOT, LC_ALL="C", PYTHONUTF8="0", PYTHONCOERCECLOCALE="0")
    done = python("-m", "ptmcalc", "check", file, env={k: v for k, v in plain.items() if k != "PYTHONIOENCODING"})
    assert done.status == 2
    assert "`größe`" in done.out


def test_a_key_to_vary_that_is_empty_is_wrong_usage(tmp_path: Path) -> None:
    file = written(tmp_path / "conveyor.yaml", template())
    done = ptmcalc("solve", file, "--check", "CNV101", "--vary", "")
    assert (done.status, done.out) == (2, "")
    assert "internal error" not in done.err


def test_a_huge_file_is_not_read_to_its_end(tmp_path: Path) -> None:
    """Sixteen gibibytes of nothing, of which the first mebibyte is enough to refuse it."""
    file = tmp_path / "huge.yaml"
    with file.open("wb") as hole:
        hole.truncate(1 << 34)
    done = ptmcalc("check", file, "--format", "plain")
    assert done.status == 2
    assert "TXT108" in done.out


ABSURD = [
    ("route", "length", "1e300 m"),
    ("belt", "mass", "1e300 kg/m"),
    ("belt", "mass", "1e-300 kg/m"),
    ("belt", "modulus", "1e-300 N/mm"),
    ("load", "capacity", "1e300 t/h"),
    ("takeup", "tension", "1e-300 N"),
    ("takeup", "tension", "1e300 N"),
    ("drive.gear", "ratio", 1e300),
    ("drive.gear", "ratio", 1e-300),
    ("drive.drum", "diameter", "1e300 m"),
    ("drive.drum", "wrap", "1e300 deg"),
    ("drive.motor", "inertia", "1e300 kg*m^2"),
    ("resistance", "coefficient", 1e300),
    ("", "speed", "1e300 m/s"),
    ("", "speed", "1e-300 m/s"),
    # large and small beyond all machines, but allowed
    ("route", "length", "1e15 m"),
    ("belt", "mass", "1e14 kg/m"),
    ("belt", "mass", "1e-12 kg/m"),
    ("load", "capacity", "1e12 kg/s"),
    ("takeup", "tension", "1e-12 N"),
    ("takeup", "tension", "1e15 N"),
    ("drive.gear", "ratio", 1e15),
    ("drive.gear", "ratio", 1e-12),
    ("drive.drum", "diameter", "1e15 m"),
    ("drive.drum", "wrap", "1e15 rad"),
    ("drive.motor", "inertia", "1e15 kg*m^2"),
    ("resistance", "coefficient", 1e15),
    ("", "speed", "1e15 m/s"),
]


@pytest.mark.parametrize(("block", "key", "value"), ABSURD)
def test_a_number_a_float_holds_but_no_machine_has_is_no_bug_of_ours(
    block: str, key: str, value: str | float, tmp_path: Path
) -> None:
    data = template() | {"scenes": [{"type": "run"}, {"type": "start"}]}
    node = data
    for step in filter(None, block.split(".")):
        node = node[step]
    node[key] = value
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # as in a process of its own, where they do not become errors
        done = ptmcalc("check", written(tmp_path / "absurd.yaml", data), "--format", "json")
    assert done.status in (0, 1, 2, 3), done.err
    for file in json.loads(done.out)["files"]:
        for scene in file["scenes"]:
            assert all(load["value"] is None or math.isfinite(load["value"]) for load in scene["loads"])


def test_a_folder_takes_upper_case_endings_and_names_links_that_lead_nowhere(tmp_path: Path) -> None:
    (tmp_path / "C.YAML").write_text("kind: conveyor\n", encoding="utf-8")
    (tmp_path / "gone.yaml").symlink_to(tmp_path / "nowhere")
    done = ptmcalc("check", tmp_path)
    assert done.status == 2
    assert "C.YAML:1:1: error SPC103" in done.out
    assert "gone.yaml: error TXT101" in done.out
