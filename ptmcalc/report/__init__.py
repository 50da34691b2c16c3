"""Output formats of reports. A report contains results, independent of the machine kind.

A format is a module here with `render`, named in `Format`.
"""

from collections.abc import Sequence
from enum import StrEnum
from importlib import import_module

from ptmcalc.contract.report import FileReport


class Format(StrEnum):
    """The formats of `ptmcalc check`."""

    TABLE = "table"
    PLAIN = "plain"
    JSON = "json"
    JUNIT = "junit"
    SARIF = "sarif"
    GITHUB = "github"
    MARKDOWN = "markdown"
    SUMMARY = "summary"
    CSV = "csv"


def render(
    form: Format, reports: Sequence[FileReport], *, width: int = 120, color: bool = False, verbose: bool = False
) -> str:
    """The reports in one format; `width`, `color` and `verbose` apply to the table only."""
    module = import_module(f"{__name__}.{form.value}")
    text: str = module.render(tuple(reports), width=width, color=color, verbose=verbose)
    return text
