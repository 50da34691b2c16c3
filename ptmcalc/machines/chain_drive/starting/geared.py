"""A start of the rigid chain with a star-delta starter, a soft starter or fluid couplings, over time."""

import math
from collections.abc import Callable

import numpy as np

from ptmcalc.components.motor import ConverterMotor
from ptmcalc.components.starting_gear import SoftStarter, in_star
from ptmcalc.machines.chain_drive.machine.model import chain_line, drive_of, mean_arm
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Drive, Start
from ptmcalc.machines.chain_drive.starting.motion import UP_TO, rigid_acceleration, start_factor
from ptmcalc.numerics.belt.curve import MotorForce

_NEARLY = 0.98
"""Speed that ends a start, relative to the speed at which the torque falls to the resistance [1], where the torque does
not exceed the resistance up to the speed of the file. An engineering choice: that speed is approached without end."""
_STEPS, _MOST = 2000, 20
"""Steps of a start at mean acceleration, and how many times as many there may be. Numerical choices: more reduce the
error of the time and take longer."""
_LOOKS = 401
"""Speeds at which the torque is compared with the resistance; a numerical choice. More find a narrow minimum."""
_LATE = 1e6
"""Time at which every rise is over [s]; a numerical choice far beyond any start."""

Rate = Callable[[float, float], float]
"""Acceleration of the chain by time and speed."""


def motor_torque_at(drive: Drive, turns: float) -> MotorForce:
    """Torque of all motors on the input shaft of the gear by time and speed of the chain [N*m]; `turns` is the angle of
    that shaft per travel of the chain [rad/m]."""
    curve, starter, coupling = drive.start_curve, drive.starter, drive.fluid_coupling
    assert curve is not None
    stages = curve.curve_stages
    if drive.switch_over > 0:
        stages = in_star(stages, drive.switch_over)
    count = float(drive.motor.count)
    soft = starter if isinstance(starter, SoftStarter) and coupling is None else None
    ramped = curve if isinstance(curve, ConverterMotor) else None
    return MotorForce(
        stages,
        turns,
        count,
        count,
        reference=ramped.speed if ramped is not None else 0.0,
        ramp=ramped.ramp_time if ramped is not None else 0.0,
        fill=coupling.time_constant if coupling is not None else 0.0,
        soft_from=soft.initial_voltage if soft is not None else 1.0,
        soft_time=soft.time if soft is not None else 0.0,
    )


def geared_start(spec: ChainDrive, scene: Start) -> tuple[float, float]:
    """Start time of the rigid body with its starting gear by Heun's rule, and the difference from half as many steps
    [s]; infinite where the torque does not exceed the resistance of the start up to nine tenths of the speed, or up to
    the switch-over."""
    drive, line = drive_of(spec), chain_line(spec, scene, start_factor(spec))
    turns = drive.gear.ratio / mean_arm(spec)
    force = motor_torque_at(drive, turns)

    def rate(time: float, speed: float) -> float:
        torque = max(force(time, speed)[0], 0.0)
        return rigid_acceleration(spec, line, torque)[0]

    speeds = np.linspace(0.0, line.speed, _LOOKS)
    late = np.array([rate(_LATE, speed) for speed in speeds])
    short = np.flatnonzero(late <= 0)
    settles = float(speeds[short[0]]) if len(short) else math.inf
    if settles <= max(UP_TO * line.speed, min(drive.switch_over / turns, line.speed)):
        return math.inf, 0.0
    goal = min(line.speed, _NEARLY * settles)
    whole = goal / float(late[speeds <= goal].mean()) + max(force.soft_time, force.fill)
    switch = drive.switch_over / turns
    fine, coarse = (_reached(rate, goal, switch, whole / count, count) for count in (_STEPS, _STEPS // 2))
    return fine, abs(fine - coarse) if math.isfinite(fine) else 0.0


def _reached(rate: Rate, goal: float, switch: float, step: float, count: int) -> float:
    """When the speed first reaches the goal [s]; a step ends where the starter switches over."""
    time = speed = 0.0
    for _ in range(_MOST * count):
        new, taken = _stepped(rate, time, speed, step), step
        if speed < switch <= new:
            taken = step * (switch - speed) / (new - speed)
            new = max(_stepped(rate, time, speed, taken), switch)
        if new >= goal:
            return time + taken * (goal - speed) / (new - speed)
        time, speed = time + taken, new
    return math.inf


def _stepped(rate: Rate, time: float, speed: float, step: float) -> float:
    """The speed a step later, on one side of the switch-over; a chain does not run back."""
    first = rate(time, speed)
    second = rate(time + step, max(speed + first * step, 0.0))
    return max(speed + (first + second) / 2 * step, 0.0)
