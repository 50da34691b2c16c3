"""Hard machines as design files: what the comments on top of each expect, and what is wrong with what came of it.

A file of the zoo says on top, in comments, what is hard about it and what is right, and then in lines of their own:

    # expect: fail                                the verdict of the whole file: pass, fail, undecided or invalid
    # expect: fail SHF105 [run_out]               the verdict of a check, in that scene or in any that has it
    # expect: NUM102                              a finding; no other finding of its letters may be there
    # expect: invalid SPC110 14:18                refused, with this code at this line and column
    # expect: run_out_angle = 4.9 within 1e-9     a load in SI units: in its interval, its value as near
    # expect: torque_peak[link] about 240 within 1e-5     the same of a number that is known no closer than that
    # expect: run_out_time = inf [coast]
    # expect: tension_min unbounded               no number of it may be trusted
    # at most: 4000 steps, 900 evaluations        of any run, and of all runs of a scene together
    # at most: 1e-9 residual                      what the energy ledger of a transient may leave over
    # tries: 2 s                                  predicted seconds of one run beside those the check makes itself

Every other line of the comments is for people.
"""

import itertools
import json
import math
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from unittest import mock

from ptmcalc.base.diagnostic import Severity, Verdict
from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.check import Sense
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.report import FileReport, Judgement, exit_status
from ptmcalc.contract.result import Result
from ptmcalc.contract.solver import Fidelity
from ptmcalc.engine import check as engine_check
from ptmcalc.engine import purse as engine_purse
from ptmcalc.engine.check import Options
from ptmcalc.engine.load import Loaded, load_text
from ptmcalc.engine.plan import Rung, ScenePlan
from ptmcalc.engine.run import settle
from ptmcalc.engine.settled import Run, Settled
from ptmcalc.engine.textbook import OF_TEXTBOOKS
from ptmcalc.engine.widen import widen
from ptmcalc.report import json as report_json
from ptmcalc.spec.machine import MachineSpec

BUDGET = 5.0
"""Predicted seconds a scene may cost here."""
TRIED = 0.3
"""Predicted seconds of a run that is made to hold the others against, where the file does not say."""
STATUS = {"pass": 0, "fail": 1, "invalid": 2, "undecided": 3}
RESIDUAL = 1e-5
"""What the energy ledger of a transient may leave over where the file does not say: ten times the widest tolerance."""
ROUNDING = 1e-9
"""Of two runs that agree, as a share of what they found."""
WITHOUT_LEDGER: Mapping[str, str] = {
    "step_table": "a table as by hand, shown beside, never decides",
    "chain_run_through": "a sum over tooth passes, each in closed form: nothing is integrated",
    "chain_run_through_near": "a sum over tooth passes, each in closed form: nothing is integrated",
    "chain_start_teeth": "a sum over tooth passes, each in closed form: nothing is integrated",
    "chain_breakaway": "a wave front in closed form: nothing is integrated",
    "buffer_collision": "two numbers of steps tell the error; runs of an adaptive method are held against it",
}
"""Transients that keep no account of energy, and why."""

DUST = 1e-12
"""Of a number that should be 0, as a share of the largest one of its quantity."""
OF_THE_RUN = {"energy_residual", "tension_polygon_bound"}
"""Loads that say something of a run, not of the machine: what its ledger leaves over, and an upper bound that is as
good as the run."""

_EXPECT = re.compile(r"^# (expect|at most|tries): *(.*?) *$")
_VERDICT = re.compile(r"(pass|fail|undecided|invalid)")
_OF_CHECK = re.compile(r"(pass|fail|undecided|not_checked) ([A-Z]{3}[0-9]{3})(?: \[([^\]]+)\])?")
_REFUSED = re.compile(r"invalid ([A-Z]{3}[0-9]{3}) ([0-9]+):([0-9]+)")
_FOUND = re.compile(r"NUM[0-9]{3}")
_LOAD = re.compile(r"(\S+) (=|about) (\S+)(?: within (\S+))?(?: \[([^\]]+)\])?")
_UNBOUNDED = re.compile(r"(\S+) unbounded(?: \[([^\]]+)\])?")
_AMOUNT = re.compile(r"(\S+) (steps|evaluations|residual)")


