"""Solvers of the conveyor, one a file, from the cheapest to the richest."""

from ptmcalc.machines.conveyor.running.motor_torque import STEADY_DRIVE
from ptmcalc.machines.conveyor.running.statics import STATICS
from ptmcalc.machines.conveyor.starting.rigid import RIGID
from ptmcalc.machines.conveyor.stopping.formulas import BRAKING, BRAKING_NOTES, HOLDING, IDENTIFY, RIGID_STOP
from ptmcalc.machines.conveyor.stopping.stiff import STIFF_STOP
from ptmcalc.machines.conveyor.waves.characteristics import CHARACTERISTICS
from ptmcalc.machines.conveyor.waves.first_wave import FIRST_WAVE
from ptmcalc.machines.conveyor.waves.network import NETWORK, RUNNING_NETWORK
from ptmcalc.machines.conveyor.waves.two_interval import TWO_INTERVAL

SOLVERS = (
    STATICS,
    STEADY_DRIVE,
    HOLDING,
    BRAKING,
    BRAKING_NOTES,
    IDENTIFY,
    RIGID_STOP,
    STIFF_STOP,
    RIGID,
    FIRST_WAVE,
    TWO_INTERVAL,
    CHARACTERISTICS,
    NETWORK,
    RUNNING_NETWORK,
)
