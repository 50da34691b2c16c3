"""The check of one design file, from its text to its report."""

import math
import os
from collections.abc import Callable, Container, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from datetime import date
from functools import partial
from pathlib import Path
from typing import TypeVar

from ptmcalc.base.diagnostic import BROKEN, Diagnostic, Severity, Verdict
from ptmcalc.base.errors import NumericsError, UsageError
from ptmcalc.base.progress import step
from ptmcalc.base.span import KeyPath, Span, dotted
from ptmcalc.base.units import show
from ptmcalc.contract.check import AnyCheck
from ptmcalc.contract.effect import EffectState
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.report import (
    Change,
    EffectReport,
    FileReport,
    FormulaValue,
    Judgement,
    LoadReport,
    NextSolver,
    Place,
    SceneReport,
    SolverReport,
)
from ptmcalc.contract.result import Finding, History
from ptmcalc.engine.ends import Flips, Key, by_key, flips_of
from ptmcalc.engine.judge import Ruling
from ptmcalc.engine.load import Loaded, load_file
from ptmcalc.engine.plan import Plan, PlannedEffect, plan
from ptmcalc.engine.policy import ANY, Choice
from ptmcalc.engine.purse import FilePurse
from ptmcalc.engine.repair import Repairs
from ptmcalc.engine.run import NO_MEMORY, WORK_BUDGET
from ptmcalc.engine.settled import Run, Settled
from ptmcalc.engine.textbook import OF_TEXTBOOKS, far_from_textbook
from ptmcalc.engine.widen import absent
from ptmcalc.spec.alias import said_as_written
from ptmcalc.spec.machine import MachineSpec
from ptmcalc.spec.scene import Scene
from ptmcalc.text.document import Document

T = TypeVar("T")
_PARTS = 12
"""Numbers that describe the shape of a history, one for each part of its time. A numerical choice: more detect smaller
changes and lengthen the report."""


@dataclass(frozen=True, slots=True)
class Options:
    """Options of the command line: scenes, accuracy, forced effects, the maximum predicted seconds of a scene or of the
    search for a repair, and whether repairs are searched for."""

    scenes: tuple[str, ...] = ()
    accuracy: str = ""
    effects: Mapping[str, str] = field(default_factory=dict)
    histories: bool = False
    courses: bool = False
    """True if reports show histories in short form"""
    figures: bool = False
    """True if figures are requested"""
    ledger: bool = False
    """True if a run without each effect near its threshold shows what it changes"""
    budget: float = WORK_BUDGET
    repairs: bool = True
    counting: Choice = ANY
    """the selected checks; no repair is searched for others"""
    run: bool = True
    """False if files are only read and validated"""
    today: date | None = None
    """the day for waivers; default: the current day"""


def check_paths(paths: Sequence[Path], options: Options) -> tuple[FileReport, ...]:
    """The reports of files, in their order; an internal error on one file does not stop the others."""
    if len(paths) == 1:
        try:
            return (check_file(paths[0], options),)
        except MemoryError:
            return (beyond_memory(paths[0].as_posix()),)
    return tuple(guarded(path.as_posix(), partial(check_file, path, options)) for path in paths)


def guarded(name: str, make: Callable[[], T]) -> T | FileReport:
    """The result of a file, usually its report, or the report of an internal error.

    Raises:
        UsageError: the options are wrong for this file.
    """
    try:
        return make()
    except UsageError:
        raise
    except MemoryError:
        return beyond_memory(name)
    except Exception as error:
        if os.environ.get("PTMCALC_TRACEBACK"):
            raise
        return broken(name, f"{type(error).__name__}: {error}")


def beyond_memory(name: str) -> FileReport:
    """The report of a file that requires more memory than available: it is undecided, not invalid."""
    hint = "simplify the machine or its scenes, or give the process more memory"
    reason = f"the file {NO_MEMORY}: nothing was computed"
    return FileReport(name, diagnostics=(Diagnostic("NUM103", reason, hint=hint, severity=_WARN),))