@dataclass(frozen=True)
class Known:
    """A load that physics says."""

    load: str
    value: float
    within: float
    scene: str
    exact: bool


@dataclass
class Expected:
    """What the comments of a file say."""

    verdict: str = ""
    checks: list[tuple[str, str, str]] = field(default_factory=list)
    refused: list[tuple[str, int, int]] = field(default_factory=list)
    findings: set[str] = field(default_factory=set)
    loads: list[Known] = field(default_factory=list)
    unbounded: list[tuple[str, str]] = field(default_factory=list)
    at_most: dict[str, float] = field(default_factory=dict)
    tried: float = TRIED


def expected(text: str) -> Expected:
    """What a file expects; a line that says nothing is a mistake of the file."""
    found = Expected()
    for line in text.splitlines():
        match = _EXPECT.match(line)
        if match is None:
            continue
        what, said = match[1], match[2]
        if what == "tries":
            found.tried = float(said.removesuffix(" s"))
        elif what == "at most":
            amounts = [_AMOUNT.fullmatch(part.strip()) for part in said.split(",")]
            assert all(amounts), f"`{line}` says nothing"
            found.at_most |= {one[2]: float(one[1]) for one in amounts if one}
        else:
            _expect(found, said)
    assert found.verdict or found.refused, "no `# expect: pass|fail|undecided|invalid ...` on top"
    assert found.refused or "evaluations" in found.at_most, "no `# at most: N evaluations` on top"
    return found


def _expect(found: Expected, said: str) -> None:
    if _VERDICT.fullmatch(said):
        found.verdict = said
    elif one := _OF_CHECK.fullmatch(said):
        found.checks.append((one[1], one[2], one[3] or ""))
    elif one := _REFUSED.fullmatch(said):
        found.verdict = "invalid"
        found.refused.append((one[1], int(one[2]), int(one[3])))
    elif _FOUND.fullmatch(said):
        found.findings.add(said)
    elif one := _UNBOUNDED.fullmatch(said):
        found.unbounded.append((one[1], one[2] or ""))
    elif one := _LOAD.fullmatch(said):
        found.loads.append(Known(one[1], float(one[3]), float(one[4] or 0), one[5] or "", one[2] == "="))
    else:
        raise AssertionError(f"`# expect: {said}` says nothing")


# -- what comes of a machine ------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Checked:
    """A file through the pipeline of `ptmcalc check`: its report, and every scene that was settled for it."""

    loaded: Loaded
    report: FileReport
    settled: tuple[tuple[AnyKind, MachineSpec, Settled], ...]


def checked(text: str, name: str = "case.yaml", budget: float = BUDGET) -> Checked:
    """Load, plan, settle and judge, as the command does it; the scenes are seen as they are settled there."""
    seen: list[tuple[AnyKind, MachineSpec, Settled]] = []

    def watched(kind: AnyKind, spec: MachineSpec, scene: ScenePlan, **options: Any) -> Settled:
        settled = settle(kind, spec, scene, **options)
        seen.append((kind, spec, settled))
        return settled

    loaded = load_text(text.encode(), name)
    with mock.patch.object(engine_purse, "settle", watched):
        report = engine_check.check(loaded, Options(budget=budget, repairs=False))
    return Checked(loaded, report, tuple(seen))


def is_wrong(text: str, name: str = "case.yaml", tried: float | None = None) -> list[str]:
    """Everything that is wrong with what comes of a file of the zoo; `tried` replaces the seconds it says."""
    wanted, found = expected(text), checked(text, name)
    most = wanted.tried if tried is None else tried
    return [*_beside_what_is_expected(wanted, found.report), *_wrong_by_itself(found, wanted.at_most, most)]


