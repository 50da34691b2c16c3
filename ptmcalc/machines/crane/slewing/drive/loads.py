"""Loads of the slewing drive and of its duty."""

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo

OF_THE_DRIVE = (
    LoadInfo("torque_motor_start", "starting torque, all motors, maximum", units.TORQUE),
    LoadInfo("torque_brake_required", "required brake torque, motor shaft", units.TORQUE),
    LoadInfo("starting_reserve", "starting torque reserve", units.RATIO),
    LoadInfo("speed_reserve", "torque reserve up to full speed", units.RATIO),
    LoadInfo("wind_reserve_motor", "motor reserve against wind", units.RATIO),
    LoadInfo("overhauling_reserve", "motor braking torque reserve", units.RATIO),
    LoadInfo("wind_reserve_brake", "brake reserve against wind", units.RATIO),
    LoadInfo("torque_motor_rms", "motor torque, rms, per motor", units.TORQUE),
    LoadInfo("heating_utilisation", "thermal utilisation (rms torque)", units.SHARE),
    LoadInfo("rotation_used", "rotation share of start and stop", units.SHARE, headline=False),
    LoadInfo("gear_locks", "jam ratio, reflected/rotor inertia", units.RATIO, headline=False),
)
OF_THE_USE = (
    LoadInfo("spectrum_factor", "load spectrum factor K_p", units.RATIO, headline=False),
    LoadInfo("crane_group", "required crane group, A", units.RATIO, headline=False),
)
