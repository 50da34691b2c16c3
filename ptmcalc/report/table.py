"""The report a designer reads on a terminal: loads by scene, checks worst first, then what was computed and why.

The short one fits one screen and begins with the checks where one of them is not passed; the whole one shows all.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence

from rich.console import Console
from rich.text import Text

from ptmcalc.base.diagnostic import Diagnostic, Severity, Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import dotted
from ptmcalc.contract.report import FileReport, Judgement, LoadReport, SceneReport, count
from ptmcalc.contract.result import LoadInfo
from ptmcalc.report import details, ledger, pick, tables, words
from ptmcalc.report.drawing import GAP, STYLE, fill, glued, new_table, printed, put, tell, widths
from ptmcalc.report.pick import Row


def render(reports: tuple[FileReport, ...], *, width: int, color: bool, verbose: bool = False) -> str:
    """The tables of all files, and a summary line; of the short ones also what they leave out."""

    def write(console: Console) -> None:
        for report in words.printable(reports):
            _title(console, report)
            (_whole if verbose else _short)(console, report)
            _diagnostics(console, report.diagnostics, notes=True)
            console.print()
        console.print(words.summary(count(reports)))
        if not verbose and (more := pick.left_out(reports)):
            tell(console, Text(more, style="dim"))

    return printed(write, width, color)


def listing(columns: Sequence[str], rows: Iterable[Sequence[str]], *, width: int) -> str:
    """A plain table of texts, for the commands that list things."""
    cells = words.printable([list(columns), *map(list, rows)])
    table = new_table("", *columns)
    return printed(lambda console: console.print(fill(table, cells[1:], width)), width, color=False)


def _title(console: Console, report: FileReport) -> None:
    """The line with the verdict, and what is wrong or doubtful in the file."""
    title = Text(report.path, style="bold")
    for part in (report.kind, report.name):
        title.append(f"  {part}" if part else "", style="not bold")
    title.append("  ")
    title.append(report.verdict.upper(), style=STYLE[report.verdict])
    console.print(title)
    if report.project:
        tell(console, Text(" " + ", ".join(f"{label} {text}" for label, text in words.head(report))))
    _worst(console, report)
    console.print()
    _diagnostics(console, report.diagnostics, notes=False)


def _worst(console: Console, report: FileReport) -> None:
    """Why the verdict is what it is: the worst check with its numbers, the key that governs it and the way out.

    It stands above everything that may fill a screen.
    """
    for scene, judgement in words.worst_first(report)[:1]:
        verdict = _verdict(judgement)
        about = f"{verdict} {judgement.code} {words.subject(judgement)}, {scene}:"
        parts = [*about.split(), *_numbers(report, judgement), *words.remark(judgement).split()]
        first, *others = ledger.flowed(parts, console.width)
        line = Text(first)
        line.stylize(STYLE[judgement.verdict.value], 1, 1 + len(verdict))
        console.print(line)
        for other in others:
            console.print(Text(other))


def _numbers(report: FileReport, judgement: Judgement) -> Iterator[str]:
    """`0.4348, limit ≥ 1.2, margin -63.8 %; governed by drum.friction (belt.yaml:25:15);`."""
    found = {
        "": words.value(judgement),
        "limit ": _limit(judgement),
        "margin ": words.margin(judgement),
    }
    told = [f"{name}{number}" for name, number in found.items() if number]
    yield from (f"{part}{',' if part is not told[-1] else ';'}" for part in told)
    key, place = _governed(report, judgement).rsplit(" (", 1)
    yield key
    yield f"({place}{';' * bool(words.remark(judgement))}"


def _limit(judgement: Judgement) -> str:
    limit = words.amount(judgement.limit, judgement.quantity) if judgement.limit else ""
    return f"{words.SIGN[judgement.sense]} {limit}" if limit else ""


def _governed(report: FileReport, judgement: Judgement) -> str:
    return f"governing key: {dotted(judgement.blame.path)} ({report.path}:{words.place(judgement.blame.span)})"


def _short(console: Console, report: FileReport) -> None:
    """One screen: what governs, and what is not passed."""
    rows = pick.checks(report)
    bad = any(row.judgement.verdict is not Verdict.PASS for row in rows)
    if bad:
        _checks(console, report, rows, edge=False)
    _loads(console, report.scenes, pick.loads(report), edge=False)
    if not bad:
        _checks(console, report, rows, edge=False)
    tables.draw(console, report, whole=False)
    for heading, lines in ledger.sections(report, console.width):
        console.print(Text(heading, style="bold"))
        for line in lines:
            console.print(Text(line))


def _whole(console: Console, report: FileReport) -> None:
    """Every load of the headlines, every check, and all that was computed, with explanations."""
    if report.scenes:
        _loads(console, report.scenes, pick.all_loads(report), edge=True)
        _checks(console, report, pick.all_checks(report), edge=True)
        tables.draw(console, report, whole=True)
        details.notes(console, report.scenes)
        details.effects(console, report.scenes)
        details.events(console, report.scenes)
        details.solvers(console, report.scenes)
    details.assumed(console, report)
    details.health(console, report.scenes)


_INDENT = " " * 8


def _diagnostics(console: Console, found: Iterable[Diagnostic], *, notes: bool) -> None:
    """What was found in the file: the notes, which come last, or everything else, which comes first."""
    shown = [diagnostic for diagnostic in found if (diagnostic.severity is Severity.NOTE) is notes]
    if shown and notes:
        console.print(Text("Notes", style="bold"))
    for diagnostic in shown:
        line = Text(" " if notes else "  ")
        line.append(f"{words.place(diagnostic.span)}  " if diagnostic.span else "")
        line.append(f"{diagnostic.severity.value} {diagnostic.code}", style=STYLE[diagnostic.severity.value])
        line.append(f"  {diagnostic.message}")
        tell(console, line, _INDENT)
        if diagnostic.hint:
            tell(console, Text(f"{_INDENT}{diagnostic.hint}", style="italic"), _INDENT)
    if shown and not notes:
        console.print()


def _loads(console: Console, scenes: tuple[SceneReport, ...], names: frozenset[str], *, edge: bool) -> None:
    """Loads of these names in rows, scenes in columns; the textbook's value with its ratio beside a simulated one.

    As many scenes stand side by side as fit; a row, or a scene, is there only where it has one of the loads.
    """
    scenes = tuple(scene for scene in scenes if any(load.info.name in names for load in scene.loads))
    loads = [{load.info.name: load for load in scene.loads} for scene in scenes]
    infos = _in_order(scenes, names)
    units = {
        info.name: words.common_unit(
            (own[info.name].estimate.value for own in loads if info.name in own), info.quantity
        )
        for info in infos
    }
    columns = [_columns(scene, own, infos, units, courses=True) for scene, own in zip(scenes, loads, strict=True)]
    labels = min(max((len(info.title) + len(units[info.name]) for info in infos), default=0) + 2 * GAP, _LABELS)
    if sum(_width(column) for part in columns for column in part) > console.width - labels:
        columns = [_columns(scene, own, infos, units, courses=False) for scene, own in zip(scenes, loads, strict=True)]
    title = "Loads"
    for group in _side_by_side([sum(map(_width, part)) for part in columns], console.width - labels):
        shown = [column for index in group for column in columns[index]]
        table = new_table(title, "", "", edge=edge)
        for name, style, _ in shown:
            table.add_column(name, justify="right", style=style)
        rows = [
            [info.title, units[info.name].removeprefix("1"), *(glued(cells[row]) for _, _, cells in shown)]
            for row, info in enumerate(infos)
            if any(cells[row] for _, _, cells in shown)
        ]
        put(console, fill(table, rows, console.width))
        title = ""


def _in_order(scenes: Iterable[SceneReport], names: frozenset[str]) -> list[LoadInfo]:
    """The loads of these names: those of the fullest scene, and each of another behind the one it follows there.

    A scene that shares none of its loads with those before it comes last.
    """
    infos: list[LoadInfo] = []
    for scene in sorted(scenes, key=lambda scene: -len(scene.loads)):
        own = [load.info for load in scene.loads if load.info.name in names]
        place = next((infos.index(info) for info in own if info in infos), len(infos))
        for info in own:
            if info not in infos:
                infos.insert(place, info)
            place = infos.index(info) + 1
    return infos


_Column = tuple[str, str, list[str]]
"""Heading, style, cells."""
_LABELS = 32
"""Width that the titles of loads are given at most before scenes have to part; longer ones go on in a second line."""


def _columns(
    scene: SceneReport,
    own: Mapping[str, LoadReport],
    infos: Sequence[LoadInfo],
    units: Mapping[str, str],
    *,
    courses: bool,
) -> list[_Column]:
    """The columns of one scene: its values, their courses over time, and the textbook's, where there are any."""
    found = [own.get(info.name) for info in infos]
    values = [words.amount(load.estimate, load.info.quantity, units[load.info.name]) if load else "" for load in found]
    columns = [(scene.name, "", values)]
    if courses and any(load and load.course for load in found):
        columns.append(("over time", "dim", [words.sparkline(load.course) if load else "" for load in found]))
    if any(load and load.formula for load in found):
        columns.append(("textbook", "dim", [_formula(load, units[load.info.name]) if load else "" for load in found]))
    return columns


