"""Loads of the drive in steady motion, and of its duty."""

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo

OF_THE_DRIVE = (
    LoadInfo("motor_speed", "motor speed", units.ANGULAR_SPEED),
    LoadInfo("torque_motor_static_up", "motor torque, steady hoisting", units.TORQUE, governing=True),
    LoadInfo("torque_motor_static_down", "motor torque, steady lowering", units.TORQUE),
    LoadInfo("power_hoisting", "motor power, steady hoisting", units.POWER, governing=True),
    LoadInfo("starting_reserve", "starting torque reserve", units.RATIO, governing=True),
    LoadInfo("overhauling_reserve", "motor braking torque reserve", units.RATIO),
    LoadInfo("lowering_speed", "motor speed, steady lowering on its curve", units.ANGULAR_SPEED),
    LoadInfo("lowering_speed_ratio", "motor speed relative to no load, steady lowering", units.RATIO, headline=False),
    LoadInfo("start_time", "hoisting start time, rigid model", units.TIME),
    LoadInfo("torque_motor_rms", "motor torque, rms", units.TORQUE, governing=True),
    LoadInfo("heating_utilisation", "thermal utilisation (rms torque)", units.SHARE, governing=True),
    LoadInfo("start_heat", "rotor heat per start, one motor", units.ENERGY),
    LoadInfo("starts_per_hour", "starts per hour", units.RATIO, headline=False),
    LoadInfo("brake_torque_static", "load torque at brake shaft, lowering", units.TORQUE),
    LoadInfo("brake_reserve_static", "brake holding torque reserve", units.RATIO, governing=True),
    LoadInfo("drop_distance", "load drop with brake applied", units.SPAN, governing=True),
    LoadInfo("drop_speed", "load speed at end of drop", units.SPEED),
)
OF_THE_CLASS = (
    LoadInfo("equivalent_load_share", "equivalent / rated load", units.RATIO, headline=False),
    LoadInfo("spectrum_factor", "load spectrum factor", units.RATIO, headline=False),
    LoadInfo("mechanism_group", "required mechanism group, M", units.RATIO, headline=False),
    LoadInfo("crane_group", "required crane group, A", units.RATIO, headline=False),
)
