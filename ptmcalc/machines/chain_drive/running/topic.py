"""Steady running: tensions, power, motor torque."""

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.contract.topic import Topic
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive
from ptmcalc.machines.chain_drive.running.checks_motor import RATING, RESERVE
from ptmcalc.machines.chain_drive.running.motor_torque import STEADY_DRIVE
from ptmcalc.machines.chain_drive.running.statics import STATICS

RUNNING: Topic[ChainDrive] = Topic(
    loads=(
        LoadInfo("chain_speed", "mean chain speed", units.SPEED, headline=False),
        LoadInfo("sprocket_speed", "drive sprocket speed", units.ANGULAR_SPEED),
        LoadInfo("speed_max", "chain speed, maximum", units.SPEED, headline=False),
        LoadInfo("speed_ripple", "chain speed ripple (polygon effect)", units.SHARE),
        LoadInfo("acceleration_polygon_max", "polygon-effect acceleration, maximum", units.ACCELERATION),
        LoadInfo("static_resistance", "effective chain pull", units.FORCE, governing=True),
        LoadInfo("power_drive", "power at drive shaft", units.POWER, governing=True),
        LoadInfo("tension_static", "static chain tension, maximum", units.FORCE, governing=True),
        LoadInfo("tension_run_off", "static tension leaving sprocket", units.FORCE),
        LoadInfo("tension_centrifugal", "centrifugal tension", units.FORCE, headline=False),
        LoadInfo("tension_design", "total chain tension, maximum", units.FORCE, governing=True),
        LoadInfo("tension_min", "total chain tension, minimum", units.FORCE, governing=True),
        LoadInfo("steady_reserve", "motor torque reserve, steady running", units.RATIO),
        LoadInfo("motor_utilisation", "motor torque utilisation, steady running", units.SHARE, headline=False),
        LoadInfo("wave_speed", "wave speed, loaded strand", units.SPEED, headline=False),
        LoadInfo("wave_travel_time", "wave transit time, vibrating strands", units.TIME, headline=False),
        LoadInfo("safety_dynamic", "safety factor, steady running", units.RATIO, governing=True),
        LoadInfo("joint_pressure", "pin/bush bearing pressure", units.PRESSURE, governing=True),
        LoadInfo("stress_amplitude", "link plate stress amplitude", units.STRESS),
        LoadInfo("fatigue_utilisation", "fatigue utilisation of link plates", units.SHARE, governing=True),
    ),
    solvers=(STATICS, STEADY_DRIVE),
    checks=(RESERVE, RATING),
)
