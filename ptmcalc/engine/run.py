"""Plan -> results: climb the ladder of a scene only while something is undecided."""

import math
from collections.abc import Callable, Container, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import NOTHING, Estimate, Interval
from ptmcalc.base.memory import MEMORY_BUDGET, limited
from ptmcalc.base.units import SHARE, TIME, show
from ptmcalc.contract.check import AnyCheck
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.result import Failure, Finding, Found, Result, family
from ptmcalc.engine.judge import Ruling, contradicted, found_to_fail, judge
from ptmcalc.engine.plan import Plan, PlannedEffect, Rung, ScenePlan
from ptmcalc.engine.relate import narrowed, related
from ptmcalc.spec.machine import MachineSpec

WORK_BUDGET = 60.0
"""Predicted seconds of a scene. A numerical choice; they are predicted, not measured, so that verdicts are equal on
every machine. A larger value decides more checks and takes longer."""
NO_MEMORY = f"takes more memory than {MEMORY_BUDGET >> 30} GiB, the budget of a run, or than there is"
"""Message of a computation without sufficient memory, with the work memory in GiB (2^30 bytes). It may succeed at
another time."""
_CHEAP = 0.01
"""Predicted seconds of a run that is made to predict the others. A numerical choice: a larger value predicts better and
takes longer."""
_ANYTHING = 1.0
"""Value of a load that no run knows yet, in the load's unit, for the prediction of a run. Any finite value serves: only
whether its bound is finite is used."""
_NAMED = 3
"""Loads that a message names; the rest is counted. An engineering choice: the message stays short."""
_GOOD_PART, _SOME_PART, _MUCH_LESS = 0.25, 0.01, 0.5
"""Shares of an error bar that decide the next run [1]; numerical choices. `_GOOD_PART`: a cause with this share is
reduced first. `_SOME_PART`: a cause with this share comes next, and counts as numerical error worth another method.
`_MUCH_LESS`: a model with more effects must promise at most this part of the bar. Other values change the order of the
runs: a budget may then decide fewer checks."""


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
    def carried(self) -> frozenset[str]:
        """Effects that a run behind a reported load carried."""
        return frozenset(name for best in self.loads.values() for name in best.rung.carried)


def settle(
    kind: AnyKind,
    spec: MachineSpec,
    scene: ScenePlan,
    *,
    budget: float = WORK_BUDGET,
    only: AnyCheck | None = None,
    verdicts: Container[tuple[str, str]] | None = None,
    until: Callable[[Rung], bool] = lambda rung: True,
) -> Settled:
    """Run the cheapest rung, then the next that can help, until every verdict and the accuracy asked for stand.

    `only` settles one check and nothing else, `verdicts` those of some checks, by code and element: neither loads that
    none of them reads nor the accuracy asked for; `until` limits the rungs that may run (for predictions).
    """
    settled = Settled(scene)
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
    waiting = list(scene.rungs)
    shown_for = settled.beside
    while True:
        if settled.runs or not waiting:
            settled.rulings = _rulings(kind, spec, settled, only, verdicts)
            following = _next(settled, spec, waiting, _wanted(kind, spec, settled, whole=whole))
        else:
            following = waiting[0]  # nothing is known yet: whatever is wanted, the cheapest run comes first
        settled.next_rung = following
        if following is not None and until(following) and settled.spent - shown_for + following.seconds <= budget:
            waiting.remove(following)
            _climb(settled, spec, following)
            _relate(kind, spec, settled)
            continue
        if not settled.runs:
            settled.rulings = _rulings(kind, spec, settled, only, verdicts)
        settled.findings += _contradictions(settled)
        settled.findings += _open_ends(settled)
        if following is None:
            settled.findings += _unreached(kind, spec, settled) if whole else ()
        elif until(following):
            settled.findings.append(_too_dear(kind, spec, settled, waiting, budget, whole=whole))
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