def wrong_anyway(text: str, *, budget: float, tried: float, evaluations: float) -> list[str]:
    """What is wrong with what comes of a valid file that says nothing of what is right."""
    found = checked(text, budget=budget)
    refused = [d.message for d in found.report.diagnostics if d.severity is Severity.ERROR]
    return refused or _wrong_by_itself(found, {"evaluations": evaluations}, tried)


def _wrong_by_itself(found: Checked, at_most: Mapping[str, float], tried: float) -> list[str]:
    """What is wrong whatever was expected."""
    wrong = never_right(found.report)
    for _, _, settled in found.settled:
        said = f"{settled.plan.scene.label}: "
        wrong += [said + one for one in _of_runs(settled.runs, at_most.get("residual", RESIDUAL))]
        wrong += [said + one for one in _beyond(at_most, settled.runs)]
    for kind, spec, settled in found.settled[: len(found.report.scenes)]:
        said = f"{settled.plan.scene.label}: "
        runs = [*settled.runs, *beside(kind, spec, settled, tried)]
        wrong += [said + one for one in contradictions(runs, _dust(kind, spec, settled))]
        wrong += [said + one for run in runs[len(settled.runs) :] for one in faulty(run)]
    return wrong


# -- what is never right ----------------------------------------------------------------------------------------------


def never_right(report: FileReport) -> list[str]:
    """What no report may say, whatever the machine."""
    wrong = []
    if exit_status((report,)) != STATUS[report.verdict]:
        wrong.append(f"exit status {exit_status((report,))} with verdict {report.verdict}")
    json.loads(report_json.render((report,), width=120, color=False))  # raises on NaN and Infinity
    for scene in report.scenes:
        for load in scene.loads:
            wrong += [f"{scene.name}: {load.info.name} {one}" for one in _no_interval(load.estimate)]
        told = any(d.code.startswith("NUM") for d in report.diagnostics)
        told |= any(
            judgement.verdict is Verdict.FAIL for judgement in scene.checks
        )  # what stalls has no cycle to judge
        for judgement in scene.checks:
            wrong += [f"{scene.name}: {judgement.code} {one}" for one in _unfounded(judgement, told)]
    if not report.valid:
        wrong += [f"{d.code} has no place" for d in report.diagnostics if d.span is None or not d.message]
    return wrong


def _no_interval(one: Estimate) -> Iterator[str]:
    parts = one.value, one.low, one.high, one.numerical, one.model
    if any(map(math.isnan, parts)):
        yield f"holds NaN: {one}"
    elif not one.low <= one.value <= one.high:
        yield f"lies outside its interval: {one}"
    elif min(one.numerical, one.model) < 0:
        yield f"has a bar below 0: {one}"


def _unfounded(judgement: Judgement, told: bool) -> Iterator[str]:
    """A verdict without a number that bears it, an open one without a reason; `told` whether the report says why some
    numbers are not known, which the reason of a check may do as well: by the load, and who leaves out or rules out
    what. A failure that a run found, as a stall, has its reason instead of a number."""
    value, limit = judgement.value, judgement.limit
    if judgement.verdict is Verdict.FAIL and value is None and judgement.reason:
        return
    if judgement.verdict in (Verdict.PASS, Verdict.FAIL):
        if value is None or limit is None or any(_no_interval(value)):
            yield f"is a {judgement.verdict} without a number"
            return
        least = judgement.sense is Sense.AT_LEAST
        sound = value.low >= limit.high if least else value.high <= limit.low
        bad = value.high < limit.low if least else value.low > limit.high
        bad |= bool(judgement.reason)  # a failure that a run found: only such a failed check has a reason
        if (judgement.verdict is Verdict.PASS and not sound) or (judgement.verdict is Verdict.FAIL and not bad):
            yield f"is a {judgement.verdict} by {value} against {limit}"
    elif judgement.verdict is Verdict.UNDECIDED:
        if not judgement.reason:
            yield "is undecided without a reason"
        unknown = value is None or not (value.bounded or value.low == value.high)
        if unknown and not told and not any(f"`{load}`" in judgement.reason for load in judgement.loads):
            yield f"is undecided for {value} and no finding says why"


