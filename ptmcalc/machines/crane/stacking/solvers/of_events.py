"""Solvers of buffers, fork, rail and safety gear, from the cheapest to the richest."""

from ptmcalc.contract.solver import AnySolver
from ptmcalc.machines.crane.stacking.solvers.buffer_stop import BUFFER_STOP
from ptmcalc.machines.crane.stacking.solvers.fork_caught import CAUGHT_HANDBOOK, CAUGHT_STOPPED, CAUGHT_TRAIN
from ptmcalc.machines.crane.stacking.solvers.fork_pushed import PUSH_HANDBOOK, PUSH_RIGID, PUSH_TRAIN
from ptmcalc.machines.crane.stacking.solvers.rail_roll import RAIL_JUMP, RAIL_RESPONSE, RAIL_STANDARD
from ptmcalc.machines.crane.stacking.solvers.safety_gear_catch import GEAR_CATCH

SOLVERS_OF_EVENTS: tuple[AnySolver, ...] = (
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
