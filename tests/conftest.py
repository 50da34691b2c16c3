"""Shared fixtures, and the collector of Markdown cases: prose, a spec, and the findings it must give."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

from support.markdown import MarkdownFile


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> pytest.Collector | None:
    if file_path.suffix == ".md" and "machines" in file_path.parts:
        return MarkdownFile.from_parent(parent, path=file_path)
    return None
