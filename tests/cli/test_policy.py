"""Which findings count: chosen by code, known from a baseline; and what the exit status makes of them."""

import json
from pathlib import Path

import pytest
from support.command import Done, ptmcalc

SPECS = Path(__file__).parent / "specs"
SLIPPING, FAULTY, DISAGREEING = SPECS / "slipping.yaml", SPECS / "faulty.yaml", SPECS / "disagreeing.yaml"
"""The first fails CNV101 once, leaves it undecided once and passes six checks."""


def checked(*arguments: str | Path) -> Done:
    return ptmcalc("check", "--no-repairs", "--format", "plain", *arguments)


def last(done: Done) -> str:
    return done.out.splitlines()[-1]


# -- by code --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("options", "status", "summary"),
    [
        ((), 1, "1 file, 6 checks passed, 1 failed, 1 undecided"),
        (("--ignore", "CNV101"), 0, "1 file, 6 checks passed, 2 ignored"),
        (("--select", "CNV101"), 1, "1 file, 0 checks passed, 1 failed, 1 undecided, 6 ignored"),
        (("--select", "cnv102, CNV105"), 0, "1 file, 4 checks passed, 4 ignored"),
        (("--select", "CNV102", "--ignore", "CNV1"), 0, "1 file, 2 checks passed, 6 ignored"),
        (("--select", "CNV1", "--ignore", "CNV101"), 0, "1 file, 6 checks passed, 2 ignored"),
    ],
    ids=str,
)
def test_the_longer_prefix_wins_and_what_is_left_out_is_counted(
    options: tuple[str, ...], status: int, summary: str
) -> None:
    done = checked(SLIPPING, *options)
    assert (done.status, done.err, last(done)) == (status, "", summary)


@pytest.mark.parametrize(
    "options",
    [("--ignore", "CNV"), ("--select", "CNV101", "--ignore", "CNV101"), ("--select", "HST"), ("--select", "NUM")],
    ids=str,
)
def test_a_run_that_checks_nothing_has_not_passed(options: tuple[str, ...]) -> None:
    done = checked(SLIPPING, *options)
    assert (done.status, last(done)) == (3, "1 file, 0 checks passed, 8 ignored")
    assert done.err == "ptmcalc: --select and --ignore exclude all checks; nothing was checked\n"
    (entry,) = json.loads(ptmcalc("check", "--no-repairs", "--format", "json", SLIPPING, *options).out)["files"]
    assert (entry["verdict"], entry["ignored_checks"]) == ("undecided", 8)


def test_a_file_without_a_chosen_check_decides_nothing_beside_others(tmp_path: Path) -> None:
    (tmp_path / "belt.yaml").write_bytes((SPECS / "passing.yaml").read_bytes())
    (tmp_path / "hoist.yaml").write_text(ptmcalc("new", "hoist").out, encoding="utf-8")
    done = checked(tmp_path, "--select", "CNV101")
    assert done.status == 0
    assert done.err == "ptmcalc: 1 file has no check that --select and --ignore leave\n"
    assert checked(tmp_path / "hoist.yaml", "--select", "CNV101").status == 3


def test_only_reading_a_file_leaves_no_check_out() -> None:
    done = checked(SPECS / "passing.yaml", "--validate-only", "--select", "HST")
    assert (done.status, done.err) == (0, "")


@pytest.mark.parametrize("prefix", ["CVN", "CNV999", "", "FRICTION", "CNV101,"])
@pytest.mark.parametrize("option", ["--select", "--ignore"])
def test_a_prefix_no_code_begins_with_is_refused(option: str, prefix: str) -> None:
    """A slip of the pen would make every run green."""
    done = checked(SLIPPING, option, prefix)
    assert (done.status, done.out) == (2, "")
    assert f"{option}: no code begins with `{prefix.split(',')[-1]}`" in done.err


def test_what_makes_a_file_invalid_cannot_be_ignored() -> None:
    done = checked(FAULTY, "--ignore", "SPC", "--ignore", "TXT")
    assert done.status == 2
    assert " error SPC106 " in done.out


