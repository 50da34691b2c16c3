"""Shared fixtures, and the collector of Markdown cases: prose, a spec, and the findings it must give."""

import gc
import json
import os
import sys
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

# One process a core is busy enough: threads of matrices that wait for each other's core burn it. Set before numpy is
# there, and for the processes of a run, which inherit it.
os.environ["OPENBLAS_NUM_THREADS"] = os.environ["OMP_NUM_THREADS"] = os.environ["MKL_NUM_THREADS"] = "1"
# Where nobody may write what is compiled, each process of a run compiles the package and the tests again.
os.environ["PYTHONDONTWRITEBYTECODE"] = ""
sys.path.insert(0, str(Path(__file__).parent))

from support.markdown import MarkdownFile
from support.turns import later

sys.dont_write_bytecode = False
SECONDS = Path(__file__).parent / "seconds.json"
"""Seconds of each file of tests on a machine of two cores, written by `--store-seconds`."""
_WORTH = 60.0
"""A run of fewer seconds has no list of them."""


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--store-seconds", action="store_true", help=f"write the seconds of each file to {SECONDS.name}")


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """The longest files begin first: none of them is left to one process at the end. In a run of the whole, samples
    take turns (`support.turns`); what is asked for by its path runs."""
    known = json.loads(SECONDS.read_text("utf-8")) if SECONDS.exists() else {}
    if [Path(one).resolve() for one in config.args] == [Path(__file__).parent]:
        others = later((item.nodeid for item in items if not item.get_closest_marker("study")), known)
        for item in items:
            if item.nodeid in others:
                item.add_marker(pytest.mark.study)
    items.sort(key=lambda item: -known.get(_file(item.nodeid), 0.0))


def pytest_terminal_summary(terminalreporter: Any, config: pytest.Config) -> None:
    """Seconds of each room, in all processes together."""
    files: Counter[str] = Counter()
    for reports in terminalreporter.stats.values():
        for one in reports:
            if isinstance(one, pytest.TestReport):
                files[_file(one.nodeid)] += one.duration
    if files.total() < _WORTH:
        return
    rooms: Counter[str] = Counter()
    for file, seconds in files.items():
        rooms[_room(file)] += seconds
    terminalreporter.section(f"seconds by room, {files.total():.0f} in all")
    for room, seconds in rooms.most_common():
        terminalreporter.write_line(f"{seconds:7.0f}  {room}")
    if config.getoption("--store-seconds"):
        known = json.loads(SECONDS.read_text("utf-8")) if SECONDS.exists() else {}
        told = known | {file: round(seconds, 1) for file, seconds in files.items()}
        lasting = {file: seconds for file, seconds in sorted(told.items()) if seconds >= 1 and Path(file).exists()}
        SECONDS.write_text(json.dumps(lasting, indent=1) + "\n", encoding="utf-8")


def _file(nodeid: str) -> str:
    return nodeid.partition("::")[0]


def _room(file: str) -> str:
    """`tests/machines/hoist`, `tests/report`: the folder of the tests, and the kind where there is one."""
    return "/".join(file.split("/")[: 3 if "/machines/" in file else 2])


def pytest_collection_finish() -> None:
    gc.freeze()  # all tests stay to the end: a collection need not go through them again (a twentieth of the run)
    gc.set_threshold(50_000)  # after every 700 objects it takes another sixteenth


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> pytest.Collector | None:
    if file_path.suffix == ".md" and "machines" in file_path.parts:
        return MarkdownFile.from_parent(parent, path=file_path)
    return None
