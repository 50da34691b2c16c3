"""Findings that are known from an earlier run and waived as long as they are no worse.

A finding is a check by file, code, scene and element, or a warning by file, code, scene and key. A baseline keeps its
verdict, its value with the error bar, and its limit. A finding is worse, and so counts as new, where its verdict is
worse, its value lies beyond both error bars on the bad side, a bound of it is lost, or its limit is stricter.
"""

import json
import math
import os
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ptmcalc.base.diagnostic import Diagnostic, Severity, Verdict
from ptmcalc.base.errors import UsageError
from ptmcalc.base.estimate import Interval
from ptmcalc.base.span import dotted, known
from ptmcalc.base.units import Quantity, show
from ptmcalc.contract.check import Sense
from ptmcalc.contract.report import FileReport, Judgement

BASELINE_VERSION = "2"
_FORMER = "1"
"""It knew neither scenes nor values: whatever failed in one scene was known in all, however badly."""
_BAD = (Verdict.FAIL, Verdict.UNDECIDED, Verdict.NOT_CHECKED)
_SAME = 1e-9
"""Relative difference of two exact values [1] that counts as rounding of another processor or library. A numerical
choice. A larger value hides small changes; a smaller one reports rounding as a change."""
_VISIBLE = 1e-4
"""Relative error bar [1] from which on it is printed next to a value of four digits. An engineering choice; no
comparison depends on it."""
_SCENES = re.compile(r"scenes? (?P<labels>`[^`]*`(?:, `[^`]*`)*)[,:]")
"""How a warning of scenes begins."""
_NUMBERS = ("value", "low", "high", "limit_low", "limit_high")
Key = tuple[str, str, str, str]
"""File, code, scene, and the element of a check or the key of a warning."""


@dataclass(frozen=True, slots=True)
class Seen:
    """A finding as it stands in one run; without `value` where no number decided it."""

    state: str
    value: float | None = None
    bar: Interval | None = None
    limit: Interval | None = None

    @property
    def weight(self) -> int:
        """0 the worst; below 0 no state of a finding."""
        order = [*(verdict.value for verdict in _BAD), Severity.WARNING.value]
        return order.index(self.state) if self.state in order else -1

    def worse_than(self, then: "Seen", sense: Sense) -> bool:
        """Whether it is worse than it was, beyond the error bars."""
        if self.weight < then.weight or (self.value is None and then.value is not None):
            return True
        if self.limit is not None and then.limit is not None and _beyond(then.limit, self.limit, sense):
            return True
        if self.bar is None or then.bar is None:
            return False
        now_worst, then_worst = (one.low if sense is Sense.AT_LEAST else -one.high for one in (self.bar, then.bar))
        return (not math.isfinite(now_worst) and now_worst < then_worst) or _beyond(self.bar, then.bar, sense)


def _beyond(one: Interval, other: Interval, sense: Sense) -> bool:
    """Whether all of an interval is less (of what is to be at least) or more than all of another one."""
    less, more = (one, other) if sense is Sense.AT_LEAST else (other, one)
    return less.high < more.low and not math.isclose(less.high, more.low, rel_tol=_SAME)


Known = Mapping[Key, Seen]
"""The findings of a baseline."""


def baseline_of(reports: Sequence[FileReport], folder: Path) -> str:
    """The text of a baseline that lies in a folder: every finding there is now."""
    rows: dict[Key, dict[str, Any]] = {}
    for report in reports:
        name = _name(report, folder)
        for one in _warnings(report):
            for key in _keys(name, one):
                rows[key] = _row(key, dotted(known(one.path)), Seen(Severity.WARNING.value))
        for scene, judgement in report.judgements:
            if judgement.verdict in _BAD:
                key = _key(name, scene.name, judgement)
                rows[key] = _row(key, dotted(known(judgement.blame.path)), _seen(judgement))
    found = [rows[key] for key in sorted(rows)]
    return json.dumps({"schema_version": BASELINE_VERSION, "findings": found}, indent=2, ensure_ascii=False) + "\n"


def read_baseline(path: Path) -> Known:
    """The findings of a baseline.

    Raises:
        UsageError: it cannot be read, is none, or is one of an older form.
    """
    hint = "`--write-baseline` writes one"
    try:
        document: Any = json.loads(path.read_text("utf-8"))
        version = document["schema_version"]
        if version == _FORMER and isinstance(document["findings"], list):
            reason = f"the baseline `{path}` has the form of an earlier version, without scenes and values"
            raise UsageError(reason, "`--write-baseline` writes it anew; first check which findings it waives")
        found = dict(map(_entry, document["findings"]))
        if version != BASELINE_VERSION or any(one.weight < 0 for one in found.values()):
            raise ValueError
    except OSError as error:
        raise UsageError(f"the baseline `{path}` cannot be read: {error.strerror}", hint) from None
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        raise UsageError(f"`{path}` is not a baseline of ptmcalc", hint) from None
    return found


def _row(key: Key, path: str, seen: Seen) -> dict[str, Any]:
    file, code, scene, element = key
    row = {"file": file, "code": code, "scene": scene, "element": element, "key": path, "state": seen.state}
    ends = (seen.bar, seen.limit)
    numbers = [seen.value, *(end for one in ends for end in ((one.low, one.high) if one else (None, None)))]
    shown = (None if one is None else one if math.isfinite(one) else str(one) for one in numbers)
    return row | {name: one for name, one in zip(_NUMBERS, shown, strict=True) if one is not None}