def broken(name: str, reason: str) -> FileReport:
    """The report of a file that causes an internal error."""
    hint = "please report it with the file and the output of the same command under PTMCALC_TRACEBACK=1"
    return FileReport(name, diagnostics=(Diagnostic(BROKEN, f"internal error: {reason}", hint=hint),))


def check_file(path: Path, options: Options) -> FileReport:
    """The report of one file."""
    return check(load_file(path, path.as_posix(), options.effects, options.accuracy), options)


def planned_for(loaded: Loaded, options: Options) -> Plan | None:
    """The plan of a loaded file; None if nothing is to be computed.

    Raises:
        UsageError: the file has not the scenes that are asked for.
    """
    if loaded.kind is None or loaded.spec is None or not options.run:
        return None
    return plan(loaded.kind, loaded.spec, chosen_scenes(loaded.spec, options.scenes))


def check(loaded: Loaded, options: Options, planned: Plan | None = None) -> FileReport:
    """The report of a loaded file, by its plan if available."""
    name = loaded.document.name
    if loaded.kind is None or loaded.spec is None:
        return FileReport(name, _text(loaded, "kind"), _text(loaded, "name"), loaded.diagnostics)
    kind, spec = loaded.kind, loaded.spec
    made = planned or planned_for(loaded, options)
    if made is None:
        return FileReport(name, kind.name, spec.name, loaded.diagnostics, loaded.assumed, computed=False)
    conflicts = _conflicts(loaded, kind, spec, made, options)
    if any(one.severity is Severity.ERROR for one in conflicts):
        named = tuple(said_as_written(one, loaded.document) for one in conflicts)
        return FileReport(name, kind.name, spec.name, loaded.diagnostics + named, loaded.assumed)
    purse = FilePurse(options.budget)
    settled = []
    for number, scene in enumerate(made.scenes, 1):
        step(f"scene {scene.scene.label} ({number} of {len(made.scenes)})")
        settled.append(purse.settle(kind, spec, scene))
    flips = flips_of(kind, spec, made, settled, loaded.assumed, purse)
    diagnostics = (
        loaded.diagnostics
        + conflicts
        + tuple(purse.said(loaded.document))
        + tuple(
            Diagnostic(f.code, message, loaded.document.value_span(f.path), f.path, f.hint, _severity(f))
            for f, message in _said(settled)
        )
    )
    repairs = Repairs(loaded, options.scenes, purse, partial(_again, options))
    scenes = tuple(_Assembly(loaded, kind, spec, scene, flips, options, repairs).scene() for scene in settled)
    judged = scenes
    if spec.waive:
        from ptmcalc.engine.waive import about_waivers, waived

        today = options.today or date.today()
        diagnostics += tuple(about_waivers(spec, scenes, today, loaded.document, whole=not options.scenes))
        judged = waived(spec, scenes, today)
    diagnostics += tuple(note for scene in scenes if (note := far_from_textbook(loaded, scene)) is not None)
    diagnostics += tuple(_nothing_checked(loaded, judged))
    tables = kind.tables_of(spec, judged)
    project = spec.project.given if spec.project is not None else ()
    report = FileReport(name, kind.name, spec.name, diagnostics, loaded.assumed, judged, tables, project=project)
    if not loaded.document.aliased:
        return report
    from ptmcalc.engine.report_keys import as_written_in_file

    return as_written_in_file(report, loaded.document)


def _conflicts(
    loaded: Loaded, kind: AnyKind, spec: MachineSpec, made: Plan, options: Options
) -> tuple[Diagnostic, ...]:
    """Effects forced on that no solver can simulate."""
    if "on" not in spec.effects.values():
        return ()
    from ptmcalc.engine.forced import refused

    return tuple(refused(kind, spec, made.scenes, loaded.document, whole=not options.scenes))


