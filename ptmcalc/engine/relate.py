"""Relations between the loads of a scene: intervals that narrow each other, and loads that contradict each other."""

import math
from collections.abc import Iterator, Mapping

from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.relation import Relation
from ptmcalc.contract.result import family, of
from ptmcalc.spec.machine import MachineSpec
from ptmcalc.spec.scene import Scene

_ROUNDING = 1e-9
"""Relative difference of two loads by different formulas [1] that counts as rounding, above the resolution 2e-16 of the
floating point. A smaller value reports rounding as a contradiction; a larger one hides small contradictions."""
_ROUNDS = 3
"""Passes over the relations: one load narrows the next. Derived: no declared chain of relations is longer. Fewer leave
loads wider; more change nothing."""


def related(
    kind: AnyKind, spec: MachineSpec, scene: Scene, loads: Mapping[str, Estimate]
) -> tuple[dict[str, Estimate], dict[str, str]]:
    """The loads narrowed by all relations of the kind, and by the name of each load that contradicts another, why."""
    found, broken = dict(loads), dict[str, str]()
    for _ in range(_ROUNDS):
        before = dict(found)
        for relation in kind.relations:
            if type(scene) not in relation.scenes:
                continue
            for names in _parts(relation, found):
                known = {name: found[actual] for name, actual in names.items()}
                if any(math.isnan(one.value) for one in known.values()):
                    continue
                for name, interval in relation.bounds(spec, scene, known).items():
                    narrower = narrowed(found[names[name]], interval)
                    if narrower is None:
                        broken |= dict.fromkeys(names.values(), f"{relation.why} ({', '.join(names.values())})")
                    else:
                        found[names[name]] = narrower
        if found == before:
            break
    return found, broken


def _parts(relation: Relation, loads: Mapping[str, Estimate]) -> Iterator[dict[str, str]]:
    """The loads of a relation by their names in it: as they are, or those of each part that has them.

    A load that a machine has once takes part in the relation of every part.
    """
    parts = {name.partition("[")[2].removesuffix("]") for name in loads if family(name) in relation.loads}
    for part in sorted(parts):
        names = {name: of(name, part) if part and of(name, part) in loads else name for name in relation.loads}
        own = not part or any(actual != name for name, actual in names.items())
        if own and all(actual in loads for actual in names.values()):
            yield names


def narrowed(estimate: Estimate, interval: Interval) -> Estimate | None:
    """An estimate inside an interval that is known to contain it; None where they do not intersect.

    Intervals that miss each other by rounding touch.
    """
    low, high = max(estimate.low, interval.low), min(estimate.high, interval.high)
    if low <= estimate.low and high >= estimate.high:
        return estimate
    if low > high:
        size = max((abs(end) for end in (low, high) if math.isfinite(end)), default=0.0)
        return None if low - high > _ROUNDING * size else estimate
    value = min(max(estimate.value, low), high)
    bar = max(high - value, value - low)
    return Estimate(value, low, high, min(estimate.numerical, bar), min(estimate.model, bar))
