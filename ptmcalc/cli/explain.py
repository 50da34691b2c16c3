"""What `explain` prints: of one name, or of all as a handbook.

An explanation is made of parts once, and written as plain text or as Markdown. Formulas are written as they stand in
the program and, translated word by word, in LaTeX.
"""

import difflib
import inspect
import re
import textwrap
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, partial
from importlib import resources
from typing import Any

from ptmcalc.base.diagnostic import CODES, CodeText
from ptmcalc.base.errors import UsageError
from ptmcalc.cli.examples import EXAMPLES
from ptmcalc.contract.check import AnyCheck
from ptmcalc.contract.effect import AnyEffect
from ptmcalc.contract.example import Example
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.result import LoadInfo
from ptmcalc.contract.solver import AnySolver
from ptmcalc.engine.registry import kind_names, load_kind
from ptmcalc.report import formula
from ptmcalc.spec.synonyms import folded

_DIGITS_ALIKE = str.maketrans("OIL", "011")
"""Letters that are written for a digit of a code."""
_DISPLAYED = re.compile(r"^ {4}\S.*(?:\n {4,}\S.*)*", re.MULTILINE)
"""The formulas of a docstring: what is set in by four columns."""
_HANDBOOK = """\
# Handbook

Every code, effect, solver and load of ptmcalc: formula, symbols, range, error, source, and an example for the
top folder of the project. `ptmcalc explain --all --format markdown` writes this page; `ptmcalc explain NAME` prints one
entry.
"""


@dataclass(frozen=True, slots=True)
class Part:
    """A piece of an explanation: a heading (none for the running text), its lines, and whether they stand set in."""

    heading: str
    text: str
    displayed: bool = False
    tex: bool = False


@dataclass(frozen=True, slots=True)
class Explanation:
    """All that is said of one name."""

    name: str
    title: str
    about: str
    parts: tuple[Part, ...]

    @property
    def plain(self) -> str:
        """For a terminal."""
        head = f"{self.name}: {self.title}" + (f"   ({self.about})" if self.about else "")
        return "\n\n".join([head, *map(_plain, self.parts)]) + "\n"

    @property
    def markdown(self) -> str:
        """For a page: a section."""
        about = [f"*{self.about}*"] if self.about else []
        return "\n\n".join([f"### {self.name}: {self.title}", *about, *map(_markdown, self.parts)]) + "\n"


def _plain(part: Part) -> str:
    if part.displayed:
        return f"{part.heading}\n{textwrap.indent(part.text, '    ')}"
    return f"{part.heading}: {part.text}" if part.heading else part.text


def _markdown(part: Part) -> str:
    if part.tex:
        return f"$$\n{part.text}\n$$"
    if part.displayed and "**Range**" in part.text:
        return f"**{part.heading}**\n\n" + _paragraphs(part.text)
    if part.heading == "Symbols":
        return "**Symbols**\n\n" + "\n".join(f"- {line}" for line in part.text.splitlines())
    if part.displayed:
        return f"**{part.heading}**\n\n```text\n{part.text}\n```"
    return f"**{part.heading}**: {_paragraphs(part.text)}" if part.heading else _paragraphs(part.text)


def _paragraphs(text: str) -> str:
    """A docstring whose marked parts are paragraphs of their own."""
    return re.sub(r"(?<!\n)\n(?=\*\*[A-Z])", "\n\n", text)


# -- names ----------------------------------------------------------------------------------------------------------


def explanation(name: str, form: str = "text") -> str:
    """The text of `explain NAME`.

    Raises:
        UsageError: nothing has that name.
    """
    known = dict.fromkeys(key for key, _ in _everything())
    if (term := terms().get(folded(name))) is not None and name not in known:
        one = term.explanation
        return one.markdown if form == "markdown" else one.plain
    found: list[Explanation] = []
    if name not in known and name.upper() not in known:
        from ptmcalc.cli import laws  # reads the text of all formulas

        found = laws.pages(name)
        known |= laws.names()
    if not found:
        wanted = known_as(name, known)
        found = [make() for key, make in _everything() if key == wanted]
    return "\n".join(one.markdown if form == "markdown" else one.plain for one in found)


