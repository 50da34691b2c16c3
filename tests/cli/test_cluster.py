"""A cluster: the bytes of a serial run whatever happens to its workers, and nothing lost where its scheduler goes.

A real scheduler and real workers, as processes on the loopback.
"""

import json
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import BrokenExecutor, Executor, Future
from contextlib import suppress
from itertools import chain, repeat
from pathlib import Path
from typing import Any
from unittest import mock

import pytest
from support.cluster import Cluster, cluster
from support.command import ROOT, Done, environment, ptmcalc

from ptmcalc.base.errors import UsageError
from ptmcalc.cli import cluster as ours
from ptmcalc.cli import worker
from ptmcalc.engine.batch import Answer, Batch, GoneError, LostError
from ptmcalc.engine.check import Options
from ptmcalc.engine.store import Record, Store

PASSING = (Path(__file__).parent / "specs" / "passing.yaml").read_bytes()
MANY = 500


@pytest.fixture(scope="module")
def two_workers(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Cluster]:
    with cluster(tmp_path_factory.mktemp("cluster"), 2) as found:
        yield found


@pytest.fixture
def specs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[int], None]:
    """Writes so many variants of a conveyor, each decided by closed forms; every hundredth is no file of ours."""
    monkeypatch.chdir(tmp_path)

    def write(number: int) -> None:
        folder = tmp_path / "specs"
        folder.mkdir()
        for index in range(number):
            text = PASSING.replace(b"18 m", b"%d m" % (10 + index % 9)) + b"# %d\n" % index
            (folder / f"{index:03}.yaml").write_bytes(text if index % 100 != 99 else b"kind: [ # %d" % index)

    return write


def checked(*options: str) -> Done:
    return ptmcalc("check", "specs", "--no-repairs", "--scene", "run_loaded", "--format", "json", *options)


def after_a_chunk(do: Callable[[], object], number: int = 1) -> Any:
    """Does something once, when so many chunks of results have been kept."""
    add, chunks = Store.add, iter(range(1, 10_000))

    def added(self: Store, records: Iterable[tuple[bytes, Record]]) -> None:
        add(self, records)
        if next(chunks) == number:
            do()

    return mock.patch.object(Store, "add", added)


def test_the_bytes_are_those_of_a_serial_run_though_a_worker_is_killed(
    two_workers: Cluster, specs: Callable[[int], None]
) -> None:
    """500 specs; one of the two workers is killed while both are at work."""
    specs(MANY)
    serial = checked("--jobs", "1")
    killed = two_workers.workers[0]
    with after_a_chunk(killed.kill):
        done = checked("--executor", two_workers.executor)
    assert killed.wait(10) == -signal.SIGKILL
    assert two_workers.workers[1].poll() is None
    assert (done.status, done.err) == (serial.status, serial.err) == (2, "")
    assert len(json.loads(done.out)["files"]) == MANY
    assert done.out == serial.out


def test_a_cluster_needs_the_same_program(two_workers: Cluster, specs: Callable[[int], None]) -> None:
    specs(2)
    with mock.patch.object(ours, "edition", return_value=b"another"):
        done = checked("--executor", two_workers.executor)
    assert (done.status, done.out) == (2, "")
    assert "the cluster has another version of ptmcalc" in done.err


def test_a_scheduler_that_goes_leaves_one_clear_error_and_what_is_done(
    tmp_path: Path, specs: Callable[[int], None]
) -> None:
    specs(400)
    whole = checked("--jobs", "1")
    with cluster(tmp_path, 1) as found, after_a_chunk(found.scheduler.kill):
        done = checked("--executor", found.executor, "--store", "results", "-o", "json=report.json")
    place = found.executor.removeprefix("dask://")
    assert done.status == 2
    (line,) = done.err.splitlines()
    assert line.startswith(f"ptmcalc: the scheduler of dask at `{place}` is gone (interrupted after ")
    assert line.endswith(" of 400 files; the same command goes on from there)")
    assert not Path("report.json").exists(), "a report that is not whole replaces none"
    printed = json.loads(done.out)["files"]
    with Store(Path("results")) as store:
        kept = len(store)
    assert 0 < kept <= len(printed) < 400
    assert all(entry in json.loads(whole.out)["files"] for entry in printed)
    again = checked("--jobs", "1", "--store", "results")
    assert again.out == whole.out
    assert f"{kept} of 400 files known" in again.err


@pytest.mark.parametrize(
    ("executor", "reason"),
    [
        ("dask://127.0.0.1:1", "no scheduler of dask answers at `127.0.0.1:1`"),
        ("dask://127.0.0.1", "is not an executor"),
        ("dask://user@host:1", "is not an executor"),
        ("slurm", "is not an executor"),
        ("", "is not an executor"),
    ],
)
def test_what_is_no_cluster_is_refused(executor: str, reason: str, specs: Callable[[int], None]) -> None:
    specs(1)
    done = checked("--executor", executor)
    assert (done.status, done.out) == (2, "")
    assert reason in done.err


