"""Steady cycle: speed fluctuation, flywheel, efficiency, motor torque."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.shaft.cycle.checks import CHECKS_OF_CYCLE
from ptmcalc.machines.shaft.cycle.closed_cycle import CLOSED_CYCLE, MEAN_CYCLE
from ptmcalc.machines.shaft.cycle.effects import MOTOR_SLOPE
from ptmcalc.machines.shaft.cycle.energy_step import ENERGY_STEP
from ptmcalc.machines.shaft.cycle.flywheel_formula import FLYWHEEL_FORMULA
from ptmcalc.machines.shaft.cycle.loads import LOADS_OF_CYCLE
from ptmcalc.machines.shaft.cycle.work_balance import WORK_BALANCE
from ptmcalc.machines.shaft.machine.spec import Shaft

CYCLE: Topic[Shaft] = Topic(
    loads=LOADS_OF_CYCLE,
    effects=(MOTOR_SLOPE,),
    solvers=(WORK_BALANCE, FLYWHEEL_FORMULA, ENERGY_STEP, MEAN_CYCLE, CLOSED_CYCLE),
    checks=CHECKS_OF_CYCLE,
)
