"""What `ptmcalc check --html` writes: the page of one file, or a folder of pages with their index."""

from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import BrokenExecutor, Executor
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from ptmcalc.base.errors import UsageError
from ptmcalc.cli.batch import write
from ptmcalc.cli.processes import pool
from ptmcalc.contract.report import FileReport
from ptmcalc.report import html
from ptmcalc.text.document import MAX_BYTES

_OF_A_PAGE = (".html", ".htm")


def begin(place: str, paths: Sequence[str]) -> None:
    """See that there can be pages at that place, before anything is computed for them.

    Raises:
        UsageError: what writes them is not installed, or a single page is named for several files.
    """
    html.require()
    if _single(place) and (len(paths) > 1 or any(Path(path).is_dir() for path in paths)):
        raise _one_for_many(place)
    if not _single(place) and Path(place).is_file():
        raise UsageError(f"--html: `{place}` is a file", "name a folder, or a file that ends in .html")


def write_pages(place: str, reports: Sequence[FileReport], jobs: int) -> None:
    """Write the page, or the pages and their index, drawn by so many processes.

    Raises:
        UsageError: they cannot be written, or a single page is named for several files.
    """
    if _single(place):
        if len(reports) != 1:
            raise _one_for_many(place)
        write(Path(place), [html.page(reports[0], _text_of(reports[0]))])
        return
    folder = Path(place)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(f"cannot write `{place}`: {error.strerror}") from None
    with ExitStack() as stack:
        each = _each(stack.enter_context(pool(jobs, ())())) if min(jobs, len(reports)) > 1 else map
        for name, text in html.site(reports, _text_of, each):
            write(folder / name, [text])


def _each(executor: Executor) -> Callable[..., Iterable[str]]:
    """A `map` by other processes, and by this one where there are none."""

    def each(make: Callable[..., str], *given: Iterable[Any]) -> list[str]:
        rows = list(zip(*given, strict=True))
        try:
            return list(executor.map(make, *zip(*rows, strict=True)))
        except (BrokenExecutor, OSError):
            return [make(*row) for row in rows]

    return each


def _single(place: str) -> bool:
    return place.lower().endswith(_OF_A_PAGE) and not Path(place).is_dir()


def _one_for_many(place: str) -> UsageError:
    return UsageError(
        f"--html: `{place}` is one page, and there are several files", "name a folder, e.g. --html report/"
    )


def _text_of(report: FileReport) -> str:
    """The text of a design file; empty where it cannot be read."""
    try:
        with Path(report.path).open("rb") as file:
            return file.read(MAX_BYTES).decode("utf-8-sig", errors="replace")
    except (OSError, ValueError):
        return ""