@dataclass(frozen=True, slots=True)
class Foreseen:
    """What a scene will come to: what was evaluated to see that far, all rungs in their order, and their seconds."""

    settled: Settled
    rungs: tuple[Rung, ...]
    seconds: float

    @property
    def carried(self) -> frozenset[str]:
        """Effects that a run will carry."""
        return self.settled.carried.union(*(rung.carried for rung in self.rungs[len(self.settled.runs) :]))


def foresee(made: Plan, *, budget: float = WORK_BUDGET) -> Iterator[Foreseen]:
    """The climbs of all scenes before they are made: cheap runs are made, dear ones imagined.

    An imagined run finds of each load what is known of it, without a numerical bar and with the bounds of what it
    leaves out. Of a load that a check reads and nobody knows in this scene it finds what another scene says of it, and
    the verdict stands if the bounds are finite.
    """
    elsewhere: dict[str, float] = {}
    for scene in made.scenes:
        coming = _foreseen(made.kind, made.spec, scene, budget, elsewhere)
        known = coming.settled.estimates.items()
        elsewhere |= {name: one.value for name, one in known if math.isfinite(one.value)}
        yield coming


def _foreseen(
    kind: AnyKind, spec: MachineSpec, scene: ScenePlan, budget: float, elsewhere: Mapping[str, float]
) -> Foreseen:
    settled = settle(kind, spec, scene, budget=budget, until=lambda rung: rung.seconds <= _CHEAP)
    made = tuple(run.rung for run in settled.runs)
    seen = Settled(scene, dict(settled.loads), settled.formulas, list(settled.runs), rulings=settled.rulings)
    rungs, following = list(made), settled.next_rung
    waiting = [rung for rung in scene.rungs if rung not in rungs]
    while following is not None and sum(rung.seconds for rung in rungs) + following.seconds <= budget:
        rungs.append(following)
        waiting.remove(following)
        _imagined(seen, kind, spec, following, elsewhere)
        seen.rulings = judge(kind, spec, scene.scene, seen.estimates)
        following = _next(seen, spec, waiting, _wanted(kind, spec, seen, whole=True))
    prices = [solver.cost(spec, scene.scene, solver.represents, 0) for solver in scene.formulas]
    beside = sum(price for price in prices if price <= budget)
    coming = Foreseen(settled, tuple(rungs), beside + sum(rung.seconds for rung in rungs))
    return replace(coming, seconds=coming.seconds + _again(scene, coming))


def _again(scene: ScenePlan, coming: Foreseen) -> float:
    """Seconds of the runs without each effect near its threshold, as `without` makes them."""
    richest = max(coming.rungs, key=lambda rung: (len(rung.carried), rung.level), default=None)
    if richest is None:
        return 0.0
    near = (p.effect.name for p in scene.effects if p.criterion is not None and p.criterion.near)
    return richest.seconds * sum(name in richest.carried - richest.solver.always for name in near)


def _imagined(seen: Settled, kind: AnyKind, spec: MachineSpec, rung: Rung, elsewhere: Mapping[str, float]) -> None:
    """Learn from a run what it may find."""
    known = {name: one.value for name, one in seen.estimates.items() if math.isfinite(one.value)}
    made = (ruling for ruling in seen.rulings if ruling.verdict is not Verdict.OFF)
    asked = {name for ruling in made for name in ruling.check.loads}.union(known)
    loads = (info.name for info in kind.loads_of(spec) if family(info.name) in rung.solver.gives)
    names = [name for name in loads if name in asked]  # not the stopping time of a start
    result = Result({name: Found(Estimate.exact(known.get(name, elsewhere.get(name, _ANYTHING)))) for name in names})
    estimates = widen(seen.plan, spec, rung, result)
    for name in names:
        if name not in known and estimates[name].bounded:
            estimates[name] = Estimate.exact(estimates[name].value)
    _learnt(seen, rung, result, estimates)


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


def _climb(settled: Settled, spec: MachineSpec, rung: Rung) -> None:
    """Run a rung and keep every load it knows better."""
    scene, result = settled.plan.scene, _made(settled, spec, rung)
    if result is None:
        return
    estimates = widen(settled.plan, spec, rung, result)
    for name in _learnt(settled, rung, result, estimates):
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


