"""Loads of the motors."""

from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain

MOTOR_PEAK = LoadInfo("motor_torque_peak", "motor torque, maximum", units.TORQUE, governing=True)
MOTOR_RMS = LoadInfo("motor_torque_rms", "motor torque, rms", units.TORQUE, governing=True)
BRAKING = LoadInfo("braking_reserve", "motor braking torque / overhauling torque", units.RATIO, governing=True)

LOADS_OF_MOTORS = (
    MOTOR_PEAK,
    MOTOR_RMS,
    BRAKING,
)


def parts(spec: Drivetrain) -> Iterator[LoadInfo]:
    """The loads of the motors of one train."""
    for info in LOADS_OF_MOTORS:
        for name in spec.motors:
            yield info.of(name)
