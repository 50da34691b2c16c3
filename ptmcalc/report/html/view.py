"""What stands on the page of a file, before it is HTML: texts in rows, each number with its unit."""

import hashlib
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from datetime import date
from typing import Any

from ptmcalc.base.diagnostic import Severity, Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import dotted
from ptmcalc.base.units import TIME, Quantity, digits, show
from ptmcalc.contract.check import Sense
from ptmcalc.contract.effect import EffectState
from ptmcalc.contract.figure import Told
from ptmcalc.contract.report import EffectReport, FileReport, Judgement, LoadReport, SceneReport, count
from ptmcalc.report import pick, words
from ptmcalc.report.rows import cell

Entry = dict[str, Any]
"""A part of a page: what a template shows of it, by name."""
_SIGN = {Sense.AT_LEAST: "≥", Sense.AT_MOST: "≤"}
_AROUND = 3
"""Lines shown before and behind the one that a verdict blames."""
_MOST_LINES = 3000
"""Lines of a file that a page shows whole."""
_WIDEST = 400
_TILES = 12
_GROUPS = (
    ("Forces, torques and stresses", ("force", "torque", "stress", "pressure")),
    ("Power and energy", ("power", "energy")),
    ("Safety, reserves and shares", ("ratio", "slip")),
)
_OTHERS = "Motion and dimensions"


class Source:
    """The text of a design file; empty where nobody has it."""

    def __init__(self, text: str) -> None:
        checksum = hashlib.sha256(text.encode()).hexdigest()
        self.identity = [("SHA-256 of the design file", checksum)] if text else []
        lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n") if text else []
        if lines and not lines[-1]:
            lines.pop()
        shown = (line.replace("\t", "    ").rstrip() for line in lines)
        self.lines: list[str] = [words.printable(line[:_WIDEST]) for line in shown]

    @property
    def whole(self) -> bool:
        """Whether the page shows all of it, so that a line can be gone to."""
        return 0 < len(self.lines) <= _MOST_LINES

    def anchor(self, judgement: Judgement) -> int | None:
        """The line that a verdict blames, where the page has it."""
        line = judgement.blame.span.line
        return line if self.whole and 1 <= line <= len(self.lines) else None

    def excerpt(self, judgement: Judgement) -> Entry | None:
        """The blamed line among those around it."""
        line = judgement.blame.span.line
        if not 1 <= line <= len(self.lines):
            return None
        first, last = max(line - _AROUND, 1), min(line + _AROUND, len(self.lines))
        return {
            "label": f"Lines {first} to {last} of the design file, {judgement.code}",
            "lines": [
                {"number": number, "text": self.lines[number - 1], "marked": number == line}
                for number in range(first, last + 1)
            ],
            "tone": _tone(judgement.verdict),
            "says": f"{judgement.code} {judgement.verdict.value.replace('_', ' ')}",
        }

    def marked(self, report: FileReport) -> list[Entry]:
        """All lines, with what is said of them."""
        if not self.whole:
            return []
        said: dict[int, dict[str, None]] = {}
        tones: dict[int, str] = {}
        for _, judgement in words.worst_first(report):
            if judgement.verdict is Verdict.PASS:
                continue
            line = judgement.blame.span.line
            said.setdefault(line, {})[f"{judgement.code} {judgement.verdict.value.replace('_', ' ')}"] = None
            tones.setdefault(line, _tone(judgement.verdict) or "fail")
        for one in report.diagnostics:
            if one.span and one.severity is not Severity.NOTE:
                said.setdefault(one.span.line, {})[f"{one.code} {one.severity.value}"] = None
                tones.setdefault(one.span.line, "fail" if one.severity is Severity.ERROR else "open")
        return [
            {"number": number, "text": text, "says": ", ".join(said.get(number, ())), "tone": tones.get(number, "")}
            for number, text in enumerate(self.lines, 1)
        ]


def _tone(verdict: Verdict) -> str:
    return {Verdict.PASS: "pass", Verdict.OFF: "pass", Verdict.FAIL: ""}.get(verdict, "open")