def _again(
    options: Options, loaded: Loaded, one: AnyCheck, scenes: tuple[str, ...], most: float
) -> tuple[list[Verdict], float]:
    """The verdicts of one check in a changed file, and the predicted seconds of its runs; none if it is invalid."""
    own = replace(options, scenes=scenes)
    rulings, spent = judged_again(own, loaded, {(one.code, one.element)}, FilePurse(most))
    return [ruling.verdict for ruling in rulings.values()], spent


def judged_again(
    options: Options, loaded: Loaded, wanted: Container[tuple[str, str]], purse: FilePurse
) -> tuple["Mapping[Key, Ruling]", float]:
    """How checks, by code and element, stand in a changed file with each assumed value at both ends, and the predicted
    seconds of the runs with the assumed values; none if the file is invalid."""
    kind, spec, made = loaded.kind, loaded.spec, planned_for(loaded, options)
    if kind is None or spec is None or made is None:
        return {}, 0.0
    if any(found.severity is Severity.ERROR for found in _conflicts(loaded, kind, spec, made, options)):
        return {}, 0.0
    settled = [purse.settle(kind, spec, scene, wanted) for scene in made.scenes]
    flips = flips_of(kind, spec, made, settled, loaded.assumed, purse)
    rulings = {
        key: replace(ruling, verdict=Verdict.UNDECIDED) if key in flips else ruling
        for key, ruling in by_key(made, settled)
    }
    return rulings, sum(scene.spent for scene in settled)


def _nothing_checked(loaded: Loaded, scenes: Sequence[SceneReport]) -> Iterator[Diagnostic]:
    """The finding that no check was made."""
    if any(one.verdict is not Verdict.OFF for scene in scenes for one in scene.checks):
        return
    off = {one.code for scene in scenes for one in scene.checks}
    reason = f"every check that applies is switched off ({len(off)})" if off else "no check applies to the scenes"
    path: KeyPath = ("checks",) if off else ("scenes",)
    hint = "delete an `off`" if off else "add a scene to which checks apply"
    yield Diagnostic("SPC204", f"nothing was checked: {reason}", _span(loaded.document, path), path, hint, _WARN)


_WARN = Severity.WARNING


def _severity(finding: Finding) -> Severity:
    """Whether a finding affects computed values: a remark on a textbook formula, or on a window with unbounded loads,
    does not."""
    return Severity.NOTE if finding.code in (*OF_TEXTBOOKS, "NUM112", "NUM113") else Severity.WARNING


def _said(settled: list[Settled]) -> Iterator[tuple[Finding, str]]:
    """The findings of all scenes, each once, with its scenes if the file has several."""
    about: dict[Finding, dict[str, None]] = {}
    for one in settled:
        for finding in one.said:
            about.setdefault(finding, {})[one.plan.scene.label] = None
    for finding, labels in about.items():
        if len(settled) == 1 or finding.message.startswith("scene `"):
            yield finding, finding.message
            continue
        scenes = f"scene{'s' if len(labels) > 1 else ''} {', '.join(f'`{label}`' for label in labels)}"
        yield finding, f"{scenes}: {finding.message}"


def _text(loaded: Loaded, key: str) -> str:
    data = loaded.document.data
    value = data.get(key, "") if isinstance(data, dict) else ""
    return value if isinstance(value, str) else ""


def chosen_scenes(spec: MachineSpec, names: tuple[str, ...]) -> list[Scene] | None:
    """The scenes of the given names.

    Raises:
        UsageError: the file has no scene of that name.
    """
    if not names:
        return None
    scenes = {scene.label: scene for scene in spec.all_scenes}
    for name in names:
        if name not in scenes:
            raise UsageError(f"unknown scene `{name}`", f"scenes: {', '.join(scenes)}")
    return [scenes[name] for name in names]


