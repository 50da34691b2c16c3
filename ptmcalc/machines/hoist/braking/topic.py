"""Emergency stops by the brake: motion of the rigid drive, heat and wear of the brake."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.hoist.braking.checks import CHECKS_OF_BRAKING
from ptmcalc.machines.hoist.braking.loads import LOADS
from ptmcalc.machines.hoist.braking.solver import EMERGENCY
from ptmcalc.machines.hoist.machine.spec import Hoist

BRAKING: Topic[Hoist] = Topic(loads=LOADS, solvers=(EMERGENCY,), checks=CHECKS_OF_BRAKING)
