"""Starting: starting force and time, motor heat, residual oscillation."""

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.contract.topic import Topic
from ptmcalc.machines.conveyor.machine.loads import RUN_BACK_DISTANCE, RUN_BACK_SPEED, parts_of
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.starting.checks import (
    COUPLING_HEAT,
    MOTOR_HEAT,
    RESIDUAL,
    RESONANCE,
    RUN_BACK,
    SHARP,
    START,
)
from ptmcalc.machines.conveyor.starting.loads import START_LOADS, start_parts
from ptmcalc.machines.conveyor.starting.permitted_starts import PERMITTED, STARTS, permitted_parts
from ptmcalc.machines.conveyor.starting.rigid import RIGID

LOADS = (
    LoadInfo("natural_frequency", "longitudinal natural frequency of belt", units.ANGULAR_FREQUENCY, headline=False),
    LoadInfo("starting_force", "mean starting force at pulley", units.FORCE),
    LoadInfo("starting_force_needed", "required starting force at pulley", units.FORCE),
    LoadInfo("starting_reserve", "starting force reserve", units.RATIO, governing=True),
    LoadInfo("rim_force_excess", "accelerating force at pulley", units.FORCE),
    LoadInfo("acceleration_rigid", "acceleration, rigid-belt model", units.ACCELERATION),
    LoadInfo("start_time", "starting time", units.TIME, headline=False),
    LoadInfo("start_time_rigid", "starting time, rigid-belt model", units.TIME, governing=True),
    LoadInfo("first_wave_time_max", "time of first-wave peak, textbook", units.TIME, headline=False),
    LoadInfo(RUN_BACK_DISTANCE, "belt run-back distance, aborted start", units.LENGTH, headline=False),
    LoadInfo(RUN_BACK_SPEED, "belt run-back speed, aborted start", units.SPEED, headline=False),
    LoadInfo("reduced_drive_mass", "equivalent drive mass at pulley", units.MASS),
    LoadInfo("wave_speed_carry", "wave speed, carrying strand", units.SPEED, headline=False),
    LoadInfo("wave_speed_return", "wave speed, return strand", units.SPEED, headline=False),
    LoadInfo("impedance_carry", "wave impedance, carrying strand", units.IMPEDANCE, headline=False),
    LoadInfo("impedance_return", "wave impedance, return strand", units.IMPEDANCE, headline=False),
)

STARTING: Topic[Conveyor] = Topic(
    loads=(*LOADS, *START_LOADS, PERMITTED),
    parts=lambda spec: (*parts_of(LOADS, spec), *start_parts(spec), *permitted_parts(spec)),
    solvers=(RIGID,),
    checks=(START, MOTOR_HEAT, COUPLING_HEAT, SHARP, RESIDUAL, RESONANCE, RUN_BACK, STARTS),
)
