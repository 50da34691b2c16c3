"""Solvers of the stacker cranes, one a file; each list in a file of its own, from the cheapest to the richest."""

from ptmcalc.machines.crane.stacking.solvers.of_events import SOLVERS_OF_EVENTS
from ptmcalc.machines.crane.stacking.solvers.of_mast import SOLVERS_OF_MAST
from ptmcalc.machines.crane.stacking.solvers.of_statics import SOLVERS_OF_STATICS

SOLVERS = (*SOLVERS_OF_STATICS, *SOLVERS_OF_MAST, *SOLVERS_OF_EVENTS)
