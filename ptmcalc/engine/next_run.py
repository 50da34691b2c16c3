"""The next run of a scene: the loads that are still wanted, and the cheapest run that can improve one of them."""

import math
from collections.abc import Iterable, Iterator

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.result import family
from ptmcalc.engine.plan import Rung, ScenePlan
from ptmcalc.engine.settled import Best, Run, Settled, accurate, bar_within, inaccurate
from ptmcalc.engine.widen import widen
from ptmcalc.spec.machine import MachineSpec

_GOOD_PART, _SOME_PART, _MUCH_LESS = 0.25, 0.01, 0.5
"""Shares of an error bar that decide the next run [1]; numerical choices. `_GOOD_PART`: a cause with this share is
reduced first. `_SOME_PART`: a cause with this share comes next, and counts as numerical error worth another method.
`_MUCH_LESS`: a model with more effects must promise at most this part of the bar. Other values change the order of the
runs: a budget may then decide fewer checks."""


def wanted_loads(kind: AnyKind, spec: MachineSpec, settled: Settled, *, whole: bool) -> set[str]:
    """Loads that are not known yet or whose bars are still too wide: behind an undecided verdict, wider than the
    accuracy asked for, or, in a `whole` report, without any bound."""
    wanted = set(_unknown(kind, spec, settled)) if whole else set()
    for ruling in settled.rulings:
        if ruling.verdict in (Verdict.NOT_CHECKED, Verdict.OFF):
            continue
        for name in ruling.check.loads:
            known = settled.loads.get(name)
            if ruling.verdict is Verdict.UNDECIDED or known is None or not accurate(known, name, spec.accuracy):
                wanted.add(name)
    return wanted.union(inaccurate(kind, spec, settled))


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


def next_run(settled: Settled, spec: MachineSpec, waiting: Iterable[Rung], wanted: set[str]) -> Rung | None:
    """The cheapest waiting rung that can improve a wanted load, or that carries what the file insists on.

    What makes up a good part of a bar is tackled first: the grid by a finer setting, the model by a richer run.
    """
    forced = {planned.effect.name for planned in settled.plan.effects if planned.must_run} - settled.carried
    for share in (_GOOD_PART, _SOME_PART, 0.0):
        for rung in waiting:
            helps = any(can_help(settled, spec, rung, name, share) for name in wanted)
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


def can_help(settled: Settled, spec: MachineSpec, rung: Rung, name: str, share: float) -> bool:
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
    left_out = bar_within(best, name) - bar.numerical
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