@dataclass(frozen=True, slots=True)
class Term:
    """A term of the field: its names, what a design file writes for it, and the entries to read on."""

    names: tuple[str, ...]
    text: str
    entries: tuple[str, ...]

    @property
    def explanation(self) -> Explanation:
        """As it is printed."""
        first, *others = self.names
        titles = {key: make().title for key, make in _everything() if key in self.entries}
        entries = "\n".join(f"{key}: {titles[key]}" for key in self.entries)
        about = "also " + ", ".join(others)
        return Explanation(first, "term of the field", about, (Part("", self.text), Part("See", entries, True)))


@cache
def terms() -> Mapping[str, Term]:
    """Terms of the field, by each of their names without regard to case and hyphens."""
    text = resources.files("ptmcalc.cli").joinpath("terms.txt").read_text("utf-8")
    found: dict[str, Term] = {}
    for block in text.split("\n\n")[1:]:
        names, *lines, entries = block.strip().splitlines()
        one = Term(tuple(names.split(", ")), "\n".join(lines), tuple(entries.removeprefix("See: ").split(", ")))
        found |= dict.fromkeys(map(folded, one.names), one)
    return found


def known_as(name: str, known: Collection[str]) -> str:
    """The known name that a name stands for: a code may be written in small letters.

    Raises:
        UsageError: nothing has that name.
    """
    wanted = name.upper() if name.upper() in known else name
    if wanted not in known:
        alike = name[:3].upper() + name[3:].upper().translate(_DIGITS_ALIKE)
        close = [alike] if alike in known else difflib.get_close_matches(name, known, 1)
        raise UsageError(f"unknown name `{name}`", f"did you mean `{close[0]}`?" if close else "try `ptmcalc solvers`")
    return wanted


def handbook(form: str = "text") -> str:
    """The text of `explain --all`: the findings, then kind by kind checks, effects, solvers and loads."""
    if form != "markdown":
        return "\n".join(make().plain for _, make in _everything())
    chapters = [_HANDBOOK, "## Findings about files and numbers\n"]
    chapters += [_finding(code, text).markdown for code, text in CODES.items()]
    for kind in map(load_kind, kind_names()):
        for title, entries in _chapters(kind):
            chapters.append(f"## {kind.name}: {title}\n")
            chapters += [make().markdown for _, make in entries]
    return "\n".join(chapters)


Entries = list[tuple[str, Callable[[], Explanation]]]


def _everything() -> Iterator[tuple[str, Callable[[], Explanation]]]:
    """Names and how to write what they are: only what is asked for is written."""
    for code, text in CODES.items():
        yield code, partial(_finding, code, text)
    for kind in map(load_kind, kind_names()):
        for _, entries in _chapters(kind):
            yield from entries


def _chapters(whole: AnyKind) -> Iterator[tuple[str, Entries]]:
    """Entries of a kind by chapter."""
    for title, entries in pieces_of(whole).items():
        yield title, [(name, partial(one.make, one.kinds, one.piece)) for name, all_ in entries.items() for one in all_]


def pieces_of(whole: AnyKind) -> "Mapping[str, Mapping[str, Sequence[Shared]]]":
    """Checks, effects, solvers and loads of a kind by name, each with all types of the kind that have it."""
    of: dict[str, dict[str, list[Shared]]] = {"checks": {}, "effects": {}, "solvers": {}, "loads": {}}
    for kind in whole.manifests:
        for check in kind.checks:
            if not check.types or kind.type in check.types:
                _add(of["checks"], check.code, kind, check, partial(_check, whole))
        for effect in kind.effects:
            _add(of["effects"], effect.name, kind, effect, partial(_effect, whole))
        for solver in (*kind.solvers, *kind.reference_methods):
            _add(of["solvers"], solver.name, kind, solver, partial(_solver, whole))
        for load in kind.loads:
            if len(whole.manifests) == 1 or any(load.name in solver.gives for solver in kind.solvers):
                _add(of["loads"], load.name, kind, load, partial(_load, whole))
    return of


