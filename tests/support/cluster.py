"""A scheduler of dask.distributed and its workers as processes of their own, on the loopback."""

import json
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from distributed import Client

from support.command import ROOT, environment


@dataclass(frozen=True)
class Cluster:
    """Processes, and where the scheduler listens."""

    address: str
    scheduler: subprocess.Popen[bytes]
    workers: tuple[subprocess.Popen[bytes], ...]

    @property
    def executor(self) -> str:
        """What `--executor` takes."""
        return self.address.replace("tcp://", "dask://")


@contextmanager
def cluster(folder: Path, workers: int) -> Iterator[Cluster]:
    """A cluster whose processes are ended with it; ports are chosen free by the system."""
    started: list[subprocess.Popen[bytes]] = []

    def start(module: str, *arguments: str) -> subprocess.Popen[bytes]:
        command = [sys.executable, "-m", f"distributed.cli.{module}", "--host", "127.0.0.1", "--no-dashboard"]
        with (folder / f"{module}_{len(started)}.log").open("wb") as log:
            started.append(
                subprocess.Popen([*command, *arguments], cwd=folder, env=environment(ROOT), stdout=log, stderr=log)
            )
        return started[-1]

    try:
        place = folder / "scheduler.json"
        scheduler = start("dask_scheduler", "--port", "0", "--scheduler-file", str(place), "--no-show")
        while not place.exists():
            assert scheduler.poll() is None, (folder / "dask_scheduler_0.log").read_text("utf-8")
            time.sleep(0.05)
        address = json.loads(place.read_text("utf-8"))["address"]
        some = tuple(start("dask_worker", address, "--nthreads", "1", "--no-nanny") for _ in range(workers))
        with Client(address, set_as_default=False) as client:
            client.wait_for_workers(workers)
        yield Cluster(address, scheduler, some)
    finally:
        for process in reversed(started):
            process.kill()
            process.wait()
