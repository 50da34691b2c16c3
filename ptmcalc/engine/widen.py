"""Error bars of a run with the bounds of the effects that it leaves out."""

from collections.abc import Mapping

from ptmcalc.base.estimate import NOTHING, Estimate
from ptmcalc.contract.result import Result
from ptmcalc.engine.plan import PlannedEffect, Rung, ScenePlan
from ptmcalc.spec.machine import MachineSpec

_ROUNDING = 1e-12
"""Change of a load by a bound, relative to its value, that is rounding [1]. A numerical choice: a bound of nothing that
is a difference of two equal numbers is smaller, and a bound that an engineer sees is larger."""


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


def absent(
    planned: PlannedEffect, spec: MachineSpec, plan: ScenePlan, loads: Mapping[str, Estimate], carried: frozenset[str]
) -> bool:
    """Whether there is no such effect to report in a scene: its number is exactly 0, the file does not force it, and it
    changes none of the known loads.

    A simulated effect whose number is 0 is a term that vanishes. The bound of one that is not simulated counts, because
    some bounds are wider than the number: such an effect explains an error bar.
    """
    if planned.forced or not planned.absent:
        return False
    if planned.effect.name in carried:
        return True
    offsets = planned.effect.bound(spec, plan.scene, loads)
    return all(
        max(-offset.low, offset.high) <= _ROUNDING * abs(loads[name].value)
        for name, offset in offsets.items()
        if name in loads
    )