def _contradictions(settled: Settled) -> Iterator[Finding]:
    """Loads that contradict each other, each relation once."""
    for why in dict.fromkeys((settled.broken | settled.disjoint).values()):
        yield Finding("NUM111", f"scene `{settled.plan.scene.label}`: loads contradict each other: {why}")


def _open_ends(settled: Settled) -> Iterator[Finding]:
    """Windows that end before the motion is steady, of the runs behind the loads that can still change."""
    open_ones = (best for name, best in settled.loads.items() if name in best.result.beyond and best.result.open_end)
    for end in dict.fromkeys(best.open_end for best in open_ones):
        yield Finding("NUM112", f"scene `{settled.plan.scene.label}`: {end}")


def _learnt(settled: Settled, rung: Rung, result: Result, estimates: Mapping[str, Estimate]) -> list[str]:
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


def widen(plan: ScenePlan, spec: MachineSpec, rung: Rung, result: Result) -> dict[str, Estimate]:
    """The loads of a run with the bounds of every effect it leaves out, in the order of the kind's list.

    An excluded effect puts no bar on a load, and a part of an effect that is left out is inside that one's bound.
    """
    estimates = {name: found.estimate.widened(result.beyond.get(name, NOTHING)) for name, found in result.loads.items()}
    for planned in plan.effects:
        effect = planned.effect
        if planned.excluded or effect.name in rung.carried:
            continue
        if effect.part_of and effect.part_of not in rung.carried:
            continue
        offsets = effect.bound(spec, plan.scene, estimates)
        estimates = estimates | {
            name: estimates[name].widened(offset) for name, offset in offsets.items() if name in estimates
        }
    return estimates


def _wanted(kind: AnyKind, spec: MachineSpec, settled: Settled, *, whole: bool) -> set[str]:
    """Loads that are not known yet or whose bars are still too wide: behind an undecided verdict, wider than the
    accuracy asked for, or, in a `whole` report, without any bound."""
    wanted = set(_unknown(kind, spec, settled)) if whole else set()
    for ruling in settled.rulings:
        if ruling.verdict in (Verdict.NOT_CHECKED, Verdict.OFF):
            continue
        for name in ruling.check.loads:
            known = settled.loads.get(name)
            if ruling.verdict is Verdict.UNDECIDED or known is None or not _accurate(known, name, spec.accuracy):
                wanted.add(name)
    return wanted.union(_inaccurate(kind, spec, settled))


def _unknown(kind: AnyKind, spec: MachineSpec, settled: Settled) -> Iterator[str]:
    """Governing loads that no run has looked for and one can, or that none has bounded."""
    none: frozenset[str] = frozenset()
    looked_for = none.union(*(run.rung.solver.gives for run in settled.runs))
    left = none.union(*(rung.solver.gives for rung in settled.plan.rungs)) - looked_for
    for info in kind.loads_of(spec):
        if not info.headline:
            continue
        known = settled.loads.get(info.name)
        if known is None:
            if family(info.name) in left:
                yield info.name
        elif not known.estimate.bounded and math.isfinite(known.estimate.value):
            yield info.name


def _inaccurate(kind: AnyKind, spec: MachineSpec, settled: Settled) -> list[str]:
    """Governing loads whose bars are wider than the accuracy asked for."""
    if spec.accuracy is None:
        return []
    known = [info.name for info in kind.loads_of(spec) if info.headline and info.name in settled.loads]
    return [name for name in known if not _accurate(settled.loads[name], name, spec.accuracy)]


def _unreached(kind: AnyKind, spec: MachineSpec, settled: Settled) -> list[Finding]:
    """What to say where nothing is left to run and a governing load is still not as accurate as asked."""
    names = _inaccurate(kind, spec, settled)
    if not names or spec.accuracy is None:
        return []
    label = settled.plan.scene.label
    reason = f"nothing that is left to run brings {_closest(spec.accuracy, settled, names)}"
    return [Finding("NUM105", f"scene `{label}`: {reason}", ("accuracy",))]