@dataclass(slots=True)
class Shared:
    """A check, effect, solver or load, the types of machine that have it, and the function that explains it."""

    piece: Any
    kinds: list[AnyKind]
    make: Callable[[Sequence[AnyKind], Any], Explanation]


def _add(
    entries: dict[str, list[Shared]],
    name: str,
    kind: AnyKind,
    piece: Any,
    make: Callable[[Sequence[AnyKind], Any], Explanation],
) -> None:
    known = entries.setdefault(name, [])
    same = next((one for one in known if one.piece == piece), None)
    if same is None:
        known.append(Shared(piece, [kind], make))
    else:
        same.kinds.append(kind)


def label_of(kinds: Sequence[AnyKind]) -> str:
    """The kind in words, with all types concerned."""
    return f"{kinds[0].name} {', '.join(kind.type for kind in kinds)}".strip()


# -- what is said of each -------------------------------------------------------------------------------------------


def _finding(code: str, text: CodeText) -> Explanation:
    parts = [Part("", text.why), Part("Corrective action", text.fix), *_example(EXAMPLES.get(code))]
    return Explanation(code, text.title, "", tuple(parts))


_OF_HAZARDS = (
    "If it fails, it stands before failed checks of heat, wear, sway and times: a part breaks or tips, a load drops, or"
    " the machine slips, goes slack, runs back or does not stop in time."
)


def _check(whole: AnyKind, kinds: Sequence[AnyKind], check: AnyCheck) -> Explanation:
    scenes = ", ".join(sorted(scene.model_fields["type"].default for scene in check.scenes))
    value = [Part("Value", _doc(check.value))] if check.value and check.value.__doc__ else []
    parts = [
        Part("", check.question),
        Part("", check.what),
        Part("", check.why),
        *_formula("Formula", check.formula),
        *_symbols(kinds[0], check.code, of_check(check)),
        Part("Reads", ", ".join(check.loads)),
        *([Part("Order in reports", _OF_HAZARDS)] if check.hazard else []),
        *value,
        Part("Limit", _doc(check.limit)),
        Part("Source", check.source),
        *_example(whole.examples().get(check.code)),
    ]
    return Explanation(check.code, check.title, f"{label_of(kinds)}; scenes: {scenes}", tuple(parts))


def _effect(whole: AnyKind, kinds: Sequence[AnyKind], effect: AnyEffect) -> Explanation:
    criterion, bound = _doc(effect.criterion), _doc(effect.bound)
    parts = [
        *([Part("Part of", effect.part_of)] if effect.part_of else []),
        Part("When it matters", criterion, displayed=True),
        *_latex(criterion),
        Part(f"Change if it is neglected{' (calibrated)' * effect.calibrated}", bound, displayed=True),
        *_latex(bound),
        *_symbols(kinds[0], effect.name, of_effect(effect)),
        *_example(whole.examples().get(effect.name)),
    ]
    return Explanation(effect.name, effect.title, label_of(kinds), tuple(parts))


def _solver(whole: AnyKind, kinds: Sequence[AnyKind], solver: AnySolver) -> Explanation:
    kind = kinds[0]
    remarks = ["Simulated effects: " + (", ".join(sorted(solver.represents)) or "none")]
    if not solver.decides:
        remarks.append("It is shown next to the reported load and never decides a verdict.")
    if solver in kind.reference_methods:
        remarks.append("Reference method, never used for a verdict; `ptmcalc cost` compares the other solvers with it.")
    same = [one.name for one in kind.solvers if one.way == solver.way and one.name != solver.name]
    if same:
        remarks.append(
            f"It uses the method of {', '.join(same)}: `ptmcalc cost` uses neither as a reference for the other."
        )
    text = _doc(solver.run)
    parts = [
        Part("", "\n".join(remarks)),
        Part("", text),
        *_latex(text),
        *_symbols(kind, solver.name, of_solver(solver)),
        *_example(whole.examples().get(solver.name)),
    ]
    return Explanation(solver.name, solver.title, label_of(kinds), tuple(parts))


