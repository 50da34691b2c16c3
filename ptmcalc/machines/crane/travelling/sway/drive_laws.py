"""The drive of a travelling crane as laws of its force, one after the other."""

import numpy as np

from ptmcalc.components.motor import ConverterMotor
from ptmcalc.components.motor_stage import Stage
from ptmcalc.machines.crane.travelling.machine import model
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.machines.crane.travelling.sway.moving import Motion
from ptmcalc.numerics.pendulum.parts import Follow, Push, Smooth, Straight
from ptmcalc.numerics.pendulum.pieces import Pieces


def drive_laws(spec: Travelling, motion: Motion) -> list[tuple[Follow | Push | None, float | None, float | None]]:
    """The laws of the drive one after the other, and the speed or the time at which each gives way to the next."""
    if motion.ramp is not None:
        lasts = motion.speed / motion.ramp
        ends = ((0.0, 0.0), (lasts, motion.speed)) if motion.starts else ((0.0, motion.speed), (lasts, 0.0))
        return [(Follow(Pieces.through(ends)), None, None)]
    if not motion.starts:
        return [(None, None, None)]
    curve, ratio = spec.drive.motor.curve, model.rim_ratio(spec)
    count = spec.drive.motor.count
    if curve is None:
        return [(Push(spec.drive.torque * ratio, reaches=motion.speed), None, None)]
    if isinstance(curve, ConverterMotor):
        rises = max(curve.ramp_time, 1e-9)
        speeds = Pieces.through(((0.0, 0.0), (rises, motion.speed)))
        return [(Follow(speeds, limit=count * curve.limit * ratio), motion.speed, None)]
    laws: list[tuple[Follow | Push | None, float | None, float | None]] = []
    for stage in curve.stages:
        until = None if stage.until_speed is None else stage.until_speed / ratio
        reaches = motion.speed if until is None or until >= motion.speed else until
        laws.append((Push(_law(stage, count, ratio), reaches=reaches), until, stage.until_time))
        if reaches == motion.speed and stage.until_time is None:
            break
    return laws


def _law(stage: Stage, count: int, ratio: float) -> Straight | Smooth:
    """A motor's torque over its speed as a force over that of travel, in front of the gear."""
    if stage.pieces is None:
        size = float(np.max(np.abs(stage.torque(np.linspace(0.0, 400.0, 101))))) * count * ratio
        return Smooth(lambda speed: count * ratio * stage.torque(np.asarray(speed) * ratio), size)
    knots = [speed for speed, _ in stage.pieces]
    if stage.extends and len(knots) > 1:
        width = knots[-1] - knots[0]
        knots = [knots[0] - width, *knots, knots[-1] + width]
    torques = stage.torque(np.array(knots))
    if len(knots) == 1:
        knots, torques = [knots[0], knots[0] + 1.0], np.repeat(torques, 2)
    return Straight(
        tuple(float(speed / ratio) for speed in knots), tuple(float(count * ratio * torque) for torque in torques)
    )
