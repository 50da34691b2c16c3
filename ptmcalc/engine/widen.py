"""Error bars of a run with the bounds of the effects that it leaves out."""

from ptmcalc.base.estimate import NOTHING, Estimate
from ptmcalc.contract.result import Result
from ptmcalc.engine.plan import Rung, ScenePlan
from ptmcalc.spec.machine import MachineSpec


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
