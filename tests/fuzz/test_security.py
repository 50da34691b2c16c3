"""What docs/security.md says a design file of a stranger can and cannot do."""

import csv
import json
import os
import re
from collections.abc import Iterator
from dataclasses import replace
from io import StringIO
from pathlib import Path
from types import UnionType
from typing import Any, Union, get_args, get_origin
from xml.etree import ElementTree as Xml

import pytest
from pydantic import BaseModel
from support.command import ROOT, environment, ptmcalc, python
from support.corpus import BASE, CASES
from support.fuzz import watched
from support.samples import SAMPLES

from ptmcalc.cli.output import say
from ptmcalc.contract.cost import CostReport
from ptmcalc.contract.report import FileReport
from ptmcalc.engine.load import load_text
from ptmcalc.engine.registry import kind_names, load_kind
from ptmcalc.report import Format, histories, render, work_precision
from ptmcalc.report.cost import markdown
from ptmcalc.report.markdown import code
from ptmcalc.spec.shape import keys_of, models_of

# -- it executes nothing and reads nothing --------------------------------------------------------------------------

WATCHED = """
import json, sys
from pathlib import Path
from ptmcalc.engine.check import Options, check_file
from ptmcalc.cli.main import main

told, files = [], sorted(Path("in").iterdir())
check_file(files[0], Options(budget=1e-3, repairs=False))

def audit(event, arguments):
    if on and event.partition(".")[0] in ("open", "os", "subprocess", "socket", "shutil", "pty", "ctypes", "marshal"):
        told.append([event, str(arguments[0]) if arguments else ""])

on = False
sys.addaudithook(audit)
on = True
for file in files:
    check_file(file, Options(budget=1e-3, repairs=False))
on = False
Path("told.json").write_text(json.dumps(told))
"""
"""Checks files and notes what is asked of the operating system meanwhile."""
MEMORY = "/proc/self/statm"
"""How much memory the program has, for the budget of a run."""


def test_of_the_operating_system_nothing_is_asked_but_the_file_and_our_own_modules(tmp_path: Path) -> None:
    (tmp_path / "in").mkdir()
    for number, case in enumerate(CASES):
        (tmp_path / "in" / f"{number:03}.yaml").write_bytes(case.raw)
    (tmp_path / "watched.py").write_text(WATCHED, "utf-8")
    done = python("watched.py", cwd=tmp_path, env=environment(ROOT))
    assert (done.status, done.err) == (0, "")
    told = json.loads((tmp_path / "told.json").read_text("utf-8"))
    opened = {what for event, what in told if event == "open" and not _is_program(what)}
    assert opened - {MEMORY} == {f"in/{number:03}.yaml" for number in range(len(CASES))}
    others = {event for event, what in told if event != "open"}
    harmless = {"os.listdir", "os.scandir", "os.putenv", "os.unsetenv", "marshal.loads", "ctypes.dlopen"}
    assert others <= harmless, "what an import asks for; modules are looked for in folders"


def _is_program(name: str) -> bool:
    """Whether it is a module or a table of ours, or what names the kinds of installed packages."""
    if Path(name).is_relative_to(ROOT / "ptmcalc"):
        return True
    return name.endswith((".py", ".pyc", ".so", ".zip", "entry_points.txt", "METADATA")) or name.isdecimal()


def test_no_key_of_any_kind_names_a_file() -> None:
    for name in kind_names():
        for one in load_kind(name).manifests:
            schema = json.dumps(one.spec.model_json_schema())
            assert '"format": "path"' not in schema
            assert '"format": "file-path"' not in schema
            assert not re.search(r'"(file|path|include|record|url|command)": {', schema)


def hostile_folder(place: Path) -> Path:
    """A folder of a stranger, beside a file that is none of his business."""
    (place / "secret.yaml").write_text("kind: conveyor\ntoken: ghp_0123456789\n", "utf-8")
    folder = place / "folder"
    folder.mkdir()
    (folder / "a.yaml").write_text(BASE, "utf-8")
    return folder


