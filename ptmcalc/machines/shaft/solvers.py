"""Solvers of the main shaft, one a file, from the cheapest to the richest."""

from ptmcalc.machines.shaft.cycle.closed_cycle import CLOSED_CYCLE, MEAN_CYCLE
from ptmcalc.machines.shaft.cycle.energy_step import ENERGY_STEP
from ptmcalc.machines.shaft.cycle.flywheel_formula import FLYWHEEL_FORMULA
from ptmcalc.machines.shaft.cycle.work_balance import WORK_BALANCE
from ptmcalc.machines.shaft.runs.speed_quadrature import SPEED_QUADRATURE
from ptmcalc.machines.shaft.runs.step_table import STEP_TABLE
from ptmcalc.machines.shaft.runs.stop_formula import STOP_FORMULA
from ptmcalc.machines.shaft.runs.tachogram import MEAN_RUN_OUT, MEAN_RUN_UP, RUN_OUT, RUN_UP

SOLVERS = (
    WORK_BALANCE,
    SPEED_QUADRATURE,
    STOP_FORMULA,
    FLYWHEEL_FORMULA,
    STEP_TABLE,
    ENERGY_STEP,
    MEAN_CYCLE,
    CLOSED_CYCLE,
    MEAN_RUN_UP,
    RUN_UP,
    MEAN_RUN_OUT,
    RUN_OUT,
)
