"""Relations between the loads of a stacker crane that hold in every scene."""

import math
from collections.abc import Mapping

from ptmcalc.contract.relation import Relation, computed, ordered
from ptmcalc.contract.result import of
from ptmcalc.machines.crane.stacking.machine import model
from ptmcalc.machines.crane.stacking.machine.columns import swinging
from ptmcalc.machines.crane.stacking.machine.loads import MODES
from ptmcalc.machines.crane.stacking.machine.rack import RackStacker
from ptmcalc.machines.crane.stacking.machine.scenes import (
    Brake,
    DrivenScene,
    ForkCaught,
    ForkPush,
    HoistScene,
    ObstacleScene,
    RailScene,
    SafetyGearScene,
    StackerScene,
    Stand,
    Start,
)
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.rail.base import wheel_load
from ptmcalc.machines.crane.stacking.strength.derived import MARKED_BY
from ptmcalc.spec.scene import Scene

Loads = Mapping[str, float]

_HOISTS: frozenset[type[Scene]] = frozenset({HoistScene})
_DRIVEN: frozenset[type[Scene]] = frozenset({Start, Brake})
_HITS: frozenset[type[Scene]] = frozenset({ObstacleScene})
_CAUGHT: frozenset[type[Scene]] = frozenset({ForkCaught})
_ROLLS: frozenset[type[Scene]] = frozenset({RailScene})
_FALLS: frozenset[type[Scene]] = frozenset({SafetyGearScene})
_SWINGS = _DRIVEN | {Stand}
_FIRST = of("natural_frequency", MODES[0])
_SCENE_OF: dict[str, type[Scene]] = {
    "start": Start,
    "brake": Brake,
    "obstacle": ObstacleScene,
    "fork_caught": ForkCaught,
    "fork_push": ForkPush,
    "rail": RailScene,
    "safety_gear": SafetyGearScene,
}


def _rope_safety(spec: Stacker, scene: StackerScene, loads: Loads) -> float:
    strength, pull = spec.hoisting.rope.breaking_force, loads["rope_force"]
    return strength / pull if strength is not None and pull > 0 else math.inf


def _period(spec: Stacker, scene: StackerScene, loads: Loads) -> float:
    return 2 * math.pi / loads[_FIRST] if loads[_FIRST] > 0 else math.inf


def _column(spec: Stacker, scene: StackerScene) -> float:
    """Stiffness at the far end, without what weights do to it: the column's own force goes by it [N/m]."""
    if isinstance(scene, DrivenScene):
        push = model.driving(spec, scene) if isinstance(scene, Start) else model.stopping(spec, scene)
        return swinging(spec, scene, push.rotors).stiffness
    return swinging(spec, scene).stiffness


def _swing_force(spec: Stacker, scene: StackerScene, loads: Loads) -> float:
    return _column(spec, scene) * loads["mast_deflection_max"]


def _blow_force(spec: Stacker, scene: StackerScene, loads: Loads) -> float:
    return _column(spec, scene) * loads["collision_deflection"]


def _caught_factor(spec: Stacker, scene: StackerScene, loads: Loads) -> float:
    return loads["rope_force_caught"] / model.weight(spec, scene)


def _gear_factor(spec: Stacker, scene: StackerScene, loads: Loads) -> float:
    return loads["safety_gear_force"] / model.weight(spec, scene)


def _wheel_force(spec: Stacker, scene: StackerScene, loads: Loads) -> float:
    assert isinstance(spec, RackStacker)
    assert isinstance(scene, RailScene)
    return loads["phi4"] * wheel_load(spec, scene)


def _marks(combination: str, load: str, scene: type[Scene]) -> Relation:
    """The load of an event that marks a combination is the load of that combination."""
    return computed(
        of("combination_force", combination),
        (load,),
        lambda spec, scene, loads: loads[load],
        frozenset({scene}),
        "the load of a combination is that of its event",
    )


RELATIONS: tuple[Relation, ...] = (
    ordered("roller_reaction", "roller_load", _HOISTS, "a roller carries at most the reaction of its set"),
    computed(
        "rope_safety",
        ("rope_force",),
        _rope_safety,
        _HOISTS,
        "the rope safety factor is the breaking force divided by the rope pull",
    ),
    computed("period", (_FIRST,), _period, _SWINGS, "the period is that of the first natural frequency"),
    computed(
        "mast_force_max",
        ("mast_deflection_max",),
        _swing_force,
        _DRIVEN,
        "the mast force is the product of mast stiffness and dynamic deflection",
    ),
    computed(
        "collision_force",
        ("collision_deflection",),
        _blow_force,
        _HITS,
        "the mast force is the product of mast stiffness and deflection",
    ),
    computed(
        "fork_caught_factor",
        ("rope_force_caught",),
        _caught_factor,
        _CAUGHT,
        "the factor is the rope force divided by the weight",
    ),
    computed("wheel_force", ("phi4",), _wheel_force, _ROLLS, "the load of a wheel is phi4 times the static one"),
    computed(
        "safety_gear_factor",
        ("safety_gear_force",),
        _gear_factor,
        _FALLS,
        "the factor is the force divided by the weight",
    ),
)


def relations_of(word: str) -> tuple[Relation, ...]:
    """The relations of a type: with those of the combinations that it has."""
    return (*RELATIONS, *(_marks(*mark, _SCENE_OF[scene]) for scene, mark in MARKED_BY[word].items()))
