"""Shared fixtures, and the collector of Markdown cases: prose, a spec, and the findings it must give."""

import gc
import os
import sys
from pathlib import Path

import pytest

# One process a core is busy enough: threads of matrices that wait for each other's core burn it. Set before numpy is
# there, and for the processes of a run, which inherit it.
os.environ["OPENBLAS_NUM_THREADS"] = os.environ["OMP_NUM_THREADS"] = os.environ["MKL_NUM_THREADS"] = "1"
# Where nobody may write what is compiled, each process of a run compiles the package and the tests again.
os.environ["PYTHONDONTWRITEBYTECODE"] = ""
sys.path.insert(0, str(Path(__file__).parent))

from support.markdown import MarkdownFile

sys.dont_write_bytecode = False
LONGEST_FIRST = (
    "coverage",
    "test_zoo.py",
    "stability",
    "machines",
    "house",
    "numerics",
    "engine",
    "cli",
    "reference",
    "order",
)
"""Rooms and files that take longest: begun first, none of them is left to one process at the end."""


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    def turn(item: pytest.Item) -> int:
        return next((k for k, room in enumerate(LONGEST_FIRST) if room in item.path.parts), len(LONGEST_FIRST))

    items.sort(key=turn)


def pytest_collection_finish() -> None:
    gc.freeze()  # all tests stay to the end: a collection need not go through them again (a twentieth of the run)
    gc.set_threshold(50_000)  # after every 700 objects it takes another sixteenth


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> pytest.Collector | None:
    if file_path.suffix == ".md" and "machines" in file_path.parts:
        return MarkdownFile.from_parent(parent, path=file_path)
    return None
