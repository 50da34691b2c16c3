"""Solvers of the travelling crane, one a file, from the cheapest to the richest."""

from ptmcalc.machines.crane.travelling.buffers.buffer_collision import BUFFER_COLLISION
from ptmcalc.machines.crane.travelling.rail.rail_response import RAIL_RESPONSE, RAIL_STANDARD
from ptmcalc.machines.crane.travelling.skewing.skewing import SKEWING
from ptmcalc.machines.crane.travelling.statics.travel_statics import STARTING, TRAVEL_STATICS
from ptmcalc.machines.crane.travelling.storm.storm_parking import STORM_PARKING
from ptmcalc.machines.crane.travelling.sway.sway_exact import SWAY_EXACT
from ptmcalc.machines.crane.travelling.sway.sway_linear import SWAY_LINEAR
from ptmcalc.machines.crane.travelling.sway.sway_simulated import SWAY_SIMULATED
from ptmcalc.machines.crane.travelling.sway.travel_handbook import TRAVEL_HANDBOOK

SOLVERS = (
    TRAVEL_STATICS,
    STARTING,
    TRAVEL_HANDBOOK,
    SWAY_LINEAR,
    SWAY_EXACT,
    SWAY_SIMULATED,
    BUFFER_COLLISION,
    RAIL_RESPONSE,
    RAIL_STANDARD,
    SKEWING,
    STORM_PARKING,
)
