"""A scene after its runs: the loads as known best, with the run and the accuracy of each, and what was found."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace

from ptmcalc.base.estimate import NOTHING, Estimate, Interval
from ptmcalc.base.units import TIME, show
from ptmcalc.contract.check import AnyCheck
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.result import Failure, Finding, Found, Result
from ptmcalc.engine.judge import Ruling
from ptmcalc.engine.plan import PlannedEffect, Rung, RungKey, ScenePlan
from ptmcalc.engine.relate import narrowed
from ptmcalc.spec.machine import MachineSpec


@dataclass(frozen=True, slots=True)
class Best:
    """A load as the best run so far knows it: all bars included, and the run it came from."""

    found: Found
    rung: Rung
    result: Result

    @property
    def estimate(self) -> Estimate:
        """The number with its whole bar."""
        return self.found.estimate

    @property
    def open_end(self) -> str:
        """How far its run went, and the state at the end: "computed to 4.67 s, belt at 1.43 of 3 m/s"."""
        until = f"computed to {show(self.result.window[1], TIME)}" if self.result.window else "not computed to the end"
        return f"{until}, {self.result.open_end}" if self.result.open_end else until


@dataclass(frozen=True, slots=True)
class Run:
    """One solver run that was made; `estimates` are its loads with the bounds of what it leaves out."""

    rung: Rung
    result: Result
    estimates: Mapping[str, Estimate] = field(default_factory=dict)


@dataclass(slots=True)
class Settled:
    """A scene after the climb."""

    plan: ScenePlan
    loads: dict[str, Best] = field(default_factory=dict)
    formulas: dict[str, dict[str, float]] = field(default_factory=dict)
    runs: list[Run] = field(default_factory=list)
    shown: list[Run] = field(default_factory=list)
    rulings: tuple[Ruling, ...] = ()
    findings: list[Finding] = field(default_factory=list)
    next_rung: Rung | None = None
    broken: dict[str, str] = field(default_factory=dict)
    """by load, the relation to others that it contradicts"""
    disjoint: dict[str, str] = field(default_factory=dict)
    """by load, the runs whose error bars do not intersect"""
    beside: float = 0.0
    """seconds of what is only shown, and of runs that were given up"""

    @property
    def spent(self) -> float:
        """Seconds of all that was run, predicted or, where that is more, by what was counted."""
        return self.beside + sum(max(run.rung.seconds, run.result.spent) for run in self.runs)

    @property
    def estimates(self) -> dict[str, Estimate]:
        """The loads as numbers with bars."""
        return {name: best.estimate for name, best in self.loads.items()}

    @property
    def said(self) -> list[Finding]:
        """What was found on the way; of several runs of a solver the richest and finest speaks for all, and a solver
        none of whose loads is reported any more leaves it to one that carries more."""
        best: dict[str, Run] = {}
        for run in self.runs:
            known = best.setdefault(run.rung.solver.name, run)
            if (len(run.rung.carried), run.rung.level) > (len(known.rung.carried), known.rung.level):
                best[run.rung.solver.name] = run
        reported = {load.rung.solver.name for load in self.loads.values()}
        heard = [
            run
            for name, run in best.items()
            if name in reported or not any(run.rung.carried < other.rung.carried for other in self.runs)
        ]
        said: dict[tuple[object, ...], int] = {}
        found: list[Finding] = []
        for number, run in enumerate(sorted(heard, key=lambda run: len(run.rung.carried), reverse=True)):
            found += [  # the same advice on the same key is heard once, from the richest run
                one
                for one in run.result.findings
                if not one.hint or said.setdefault((one.code, one.path, one.hint), number) == number
            ]
        return found + self.findings

    def failure_of(self, check: AnyCheck) -> Failure | None:
        """The failure that the richest and finest of the runs about a check found."""
        about = [
            run
            for run in self.runs
            if any(one.check == check.code for one in run.result.failures)
            or any(name in run.estimates for name in check.loads)
        ]
        richest = max(about, key=lambda run: (len(run.rung.carried), run.rung.level), default=None)
        found = richest.result.failures if richest is not None else ()
        return next((one for one in found if one.check == check.code and one.element in ("", check.element)), None)

    @property
    def superseded(self) -> Iterator[RungKey]:
        """Runs after which the same solver ran with more effects or a finer level."""
        for number, run in enumerate(self.runs):
            for other in self.runs[number + 1 :]:
                if other.rung.solver is run.rung.solver and other.rung.carried >= run.rung.carried:
                    yield run.rung.key

    @property
    def carried(self) -> frozenset[str]:
        """Effects that a run behind a reported load carried."""
        return frozenset(name for best in self.loads.values() for name in best.rung.carried)

    @property
    def near(self) -> list[PlannedEffect]:
        """Simulated effects whose number lies within a factor of 2 of the threshold."""
        return [
            planned
            for planned in self.plan.effects
            if planned.effect.name in self.carried and planned.criterion is not None and planned.criterion.near
        ]


def learn(settled: Settled, rung: Rung, result: Result, estimates: Mapping[str, Estimate]) -> list[str]:
    """Keep every load that a run knows better; names of those that are no numbers."""
    settled.runs.append(Run(rung, result, estimates))
    lost = []
    for name, estimate in estimates.items():
        if math.isnan(estimate.value):
            lost.append(name)
            continue
        known = settled.loads.get(name)
        narrower = narrowed(estimate, Interval(known.estimate.low, known.estimate.high)) if known else estimate
        if (
            narrower is None and known is not None and name not in result.health
        ):  # health is the run's, not the machine's
            solvers = f"`{known.rung.solver.name}` and `{rung.solver.name}`"
            settled.disjoint[name] = f"the error bars of `{name}` by {solvers} do not intersect"
        more = _forced_in(settled, rung) - (_forced_in(settled, known.rung) if known else 0)
        if known is None or more > 0 or (more == 0 and estimate.bar <= known.estimate.bar):
            found = result.loads[name]
            one_sided = known is not None and not known.estimate.bounded
            kept = narrower if (more > 0 or one_sided) and narrower is not None else estimate
            settled.loads[name] = Best(Found(kept, found.at, found.note), rung, result)
        elif not estimate.bounded:  # it may still know one side
            inside = narrowed(known.estimate, Interval(estimate.low, estimate.high))
            settled.loads[name] = replace(known, found=replace(known.found, estimate=inside or known.estimate))
    return lost


def _forced_in(settled: Settled, rung: Rung) -> int:
    """How many of the effects that the file forces on a run carries: a load of a run with more of them is reported,
    inside the error bar of the run before."""
    return sum(planned.must_run and planned.effect.name in rung.carried for planned in settled.plan.effects)


def inaccurate(kind: AnyKind, spec: MachineSpec, settled: Settled) -> list[str]:
    """Governing loads whose bars are wider than the accuracy asked for."""
    if spec.accuracy is None:
        return []
    known = [info.name for info in kind.loads_of(spec) if info.headline and info.name in settled.loads]
    return [name for name in known if not accurate(settled.loads[name], name, spec.accuracy)]


def accurate(known: Best, name: str, asked: float | None) -> bool:
    """Whether a load is as accurate as asked within the window of its run; what comes later no finer run knows."""
    estimate = known.estimate
    if asked is None or estimate.low == estimate.high:
        return True
    return bar_within(known, name) <= asked * abs(estimate.value)


def bar_within(known: Best, name: str) -> float:
    """Error bar of a load without what can still change after the window."""
    estimate, later = known.estimate, known.result.beyond.get(name, NOTHING)
    if not math.isfinite(estimate.value):
        return estimate.bar
    down = estimate.value - estimate.low + later.low if math.isfinite(later.low) else 0.0
    up = estimate.high - estimate.value - later.high if math.isfinite(later.high) else 0.0
    return max(down, up, known.result.loads[name].estimate.bar if name in known.result.loads else 0.0)