def faulty(run: Run) -> Iterator[str]:
    """Loads of a run that are no numbers in intervals."""
    for name, one in run.estimates.items():
        yield from (f"{_called(run)} {name} {wrong}" for wrong in _no_interval(one))


def _of_runs(runs: Iterable[Run], residual: float) -> Iterator[str]:
    for run in runs:
        yield from faulty(run)
        left = run.result.health.get("energy_residual")
        trusted = run.result.health.get("steps") != 0 and any(
            one.bounded for name, one in run.estimates.items() if name not in OF_THE_RUN
        )
        if left is None:
            if (
                run.rung.solver.fidelity is Fidelity.TRANSIENT
                and run.rung.solver.name not in WITHOUT_LEDGER
                and trusted
            ):
                yield f"{_called(run)} tells no energy residual"
        elif not left <= residual and trusted:
            yield f"{_called(run)} leaves {left:.2g} of the energy over"


def _beyond(at_most: Mapping[str, float], runs: Iterable[Run]) -> Iterator[str]:
    """Counts that are above what the file allows; never seconds."""
    runs = list(runs)
    for run in runs:
        steps = run.result.health.get("steps", 0.0)
        if steps > at_most.get("steps", math.inf):
            yield f"{_called(run)} takes {steps:g} steps"
    work = sum(run.result.work for run in runs)
    if work > at_most.get("evaluations", math.inf):
        yield f"{work} evaluations"


# -- two ways to the same number --------------------------------------------------------------------------------------


def beside(kind: AnyKind, spec: MachineSpec, settled: Settled, most: float) -> Iterator[Run]:
    """Runs that the check did not need: every cheap rung, the next finer one of each that ran, and the references."""
    scene = settled.plan
    ran = {(run.rung.solver.name, run.rung.carried, run.rung.level) for run in settled.runs}
    finer = {(name, carried, level + 1) for name, carried, level in ran}
    allowed = frozenset(planned.effect.name for planned in scene.effects) - scene.excluded
    rungs = [
        rung
        for rung in scene.rungs
        if (key := (rung.solver.name, rung.carried, rung.level)) not in ran
        and rung.seconds <= (3 * most if key in finer else most)
    ]
    for reference in kind.reference_methods:
        if reference.always <= allowed and reference.usable_for(spec, scene.scene):
            carried = allowed & reference.represents
            rungs.append(Rung(reference, carried, 0, reference.cost(spec, scene.scene, carried, 0)))
            if rungs[-1].seconds > 3 * most:
                rungs.pop()
    for rung in rungs:
        try:
            result: Result = rung.solver.run(spec, scene.scene, rung.carried, rung.level)
        except NumericsError:  # it says why, and the engine makes a finding of it
            continue
        yield Run(rung, result, widen(scene, spec, rung, result))


def contradictions(runs: Iterable[Run], dust: Mapping[str, float] | None = None) -> list[str]:
    """Loads of which two runs claim intervals without a common value: one of them must be wrong.

    `dust` is what rounding leaves of a load, which no estimate tells, in its own unit.
    """
    found = []
    for one, other in itertools.combinations(runs, 2):
        for name in one.estimates.keys() & other.estimates.keys() - OF_THE_RUN:
            a, b = one.estimates[name], other.estimates[name]
            if math.isnan(a.value + b.value) and not (math.isinf(a.value) and math.isinf(b.value)):
                continue  # `faulty` says so
            if name == "tension_min" and max(a.high, b.high) < 0:
                continue  # both say that it goes slack; how far below 0 a tension would be is a number of no chain
            rounding = ROUNDING * (abs(a.value) + abs(b.value)) if math.isfinite(a.value + b.value) else 0.0
            rounding += (dust or {}).get(name, 0.0)
            if max(a.low, b.low) > min(a.high, b.high) + rounding:
                found.append(f"{name}: {_called(one)} says {_span(a)}, {_called(other)} {_span(b)}")
    return found


