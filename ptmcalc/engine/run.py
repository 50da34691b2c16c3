"""Plan -> results: run the solvers of a scene in order of cost, only while something is undecided."""

from collections.abc import Callable, Container, Sequence
from dataclasses import replace

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.errors import NumericsError
from ptmcalc.base.memory import MEMORY_BUDGET, limited
from ptmcalc.contract.check import AnyCheck
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.result import Finding, Result
from ptmcalc.engine.judge import Ruling, contradicted, found_to_fail, judge
from ptmcalc.engine.next_run import next_run, wanted_loads
from ptmcalc.engine.plan import Rung, RungKey, ScenePlan
from ptmcalc.engine.relate import related
from ptmcalc.engine.scene_findings import beyond_budget, contradictions, open_ends, unreached
from ptmcalc.engine.settled import Run, Settled, learn
from ptmcalc.engine.widen import widen
from ptmcalc.spec.machine import MachineSpec

WORK_BUDGET = 60.0
"""Predicted seconds of a scene. A numerical choice; they are predicted, not measured, so that verdicts are equal on
every machine. A larger value decides more checks and takes longer."""
NO_MEMORY = f"takes more memory than {MEMORY_BUDGET >> 30} GiB, the budget of a run, or than there is"
"""Message of a computation without sufficient memory, with the work memory in GiB (2^30 bytes). It may succeed at
another time."""


def settle(
    kind: AnyKind,
    spec: MachineSpec,
    scene: ScenePlan,
    *,
    budget: float = WORK_BUDGET,
    only: AnyCheck | None = None,
    verdicts: Container[tuple[str, str]] | None = None,
    until: Callable[[Rung], bool] = lambda rung: True,
    known: Sequence[Run] = (),
    later: Container[RungKey] = (),
) -> Settled:
    """Run the cheapest rung, then the next that can help, until every verdict and the accuracy asked for stand.

    `only` settles one check and nothing else, `verdicts` those of some checks, by code and element: neither loads that
    none of them reads nor the accuracy asked for; `until` limits the rungs that may run (for predictions); `known` are
    runs that were made and would have the same results. Rungs of `later` run only if the others do not decide.
    """
    settled = Settled(scene)
    results = {run.rung.key: run.result for run in known}
    whole = only is None and verdicts is None
    if verdicts is not None:
        spec = spec.model_copy(update={"accuracy": None})
    for solver in scene.formulas if whole else ():
        price = solver.cost(spec, scene.scene, solver.represents, 0)
        if price > budget:
            continue  # what is only shown is worth no more than what decides
        settled.beside += price
        rung = Rung(solver, solver.represents, 0, 0.0)
        shown = _made(settled, spec, rung)
        if shown is not None:
            settled.shown.append(Run(rung, shown))
            for name, found in shown.loads.items():
                settled.formulas.setdefault(name, {})[solver.name] = found.estimate.value
    postponed = {rung.key for rung in scene.rungs if rung.key in later and rung.key not in results}
    waiting = [rung for rung in scene.rungs if rung.key not in postponed]
    shown_for = settled.beside
    while True:
        if settled.runs or not waiting:
            settled.rulings = _rulings(kind, spec, settled, only, verdicts)
            following = next_run(settled, spec, waiting, wanted_loads(kind, spec, settled, whole=whole))
        else:
            following = waiting[0]  # nothing is known yet: whatever is wanted, the cheapest run comes first
        runs = following is not None and until(following) and settled.spent - shown_for + following.seconds <= budget
        if postponed and not runs:
            waiting = [rung for rung in scene.rungs if rung in waiting or rung.key in postponed]
            postponed = set()
            continue
        settled.next_rung = following
        if following is not None and runs:
            waiting.remove(following)
            _climb(settled, spec, following, results.get(following.key))
            _relate(kind, spec, settled)
            continue
        if not settled.runs:
            settled.rulings = _rulings(kind, spec, settled, only, verdicts)
        settled.findings += contradictions(settled)
        settled.findings += open_ends(settled)
        if following is None:
            settled.findings += unreached(kind, spec, settled) if whole else ()
        elif until(following):
            settled.findings.append(beyond_budget(kind, spec, settled, waiting, budget, whole=whole))
        return settled


def _rulings(
    kind: AnyKind,
    spec: MachineSpec,
    settled: Settled,
    only: AnyCheck | None,
    verdicts: Container[tuple[str, str]] | None,
) -> tuple[Ruling, ...]:
    """How the checks that are asked about stand by what is known so far."""
    whole = only is None and verdicts is None
    rulings = tuple(
        found_to_fail(one, failure)
        if one.verdict is not Verdict.OFF and (failure := settled.failure_of(one.check))
        else contradicted(one, settled.broken | settled.disjoint)
        for one in judge(kind, spec, settled.plan.scene, settled.estimates)
        if one.verdict is not Verdict.OFF or whole
    )
    if only is not None:
        rulings = tuple(ruling for ruling in rulings if ruling.check.is_of(only))
    if verdicts is not None:
        rulings = tuple(r for r in rulings if (r.check.code, r.check.element) in verdicts)
    return rulings


def _made(settled: Settled, spec: MachineSpec, rung: Rung) -> Result | None:
    """The result of a rung; None, and a finding, where its numerics break down or find no memory."""
    scene = settled.plan.scene
    try:
        with limited():
            return rung.solver.run(spec, scene, rung.carried, rung.level)
    except NumericsError as error:
        settled.findings.append(Finding(error.code, f"scene `{scene.label}`, {rung.solver.name}: {error.message}"))
        settled.beside += max(rung.seconds, error.spent)
        return None
    except MemoryError:
        said = f"scene `{scene.label}`, {rung.solver.name}: the computation {NO_MEMORY}"
        settled.findings.append(Finding("NUM103", said))
        settled.beside += rung.seconds
        return None


def _climb(settled: Settled, spec: MachineSpec, rung: Rung, known: Result | None) -> None:
    """Run a rung, unless its result is known, and keep every load it knows better."""
    scene, result = settled.plan.scene, known or _made(settled, spec, rung)
    if result is None:
        return
    estimates = widen(settled.plan, spec, rung, result)
    for name in learn(settled, rung, result, estimates):
        settled.findings.append(
            Finding("NUM101", f"scene `{scene.label}`, {rung.solver.name}: `{name}` is not a number")
        )


def _relate(kind: AnyKind, spec: MachineSpec, settled: Settled) -> None:
    """Narrow the loads by the relations of the kind, and keep what contradicts."""
    if not kind.relations:
        return
    loads, settled.broken = related(kind, spec, settled.plan.scene, settled.estimates)
    for name, best in settled.loads.items():
        if loads[name] is not best.estimate:
            settled.loads[name] = replace(best, found=replace(best.found, estimate=loads[name]))
