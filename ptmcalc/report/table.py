"""The report a designer reads on a terminal: loads by scene, checks worst first, then what was computed and why."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from io import StringIO

from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from ptmcalc.base.diagnostic import Severity, Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import dotted
from ptmcalc.base.units import TIME, digits, show
from ptmcalc.contract.check import Sense
from ptmcalc.contract.report import EffectReport, FileReport, LoadReport, SceneReport, SolverReport, count
from ptmcalc.contract.result import LoadInfo
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
_GAP = 3
_MOST_EVENTS = 30
_SIGN = {Sense.AT_LEAST: "≥", Sense.AT_MOST: "≤"}


def render(reports: tuple[FileReport, ...], *, width: int, color: bool) -> str:
    """The tables of all files, and a summary line."""

    def write(console: Console) -> None:
        for report in words.printable(reports):
            _file(console, report)
        console.print(words.summary(count(reports)))

    return _printed(write, width, color)


def listing(columns: Sequence[str], rows: Iterable[Sequence[str]], *, width: int) -> str:
    """A plain table of texts, for the commands that list things."""
    cells = words.printable([list(columns), *map(list, rows)])
    table = _table("")
    for column, wide in zip(columns, _widths(cells, width), strict=True):
        table.add_column(column, width=wide, overflow="fold")
    for row in cells[1:]:
        table.add_row(*row)
    return _printed(lambda console: console.print(table), width, color=False)


def _widths(cells: Sequence[Sequence[str]], width: int) -> list[int]:
    """Widths of columns that leave words whole as far as the screen allows, the rest where it saves most lines."""
    columns = list(zip(*cells, strict=True))
    widths = [max(len(word) for cell in column for word in (*cell.split(), "")) for column in columns]
    while sum(widths) + _GAP * len(widths) > width and max(widths) > 1:
        widths[widths.index(max(widths))] -= 1
    longest = [max(map(len, column)) for column in columns]
    while sum(widths) + _GAP * len(widths) < width:
        lines = [long / wide if long > wide else 0.0 for long, wide in zip(longest, widths, strict=True)]
        if not max(lines):
            break
        widths[lines.index(max(lines))] += 1
    return widths


def _printed(write: Callable[[Console], None], width: int, color: bool) -> str:
    """What is written to a console, without spaces at the ends of lines."""
    out = StringIO()
    write(Console(file=out, width=width, force_terminal=color, no_color=not color, highlight=False))
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
        _events(console, report.scenes)
        _solvers(console, report.scenes)
    _assumed(console, report)
    _health(console, report.scenes)


def _table(title: str, *columns: str) -> Table:
    table = Table(title=title or None, title_justify="left", title_style="bold", box=box.SIMPLE_HEAD, pad_edge=False)
    for column in columns:
        table.add_column(column, overflow="fold")
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
    """Loads in rows, scenes in columns; the textbook's value with its ratio beside a simulated one. As many scenes
    stand side by side as fit, and a row is there only where one of them has it."""
    loads = [{load.info.name: load for load in scene.loads} for scene in scenes]
    fullest_first = sorted(scenes, key=lambda scene: -len(scene.loads))
    infos = list(dict.fromkeys(load.info for scene in fullest_first for load in scene.loads if load.info.headline))
    units = {
        info.name: words.common_unit(
            (own[info.name].estimate.value for own in loads if info.name in own), info.quantity
        )
        for info in infos
    }
    columns = [_columns(scene, own, infos, units) for scene, own in zip(scenes, loads, strict=True)]
    labels = min(max((len(info.title) + len(units[info.name]) for info in infos), default=0) + 2 * _GAP, _LABELS)
    title = "Loads"
    for group in _side_by_side([sum(map(_width, part)) for part in columns], console.width - labels):
        shown = [column for index in group for column in columns[index]]
        table = _table(title)
        table.add_column("", overflow="fold")
        table.add_column("")
        for name, style, _ in shown:
            table.add_column(name, justify="right", overflow="fold", style=style)
        for row, info in enumerate(infos):
            if any(cells[row] for _, _, cells in shown):
                unit = units[info.name].removeprefix("1")
                table.add_row(info.title, unit, *(cells[row] for _, _, cells in shown))
        console.print(table)
        title = ""


_Column = tuple[str, str, list[str]]
"""Heading, style, cells."""
_LABELS = 32
"""Width that the titles of loads are given at most before scenes have to part; longer ones go on in a second line."""


def _columns(
    scene: SceneReport, own: Mapping[str, LoadReport], infos: Sequence[LoadInfo], units: Mapping[str, str]
) -> list[_Column]:
    """The columns of one scene: its values, and the textbook's where there are any."""
    found = [own.get(info.name) for info in infos]
    values = [words.amount(load.estimate, load.info.quantity, units[load.info.name]) if load else "" for load in found]
    columns = [(scene.name, "", values)]
    if any(load.formula for load in scene.loads):
        columns.append(("textbook", "dim", [_formula(load, units[load.info.name]) if load else "" for load in found]))
    return columns


