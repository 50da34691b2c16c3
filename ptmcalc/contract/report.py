"""The results of a file, independent of the output format."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from ptmcalc.base.diagnostic import BROKEN, Diagnostic, Severity, Verdict
from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.base.span import KeyPath, Span
from ptmcalc.base.units import Quantity
from ptmcalc.contract.check import AnyCheck, Sense
from ptmcalc.contract.effect import Criterion, EffectState
from ptmcalc.contract.figure import FigureReport
from ptmcalc.contract.result import Event, History, LoadInfo, family
from ptmcalc.spec.scene import Scene, type_of

_INVISIBLE = 1e-6
"""A smaller relative change is rounding."""


@dataclass(frozen=True, slots=True)
class Place:
    """A key and its position (or the position of its parent if the file does not give the key)."""

    path: KeyPath
    span: Span


@dataclass(frozen=True, slots=True)
class FormulaValue:
    """The textbook value next to the reported one; `ratio` is reported value / textbook value."""

    name: str
    value: float
    ratio: float | None


@dataclass(frozen=True, slots=True)
class LoadReport:
    """One load of a scene with its error bar and its origin."""

    info: LoadInfo
    estimate: Estimate
    solver: str
    source: str
    at: Mapping[str, float] = field(default_factory=dict)
    window: tuple[float, float] | None = None
    formulas: tuple[FormulaValue, ...] = ()
    history: History | None = None
    note: str = ""
    course: tuple[float, ...] = ()
    """its history in a few numbers"""

    @property
    def formula(self) -> FormulaValue | None:
        """The textbook value for comparison: the last of several."""
        return self.formulas[-1] if self.formulas else None


@dataclass(frozen=True, slots=True)
class Change:
    """What leaving out an effect near its threshold changes: the load it moves most, relative.

    A change is `clear` where the bars of the two numbers do not meet; else nobody can say what the effect does.
    """

    load: str
    relative: float
    clear: bool = True

    @property
    def visible(self) -> bool:
        """True if it exceeds the rounding level."""
        return abs(self.relative) >= _INVISIBLE


@dataclass(frozen=True, slots=True)
class EffectReport:
    """A line of the list of effects."""

    name: str
    title: str
    state: EffectState
    forced: bool
    criterion: Criterion | None
    note: str = ""
    change: Change | None = None
    absent: bool = False
    """True if there is none of it in the scene, such as a part that the machine does not have: tables omit it"""


@dataclass(frozen=True, slots=True)
class NextSolver:
    """The next planned run and its predicted time."""

    name: str
    predicted_seconds: float


@dataclass(frozen=True, slots=True)
class SolverReport:
    """A solver that ran in a scene."""

    name: str
    fidelity: str
    effects: tuple[str, ...]
    predicted_seconds: float
    work: int
    decides: bool
    next: NextSolver | None = None


@dataclass(frozen=True, slots=True)
class Repair:
    """The value of a key at which the check just passes; `other` is that at the opposite edge of a forbidden band."""

    path: KeyPath
    value: float
    quantity: Quantity
    other: float | None = None


@dataclass(frozen=True, slots=True)
class Judgement:
    """The verdict of one check in one scene."""

    code: str
    title: str
    verdict: Verdict
    value: Estimate | None
    limit: Estimate | None
    sense: Sense
    quantity: Quantity
    margin: float | None
    blame: Place
    element: str = ""
    meaning: str = ""
    """meaning of a failed check; empty for other verdicts"""
    reason: str = ""
    without: tuple[str, ...] = ()
    repair: Repair | None = None
    tried: str = ""
    """tried values if no value passes"""
    loads: tuple[str, ...] = ()
    """the loads that the check used"""
    baseline: bool = False
    """True if a baseline waives it, not the file"""
    hazard: bool = False
    """True if a part breaks, a load drops, or the machine slips, runs back or does not stop in time where it fails"""


@dataclass(frozen=True, slots=True)
class SceneReport:
    """All results of one scene."""

    name: str
    type: str
    effects: tuple[EffectReport, ...]
    solvers: tuple[SolverReport, ...]
    loads: tuple[LoadReport, ...]
    checks: tuple[Judgement, ...]
    health: Mapping[str, float]
    events: tuple[Event, ...] = ()
    figures: tuple[FigureReport, ...] = ()
    """figures, if requested"""

    @property
    def present(self) -> tuple[EffectReport, ...]:
        """The effects that the scene can have. Tables list these alone: a report changes only with its own machine."""
        return tuple(effect for effect in self.effects if not effect.absent)

    def simulated(self, solver: SolverReport) -> tuple[str, ...]:
        """The effects of the scene that a run simulated."""
        absent = {effect.name for effect in self.effects if effect.absent}
        return tuple(name for name in solver.effects if name not in absent)


@dataclass(frozen=True, slots=True)
class Amount:
    """A number in a table of a machine."""

    estimate: Estimate
    quantity: Quantity


Cell = str | Amount | tuple[str, ...]
"""Cell of a table of a machine: words, a number, or a list of words; may be empty."""


@dataclass(frozen=True, slots=True)
class Column:
    """A column of a table: its key in JSON, its heading; a detail is left out of the short table."""

    key: str
    heading: str
    detail: bool = False


@dataclass(frozen=True, slots=True)
class TableReport:
    """A table of a kind's own that its scenes together make: shape (rows, columns), with notes below."""

    name: str
    title: str
    columns: tuple[Column, ...]
    rows: tuple[tuple[Cell, ...], ...]
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class AssumedReport:
    """An assumed value that the file does not give."""

    path: KeyPath
    value: float
    quantity: Quantity
    interval: Interval
    source: str
    scenes: frozenset[str] = frozenset()
    """types of the scenes that use it; empty for all"""
    loads: frozenset[str] = frozenset()
    """families of the loads that depend on it; empty for all"""
    limits_only: bool = False
    """whether only limits of checks of those loads depend on it"""

    def read_in(self, scene: Scene) -> bool:
        """Whether a scene reads the value."""
        return not self.scenes or scene.type in self.scenes

    def read_by(self, check: AnyCheck) -> bool:
        """Whether a check can depend on the value."""
        scenes = not self.scenes or not self.scenes.isdisjoint(map(type_of, check.scenes))
        return scenes and (not self.loads or not self.loads.isdisjoint(map(family, check.loads)))

    def changes(self, loads: Iterable[str]) -> bool:
        """Whether one of these loads can depend on the value."""
        return not self.limits_only and (not self.loads or not self.loads.isdisjoint(map(family, loads)))


