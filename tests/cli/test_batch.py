"""Many files: the same report whoever works on them, nothing lost where a run is killed, and nothing done twice."""

import csv
import json
import os
import signal
import sqlite3
import subprocess
import sys
import threading
import time
import tracemalloc
from collections.abc import Sequence
from concurrent.futures import BrokenExecutor, Executor, Future
from dataclasses import replace
from datetime import date
from io import StringIO
from pathlib import Path
from typing import Any
from unittest import mock

import pytest
from rich.console import Console
from support.command import ROOT, Done, environment, ptmcalc

from ptmcalc.cli import processes, worker
from ptmcalc.cli.batch import follow
from ptmcalc.engine import agenda
from ptmcalc.engine import batch as engine
from ptmcalc.engine.batch import Answer, Batch, Keys
from ptmcalc.engine.check import Options
from ptmcalc.engine.store import Store

SPECS = Path(__file__).parent / "specs"
PASSING, SLIPPING = (SPECS / "passing.yaml").read_bytes(), (SPECS / "slipping.yaml").read_bytes()
BROKEN, INVALID = b"kind: [", b"kind: conveyor\nname: nothing else\n"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Twelve files of every verdict, two of them equal; commands are run beside it."""
    specs = tmp_path / "specs"
    (specs / "inner").mkdir(parents=True)
    for index in range(6):
        (specs / f"{index}.yaml").write_bytes(PASSING + b"# %d\n" % index)
        (specs / "inner" / f"{index}.yaml").write_bytes((SLIPPING, BROKEN, INVALID)[index % 3] + b"# %d\n" % index)
    (specs / "inner" / "3.yaml").write_bytes(SLIPPING + b"# 0\n")
    monkeypatch.chdir(tmp_path)
    return specs


def checked(*arguments: str | Path, form: str = "json") -> Done:
    return ptmcalc("check", "specs", "--no-repairs", "--format", form, *arguments)


def document(done: Done) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(done.out)
    return found


# -- the same report ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("form", ["json", "plain", "table", "junit", "sarif", "github", "markdown", "summary", "csv"])
def test_every_format_is_the_same_one_by_one_in_a_batch_and_from_the_store(folder: Path, form: str) -> None:
    with mock.patch("ptmcalc.cli.batch.FEW", 100):
        alone = checked(form=form)
    batch = checked(form=form)
    first, again = (checked("--store", "results", form=form) for _ in range(2))
    assert alone.status == batch.status == first.status == again.status == 2
    assert alone.out == batch.out == first.out == again.out
    assert (alone.err, batch.err) == ("", "")
    assert first.err == "ptmcalc: 1 of 12 files known from `results`\n"
    assert again.err == "ptmcalc: 12 of 12 files known from `results`\n"


def test_who_has_others_work_plans_nothing(folder: Path) -> None:
    """Every file goes out as it is: to load or to plan one first would keep the workers waiting."""
    alone = checked("--jobs", "1")
    with mock.patch("ptmcalc.engine.batch.load_text", side_effect=AssertionError("it is planned before it goes out")):
        assert checked("--jobs", "2") == alone


@pytest.mark.parametrize("jobs", ["auto", "2"])
def test_a_long_file_comes_back_and_is_done_on_its_own(folder: Path, jobs: str) -> None:
    """Whoever gets it first leaves it; the bytes are the same, and it counts once."""
    alone, out = checked("--jobs", "1"), StringIO()
    with mock.patch.object(agenda, "CHUNK", 0.0):
        assert checked("--jobs", jobs) == alone
        with Store() as store:
            batch = Batch(sorted(folder.rglob("*.yaml")), Options(repairs=False), store, worker.without_text)
            follow(batch, batch.run(Here, 2), Console(file=out, force_terminal=True, width=100))
    assert "12 of 12 files" in out.getvalue()


def test_reports_are_kept_only_where_somebody_may_ask_for_them(folder: Path) -> None:
    """Not beside JSON alone; another format, a policy or a store needs them."""
    with mock.patch("ptmcalc.cli.batch.FEW", 100):
        alone = checked()
    with mock.patch("ptmcalc.engine.batch.packed", side_effect=AssertionError):
        assert checked() == alone
        for more in (("-o", "junit=out.xml"), ("--ignore", "CNV101"), ("--store", "results")):
            assert checked(*more).status == 4
    assert checked("-o", "junit=out.xml") == alone


def test_policies_count_in_a_batch_as_they_do_one_by_one(folder: Path) -> None:
    options = ("--ignore", "CNV101", "--exclude", "inner/1.yaml", "--exit-zero")
    with mock.patch("ptmcalc.cli.batch.FEW", 100):
        alone = checked(*options)
    assert checked(*options) == checked(*options, "--jobs", "1") == alone
    assert document(alone)["summary"]["ignored"] > 0
    assert "1 design file is left out" in alone.err


def test_a_store_is_of_use_to_every_format_and_policy(folder: Path) -> None:
    """A first run that asks for no JSON leaves a second one that does nothing to compute."""
    checked("--store", "results", form="plain")
    with mock.patch("ptmcalc.cli.worker.fresh_within", side_effect=AssertionError("it is known")):
        found = checked("--store", "results", "--ignore", "CNV101")
    assert found.out == checked("--ignore", "CNV101").out


# -- what is known --------------------------------------------------------------------------------------------------


def test_only_what_changed_is_done_again(folder: Path) -> None:
    first = document(checked("--store", "results"))
    (folder / "0.yaml").write_bytes(SLIPPING)
    (folder / "new.yaml").write_bytes(PASSING + b"# 1\n")
    os.utime(folder / "1.yaml", (0, 0))
    done = checked("--store", "results")
    assert done.err == "ptmcalc: 12 of 13 files known from `results`\n"
    found = {entry.pop("path"): entry for entry in document(done)["files"]}
    for entry in first["files"]:
        path = entry.pop("path")
        assert (found[path] == entry) is (path != "specs/0.yaml")
    assert found["specs/new.yaml"] == found["specs/1.yaml"], "by its content, wherever it lies"


@pytest.mark.parametrize(
    "options",
    [
        Options(("run",)),
        Options(accuracy="1 %"),
        Options(effects={"sag": "off"}),
        Options(budget=1.0),
        Options(histories=True),
        Options(figures=True),
        Options(repairs=False),
    ],
    ids=str,
)
def test_a_key_depends_on_every_option_and_on_the_program(options: Options) -> None:
    plain = Keys(Options()).of(PASSING)
    assert Keys(options).of(PASSING) != plain
    assert Keys(Options()).of(PASSING + b" ") != plain
    assert Keys(Options()).of(PASSING) == plain
    with mock.patch.object(engine, "edition", return_value=b"another program"):
        assert Keys(Options()).of(PASSING) != plain


def test_a_waiver_is_held_against_the_day_it_is_read(folder: Path) -> None:
    waiver = b"waive: [{check: CNV101, reason: being mended, until: 2026-06-30}]\n"
    (folder / "0.yaml").write_bytes(SLIPPING + waiver)
    day = "ptmcalc.engine.batch.Batch.today"
    from datetime import date

    verdicts = []
    for today in (date(2026, 6, 30), date(2026, 7, 1), date(2026, 7, 1)):
        with Store(folder.parent / "results") as store:
            options = Options(repairs=False, today=today)
            batch = Batch([folder / "0.yaml", folder / "1.yaml"], options, store, worker.with_text)
            missing = batch.missing
            list(batch.run(None))
            verdicts.append((batch.results()[0].verdict, missing))
    assert verdicts == [("pass", 2), ("fail", 1), ("fail", 0)], day


def test_a_damaged_record_is_made_again(folder: Path) -> None:
    sound = checked("--store", "results")
    with sqlite3.connect("results") as base:
        base.execute("update result set report = zeroblob(10), text = zeroblob(10)")
    base.close()
    again = checked("--store", "results")
    assert (again.status, again.out) == (sound.status, sound.out)


def test_a_store_that_is_none_is_wrong_usage(folder: Path) -> None:
    Path("results").write_text("notes of mine", encoding="utf-8")
    done = checked("--store", "results")
    assert (done.status, done.out) == (2, "")
    assert "`results` cannot be used as a store" in done.err
    assert Path("results").read_text("utf-8") == "notes of mine"


def test_a_file_is_kept_while_a_slow_one_of_its_chunk_is_worked_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    slow, place = threading.Event(), tmp_path / "results"

    def fresh(raw: bytes, options: Options, patience: float) -> Any:
        if b"slow" in raw:
            slow.wait(10)
        return engine.fresh_within(raw, options, patience)

    monkeypatch.setattr(worker, "fresh_within", fresh)
    texts = [PASSING, PASSING + b"# slow\n"]
    options = Options(repairs=False)
    with Store(place) as store:
        work = threading.Thread(target=worker.with_text, args=(texts, options), kwargs={"place": str(place)})
        work.start()
        end = time.monotonic() + 10
        while not len(store) and time.monotonic() < end:
            time.sleep(0.02)
        known = store.tallies([Keys(options).of(text) for text in texts], "")
        assert (len(known), work.is_alive()) == (1, True)
        slow.set()
        work.join()


def test_no_damaged_byte_of_a_store_changes_a_report(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It is made again, or the store is refused; never a pass of what fails."""
    monkeypatch.chdir(tmp_path)
    Path("a.yaml").write_bytes(SLIPPING)
    command = ("check", "a.yaml", "--no-repairs", "--format", "plain", "--store", "kept")
    good = ptmcalc(*command)
    whole = Path("kept").read_bytes()
    tally = whole.index(b'"counts"')
    places = [*range(tally - 60, tally + 200, 4), *range(0, len(whole), len(whole) // 40)]
    for place in places:
        Path("kept").write_bytes(whole[:place] + bytes([whole[place] ^ 1]) + whole[place + 1 :])
        Path("kept-journal").unlink(missing_ok=True)
        done = ptmcalc(*command)
        refused = done.status == 2 and "cannot be used as a store" in done.err
        assert refused or (done.status, done.out) == (good.status, good.out)


# -- shards ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("number", [1, 3])
def test_the_reports_of_the_shards_make_the_report_of_the_whole(folder: Path, number: int) -> None:
    whole = checked("--ignore", "CNV103")
    for index in range(1, number + 1):
        checked("--ignore", "CNV103", "--shard", f"{index}/{number}", "-o", f"json={index}.json")
    parts = [f"{index}.json" for index in range(1, number + 1)]
    done = ptmcalc("merge", *reversed(parts))
    assert (done.status, done.err) == (2, "")
    assert done.out == whole.out
    assert ptmcalc("merge", *parts, "-o", "all.json") == Done(2, "", "")
    assert Path("all.json").read_text("utf-8") == whole.out


def test_the_stores_of_the_shards_make_the_store_of_the_whole(folder: Path) -> None:
    for index in (1, 2):
        checked("--shard", f"{index}/2", "--store", f"{index}.store")
    assert ptmcalc("merge", "1.store", "2.store", "-o", "all.store") == Done(0, "", "")
    done = checked("--store", "all.store")
    assert done.err == "ptmcalc: 12 of 12 files known from `all.store`\n"
    assert done.out == checked().out


def test_what_cannot_be_merged_is_refused(folder: Path) -> None:
    checked("--store", "a.store", "-o", "json=a.json")
    text = Path("a.json").read_text("utf-8")
    Path("b.json").write_text(text.replace("Yard conveyor", "Another one"), encoding="utf-8")
    Path("c.json").write_text('{"files": []}', encoding="utf-8")
    for parts, reason in (
        (("a.json", "b.json"), "`specs/0.yaml` is in `a.json` and in `b.json`"),
        (("a.json", "a.json"), "`a.json` is named twice"),
        (("a.json", "./a.json"), "`a.json` is named twice"),
        (("a.json", "c.json"), "`c.json` is not a JSON report of ptmcalc"),
        (("a.json", "nowhere.json"), "the report `nowhere.json` cannot be read"),
        (("a.json", "a.store"), "stores and reports do not mix"),
        (("a.store",), "a store is not printed"),
    ):
        done = ptmcalc("merge", *parts)
        assert (done.status, done.out) == (2, "")
        assert reason in done.err


WARNED = ("--scene", "run_loaded", "--fail-level", "warning")


@pytest.fixture(scope="module")
def reports_of_shards(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, str], Done]:
    """The reports of both shards of a run over files that pass and files with warnings, and of a third of three; the
    folder of the run, and what it prints as a whole."""
    place = tmp_path_factory.mktemp("shards")
    (place / "specs" / "inner").mkdir(parents=True)
    for index in range(6):
        (place / "specs" / f"{index}.yaml").write_bytes(PASSING + b"# %d\n" % index)
    for index in range(3):
        (place / "specs" / "inner" / f"{index}.yaml").write_bytes((SPECS / "disagreeing.yaml").read_bytes())
    found = {}
    with pytest.MonkeyPatch.context() as here:
        here.chdir(place)
        for shard in ("1/2", "2/2", "3/3"):
            found[f"{shard.replace('/', 'of')}.json"] = checked("--shard", shard, *WARNED).out
        return place, found, checked(*WARNED)


@pytest.fixture
def parts(
    reports_of_shards: tuple[Path, dict[str, str], Done], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> dict[str, dict[str, Any]]:
    """Those reports, to be changed."""
    monkeypatch.chdir(tmp_path)
    return {name: json.loads(text) for name, text in reports_of_shards[1].items()}


def merged(parts: dict[str, dict[str, Any]], *names: str) -> Done:
    for name, document in parts.items():
        Path(name).write_text(json.dumps(document), encoding="utf-8")
    return ptmcalc("merge", *(names or ("1of2.json", "2of2.json")))


def test_the_level_that_fails_is_that_of_the_parts(
    parts: dict[str, dict[str, Any]], reports_of_shards: tuple[Path, dict[str, str], Done]
) -> None:
    whole = reports_of_shards[2]
    done = merged(parts)
    assert (done.status, done.out) == (whole.status, whole.out) == (1, whole.out)
    for part in parts.values():
        part["run"]["fail_level"] = "error"
    assert merged(parts).status == 0
    parts["1of2.json"]["run"]["fail_level"] = "note"
    done = merged(parts)
    assert (done.status, done.out) == (2, "")
    assert "`2of2.json` has --fail-level error, `1of2.json` has note" in done.err


@pytest.mark.parametrize(
    ("names", "reason"),
    [
        (("1of2.json",), "part 2/2 of the run is missing"),
        (("2of2.json",), "part 1/2 of the run is missing"),
        (("3of3.json",), "parts 1/3, 2/3 of the run are missing"),
        (("1of2.json", "2of2.json", "3of3.json"), "parts of different runs"),
        (("1of2.json", "2of2.json", "1of2.json"), "`1of2.json` is named twice"),
    ],
)
def test_a_part_that_is_missing_or_doubled_is_refused(
    parts: dict[str, dict[str, Any]], names: tuple[str, ...], reason: str
) -> None:
    done = merged(parts, *names)
    assert (done.status, done.out, done.err.count("\n")) == (2, "", 1)
    assert reason in done.err
    parts["copy.json"] = parts["1of2.json"]
    assert "`1of2.json` and `copy.json` are both part 1/2" in merged(parts, "1of2.json", "copy.json", "2of2.json").err


def test_a_part_without_one_of_its_files_is_refused(parts: dict[str, dict[str, Any]]) -> None:
    part = parts["1of2.json"]
    gone = part["files"].pop(0)
    counts = [check["verdict"] for scene in gone["scenes"] for check in scene["checks"]]
    part["summary"]["files"] -= 1
    part["summary"]["pass"] -= counts.count("pass")
    assert counts.count("pass") == len(counts)
    assert "all parts together: 8 files of a run over 9" in merged(parts).err
    parts["2of2.json"]["run"]["files"] = 8
    assert "`2of2.json` is part of a run over 8 files, `1of2.json` of one over 9" in merged(parts).err


def test_a_part_of_an_interrupted_run_is_refused(parts: dict[str, dict[str, Any]]) -> None:
    parts["2of2.json"]["run"]["complete"] = False
    assert "the run of `2of2.json` was interrupted" in merged(parts).err


def _set(*path: Any, to: Any) -> Any:
    def change(document: dict[str, Any]) -> None:
        *way, last = path
        inner: Any = document
        for key in way:
            inner = inner[key]
        inner[last] = to

    return change


_FILE = ("files", 0)
_CHECK = (*_FILE, "scenes", 0, "checks", 0)


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        (_set(*_FILE, "verdict", to="undecided"), "is called `undecided`, and by its checks is `pass`"),
        (_set(*_CHECK, "verdict", to="fail"), "is called `pass`, and by its checks is `fail`"),
        (_set(*_CHECK, "value", to=-1e9), "is called `pass`, with its value beyond the limit"),
        (_set("summary", "pass", to=99), "the summary counts 99 of `pass`"),
        (_set("summary", to={}), "the summary counts None of `files`"),
        (_set("run", to=None), "does not state which part of a run it is"),
        (_set("run", "shard", to="2/1"), "does not state which part of a run it is"),
        (_set("run", "shard", to="a/b"), "does not state which part of a run it is"),
        (_set("run", "shard", to=[]), "does not state which part of a run it is"),
        (_set("run", "fail_level", to="all"), "does not state which part of a run it is"),
        (_set("run", "more", to=1), "does not state which part of a run it is"),
        (_set(*_FILE, "verdict", to="good"), "is not a JSON report of ptmcalc"),
        (_set(*_FILE, "verdict", to=[]), "is not a JSON report of ptmcalc"),
        (_set(*_FILE, "path", to=3), "is not a JSON report of ptmcalc"),
        (_set(*_FILE, "scenes", to=None), "is not a JSON report of ptmcalc"),
        (_set(*_FILE, "scenes", to={"a": 1}), "is not a JSON report of ptmcalc"),
        (_set(*_FILE, "scenes", 0, "checks", to=3), "is not a JSON report of ptmcalc"),
        (_set(*_FILE, "ignored", to="many"), "is not a JSON report of ptmcalc"),
        (_set(*_FILE, "ignored", to=-1), "is not a JSON report of ptmcalc"),
        (_set(*_CHECK, "verdict", to={}), "is not a JSON report of ptmcalc"),
        (_set(*_CHECK, "value", to="9"), "is not a JSON report of ptmcalc"),
        (_set(*_CHECK, "value", to=float("nan")), "is not a JSON report of ptmcalc"),
        (_set(*_FILE, "diagnostics", to=[{}]), "is not a JSON report of ptmcalc"),
        (_set(*_FILE, to=None), "is not a JSON report of ptmcalc"),
        (_set("files", to=7), "is not a JSON report of ptmcalc"),
        (_set("tool", to="ptmcalc"), "is not a JSON report of ptmcalc"),
    ],
)
def test_a_part_that_contradicts_itself_or_is_malformed_is_refused(
    parts: dict[str, dict[str, Any]], change: Any, reason: str
) -> None:
    change(parts["1of2.json"])
    done = merged(parts)
    assert (done.status, done.out, done.err.count("\n")) == (2, "", 1)
    assert reason in done.err


