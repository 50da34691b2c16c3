"""Options of `check` that say which findings count, and how they end it."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ptmcalc.base.errors import UsageError
from ptmcalc.cli.output import say

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from ptmcalc.contract.report import FileReport
    from ptmcalc.engine.policy import Choice

SelectOption = Annotated[
    list[str] | None,
    typer.Option("--select", metavar="CODE", help="Only findings with this code prefix, e.g. CNV; may be repeated."),
]
IgnoreOption = Annotated[
    list[str] | None,
    typer.Option(
        "--ignore", metavar="CODE", help="No findings with this code prefix; the longer prefix takes precedence."
    ),
]
BaselineOption = Annotated[
    str,
    typer.Option("--baseline", metavar="FILE", help="Findings of this baseline are waived unless they are worse now."),
]
WriteOption = Annotated[
    str,
    typer.Option("--write-baseline", metavar="FILE", help="Write the present findings as a baseline, and apply it."),
]
ExitZeroOption = Annotated[
    bool, typer.Option("--exit-zero", help="Exit status 0 also if checks fail or are undecided.")
]


def choice_of(select: list[str] | None, ignore: list[str] | None) -> "Choice":
    """The checks that `--select` and `--ignore` leave."""
    from ptmcalc.engine.policy import Choice

    return Choice(prefixes("--select", select), prefixes("--ignore", ignore))


def what_counts(
    choice: "Choice", baseline: str, write_baseline: str, *, whole: bool
) -> "Callable[[Sequence[FileReport]], Sequence[FileReport]]":
    """What the options of a run make of its reports; they are looked at before it begins.

    Of a run over `whole` files it is told what a baseline holds that is no longer there.
    """
    from ptmcalc.engine.policy import chosen

    if not baseline and not write_baseline:
        return lambda reports: chosen(reports, choice)
    from ptmcalc.engine.baseline import apart_from, baseline_of, read_baseline

    known = read_baseline(Path(baseline)) if baseline else {}

    def counted(reports: "Sequence[FileReport]") -> "Sequence[FileReport]":
        found = chosen(reports, choice)
        if baseline:
            found, unmet = apart_from(found, known, Path(baseline).parent)
            stale = sum(choice.takes(code) for _, code, _, _ in unmet)
            if stale and whole:
                what = "1 finding is" if stale == 1 else f"{stale} findings are"
                again = "--write-baseline writes it anew"
                say(f"ptmcalc: {what} in `{baseline}` and no longer found; {again}\n", err=True)
        if write_baseline:
            path = Path(write_baseline)
            try:
                path.write_text(baseline_of(found, path.parent), encoding="utf-8", errors="replace")
            except OSError as error:
                raise UsageError(f"cannot write `{path}`: {error.strerror}") from None
            found, _ = apart_from(found, read_baseline(path), path.parent)
        return found

    return counted


def prefixes(option: str, given: list[str] | None) -> tuple[str, ...]:
    """Prefixes of codes, several of them also with commas between.

    Raises:
        UsageError: one that no code begins with.
    """
    from ptmcalc.base.diagnostic import CODES
    from ptmcalc.engine.registry import begins_a_code

    words = [word.strip().upper() for text in given or () for word in text.split(",")]
    for word in words:
        if not word or not (any(code.startswith(word) for code in CODES) or begins_a_code(word)):
            raise UsageError(f"{option}: no code begins with `{word}`", "e.g. CNV, CNV1 or CNV101")
    return tuple(words)