def _width(column: _Column) -> int:
    heading, _, cells = column
    return max(len(heading), *map(len, cells), 0) + GAP


def _side_by_side(widths: Sequence[int], room: int) -> Iterator[list[int]]:
    """Columns in groups that fit into so much room, at least one in each."""
    group: list[int] = []
    for index, width in enumerate(widths):
        if group and sum(widths[one] for one in group) + width > room:
            yield group
            group = []
        group.append(index)
    if group:
        yield group


def _formula(load: LoadReport | None, unit: str) -> str:
    if load is None or load.formula is None:
        return ""
    ratio = f" ×{load.formula.ratio:.3f}" if load.formula.ratio is not None else ""
    return words.amount(Estimate.exact(load.formula.value), load.info.quantity, unit) + ratio


def _checks(console: Console, report: FileReport, rows: Sequence[Row], *, edge: bool) -> None:
    """Verdicts in rows, the worst first; under them the key that governs each that is not sound, and the way out."""
    if not rows:
        return
    styles = [STYLE[row.judgement.verdict.value] for row in rows]
    headings, cells = _in_columns(rows, edge, console.width)
    put(console, fill(new_table("Checks", *headings, edge=edge), cells, console.width, styles))
    lines = _remarks(report, rows, edge)
    for (verdict, style, remark), names in lines.items():
        tell(console, Text.assemble((verdict, style), f" {', '.join(names)}: {remark}"))
    if lines:
        console.print()


