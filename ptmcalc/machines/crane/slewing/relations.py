"""Relations between the loads of a slewing crane that hold for every crane at every moment."""

from collections.abc import Mapping

from ptmcalc.contract.relation import Relation, computed, ordered
from ptmcalc.machines.crane.slewing.machine.spec import Slew, SlewingCrane, SlewingScene
from ptmcalc.spec.scene import Scene

_SLEWS: frozenset[type[Scene]] = frozenset({Slew})
Numbers = Mapping[str, float]


def _whole(spec: SlewingCrane, scene: SlewingScene, loads: Numbers) -> float:
    return loads["start_time"] + loads["steady_time"] + loads["brake_time"]


def _used(spec: SlewingCrane, scene: SlewingScene, loads: Numbers) -> float:
    return (loads["start_angle"] + loads["brake_angle"]) / spec.cycle.rotation


def _steady(spec: SlewingCrane, scene: SlewingScene, loads: Numbers) -> float:
    return loads["steady_angle"] / spec.speed


RELATIONS: tuple[Relation, ...] = (
    ordered("sway_max", "sway_radial_max", _SLEWS, "the angle of the rope is at least the radial one"),
    ordered("sway_max", "sway_tangential_max", _SLEWS, "the angle of the rope is at least the tangential one"),
    ordered("sway_max", "sway_residual", _SLEWS, "the residual sway is at most the maximum angle of the rope"),
    computed(
        "cycle_time", ("start_time", "steady_time", "brake_time"), _whole, _SLEWS,
        "the time of a slewing motion is the sum of starting, steady slewing and stopping time",
    ),
    computed(
        "rotation_used", ("start_angle", "brake_angle"), _used, _SLEWS, "the angle share is that of start and stop"
    ),
    computed("steady_time", ("steady_angle",), _steady, _SLEWS, "steady slewing is at the speed of the crane"),
)  # fmt: skip
