"""Solvers of the stacker cranes, from the cheapest to the most complete."""

from ptmcalc.contract.solver import AnySolver
from ptmcalc.machines.crane.stacking.collision.buffer_stop import BUFFER_STOP
from ptmcalc.machines.crane.stacking.fork.caught import CAUGHT_HANDBOOK, CAUGHT_STOPPED, CAUGHT_TRAIN
from ptmcalc.machines.crane.stacking.fork.pushed import PUSH_HANDBOOK, PUSH_RIGID, PUSH_TRAIN
from ptmcalc.machines.crane.stacking.mast.solvers import SOLVERS_OF_MAST
from ptmcalc.machines.crane.stacking.mechanisms.carriage_statics import CARRIAGE_STATICS
from ptmcalc.machines.crane.stacking.mechanisms.drive_times import DRIVE_TIMES
from ptmcalc.machines.crane.stacking.rail.roll import RAIL_JUMP, RAIL_RESPONSE, RAIL_STANDARD
from ptmcalc.machines.crane.stacking.safety_gear.catch import GEAR_CATCH
from ptmcalc.machines.crane.stacking.strength.weights import WEIGHTS

SOLVERS: tuple[AnySolver, ...] = (
    CARRIAGE_STATICS,
    WEIGHTS,
    DRIVE_TIMES,
    *SOLVERS_OF_MAST,
    BUFFER_STOP,
    CAUGHT_HANDBOOK,
    CAUGHT_STOPPED,
    CAUGHT_TRAIN,
    PUSH_HANDBOOK,
    PUSH_RIGID,
    PUSH_TRAIN,
    RAIL_STANDARD,
    RAIL_RESPONSE,
    RAIL_JUMP,
    GEAR_CATCH,
)