def _entry(row: Mapping[str, Any]) -> tuple[Key, Seen]:
    words = [row[name] for name in ("file", "code", "scene", "element", "state")]
    if not all(isinstance(word, str) for word in words):
        raise TypeError
    file, code, scene, element, state = words
    value, low, high, least, most = (float(row[name]) if name in row else None for name in _NUMBERS)
    bar = Interval(low, high) if low is not None and high is not None else None
    limit = Interval(least, most) if least is not None and most is not None else None
    return (file, code, scene, element), Seen(state, value, bar, limit)


def apart_from(
    reports: Sequence[FileReport], known: Known, folder: Path
) -> tuple[tuple[FileReport, ...], frozenset[Key]]:
    """The reports with known findings waived, and what of the baseline is not found any more in the files checked.

    A finding that is worse than it was is not known, and says so. Warnings that are known are left out and counted.
    """
    told, met, files = [], set(), set()
    for report in reports:
        name = _name(report, folder)
        files.add(name)
        met |= {key for one in _warnings(report) for key in _keys(name, one)}
        met |= {_key(name, scene.name, one) for scene, one in report.judgements if one.verdict in _BAD}
        gone = {one for one in _warnings(report) if all(key in known for key in _keys(name, one))}
        said = tuple(one for one in report.diagnostics if one not in gone)
        scenes = tuple(
            replace(
                scene,
                checks=tuple(_against(one, known.get(_key(name, scene.name, one))) for one in scene.checks),
            )
            for scene in report.scenes
        )
        ignored = report.ignored + len(report.diagnostics) - len(said)
        told.append(replace(report, diagnostics=said, scenes=scenes, ignored=ignored))
    return tuple(told), frozenset(key for key in known if key[0] in files and key not in met)


def _against(judgement: Judgement, then: Seen | None) -> Judgement:
    """A verdict as a baseline leaves it: waived where it is known, else with the reason why it is not."""
    if judgement.verdict not in _BAD or then is None:
        return judgement
    now = _seen(judgement)
    numbers = _numbers(now, then, judgement.quantity)
    if now.worse_than(then, judgement.sense):
        said = f"worse than in the baseline: {numbers}" if numbers else f"{then.state} in the baseline"
        return replace(judgement, reason="; ".join(filter(None, (said, judgement.reason))))
    said = f"{judgement.verdict.value}, known from the baseline" + (f": {numbers}" if numbers else "")
    reason = "; ".join(filter(None, (said, judgement.reason)))
    return replace(judgement, verdict=Verdict.WAIVED, reason=reason, baseline=True)


def _numbers(now: Seen, then: Seen, quantity: Quantity) -> str:
    """Both values, and both limits where they differ."""
    if then.value is None:
        return ""
    before = _amount(then.value, then.bar, quantity)
    said = f"{before} then, {_amount(now.value, now.bar, quantity) if now.value is not None else 'no value'} now"
    if now.limit and then.limit and (_beyond(now.limit, then.limit, _UP) or _beyond(then.limit, now.limit, _UP)):
        limits = [show(one.low + one.width / 2, quantity) for one in (then.limit, now.limit)]
        said += f"; limit {limits[0]} then, {limits[1]} now"
    return said


_UP = Sense.AT_LEAST


def _amount(value: float, bar: Interval | None, quantity: Quantity) -> str:
    if not math.isfinite(value):
        return "unlimited" if value > 0 else "none" if value < 0 else "unknown"
    if bar is None or not bar.width > _VISIBLE * abs(value):
        return show(value, quantity)
    low, high = (show(end, quantity) if math.isfinite(end) else "no bound" for end in (bar.low, bar.high))
    return f"{show(value, quantity)} [{low}, {high}]"


def _seen(judgement: Judgement) -> Seen:
    """A verdict as a baseline keeps it; of one that a run found whatever its number, no number."""
    value, limit = judgement.value, judgement.limit
    if value is None or (judgement.verdict is Verdict.FAIL and judgement.margin is None):
        return Seen(judgement.verdict.value)
    bar = Interval(float(value.low), float(value.high))
    ends = Interval(float(limit.low), float(limit.high)) if limit is not None else None
    return Seen(judgement.verdict.value, float(value.value), bar, ends)


def _warnings(report: FileReport) -> Iterator[Diagnostic]:
    return (one for one in report.diagnostics if one.severity is Severity.WARNING)


def _key(name: str, scene: str, judgement: Judgement) -> Key:
    return name, judgement.code, scene, judgement.element


def _keys(name: str, warning: Diagnostic) -> list[Key]:
    """Those of a warning: one for each scene it is about, or one of the file."""
    begun = _SCENES.match(warning.message)
    labels = begun["labels"][1:-1].split("`, `") if begun else [""]
    return [(name, warning.code, label, dotted(known(warning.path))) for label in labels]


def _name(report: FileReport, folder: Path) -> str:
    """The file as seen from the folder of the baseline, so that it holds wherever the command is run."""
    return Path(os.path.relpath(report.path, folder)).as_posix()
