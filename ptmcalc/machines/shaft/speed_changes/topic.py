"""Run-up and run-out: time and angle, starting torque, brake."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.shaft.machine.spec import Shaft
from ptmcalc.machines.shaft.speed_changes.checks import CHECKS_OF_SPEED_CHANGES
from ptmcalc.machines.shaft.speed_changes.loads import LOADS_OF_RUN_OUT, LOADS_OF_RUN_UP
from ptmcalc.machines.shaft.speed_changes.speed_quadrature import SPEED_QUADRATURE
from ptmcalc.machines.shaft.speed_changes.step_table import STEP_TABLE
from ptmcalc.machines.shaft.speed_changes.stop_formula import STOP_FORMULA
from ptmcalc.machines.shaft.speed_changes.tachogram import MEAN_RUN_OUT, MEAN_RUN_UP, RUN_OUT, RUN_UP

SPEED_CHANGES: Topic[Shaft] = Topic(
    loads=(*LOADS_OF_RUN_UP, *LOADS_OF_RUN_OUT),
    solvers=(SPEED_QUADRATURE, STOP_FORMULA, STEP_TABLE, MEAN_RUN_UP, RUN_UP, MEAN_RUN_OUT, RUN_OUT),
    checks=CHECKS_OF_SPEED_CHANGES,
)