@pytest.mark.parametrize("greeting", [b"", b"SSH-2.0-OpenSSH_9.6\r\n", (2).to_bytes(8, "little")], ids=str)
def test_a_server_that_is_no_scheduler_ends_the_run_soon(
    greeting: bytes, specs: Callable[[int], None], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A server of HTTP waits to be spoken to; one that begins as dask does may never go on."""
    monkeypatch.setattr(ours, "_PATIENCE", 0.5)
    monkeypatch.setattr(ours, "_DEADLINE", 1.0)
    specs(1)
    with socket.create_server(("127.0.0.1", 0)) as server:
        held = []

        def answer() -> None:
            with suppress(OSError):
                while True:
                    held.append(server.accept()[0])
                    held[-1].sendall(greeting)

        threading.Thread(target=answer, daemon=True).start()
        place = f"127.0.0.1:{server.getsockname()[1]}"
        begun = time.monotonic()
        done = checked("--executor", f"dask://{place}")
        assert time.monotonic() - begun < 10
    assert (done.status, done.out) == (2, "")
    assert done.err.startswith(f"ptmcalc: no scheduler of dask answers at `{place}`")
    assert done.err.count("\n") == 1


def test_a_scheduler_that_is_killed_leaves_one_line(tmp_path: Path, specs: Callable[[int], None]) -> None:
    """In a process of its own: dask would write a traceback to its standard error."""
    specs(1500)
    with cluster(tmp_path, 1) as found:
        command = [
            sys.executable,
            "-m",
            "ptmcalc",
            "check",
            "specs",
            "--format",
            "summary",
            "--executor",
            found.executor,
        ]
        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE}
        run = subprocess.Popen(command, env=environment(ROOT), text=True, **quiet)  # type: ignore[call-overload]
        time.sleep(2.0)
        found.scheduler.kill()
        _, err = run.communicate(timeout=30)
    assert run.returncode == 2
    assert err.count("\n") == 1
    assert "dask" in err


def test_jobs_are_not_those_of_a_cluster(specs: Callable[[int], None]) -> None:
    specs(1)
    done = checked("--executor", "dask://127.0.0.1:1", "--jobs", "2")
    assert (done.status, done.out) == (2, "")
    assert "leave one out" in done.err


def test_without_dask_the_extra_is_named(specs: Callable[[int], None]) -> None:
    specs(1)
    with mock.patch.dict(sys.modules, {"distributed": None}):
        done = checked("--executor", "dask://127.0.0.1:1")
    assert (done.status, done.out) == (2, "")
    assert 'pip install "ptmcalc[dask]"' in done.err


# -- executors that lose things -------------------------------------------------------------------------------------


class Losing(Executor):
    """An executor that does so many tasks and then has lost its connection."""

    def __init__(self, most: int) -> None:
        self.left = most

    def submit(self, work: Any, /, *arguments: Any, **more: Any) -> Future[Any]:  # type: ignore[override]
        future: Future[Any] = Future()
        if self.left:
            future.set_result(work(*arguments, **more))
        else:
            future.set_exception(LostError("gone"))
        self.left = max(self.left - 1, 0)
        return future


def test_what_is_lost_with_a_connection_is_done_again(specs: Callable[[int], None]) -> None:
    """By another one, as often as it takes; no file is told to have killed anybody."""
    specs(20)
    connections = chain([Losing(1), Losing(0), Losing(3)], map(Losing, repeat(1000)))
    with Store() as store, mock.patch("ptmcalc.engine.agenda.MOST_IN_CHUNK", 1):
        batch = Batch(sorted(Path("specs").iterdir()), Options(("run_loaded",)), store, worker.with_text)
        steps = list(batch.run(lambda: next(connections), 2))
        assert sum(count for count, _ in steps) == 20
        assert [report.verdict for report in batch.results()] == ["pass"] * 20
        assert len(store) == 20


def test_what_came_back_is_kept_where_the_rest_is_gone(specs: Callable[[int], None]) -> None:
    specs(20)

    connections = iter([Losing(5)])

    def executor() -> Executor:
        for one in connections:
            return one
        raise GoneError("nobody answers")

    with Store() as store, mock.patch("ptmcalc.engine.agenda.MOST_IN_CHUNK", 1):
        batch = Batch(sorted(Path("specs").iterdir()), Options(("run_loaded",)), store, worker.with_text)
        with pytest.raises(GoneError):
            list(batch.run(executor, 2))
        assert len(batch.results(whole=False)) == len(store) == 5


class KilledWorker(Exception):  # noqa: N818
    """As dask calls it."""


@pytest.mark.parametrize(
    ("error", "becomes"),
    [
        (KilledWorker("thrice"), BrokenExecutor),
        (ModuleNotFoundError("No module named 'ptmcalc'"), UsageError),
        (RuntimeError("Error during deserialization of the task graph. ..."), UsageError),
        (ZeroDivisionError(), ZeroDivisionError),
    ],
    ids=lambda one: getattr(one, "__name__", type(one).__name__),
)
def test_a_task_that_fails_says_why_in_the_words_of_a_batch(error: Exception, becomes: type[Exception]) -> None:
    inner: Future[Any] = Future()
    outer: Future[Any] = Future()
    inner.set_exception(error)
    ours._pass_on(inner, outer)
    assert type(outer.exception()) is becomes


def test_processes_of_a_cluster_do_one_chunk_at_a_time() -> None:
    """What is remembered of a machine between two runs is not made for threads."""

    def work(texts: Any, options: Any, patience: float) -> list[Answer]:
        assert ours._AT_WORK.locked()
        return []

    assert ours._alone(ours.edition(), work, [], Options(), 1.0) == []
    assert not ours._AT_WORK.locked()


def test_a_sweep_uses_the_same_door(two_workers: Cluster, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Points that need a run of their own, on the workers that are left and here."""
    monkeypatch.chdir(tmp_path)
    Path("yard.yaml").write_bytes(PASSING)
    vary = ("--vary", "takeup.tension=25 kN:35 kN:3", "--format", "json")
    here = ptmcalc("sweep", "yard.yaml", *vary)
    assert here.status == 0
    assert ptmcalc("sweep", "yard.yaml", *vary, "--executor", two_workers.executor) == here
