"""Solvers of the column's motion, from the cheapest to the richest."""

from ptmcalc.contract.solver import AnySolver
from ptmcalc.machines.crane.stacking.solvers.mast_modal import MAST_MODAL

SOLVERS_OF_MAST: tuple[AnySolver, ...] = (MAST_MODAL,)
