"""The drive in steady motion: motor, gearbox, brake, duty."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.hoist.drive.checks import CHECKS_OF_DRIVE
from ptmcalc.machines.hoist.drive.loads import OF_THE_CLASS, OF_THE_DRIVE
from ptmcalc.machines.hoist.drive.solver import HOLDING, STARTING
from ptmcalc.machines.hoist.machine.spec import Hoist

DRIVE: Topic[Hoist] = Topic(
    loads=(*OF_THE_DRIVE, *OF_THE_CLASS),
    solvers=(HOLDING, STARTING),
    checks=CHECKS_OF_DRIVE,
)
