"""Steady running: tensions, power, trough, curves, take-up, motor torque."""

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.contract.topic import Topic
from ptmcalc.machines.conveyor.machine.loads import parts_of
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.running.checks import SAG, SLACK, STRAND_SAG, STRENGTH, STROKE, TRANSIENT_SAG
from ptmcalc.machines.conveyor.running.checks_belt import DRUM, FIBRE, FILL, LIFT, PRESSED
from ptmcalc.machines.conveyor.running.checks_motor import RATING, RESERVE
from ptmcalc.machines.conveyor.running.idlers import BEARING_LIFE, ROLL_SPEED
from ptmcalc.machines.conveyor.running.loads import STATIC_LOADS, static_parts
from ptmcalc.machines.conveyor.running.motor_torque import STEADY_DRIVE
from ptmcalc.machines.conveyor.running.splice import SPLICE
from ptmcalc.machines.conveyor.running.statics import STATICS

LOADS = (
    LoadInfo("tension_run_on_max", "T1 entering drive pulley, maximum", units.FORCE, governing=True),
    LoadInfo("tension_dynamic_run_on_max", "T1 dynamic component, maximum", units.FORCE, governing=True),
    LoadInfo("tension_run_off_min", "T2 leaving drive pulley, minimum", units.FORCE),
    LoadInfo("tension_max", "belt tension, maximum", units.FORCE, governing=True),
    LoadInfo("tension_min", "belt tension, minimum", units.FORCE, governing=True),
    LoadInfo("slack_margin_min", "tension above slack limit, minimum", units.FORCE, governing=True),
    LoadInfo("belt_safety_min", "belt safety factor, minimum", units.RATIO, governing=True),
    LoadInfo("sag_relative_max", "belt sag ratio h/a, maximum", units.SHARE, governing=True),
    LoadInfo("effective_tension", "effective tension T_e (F_U)", units.FORCE, governing=True),
    LoadInfo("effective_tension_worst", "T_e, worst partial loading", units.FORCE, headline=False),
    LoadInfo("power_drive_running", "power at drive pulley shafts", units.POWER, governing=True),
    LoadInfo("power_drive_empty", "power at drive pulley shafts, empty belt", units.POWER, headline=False),
    LoadInfo("power_motor_running", "power at motor shafts", units.POWER, headline=False),
    LoadInfo("steady_reserve", "motor torque reserve, steady running", units.RATIO),
    LoadInfo("motor_utilisation", "motor torque utilisation, steady running", units.SHARE, headline=False),
    LoadInfo("sag_tension_required", "tension required by sag limit", units.FORCE, headline=False),
    LoadInfo("slack_side_tension_required", "slack-side tension required for traction", units.FORCE, headline=False),
    LoadInfo("takeup_travel", "required take-up travel", units.LENGTH, headline=False),
    LoadInfo("takeup_movement", "take-up movement range in the scene", units.LENGTH, headline=False),
    LoadInfo("takeup_mass", "gravity take-up mass, two belt strands", units.MASS, headline=False),
    LoadInfo("belt_cycle_time", "belt circuit time", units.TIME, headline=False),
    LoadInfo("static_resistance", "static resistance at pulley", units.FORCE),
)

RUNNING: Topic[Conveyor] = Topic(
    loads=(*LOADS, *STATIC_LOADS),
    parts=lambda spec: (*parts_of(LOADS, spec), *static_parts(spec)),
    solvers=(STATICS, STEADY_DRIVE),
    checks=(
        *(STRENGTH, SAG, SLACK, STROKE, FILL, DRUM, FIBRE, PRESSED, LIFT, RESERVE, RATING),
        *(SPLICE, STRAND_SAG, TRANSIENT_SAG, ROLL_SPEED, BEARING_LIFE),
    ),
)
