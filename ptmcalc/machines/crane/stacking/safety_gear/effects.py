"""Effect of the safety gear."""

from collections.abc import Mapping

from ptmcalc.base.estimate import ANYTHING, Estimate, Interval
from ptmcalc.contract.effect import AnyEffect, Criterion, Effect
from ptmcalc.machines.crane.stacking.machine.scenes import SafetyGearScene
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.safety_gear.fall import fall_of
from ptmcalc.spec.scene import Scene

Loads = Mapping[str, Estimate]
Offsets = Mapping[str, Interval]
GEAR = "safety_gear"
FALLS: frozenset[type[Scene]] = frozenset({SafetyGearScene})
GEAR_THRESHOLD = 1.0
"""Force of the safety gear relative to the weight [1]. Derived: at or below 1 the gear does not decelerate the
carriage. Every run simulates the gear, so no error depends on the value. It affects the list of sensitive effects."""


def _anything(loads: Loads) -> Offsets:
    return dict.fromkeys(loads, ANYTHING)


def gear_criterion(spec: Stacker, scene: SafetyGearScene) -> Criterion:
    """Ratio of the gear force to the weight; the effect is never neglected.

        F/(M g)

    **Range** every stop by the safety gear; every run includes this effect.
    **Error** exact for the gear.
    **Source** `laws.safety_gear`.
    """
    one = fall_of(spec, scene)
    value = one.force / (one.mass * spec.gravity)
    return Criterion("ψ", value, GEAR_THRESHOLD, "safety gear force / weight", "laws.safety_gear")


def gear_bound(spec: Stacker, scene: SafetyGearScene, loads: Loads) -> Offsets:
    """No bound: the stop cannot be computed without this effect.

    **Range** every load of the stop by the safety gear.
    **Error** unbounded.
    **Source** no run neglects this effect.
    """
    return _anything(loads)


EFFECTS_OF_THE_SAFETY_GEAR: tuple[AnyEffect, ...] = (
    Effect(GEAR, "safety gear engagement", FALLS, gear_criterion, gear_bound),
)
