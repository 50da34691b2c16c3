"""Relations between the loads of a hoist that hold for every hoist at every moment."""

import math
from collections.abc import Callable, Mapping

from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.contract.relation import Bounds, Relation, computed, ordered
from ptmcalc.machines.hoist.machine import model
from ptmcalc.machines.hoist.machine.spec import Hoist, HoistScene, Lift, LowerBrake, Release, Run, Start, Stop
from ptmcalc.spec.scene import Scene

_MOVING: frozenset[type[Scene]] = frozenset((Lift, Start, Stop, LowerBrake, Release))
_HANGING: frozenset[type[Scene]] = frozenset((Start, Stop, LowerBrake, Release))
_RUN: frozenset[type[Scene]] = frozenset((Run,))
_ROUNDING = 1e-9
"""Relative widening of a relation of loads from different sums [1], above the resolution 2e-16 of the floating point. A
smaller value reports rounding as a contradiction; a larger one narrows loads less."""

Value = Callable[[Hoist, HoistScene, Mapping[str, float]], float]


def _rounded(load: str, of: str, value: Value, scenes: frozenset[type[Scene]], why: str) -> Relation:
    """`load = value(of)`, to rounding."""
    exact = computed(load, (of,), value, scenes, why)

    def bounds(spec: Hoist, scene: HoistScene, loads: Mapping[str, Estimate]) -> Bounds:
        one = exact.bounds(spec, scene, loads)[load]
        room = _ROUNDING * max(abs(side) for side in (one.low, one.high))
        return {load: Interval(one.low - room, one.high + room) if math.isfinite(room) else one}

    return Relation((load, of), scenes, bounds, why)


def _over_weight(force: str) -> Value:
    """Force relative to the weight on the hook before the scene."""

    def value(spec: Hoist, scene: HoistScene, loads: Mapping[str, float]) -> float:
        return loads[force] / (model.hook_mass(spec, scene) * spec.gravity)

    return value


def _safety(spec: Hoist, scene: HoistScene, loads: Mapping[str, float]) -> float:
    strength, pull = spec.rope.breaking_force, loads["rope_pull_max"]
    return strength / pull if strength is not None and pull > 0 else math.inf


_MAX = "the factor is the maximum rope force divided by the weight"
RELATIONS: tuple[Relation, ...] = (
    ordered("rope_force_max", "rope_force_min", _HANGING, "the maximum rope force is at least the minimum"),
    ordered("bridge_force_max", "bridge_force_min", _HANGING, "the maximum force is at least the minimum"),
    ordered("hook_speed_max", "hook_speed", _RUN, "the hook speed is highest on the last layer"),
    _rounded(
        "rope_safety",
        "rope_pull_max",
        _safety,
        _RUN,
        "the rope safety factor is the breaking force divided by the maximum rope pull",
    ),
    _rounded("lift_off_factor", "rope_force_max", _over_weight("rope_force_max"), frozenset((Lift,)), _MAX),
    _rounded("start_factor", "rope_force_max", _over_weight("rope_force_max"), frozenset((Start,)), _MAX),
    _rounded(
        "lowering_brake_factor",
        "rope_force_max",
        _over_weight("rope_force_max"),
        frozenset((LowerBrake,)),
        _MAX,
    ),
    _rounded(
        "rope_force_share",
        "rope_force_min",
        _over_weight("rope_force_min"),
        _HANGING,
        "the ratio is the minimum rope force divided by the weight",
    ),
    _rounded(
        "bridge_factor",
        "bridge_force_max",
        _over_weight("bridge_force_max"),
        _MOVING,
        "the factor is the maximum force on the structure divided by the weight",
    ),
)
