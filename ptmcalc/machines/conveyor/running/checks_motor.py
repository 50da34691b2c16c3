"""Checks of the motors in steady running: strong enough to pull, to hold an overhauling load, and for their rating."""

from ptmcalc.components.steady_drive_checks import rated_torque_check, steady_reserve_check
from ptmcalc.machines.conveyor.running.motor_torque import MOTORS

RESERVE = steady_reserve_check("CNV121", MOTORS)
RATING = rated_torque_check("CNV122", MOTORS)
