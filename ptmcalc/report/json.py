"""The JSON of `check`: a fixed contract that other tools read."""

import json
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import cache
from typing import Any

from ptmcalc import __version__
from ptmcalc.base.diagnostic import Diagnostic
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.units import ANGULAR_SPEED, TIME, Quantity
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.report import (
    Amount,
    AssumedReport,
    Cell,
    EffectReport,
    FileReport,
    Judgement,
    LoadReport,
    Place,
    SceneReport,
    SolverReport,
    TableReport,
    count,
)
from ptmcalc.contract.result import History

SCHEMA_VERSION = "1"


_ONE_LINE = json.JSONEncoder(ensure_ascii=False, allow_nan=False, check_circular=False)


def _harmless(text: str) -> str:
    """JSON in which no CI server that reads the log finds a command of its own: `##[...]`."""
    return text.replace("##", "#\\u0023")


def line(value: Any) -> str:
    """JSON on one line."""
    return _harmless(_ONE_LINE.encode(value))


def render(reports: Iterable[FileReport], *, width: int, color: bool, verbose: bool = False) -> str:
    """The document; the same reports give the same bytes."""
    reports = tuple(reports)
    return "".join(pieces(count(reports), ((report.path, part_of(report)) for report in reports)))


@dataclass(frozen=True, slots=True)
class RunInfo:
    """What the document says of the run: which part of it this is, if not the whole, how many files all parts together
    have, what the exit status counts, how many files were left out of folders, and whether it came to its end."""

    shard: str | None = None
    files: int = 0
    fail_level: str = "error"
    left_out: int = 0
    complete: bool = True


def pieces(summary: Mapping[str, int], files: Iterable[tuple[str, str]], run: RunInfo | None = None) -> Iterator[str]:
    """The document bit by bit, of files as their paths and parts."""
    yield f'{{\n "schema_version": {line(SCHEMA_VERSION)},\n'
    yield f' "tool": {line({"name": "ptmcalc", "version": __version__})},\n'
    if run is not None:
        yield f' "run": {line(asdict(run))},\n'
    yield f' "summary": {line(summary)},\n "files": ['
    before = "\n"
    for path, part in files:
        yield f'{before}  {{"path": {line(path)},\n'
        yield part
        before = ",\n"
    yield "]}\n"


def part_of(report: FileReport) -> str:
    """What the document says of one file behind its path."""
    return part(_file(report))


def part(entry: Mapping[str, Any]) -> str:
    """A line for each diagnostic, assumption, effect, solver, load, check: to be read, and compared line by line."""
    one_line = _ONE_LINE.encode
    lines = [f'   "{key}": {one_line(value)}' for key, value in entry.items() if not isinstance(value, list)]
    for key, value in entry.items():
        if key == "scenes":
            lines.append(f'   "scenes": {_list([_scene_text(scene) for scene in value], 3)}')
        elif isinstance(value, list):
            lines.append(f'   "{key}": {_list([one_line(one) for one in value], 3)}')
    return _harmless(",\n".join(lines) + "}")


def _scene_text(scene: Mapping[str, Any]) -> str:
    one_line = _ONE_LINE.encode
    lines = [
        f'"{key}": ' + (_list([one_line(one) for one in value], 5) if isinstance(value, list) else one_line(value))
        for key, value in scene.items()
    ]
    return "{" + ",\n     ".join(lines) + "}"


def _list(items: Sequence[str], indent: int) -> str:
    """A list of which each item begins a line."""
    space = "\n" + " " * (indent + 1)
    return "[" + ",".join(space + item for item in items) + "]"


def rows(found: list[dict[str, Any]]) -> str:
    """The JSON of the commands that answer with rows."""
    return dump({"schema_version": SCHEMA_VERSION, "rows": found})


def dump(document: Mapping[str, Any]) -> str:
    """JSON text without NaN and Infinity."""
    return _harmless(json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False)) + "\n"


def finite(value: float | None) -> float | None:
    """A float, or null where there is no finite one."""
    return float(value) if value is not None and math.isfinite(value) else None


def _file(report: FileReport) -> dict[str, Any]:
    return {
        "kind": report.kind,
        "name": report.name,
        "verdict": report.verdict,
        "assumed": [_assumed(value) for value in report.assumed],
        "diagnostics": [_diagnostic(diagnostic) for diagnostic in report.diagnostics],
        "scenes": [_scene(scene) for scene in report.scenes],
        **({"tables": [_table(table) for table in report.tables]} if report.tables else {}),
        **({"ignored": report.ignored} if report.ignored else {}),
        **({"ignored_checks": report.ignored_checks} if report.ignored_checks else {}),
        **({} if report.computed else {"computed": False}),
        **({"project": dict(report.project)} if report.project else {}),
    }


def _table(table: TableReport) -> dict[str, Any]:
    """Its rows by the keys of its columns."""
    keys = [column.key for column in table.columns]
    return {
        "name": table.name,
        "title": table.title,
        "rows": [dict(zip(keys, map(_cell, row), strict=True)) for row in table.rows],
        "notes": list(table.notes),
    }


def _cell(cell: Cell) -> Any:
    if isinstance(cell, Amount):
        return {**_estimate(cell.estimate), "unit": cell.quantity.si}
    return list(cell) if isinstance(cell, tuple) else cell or None


def _assumed(value: AssumedReport) -> dict[str, Any]:
    return {
        "path": list(value.path),
        "value": value.value,
        "unit": value.quantity.si,
        "interval": [value.interval.low, value.interval.high],
        "source": value.source,
    }