def test_an_ignored_warning_does_not_reach_the_level_that_fails() -> None:
    loud, quiet = (checked(DISAGREEING, "--fail-level", "warning", *more) for more in ((), ("--ignore", "SPC201")))
    assert " warning SPC201 " in loud.out
    assert " SPC201 " not in quiet.out
    assert (loud.status, quiet.status) == (1, 0)
    assert last(quiet) == f"{last(loud)}, 1 ignored"


@pytest.mark.parametrize(
    ("file", "status"), [(SLIPPING, 0), (FAULTY, 2), (SPECS / "nowhere.yaml", 2), (SPECS / "without_friction.yaml", 0)]
)
def test_exit_zero_forgives_verdicts_but_no_invalid_file(file: Path, status: int) -> None:
    plain, forgiven = checked(file), checked(file, "--exit-zero")
    assert forgiven.status == status
    assert plain.status != 0
    assert plain.out == forgiven.out


# -- baselines ------------------------------------------------------------------------------------------------------


def written(folder: Path, *options: str) -> Path:
    path = folder / "baseline.json"
    assert checked(folder, "--write-baseline", path, *options).err == ""
    return path


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "one.yaml").write_bytes(SLIPPING.read_bytes())
    (tmp_path / "two.yaml").write_bytes(DISAGREEING.read_bytes())
    return tmp_path


def test_what_is_known_is_waived_and_counted(folder: Path) -> None:
    done = checked(folder, "--write-baseline", folder / "baseline.json")
    assert done.status == 0
    assert last(done).endswith("2 waived, 1 ignored")
    again = checked(folder, "--baseline", folder / "baseline.json", "--fail-level", "warning")
    assert (again.status, again.out, again.err) == (0, done.out, "")
    assert (
        "waived CNV101 drive pulley traction reserve [run_loaded]: 0.4348, limit ≥ 1.2; belt slips at the drive pulley;"
        " fail, known" in done.out
    )


def test_a_baseline_has_files_codes_and_keys_and_the_same_bytes_again(folder: Path) -> None:
    path = written(folder)
    text = path.read_text("utf-8")
    rows = json.loads(text)["findings"]
    names = ("file", "code", "scene", "element", "key", "state")
    assert ("one.yaml", "CNV101", "run_loaded", "", "drive.drum.friction", "fail") in [
        tuple(row[name] for name in names) for row in rows
    ]
    assert [(row["file"], row["code"]) for row in rows if row["state"] == "warning"] == [("two.yaml", "SPC201")]
    assert written(folder).read_text("utf-8") == text


