"""`diff`: what changed between two states, by how much against the error bars, and how it reads."""

import json
import re
from pathlib import Path
from typing import Any

import pytest
from support.command import Done, ptmcalc

from ptmcalc.report.compare import Move, Number, Turn, compared, pairs

SPECS = Path(__file__).parent / "specs"
PASSING = (SPECS / "passing.yaml").read_text("utf-8")
SMOOTH = PASSING.replace("friction: 0.35", "friction: 0.09").replace("30 kN", "28 kN")


@pytest.fixture(scope="module")
def store(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What is known of the few machines below, so that each is computed once."""
    return tmp_path_factory.mktemp("diff") / "store"


@pytest.fixture(autouse=True)
def states(tmp_path: Path, store: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Two folders: a file that gets worse, one that stays, one that goes, one that comes, one that becomes invalid."""
    before = {"worse.yaml": PASSING, "in/same.yaml": PASSING, "gone.yaml": PASSING, "invalid.yaml": PASSING}
    after = {"worse.yaml": SMOOTH, "in/same.yaml": PASSING, "new.yaml": SMOOTH, "invalid.yaml": "kind: conveyor\n"}
    for state, files in (("old", before), ("new", after)):
        for name, text in files.items():
            path = tmp_path / state / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "store").symlink_to(store)
    return tmp_path


def rows(done: Done, what: str) -> list[dict[str, Any]]:
    found = json.loads(done.out)
    assert found["schema_version"] == "1"
    return [row for row in found["rows"] if row["what"] == what]


def diffed(old: str, new: str, form: str = "json") -> Done:
    done = ptmcalc("diff", old, new, "--format", form, "--store", "store")
    known = [line for line in done.err.splitlines() if " known from " in line]
    return Done(done.status, done.out, "\n".join(line for line in done.err.splitlines() if line not in known))


# -- what changed ---------------------------------------------------------------------------------------------------


def test_two_folders_are_compared_file_by_file(states: Path) -> None:
    done = diffed("old", "new")
    assert (done.status, done.err) == (2, "")
    assert [(row["file"], row["change"], row["old"], row["new"]) for row in rows(done, "file")] == [
        ("gone.yaml", "gone", "pass", None),
        ("invalid.yaml", "worse", "pass", "invalid"),
        ("new.yaml", "new", None, "fail"),
        ("worse.yaml", "worse", "pass", "fail"),
    ]


def test_verdicts_and_keys_that_changed_are_told_with_their_numbers(states: Path) -> None:
    done = diffed("old/worse.yaml", "new/worse.yaml")
    assert done.status == 1
    assert [(row["key"], row["old"], row["new"]) for row in rows(done, "key")] == [
        ("drive.drum.friction", "0.35", "0.09"),
        ("takeup.tension", "30 kN", "28 kN"),
    ]
    lines = SMOOTH.splitlines()
    assert all(row["new"] in lines[row["line"] - 1] for row in rows(done, "key"))
    found = rows(done, "check")
    worse = [(row["code"], row["scene"]) for row in found if row["change"] == "worse"]
    assert (
        worse == [("CNV101", "run_loaded"), ("CNV101", "start_empty")] == [(r["code"], r["scene"]) for r in found[:2]]
    )
    for state, path in (("old", "old/worse.yaml"), ("new", "new/worse.yaml")):
        report = json.loads(ptmcalc("check", path, "--format", "json", "--store", "store").out)["files"][0]
        checks = {(scene["name"], one["code"]): one for scene in report["scenes"] for one in scene["checks"]}
        for row in found:
            whole = checks[row["scene"], row["code"]]
            assert row[state] == {key: whole[key] for key in row[state]}


def test_loads_are_held_against_the_bars_of_both(states: Path) -> None:
    found = rows(diffed("old/worse.yaml", "new/worse.yaml"), "load")
    assert {row["change"] for row in found} == {"clear", "within_bars"}
    for row in found:
        old, new = row["old"], row["new"]
        apart = new["low"] > old["high"] or new["high"] < old["low"]
        assert apart is (row["change"] == "clear")
        assert row["relative"] == pytest.approx((new["value"] - old["value"]) / abs(old["value"]))
        bars = sum(max(one["high"] - one["value"], one["value"] - one["low"]) for one in (old, new))
        assert row["over_bars"] == (pytest.approx(abs(new["value"] - old["value"]) / bars) if bars else None)


