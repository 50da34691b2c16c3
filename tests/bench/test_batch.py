"""What a file costs in a batch that closed forms decide, stage by stage: gates on counts; the seconds are a study.

`python -m pytest tests/bench/test_batch.py -n 0 -m study -s` prints the table.
"""

import gc
import itertools
import json
import os
import random
import resource
import sys
import time
import tracemalloc
from collections import Counter
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
from ptmcalc.engine.batch import Answer, Batch, Keys, fresh
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_text
from ptmcalc.engine.plan import plan
from ptmcalc.engine.run import settle
from ptmcalc.engine.store import Store, packed
from ptmcalc.report import Format
from ptmcalc.report.json import part_of
from ptmcalc.text.document import MAX_BYTES, parse
from ptmcalc.text.source import beginning_of

OPTIONS = Options()
MOST_CALLS = {"YAML": 1_400, "load": 1_750, "plan": 200, "run and judge": 3_400, "report": 670, "JSON": 950}
"""Calls of Python functions for each stage of one file, about a third more than those there are."""


DRAWN = {
    "lift: {} m": ("60", 30, 60),
    "length: {} m": ("1000", 950, 1050),
    "mass: {} kg/m": ("20", 18, 22),
    "stiffness: {} MN": ("138", 130, 140),
    "capacity: {} t/h": ("2880", 2500, 2880),
    "inertia: {} kg*m^2": ("6", 5.5, 6.5),
    "friction: {}": ("0.35", 0.34, 0.40),
    "tension: {} kN": ("230", 500, 600),
}
"""Keys of the variants, in every block: what the spec says, and the range their numbers are drawn from. No two files
have a mass, a length or a stiffness in common, so nothing that is remembered of one serves another."""

SCENES = """\
scenes:
  - {type: run, load: full}
  - {type: run, load: empty}
"""


def variants(number: int) -> list[bytes]:
    """So many of the overland conveyor of the specs, in the scenes that closed forms decide."""
    text = (ROOT / "specs" / "conveyor.yaml").read_text("utf-8")
    for old, new in (("4000 N/mm", "9000 N/mm"), ("accuracy: 3 %\n", "")):
        assert old in text
        text = text.replace(old, new)
    text = text[: text.index("scenes:")] + SCENES
    draw = random.Random(9)
    return [_drawn(text, draw).encode() for _ in range(number)]


def _drawn(text: str, draw: random.Random) -> str:
    for form, (value, low, high) in DRAWN.items():
        assert form.format(value) in text
        text = text.replace(form.format(value), form.format(f"{draw.uniform(low, high):.4f}"))
    return text


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


def test_many_files_leave_nothing_behind() -> None:
    """What is remembered of the last files is as much after seventy of them as after twice as many."""

    def left() -> Counter[str]:
        gc.collect()
        types = (type(one) for one in gc.get_objects())
        return Counter(one.__name__ for one in types if str(one.__module__).startswith("ptmcalc"))

    texts = variants(140)
    worker.with_text(texts[:70], OPTIONS)
    first = left()
    worker.with_text(texts[70:], OPTIONS)
    assert sum(first.values()) > 1000, "they are counted"
    assert sum((left() - first).values()) < 0.01 * sum(first.values())


def files_of(texts: Sequence[bytes], folder: Path) -> list[Path]:
    folder.mkdir()
    for index, raw in enumerate(texts):
        (folder / f"{index:06}.yaml").write_bytes(raw)
    return sorted(folder.iterdir())


def test_memory_grows_with_names_and_keys_only(tmp_path: Path) -> None:
    """Of a thousand files more a batch holds no report, from the reading to the JSON written."""
    (raw,) = variants(1)
    (answer,) = worker.with_text([raw], OPTIONS)
    one = answer.record
    assert one is not None
    numbers = itertools.count()

    def work(texts: Sequence[bytes], options: Options, patience: float) -> list[Answer]:
        return [Answer(0.0, one) for _ in texts]

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
    forbidden = ("engine.batch.load_text", "cli.worker.fresh_within", "report.json.part_of", "engine.store._adapter")
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
    assert 10 < (many - few) / (number - 1) < 100


# -- seconds --------------------------------------------------------------------------------------------------------


def seconds(work: Callable[[], Any], times: int = 15) -> float:
    def once() -> float:
        start = time.process_time()
        work()
        return time.process_time() - start

    return min(once() for _ in range(times))


def table_of_stages(texts: Sequence[bytes]) -> Iterator[str]:
    """Processor seconds and calls of each stage of one file, those it contains taken off."""
    works = [stages(raw) for raw in texts]
    spent = {name: min(seconds(forgetful(one[name]), 3) for one in works) for name in works[0]}
    whole = spent.pop("whole")
    for name, own in spent.items():
        inner = PART_OF.get(name)
        counted = [calls(forgetful(works[0][one])) for one in (name, inner) if one]
        own -= spent[inner] if inner else 0.0
        yield f"{name:<16} {1e6 * own:9.0f} us {own / whole:6.0%} {counted[0] - sum(counted[1:]):7} calls"
    yield f"{'whole':<16} {1e6 * whole:9.0f} us"


@pytest.mark.study
def test_seconds_of_a_batch(tmp_path: Path) -> None:
    """What a file takes stage by stage, and files a second of a run over many, alone, by two, and unchanged."""
    number = int(os.environ.get("PTMCALC_BATCH", "1000"))
    texts = variants(number)
    worker.with_text(texts[:2], OPTIONS)
    path = files_of(texts[:1], tmp_path / "one")[0]
    lines = [
        f"{'read':<16} {1e6 * seconds(lambda: beginning_of(path, MAX_BYTES + 1)):9.1f} us",
        f"{'key':<16} {1e6 * seconds(lambda: Keys(OPTIONS).of(texts[0])):9.1f} us",
        *table_of_stages(texts[:8]),
    ]
    files_of(texts, tmp_path / "specs")
    common = ("check", tmp_path / "specs", "--format", "json", "--jobs")
    kept = ("--store", tmp_path / "store")
    alone, together = (lambda: ptmcalc(*common, "1")), (lambda: ptmcalc(*common, "2"))
    ptmcalc(*common, "1", *kept)
    fastest = dict.fromkeys(("one process", "two processes", "unchanged, JSON"), float("inf"))
    for _ in range(3):  # in turns: whatever else the machine does meets all of them
        for name, run in zip(fastest, (alone, together, lambda: ptmcalc(*common, "1", *kept)), strict=True):
            start = time.perf_counter()
            assert run().status == 0
            fastest[name] = min(fastest[name], time.perf_counter() - start)
    lines += [f"{name:<16} {number / wall:9.0f} files/s" for name, wall in fastest.items()]
    largest = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print("\n" + "\n".join(lines), f"\nlargest memory   {largest:9.0f} MB", sep="")