def page(report: FileReport, source: Source) -> Entry:
    """Everything on the page but its pictures."""
    scenes = report.scenes
    checks = [_check(report, source, scene, judgement) for scene, judgement in words.worst_first(report)]
    parts = {
        "findings": _findings(report, source),
        "governing": _governing(report),
        "checks": checks,
        "tables": list(_tables(report)),
        "effects": [{"name": one.name, "rows": [_effect(e) for e in one.present]} for one in scenes if one.present],
        "loads": [
            {"name": one.name, "rows": [_load(k, one, load) for load in one.loads]}
            for k, one in enumerate(scenes, 1)
            if one.loads
        ],
        "solvers": [_solvers(k, one) for k, one in enumerate(scenes, 1) if one.solvers],
        "assumed": [
            {
                "key": dotted(one.path),
                "value": words.number(one.value, one.quantity),
                "interval": words.interval(one),
                "source": one.source,
            }
            for one in report.assumed
        ],
        "file_lines": source.marked(report),
    }
    return parts | {
        "path": report.path,
        "name": report.name,
        "head": [*words.head(report), ("date", date.today().isoformat()), *source.identity],
        "kind": report.kind,
        "verdict": report.verdict,
        "counted": words.summary(count([report])).partition(", ")[2],
        "worst": checks[0] if checks else None,
        "remarks": any(one["remark"] or one["repair"] for one in checks),
        "tiles": _tiles(report),
        "scenes": [{"name": one.name, "type": one.type} for one in _told_scenes(report)],
    }


# -- verdicts -------------------------------------------------------------------------------------------------------


def _check(report: FileReport, source: Source, scene: str, judgement: Judgement) -> Entry:
    limit, repair = judgement.limit, judgement.repair
    said = [judgement.reason, f"without {', '.join(judgement.without)}" if judgement.without else ""]
    return {
        "state": judgement.verdict.value,
        "code": judgement.code,
        "title": words.subject(judgement),
        "scene": scene,
        "value": words.value(judgement),
        "limit": f"{_SIGN[judgement.sense]} {words.amount(limit, judgement.quantity)}" if limit else "",
        "margin": words.margin(judgement),
        "level": _level_of(report, scene, judgement),
        "key": dotted(judgement.blame.path),
        "line": source.anchor(judgement),
        "meaning": judgement.meaning,
        "remark": "; ".join(filter(None, said)),
        "repair": f"{dotted(repair.path)} = {words.number(repair.value, repair.quantity)}" if repair else "",
        "excerpt": source.excerpt(judgement),
    }


def _level_of(report: FileReport, name: str, judgement: Judgement) -> str:
    """By what the loads that a check reads were found."""
    scene = next(one for one in report.scenes if one.name == name)
    loads = [load for load in scene.loads if load.info.name in judgement.loads]
    return ", ".join(dict.fromkeys(f"{_level(scene, load.solver)}: {load.solver}" for load in loads))


def _findings(report: FileReport, source: Source) -> list[Entry]:
    return [
        {
            "severity": one.severity.value,
            "code": one.code,
            "line": one.span.line if one.span else "",
            "linked": source.whole and one.span is not None and one.span.line <= len(source.lines),
            "message": one.message,
            "hint": one.hint,
        }
        for one in sorted(report.diagnostics, key=lambda one: -one.severity.rank)
    ]


# -- loads ----------------------------------------------------------------------------------------------------------


def _level(scene: SceneReport, solver: str) -> str:
    return next((one.fidelity for one in scene.solvers if one.name == solver), "")


def _told_scenes(report: FileReport) -> list[SceneReport]:
    names = pick.loads(report)
    return [one for one in report.scenes if any(load.info.name in names for load in one.loads)]


def _governing(report: FileReport) -> list[Entry]:
    """Loads in rows under what they are, scenes in columns."""
    names, scenes = pick.loads(report), _told_scenes(report)
    own = [{load.info.name: load for load in scene.loads} for scene in scenes]
    infos = {load.info.name: load.info for scene in scenes for load in scene.loads if load.info.name in names}
    rows: dict[str, list[Entry]] = {title: [] for title in (*(title for title, _ in _GROUPS), _OTHERS)}
    for info in infos.values():
        found = [(scene, loads.get(info.name)) for scene, loads in zip(scenes, own, strict=True)]
        unit = words.common_unit((load.estimate.value for _, load in found if load), info.quantity)
        cells = [_cell(scene, load, unit) if load else None for scene, load in found]
        rows[_group(info.quantity)].append({"title": info.title, "cells": cells})
    return [{"title": title, "rows": found} for title, found in rows.items() if found]


def _group(quantity: Quantity) -> str:
    return next((title for title, names in _GROUPS if quantity.name in names), _OTHERS)


