"""Solvers of the chain drive, one a file, from the cheapest to the richest."""

from ptmcalc.contract.solver import AnySolver
from ptmcalc.machines.chain_drive.polygon.bound import POLYGON_BOUND
from ptmcalc.machines.chain_drive.polygon.chain_modes import CHAIN_MODES
from ptmcalc.machines.chain_drive.polygon.distributed_strand import DISTRIBUTED_STRAND
from ptmcalc.machines.chain_drive.polygon.textbook import CHAIN_TEXTBOOK
from ptmcalc.machines.chain_drive.running.motor_torque import STEADY_DRIVE
from ptmcalc.machines.chain_drive.running.selection import CHAIN_SELECTION
from ptmcalc.machines.chain_drive.running.statics import STATICS
from ptmcalc.machines.chain_drive.speed_change.tooth_passes import RANGE, RANGE_NOTES, START_TEETH
from ptmcalc.machines.chain_drive.starting.breakaway import BREAKAWAY
from ptmcalc.machines.chain_drive.starting.rigid import RIGID_START, START_NOTES
from ptmcalc.machines.chain_drive.starting.waves import ONE_MODE, WAVES
from ptmcalc.machines.chain_drive.stopping.formulas import SOLVERS_OF_STOPS

SOLVERS: tuple[AnySolver, ...] = (
    STATICS,
    STEADY_DRIVE,
    CHAIN_SELECTION,
    CHAIN_TEXTBOOK,
    CHAIN_MODES,
    POLYGON_BOUND,
    DISTRIBUTED_STRAND,
    RIGID_START,
    START_NOTES,
    ONE_MODE,
    BREAKAWAY,
    WAVES,
    START_TEETH,
    RANGE_NOTES,
    RANGE,
    *SOLVERS_OF_STOPS,
)
