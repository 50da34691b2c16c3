"""Solvers of buffers, fork, rail and safety gear, from the cheapest to the richest."""

from ptmcalc.contract.solver import AnySolver

SOLVERS_OF_EVENTS: tuple[AnySolver, ...] = ()