@dataclass(frozen=True, slots=True)
class FileReport:
    """All results of one file."""

    path: str
    kind: str = ""
    name: str = ""
    diagnostics: tuple[Diagnostic, ...] = ()
    assumed: tuple[AssumedReport, ...] = ()
    scenes: tuple[SceneReport, ...] = ()
    tables: tuple[TableReport, ...] = ()
    ignored: int = 0
    """findings and verdicts that the run excluded"""
    ignored_checks: int = 0
    """the verdicts among them"""
    computed: bool = True
    """False if the file is only validated"""
    project: tuple[tuple[str, str], ...] = ()
    """head of the report by its keys: number, revision, author, checked_by"""

    @property
    def valid(self) -> bool:
        """Whether the file could be read as a machine at all."""
        return all(d.severity is not Severity.ERROR for d in self.diagnostics)

    @property
    def judgements(self) -> Iterator[tuple[SceneReport, Judgement]]:
        """Every verdict with its scene, in the order of the file."""
        return ((scene, judgement) for scene in self.scenes for judgement in scene.checks)

    @property
    def verdict(self) -> str:
        """`invalid`, `fail`, `undecided` or `pass`: neither a check that was not made nor a file without any check is a
        pass."""
        if not self.valid:
            return "invalid"
        verdicts = {judgement.verdict for _, judgement in self.judgements}
        if Verdict.FAIL in verdicts:
            return "fail"
        if verdicts & {Verdict.UNDECIDED, Verdict.NOT_CHECKED}:
            return "undecided"
        return "pass" if self.judged or not self.computed else "undecided"

    @property
    def judged(self) -> bool:
        """Whether there is a verdict of a check that was made and counts."""
        return any(judgement.verdict is not Verdict.OFF for _, judgement in self.judgements)


@dataclass(frozen=True, slots=True)
class Tally:
    """Data of one file for summary and exit status."""

    verdict: str
    counts: Mapping[str, int]
    loudest: str = ""
    """highest severity of the findings; empty without findings"""
    broken: bool = False
    """True for an internal error of ptmcalc"""
    unchosen: bool = False
    """whether it has checks, and the run was told to leave out all of them"""


def tally(report: FileReport) -> Tally:
    """The tally of a file."""
    counts = dict.fromkeys(("pass", "fail", "undecided", "not_checked", "waived", "off"), 0)
    for _, judgement in report.judgements:
        counts[judgement.verdict.value] += 1
    counts |= {"invalid": int(not report.valid), "ignored": report.ignored}
    said = [diagnostic.severity for diagnostic in report.diagnostics]
    loudest = max(said, key=lambda severity: severity.rank).value if said else ""
    is_broken = any(d.code == BROKEN for d in report.diagnostics)
    unchosen = report.valid and not report.judged and report.ignored_checks > 0
    return Tally(report.verdict, counts, loudest, is_broken, unchosen)


def total(tallies: Iterable[Tally]) -> dict[str, int]:
    """Files, verdicts, invalid files, and what was left out of a run."""
    names = ("pass", "fail", "undecided", "not_checked", "waived", "off", "invalid", "ignored")
    totals = {"files": 0} | dict.fromkeys(names, 0)
    for one in tallies:
        totals["files"] += 1
        for name in names:
            totals[name] += one.counts[name]
    return totals


def count(reports: Iterable[FileReport]) -> dict[str, int]:
    """Files, verdicts, invalid files, and what was left out of a run."""
    return total(map(tally, reports))


def status_of(tallies: Iterable[Tally]) -> int:
    """0 all pass, 1 a check failed, 2 an invalid file, 3 undecided, 4 internal error; the most severe applies, in the
    order 4, 2, 1, 3.

    A file without any selected check does not count if another file has some: `--select CNV` over machines of several
    kinds. A run in which nothing was checked is undecided.
    """
    found = {"broken" if one.broken else "unchosen" if one.unchosen else one.verdict for one in tallies}
    worst = (("broken", 4), ("invalid", 2), ("fail", 1), ("undecided", 3), ("pass", 0))
    return next((status for name, status in worst if name in found), 3)


def status_at(tallies: Sequence[Tally], level: Severity) -> int:
    """The exit status of a run in which findings from a severity up count as a failure."""
    status = status_of(tallies)
    loud = any(one.loudest and Severity(one.loudest).rank >= level.rank for one in tallies)
    return 1 if status in (0, 3) and loud else status


def exit_status(reports: Iterable[FileReport]) -> int:
    """The exit status of a run: that of its worst file."""
    return status_of(map(tally, reports))
