"""Solvers of the hoist, one a file, from the cheapest to the richest."""

from ptmcalc.machines.hoist.motion.hoist_train import TRAIN
from ptmcalc.machines.hoist.motion.lifting_formulas import FORMULAS
from ptmcalc.machines.hoist.motion.rope_hauled import ROPE_HAULED
from ptmcalc.machines.hoist.motion.rope_waves import ROPE_WAVES
from ptmcalc.machines.hoist.motion.two_mass import TWO_MASS
from ptmcalc.machines.hoist.statics.handbook import HOIST_HANDBOOK
from ptmcalc.machines.hoist.statics.solver import HOIST_STATICS, HOLDING, STARTING
from ptmcalc.machines.hoist.winding.corrected import WINDING_CORRECTED
from ptmcalc.machines.hoist.winding.map import WINDING_MAP
from ptmcalc.machines.hoist.winding.paper import WINDING_PAPER

SOLVERS = (
    HOIST_STATICS,
    HOIST_HANDBOOK,
    HOLDING,
    STARTING,
    *FORMULAS,
    TWO_MASS,
    TRAIN,
    ROPE_HAULED,
    ROPE_WAVES,
    WINDING_PAPER,
    WINDING_CORRECTED,
    WINDING_MAP,
)
