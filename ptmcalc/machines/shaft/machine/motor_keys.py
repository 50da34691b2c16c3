"""Keys of the motor to which the verdicts of a main shaft point."""

from collections.abc import Mapping

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.components.motor import ConstantMotor, ConverterMotor, InductionBase, LinearMotor, TableMotor
from ptmcalc.machines.shaft.machine.spec import Shaft, ShaftScene

Loads = Mapping[str, Estimate]


def motor_key(spec: Shaft) -> KeyPath:
    """The key that says how strong the motor is."""
    motor = spec.drive.motor
    if isinstance(motor, InductionBase):
        return ("drive", "motor", "power")
    if isinstance(motor, ConstantMotor):
        return ("drive", "motor", "torque")
    if isinstance(motor, LinearMotor):
        return ("drive", "motor", "starting_torque")
    return ("drive", "motor", "torque_limit") if isinstance(motor, ConverterMotor) else ("drive", "motor", "points")


def motor_that_can_vary(spec: Shaft, scene: ShaftScene) -> KeyPath:
    return () if isinstance(spec.drive.motor, TableMotor) else motor_key(spec)


def blame_motor(spec: Shaft, scene: ShaftScene, loads: Loads) -> KeyPath:
    return motor_key(spec)
