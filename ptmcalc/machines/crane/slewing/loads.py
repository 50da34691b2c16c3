"""The loads a slewing crane can report."""

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo

OF_THE_CYCLE = (
    LoadInfo("slew_inertia", "moment of inertia about the slewing axis", units.INERTIA, governing=True),
    LoadInfo("start_time", "start time", units.TIME, governing=True),
    LoadInfo("start_angle", "angle of the start", units.ANGLE),
    LoadInfo("steady_time", "time of steady slewing", units.TIME),
    LoadInfo("steady_angle", "angle of steady slewing", units.ANGLE),
    LoadInfo("brake_time", "time of the stop", units.TIME, governing=True),
    LoadInfo("brake_angle", "angle of the stop", units.ANGLE, governing=True),
    LoadInfo("cycle_time", "time of a rotation", units.TIME, governing=True),
    LoadInfo("share_start", "share of the start in a rotation", units.RATIO, headline=False),
    LoadInfo("share_steady", "share of steady slewing", units.RATIO, headline=False),
    LoadInfo("share_brake", "share of the stop", units.RATIO, headline=False),
)
OF_THE_DRIVE = (
    LoadInfo("torque_start", "torque at the column, start", units.TORQUE, governing=True),
    LoadInfo("torque_steady", "torque at the column, steady slewing", units.TORQUE, governing=True),
    LoadInfo("torque_inertia_brake", "inertia torque at the column, stop", units.TORQUE),
    LoadInfo("torque_brake", "torque at the column, stop in the allowed angle", units.TORQUE, governing=True),
    LoadInfo("torque_equivalent", "equivalent torque at the column", units.TORQUE, governing=True),
    LoadInfo("torque_pinion", "equivalent torque of the open pinion", units.TORQUE),
    LoadInfo("torque_worm", "equivalent torque on the fast shaft of the gearbox", units.TORQUE, governing=True),
    LoadInfo("power_gearbox", "power of the gearbox by the equivalent torque", units.POWER),
    LoadInfo("torque_motor_start", "motor torque that the start takes", units.TORQUE),
    LoadInfo("torque_brake_required", "brake torque on the motor shaft for the allowed angle", units.TORQUE),
    LoadInfo("starting_reserve", "mean starting torque over that of steady slewing", units.RATIO),
)
LOADS = (*OF_THE_CYCLE, *OF_THE_DRIVE)
