"""The report a designer reads on a terminal: loads by scene, checks worst first, then what was computed and why."""

from collections.abc import Iterable
from io import StringIO

from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from ptmcalc.base.diagnostic import Severity, Verdict
from ptmcalc.base.span import dotted
from ptmcalc.base.units import TIME, digits
from ptmcalc.contract.check import Sense
from ptmcalc.contract.report import EffectReport, FileReport, LoadReport, SceneReport, SolverReport, count
from ptmcalc.report import words

_STYLE = {
    Verdict.FAIL.value: "bold red",
    Verdict.UNDECIDED.value: "yellow",
    Verdict.NOT_CHECKED.value: "yellow",
    Verdict.WAIVED.value: "cyan",
    Verdict.PASS.value: "green",
    "invalid": "bold red",
    Severity.ERROR.value: "bold red",
    Severity.WARNING.value: "yellow",
    Severity.NOTE.value: "cyan",
}
_INVISIBLE = 1e-6
_SIGN = {Sense.AT_LEAST: "≥", Sense.AT_MOST: "≤"}


def render(reports: tuple[FileReport, ...], *, width: int, color: bool) -> str:
    """The tables of all files, and a summary line."""
    out = StringIO()
    console = Console(file=out, width=width, force_terminal=color, no_color=not color, highlight=False)
    for report in reports:
        _file(console, report)
    console.print(words.summary(count(reports)))
    return "\n".join(line.rstrip() for line in out.getvalue().split("\n"))


def _file(console: Console, report: FileReport) -> None:
    title = Text(report.path, style="bold")
    for part in (report.kind, report.name):
        title.append(f"  {part}" if part else "", style="not bold")
    title.append("  ")
    title.append(report.verdict.upper(), style=_STYLE[report.verdict])
    console.print(title)
    console.print()
    _diagnostics(console, report)
    if report.scenes:
        _loads(console, report.scenes)
        _checks(console, report)
        _effects(console, report.scenes)
        _solvers(console, report.scenes)
    _assumed(console, report)
    _health(console, report.scenes)


def _table(title: str, *columns: str) -> Table:
    table = Table(title=title, title_justify="left", title_style="bold", box=box.SIMPLE_HEAD, pad_edge=False)
    for column in columns:
        table.add_column(column)
    return table


def _diagnostics(console: Console, report: FileReport) -> None:
    for diagnostic in report.diagnostics:
        line = Text(f"  {words.place(diagnostic.span)}  " if diagnostic.span else "  ")
        line.append(f"{diagnostic.severity.value} {diagnostic.code}", style=_STYLE[diagnostic.severity.value])
        line.append(f"  {diagnostic.message}")
        console.print(line)
        if diagnostic.hint:
            console.print(Text(f"        {diagnostic.hint}", style="italic"))
    if report.diagnostics:
        console.print()


def _loads(console: Console, scenes: tuple[SceneReport, ...]) -> None:
    """Loads in rows, scenes in columns; the textbook's value with its ratio beside a simulated one."""
    table = _table("Loads")
    table.add_column("", no_wrap=True)
    cells: list[dict[str, LoadReport]] = []
    textbook = [any(load.formula for load in scene.loads) for scene in scenes]
    for scene, has_formula in zip(scenes, textbook, strict=True):
        table.add_column(scene.name, justify="right")
        if has_formula:
            table.add_column("textbook", justify="right", style="dim")
        cells.append({load.info.name: load for load in scene.loads})
    fullest_first = sorted(scenes, key=lambda scene: -len(scene.loads))
    names = dict.fromkeys(load.info for scene in fullest_first for load in scene.loads if load.info.headline)
    for info in names:
        row = [info.title]
        for found, has_formula in zip(cells, textbook, strict=True):
            load = found.get(info.name)
            row.append(words.amount(load.estimate, info.quantity) if load else "")
            if has_formula:
                row.append(_formula(load))
        table.add_row(*row)
    console.print(table)


def _formula(load: LoadReport | None) -> str:
    if load is None or load.formula is None:
        return ""
    ratio = f"  ×{load.formula.ratio:.3f}" if load.formula.ratio is not None else ""
    return words.number(load.formula.value, load.info.quantity) + ratio


def _checks(console: Console, report: FileReport) -> None:
    table = _table("Checks", "verdict", "check", "scene", "value", "limit", "margin", "governed by", "would pass")
    for scene, judgement in words.worst_first(report):
        verdict = judgement.verdict.value
        value = words.amount(judgement.value, judgement.quantity) if judgement.value else ""
        limit = (
            f"{_SIGN[judgement.sense]} {words.amount(judgement.limit, judgement.quantity)}" if judgement.limit else ""
        )
        blame = f"{dotted(judgement.blame.path)} ({words.place(judgement.blame.span)})"
        remedy = words.repair(judgement) or judgement.reason
        if judgement.without:
            remedy = "; ".join(filter(None, (remedy, f"without {', '.join(judgement.without)}")))
        table.add_row(
            Text(verdict.replace("_", " "), style=_STYLE[verdict]),
            f"{judgement.code} {judgement.title}",
            scene,
            value,
            limit,
            words.margin(judgement),
            "" if judgement.verdict is Verdict.PASS else blame,
            remedy,
        )
    console.print(table)


def _effects(console: Console, scenes: Iterable[SceneReport]) -> None:
    rows = [(scene.name, effect) for scene in scenes for effect in scene.effects]
    if not rows:
        return
    table = _table("Effects", "scene", "effect", "state", "number", "threshold", "what it says", "without it")
    for scene, effect in rows:
        number = effect.criterion
        table.add_row(
            scene,
            effect.name,
            f"{effect.state.value}{' (forced)' if effect.forced else ''}",
            f"{number.symbol} = {digits(number.value, 3)}" if number else "",
            digits(number.threshold, 3) if number else "",
            number.meaning if number else effect.note,
            _change(effect),
        )
    console.print(table)


def _change(effect: EffectReport) -> str:
    if effect.change is None:
        return ""
    if abs(effect.change.relative) < _INVISIBLE:
        return "no change"
    return f"{effect.change.load} {100 * effect.change.relative:+.2g} %"


def _solvers(console: Console, scenes: Iterable[SceneReport]) -> None:
    table = _table("Solvers", "scene", "solver", "effects carried", "work", "next would be")
    for scene in scenes:
        for solver in scene.solvers:
            table.add_row(
                scene.name,
                solver.name if solver.decides else f"{solver.name} (shown only)",
                ", ".join(solver.effects) if solver.decides else "",
                str(solver.work),
                _next(solver),
            )
    console.print(table)


def _next(solver: SolverReport) -> str:
    if solver.next is None:
        return ""
    return f"{solver.next.name}, about {words.number(solver.next.predicted_seconds, TIME)}"


def _assumed(console: Console, report: FileReport) -> None:
    if not report.assumed:
        return
    table = _table("Assumed: the file does not say", "key", "value", "may be", "source")
    for value in report.assumed:
        low, high = (words.number(end, value.quantity) for end in (value.interval.low, value.interval.high))
        table.add_row(dotted(value.path), words.number(value.value, value.quantity), f"{low} to {high}", value.source)
    console.print(table)


def _health(console: Console, scenes: Iterable[SceneReport]) -> None:
    for scene in scenes:
        residual = scene.health.get("energy_residual")
        if residual is not None:
            steps = int(scene.health.get("steps", 0))
            console.print(f"{scene.name}: work balance closes to {residual:.1e}, {steps} steps", style="dim")
    console.print()