def test_a_shard_without_a_file_has_checked_nothing(folder: Path) -> None:
    done = checked("--shard", "13/13")
    assert (done.status, document(done)["files"]) == (3, [])
    assert done.err == "ptmcalc: part 13/13 of the run holds no file: it has 12 files; nothing was checked\n"
    assert checked("--shard", "13/13", "--exit-zero").status == 0


def test_a_list_without_a_name_has_checked_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdin", StringIO("\n"))
    done = ptmcalc("check", "-", "--format", "plain")
    assert (done.status, done.err) == (3, "ptmcalc: the list names no file; nothing was checked\n")


def test_what_gitignore_hides_is_told_and_counted(folder: Path) -> None:
    (folder / ".gitignore").write_text("*.yaml\n", encoding="utf-8")
    done = checked()
    assert done.status == 2
    assert "12 design files are left out by --exclude or .gitignore" in done.err
    assert document(done)["run"]["left_out"] == 12
    assert "the folder holds no design file; 12 are left out" in done.out


# -- what goes wrong ------------------------------------------------------------------------------------------------


def work_with_accidents(texts: Sequence[bytes], options: Options, patience: float) -> list[Answer]:
    """The work of a process that a certain text kills."""
    if any(b"deadly" in text for text in texts):
        os.kill(os.getpid(), signal.SIGKILL)
    return worker.with_text(texts, options, patience)


