"""Loads of the steady cycle of a main shaft."""

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo

LOADS_OF_CYCLE = (
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
)
OF_CYCLE = frozenset(info.name for info in LOADS_OF_CYCLE)
"""Names of the loads of a steady cycle."""
