"""The solvers of a chain that changes its speed, from the cheapest to the richest."""

from ptmcalc.contract.solver import AnySolver
from ptmcalc.machines.chain_drive.solvers.breakaway import BREAKAWAY
from ptmcalc.machines.chain_drive.solvers.rigid_start import RIGID_START, START_NOTES
from ptmcalc.machines.chain_drive.solvers.start_waves import ONE_MODE, WAVES
from ptmcalc.machines.chain_drive.solvers.stopping import SOLVERS_OF_STOPS
from ptmcalc.machines.chain_drive.solvers.tooth_passes import RANGE, RANGE_NOTES, START_TEETH

SOLVERS_OF_MOTION: tuple[AnySolver, ...] = (
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