def _cell(scene: SceneReport, load: LoadReport, unit: str) -> Entry:
    return {
        "value": _with_unit(words.amount(load.estimate, load.info.quantity, unit), load.estimate.value, unit),
        "level": f"{_level(scene, load.solver)}: {load.solver}",
        "textbook": _textbook(load, unit),
    }


def _with_unit(text: str, value: float, unit: str) -> str:
    return text if unit == "1" or not math.isfinite(value) else f"{text} {unit}"


def _textbook(load: LoadReport, unit: str) -> str:
    one = load.formula
    if one is None:
        return ""
    text = words.amount(Estimate.exact(one.value), load.info.quantity, unit)
    ratio = f", ×{one.ratio:.3f}" if one.ratio is not None else ""
    return _with_unit(text, one.value, unit) + ratio


def _tiles(report: FileReport) -> list[Entry]:
    """The numbers a designer asks for first: of each load that governs, its worst scene."""
    names = pick.loads(report)
    found: dict[str, tuple[SceneReport, LoadReport]] = {}
    for scene in report.scenes:
        for load in scene.loads:
            if load.info.name not in names or not load.info.governing or not math.isfinite(load.estimate.value):
                continue
            known = found.get(load.info.name)
            if known is None or _worse(load, known[1]):
                found[load.info.name] = scene, load
    return [
        {
            "title": load.info.title,
            "value": words.amount(load.estimate, load.info.quantity),
            "scene": scene.name,
            "level": f"{_level(scene, load.solver)}: {load.solver}",
        }
        for scene, load in list(found.values())[:_TILES]
    ]


_SMALL = ("safety", "reserve", "_min")


def _worse(load: LoadReport, other: LoadReport) -> bool:
    """Of safeties, reserves and smallest values the smaller one is the worse, of all others the larger."""
    new, old = load.estimate.value, other.estimate.value
    return new < old if any(word in load.info.name for word in _SMALL) else abs(new) > abs(old)


def _interval(estimate: Estimate, quantity: Quantity) -> str:
    """Between which numbers a load lies."""
    if estimate.low == estimate.high:
        return "exact for its level"
    if not estimate.bounded:
        return "no bound"
    low, high = (words.number(end, quantity) for end in (estimate.low, estimate.high))
    return f"{low} to {high}" if low != high else "narrower than its digits"


def _load(number: int, scene: SceneReport, load: LoadReport) -> Entry:
    estimate, quantity = load.estimate, load.info.quantity
    unit = words.common_unit([estimate.value], quantity)
    return {
        "title": load.info.title,
        "name": load.info.name,
        "value": words.number(estimate.value, quantity),
        "interval": _interval(estimate, quantity),
        "level": _level(scene, load.solver),
        "solver": load.solver,
        "anchor": f"solver-{number}-{load.solver}",
        "where": _where(load.at, load.window),
        "textbook": "; ".join(
            f"{one.name}: {_with_unit(words.amount(Estimate.exact(one.value), quantity, unit), one.value, unit)}"
            + (f", ×{one.ratio:.3f}" if one.ratio is not None else "")
            for one in load.formulas
        ),
        "note": load.note,
    }


_AT = {"time": "s", "position": "m", "angle": "rad", "pitch": "m"}


def _where(at: Mapping[str, float], window: tuple[float, float] | None) -> str:
    parts = [f"{name} {digits(value)} {_AT.get(name, '')}".rstrip() for name, value in at.items()]
    if window:
        parts.append(f"in {show(window[1] - window[0], TIME)}")
    return ", ".join(parts)


def told(ones: Iterable[Told]) -> list[str]:
    """The numbers of a figure with their units, and by what, at which level and after which source they were found."""
    found: dict[tuple[str, str, str], dict[str, None]] = {}
    for one in ones:
        number = words.amount(one.estimate, one.quantity)
        found.setdefault((one.level, one.solver, one.source), {})[f"{one.title} {number}"] = None
    return [f"{'; '.join(numbers)}: {level}, {solver}; {source}" for (level, solver, source), numbers in found.items()]


# -- what was computed ----------------------------------------------------------------------------------------------


