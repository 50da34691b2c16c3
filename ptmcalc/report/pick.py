"""Contents of the short table: the governing values and everything that is not passed. The rest is counted."""

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.report import FileReport, Judgement, SceneReport
from ptmcalc.contract.result import LoadInfo, family
from ptmcalc.report import words

MOST_EVENTS = 30
"""Events of a scene that the whole table lists; the JSON has all."""


@dataclass(frozen=True, slots=True)
class Row:
    """A verdict that is shown, in one scene or in all that say the same, and how many passed ones of its code it stands
    for besides itself."""

    scenes: tuple[str, ...]
    judgement: Judgement
    more: int = 0

    @property
    def scene(self) -> str:
        """As it is written."""
        return ", ".join(self.scenes)


def all_checks(report: FileReport) -> list[Row]:
    """Every verdict, the worst first."""
    return [Row((scene,), judgement) for scene, judgement in words.worst_first(report)]


def checks(report: FileReport) -> list[Row]:
    """Every verdict that is not a pass, once for all scenes it is the same in, and of those that are the closest one of
    each code, the worst first."""
    rows = _folded(all_checks(report))
    passed = Counter(row.judgement.code for row in rows if row.judgement.verdict is Verdict.PASS)
    shown = []
    for row in rows:
        if row.judgement.verdict is not Verdict.PASS:
            shown.append(row)
        elif more := passed.pop(row.judgement.code, 0):
            shown.append(replace(row, more=more - 1))
    return shown


def _folded(rows: Sequence[Row]) -> list[Row]:
    """Verdicts that are no pass and read the same in several scenes as one, at the place of the first."""
    found: dict[object, list[Row]] = {}
    for index, row in enumerate(rows):
        bad = row.judgement.verdict is not Verdict.PASS
        found.setdefault(as_read(row.judgement) if bad else index, []).append(row)
    return [Row(tuple(row.scene for row in same), same[0].judgement) for same in found.values()]


def as_read(judgement: Judgement) -> tuple[object, ...]:
    """All that a reader is told of a verdict but its scene."""
    numbers = words.value(judgement), words.amount(judgement.limit, judgement.quantity) if judgement.limit else ""
    about = (judgement.verdict, judgement.code, judgement.element, judgement.blame, words.remark(judgement))
    return (*about, *numbers, words.margin(judgement))


def all_loads(report: FileReport) -> frozenset[str]:
    """Names of the loads of the whole table: the headlines, and what a check that is not passed reads."""
    return _of_bad_verdicts(report).union(info.name for info in _headlines(report))


def loads(report: FileReport) -> frozenset[str]:
    """Names of the loads of the short table.

    Of the headlines those that the kind calls governing or that a check of this file reads, all where there is none,
    the whole machine for its parts; and whatever a check that is not passed reads.
    """
    read = {name for _, judgement in report.judgements for name in judgement.loads}
    read |= {family(name) for name in read}
    headlines = _headlines(report)
    governing = {info.name for info in headlines if info.governing or info.name in read}
    shown = governing or {info.name for info in headlines}
    return _of_bad_verdicts(report).union(name for name in shown if not _stood_for(name, report.scenes))


def _headlines(report: FileReport) -> set[LoadInfo]:
    return {load.info for scene in report.scenes for load in scene.loads if load.info.headline}


def _of_bad_verdicts(report: FileReport) -> frozenset[str]:
    found = {load.info.name for scene in report.scenes for load in scene.loads}
    return frozenset(
        name
        for _, judgement in report.judgements
        if judgement.verdict is not Verdict.PASS
        for name in judgement.loads
        if name in found
    )


def _stood_for(name: str, scenes: Sequence[SceneReport]) -> bool:
    """Whether the load of a part is told by that of the machine wherever there is one: by the worst of all parts."""
    whole = family(name)
    if whole == name:
        return False
    values = [{load.info.name: load.estimate.value for load in scene.loads} for scene in scenes]
    return all(_is_extreme(whole, own) for own in values if name in own)


def _is_extreme(whole: str, values: Mapping[str, float]) -> bool:
    """Whether a machine's value is the largest or the smallest of those of its parts."""
    parts = [value for name, value in values.items() if name != whole and family(name) == whole]
    return whole in values and any(math.isclose(values[whole], end) for end in (max(parts), min(parts)))


def left_out(reports: Sequence[FileReport]) -> str:
    """One line that counts what the whole table shows besides; empty where that is nothing."""
    counted = {
        "load": sum(len(all_loads(report)) - len(loads(report)) for report in reports),
        "passed check": sum(row.more for report in reports for row in checks(report)),
        "event": sum(min(len(scene.events), MOST_EVENTS) for report in reports for scene in report.scenes),
    }
    whole = {
        "meaning of the effects": any(scene.present for report in reports for scene in report.scenes),
        "all runs": any(scene.solvers for report in reports for scene in report.scenes),
        "reasons for assumptions": any(report.assumed for report in reports),
    }
    parts = [f"{number} {name}{'' if number == 1 else 's'}" for name, number in counted.items() if number]
    parts += [name for name, there in whole.items() if there]
    return f"Further output with --verbose: {', '.join(parts)}" if parts else ""