@pytest.mark.parametrize("form", ["table", "json", "markdown"])
def test_reports_say_the_same_as_the_folders_but_for_the_keys(states: Path, form: str) -> None:
    for state in ("old", "new"):
        ptmcalc("check", state, "-o", f"json={state}.json", "--store", "store")
    folders, reports = diffed("old", "new", form), diffed("old.json", "new.json", form)
    assert reports.status == folders.status == 2
    with_keys = re.compile(r"Changed: .*\n\n|^ [\w.\[\]]+ (is|.* →|more keys?)(?: .*)?\n", re.MULTILINE)
    if form == "json":
        assert [r for r in json.loads(folders.out)["rows"] if r["what"] != "key"] == json.loads(reports.out)["rows"]
    else:
        assert with_keys.sub("", folders.out) == reports.out


@pytest.mark.parametrize("form", ["table", "markdown", "json"])
def test_where_nothing_changed_nothing_is_told(states: Path, form: str) -> None:
    done = diffed("old", "old", form)
    assert (done.status, done.err) == (0, "")
    if form == "json":
        assert json.loads(done.out)["rows"] == []
    else:
        assert "Nothing changed in 4 files." in done.out
        assert "yaml" not in done.out


def test_what_gets_better_is_no_fault(states: Path) -> None:
    done = diffed("new/worse.yaml", "old/worse.yaml", "markdown")
    assert done.status == 0
    assert "✅ **CNV101 drive pulley traction reserve** (run\\_loaded) passes now: 2.491" in done.out
    assert "before, it failed at 0.3586" in done.out


# -- how it reads ---------------------------------------------------------------------------------------------------


def test_the_comment_reads_like_a_review(states: Path) -> None:
    """What got worse comes first: with what was written, the numbers, who governs it, and what would mend it."""
    text = diffed("old", "new", "markdown").out
    title, summary, *_ = text.split("\n\n")
    assert title == "## ptmcalc diff"
    assert re.fullmatch(
        r"\*\*2 checks worse, 6 margins moved, \d+ loads changed beyond the error bars, \d+ loads changed within them,"
        r" 1 file invalid, 1 file new, 1 file gone in 4 of 5 files\.\*\*",
        summary,
    )
    assert re.findall("^### (.*)$", text, re.MULTILINE) == [
        "❌ worse.yaml",
        "❌ invalid.yaml",
        "❌ new.yaml",
        "gone.yaml",
    ]
    worse = text.partition("worse.yaml\n\n")[2].partition("\n\n### ")[0]
    changed, turned, *_ = worse.split("\n\n")
    assert changed == "Changed: drive.drum.friction 0.35 → 0.09 (line 23); takeup.tension 30 kN → 28 kN (line 25)."
    assert re.fullmatch(
        r"- ❌ \*\*CNV101 drive pulley traction reserve\*\* \(run\\_loaded\) fails now: 0\.3586, limit ≥ 1\.2;"
        r" before, it passed at 2\.491\. `drive\.drum\.friction` \(line 23\) governs it\."
        r" It passes with `takeup\.tension` = 93\.\d+ kN\.",
        turned.splitlines()[0],
    )
    assert "\n\nThis file is gone.\n" in text
    assert "- new: **error** SPC103, line 1: " in text
    for title in ("Changed margins", "Loads changed beyond their error bars"):
        assert f"<details><summary>{title}</summary>\n\n| " in worse, "tables are opened by who wants to know"
    assert worse.count("|\n\n</details>") == 2
    invalid = text.partition("invalid.yaml\n\n")[2].partition("\n\n### ")[0]
    (gone,) = (line for line in invalid.splitlines() if line.startswith("- ") and " gone: " in line)
    assert re.fullmatch(r"- \d+ checks that passed are gone: CNV101 \(2 times\), CNV102 .*, CNV105 .*\.", gone)


def test_what_got_worse_comes_before_what_else_is_said(states: Path) -> None:
    expired = "waive: [{check: CNV104, reason: tested, until: 2020-01-01}]\n"
    (states / "new" / "worse.yaml").write_text(SMOOTH + expired, encoding="utf-8")
    text = diffed("old/worse.yaml", "new/worse.yaml", "markdown").out
    assert 0 < text.index("fails now") < text.index("- new: **warning**")


