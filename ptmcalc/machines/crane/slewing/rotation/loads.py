"""Loads of a rotation: times, angles, torques of the phases."""

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo

OF_THE_CHAIN = (
    LoadInfo("slew_inertia", "moment of inertia about slewing axis", units.INERTIA, governing=True),
    LoadInfo("start_time", "starting time", units.TIME, governing=True),
    LoadInfo("start_angle", "starting angle", units.ANGLE),
    LoadInfo("steady_time", "steady slewing time", units.TIME),
    LoadInfo("steady_angle", "steady slewing angle", units.ANGLE),
    LoadInfo("brake_time", "stopping time", units.TIME, governing=True),
    LoadInfo("brake_angle", "stopping angle", units.ANGLE, governing=True),
    LoadInfo("cycle_time", "time of one slewing motion", units.TIME, governing=True),
    LoadInfo("share_start", "time share of start", units.RATIO, headline=False),
    LoadInfo("share_steady", "time share of steady slewing", units.RATIO, headline=False),
    LoadInfo("share_brake", "time share of stop", units.RATIO, headline=False),
    LoadInfo("torque_start", "axis torque, start", units.TORQUE, governing=True),
    LoadInfo("torque_steady", "axis torque, steady slewing", units.TORQUE, governing=True),
    LoadInfo("torque_inertia_brake", "axis inertia torque, braking", units.TORQUE),
    LoadInfo("torque_brake", "axis torque, braking", units.TORQUE, governing=True),
    LoadInfo("torque_equivalent", "axis torque, equivalent", units.TORQUE, governing=True),
    LoadInfo("torque_pinion", "equivalent torque at slewing pinion", units.TORQUE),
    LoadInfo("torque_worm", "gearbox equivalent input torque", units.TORQUE, governing=True),
    LoadInfo("power_gearbox", "gearbox power at equivalent torque", units.POWER),
)
