"""Every number of a worked case that a test here compares is a row of `docs/validation.md`, written by that very test.

A test whose rows are not on the page as they come out fails. To write the page anew, all of it, in one process:

    python tests/update.py validation
"""

from collections.abc import Iterator

import pytest
from support import validation


@pytest.fixture(autouse=True)
def _on_the_page(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    rows: list[validation.Row] = []
    monkeypatch.setattr(pytest, "approx", validation.recorder(rows))
    yield
    outcome = request.node.stash.get(validation.PASSED, False)
    if outcome and rows:
        validation.hold(request.node, rows)


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport(item: pytest.Item, call: pytest.CallInfo[None]) -> Iterator[None]:
    yield
    if call.when == "call":
        item.stash[validation.PASSED] = call.excinfo is None


def pytest_sessionfinish() -> None:
    validation.write()
