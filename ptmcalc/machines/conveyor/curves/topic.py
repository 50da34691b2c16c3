"""Horizontal curves: does the belt stay on its idlers?"""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.conveyor.curves.checks import INWARD, OUTWARD
from ptmcalc.machines.conveyor.curves.loads import LOADS, loads_of
from ptmcalc.machines.conveyor.curves.tensions import BEND_TENSIONS
from ptmcalc.machines.conveyor.machine.spec import Conveyor

CURVES: Topic[Conveyor] = Topic(loads=LOADS, parts=loads_of, solvers=(BEND_TENSIONS,), checks=(INWARD, OUTWARD))
