"""Solvers of the hoist, one a file, from the cheapest to the richest."""

from ptmcalc.machines.hoist.solvers.hoist_statics import HOIST_STATICS
from ptmcalc.machines.hoist.solvers.hoist_train import TRAIN
from ptmcalc.machines.hoist.solvers.lifting_formulas import FORMULAS
from ptmcalc.machines.hoist.solvers.two_mass import TWO_MASS

SOLVERS = (HOIST_STATICS, *FORMULAS, TWO_MASS, TRAIN)
