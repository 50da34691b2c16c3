"""Relations between the loads of a drive train that hold for every train at every moment."""

import math
from collections.abc import Mapping

from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.contract.relation import Bounds, Relation, ordered
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain, Run, Start, Stop, TrainScene
from ptmcalc.spec.scene import Scene

_ANY: frozenset[type[Scene]] = frozenset({Run, Start, Stop})


def _rms(spec: Drivetrain, scene: TrainScene, loads: Mapping[str, Estimate]) -> Bounds:
    """The rms torque over no less than the time of the scene is at most the largest torque."""
    if spec.checks.cycle_time is not None:
        return {}
    return {
        "motor_torque_rms": Interval(0.0, loads["motor_torque_peak"].high),
        "motor_torque_peak": Interval(loads["motor_torque_rms"].low, math.inf),
    }


def _started(spec: Drivetrain, scene: Start, loads: Mapping[str, Estimate]) -> Bounds:
    """A start has a finite time exactly where its speed is reached."""
    time, share = loads["start_time"], loads["start_share"]
    if math.isfinite(time.high):
        return {"start_share": Interval(1.0, 1.0)}
    return {"start_time": Interval(0.0, math.inf)} if share.low < 1 else {}


def _stopped(spec: Drivetrain, scene: Stop, loads: Mapping[str, Estimate]) -> Bounds:
    """A stop has a finite time exactly where no speed is left."""
    return {"stop_speed_share": Interval(0.0, 0.0)} if math.isfinite(loads["stop_time"].high) else {}


RELATIONS: tuple[Relation, ...] = (
    ordered("speed_max", "speed_min", _ANY, "the maximum speed is at least the minimum speed"),
    ordered("speed_max", "speed_end", _ANY, "the maximum speed is at least the final speed"),
    ordered("speed_end", "speed_min", _ANY, "the final speed is at least the minimum speed"),
    Relation(
        ("motor_torque_rms", "motor_torque_peak"), _ANY, _rms, "the maximum motor torque is at least the rms torque"
    ),
    Relation(
        ("start_time", "start_share"),
        frozenset({Start}),
        _started,
        "a finite starting time means that the speed is reached",
    ),
    Relation(
        ("stop_time", "stop_speed_share"),
        frozenset({Stop}),
        _stopped,
        "a finite stopping time means a final speed of zero",
    ),
)