def test_a_file_that_kills_its_worker_is_told_and_stops_no_other(folder: Path) -> None:
    (folder / "2.yaml").write_bytes(PASSING + b"# deadly\n")
    files = sorted(folder.rglob("*.yaml"))
    with Store() as store, mock.patch.object(agenda, "MOST_IN_CHUNK", 4):
        batch = Batch(files, Options(repairs=False), store, work_with_accidents)
        steps = list(batch.run(processes.pool(2, batch.kinds), 2))
        found = {report.path: report for report in batch.results()}
    assert sum(count for count, _ in steps) == 11, "one of two equal files is done"
    broken = [path for path, report in found.items() if any(d.code == "BUG101" for d in report.diagnostics)]
    assert broken == [(folder / "2.yaml").as_posix()]
    assert list(found) == [path.as_posix() for path in files]
    assert all(found[path.as_posix()].verdict == "pass" for path in sorted(folder.glob("[013-5].yaml")))


@pytest.mark.parametrize("jobs", [1, 2])
def test_a_file_that_vanishes_before_its_turn_is_told_and_stops_no_other(folder: Path, jobs: int) -> None:
    files = sorted(folder.glob("*.yaml"))
    with Store() as store:
        batch = Batch(files, Options(repairs=False), store, worker.with_text)
        (folder / "3.yaml").unlink()
        steps = list(batch.run(Here if jobs > 1 else None, jobs))
        verdicts = [report.verdict for report in batch.results()]
    assert sum(count for count, _ in steps) == 5
    assert verdicts == ["pass"] * 3 + ["invalid"] + ["pass"] * 2


