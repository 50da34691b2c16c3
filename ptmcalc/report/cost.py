"""Cost of accuracy as text: a table, JSON, one sentence, and the table of all design files."""

import math
import os
from collections.abc import Iterable, Iterator, Sequence
from os.path import commonpath, relpath
from typing import Any

from ptmcalc.base.units import TIME, digits, show
from ptmcalc.contract.cost import Choice, CostReport, Held, LoadCost, Outcome, Role, Setting, total
from ptmcalc.report import json, words
from ptmcalc.report.drawing import wrapped
from ptmcalc.report.markdown import code
from ptmcalc.report.table import listing

MARGINS = "margins"
_COLUMNS = ("", "setting", "time", "plan", "true error", "bar", "held", "by")
_LEGEND = (
    "* no faster setting proves the same accuracy; o no faster setting has the same true error. The error is the"
    " largest relative error of the governing loads, compared with the setting `by` of another method (-: there is"
    " none); `≤` if that setting is not more accurate; held: whether the error bars cover the errors, open if"
    " unknown. all: with every effect that the solver can simulate, otherwise with those that the scene requires;"
    " f: formula, shown only; w: reference method, never planned."
)


def table(report: CostReport, width: int) -> str:
    """Every setting scene by scene, what to choose, and the sentence."""
    parts = [f"{words.printable(report.path)}  {report.kind}\n"]
    for scene in report.scenes:
        settings = report.of_scene(scene)
        parts += [f"\n{words.printable(scene)}\n", listing(_COLUMNS, _rows(settings), width=width)]
        parts += [f"{_flowed(note, width)}\n" for note in _notes(settings)]
    parts += [f"\n{_flowed(_LEGEND, width)}\n\nThe fastest settings whose bars prove it\n"]
    parts += [listing(("scene", "for", "settings", "time"), _chosen(report), width=width)]
    parts += [f"\n{_flowed(conclusion(report), width)}\n"]
    return "".join(parts)


def _flowed(text: str, width: int) -> str:
    return wrapped(words.printable(text), width)


def _rows(settings: Sequence[Setting]) -> Iterator[tuple[str, ...]]:
    """The settings, numbered so that another one can name them."""
    numbers = {one.name: str(k) for k, one in enumerate(settings, 1)}
    for one in settings:
        mark = f"{numbers[one.name]}{'*' * one.front_of_bars}{'o' * one.front_of_errors}"
        name = one.name + {Role.FORMULA: " f", Role.REFERENCE: " w"}.get(one.role, "")
        predicted = seconds(one.predicted_seconds)
        if one.outcome is not Outcome.MEASURED:
            yield (mark, name, one.outcome.value.replace("_", " "), predicted, "", "", "", "")
            continue
        by = numbers[one.references[0]] if one.references else "-" if one.loads else ""
        yield (mark, name, seconds(one.seconds), predicted, _error(one), _bar(one), _held(one), by)


def _notes(settings: Sequence[Setting]) -> Iterator[str]:
    for one in settings:
        if one.outcome is not Outcome.MEASURED:
            yield f"  {one.name} {one.outcome.value.replace('_', ' ')}: {one.reason}"


def seconds(value: float | None) -> str:
    """A time with two digits."""
    return "" if value is None else show(value, TIME, 2)


def share(value: float) -> str:
    """A relative error with two digits: `1.3 %`, `2e-6 %`."""
    if value == 0:
        return "0"
    return f"{digits(100 * value, 2)} %" if value >= 1e-6 else f"{100 * value:.0e} %"


def _error(one: Setting) -> str:
    worst = one.worst
    if worst is None or worst.error is None or worst.at_most is None:
        return ""
    return share(worst.error) if worst.resolved else f"≤ {share(worst.at_most)}"


def _bar(one: Setting) -> str:
    if one.role is Role.FORMULA or one.bar is None:
        return ""
    return share(one.bar) if math.isfinite(one.bar) else "∞"


def _held(one: Setting) -> str:
    return {Held.YES: "yes", Held.NO: "NO", Held.OPEN: "open", None: ""}[one.held]


