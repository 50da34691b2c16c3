"""Relations between the loads of a conveyor that hold for every belt at every moment."""

import math
from collections.abc import Mapping

from ptmcalc.contract.relation import Relation, computed, ordered
from ptmcalc.machines.conveyor.machine.model import breaking_force
from ptmcalc.machines.conveyor.machine.scenes import IN_MOTION, ConveyorScene, EmergencyStop, Run, Stop
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.spec.scene import Scene

_ANY: frozenset[type[Scene]] = IN_MOTION.union((Run,))
_STOPS: frozenset[type[Scene]] = frozenset((Stop, EmergencyStop))


def _safety(spec: Conveyor, scene: ConveyorScene, loads: Mapping[str, float]) -> float:
    strength, tension = breaking_force(spec), loads["tension_max"]
    return strength / tension if strength is not None and tension > 0 else math.inf


RELATIONS: tuple[Relation, ...] = (
    ordered("tension_max", "tension_run_on_max", _ANY, "the maximum tension anywhere is at least that at the pulley"),
    ordered("tension_run_off_min", "tension_min", _ANY, "the minimum tension anywhere is at most that at the pulley"),
    ordered(
        "stop_distance_max", "stop_distance", _STOPS, "the stopping distance of any point is at least that at the head"
    ),
    computed(
        "belt_safety_min",
        ("tension_max",),
        _safety,
        _ANY,
        "the belt safety factor is the breaking force divided by the maximum tension",
    ),
)