def _remarks(report: FileReport, rows: Sequence[Row], edge: bool) -> dict[tuple[str, str, str], list[str]]:
    """Remarks below the table with their checks, each cause once; that of the worst check stands above the table."""
    lines: dict[tuple[str, str, str], list[str]] = {}
    first = ""
    for index, row in enumerate(rows):
        judgement, remark = row.judgement, words.remark(row.judgement)
        bad = judgement.verdict is not Verdict.PASS
        if not bad and not (remark and edge):
            continue
        told = f"{_governed(report, judgement)}{'; ' * bool(remark)}{remark}" if bad else remark
        if bad and not index:
            first = told
            continue
        if bad and told == first:
            told = f"key and cause as of {_name(rows[0])}"
        lines.setdefault((_verdict(judgement), STYLE[judgement.verdict.value], told), []).append(_name(row))
    return lines


def _name(row: Row) -> str:
    """Code, part and scenes of a verdict."""
    return " ".join(filter(None, (row.judgement.code, row.judgement.element, row.scene)))


_TITLE = 24
"""A check whose title gets less room than this in a row of its own columns shares it with the scene and the remark."""


def _in_columns(rows: Sequence[Row], edge: bool, width: int) -> tuple[list[str], list[list[str]]]:
    """Headings and cells: scene and remark in columns of their own, or with the title where the screen is narrow."""
    headings = ["verdict", "check", "scene", "value", "limit", "margin", "remark"]
    table = [_cells(row, edge) for row in rows]
    if not any(cells[-1] for cells in table):
        headings, table = headings[:-1], [cells[:-1] for cells in table]
    if widths([headings, *table], width)[1] >= min(_TITLE, max(len(cells[1]) for cells in table)):
        return headings, table
    beside = [f" ({cells[6]})" if cells[6:] and cells[6] else "" for cells in table]
    narrow = [
        [cells[0], f"{cells[1]}, {cells[2]}{remark}", *cells[3:6]] for cells, remark in zip(table, beside, strict=True)
    ]
    return ["verdict", "check, scene", *headings[3:6]], narrow


def _cells(row: Row, edge: bool) -> list[str]:
    judgement = row.judgement
    value = words.value(judgement)
    return [
        glued(_verdict(judgement)),
        f"{judgement.code} {words.subject(judgement)}",
        row.scene,
        *map(glued, (value, _limit(judgement), words.margin(judgement))),
        "" if edge else _beside(row),
    ]


def _verdict(judgement: Judgement) -> str:
    return judgement.verdict.value.replace("_", " ")


def _beside(row: Row) -> str:
    """What the short table says beside a passed check instead of in lines of their own."""
    if row.judgement.verdict is not Verdict.PASS:
        return ""
    return "; ".join(filter(None, (words.remark(row.judgement), f"+{row.more} more" if row.more else "")))
