"""The runs of all scenes and their seconds, foreseen before they are made."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.result import Found, Result, family
from ptmcalc.engine.judge import judge
from ptmcalc.engine.next_run import next_run, wanted_loads
from ptmcalc.engine.plan import Plan, Rung, ScenePlan
from ptmcalc.engine.run import WORK_BUDGET, settle
from ptmcalc.engine.settled import Settled, learn
from ptmcalc.engine.widen import widen
from ptmcalc.spec.machine import MachineSpec

_CHEAP = 0.01
"""Predicted seconds of a run that is made to predict the others. A numerical choice: a larger value predicts better and
takes longer."""
_ANYTHING = 1.0
"""Value of a load that no run knows yet, in the load's unit, for the prediction of a run. Any finite value serves: only
whether its bound is finite is used."""


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
        following = next_run(seen, spec, waiting, wanted_loads(kind, spec, seen, whole=True))
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
    learn(seen, rung, result, estimates)