def _diagnostic(diagnostic: Diagnostic) -> dict[str, Any]:
    return {
        "code": diagnostic.code,
        "severity": diagnostic.severity.value,
        "message": diagnostic.message,
        "line": diagnostic.span.line if diagnostic.span else None,
        "column": diagnostic.span.column if diagnostic.span else None,
        "path": list(diagnostic.path),
        "hint": diagnostic.hint,
    }


def _scene(scene: SceneReport) -> dict[str, Any]:
    return {
        "name": scene.name,
        "type": scene.type,
        "effects": [_effect(effect) for effect in scene.effects],
        "solvers": [_solver(solver) for solver in scene.solvers],
        "loads": [_load(load) for load in scene.loads],
        "checks": [_check(judgement) for judgement in scene.checks],
        "events": [
            {"time": event.time, "element": event.element, "from": event.before, "to": event.after}
            for event in scene.events
        ],
        "health": {name: finite(value) for name, value in scene.health.items()},
    }


def _effect(effect: EffectReport) -> dict[str, Any]:
    entry: dict[str, Any] = {
        "name": effect.name,
        "state": effect.state.value,
        "forced": effect.forced,
        "criterion": criterion(effect.criterion),
    }
    if effect.note:
        entry["note"] = effect.note
    if effect.absent:
        entry["absent"] = True
    if effect.change:
        entry["change_without"] = {"load": effect.change.load, "relative": effect.change.relative}
    return entry


def criterion(number: Criterion | None) -> dict[str, Any] | None:
    """The number that decided about an effect."""
    if number is None:
        return None
    return {
        "symbol": number.symbol,
        "value": finite(number.value),
        "threshold": number.threshold,
        "meaning": number.meaning,
        "source": number.source,
    }


def _solver(solver: SolverReport) -> dict[str, Any]:
    following = solver.next
    return {
        "name": solver.name,
        "fidelity": solver.fidelity,
        "effects": list(solver.effects),
        "predicted_seconds": solver.predicted_seconds,
        "work": solver.work,
        "decides": solver.decides,
        "next": {"name": following.name, "predicted_seconds": following.predicted_seconds} if following else None,
    }


@cache
def _unit(quantity: Quantity) -> dict[str, str]:
    """The SI unit; of a rotational speed, whose unit may also be that of a frequency, what people read it in."""
    shown_in = {"shown_in": quantity.display[0]} if quantity.dimension == ANGULAR_SPEED.dimension else {}
    return {"unit": quantity.si} | {key: unit for key, unit in shown_in.items() if unit != quantity.si}


def _estimate(estimate: Estimate) -> dict[str, Any]:
    if estimate.bounded:
        return {"value": float(estimate.value), "low": float(estimate.low), "high": float(estimate.high)}
    entry: dict[str, Any] = {
        "value": finite(estimate.value),
        "low": finite(estimate.low),
        "high": finite(estimate.high),
    }
    if None in entry.values():
        entry["unbounded"] = True
    return entry


def _history(history: History) -> dict[str, Any]:
    """Over time, or over another quantity, which is named and has its unit."""
    values: dict[str, Any] = {"value": [finite(value) for value in history.values], "unit": history.quantity.si}
    if history.over == TIME:
        return {"t": list(history.times)} | values
    return {history.over.name: list(history.times), f"{history.over.name}_unit": history.over.si} | values


def _load(load: LoadReport) -> dict[str, Any]:
    entry = {
        "name": load.info.name,
        **_estimate(load.estimate),
        **_unit(load.info.quantity),
        "numerical_error": finite(load.estimate.numerical),
        "model_error": finite(load.estimate.model),
        "solver": load.solver,
        "source": load.source,
        "at": dict(load.at),
    }
    if load.window:
        entry["window"] = list(load.window)
    if load.history:
        entry["history"] = _history(load.history)
    if load.note:
        entry["note"] = load.note
    if load.formulas:
        formulas = [{"name": one.name, "value": finite(one.value), "ratio": finite(one.ratio)} for one in load.formulas]
        entry["formula"] = formulas[-1]
        if len(formulas) > 1:
            entry["formulas"] = formulas
    return entry


def _place(place: Place) -> dict[str, Any]:
    return {"path": list(place.path), "line": place.span.line, "column": place.span.column}


def _check(judgement: Judgement) -> dict[str, Any]:
    value, limit, repair = judgement.value, judgement.limit, judgement.repair
    entry: dict[str, Any] = {
        "code": judgement.code,
        "title": judgement.title,
        "verdict": judgement.verdict.value,
        "value": finite(value.value) if value else None,
        "low": finite(value.low) if value else None,
        "high": finite(value.high) if value else None,
        "limit": finite(limit.value) if limit else None,
        "sense": judgement.sense.value,
        **_unit(judgement.quantity),
        "margin": finite(judgement.margin),
        "blame": _place(judgement.blame),
    }
    if value and not math.isfinite(value.value):
        entry["unbounded"] = True
    if judgement.hazard:
        entry["hazard"] = True
    if judgement.element:
        entry["element"] = judgement.element
    if judgement.meaning:
        entry["meaning"] = judgement.meaning
    if judgement.reason:
        entry["reason"] = judgement.reason
    if judgement.without:
        entry["without"] = list(judgement.without)
    if repair:
        entry["repair"] = {"path": list(repair.path), "value": finite(repair.value), **_unit(repair.quantity)}
        if repair.other is not None:
            entry["repair"]["other"] = finite(repair.other)
    if judgement.tried:
        entry["tried"] = judgement.tried
    return entry
