"""Motor and gear of a main shaft: torques on the main shaft and losses by the direction of the power."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ptmcalc.components.motor import AnyMotor, ConverterMotor, InductionBase
from ptmcalc.components.motor_stage import Stage
from ptmcalc.laws import shaft as law

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class DriveLine:
    """Motor and gear. `stages` are the torque curves of the start; a converter shifts its one by its reference."""

    motor: AnyMotor
    ratio: float
    efficiency: float
    reverse_efficiency: float
    reverses: bool
    """whether the efficiency divides while the motor brakes"""
    motor_inertia: float

    @cached_property
    def stages(self) -> tuple[Stage, ...]:
        """The torque curves of the start, one after the other."""
        return self.motor.stages

    @property
    def lossy_both_ways(self) -> bool:
        """Whether the torque on the main shaft has a corner where the power through the gear turns."""
        return self.reverses and (self.efficiency < 1 or self.reverse_efficiency < 1)

    @property
    def time_dependent(self) -> bool:
        """Whether the torque depends on the time since the start besides the speed."""
        ramp = isinstance(self.motor, ConverterMotor) and self.motor.ramp_time > 0
        return ramp or any(stage.until_time is not None for stage in self.stages)

    def lag(self, time: FloatArray) -> FloatArray:
        """By how much the curve of a converter lies at lower speeds than in the end, at a time [rad/s]."""
        if isinstance(self.motor, ConverterMotor):
            return np.asarray(self.motor.speed - self.motor.reference(time))
        return np.zeros(np.shape(time))

    def torque(self, stage: int, speed: FloatArray, time: FloatArray | None = None) -> FloatArray:
        """Motor torque at speeds of the main shaft; without a time long after the start [N*m]."""
        at = self.ratio * speed
        if time is not None and isinstance(self.motor, ConverterMotor):
            at = at + self.lag(time)
        return self.stages[stage].torque(at)

    def slope(self, stage: int, speed: FloatArray) -> FloatArray:
        """Change of the motor torque with the speed of the main shaft, long after the start [N*m*s/rad]."""
        curve, at = self.stages[stage], self.ratio * speed
        if curve.slope is not None:
            return self.ratio * curve.slope(at)
        assert curve.pieces is not None
        knots, values = np.array(curve.pieces).T
        if len(knots) == 1:
            return np.zeros(np.shape(at))
        rises = np.diff(values) / np.diff(knots)
        ends = (rises[0], rises[-1]) if curve.extends else (0.0, 0.0)
        rises = np.concatenate([ends[:1], rises, ends[1:]])
        return np.asarray(self.ratio * rises[np.searchsorted(knots, at)])

    def knots(self, stage: int) -> FloatArray:
        """Speeds of the main shaft at which the curve of a stage has a corner, once it no longer moves [rad/s]."""
        curve = self.stages[stage]
        if curve.pieces is None or (curve.extends and len(curve.pieces) <= 2):
            return np.zeros(0)
        return np.array([speed for speed, _ in curve.pieces]) / self.ratio

    def factor(self, motor_torque: FloatArray, inertia: FloatArray, resistance: FloatArray) -> FloatArray:
        """What the gear makes of the torque through it."""
        if not self.reverses:
            return np.full(np.shape(motor_torque), self.efficiency)
        if self.motor_inertia == 0:
            return np.where(motor_torque >= 0, self.efficiency, 1 / self.reverse_efficiency)
        return law.gear_factor(
            motor_torque,
            self.motor_inertia,
            inertia,
            self.ratio,
            resistance,
            self.efficiency,
            self.reverse_efficiency,
        )

    @property
    def free_speed(self) -> float | None:
        """Speed of the main shaft at which the motor gives no torque [rad/s]."""
        free = self.motor.no_load_speed
        return free / self.ratio if free else None

    @property
    def breakdown_torque(self) -> float | None:
        """The most the motor can give above its working range, None for one that has no such limit [N*m]."""
        return self.motor.breakdown_torque if isinstance(self.motor, InductionBase) else None
