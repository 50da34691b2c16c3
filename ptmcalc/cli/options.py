"""Options of several commands, the formats to choose from, and how their texts are read."""

from enum import StrEnum
from typing import Annotated

import typer

from ptmcalc.base.errors import UsageError

_IN_JSON = "json"


class CheckFormat(StrEnum):
    """Formats of `check`."""

    TABLE = "table"
    PLAIN = "plain"
    JSON = "json"
    JUNIT = "junit"
    SARIF = "sarif"
    GITHUB = "github"
    MARKDOWN = "markdown"
    SUMMARY = "summary"
    CSV = "csv"


class ListFormat(StrEnum):
    """Formats of the commands that answer with rows."""

    TABLE = "table"
    JSON = "json"


class CostFormat(StrEnum):
    """Formats of `cost`."""

    TABLE = "table"
    JSON = "json"
    MARKDOWN = "markdown"


class StudyFormat(StrEnum):
    """Formats of the commands that compute many points."""

    TABLE = "table"
    JSON = "json"
    CSV = "csv"


class Sample(StrEnum):
    """How the points of a sweep are chosen."""

    GRID = "grid"
    LHS = "lhs"


class ExplainFormat(StrEnum):
    """Formats of `explain`."""

    TEXT = "text"
    MARKDOWN = "markdown"


class Law(StrEnum):
    """Laws of similarity of `scale`."""

    FULL = "full"
    GEOMETRIC = "geometric"
    BALLAST = "ballast"


ScenesOption = Annotated[list[str] | None, typer.Option("--scene", help="Only this scene; may be repeated.")]
AccuracyOption = Annotated[str, typer.Option("--accuracy", help="Relative error of the governing loads, e.g. 1%.")]
BudgetOption = Annotated[str, typer.Option("--budget", help="Predicted time each scene may take at most, e.g. 2s.")]
EffectsOption = Annotated[
    list[str] | None,
    typer.Option("--effects", help="NAME=on|off|auto, replaces the setting of the file; may be repeated."),
]
ExcludeOption = Annotated[
    list[str] | None,
    typer.Option("--exclude", metavar="PATTERN", help="Leave out of folders, as .gitignore writes it; repeatable."),
]
GitignoreOption = Annotated[
    bool, typer.Option("--gitignore/--no-gitignore", help="Leave out of folders what their .gitignore leaves out.")
]
JobsOption = Annotated[
    str, typer.Option("--jobs", "-j", metavar="auto|N", help="Processes; auto: all cores where the work is worth it.")
]
ShardOption = Annotated[
    str, typer.Option("--shard", metavar="I/N", help="Every N-th file from the I-th; `merge` unites the reports.")
]
StoreOption = Annotated[
    str,
    typer.Option(
        "--store", metavar="FILE", help="Keep results there, go on from them, re-use those of unchanged files."
    ),
]
ExecutorOption = Annotated[
    str,
    typer.Option(
        "--executor",
        metavar="local|dask://HOST:PORT",
        help="Workers: local processes, or a cluster of dask.",
    ),
]
StudyBudgetOption = Annotated[
    str, typer.Option("--budget", help="Predicted time of all points that need a run of their own, e.g. 5min.")
]
RepairsOption = Annotated[
    bool, typer.Option("--repairs/--no-repairs", help="Look for the value at which a failed check would pass.")
]
ListOption = Annotated[ListFormat, typer.Option("--format", help="How to print.")]


def history_with_its_value(words: list[str]) -> list[str]:
    """The words of a command line in which `--history`, whose value may be left out, always has one.

    A word behind it that ends in .csv is the file to write; anything else is a path to check. Behind `--` no word is
    an option.
    """
    rewritten: list[str] = []
    options, alone = True, False
    for word in words:
        options = options and word != "--"
        if options and alone and is_csv(word):
            rewritten[-1] = f"--history={word}"
            alone = False
        else:
            alone = options and word == "--history"
            rewritten.append(f"--history={_IN_JSON}" if alone else word)
    return rewritten


def format_and_file(text: str) -> tuple[str, str]:
    form, separator, name = text.partition("=")
    if not separator or not name or form not in list(CheckFormat):
        raise UsageError(f"`{text}` is not FORMAT=FILE", f"formats: {', '.join(CheckFormat)}")
    return form, name


def history_files(given: list[str] | None) -> list[str]:
    for text in given or ():
        if text != _IN_JSON and not is_csv(text):
            raise UsageError(f"`--history={text}` names no .csv file", "write `--history`, or `--history FILE.csv`")
    return [text for text in given or () if text != _IN_JSON]


def is_csv(name: str) -> bool:
    """Whether a word names a CSV file."""
    return name.lower().endswith(".csv")


def effects_of(given: list[str] | None) -> dict[str, str]:
    chosen = {}
    for text in given or ():
        name, separator, wish = text.partition("=")
        if not separator or wish not in ("on", "off", "auto"):
            raise UsageError(f"`{text}` is not NAME=on|off|auto", "e.g. --effects sag=off")
        chosen[name] = wish
    return chosen


def seconds_of(text: str) -> float:
    """Seconds of a budget."""
    from ptmcalc.base import units

    try:
        seconds = units.read(text, units.TIME)
    except units.UnitError as error:
        raise UsageError(f"--budget: {error.reason}", error.hint) from None
    if seconds < 0:
        raise UsageError(f"--budget: `{text}` is less than no time", "e.g. --budget 2s")
    return seconds