@dataclass(frozen=True, slots=True)
class _Assembly:
    """Assemble the report of one scene."""

    loaded: Loaded
    kind: AnyKind
    spec: MachineSpec
    settled: Settled
    flips: Flips
    options: Options
    repairs: Repairs

    def scene(self) -> SceneReport:
        scene = self.settled.plan.scene
        histories = self._histories()
        without = tuple(planned.effect.name for planned in self.settled.plan.effects if planned.forced_off)
        report = SceneReport(
            name=scene.label,
            type=scene.type,
            effects=tuple(self._effects()),
            solvers=tuple(self._solvers()),
            loads=tuple(self._loads(histories)),
            checks=tuple(self._judgement(ruling, without) for ruling in self.settled.rulings),
            health=self._health(),
            events=next((run.result.events for run in reversed(self.settled.runs) if run.result.events), ()),
        )
        if not self.options.figures:
            return report
        from ptmcalc.engine.figures import figures_of

        return replace(report, figures=tuple(figures_of(self.kind, report, self.spec, histories, self._textbooks())))

    def _effects(self) -> Iterator[EffectReport]:
        carried, near = self.settled.carried, self.settled.near if self.options.ledger else []
        for planned in self.settled.plan.effects:
            name = planned.effect.name
            yield EffectReport(
                name=name,
                title=planned.effect.title,
                state=_state(planned, carried),
                forced=planned.forced,
                criterion=planned.criterion,
                note=_note(planned, carried),
                change=self._change(name) if planned in near else None,
                absent=absent(planned, self.spec, self.settled.plan, self.settled.estimates, carried),
            )

    def _change(self, name: str) -> Change | None:
        """The load of a check with the largest change if the effect is neglected; clear changes take precedence."""
        from ptmcalc.engine.sensitivity import without

        pair = without(self.settled, self.spec, name)
        if pair is None:
            return None
        carrying, sparing = pair
        loads = dict.fromkeys(load for ruling in self.settled.rulings for load in ruling.check.loads)
        changes = [
            Change(load, changed.value / own.value - 1, clear=changed.low > own.high or changed.high < own.low)
            for load in loads
            if (own := carrying.get(load)) is not None
            and (changed := sparing.get(load)) is not None
            and own.bounded
            and changed.bounded
            and own.value != 0
        ]
        return max(changes, key=lambda change: (change.clear and change.visible, abs(change.relative)), default=None)

    def _solvers(self) -> Iterator[SolverReport]:
        for run in self.settled.runs:
            yield _solver(run, True, self._next() if run is self.settled.runs[-1] else None)
        for run in self.settled.shown:
            yield _solver(run, False, None)

    def _next(self) -> NextSolver | None:
        """The fastest run with more effects or a finer level than all completed runs."""
        ran = [(run.rung.solver.name, run.rung.carried, run.rung.level) for run in self.settled.runs]
        most = max((len(carried) for _, carried, _ in ran), default=0)
        finest = max((level for _, carried, level in ran if len(carried) == most), default=0)
        for rung in self.settled.plan.rungs:
            more = len(rung.carried) > most or (len(rung.carried) == most and rung.level > finest)
            if more and (rung.solver.name, rung.carried, rung.level) not in ran:
                return NextSolver(rung.solver.name, rung.seconds)
        return None

    def _loads(self, histories: Mapping[str, History]) -> Iterator[LoadReport]:
        for info in self.kind.loads_of(self.spec):
            best = self.settled.loads.get(info.name)
            if best is None:
                continue
            history, estimate = histories.get(info.name), best.estimate
            yield LoadReport(
                info=info,
                estimate=estimate,
                solver=best.rung.solver.name,
                source=best.rung.solver.source,
                at=best.found.at,
                window=best.result.window,
                formulas=self._formulas(info.name, estimate.value) if info.name in self.settled.formulas else (),
                history=history if self.options.histories else None,
                course=history.course(_PARTS) if history and self.options.courses else (),
                note=best.found.note,
            )

    def _histories(self) -> Mapping[str, History]:
        """Courses of loads over time, each from the run whose value is told, else from the richest that knows it."""
        found: dict[str, History] = {}
        told: set[str] = set()
        best = self.settled.loads
        asked = self.options.histories or self.options.courses or self.options.figures
        for run in self.settled.runs if asked else ():
            with suppress(NumericsError, MemoryError):  # given up, as the run itself was not
                found |= {name: one for name, one in run.result.histories().items() if name not in told}
                told |= {name for name in found if name in best and best[name].result is run.result}
        return found

    def _textbooks(self) -> Mapping[str, Mapping[str, History]]:
        """Courses of loads as textbooks' solvers have them, which are shown and decide nothing, by solver."""
        return {run.rung.solver.name: found for run in self.settled.shown if (found := run.result.histories())}

    def _formulas(self, load: str, value: float) -> tuple[FormulaValue, ...]:
        return tuple(
            FormulaValue(name, textbook, value / textbook if textbook and math.isfinite(textbook) else None)
            for name, textbook in self.settled.formulas[load].items()
        )

    def _judgement(self, ruling: Ruling, without: tuple[str, ...]) -> Judgement:
        check, scene = ruling.check, self.settled.plan.scene
        verdict, reason = ruling.verdict, ruling.reason
        blame = ruling.blame
        if verdict is Verdict.UNDECIDED and not (ruling.value is not None and ruling.value.bounded):
            from ptmcalc.engine.unknown import why_open

            reason = why_open(self.kind, self.spec, self.settled, check.loads) or reason
        flip = self.flips.get((scene.label, check.code, check.element))
        if flip and verdict in (Verdict.PASS, Verdict.FAIL):
            assumed, end, other = flip
            verdict, blame = Verdict.UNDECIDED, assumed.path
            reason = f"{other.value} if `{dotted(assumed.path)}` is {show(end, assumed.quantity)}: give its value"
        document = self.loaded.document
        sought = ruling.verdict is Verdict.FAIL and self.options.repairs and self.options.counting.takes(check.code)
        repair, tried = self.repairs.of(ruling, scene) if sought else (None, "")
        return Judgement(
            code=check.code,
            title=check.title,
            verdict=verdict,
            value=ruling.value,
            limit=ruling.limit,
            sense=check.sense,
            quantity=self.kind.quantity_of(self.spec, check),
            margin=ruling.margin,
            blame=Place(blame, _span(document, blame)),
            element=check.element,
            meaning=check.meaning(ruling.value, ruling.limit) if verdict is Verdict.FAIL and not reason else "",
            reason=reason,
            without=without if verdict not in (Verdict.NOT_CHECKED, Verdict.OFF) else (),
            repair=repair,
            tried=tried,
            loads=check.loads,
            hazard=check.hazard,
        )

    def _health(self) -> Mapping[str, float]:
        """The health of the richest run, and the work of all of them."""
        health: dict[str, float] = {}
        for run in self.settled.runs:
            health |= run.result.health
        return health | {"evaluations": float(sum(run.result.work for run in self.settled.runs))}


def _state(planned: PlannedEffect, carried: frozenset[str]) -> EffectState:
    if planned.effect.name in carried:
        return EffectState.SIMULATED
    return EffectState.BOUNDED if planned.active else EffectState.SKIPPED


def _note(planned: PlannedEffect, carried: frozenset[str]) -> str:
    """Reason of the state: forced by the file, missing input, or calibrated bound."""
    if planned.forced_off:
        return "forced off by the file"
    if planned.criterion is None:
        return "a required input is not given: the loads exclude this effect"
    notes = ["forced on by the file"] if planned.forced else []
    if planned.effect.calibrated and planned.effect.part_of in carried and planned.effect.name not in carried:
        notes.append("its bound is calibrated")
    return "; ".join(notes)


def _solver(run: Run, decides: bool, following: NextSolver | None) -> SolverReport:
    return SolverReport(
        name=run.rung.solver.name,
        fidelity=run.rung.solver.fidelity.value,
        effects=tuple(sorted(run.rung.carried)),
        predicted_seconds=run.rung.seconds,
        work=run.result.work,
        decides=decides,
        next=following,
    )


def _span(document: Document, path: tuple[str | int, ...]) -> Span:
    return document.value_span(path) if document.holds(path) else document.key_span(path)
