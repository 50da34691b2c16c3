"""Solvers of the column's motion, from the cheapest to the richest."""

from ptmcalc.contract.solver import AnySolver
from ptmcalc.machines.crane.stacking.collision.obstacle_energy import (
    OBSTACLE_BOUND,
    OBSTACLE_ENERGY,
    OBSTACLE_TIP_STOPPED,
)
from ptmcalc.machines.crane.stacking.mast.beam import MAST_BEAM
from ptmcalc.machines.crane.stacking.mast.handbook import MAST_HANDBOOK
from ptmcalc.machines.crane.stacking.mast.modal import COLLISION_MODAL, MAST_MODAL, STANDING_MODAL
from ptmcalc.machines.crane.stacking.mast.two_mass_run import MAST_TWO_MASS

SOLVERS_OF_MAST: tuple[AnySolver, ...] = (
    MAST_HANDBOOK,
    OBSTACLE_TIP_STOPPED,
    OBSTACLE_ENERGY,
    OBSTACLE_BOUND,
    MAST_BEAM,
    MAST_TWO_MASS,
    MAST_MODAL,
    COLLISION_MODAL,
    STANDING_MODAL,
)
