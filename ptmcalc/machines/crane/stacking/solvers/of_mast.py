"""Solvers of the column's motion, from the cheapest to the richest."""

from ptmcalc.contract.solver import AnySolver

SOLVERS_OF_MAST: tuple[AnySolver, ...] = ()
