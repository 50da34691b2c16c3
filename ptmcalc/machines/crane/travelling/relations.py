"""Relations between the loads of a travelling crane that hold for every crane at every moment."""

from collections.abc import Mapping

from ptmcalc.contract.relation import Relation, computed, ordered
from ptmcalc.machines.crane.travelling.machine import model
from ptmcalc.machines.crane.travelling.machine.scenes import (
    MOVING,
    Run,
    Storm,
    TravelScene,
)
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.spec.scene import Scene

_MOVES: frozenset[type[Scene]] = frozenset(MOVING)
_ON_WHEELS: frozenset[type[Scene]] = _MOVES | {Run, Storm}
Numbers = Mapping[str, float]


def _utilisation(spec: Travelling, scene: TravelScene, loads: Numbers) -> float:
    return loads["torque_motor_max"] / spec.drive.torque


def _power(spec: Travelling, scene: TravelScene, loads: Numbers) -> float:
    return loads["torque_motor_travel"] * model.motor_speed(spec)


def _storm(spec: Travelling, scene: TravelScene, loads: Numbers) -> float:
    return loads["holding_force"] / loads["storm_force"]


RELATIONS: tuple[Relation, ...] = (
    ordered("wheel_load_max", "wheel_load_min", _ON_WHEELS, "the maximum wheel load is at least the minimum"),
    ordered("corner_load_max", "corner_load_min", frozenset({Run}), "the maximum corner load is at least the minimum"),
    ordered("skid_reserve", "skid_reserve_min", _MOVES, "the minimum adhesion reserve is at most that of a corner"),
    ordered("sway_angle_max", "sway_residual", _MOVES, "the residual sway is at most the maximum sway angle"),
    computed(
        "drive_utilisation", ("torque_motor_max",), _utilisation, _MOVES,
        "the drive utilisation is the ramp torque divided by the mean starting torque",
    ),
    computed(
        "power_travel", ("torque_motor_travel",), _power, frozenset({Run}), "power is torque times speed of the motors"
    ),
    computed(
        "storm_reserve", ("holding_force", "storm_force"), _storm, frozenset({Storm}),
        "the out-of-service reserve is the holding force divided by the driving force",
    ),
)  # fmt: skip
