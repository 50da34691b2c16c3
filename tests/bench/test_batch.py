"""What a file costs in a batch that closed forms decide, stage by stage: gates on counts; the seconds are a study.

`python -m pytest tests/bench/test_batch.py -n 0 -m study -s` prints the table.
"""

import itertools
import json
import os
import random
import resource
import sys
import time
import tracemalloc
from collections.abc import Callable, Iterator, Sequence
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path
from types import FrameType
from typing import Any
from unittest import mock

import pytest
from support.command import ROOT, ptmcalc

from ptmcalc.cli import worker
from ptmcalc.cli.batch import rendered
from ptmcalc.engine.batch import Batch, Keys, fresh
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_text
from ptmcalc.engine.plan import plan
from ptmcalc.engine.run import settle
from ptmcalc.engine.store import Record, Store, packed
from ptmcalc.report import Format
from ptmcalc.report.json import part_of
from ptmcalc.text.document import parse

OPTIONS = Options()
MOST_CALLS = {"YAML": 2_200, "load": 1_450, "plan": 8_600, "run and judge": 11_000, "report": 2_400, "JSON": 2_150}
"""Calls of Python functions for each stage of one file, about one and a half of those there are."""


def variants(number: int) -> list[bytes]:
    """So many of the overland conveyor of the specs, each with a lift and a take-up of its own, and margins that closed
    forms decide."""
    text = (ROOT / "specs" / "conveyor.yaml").read_text("utf-8")
    for old, new in (("4000 N/mm", "9000 N/mm"), ("accuracy: 3 %\n", "")):
        assert old in text
        text = text.replace(old, new)
    draw = random.Random(9)
    return [
        text.replace("lift: 60 m", f"lift: {draw.uniform(30, 60):.4f} m")
        .replace("tension: 230 kN", f"tension: {draw.uniform(500, 600):.4f} kN")
        .encode()
        for _ in range(number)
    ]


def stages(raw: bytes) -> dict[str, Callable[[], Any]]:
    """What is done to one file, each stage with all before it done; YAML is a part of load, plan of run and judge."""
    loaded = load_text(raw, "a.yaml")
    assert loaded.kind is not None
    assert loaded.spec is not None
    kind, spec = loaded.kind, loaded.spec
    report = check(load_text(raw, "a.yaml"), OPTIONS)

    def judged() -> None:
        for scene in plan(kind, spec, None).scenes:
            settle(kind, spec, scene)

    return {
        "YAML": lambda: parse(raw, "a.yaml"),
        "load": lambda: load_text(raw, "a.yaml"),
        "plan": lambda: plan(kind, spec, None),
        "run and judge": judged,
        "report": lambda: check(loaded, OPTIONS),
        "JSON": lambda: part_of(report),
        "store": lambda: packed(report),
        "whole": lambda: worker.with_text([raw], OPTIONS),
    }


PART_OF = {"YAML": None, "load": "YAML", "plan": None, "run and judge": "plan", "report": "run and judge", "JSON": None}
"""The stage that another one contains, whose calls are not counted twice."""


def calls(work: Callable[[], Any]) -> int:
    """How many calls of Python functions a piece of work is."""
    count = 0

    def told(frame: FrameType, event: str, argument: object) -> None:
        nonlocal count
        count += event == "call"

    before = sys.getprofile()
    sys.setprofile(told)
    try:
        work()
    finally:
        sys.setprofile(before)
    return count


def forgetful(work: Callable[[], Any]) -> Callable[[], Any]:
    """The same work from nothing, as a new file has it."""
    from ptmcalc.base.memory import forget

    def done() -> Any:
        forget()
        return work()

    return done


def test_the_variants_are_what_the_target_is_about() -> None:
    """At least 40 keys and 8 checks, different from each other, decided by closed forms."""
    texts = variants(5)
    assert len(set(texts)) == 5
    for raw in texts:
        assert len(parse(raw, "").keys) >= 40
        report = fresh(raw, OPTIONS)
        assert report.verdict == "pass"
        assert sum(1 for _ in report.judgements) >= 8
        assert {solver.fidelity for scene in report.scenes for solver in scene.solvers if solver.decides} == {"formula"}


@pytest.mark.parametrize("stage", MOST_CALLS)
def test_a_stage_makes_no_more_calls_than_it_may(stage: str) -> None:
    (raw,) = variants(1)
    work = stages(raw)
    inner = PART_OF[stage]
    done = calls(forgetful(work[stage])) - (calls(forgetful(work[inner])) if inner else 0)
    assert MOST_CALLS[stage] / 2 < done <= MOST_CALLS[stage], "a cap far above the count says nothing"