def _width(column: _Column) -> int:
    heading, _, cells = column
    return max(len(heading), *map(len, cells), 0) + _GAP


def _side_by_side(widths: Sequence[int], room: int) -> Iterator[list[int]]:
    """Columns in groups that fit into so much room, at least one in each."""
    group: list[int] = []
    for index, width in enumerate(widths):
        if group and sum(widths[one] for one in group) + width > room:
            yield group
            group = []
        group.append(index)
    yield group


def _formula(load: LoadReport | None, unit: str) -> str:
    if load is None or load.formula is None:
        return ""
    ratio = f" ×{load.formula.ratio:.3f}" if load.formula.ratio is not None else ""
    return words.amount(Estimate.exact(load.formula.value), load.info.quantity, unit) + ratio


def _checks(console: Console, report: FileReport) -> None:
    """Verdicts in rows, the worst first; under them the key that governs each that is not sound, and the way out."""
    table = _table("Checks", "verdict", "check", "scene", "value", "limit", "margin")
    lines = []
    for scene, judgement in words.worst_first(report):
        verdict = Text(judgement.verdict.value.replace("_", " "), style=_STYLE[judgement.verdict.value])
        value = words.amount(judgement.value, judgement.quantity) if judgement.value else ""
        limit = (
            f"{_SIGN[judgement.sense]} {words.amount(judgement.limit, judgement.quantity)}" if judgement.limit else ""
        )
        title = f"{judgement.code} {words.subject(judgement)}"
        table.add_row(verdict, title, scene, value, limit, words.margin(judgement))
        remark = words.remark(judgement)
        name = " ".join(filter(None, (judgement.code, judgement.element, scene)))
        if judgement.verdict is not Verdict.PASS:
            place = f"{report.path}:{words.place(judgement.blame.span)}"
            governed = f" governed by {dotted(judgement.blame.path)} ({place})"
            lines.append(Text.assemble(verdict, f" {name}:{governed}{'; ' * bool(remark)}{remark}"))
        elif remark:
            lines.append(Text.assemble(verdict, f" {name}: {remark}"))
    console.print(table)
    for line in lines:
        console.print(line)
    if lines:
        console.print()


def _effects(console: Console, scenes: Iterable[SceneReport]) -> None:
    rows = [(scene.name, effect) for scene in scenes for effect in scene.effects]
    if not rows:
        return
    table = _table("Effects", "scene", "effect", "state", "number", "what it says", "without it")
    for scene, effect in rows:
        number = effect.criterion
        table.add_row(
            scene,
            effect.name,
            f"{effect.state.value}{' (forced)' if effect.forced else ''}",
            words.compared(number) if number else "",
            "; ".join(filter(None, (number.meaning if number else "", effect.note))),
            _change(effect),
        )
    console.print(table)


def _change(effect: EffectReport) -> str:
    if effect.change is None:
        return ""
    if abs(effect.change.relative) < _INVISIBLE:
        return "no change"
    return f"{effect.change.load} {100 * effect.change.relative:+.2g} %"


def _events(console: Console, scenes: tuple[SceneReport, ...]) -> None:
    """What changed its state and when, the first of each scene; the JSON has all."""
    if not any(scene.events for scene in scenes):
        return
    table = _table("Events", "scene", "time", "element", "from", "to")
    for scene in scenes:
        for event in scene.events[:_MOST_EVENTS]:
            table.add_row(scene.name, f"{digits(event.time, 5)} s", event.element, event.before, event.after)
        left = len(scene.events) - _MOST_EVENTS
        if left > 0:
            table.add_row(scene.name, f"... and {left} more")
    console.print(table)


def _solvers(console: Console, scenes: Iterable[SceneReport]) -> None:
    table = _table("Solvers", "scene", "solver", "effects carried", "work", "next would take")
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
    return f"{solver.next.name}, {show(solver.next.predicted_seconds, TIME, 2)}"


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