def _load(whole: AnyKind, kinds: Sequence[AnyKind], load: LoadInfo) -> Explanation:
    giving = list({one.name: one for kind in kinds for one in kind.solvers if load.name in one.gives}.values())
    reading = list(dict.fromkeys(check.code for kind in kinds for check in kind.checks if load.name in check.loads))
    of_parts = any(_is_family(kind, load) for kind in kinds)
    family = f"One for each part of the machine: `{load.name}[name]`.\n" if of_parts else ""
    lines = [f"Computed by: {', '.join(one.name for one in giving) or 'none'}"]
    lines += [f"Read by: {', '.join(reading)}"] if reading else []
    parts = [Part("", f"{family}Unit: {load.quantity.si} in JSON, a multiple of it in tables.")]
    parts += [Part("", "\n".join(lines))]
    parts += [Part("Range, error and source", _where(giving), displayed=True)] if giving else []
    parts += _example(whole.examples().get(load.name))
    return Explanation(load.name, f"{load.title} [{load.quantity.si}]", f"{label_of(kinds)}; load", tuple(parts))


def _is_family(kind: AnyKind, load: LoadInfo) -> bool:
    return kind.parts is not None and any(load.name in check.loads and check.each is not None for check in kind.checks)


def _where(giving: Iterable[AnySolver]) -> str:
    """Of each solver that finds a load, what holds for its numbers."""
    said = []
    for one in giving:
        told = {mark: part_of(_doc(one.run), mark) for mark in ("Range", "Error", "Source")}
        said.append(f"- {one.name}: " + " ".join(f"**{mark}** {text}" for mark, text in told.items() if text))
    return "\n".join(said)


# -- parts ----------------------------------------------------------------------------------------------------------


def _doc(function: Any) -> str:
    return inspect.cleandoc(function.__doc__ or "")


def part_of(text: str, name: str) -> str:
    """One marked paragraph of a docstring on one line."""
    match = re.search(rf"\*\*{name}\*\*(.*?)(?=\*\*[A-Z]|\Z)", text, re.DOTALL)
    return " ".join(match[1].split()) if match else ""


def displayed(text: str) -> str:
    """The formulas of a docstring."""
    return "\n".join(textwrap.dedent(match[0]) for match in _DISPLAYED.finditer(inspect.cleandoc(text)))


def of_check(check: AnyCheck) -> str:
    """All formulas on the page of a check."""
    return "\n".join([check.formula, *(displayed(_doc(one)) for one in (check.value, check.limit) if one is not None)])


def of_effect(effect: AnyEffect) -> str:
    """All formulas on the page of an effect."""
    return displayed(_doc(effect.criterion)) + "\n" + displayed(_doc(effect.bound))


def of_solver(solver: AnySolver) -> str:
    """All formulas on the page of a solver."""
    return displayed(_doc(solver.run))


def _formula(heading: str, plain: str) -> list[Part]:
    tex = Part("In LaTeX", formula.latex(plain), displayed=True, tex=True)
    return [Part(heading, plain, displayed=True), tex]


def _latex(text: str) -> list[Part]:
    shown = displayed(text)
    return [Part("In LaTeX", formula.latex(shown), displayed=True, tex=True)] if shown else []


def _symbols(kind: AnyKind, name: str, plain: str) -> list[Part]:
    """Meanings of the letters of a formula, as far as the kind lists them for that page."""
    listed = kind.symbols()
    lines = [
        f"{one}: {listed[name, one].meaning} [{listed[name, one].unit}]"
        for one in formula.letters(plain)
        if (name, one) in listed
    ]
    return [Part("Symbols", "\n".join(lines), displayed=True)] if lines else []


def _example(example: Example | None) -> list[Part]:
    if example is None:
        return []
    file = [Part("Example, design.yaml", example.file.rstrip(), displayed=True)] if example.file else []
    return [*file, Part("Example", f"$ {example.command}\n{example.says}".rstrip(), displayed=True)]
