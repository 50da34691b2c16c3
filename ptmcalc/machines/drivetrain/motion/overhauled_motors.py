"""Motors that the load drives in a run: braking reserves that change with time, and motors beyond their curve."""

import math

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.components.motor_torque import overhauled_torque
from ptmcalc.contract.result import Failure, Found, of
from ptmcalc.machines.drivetrain.machine.keys.torques import MotorOn
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain, TrainScene
from ptmcalc.machines.drivetrain.motion.course import Course
from ptmcalc.machines.drivetrain.motors.overhauling import LOAD, overhauled, parts_with_motors, path_of

_OVERSPEED = 1.2
"""Speed of a motor for a short time relative to no-load speed [1], IEC 60034-1, 9.7. A larger value accepts faster
lowering; a smaller one refuses motors that withstand it."""


def seen(spec: Drivetrain, scene: TrainScene, course: Course) -> tuple[dict[str, Found], tuple[Failure, ...]]:
    """Reserves of loads that change with time, and motors that the load has driven beyond their curve in a run.

    A motor is beyond its curve at a speed above that of its greatest braking torque, where the load is larger than the
    torque that is left at the end of the run, or above its overspeed. Below that speed the reserve is the greatest
    braking torque over the largest one of the run.
    """
    listed = {one.motor: one for one in overhauled(spec, scene)}
    loads: dict[str, Found] = {}
    failures: list[Failure] = []
    for part in parts_with_motors(spec, course.case) if listed else ():
        name = part.motors[0][0]
        if name not in listed or not any(overhauled_torque(one.motor) for _, one in part.motors):
            continue  # motors that never brake: no curve to go beyond
        speed = _of(course, "speed", spec.motors[name].at)
        runs_away = speed[0] > part.greatest and part.at_speed(speed[0], course.record.time) < 1
        if runs_away or speed[1] > max(part.greatest, _OVERSPEED * part.no_load):
            failures.append(_failure(spec, part.motors[0], speed[1]))
            continue
        if listed[name].lasting or listed[name].reserve >= 1 or not speed[1] <= part.greatest:
            continue
        used = {motor: -_of(course, "drive", motor)[2] for motor, _ in part.motors}
        shares = [
            one.count * overhauled_torque(one.motor) / used[motor] for motor, one in part.motors if used[motor] > 0
        ]
        loads[of(LOAD, name)] = Found(Estimate.exact(min(shares, default=math.inf)))
    return loads, tuple(failures)


def _failure(spec: Drivetrain, motor: tuple[str, MotorOn], speed: float) -> Failure:
    name, one = motor
    now = units.show(speed, units.ANGULAR_SPEED)
    message = f"the load drives `{one.at}` at {now}, above the speed of the maximum braking torque of the motor"
    return Failure("DRV111", message, path_of(spec, name), "increase the motor torque, or add a brake", name)


def _of(course: Course, what: str, name: str) -> tuple[float, float, float]:
    """Last, largest and smallest value of a signal."""
    index = course.index(what, name)
    if index is None:
        return 0.0, 0.0, 0.0
    record = course.record
    return float(record.last[index]), float(record.top.values[index]), float(record.bottom.values[index])
