"""What a chunk has done is kept while the rest of it is still worked on."""

import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest
from support.command import report_of_file

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.report import tally
from ptmcalc.engine import keep
from ptmcalc.engine.batch import Keys
from ptmcalc.engine.check import Options, broken
from ptmcalc.engine.keep import Keeper
from ptmcalc.engine.store import Record, Store, packed

REPORT = report_of_file("tests/cli/specs/slipping.yaml")
RECORD = Record(tally(REPORT), packed(REPORT), b'"text": 1')
OPTIONS = Options()


def _holds(store: Store, key: bytes) -> bool:
    return store.get(key) is not None


def until(there: Callable[[], bool], seconds: float = 5.0) -> bool:
    end = time.monotonic() + seconds
    while not there():
        if time.monotonic() > end:
            return False
        time.sleep(0.01)
    return True


def test_a_result_is_kept_within_a_moment_under_the_key_of_its_text(tmp_path: Path) -> None:
    place, keys = tmp_path / "results", Keys(OPTIONS)
    with Store(place) as store, Keeper(str(place), OPTIONS) as keeper:
        for text in (b"one", b"two"):
            keeper.add(text, RECORD)
            key = keys.of(text)
            assert until(partial(_holds, store, key))
        assert len(store) == 2


def test_what_is_back_before_that_costs_no_transaction(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(keep, "MOMENT", 3600.0)
    with Store(tmp_path / "results") as store, Keeper(str(tmp_path / "results"), OPTIONS) as keeper:
        keeper.add(b"one", RECORD)
    with Store(tmp_path / "results") as store:
        assert len(store) == 0


def test_what_our_own_program_broke_down_on_is_not_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(keep, "MOMENT", 0.0)
    bad = broken("a.yaml", "a bug")
    with Store(tmp_path / "results") as store, Keeper(str(tmp_path / "results"), OPTIONS) as keeper:
        keeper.add(b"bad", Record(tally(bad), packed(bad)))
        keeper.add(b"good", RECORD)
        assert until(lambda: len(store) == 1)
        assert store.tallies([Keys(OPTIONS).of(b"good")], "")[Keys(OPTIONS).of(b"good")].counts[Verdict.FAIL] == 1


def test_a_store_that_cannot_be_written_to_is_told_when_the_chunk_is_back(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(keep, "MOMENT", 0.0)
    with Keeper(str(tmp_path / "no" / "where"), OPTIONS) as keeper:
        keeper.add(b"one", RECORD)
    assert list(tmp_path.iterdir()) == []