@pytest.mark.parametrize("word", ["folder", "folder/*.yaml", "./folder/../folder"])
def test_a_link_that_leads_out_of_the_folder_is_told_and_not_read(
    word: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = hostile_folder(tmp_path)
    (folder / "b.yaml").symlink_to("../secret.yaml")
    (folder / "inside.yaml").symlink_to("a.yaml")
    monkeypatch.chdir(tmp_path)
    done = ptmcalc("check", word, "--validate-only", "--format", "plain")
    assert done.status == 2
    assert re.search(r"b\.yaml: error TXT113 ", done.out)
    assert "token" not in done.out
    assert done.out.endswith("3 files, 0 checks passed, 1 invalid\n")
    named = ptmcalc("check", "folder/b.yaml", "--validate-only")
    assert "`token`" in named.out, "who names it may read it"


def test_a_link_inside_the_repository_is_followed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = hostile_folder(tmp_path)
    (tmp_path / ".git").mkdir()
    (folder / "b.yaml").symlink_to("../secret.yaml")
    monkeypatch.chdir(tmp_path)
    assert "TXT113" not in ptmcalc("check", "folder", "--validate-only").out


def test_a_folder_behind_a_link_is_not_entered(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = hostile_folder(tmp_path)
    (folder / "up").symlink_to("..")
    monkeypatch.chdir(tmp_path)
    assert ptmcalc("check", "folder", "--validate-only").out == "1 file, 0 checks passed\n"
    by_pattern = ptmcalc("check", "folder/**/*.yaml", "--validate-only").out
    assert "token" not in by_pattern
    assert "TXT113" in by_pattern


def test_pipes_and_devices_are_not_read(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.yaml")
    for path in (tmp_path / "pipe.yaml", Path("/dev/zero"), Path("/dev/full"), tmp_path):
        done = ptmcalc("check", "--validate-only", "-j", "1", path)
        assert done.status == 2
        assert "TXT101" in done.out or "TXT102" in done.out
    record = ptmcalc("decode", ROOT / "specs" / "shaft.yaml", tmp_path / "pipe.yaml", "--phase", "run_up")
    assert (record.status, "a pipe or a device, not a file" in record.err) == (2, True)


def test_the_ignored_of_a_stranger_take_no_time(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = hostile_folder(tmp_path)
    (folder / f"{'a' * 200}.yaml").write_text(BASE, "utf-8")
    monkeypatch.chdir(tmp_path)
    (folder / ".gitignore").write_text("/**/**/x*y*z*\n*a*a*a*b*\n", "utf-8")
    with watched(2):
        assert ptmcalc("check", "folder", "--validate-only").status == 0
    (folder / ".gitignore").write_text("*a*a*a*a*a*a*a*a*a*b*\n", "utf-8")
    done = ptmcalc("check", "folder", "--validate-only")
    assert (done.status, "has too many `*`" in done.err) == (2, True)
    (folder / ".gitignore").unlink()
    (folder / ".gitignore").symlink_to("/dev/zero")
    assert ptmcalc("check", "folder", "--validate-only").status == 0


# -- it exhausts neither memory nor time ----------------------------------------------------------------------------

MUCH = {
    "bytes": (b"kind: conveyor # " + b"x" * (1 << 20), (1, 1)),
    "nodes": (b"kind: conveyor\nx: [" + b"1," * 50_000 + b"]\n", (2, 99_995)),
    "aliases": (b"a: &a [" + b"1," * 1000 + b"]\nb: [" + b"*a," * 60 + b"]\n", (2, 149)),
    "levels": (b"kind: conveyor\nx: " + b"[" * 101, (2, 103)),
    "letters of a value": (b"kind: conveyor\nname: " + b"x" * 10_001, (2, 7)),
    "letters of a key": (b"kind: conveyor\n? " + b"x" * 10_001 + b"\n: 1\n", (2, 3)),
    "faults of the text": (b"kind: conveyor\n" + b"x: 1\n" * 1002, (1003, 1)),
    "unknown keys": (b"kind: conveyor\n" + b"".join(b"x%d: 1\n" % n for n in range(2000)), None),
    "unknown effects": (b"kind: conveyor\neffects:\n" + b"".join(b" x%d: on\n" % n for n in range(2000)), None),
    "unknown checks": (b"kind: conveyor\nchecks:\n" + b"".join(b" x%d: 1\n" % n for n in range(2000)), None),
}


@pytest.mark.parametrize("what", MUCH)
def test_too_much_of_anything_is_told_at_its_place(what: str) -> None:
    raw, place = MUCH[what]
    with watched(2):
        found = load_text(raw, "much.yaml").diagnostics
    (told,) = (one for one in found if one.code == "TXT108")
    assert told.hint
    assert told.span is not None
    if place is not None:
        assert (told.span.line, told.span.column) == place
    assert len(found) <= 2001


def _lists(annotation: Any, path: str, depth: int = 0) -> Iterator[tuple[str, bool]]:
    """The lists and tables of parts below an annotation, and whether they have a most."""
    limits = []
    while hasattr(annotation, "__metadata__"):
        limits += annotation.__metadata__
        annotation = get_args(annotation)[0]
    if get_origin(annotation) in (Union, UnionType):
        for part in get_args(annotation):
            yield from _lists(part, path, depth)
        return
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        for key, field in keys_of(annotation).items() if depth < 8 else ():
            own = [part for part in field.metadata if getattr(part, "max_length", None)]
            inside = list(_lists(field.annotation, f"{path}.{key}", depth + 1))
            yield from ([(name, limited or bool(own)) for name, limited in inside[:1]] + inside[1:] if own else inside)
        return
    if get_origin(annotation) in (tuple, list, dict):
        of_fixed_length = get_origin(annotation) is tuple and get_args(annotation)[-1] is not Ellipsis
        most = any(getattr(part, "max_length", None) or _in_field(part) for part in limits)
        yield path, of_fixed_length or most
        for part in get_args(annotation):
            if models_of(part):
                yield from _lists(part, f"{path}[]", depth + 1)


def _in_field(part: Any) -> bool:
    return any(getattr(one, "max_length", None) for one in getattr(part, "metadata", ()))


NO_MOST = {"effects", "waive"}
"""Of them there are at most as many as effects and checks of the kind: others are refused by name, a second one too."""


def test_every_list_of_every_kind_has_a_most() -> None:
    endless = {
        path
        for name in kind_names()
        for one in load_kind(name).manifests
        for path, limited in _lists(one.spec, one.label)
        if not limited and path.rpartition(".")[2] not in NO_MOST
    }
    assert endless == set()


def test_a_scene_beyond_the_budget_is_undecided_and_said(tmp_path: Path) -> None:
    (tmp_path / "a.yaml").write_text(BASE.replace("240 kN", "150 kN"), "utf-8")
    done = ptmcalc("check", tmp_path / "a.yaml", "--budget", "0 s", "--format", "plain")
    assert "NUM103" in done.out
    assert done.status in (1, 3)


# -- what it says cannot leave the report ---------------------------------------------------------------------------

NASTY = (
    *("\x1b[31mred", "a\nb", "a\r\n::error::b", "[red]x[bold]", ":smile:", "::warning file=x::y", "##[error]z", "-x"),
    *("##vso[task.setvariable variable=x]y", "=1+1", "+1", "@a", "a`b|c", "<script>", "%0A::error::", "\u202ereversed"),
)


def nasty_files(folder: Path) -> None:
    """Files whose names mean something to whoever prints them, one of them no UTF-8."""
    for name in NASTY:
        (folder / f"{name}.yaml").write_text(BASE.replace("corpus", json.dumps(name)), "utf-8")
    with open(os.fsencode(folder) + b"/bad\xff.yaml", "wb") as file:
        file.write(b"kind: conveyor\n")


@pytest.mark.parametrize("form", list(Format))
def test_names_of_files_and_machines_mean_nothing_to_who_prints_them(
    form: Format, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "in").mkdir()
    nasty_files(tmp_path / "in")
    monkeypatch.chdir(tmp_path / "in")
    words = ("check", "--format", form.value, "--budget", "0.1 ms", "--no-repairs", "--", ".")
    done = ptmcalc(*words)
    assert done.status == 2
    text = done.out
    assert "BUG" not in text
    lines = text.split("\n")
    if form in (Format.JSON, Format.SARIF):
        json.loads(text, parse_constant=lambda word: pytest.fail(word))
    else:
        assert not [char for char in text if not char.isprintable() and char != "\n"]
    if form is Format.JUNIT:
        Xml.fromstring(text)
    if form is Format.CSV:
        for row in csv.reader(StringIO(text)):
            texts = [cell for cell in row if not re.fullmatch(r"-?[0-9.e+-]+", cell)]
            assert not [cell for cell in texts if cell.startswith(("=", "+", "-", "@"))]
    if form is not Format.GITHUB:
        assert not [line for line in lines if line.lstrip().startswith("::")]
        assert not re.search(r"(?<!\\)##\w*\[", text)
    else:
        assert all(re.match(r"::(error|warning|notice) file=", line) for line in lines[:-2])
    if form in (Format.TABLE, Format.PLAIN, Format.SUMMARY):
        assert "[red]x[bold]" in text, "it is a name"
        assert ":smile:" in text


def test_a_wrapped_name_begins_no_line_as_a_command(capsys: pytest.CaptureFixture[str]) -> None:
    say("x\n  ::error::y\n##vso[z]\n## heading\na ##[group] b\n")
    assert capsys.readouterr().out == "x\n\\  ::error::y\n\\##vso[z]\n## heading\na \\##[group] b\n"


def test_wrong_usage_prints_no_escape(tmp_path: Path) -> None:
    done = ptmcalc("check", tmp_path, "--scene", "x", "--baseline", "\x1b[31m\n::error::x")
    assert done.status == 2
    assert "\x1b" not in done.err
    assert len(done.err.splitlines()) == 1


def test_a_message_holds_no_link_for_code_scanning() -> None:
    said = replace(SAMPLES["warned"].diagnostics[0], message="[click](http://evil)")
    run = json.loads(render(Format.SARIF, [replace(SAMPLES["warned"], diagnostics=(said,))]))["runs"][0]
    assert all("](" not in one["message"]["text"] for one in run["results"])


def test_a_history_is_no_formula() -> None:
    (row, *_) = list(csv.DictReader(StringIO(histories.render([replace(SAMPLES["moving"], path="=cmd.yaml")]))))
    assert row["file"] == "'=cmd.yaml"


def test_a_page_and_a_table_of_costs_hold_no_markup() -> None:
    report = CostReport('<script>alert(1)</script>"`|\x1b', "conveyor", (), (), None)
    page = work_precision.render(report)
    assert "<script" not in page
    table = markdown([report])
    assert "\x1b" not in table
    assert re.findall(r"(?<!\\)\|", table.splitlines()[-1]) == re.findall(r"\|", table.splitlines()[0])


@pytest.mark.parametrize("text", ["a", "a`b", "``", "a`", "a|b", "`````", ""])
def test_code_of_markdown_ends_where_it_ends(text: str) -> None:
    (fence,) = re.findall("^`+", code(text.replace("`", "'"))) or [""]
    found = code(text)
    opening = re.match("`+", found)
    assert opening is not None
    assert found.endswith(opening[0])
    inside = found[len(opening[0]) : -len(opening[0])]
    assert opening[0] not in inside
    assert inside.strip().replace("\\|", "|") == text
    assert fence


def test_a_comment_keeps_below_what_a_comment_may_be_whatever_a_file_says() -> None:
    (scene, *_) = SAMPLES["failing"].scenes
    long = tuple(replace(one, reason="x" * 9000) for one in scene.checks)
    many: tuple[FileReport, ...] = tuple(
        replace(SAMPLES["failing"], path=f"{n}.yaml", scenes=(replace(scene, checks=long),)) for n in range(150)
    )
    assert len(render(Format.MARKDOWN, many)) < 65_536


def test_python_is_told_no_more_of_a_secret_than_where_it_stands() -> None:
    """A value of the wrong form is described, not shown."""
    found = load_text(BASE.replace("name: corpus", "name: [ghp_0123456789]").encode(), "secret.yaml").diagnostics
    assert found
    assert not [one for one in found if "ghp" in one.message + one.hint]