def _closest(asked: float, settled: Settled, names: list[str]) -> str:
    """Loads that are not as accurate as asked, and how close the one stands that is known least closely."""
    known = [(settled.loads[name].estimate.value, _bar_within(settled.loads[name], name)) for name in names]
    wide = max(bar / abs(value) if value else math.inf for value, bar in known)
    how = f"the widest bar is {show(wide, SHARE, 2)}" if math.isfinite(wide) else "one load has no error bound"
    more = f" and {len(names) - _NAMED} more" if len(names) > _NAMED else ""
    return f"{', '.join(f'`{name}`' for name in names[:_NAMED])}{more} to {show(asked, SHARE)}: {how}"


def _too_dear(
    kind: AnyKind, spec: MachineSpec, settled: Settled, waiting: list[Rung], budget: float, *, whole: bool
) -> Finding:
    """What to say where the next run is beyond the budget: its price, that of all that may help, and what is open."""
    following = settled.next_rung
    assert following is not None
    wanted = _wanted(kind, spec, settled, whole=whole)
    helpful = [rung for rung in waiting if any(_helps(settled, spec, rung, name, 0.0) for name in wanted)]
    said = (
        f"scene `{settled.plan.scene.label}`: the next run ({following.solver.name}) is predicted to take"
        f" {following.seconds:.3g} s, beyond the budget of {budget:.3g} s"
    )
    if len(helpful) > 1:
        said += f"; all {len(helpful)} that may help would take {sum(rung.seconds for rung in helpful):.3g} s"
    names = _inaccurate(kind, spec, settled)
    if names and spec.accuracy is not None:
        said += f"; it may bring {_closest(spec.accuracy, settled, names)}"
    return Finding("NUM103", said)


def _accurate(known: Best, name: str, asked: float | None) -> bool:
    """Whether a load is as accurate as asked within the window of its run; what comes later no finer run knows."""
    estimate = known.estimate
    if asked is None or estimate.low == estimate.high:
        return True
    return _bar_within(known, name) <= asked * abs(estimate.value)


def _bar_within(known: Best, name: str) -> float:
    """Error bar of a load without what can still change after the window."""
    estimate, later = known.estimate, known.result.beyond.get(name, NOTHING)
    if not math.isfinite(estimate.value):
        return estimate.bar
    down = estimate.value - estimate.low + later.low if math.isfinite(later.low) else 0.0
    up = estimate.high - estimate.value - later.high if math.isfinite(later.high) else 0.0
    return max(down, up, known.result.loads[name].estimate.bar if name in known.result.loads else 0.0)


def _next(settled: Settled, spec: MachineSpec, waiting: Iterable[Rung], wanted: set[str]) -> Rung | None:
    """The cheapest waiting rung that can improve a wanted load, or that carries what the file insists on.

    What makes up a good part of a bar is tackled first: the grid by a finer setting, the model by a richer run.
    """
    forced = {planned.effect.name for planned in settled.plan.effects if planned.must_run} - settled.carried
    for share in (_GOOD_PART, _SOME_PART, 0.0):
        for rung in waiting:
            helps = any(_helps(settled, spec, rung, name, share) for name in wanted)
            if not settled.runs or forced & rung.carried or helps:
                return rung
    return next((rung for rung in waiting if any(_is_another_way(settled, rung, name) for name in wanted)), None)


def _is_another_way(settled: Settled, rung: Rung, name: str) -> bool:
    """Whether a solver that has not run carries what the best run of a load does, whose bar is its own numerics' and
    has no finer setting: a bound that cannot be sharpened, where a computation is left."""
    best = settled.loads.get(name)
    if best is None or family(name) not in rung.solver.gives or rung.solver is best.rung.solver:
        return False
    ran = any(run.rung.solver is rung.solver and run.rung.carried >= best.rung.carried for run in settled.runs)
    finer = any(
        one.solver is best.rung.solver and one.carried == best.rung.carried and one.level > best.rung.level
        for one in settled.plan.rungs
    )
    bar = best.estimate
    own = bar.bounded and bar.numerical >= _SOME_PART * bar.bar > 0
    return own and not ran and not finer and rung.carried >= best.rung.carried


