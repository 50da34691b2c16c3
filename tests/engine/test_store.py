"""The store of results: what was added is there whole or not at all, and what is damaged counts as absent."""

import shutil
import sqlite3
from dataclasses import replace
from pathlib import Path

import pytest
from support.command import report_of_file

from ptmcalc.base.errors import UsageError
from ptmcalc.contract.report import tally
from ptmcalc.engine.store import Record, Store, packed

REPORT = report_of_file("tests/cli/specs/slipping.yaml")
RECORD = Record(tally(REPORT), packed(REPORT), b'"text": 1', "2026-11-22")


def key(number: int) -> bytes:
    return number.to_bytes(32, "big")


def test_a_report_comes_back_as_it_was(tmp_path: Path) -> None:
    with Store(tmp_path / "results") as store:
        store.add([(key(1), RECORD)])
    with Store(tmp_path / "results") as store:
        found = store.get(key(1))
        assert found is not None
        assert found.report == replace(REPORT, path="")
        assert (found.tally, found.day) == (RECORD.tally, RECORD.day)
        assert store.text(key(1)) == RECORD.text
        assert (store.get(key(2)), store.text(key(2)), len(store)) == (None, b"", 1)


def test_a_result_of_a_day_holds_that_day(tmp_path: Path) -> None:
    with Store(tmp_path / "results") as store:
        store.add([(key(1), RECORD), (key(2), Record(RECORD.tally, RECORD.packed))])
        assert store.tally(key(1), "2026-11-22") == RECORD.tally
        assert store.tally(key(1), "2026-11-23") is None
        assert store.tally(key(2), "2026-11-23") == RECORD.tally


def test_a_process_stopped_amid_a_transaction_leaves_what_was_before(tmp_path: Path) -> None:
    """The file and its journal as they stand on the disk while pages of an unfinished transaction are in the file."""
    with Store(tmp_path / "results") as store:
        store.add([(key(number), RECORD) for number in range(20)])
    other = sqlite3.connect(tmp_path / "results", isolation_level=None)
    other.execute("pragma cache_size = 2")
    other.execute("begin immediate")
    other.execute("update result set day = 'torn', report = zeroblob(9000)")
    assert (tmp_path / "results-journal").stat().st_size > 0
    assert b"torn" in (tmp_path / "results").read_bytes()
    for name in ("results", "results-journal"):
        shutil.copy(tmp_path / name, tmp_path / name.replace("results", "killed"))
    other.close()
    with Store(tmp_path / "killed") as store:
        assert [(name, record) for name, record in store.items()] == [(key(number), RECORD) for number in range(20)]
        store.add([(key(20), RECORD)])
        assert len(store) == 21


@pytest.mark.parametrize("column", ["day", "tally", "report", "checksum", "text", "text_checksum"])
def test_a_damaged_record_counts_as_absent(tmp_path: Path, column: str) -> None:
    with Store(tmp_path / "results") as store:
        store.add([(key(1), RECORD), (key(2), RECORD)])
    harm = {"checksum": "1", "text_checksum": "1", "day": "'2026-11-23'"}
    harm["tally"] = "replace(tally, '\"fail\": 1', '\"fail\": 0')"
    change = harm.get(column, f"cast(x'00' || substr({column}, 2) as blob)")
    with sqlite3.connect(tmp_path / "results") as base:
        base.execute(f"update result set {column} = {change} where key = ?", [key(1)])
    base.close()
    with Store(tmp_path / "results") as store:
        if column in ("text", "text_checksum"):
            assert store.text(key(1)) == b""
        else:
            assert store.get(key(1)) is None
            assert [name for name, _ in store.items()] == [key(2)]
        if column in ("day", "tally"):  # what an exit status is made of, read without the report
            assert (store.tally(key(1), RECORD.day), store.tally(key(1), "2026-11-23")) == (None, None)
            assert store.tallies([key(1), key(2)], RECORD.day) == {key(2): RECORD.tally}
        assert store.text(key(2)) == RECORD.text


def test_a_record_under_the_key_of_another_counts_as_absent(tmp_path: Path) -> None:
    """A damaged index leads to the row of another file, which is whole."""
    with Store(tmp_path / "results") as store:
        store.add([(key(1), RECORD)])
    with sqlite3.connect(tmp_path / "results") as base:
        base.execute("update result set key = ?", [key(2)])
    base.close()
    with Store(tmp_path / "results") as store:
        found = store.get(key(2)), store.tally(key(2), RECORD.day), store.text(key(2)), list(store.items())
        assert found == (None, None, b"", [])


@pytest.mark.parametrize("form", ["cast(x'ff' || tally as text)", "cast(tally as blob)", "3", "''"])
def test_a_tally_of_another_form_counts_as_absent(tmp_path: Path, form: str) -> None:
    with Store(tmp_path / "results") as store:
        store.add([(key(1), RECORD)])
    with sqlite3.connect(tmp_path / "results") as base:
        base.execute(f"update result set tally = {form}")
    base.close()
    with Store(tmp_path / "results") as store:
        assert (store.get(key(1)), store.tally(key(1), RECORD.day)) == (None, None)


@pytest.mark.parametrize("content", [b"kind: conveyor\n" * 100, b"SQLite format 3\0" + b"x" * 5000])
def test_a_file_that_is_no_store_is_refused_and_left_alone(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "results"
    path.write_bytes(content)
    with pytest.raises(UsageError, match="cannot be used as a store"):
        Store(path)
    assert path.read_bytes() == content


def test_the_base_of_another_program_is_refused_and_left_alone(tmp_path: Path) -> None:
    path = tmp_path / "results"
    with sqlite3.connect(path) as base:
        base.execute("create table result (key blob)")
    base.close()
    before = path.read_bytes()
    with pytest.raises(UsageError, match="it holds something else"):
        Store(path)
    assert path.read_bytes() == before


def test_two_processes_may_use_one_store(tmp_path: Path) -> None:
    with Store(tmp_path / "results") as one, Store(tmp_path / "results") as other:
        one.add([(key(1), RECORD)])
        other.add([(key(2), RECORD), (key(1), RECORD)])
        assert len(one) == len(other) == 2


def test_a_store_without_a_name_is_gone_with_its_use() -> None:
    with Store() as store:
        store.add([(key(1), RECORD)])
        assert len(store) == 1
        (_, _, place), *_ = store._base.execute("pragma database_list").fetchall()
        assert place == "", "no folder knows it: nothing stays behind where the process is killed"
