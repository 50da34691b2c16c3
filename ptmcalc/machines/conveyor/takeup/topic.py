"""Take-up: its travel over all scenes, and the stops of its weight."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.takeup.checks import STOPS, TRAVEL_BUDGET
from ptmcalc.machines.conveyor.takeup.loads import LOADS, loads_of
from ptmcalc.machines.conveyor.takeup.travel import TRAVEL

TAKEUP: Topic[Conveyor] = Topic(loads=LOADS, parts=loads_of, solvers=(TRAVEL,), checks=(TRAVEL_BUDGET, STOPS))