def _chosen(report: CostReport) -> Iterator[tuple[str, ...]]:
    """What to choose; targets that one answer serves stand together."""
    answers: dict[tuple[str, ...], list[str]] = {}
    for choice in report.choices:
        answers.setdefault((choice.scene, *_answer(choice)), []).append(choice.target)
    for (scene, settings, price), targets in answers.items():
        named = ["this file's margins" if one == MARGINS else one for one in targets]
        yield scene, ", ".join(named), settings, price


def _answer(choice: Choice) -> tuple[str, str]:
    if not choice.reached:
        return f"not reached: {_listed(choice.missing)}", ""
    if not choice.settings:
        return "nothing to decide", ""
    return ", ".join(choice.settings), seconds(choice.seconds)


def _listed(names: Sequence[str], most: int = 2) -> str:
    """The first names, and how many more."""
    names = tuple(dict.fromkeys(names))
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(names[:most]) + more


# -- the sentence ----------------------------------------------------------------------------------------------------


def conclusion(report: CostReport) -> str:
    """One sentence: what this file's margins ask for, what each accuracy costs, and whether the bars hold."""
    parts = [_of_margins(report)]
    parts += [_of_accuracy(report, target) for target in report.targets if target != MARGINS]
    parts.append(_of_bars(report.settings))
    left = [one for one in report.settings if one.outcome is Outcome.NOT_RUN and one.role is not Role.REFERENCE]
    failed = [one for one in report.settings if one.outcome is Outcome.FAILED]
    if failed:
        parts.append(f"{_counted(len(failed), 'setting')} failed")
    if left:
        price = seconds(sum(one.predicted_seconds for one in left))
        parts.append(f"{_counted(len(left), 'setting')} beyond the budget would take {price}")
    return "; ".join(parts) + "."


def _of_margins(report: CostReport) -> str:
    choices = report.chosen(MARGINS)
    open_ = [one for one in choices if not one.reached]
    if open_:
        codes = _listed([code for one in open_ for code in one.missing])
        return f"Nothing that ran decides {codes} in {_listed([one.scene for one in open_])}"
    solvers = dict.fromkeys(name.split()[0] for one in choices for name in one.settings)
    if not solvers:
        return "There is nothing to decide"
    near = (
        f" (the closest, {report.closest[0]}, {share(abs(report.closest[1]))} from its limit)" if report.closest else ""
    )
    price = seconds(total(one.seconds for one in choices))
    return f"Every check of this file{near} is decided in {price} by {', '.join(solvers)}"


def _of_accuracy(report: CostReport, target: str) -> str:
    choices = report.chosen(target)
    short = [one for one in choices if not one.reached]
    if not short:
        return f"{target} costs {seconds(total(one.seconds for one in choices))}"
    bar, load = max(_best_bar(report, one, name) for one in short for name in one.missing)
    how = f"no bar of {load} below {share(bar)}" if math.isfinite(bar) else f"no bound of {load}"
    return f"{target} cannot be reached in {_listed([one.scene for one in short])} ({how})"


def _best_bar(report: CostReport, choice: Choice, name: str) -> tuple[float, str]:
    """The narrowest bar of a load that a choice lacks, and its name."""
    bars = [
        math.inf if load.bar is None else load.bar
        for one in report.of_scene(choice.scene)
        if one.role is Role.LADDER
        for load in one.loads
        if load.name == name
    ]
    return min(bars, default=math.inf), name


def _of_bars(settings: Sequence[Setting]) -> str:
    """How many of the bars that could be held against another method cover the error, and how many could not."""
    said = [one.held for one in settings if one.held is not None]
    alone = sum(
        one.held is None and bool(one.loads) and one.role is Role.LADDER and not one.references for one in settings
    )
    parts = []
    if said:
        parts.append(f"{said.count(Held.YES)} of {len(said)} compared settings cover the true error with their bars")
    if said.count(Held.OPEN):
        parts.append(f"{said.count(Held.OPEN)} are known closer than by any other method")
    if said.count(Held.NO):
        parts.append(f"{said.count(Held.NO)} DO NOT")
    if alone:
        parts.append(f"for {alone} there is no other method")
    return ", ".join(parts) or "there is no other method to hold them against"


