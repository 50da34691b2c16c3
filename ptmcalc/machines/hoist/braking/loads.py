"""Loads of an emergency stop."""

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo

SPEED, TIME, TRAVEL = "emergency_speed_max", "emergency_stop_time", "emergency_travel"
SPEED_RATIO = "emergency_speed_ratio"
RISE, DESCENT = "emergency_rise", "emergency_descent"
HEAT, ONE_STOP, REPEATED, STOPS = "brake_heat", "brake_temperature_one", "brake_temperature_max", "brake_stops"

LOADS = (
    LoadInfo(SPEED, "motor speed in the emergency stop, maximum", units.ANGULAR_SPEED, governing=True),
    LoadInfo(
        SPEED_RATIO, "motor speed relative to no load in the emergency stop, maximum", units.RATIO, headline=False
    ),
    LoadInfo(TIME, "emergency stopping time, rigid model", units.TIME),
    LoadInfo(TRAVEL, "travel of the motor shaft in the emergency stop", units.TURN, headline=False),
    LoadInfo(RISE, "rise of the hook in the emergency stop, rigid model", units.LENGTH),
    LoadInfo(DESCENT, "descent of the hook in the emergency stop, rigid model", units.LENGTH, governing=True),
    LoadInfo(HEAT, "brake heat per emergency stop", units.ENERGY, governing=True),
    LoadInfo(ONE_STOP, "temperature rise of the brake, one stop", units.TEMPERATURE_DIFFERENCE),
    LoadInfo(REPEATED, "temperature rise of the brake, repeated stops, maximum", units.TEMPERATURE_DIFFERENCE),
    LoadInfo(STOPS, "emergency stops until the permissible friction work", units.RATIO, headline=False),
)
