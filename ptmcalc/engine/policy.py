"""Which findings count in a run: chosen by code, or known from a baseline. Nothing vanishes without being counted."""

import json
import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ptmcalc.base.diagnostic import Severity, Verdict
from ptmcalc.base.errors import UsageError
from ptmcalc.base.span import dotted
from ptmcalc.contract.report import FileReport, Judgement

BASELINE_VERSION = "1"
_BAD = (Verdict.FAIL, Verdict.UNDECIDED, Verdict.NOT_CHECKED)
Key = tuple[str, str, str]
"""File, code, key."""
Known = Mapping[Key, str]
"""Findings of a baseline with the verdict they had then, or `warning`."""


@dataclass(frozen=True, slots=True)
class Choice:
    """Prefixes of codes that count, all when there are none, and of those that do not; the longer prefix wins."""

    select: tuple[str, ...] = ()
    ignore: tuple[str, ...] = ()

    def takes(self, code: str) -> bool:
        """Whether findings of a code count."""
        chosen = _longest(code, self.select or ("",))
        return chosen is not None and chosen > (-1 if (left := _longest(code, self.ignore)) is None else left)


ANY = Choice()


def _longest(code: str, prefixes: Iterable[str]) -> int | None:
    return max((len(prefix) for prefix in prefixes if code.startswith(prefix)), default=None)


def chosen(reports: Sequence[FileReport], choice: Choice) -> Sequence[FileReport]:
    """The reports without what does not count, of which they keep the number; what makes a file invalid always does."""
    return _Chosen(reports, choice) if choice.select or choice.ignore else reports


class _Chosen(Sequence[FileReport]):
    """Reports that lose what does not count when they are looked at: of a batch not all are in memory at once."""

    def __init__(self, reports: Sequence[FileReport], choice: Choice) -> None:
        self._reports, self._choice = reports, choice

    def __len__(self) -> int:
        return len(self._reports)

    def __getitem__(self, index):  # type: ignore[no-untyped-def]
        if isinstance(index, slice):
            return _Chosen(self._reports[index], self._choice)
        return _without(self._reports[index], self._choice)


def _without(report: FileReport, choice: Choice) -> FileReport:
    said = tuple(d for d in report.diagnostics if d.severity is Severity.ERROR or choice.takes(d.code))
    scenes = tuple(
        replace(scene, checks=tuple(one for one in scene.checks if choice.takes(one.code))) for scene in report.scenes
    )
    gone = len(report.diagnostics) - len(said)
    gone += sum(len(old.checks) - len(new.checks) for old, new in zip(report.scenes, scenes, strict=True))
    return replace(report, diagnostics=said, scenes=scenes, ignored=report.ignored + gone)


def baseline_of(reports: Sequence[FileReport], folder: Path) -> str:
    """The text of a baseline that lies in a folder: every finding there is now, by file, code and key."""
    found: dict[Key, str] = {}
    for report in reports:
        for key, state in _findings(report, folder):
            if key not in found or _weight(state) < _weight(found[key]):
                found[key] = state
    rows = [{"file": f, "code": code, "key": key, "state": found[f, code, key]} for f, code, key in sorted(found)]
    return json.dumps({"schema_version": BASELINE_VERSION, "findings": rows}, indent=2, ensure_ascii=False) + "\n"


def read_baseline(path: Path) -> Known:
    """The findings of a baseline.

    Raises:
        UsageError: it cannot be read, or is none.
    """
    try:
        document: Any = json.loads(path.read_text("utf-8"))
        rows = document["findings"]
        found = {(row["file"], row["code"], row["key"]): row["state"] for row in rows}
        if document["schema_version"] != BASELINE_VERSION or any(_weight(state) < 0 for state in found.values()):
            raise ValueError
    except OSError as error:
        hint = "`--write-baseline` writes one"
        raise UsageError(f"the baseline `{path}` cannot be read: {error.strerror}", hint) from None
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        raise UsageError(f"`{path}` is no baseline of ptmcalc", "`--write-baseline` writes one") from None
    return found


def apart_from(
    reports: Sequence[FileReport], known: Known, folder: Path
) -> tuple[tuple[FileReport, ...], frozenset[Key]]:
    """The reports with known findings waived, and what of the baseline is not found any more in the files checked.

    A verdict worse than it was is not known. Warnings that are known are left out and counted.
    """
    told, met, files = [], set(), set()
    for report in reports:
        name = _name(report, folder)
        files.add(name)
        met |= {key for key, _ in _findings(report, folder)}
        said = tuple(
            d
            for d in report.diagnostics
            if d.severity is not Severity.WARNING or (name, d.code, dotted(d.path)) not in known
        )
        scenes = tuple(
            replace(scene, checks=tuple(_known(name, judgement, known) for judgement in scene.checks))
            for scene in report.scenes
        )
        ignored = report.ignored + len(report.diagnostics) - len(said)
        told.append(replace(report, diagnostics=said, scenes=scenes, ignored=ignored))
    return tuple(told), frozenset(key for key in known if key[0] in files and key not in met)


def _known(name: str, judgement: Judgement, known: Known) -> Judgement:
    before = known.get((name, judgement.code, dotted(judgement.blame.path)))
    if judgement.verdict not in _BAD or before is None or _weight(judgement.verdict.value) < _weight(before):
        return judgement
    reason = "; ".join(filter(None, (f"{judgement.verdict.value}, known from the baseline", judgement.reason)))
    return replace(judgement, verdict=Verdict.WAIVED, reason=reason, baseline=True)


def _findings(report: FileReport, folder: Path) -> Iterator[tuple[Key, str]]:
    name = _name(report, folder)
    for one in report.diagnostics:
        if one.severity is Severity.WARNING:
            yield (name, one.code, dotted(one.path)), Severity.WARNING.value
    for _, judgement in report.judgements:
        if judgement.verdict in _BAD:
            yield (name, judgement.code, dotted(judgement.blame.path)), judgement.verdict.value


def _weight(state: str) -> int:
    """0 the worst; below 0 what no baseline holds."""
    order = [*(verdict.value for verdict in _BAD), Severity.WARNING.value]
    return order.index(state) if state in order else -1


def _name(report: FileReport, folder: Path) -> str:
    """The file as seen from the folder of the baseline, so that it holds wherever the command is run."""
    return Path(os.path.relpath(report.path, folder)).as_posix()