def _counted(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"


# -- JSON ------------------------------------------------------------------------------------------------------------


def document(reports: Sequence[CostReport]) -> str:
    """The JSON of `cost`."""
    several = len(reports) > 1
    sentences = [f"{one.path}: {conclusion(one)}" if several else conclusion(one) for one in reports]
    return json.dump(
        {
            "schema_version": json.SCHEMA_VERSION,
            "rows": [_row(report, one) for report in reports for one in report.settings],
            "choices": [_choice(report, one) for report in reports for one in report.choices],
            "conclusion": " ".join(sentences),
        }
    )


def _row(report: CostReport, one: Setting) -> dict[str, Any]:
    worst = one.worst
    return {
        "path": report.path,
        "scene": one.scene,
        "setting": one.name,
        "solver": one.solver,
        "method": one.method,
        "fidelity": one.fidelity,
        "role": one.role.value,
        "effects": list(one.effects),
        "level": one.level,
        "outcome": one.outcome.value,
        "reason": one.reason,
        "seconds": one.seconds,
        "predicted_seconds": one.predicted_seconds,
        "runs": one.runs,
        "work": one.work,
        "bar": json.finite(one.bar),
        "true_error": json.finite(worst.error) if worst else None,
        "true_error_at_most": json.finite(worst.at_most) if worst else None,
        "worst_load": worst.name if worst else None,
        "covered": one.held.value if one.held else None,
        "reference": one.references[0] if one.references else None,
        "pareto": {"bar": one.front_of_bars, "true_error": one.front_of_errors},
        "loads": [_load(load) for load in one.loads],
    }


def _load(load: LoadCost) -> dict[str, Any]:
    return {
        "name": load.name,
        "value": json.finite(load.value),
        "bar": load.bar,
        "reference": load.reference or None,
        "reference_value": json.finite(load.reference_value),
        "true_error": json.finite(load.error),
        "resolution": json.finite(load.resolution),
        "covered": load.held.value if load.held else None,
    }


def _choice(report: CostReport, one: Choice) -> dict[str, Any]:
    return {
        "path": report.path,
        "scene": one.scene,
        "target": one.target,
        "accuracy": one.accuracy,
        "reached": one.reached,
        "settings": list(one.settings),
        "seconds": one.seconds,
        "missing": list(one.missing),
    }


# -- all files -------------------------------------------------------------------------------------------------------


def summary(reports: Sequence[CostReport]) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    """Columns and rows of the project's own table, a file a row."""
    shared = [one for one in reports[0].targets if all(one in report.targets for report in reports)]
    targets = [one for one in shared if one != MARGINS]  # not the accuracy that one file asks for
    columns = ("file", "kind", "its margins", *targets, "confirmed bars")
    return columns, [(report.path, report.kind, *_summed(report, targets)) for report in reports]


def _summed(report: CostReport, targets: Iterable[str]) -> Iterator[str]:
    for target in (MARGINS, *targets):
        yield _price(report.chosen(target))
    said = [one.held for one in report.settings if one.held is not None]
    known = len(said) - said.count(Held.OPEN)
    yield f"{said.count(Held.YES)} of {known}" if known else "-"


def _price(choices: Sequence[Choice]) -> str:
    """Seconds of the scenes that reach it, and of how many that is where some do not: `31 ms (3/4)`."""
    reached = sum(one.reached for one in choices)
    if not reached:
        return "-"
    price = seconds(total(one.seconds for one in choices))
    return price if reached == len(choices) else f"{price} ({reached}/{len(choices)})"


def markdown(reports: Sequence[CostReport]) -> str:
    """The project's own table as the README keeps it."""
    columns, rows = summary(reports)
    lines = [columns, ["---"] * len(columns), *([code(words.printable(row[0])), *row[1:]] for row in rows)]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def overview(reports: Sequence[CostReport], width: int) -> str:
    """The project's own table on a terminal, paths from the folder they share."""
    columns, rows = summary(reports)
    shared = commonpath([os.path.dirname(one.path) for one in reports])
    short = [(relpath(row[0], shared) if shared else row[0], *row[1:]) for row in rows]
    return (f"in {words.printable(shared)}\n" if shared else "") + listing(columns, short, width=width)
