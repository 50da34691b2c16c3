"""Solvers of weights, carriage and drives."""

from ptmcalc.contract.solver import AnySolver
from ptmcalc.machines.crane.stacking.solvers.carriage_statics import CARRIAGE_STATICS
from ptmcalc.machines.crane.stacking.solvers.drive_times import DRIVE_TIMES
from ptmcalc.machines.crane.stacking.solvers.weights import WEIGHTS

SOLVERS_OF_STATICS: tuple[AnySolver, ...] = (CARRIAGE_STATICS, WEIGHTS, DRIVE_TIMES)
