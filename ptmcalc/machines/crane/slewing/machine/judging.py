"""What the checks of a slewing crane share: scenes, keys, conditions."""

import math

from ptmcalc.base.span import KeyPath
from ptmcalc.components.motor_rating import number_at
from ptmcalc.contract.check import Check
from ptmcalc.machines.crane.slewing.machine import model
from ptmcalc.machines.crane.slewing.machine.spec import Slew, SlewingCrane, SlewingScene

OneCheck = Check[SlewingCrane, SlewingScene]
SLEWING = frozenset({Slew})


def reaches(spec: SlewingCrane, scene: SlewingScene) -> bool:
    """Whether the motor's curve carries the crane to its speed: of one that does not (CRN118) no start is asked."""
    least = model.least_torque(spec, scene)
    return least is None or model.at_column(spec, least) >= model.steady_torque(spec, scene)


def starts(spec: SlewingCrane, scene: SlewingScene) -> bool:
    """Whether the rigid crane starts: of one that stalls (CRN101, CRN118) no stop is asked."""
    return math.isfinite(model.start_of(spec, scene)[0]) and reaches(spec, scene)


def turns(spec: SlewingCrane, scene: SlewingScene) -> bool:
    """Whether the rigid crane starts and stops: of one that stalls (CRN101, CRN118), or that no brake stops (CRN105),
    nothing more is asked."""
    return starts(spec, scene) and math.isfinite((model.stop(spec, scene) or (0.0, 0.0))[0])


def torque_key(spec: SlewingCrane, scene: SlewingScene) -> KeyPath:
    """What says how strongly it starts, or in which time."""
    if spec.motor.mean_torque(1.0) is not None:
        return ("motor", spec.motor.torque_key)
    return ("cycle", "start_time" if spec.cycle.start_time is not None else "start_angle")


def torque_repair(spec: SlewingCrane, scene: SlewingScene) -> KeyPath:
    """The torque of the motors, where it is one number."""
    return curve_number(spec, torque_key(spec, scene))


def curve_number(spec: SlewingCrane, path: KeyPath) -> KeyPath:
    """The number that a key stands for: of the motors' curve, the one that all its torques grow with."""
    return number_at(path, spec.motor.curve, rated=spec.motor.power is not None)
