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
BudgetOption = Annotated[str, typer.Option("--budget", help="Maximum predicted time of a scene, e.g. 2s.")]
EffectsOption = Annotated[
    list[str] | None,
    typer.Option("--effects", help="NAME=on|off|auto; overrides the setting of the file; may be repeated."),
]
ConfidenceOption = Annotated[
    str,
    typer.Option(
        "--confidence", help="Confidence level of the intervals, and share of machines with the stated margin."
    ),
]
LawOption = Annotated[
    Law, typer.Option("--law", help="Similarity of the model: full, without gravity, or gravity by ballast.")
]
SampleOption = Annotated[
    Sample, typer.Option("--sample", help="All combinations, or a Latin hypercube of --points points.")
]
CodesOption = Annotated[
    list[str] | None,
    typer.Option("--check", metavar="CODE", help="Only this check is to pass; may be repeated. Default: all."),
]
KeysOption = Annotated[
    str,
    typer.Option(
        "--keys",
        metavar="KEYS",
        help="Only these keys may change, e.g. takeup.tension,belt.strength; with a + before the first, these too.",
    ),
]
RangesOption = Annotated[
    list[str] | None,
    typer.Option(
        "--vary",
        metavar="KEY=FROM:TO:N",
        help="A key and its values, e.g. 'takeup.tension=20 kN:60 kN:21'; `:log` behind it for equal ratios; may be"
        " repeated. With --sample lhs KEY=FROM:TO.",
    ),
]
ExcludeOption = Annotated[
    list[str] | None,
    typer.Option("--exclude", metavar="PATTERN", help="Exclude files by a .gitignore pattern; may be repeated."),
]
GitignoreOption = Annotated[
    bool, typer.Option("--gitignore/--no-gitignore", help="Exclude the files that .gitignore excludes.")
]
JobsOption = Annotated[
    str,
    typer.Option(
        "--jobs", "-j", metavar="auto|N", help="Number of processes; auto: all cores if the work justifies them."
    ),
]
ShardOption = Annotated[
    str,
    typer.Option("--shard", metavar="I/N", help="Check every N-th file from the I-th; `merge` combines the reports."),
]
StoreOption = Annotated[
    str,
    typer.Option("--store", metavar="FILE", help="Store results there; reuse the results of unchanged files."),
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
    str, typer.Option("--budget", help="Maximum predicted time of all points that require separate runs, e.g. 5min.")
]
RepairsOption = Annotated[
    bool, typer.Option("--repairs/--no-repairs", help="Compute the value at which a failed check would pass.")
]
ListOption = Annotated[ListFormat, typer.Option("--format", help="Output format.")]


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
        raise UsageError(f"--budget: `{text}` is negative", "e.g. --budget 2s")
    return seconds
