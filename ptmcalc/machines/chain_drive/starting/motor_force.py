"""The motors of a start on their curve as the force at the sprocket over stage, time and speed."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ptmcalc.base.memory import kept_for
from ptmcalc.machines.chain_drive.machine.model import FloatArray, drive_of, filled, gear_side_inertia, mean_arm
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive
from ptmcalc.machines.chain_drive.starting.geared import motor_torque_at
from ptmcalc.machines.chain_drive.starting.motion import StartCase
from ptmcalc.numerics.belt.curve import MotorForce
from ptmcalc.numerics.driven_body import Gear

_LOOKS = 801
"""Speeds at which a torque curve is evaluated for its extremes; a numerical choice. More find a narrow peak more
closely."""
_ABOVE = 1.3
"""Highest of them relative to the no-load speed [1]; a numerical choice. No start comes close to it."""
_HALVINGS = 80
"""Bisections of the time of release; a numerical choice, up to rounding."""
_FILLED = 40.0
"""Time constants after which a fluid coupling counts as full [1]: exp(-40) is below rounding."""


@dataclass(frozen=True, slots=True)
class StartForce:
    """Force of the motors at the chain less the resistance, from switching on; a `numerics.driven_body.Drive`."""

    motors: MotorForce
    per_torque: float
    """force at the chain per torque of all motors, the gear losses in it [1/m]"""
    resistance: float
    fastest: float
    """highest chain speed at which the curve is evaluated [m/s]"""
    ends_at: float = math.inf
    """speed from which on the drive pulls what the chain resists: that of the file, where the torque of the curve does
    not fall to the resistance [m/s]"""

    @property
    def kinks(self) -> Sequence[float]:
        """Times at which the rise of the torque bends [s]."""
        ends = {self.motors.soft_time, self.motors.ramp} - {0.0}
        if self.motors.ramp > 0 and self.motors.shape == "parabolic":
            ends |= {self.motors.ramp / 2}
        if self.motors.ramp > 0 and not isinstance(self.motors.shape, str):
            ends |= {share * self.motors.ramp for share, _ in self.motors.shape if share > 0}
        return sorted(ends)

    def force(self, stage: int, time: float, speed: float) -> tuple[float, float]:
        """Force less the resistance [N], and its slope over the speed [N*s/m]."""
        if stage >= len(self.motors.stages):
            return 0.0, 0.0
        torque, slope = self.motors.in_stage(stage, time, speed)
        return self.per_torque * torque - self.resistance, self.per_torque * slope

    def until(self, stage: int) -> tuple[float, float]:
        """Chain speed [m/s] and time [s] at which the next stage begins."""
        if stage >= len(self.motors.stages) - 1:
            return self.ends_at if stage < len(self.motors.stages) else math.inf, math.inf
        one = self.motors.stages[stage]
        return one.until_speed / self.motors.turns, one.until_time

    def to_come(self, time: float) -> float:
        """Bound of the later change of the force over time [N]."""
        if self.kinks and time < self.kinks[-1]:
            return math.inf
        if self.motors.fill <= 0:
            return 0.0
        return self.largest * math.exp(-time / self.motors.fill) / -math.expm1(-time / self.motors.fill)

    @property
    def largest(self) -> float:
        """Largest force of the motors after every rise [N]."""
        return float(np.abs(self.pulls(len(self.motors.stages) - 1)).max())

    def pulls(self, stage: int) -> FloatArray:
        """Force of the motors in a stage from standstill to the fastest speed, after every rise [N]."""
        late = max([_FILLED * self.motors.fill, *self.kinks])
        speeds = np.linspace(0.0, self.fastest, _LOOKS)
        return self.per_torque * np.array([self.motors.in_stage(stage, late, float(one))[0] for one in speeds])

    def steepest(self, stage: int) -> float:
        """Largest slope of the force over the speed in a stage, of either sign [N*s/m]."""
        return _steepest(self)[stage] if stage < len(self.motors.stages) else 0.0

    @property
    def standing(self) -> float:
        """Largest force of the motors at standstill [N]."""
        times = [0.0, _FILLED * self.motors.fill, *self.kinks]
        stages = range(len(self.motors.stages))
        return max(self.per_torque * self.motors.in_stage(stage, time, 0.0)[0] for stage in stages for time in times)

    @property
    def release(self) -> float:
        """When the motors first pull more than the chain resists at standstill [s]; infinite where they never do."""
        if self.force(0, 0.0, 0.0)[0] > 0:
            return 0.0
        times = [0.0, *self.kinks, *(self.until(stage)[1] for stage in range(len(self.motors.stages)))]
        times = sorted({time for time in times if math.isfinite(time)} | {_FILLED * self.motors.fill})
        for low, high in zip(times, [*times[1:], times[-1]], strict=True):
            stage = self.stage_at(low)
            if self.force(stage, low, 0.0)[0] > 0:
                return low
            if high > low and self.force(stage, high, 0.0)[0] > 0:
                return self._rises_through(stage, low, high)
        return math.inf

    def stage_at(self, time: float) -> int:
        """Stage of motors that stand still at a time."""
        stage = 0
        while self.until(stage)[1] <= time:
            stage += 1
        return stage

    def _rises_through(self, stage: int, low: float, high: float) -> float:
        for _ in range(_HALVINGS):
            middle = (low + high) / 2
            low, high = (low, middle) if self.force(stage, middle, 0.0)[0] > 0 else (middle, high)
        return high


@kept_for(16)
def _steepest(force: StartForce) -> tuple[float, ...]:
    """Largest slope of the force in each stage [N*s/m]."""
    late = max([_FILLED * force.motors.fill, *force.kinks])
    speeds = np.linspace(0.0, force.fastest, _LOOKS)
    return tuple(
        force.per_torque * max(abs(force.motors.in_stage(stage, late, float(one))[1]) for one in speeds)
        for stage in range(len(force.motors.stages))
    )


@kept_for(32)
def start_force(spec: ChainDrive, case: StartCase) -> StartForce:
    """The motors of a start on their curve."""
    drive = drive_of(spec)
    turns = drive.gear.ratio / mean_arm(spec)
    curve = drive.start_curve
    assert curve is not None
    top = max(curve.no_load_speed or 0.0, case.line.speed * turns)
    motors, fastest = motor_torque_at(drive, turns), _ABOVE * top / turns
    found = StartForce(motors, case.losses * turns, case.line.static_resistance, fastest)
    ends = found.pulls(len(motors.stages) - 1)[-1] > case.line.static_resistance
    return replace(found, ends_at=case.line.speed) if ends else found


def stands_still(spec: ChainDrive, case: StartCase) -> bool:
    """Whether the motors of a start on their curve never pull more at standstill than the chain resists: it is held."""
    return math.isinf(start_force(spec, case).release)


def gear_of(spec: ChainDrive, case: StartCase) -> Gear:
    """The motors behind the gear, at the chain, through its losses by the direction of the force."""
    efficiency = filled(drive_of(spec).gear.efficiency)
    behind = case.losses * gear_side_inertia(spec) * (drive_of(spec).gear.ratio / mean_arm(spec)) ** 2
    other = efficiency**2 if case.losses <= 1 else efficiency**-2
    return Gear(behind, case.line.static_resistance, 1 - other)
