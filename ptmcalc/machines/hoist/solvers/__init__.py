"""Solvers of the hoist, one a file, from the cheapest to the richest."""

from ptmcalc.machines.hoist.solvers.hoist_statics import HOIST_STATICS

SOLVERS = (HOIST_STATICS,)
