"""What the checks of a travelling crane share: scenes, keys, limits."""

import math
from collections.abc import Mapping

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.components.motor_rating import number_at
from ptmcalc.contract.check import Check
from ptmcalc.machines.crane.travelling.machine import model
from ptmcalc.machines.crane.travelling.machine.scenes import (
    Brake,
    Collision,
    HoistWhileTravelling,
    Moving,
    RailStep,
    Run,
    Start,
    TravelScene,
)
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.spec.scene import Scene

Loads = Mapping[str, Estimate]
OneCheck = Check[Travelling, TravelScene]
STARTS: frozenset[type[Scene]] = frozenset({Start, HoistWhileTravelling})
MOVES: frozenset[type[Scene]] = STARTS | {Brake}
RUNNING: frozenset[type[Scene]] = frozenset({Run})
HITS: frozenset[type[Scene]] = frozenset({Collision})
STEPS: frozenset[type[Scene]] = frozenset({RailStep})


def hangs(spec: Travelling, scene: TravelScene) -> bool:
    """Whether anything hangs on the ropes."""
    return model.hanging(spec, scene) > 0


def torque_key(spec: Travelling) -> KeyPath:
    """What says how strongly the motors start."""
    motor = spec.drive.motor
    if motor.mean_starting_torque is not None:
        return ("drive", "motor", "mean_starting_torque")
    if motor.largest_starting_torque is not None:
        return ("drive", "motor", "largest_starting_torque")
    return ("drive", "motor", "curve")


def torque_repair(spec: Travelling, scene: TravelScene) -> KeyPath:
    """The torque of the motors, where it is one number."""
    return curve_number(spec, torque_key(spec))


def curve_number(spec: Travelling, path: KeyPath) -> KeyPath:
    """The number that a key stands for: of the motors' curve, the one that all its torques grow with."""
    motor = spec.drive.motor
    return number_at(path, motor.curve, rated=motor.power is not None)


def rate_key(spec: Travelling, scene: Moving) -> KeyPath:
    """What says how fast a start or a stop is."""
    if model.starts(scene):
        if spec.drive.ramp_time is not None:
            return ("drive", "ramp_time")
        return ("drive", "acceleration") if spec.drive.acceleration is not None else torque_key(spec)
    return ("drive", "deceleration") if model.commanded(spec, scene) is not None else ("drive", "brake", "torque")


def rating(value: float | None) -> Estimate:
    return Estimate.exact(math.inf if value is None else value)
