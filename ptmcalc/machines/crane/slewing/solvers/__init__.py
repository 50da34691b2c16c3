"""Solvers of the slewing crane, one a file, from the cheapest to the richest."""

from ptmcalc.machines.crane.slewing.solvers.consistent import CONSISTENT, CURVED, GEARED
from ptmcalc.machines.crane.slewing.solvers.handbook import HANDBOOK
from ptmcalc.machines.crane.slewing.solvers.leans import LEANS
from ptmcalc.machines.crane.slewing.solvers.slew import SLEW

SOLVERS = (HANDBOOK, LEANS, CONSISTENT, GEARED, CURVED, SLEW)
