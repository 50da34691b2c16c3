"""Mechanisms: carriage, ropes, starting and stopping times."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.crane.stacking.machine.loads import OF_STANDING, OF_THE_HOIST
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.mechanisms.carriage_statics import CARRIAGE_STATICS
from ptmcalc.machines.crane.stacking.mechanisms.checks import CHECKS_OF_STATICS
from ptmcalc.machines.crane.stacking.mechanisms.drive_times import DRIVE_TIMES

MECHANISMS: Topic[Stacker] = Topic(
    loads=(*OF_THE_HOIST, *OF_STANDING),
    solvers=(CARRIAGE_STATICS, DRIVE_TIMES),
    checks=CHECKS_OF_STATICS,
)