def _dust(kind: AnyKind, spec: MachineSpec, settled: Settled) -> dict[str, float]:
    """Of each load, rounding beside the largest number of its quantity in the scene, be it a load or a limit."""
    quantities = {info.name: info.quantity for info in kind.loads_of(spec)}
    largest: dict[Any, float] = {}

    def met(name: str, value: float) -> None:
        if math.isfinite(value):
            largest[quantities[name]] = max(largest.get(quantities[name], 0.0), abs(value))

    for name, one in settled.estimates.items():
        met(name, one.value)
    for ruling in settled.rulings:
        if ruling.limit is not None:
            met(ruling.check.loads[0], ruling.limit.value)
    return {name: DUST * largest.get(quantity, 0.0) for name, quantity in quantities.items()}


def _called(run: Run) -> str:
    return f"{run.rung.solver.name} {run.rung.level} {sorted(run.rung.carried)}"


def _span(one: Estimate) -> str:
    return f"[{one.low!r}, {one.high!r}]"


# -- what the file expects --------------------------------------------------------------------------------------------


def _beside_what_is_expected(wanted: Expected, report: FileReport) -> Iterator[str]:
    if report.verdict != wanted.verdict:
        said = [f"{scene.name} {one.code} {one.verdict}" for scene, one in report.judgements]
        told = [f"{d.code} {d.message}" for d in report.diagnostics]
        yield f"the file is `{report.verdict}`, not `{wanted.verdict}`: {said} {told}"
    errors = {
        (d.code, d.span.line, d.span.column) for d in report.diagnostics if d.severity is Severity.ERROR and d.span
    }
    if errors != set(wanted.refused):
        yield f"refused for {sorted(errors)}, not {wanted.refused}: {[d.message for d in report.diagnostics]}"
    found = {d.code: d.message for d in report.diagnostics if d.code.startswith("NUM") and d.code not in OF_TEXTBOOKS}
    if found.keys() != wanted.findings:
        yield f"findings {found}, not {sorted(wanted.findings)}"
    for verdict, code, scene in wanted.checks:
        said = [j.verdict.value for one, j in report.judgements if j.code == code and scene in ("", one.name)]
        if verdict not in said or (scene and set(said) != {verdict}):
            yield f"{code} {scene} is {said}, not {verdict}"
    for known in wanted.loads:
        yield from _misses(known, report)
    for name, scene in wanted.unbounded:
        loads = _loads(report, name, scene)
        if not loads or any(one.bounded for one in loads):
            yield f"{name} is {loads}, not unbounded"


def _loads(report: FileReport, name: str, scene: str) -> list[Estimate]:
    return [
        load.estimate
        for one in report.scenes
        if scene in ("", one.name)
        for load in one.loads
        if load.info.name == name
    ]


def _misses(known: Known, report: FileReport) -> Iterator[str]:
    found = _loads(report, known.load, known.scene)
    if not found:
        yield f"there is no {known.load}"
    for one in found:
        room = known.within * (abs(known.value) or 1.0) if math.isfinite(known.value) else 0.0
        near = one.value == known.value or abs(one.value - known.value) <= room
        holds = one.low - ROUNDING * abs(known.value) <= known.value <= one.high + ROUNDING * abs(known.value)
        if math.isinf(known.value):
            holds = one.low <= known.value <= one.high
        if not (near and (holds or not known.exact)):
            yield f"{known.load} is {one}, not {known.value!r} within {known.within:g}"


def hard_machines(folder: Path) -> list[Path]:
    """The files of the zoo, sorted."""
    return sorted(folder.glob("*.yaml"))
