"""What a process costs before it computes: a check and `--help` beside the libraries they are made of.

`python -m pytest tests/bench/test_start.py --benchmark-enable -s -n 0 -m study` prints the table: processor time, least
of many processes that take turns, each with its modules compiled as an installation has them. What is imported is
counted in tests/house/test_imports.py, which is the gate. Beside other work on two cores:

    a check that closed forms decide   1.92 times the import of typer, pydantic, yaml, rich and numpy (it was 3.6)
                                       1.25 times these with one model and one command at work
    `--help`                           0.88 times the import of typer and rich (it was 2.7)

`import pydantic` alone loads next to nothing; its first model, which no design file can be read without, and the first
option of a command, which typer reads with pydantic, cost half as much as all the imports together: the first ratio has
a floor of 1.5. Of the other 0.4 a third is the kind (models, effects, checks), a third what every kind shares (engine,
report, 120 dataclasses), a third the rest: numerics of closed forms, YAML, laws.
"""

import os
import resource
import subprocess
import sys
from pathlib import Path

import pytest
from support.command import ROOT, environment
from support.libraries import LIBRARIES, READY

CLOSED = "specs/hoist/winding_paper/height_25_rope_17_5.yaml"
PROCESSES = {
    "libraries": ("-c", LIBRARIES),
    "ready": ("-c", READY),
    "check": ("-m", "ptmcalc", "check", CLOSED),
    "typer and rich": ("-c", "import typer, rich"),
    "help": ("-m", "ptmcalc", "--help"),
}
RATIOS = (("check", "libraries"), ("check", "ready"), ("help", "typer and rich"))


def spent(arguments: tuple[str, ...], env: dict[str, str]) -> float:
    """Processor time of a process that succeeds [s]."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([sys.executable, *arguments], cwd=ROOT, env=env, capture_output=True, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


@pytest.mark.study
def test_table_of_starts(tmp_path: Path, request: pytest.FixtureRequest) -> None:
    timed = bool(request.config.getoption("--benchmark-enable", default=False))
    env = environment(ROOT, PYTHONPYCACHEPREFIX=str(tmp_path / "compiled"), OPENBLAS_NUM_THREADS="1")
    del env["PYTHONDONTWRITEBYTECODE"]
    seconds: dict[str, list[float]] = {name: [] for name in PROCESSES}
    for _ in range(16 if timed else 1):
        for name, arguments in PROCESSES.items():
            seconds[name].append(spent(arguments, env))
    rows = [f"{name:<16} {1e3 * min(spans):7.1f} ms" for name, spans in seconds.items()]
    rows += [f"{one} over {other}: {min(seconds[one]) / min(seconds[other]):.2f}" for one, other in RATIOS]
    print("", *rows, sep="\n")
    assert len(os.listdir(tmp_path / "compiled")) > 0