def test_where_no_process_can_be_started_the_work_is_done_here(folder: Path) -> None:
    files = sorted(folder.glob("*.yaml"))
    with Store() as store:
        batch = Batch(files, Options(repairs=False), store, worker.with_text)
        list(batch.run(lambda: Slow(-1), 2))
        assert [report.verdict for report in batch.results()] == ["pass"] * 6


@pytest.mark.parametrize("options", [(), ("--jobs", "1", "--store", "results")], ids=["one by one", "batch"])
def test_a_bug_on_one_file_stops_no_other_and_is_not_kept(
    folder: Path, options: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("PTMCALC_TRACEBACK", raising=False)
    good = checked(*options)

    def settled(*arguments: Any, **more: Any) -> Any:
        raise ZeroDivisionError("division by zero")

    with mock.patch("ptmcalc.engine.purse.settle", settled), mock.patch("ptmcalc.cli.batch.FEW", 100):
        done = checked(*options, "--budget", "50 s")
        assert done.status == 4
        said = [(entry["verdict"], [one["code"] for one in entry["diagnostics"]]) for entry in document(done)["files"]]
        assert said.count(("invalid", ["BUG101"])) == 8
        assert len(said) == 12
    assert checked(*options).out == good.out
    assert checked(*options, "--budget", "50 s").status == 2, "what was broken is tried again"


@pytest.mark.parametrize("options", [(), ("--jobs", "1", "--store", "results")], ids=["one by one", "batch"])
def test_a_file_beyond_the_memory_is_undecided_and_no_bug(
    folder: Path, options: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("PTMCALC_TRACEBACK", raising=False)
    with mock.patch("ptmcalc.engine.purse.settle", side_effect=MemoryError):
        done = ptmcalc("check", "specs/0.yaml", "--format", "json", *options)
        several = ptmcalc("check", "specs/0.yaml", "specs/1.yaml", "--format", "json", *options)
    assert (done.status, several.status) == (3, 3)
    entries = document(done)["files"] + document(several)["files"]
    assert [(entry["verdict"], entry["diagnostics"][0]["code"]) for entry in entries] == [("undecided", "NUM103")] * 3
    with_memory = ptmcalc("check", "specs/0.yaml", "specs/1.yaml", "--format", "json", *options)
    assert (with_memory.status, with_memory.out.count("NUM103")) == (0, 0), "it is no result to keep"


class Slow(Executor):
    """An executor that is interrupted when a certain number of chunks is done."""

    def __init__(self, most: int) -> None:
        self.left = most

    def submit(self, work: Any, /, *arguments: Any, **more: Any) -> Future[Any]:  # type: ignore[override]
        future: Future[Any] = Future()
        if self.left < 0:
            future.set_exception(BrokenExecutor("gone"))
        elif self.left == 0:
            raise KeyboardInterrupt
        else:
            future.set_result(work(*arguments, **more))
        self.left -= 1
        return future


class Here(Executor):
    """An executor that works at once, and in this process."""

    def submit(self, work: Any, /, *arguments: Any, **more: Any) -> Future[Any]:  # type: ignore[override]
        future: Future[Any] = Future()
        future.set_result(work(*arguments, **more))
        return future


def test_an_interrupt_keeps_and_prints_what_is_done(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(agenda, "MOST_IN_CHUNK", 1)
    monkeypatch.setattr(processes, "pool", lambda jobs, kinds: lambda: Slow(5))
    done = checked("--jobs", "2", "--store", "results", "-o", "json=report.json")
    assert done.status == 130
    assert "ptmcalc: interrupted after " in done.err
    assert not Path("report.json").exists(), "a report that is not whole replaces none"
    printed = document(done)["files"]
    with Store(Path("results")) as store:
        kept = len(store)
    assert 1 < kept <= len(printed) < 12
    whole = checked()
    assert all(entry in document(whole)["files"] for entry in printed)
    monkeypatch.undo()
    monkeypatch.chdir(folder.parent)
    assert checked("--store", "results").out == whole.out


@pytest.mark.parametrize("text", ["0", "-1", "many", "", "1.5", "9999"])
def test_what_is_no_number_of_processes_is_refused(folder: Path, text: str) -> None:
    done = checked(f"--jobs={text}")
    assert (done.status, done.out) == (2, "")
    assert "is not a number of processes" in done.err


def test_names_come_from_standard_input(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for text in ("specs/1.yaml\nspecs/0.yaml\n", "specs/1.yaml\0specs/0.yaml\0"):
        monkeypatch.setattr(sys, "stdin", StringIO(text))
        found = document(ptmcalc("check", "-", "--format", "json"))
        assert [entry["path"] for entry in found["files"]] == ["specs/1.yaml", "specs/0.yaml"]


# -- what is seen ---------------------------------------------------------------------------------------------------


def test_progress_counts_predicted_seconds(folder: Path) -> None:
    with Store() as store:
        batch = Batch(sorted(folder.rglob("*.yaml")), Options(repairs=False), store, worker.without_text)
        assert batch.missing == 11
        out = StringIO()
        steps = list(batch.run(None))
        follow(batch, iter(steps), Console(file=out, force_terminal=True, width=100))
        assert sum(seconds for _, seconds in steps) == pytest.approx(batch.expected)
    assert "12 of 12 files" in out.getvalue()


def test_the_csv_has_a_line_for_every_verdict_and_every_fault(folder: Path) -> None:
    found = document(checked())
    rows = list(csv.DictReader(StringIO(checked(form="csv").out)))
    verdicts = [
        (entry["path"], check["code"], scene["name"], check["verdict"], check["value"])
        for entry in found["files"]
        for scene in entry["scenes"]
        for check in scene["checks"]
    ]
    told = [row for row in rows if row["verdict"] != "invalid"]
    assert sorted((r["file"], r["code"], r["scene"], r["verdict"], float(r["value"])) for r in told) == sorted(verdicts)
    faults = [(e["path"], d["code"]) for e in found["files"] if e["verdict"] == "invalid" for d in e["diagnostics"]]
    assert [(row["file"], row["code"]) for row in rows if row["verdict"] == "invalid"] == faults
    governing = [row["file"] for row in rows if row["governs"]]
    assert governing == [entry["path"] for entry in found["files"] if entry["scenes"]]


# -- memory ---------------------------------------------------------------------------------------------------------


def test_of_a_file_that_is_done_a_batch_keeps_no_more_than_its_name_and_key(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Names and keys are needed to the end, for the order and the exit status; they are there before the first file is
    done. Of 40 KB that are found out about each of 1000 files nothing stays."""
    monkeypatch.setattr(agenda, "MOST_IN_CHUNK", 50)
    files = [tmp_path / f"{index:04}.yaml" for index in range(1000)]
    for index, path in enumerate(files):
        path.write_bytes(b"# %d\n" % index)
    said = engine.record_of(engine.fresh(INVALID, Options()), INVALID, date(2026, 1, 1))

    def work(raws: Sequence[bytes], options: Options, patience: float) -> list[Answer]:
        return [Answer(0.0, replace(said, text=raw * (40_000 // len(raw)))) for raw in raws]

    held: list[int] = []
    tracemalloc.start()
    try:
        before = tracemalloc.get_traced_memory()[0]
        with Store() as store:
            batch = Batch(files, Options(), store, work)
            planned = tracemalloc.get_traced_memory()[0] - before
            held += [tracemalloc.get_traced_memory()[0] for _ in batch.run(None)]
            results = batch.results()
            assert (len(store), len(results), len(results.tallies())) == (1000, 1000, 1000)
            assert len({id(one) for one in results.tallies()}) == 1, "equal tallies are one"
    finally:
        tracemalloc.stop()
    assert len(held) >= 20
    assert planned / 1000 < 1000
    assert (max(held[10:]) - held[1]) / 1000 < 100


# -- kill -9 --------------------------------------------------------------------------------------------------------

DRIVER = """
import os, signal, sys
from ptmcalc.engine import agenda
from ptmcalc.engine.store import Store
from ptmcalc.cli.main import main

add = Store.add
agenda.MOST_IN_CHUNK = 1

def kill(statement):
    if statement == "commit":
        os.kill(os.getpid(), signal.SIGKILL)

def counted(self, records):
    global left
    left -= 1
    if left == 0:
        self._base.set_trace_callback(kill)
    add(self, records)

if __name__ == "__main__":
    left = int(sys.argv.pop(1))
    Store.add = counted
    main()
"""
"""The command, which dies between the writing of a record and its commit, the so-and-so-manieth; 0 never."""
MANY = 12


@pytest.fixture
def many(tmp_path: Path) -> Path:
    specs = tmp_path / "specs"
    specs.mkdir()
    for index in range(MANY):
        (specs / f"{index:02}.yaml").write_bytes(
            PASSING.replace(b"18 m", b"%d m" % (10 + index % 9)) + b"# %d\n" % index
        )
    (tmp_path / "driver.py").write_text(DRIVER, encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_a_run_that_is_killed_twice_and_finished_has_every_result_once(many: Path, jobs: str) -> None:
    """kill -9 amid the writing of a record, again, then to the end. A run comes back only when its workers let go of
    its streams: none outlives it."""

    passing = many / "passing"
    passing.mkdir()

    def run(kill: int, *options: str) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "driver.py", str(kill), "check", "specs", "--format", "json", *options]
        env = environment(ROOT, TMPDIR=str(passing))
        return subprocess.run(command, cwd=many, env=env, capture_output=True, text=True, check=False)

    options, before = ("--jobs", jobs, "--store", "results"), 0
    for kill in (3, 5):
        assert run(kill, *options).returncode == -signal.SIGKILL
        with Store(many / "results") as store:
            assert len(store) == before + kill - 1
            before = len(store)
            assert all(record.report.kind == "conveyor" for _, record in store.items())
    done, fresh = run(0, *options), run(0, "--jobs", "1")
    assert (done.returncode, fresh.returncode) == (0, 0)
    assert done.stderr == f"ptmcalc: {before} of {MANY} files known from `results`\n", "it is not done again"
    assert done.stdout == fresh.stdout
    assert [file["path"] for file in json.loads(done.stdout)["files"]] == [f"specs/{i:02}.yaml" for i in range(MANY)]
    base = sqlite3.connect(many / "results")
    assert base.execute("pragma integrity_check").fetchall() == [("ok",)]
    assert base.execute("select count(*), count(distinct key) from result").fetchone() == (MANY, MANY)
    base.close()
    assert run(3, "--jobs", jobs).returncode == -signal.SIGKILL
    assert list(passing.iterdir()) == [], "a run that is killed leaves nothing behind, with a store or without"