def _helps(settled: Settled, spec: MachineSpec, rung: Rung, name: str, share: float) -> bool:
    """Whether a rung can narrow the bar of a load: by an effect no run has carried for it, where the model makes up
    so much of the bar, or by a finer setting of a run where the grid does. One that leaves out what the best run
    carries helps where the bounds of all it leaves out come to much less than the bar."""
    if family(name) not in rung.solver.gives:
        return False
    same = [run for run in settled.runs if run.rung.solver is rung.solver and run.rung.carried == rung.carried]
    best = settled.loads.get(name)
    if best is None:
        return not same
    if not rung.carried >= best.rung.carried:
        return not same and _promises_less(settled.plan, spec, rung, name, best)
    ran = {effect for run in settled.runs if name in run.estimates for effect in run.rung.carried}
    bar = best.estimate
    left_out = _bar_within(best, name) - bar.numerical
    model = not bar.bounded or (left_out > 0 and left_out >= share * bar.bar)
    coarser = [run for run in same if run.rung.level < rung.level and name in run.estimates]
    finer = any(_worth_refining(run, rung, name, bar, share) for run in coarser)
    richer = rung.carried - best.rung.carried
    blind = not bar.bounded and not same and bool(richer)  # each effect may have been carried, but never all together
    return finer or blind or (model and bool(richer - ran))


def _promises_less(plan: ScenePlan, spec: MachineSpec, rung: Rung, name: str, best: Best) -> bool:
    """Whether a rung brings effects the best run left out, and a bar of much less by what it leaves out itself."""
    if not rung.carried - best.rung.carried or not best.estimate.bounded:
        return False
    promised = widen(plan, spec, rung, best.result).get(name)
    return promised is not None and promised.bounded and promised.bar <= _MUCH_LESS * best.estimate.bar


def _worth_refining(run: Run, finer: Rung, name: str, best: Estimate, share: float) -> bool:
    """Whether the grid makes up so much of a run's bar, and at first order, half of it a level, would beat the best."""
    own = run.estimates[name]
    promised = own.numerical / 2 ** (finer.level - run.rung.level)
    return own.bounded and own.numerical > share * own.bar and not promised > best.bar


def sensitive(settled: Settled) -> list[PlannedEffect]:
    """Simulated effects whose number lies within a factor of 2 of the threshold."""
    return [
        planned
        for planned in settled.plan.effects
        if planned.effect.name in settled.carried and planned.criterion is not None and planned.criterion.near
    ]


def without(
    settled: Settled, spec: MachineSpec, name: str
) -> tuple[Mapping[str, Estimate], Mapping[str, Estimate]] | None:
    """The loads of a run of all that was carried, and of the same again with one effect and its parts left out, or None
    when that cannot be made.

    It is the coarsest of those runs: its errors are much the same with the effect and without it, and finer runs are
    made for verdicts. A solver that cannot leave the effect out gives way to the best run that did without it.
    """
    gone = {p.effect.name for p in settled.plan.effects if name in (p.effect.name, p.effect.part_of)}
    richest = max(settled.runs, key=lambda run: (len(run.rung.carried), run.rung.level))
    solver, carried = richest.rung.solver, richest.rung.carried
    if name not in carried:
        return None
    if gone & solver.always:
        spared = [run for run in settled.runs if not gone & run.rung.carried]
        return (richest.estimates, _loads_of(spared[-1].result)) if spared else None
    alike = (run for run in settled.runs if run.rung.solver is solver and run.rung.carried == carried)
    coarsest = min(alike, key=lambda run: run.rung.level)
    try:
        result = solver.run(spec, settled.plan.scene, carried - gone, coarsest.rung.level)
    except (NumericsError, MemoryError):
        return None
    return coarsest.estimates, _loads_of(result)


def _loads_of(result: Result) -> dict[str, Estimate]:
    return {load: found.estimate for load, found in result.loads.items()}
