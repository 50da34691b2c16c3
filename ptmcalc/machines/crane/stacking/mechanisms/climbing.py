"""The carriage on its column: what its rollers bear and resist, what its ropes pull. Statics with inertia.

A file that does not say whether each plane has its own rollers gets numbers that hold for both: the sum of the
reactions as vectors, as one set bears them, up to the sum of their sizes, which the friction of separate sets goes by.
"""

import math
from dataclasses import dataclass

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found
from ptmcalc.laws import carriage, wire_rope
from ptmcalc.machines.crane.stacking.machine import model
from ptmcalc.machines.crane.stacking.machine.scenes import HoistScene
from ptmcalc.machines.crane.stacking.machine.spec import Stacker


@dataclass(frozen=True, slots=True)
class Range:
    """A number with what it may be at most and at least."""

    value: float
    low: float
    high: float

    def found(self, note: str = "") -> Found:
        spread = self.high - self.low if self.high > self.low else 0.0  # both may be infinite
        return Found(Estimate(self.value, self.low, self.high, model=spread), note=note)


def coefficient(spec: Stacker) -> float:
    """Resistance of a guide roller over what it bears [1]."""
    rollers = spec.carriage.rollers
    return float(
        carriage.roller_coefficient(rollers.pin_friction, rollers.axle_diameter, rollers.lever_arm, rollers.diameter)
    )


def factor(spec: Stacker) -> float:
    """Weight with inertia over weight: the carriage starts upwards, or comes to rest on its way down [1]."""
    return 1 + spec.hoisting.acceleration / spec.gravity


def _moments(spec: Stacker, scene: HoistScene) -> tuple[float, float]:
    return model.eccentric_moment(spec, scene, "along"), model.eccentric_moment(spec, scene, "across")


def _of_both_planes(spec: Stacker, along: float, across: float) -> Range:
    """What the friction of both planes goes by: joint rollers add as vectors, separate ones each for itself."""
    joint, separate = math.hypot(along, across), along + across
    planes = spec.carriage.rollers.planes
    if planes == "joint":
        return Range(joint, joint, joint)
    if planes == "separate":
        return Range(separate, separate, separate)
    return Range(joint, joint, separate)


def loads(spec: Stacker, scene: HoistScene) -> dict[str, Found]:
    """Reactions of the rollers, resistance of the guide, share of the weight it takes, pull and safety of a rope."""
    rollers, up = spec.carriage.rollers, scene.direction == "up"
    along, across = (
        float(carriage.roller_reaction(moment, rollers.distance, factor(spec))) for moment in _moments(spec, scene)
    )
    reaction = math.hypot(along, across)
    w = coefficient(spec)
    borne = _of_both_planes(spec, along, across)
    resist = Range(*(float(carriage.guide_resistance(size, w)) for size in (borne.value, borne.low, borne.high)))
    found = {
        "roller_reaction": Found(Estimate.exact(reaction), note="both planes as vectors" if across and along else ""),
        "roller_load": _of_one_roller(spec, along, across, reaction).found(),
        "carriage_resistance": resist.found(),
        "rope_force": _pull(spec, scene, resist, up=up).found(),
    }
    if not up:
        found["jamming"] = _jamming(spec, scene, w).found()
    breaking = spec.hoisting.rope.breaking_force
    if breaking is not None:
        pull = _pull(spec, scene, resist, up=up)
        ends = [float(wire_rope.rope_safety(breaking, one)) for one in (pull.value, pull.high, pull.low)]
        found["rope_safety"] = Range(*ends).found()
    return found


def _of_one_roller(spec: Stacker, along: float, across: float, joint: float) -> Range:
    rollers = spec.carriage.rollers
    most = max(along, across) / rollers.per_set
    both = joint / rollers.per_set
    if rollers.planes == "separate":
        return Range(most, most, most)
    return Range(both, both if rollers.planes == "joint" else most, both)


def _pull(spec: Stacker, scene: HoistScene, resist: Range, *, up: bool) -> Range:
    efficiency = model.tackle_efficiency(spec) if up else model.lowering_efficiency(spec)

    def pulled(resistance: float) -> float:
        falls = spec.hoisting.rope.falls
        return float(
            carriage.rope_pull(model.weight(spec, scene), factor(spec), resistance, falls, efficiency, hauling=up)
        )

    least, most = (resist.low, resist.high) if up else (resist.high, resist.low)
    return Range(pulled(resist.value), pulled(least), pulled(most))


def _jamming(spec: Stacker, scene: HoistScene, w: float) -> Range:
    moments = _moments(spec, scene)
    borne = _of_both_planes(spec, *(abs(moment) for moment in moments))
    weight, height = model.weight(spec, scene), spec.carriage.rollers.distance
    return Range(
        *(float(carriage.jamming_ratio(size, weight, height, w)) for size in (borne.value, borne.low, borne.high))
    )
