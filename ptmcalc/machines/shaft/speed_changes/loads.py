"""Loads of run-up and run-out of a main shaft."""

from ptmcalc.base import units
from ptmcalc.base.units import Quantity
from ptmcalc.contract.result import LoadInfo

ANGULAR_ACCELERATION = Quantity("angular acceleration", "rad/s^2", ("rad/s^2",), "9.5 rad/s^2")

LOADS_OF_RUN_UP = (
    LoadInfo("run_up_time", "run-up time", units.TIME, governing=True),
    LoadInfo("run_up_angle", "run-up angle", units.ANGLE),
    LoadInfo("torque_starting", "motor starting torque at main shaft", units.TORQUE),
    LoadInfo("acceleration_starting", "angular acceleration from rest", ANGULAR_ACCELERATION, headline=False),
)
LOADS_OF_RUN_OUT = (
    LoadInfo("run_out_angle", "stopping angle", units.ANGLE, governing=True),
    LoadInfo("run_out_time", "stopping time", units.TIME, governing=True),
    LoadInfo("kinetic_energy", "kinetic energy at start of stop", units.ENERGY),
    LoadInfo("energy_recoverable", "recoverable energy of the stop", units.ENERGY),
    LoadInfo("brake_torque_needed", "required brake torque", units.TORQUE, governing=True),
    LoadInfo("speed_run_out", "speed at start of stop", units.ANGULAR_SPEED, headline=False),
)
OF_RUN_UP = frozenset(info.name for info in LOADS_OF_RUN_UP)
"""Names of the loads of a run-up."""
OF_RUN_OUT = frozenset(info.name for info in LOADS_OF_RUN_OUT)
"""Names of the loads of a run-out."""