def test_a_file_costs_the_same_behind_a_hundred_others() -> None:
    """Nothing that is remembered of other files is searched through."""
    texts = variants(25)
    fresh(texts[0], OPTIONS)
    first = calls(lambda: fresh(texts[1], OPTIONS))
    for raw in texts[2:24]:
        fresh(raw, OPTIONS)
    assert calls(lambda: fresh(texts[24], OPTIONS)) <= 1.1 * first


def files_of(texts: Sequence[bytes], folder: Path) -> list[Path]:
    folder.mkdir()
    for index, raw in enumerate(texts):
        (folder / f"{index:06}.yaml").write_bytes(raw)
    return sorted(folder.iterdir())


def test_memory_grows_with_names_and_keys_only(tmp_path: Path) -> None:
    """Of a thousand files more a batch holds no report, from the reading to the JSON written."""
    (raw,) = variants(1)
    (one,) = worker.with_text([raw], OPTIONS)
    numbers = itertools.count()

    def work(texts: Sequence[bytes], options: Options) -> list[Record]:
        return [one for _ in texts]

    def peak(number: int) -> int:
        texts = [b"kind: conveyor\n# %d\n" % next(numbers) for _ in range(number)]
        files = files_of(texts, tmp_path / str(number))
        with Store() as store, (tmp_path / "out.json").open("w", encoding="utf-8") as out:
            tracemalloc.start()
            batch = Batch(files, OPTIONS, store, work)
            for _ in batch.run(None):
                pass
            out.writelines(rendered(Format.JSON, batch.results(), verbose=False, to_terminal=False))
            used = tracemalloc.get_traced_memory()[1]
            tracemalloc.stop()
        assert len(json.loads((tmp_path / "out.json").read_text("utf-8"))["files"]) == number
        return used

    peak(10)
    grown = (peak(1600) - peak(600)) / 1000
    assert grown < 4_000 < len(one.packed) / 5


def test_a_file_that_did_not_change_is_not_even_parsed(tmp_path: Path) -> None:
    """And its report is not looked at: what stands in the store goes into the JSON as it is."""
    number = 12
    files_of(variants(number), tmp_path / "specs")
    command = ("check", tmp_path / "specs", "--format", "json", "--store", tmp_path / "store")
    first = ptmcalc(*command)
    forbidden = ("engine.batch.load_text", "cli.worker.fresh", "report.json.part_of", "engine.store._adapter")
    for name in forbidden:
        mock.patch(f"ptmcalc.{name}", side_effect=AssertionError(name)).start()
    try:
        again = ptmcalc(*command)
        with redirect_stdout(StringIO()):
            few = calls(lambda: ptmcalc("check", tmp_path / "specs" / "000000.yaml", *command[2:]))
            many = calls(lambda: ptmcalc(*command))
    finally:
        mock.patch.stopall()
    assert (again.status, again.out) == (0, first.out)
    assert 10 < (many - few) / (number - 1) < 80


# -- seconds --------------------------------------------------------------------------------------------------------


def seconds(work: Callable[[], Any], times: int = 15) -> float:
    def once() -> float:
        start = time.process_time()
        work()
        return time.process_time() - start

    return min(once() for _ in range(times))


def runs(folder: Path) -> Iterator[tuple[str, Callable[[], Any]]]:
    common = ("check", folder, "--format", "json")
    with redirect_stdout(StringIO()):
        yield "one process", lambda: ptmcalc(*common, "--jobs", "1")
        yield "two processes", lambda: ptmcalc(*common, "--jobs", "2")
        ptmcalc(*common, "--store", folder.parent / "store", "--jobs", "1")
        yield "unchanged, JSON", lambda: ptmcalc(*common, "--store", folder.parent / "store")


@pytest.mark.study
def test_seconds_of_a_batch(tmp_path: Path) -> None:
    """Processor seconds of the stages of one file, and files a second of a run over many."""
    number = int(os.environ.get("PTMCALC_BATCH", "1000"))
    texts = variants(number)
    worker.with_text(texts[:2], OPTIONS)
    lines = [f"{name:<16} {1e6 * seconds(forgetful(work)):9.0f} us" for name, work in stages(texts[0]).items()]
    path = files_of(texts[:1], tmp_path / "one")[0]
    lines.insert(0, f"{'read':<16} {1e6 * seconds(path.read_bytes):9.0f} us")
    lines.insert(1, f"{'key':<16} {1e6 * seconds(lambda: Keys(OPTIONS).of(texts[0])):9.0f} us")
    files_of(texts, tmp_path / "specs")
    for name, run in runs(tmp_path / "specs"):
        wall, busy = time.perf_counter(), time.process_time()
        assert run().status == 0
        wall, busy = time.perf_counter() - wall, time.process_time() - busy
        rate = f"{number / busy:9.0f} files for each second of the processor here"
        lines.append(f"{name:<16} {number / wall:9.0f} files/s {rate}")
    kept = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print("\n" + "\n".join(lines), f"\nlargest memory   {kept:9.0f} MB", sep="")
