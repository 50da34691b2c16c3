"""Stages of a motor's torque over speed as laws of a train's drive."""

from collections.abc import Iterator

import numpy as np

from ptmcalc.components.motor import AnyMotor, ConverterMotor
from ptmcalc.components.motor_stage import Stage as MotorStage
from ptmcalc.numerics.train.parts import Governed, Law, Smooth, Stage, Straight
from ptmcalc.numerics.train.signals import Signal

_SLOPES = 2.5
"""Levels to which the slope of a smooth torque curve is rounded, up to its steepest [1]; each has its own linear
system. A numerical choice. A larger value linearises more closely and computes more systems."""


def motor_stages(curve: AnyMotor, count: int, way: int) -> Iterator[Stage]:
    """The stages of the motor's own curve; a motor that runs down follows the last one, turned round."""
    if isinstance(curve, ConverterMotor):
        end, ramp = way * curve.speed, curve.ramp_time
        reference = Signal.through(((0.0, 0.0), (ramp, end))) if ramp > 0 else Signal.constant(end)
        yield Stage(Governed(reference, count * curve.stiffness, count * curve.limit))
        return
    stages = curve.stages if way > 0 else curve.stages[-1:]
    for stage in stages:
        last = stage is stages[-1]
        law = _law(stage, count, way, curve.no_load_speed)
        yield Stage(law, None if last else stage.until_speed, None if last else stage.until_time)


def _law(stage: MotorStage, count: int, way: int, no_load_speed: float | None) -> Law:
    if stage.pieces is not None:
        knots, values = (list(row) for row in zip(*stage.pieces, strict=True))
        if way < 0:
            knots, values = [-one for one in knots[::-1]], [-one for one in values[::-1]]
        values = [count * one for one in values]
        if len(knots) == 1:
            return Signal.constant(values[0])
        return Straight("speed", tuple(knots), tuple(values), stage.extends)
    formula, slope = stage.formula, stage.slope
    assert formula is not None
    assert slope is not None
    speeds = np.linspace(0.0, no_load_speed or 1.0, 201)
    size, steepest = float(np.abs(formula(speeds)).max()), float(np.abs(slope(speeds)).max())
    return Smooth(
        "speed",
        lambda speed: way * count * formula(way * speed),
        lambda speed: count * float(slope(np.array([way * speed]))[0]),
        count * size,
        count * steepest / _SLOPES,
    )