def test_a_baseline_holds_from_another_folder_and_after_edits(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = written(folder)
    one = folder / "one.yaml"
    one.write_text("# moved\n" + one.read_text("utf-8"), encoding="utf-8")
    monkeypatch.chdir(folder)
    assert checked("one.yaml", "--baseline", "baseline.json").status == 0
    assert checked(one, "--baseline", path).status == 0


def test_what_is_new_or_worse_is_not_known(folder: Path) -> None:
    path = written(folder)
    document = json.loads(path.read_text("utf-8"))
    for row in document["findings"]:
        if row["state"] == "fail":
            row["state"] = "undecided"
    path.write_text(json.dumps(document), encoding="utf-8")
    done = checked(folder / "one.yaml", "--baseline", path)
    assert (done.status, last(done)) == (1, "1 file, 6 checks passed, 1 failed, 1 waived")
    assert "worse than in the baseline: 0.4348 then, 0.4348 now" in done.out
    document["findings"] = []
    path.write_text(json.dumps(document), encoding="utf-8")
    assert checked(folder / "one.yaml", "--baseline", path).out == checked(folder / "one.yaml").out


FAULTS = Path(__file__).parents[1] / "edges" / "tools"


def test_a_scene_that_passed_is_not_known_and_a_value_beyond_its_bar_is_new(tmp_path: Path) -> None:
    """Less tension: the sag of the loaded run grows without bound, and six times what is allowed in the empty one,
    which passed. All of it was waived by the same code and key."""
    spec, known = tmp_path / "s.yaml", tmp_path / "b.json"
    spec.write_bytes((FAULTS / "baseline.yaml").read_bytes())
    before = checked(spec, "--write-baseline", known)
    assert (before.status, last(before)) == (0, "1 file, 7 checks passed, 1 waived")
    assert checked(spec, "--baseline", known).out == before.out
    assert "fail, known from the baseline: 2.526 % then, 2.526 % now" in before.out
    spec.write_text(spec.read_text("utf-8").replace("tension: 5 kN", "tension: 4.9 kN"), encoding="utf-8")
    after = checked(spec, "--baseline", known)
    assert after.status == 1, "an exact value has no bar"
    assert "worse than in the baseline: 2.526 % then, 2.594 % now" in after.out
    spec.write_text(spec.read_text("utf-8").replace("tension: 4.9 kN", "tension: 0.5 kN"), encoding="utf-8")
    worst = checked(spec, "--baseline", known)
    assert (worst.status, last(worst)) == (1, "1 file, 3 checks passed, 5 failed")
    assert "unlimited, limit ≤ 1 %; belt sags too much between the idlers; worse than in the baseline" in worst.out
    assert "worse than in the baseline: 2.526 % then, unlimited now" in worst.out


def test_what_is_gone_is_told_unless_it_was_not_looked_for(folder: Path) -> None:
    path = written(folder)
    one = folder / "one.yaml"
    one.write_text(one.read_text("utf-8").replace("friction: 0.", "friction: 0.9 # 0."), encoding="utf-8")
    assert "no longer found" in checked(folder, "--baseline", path).err
    for looked_for in ((folder / "two.yaml",), (folder, "--ignore", "CNV101"), (one, "--scene", "start_empty")):
        assert checked(*looked_for, "--baseline", path).err == ""


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[]",
        "{}",
        "null",
        '{"schema_version": "1"}',
        '{"schema_version": "3", "findings": []}',
        '{"schema_version": "2", "findings": "a"}',
        "\udcff",
        '{"schema_version": "2", "findings": [{"file": "a", "code": "b", "key": "c", "state": "fail"}]}',
        '{"schema_version": "2", "findings": [{"file": "a", "code": "b", "scene": "", "element": "", "state": "off"}]}',
        '{"schema_version": "2", "findings": [{"file": "", "code": "b", "scene": [], "element": "", "state": "fail"}]}',
        '{"schema_version": "2", "findings": [{"file": "a", "code": "b", "scene": "", "element": "", "state": "fail",'
        ' "value": "many"}]}',
    ],
)
def test_a_faulty_baseline_is_wrong_usage(text: str, tmp_path: Path) -> None:
    path = tmp_path / "baseline.json"
    path.write_bytes(text.encode("utf-8", "surrogateescape"))
    done = checked(SLIPPING, "--baseline", path)
    assert (done.status, done.out) == (2, "")
    assert "is not a baseline of ptmcalc" in done.err


def test_a_baseline_of_the_form_before_is_refused_by_name(tmp_path: Path) -> None:
    """It waives by file, code and key: whatever fails in another scene, and however badly."""
    path = tmp_path / "baseline.json"
    row = {"file": "slipping.yaml", "code": "CNV101", "key": "drive.drum.friction", "state": "fail"}
    path.write_text(json.dumps({"schema_version": "1", "findings": [row]}), encoding="utf-8")
    done = checked(SLIPPING, "--baseline", path)
    assert (done.status, done.out) == (2, "")
    assert "has the form of an earlier version" in done.err


def test_a_baseline_that_is_not_there_is_wrong_usage(tmp_path: Path) -> None:
    assert "cannot be read" in checked(SLIPPING, "--baseline", tmp_path / "none.json").err
    assert "cannot write" in checked(SLIPPING, "--write-baseline", tmp_path / "no" / "where.json").err