def _effect(effect: EffectReport) -> Entry:
    number, change = effect.criterion, effect.change
    state = effect.state.value + (" (forced)" if effect.forced else "")
    if number is None and effect.state is EffectState.SKIPPED and not effect.forced:
        state = "not assessed (input missing)"
    changed = ""
    if change is not None:
        within = "" if change.clear else ", within the bars"
        changed = f"{change.load} {100 * change.relative:+.2g} %{within}" if change.visible else "no change"
    relation = "≥" if number and number.exceeded else "<"
    value = "" if number is None else digits(number.value, 3) if math.isfinite(number.value) else "unlimited"
    return {
        "name": effect.name,
        "title": effect.title,
        "state": state,
        "number": f"{number.symbol} = {value}" if number else "",
        "threshold": f"{relation} {digits(number.threshold, 3)}" if number else "",
        "says": "; ".join(filter(None, (number.meaning if number else "", effect.note))),
        "source": number.source if number else "",
        "change": changed,
    }


def _solvers(number: int, scene: SceneReport) -> Entry:
    sources = {load.solver: load.source for load in scene.loads}
    seen: set[str] = set()
    rows = []
    for one in scene.solvers:
        anchor = "" if one.name in seen else f"solver-{number}-{one.name}"
        seen.add(one.name)
        rows.append(
            {
                "anchor": anchor,
                "name": one.name,
                "level": one.fidelity,
                "decides": "yes" if one.decides else "shown only",
                "effects": ", ".join(scene.simulated(one)) if one.decides else "",
                "work": one.work,
                "predicted": show(one.predicted_seconds, TIME, 2) if one.decides else "",
                "next": words.priced(one.next) if one.next else "",
                "source": sources.get(one.name, ""),
            }
        )
    residual = words.balance(scene)
    balance = words.closing(residual) if residual is not None else ""
    return {"name": scene.name, "rows": rows, "balance": balance}


def _tables(report: FileReport) -> Iterator[Entry]:
    for number, table in enumerate(report.tables, 1):
        yield {
            "id": f"table-{number}",
            "title": table.title,
            "columns": [column.heading or column.key.replace("_", " ") for column in table.columns],
            "rows": [[cell(one) for one in row] for row in table.rows],
            "notes": table.notes,
        }


# -- the index ------------------------------------------------------------------------------------------------------


def row(report: FileReport, page: str) -> Entry:
    """A file in the index."""
    scene, worst = next(iter(words.worst_first(report)), ("", None))
    totals = count([report])
    entry: Entry = {
        "rank": ["invalid", "fail", "undecided", "pass"].index(report.verdict),
        "verdict": report.verdict,
        "path": report.path,
        "page": page,
        "kind": report.kind,
        "name": report.name,
        "scene": scene,
        "passed": totals["pass"],
        "others": sum(totals[key] for key in ("fail", "undecided", "not_checked", "waived", "off")),
    }
    if worst is None:
        said = next((d for d in report.diagnostics if d.severity is Severity.ERROR), None)
        return (
            entry
            | dict.fromkeys(("value", "limit", "margin", "value_sort", "limit_sort", "margin_sort"), "")
            | {
                "governs": f"{said.code} {said.message}" if said else "",
                "closeness": -math.inf,
            }
        )
    relative = words.relative_margin(worst)
    return entry | {
        "governs": f"{worst.code} {words.subject(worst)}",
        "value": words.value(worst),
        "limit": f"{_SIGN[worst.sense]} {words.amount(worst.limit, worst.quantity)}" if worst.limit else "",
        "margin": words.margin(worst),
        "value_sort": _sortable(worst.value),
        "limit_sort": _sortable(worst.limit),
        "margin_sort": f"{relative:.6g}" if math.isfinite(relative) else "",
        "closeness": relative,
    }


def _sortable(estimate: Estimate | None) -> str:
    return f"{estimate.value:.6g}" if estimate is not None and math.isfinite(estimate.value) else ""


def worst_first(rows: Iterable[Entry]) -> list[Entry]:
    """The files of an index."""
    return sorted(rows, key=lambda one: (one["rank"], one["closeness"], one["path"]))


def parts_of(view: Mapping[str, Any]) -> Sequence[tuple[str, str]]:
    """What can be gone to on a page."""
    named = (
        ("findings", "findings", "Findings"),
        ("governing", "summary", "Governing loads"),
        ("checks", "checks", "Checks"),
        ("pictures", "figures", "Figures"),
        ("tables", "tables", "Tables"),
        ("effects", "effects", "Effects"),
        ("loads", "loads", "All loads"),
        ("solvers", "solvers", "Solvers and sources"),
        ("assumed", "assumed", "Assumed"),
        ("file_lines", "file", "Design file"),
    )
    return [("verdict", "Verdict"), *((anchor, title) for key, anchor, title in named if view.get(key))]
