"""The loads a main shaft can report."""

from ptmcalc.base import units
from ptmcalc.base.units import Quantity
from ptmcalc.contract.result import LoadInfo

ANGULAR_ACCELERATION = Quantity("angular acceleration", "rad/s^2", ("rad/s^2",), "9.5 rad/s^2")

LOADS = (
    LoadInfo("run_up_time", "run-up time", units.TIME, governing=True),
    LoadInfo("run_up_angle", "run-up angle", units.ANGLE),
    LoadInfo("torque_starting", "motor starting torque at main shaft", units.TORQUE),
    LoadInfo("acceleration_starting", "angular acceleration from rest", ANGULAR_ACCELERATION, headline=False),
    LoadInfo("speed_mean", "mean speed", units.ANGULAR_SPEED, governing=True),
    LoadInfo("speed_max", "speed, maximum", units.ANGULAR_SPEED),
    LoadInfo("speed_min", "speed, minimum", units.ANGULAR_SPEED),
    LoadInfo("irregularity", "speed fluctuation delta", units.SHARE, governing=True),
    LoadInfo("flywheel_inertia", "additional flywheel inertia required", units.INERTIA, governing=True),
    LoadInfo("cycle_efficiency", "cycle efficiency", units.SHARE, governing=True),
    LoadInfo("loss_factor", "cycle loss factor psi", units.SHARE),
    LoadInfo("torque_motor_rms", "motor torque, rms", units.TORQUE, governing=True),
    LoadInfo("torque_motor_max", "motor torque, maximum", units.TORQUE, governing=True),
    LoadInfo("work_drive", "drive work per cycle", units.ENERGY, headline=False),
    LoadInfo("work_useful", "useful work per cycle", units.ENERGY, headline=False),
    LoadInfo("work_loss", "work of losses per cycle", units.ENERGY, headline=False),
    LoadInfo("run_out_angle", "stopping angle", units.ANGLE, governing=True),
    LoadInfo("run_out_time", "stopping time", units.TIME, governing=True),
    LoadInfo("kinetic_energy", "kinetic energy at start of stop", units.ENERGY),
    LoadInfo("energy_recoverable", "recoverable energy of the stop", units.ENERGY),
    LoadInfo("brake_torque_needed", "required brake torque", units.TORQUE, governing=True),
    LoadInfo("speed_run_out", "speed at start of stop", units.ANGULAR_SPEED, headline=False),
)

OF_RUN_UP = frozenset({"run_up_time", "run_up_angle", "torque_starting", "acceleration_starting"})
"""Loads of a run-up."""

OF_CYCLE = frozenset(
    {
        "speed_mean",
        "speed_max",
        "speed_min",
        "irregularity",
        "flywheel_inertia",
        "cycle_efficiency",
        "loss_factor",
        "torque_motor_rms",
        "torque_motor_max",
        "work_drive",
        "work_useful",
        "work_loss",
    }
)
"""Loads of a steady cycle."""

OF_RUN_OUT = frozenset(
    {
        "run_out_angle",
        "run_out_time",
        "kinetic_energy",
        "energy_recoverable",
        "brake_torque_needed",
        "speed_run_out",
    }
)
"""Loads of a run-out."""
