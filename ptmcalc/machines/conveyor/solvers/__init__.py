"""Solvers of the conveyor, one a file, from the cheapest to the richest."""

from ptmcalc.machines.conveyor.solvers.characteristics import CHARACTERISTICS
from ptmcalc.machines.conveyor.solvers.first_wave import FIRST_WAVE
from ptmcalc.machines.conveyor.solvers.network import NETWORK, RUNNING_NETWORK
from ptmcalc.machines.conveyor.solvers.rigid import RIGID
from ptmcalc.machines.conveyor.solvers.standing import BRAKING, BRAKING_NOTES, HOLDING, IDENTIFY, RIGID_STOP
from ptmcalc.machines.conveyor.solvers.statics import STATICS
from ptmcalc.machines.conveyor.solvers.steady_drive import STEADY_DRIVE
from ptmcalc.machines.conveyor.solvers.stiff_stop import STIFF_STOP
from ptmcalc.machines.conveyor.solvers.two_interval import TWO_INTERVAL

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
