"""Solvers of the chain drive, one a file, from the cheapest to the richest."""

from ptmcalc.contract.solver import AnySolver
from ptmcalc.machines.chain_drive.solvers.chain_modes import CHAIN_MODES
from ptmcalc.machines.chain_drive.solvers.chain_selection import CHAIN_SELECTION
from ptmcalc.machines.chain_drive.solvers.chain_textbook import CHAIN_TEXTBOOK
from ptmcalc.machines.chain_drive.solvers.distributed_strand import DISTRIBUTED_STRAND
from ptmcalc.machines.chain_drive.solvers.of_motion import SOLVERS_OF_MOTION
from ptmcalc.machines.chain_drive.solvers.polygon_bound import POLYGON_BOUND
from ptmcalc.machines.chain_drive.solvers.statics import STATICS
from ptmcalc.machines.chain_drive.solvers.steady_drive import STEADY_DRIVE

SOLVERS: tuple[AnySolver, ...] = (
    STATICS,
    STEADY_DRIVE,
    CHAIN_SELECTION,
    CHAIN_TEXTBOOK,
    CHAIN_MODES,
    POLYGON_BOUND,
    DISTRIBUTED_STRAND,
    *SOLVERS_OF_MOTION,
)