def test_names_of_a_file_are_no_markup(states: Path) -> None:
    hostile = SMOOTH.replace("Yard conveyor", "'<img src=x> @all'").replace("{type: run}", "{type: run, name: '|<b>|'}")
    (states / "new" / "worse.yaml").write_text(hostile, encoding="utf-8")
    text = diffed("old/worse.yaml", "new/worse.yaml", "markdown").out
    assert "<img" not in text
    assert "<b>" not in text
    assert "@all" not in text


def test_a_load_of_the_only_drive_is_not_told_twice(states: Path) -> None:
    """In the JSON it is: there a load is a load."""
    done = diffed("old/worse.yaml", "new/worse.yaml")
    assert {"slip_reserve_min", "slip_reserve_min[head]"} <= {row["name"] for row in rows(done, "load")}
    for form in ("table", "markdown"):
        assert "[head]" not in diffed("old/worse.yaml", "new/worse.yaml", form).out.replace("\\", "")


# -- wrong usage ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("nowhere", "new", "there is no `nowhere`"),
        ("old", "nowhere.yaml", "there is no `nowhere.yaml`"),
        ("notes.json", "new", "`notes.json` is not a JSON report of ptmcalc"),
    ],
)
def test_what_cannot_be_compared_is_refused(states: Path, old: str, new: str, said: str) -> None:
    Path("notes.json").write_text("{}", encoding="utf-8")
    done = diffed(old, new)
    assert (done.status, done.out) == (2, "")
    assert said in done.err


# -- the parts ------------------------------------------------------------------------------------------------------


def entry(path: str, verdict: str = "pass", value: float | None = 1.0, bar: float = 0.0) -> dict[str, Any]:
    low, high = (None, None) if value is None else (value - bar, value + bar)
    load = {"name": "force", "value": value, "low": low, "high": high, "unit": "N"}
    scenes = [{"name": "run", "loads": [load], "checks": []}]
    return {"path": path, "verdict": verdict, "scenes": scenes, "diagnostics": []}


@pytest.mark.parametrize(
    ("old", "new", "names"),
    [
        (["a.yaml"], ["b.yaml"], ["b.yaml"]),
        (["s/a.yaml", "s/b.yaml"], ["s/b.yaml", "s/c.yaml"], ["s/a.yaml", "s/b.yaml", "s/c.yaml"]),
        (["x/s/a.yaml", "x/s/in/b.yaml"], ["y/s/a.yaml", "y/s/in/b.yaml"], ["a.yaml", "in/b.yaml"]),
        ([], ["y/a.yaml", "y/b.yaml"], ["a.yaml", "b.yaml"]),
    ],
    ids=str,
)
def test_files_are_paired_by_their_names_behind_what_all_have_in_common(
    old: list[str], new: list[str], names: list[str]
) -> None:
    found = pairs([entry(path) for path in old], [entry(path) for path in new])
    assert [pair.path for pair in found] == names


@pytest.mark.parametrize(
    ("old", "new", "move"),
    [
        ((1.0, 0.0), (1.0, 0.0), None),
        ((1.0, 0.0), (1.0 + 1e-12, 0.0), None),
        ((1.0, 0.1), (1.0, 0.2), Move.BAR),
        ((1.0, 0.1), (1.15, 0.1), Move.WITHIN),
        ((1.0, 0.1), (1.25, 0.1), Move.CLEAR),
        ((1.0, 0.1), (0.75, 0.1), Move.CLEAR),
        ((1.0, 0.0), (1.001, 0.0), Move.CLEAR),
        ((None, 0.0), (1.0, 0.0), Move.WITHIN),
        ((None, 0.0), (None, 0.0), None),
    ],
    ids=str,
)
def test_only_intervals_that_do_not_meet_are_a_clear_change(
    old: tuple[float | None, float], new: tuple[float | None, float], move: Move | None
) -> None:
    (pair,) = pairs([entry("a.yaml", "pass", *old)], [entry("a.yaml", "fail", *new)])
    change = compared(pair)
    assert [one.move for one in change.loads] == ([] if move is None else [move])
    assert change.turn is Turn.WORSE
    assert all(isinstance(one.old, Number) for one in change.loads)
