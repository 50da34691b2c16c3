"""Solvers of the drive train, one a file, from the cheapest to the richest."""

from ptmcalc.machines.drivetrain.solvers.elastic import ELASTIC
from ptmcalc.machines.drivetrain.solvers.modal import MODAL
from ptmcalc.machines.drivetrain.solvers.reduced import ONE_SHAFT, REDUCED

SOLVERS = (MODAL, REDUCED, ONE_SHAFT, ELASTIC)
