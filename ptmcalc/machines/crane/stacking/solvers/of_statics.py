"""Solvers of weights, carriage and drives."""

from ptmcalc.contract.solver import AnySolver

SOLVERS_OF_STATICS: tuple[AnySolver, ...] = ()
