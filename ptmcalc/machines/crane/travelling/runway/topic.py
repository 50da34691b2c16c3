"""Actions of the crane on its runway by EN 1991-3: groups of loads, skewing and fatigue."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.machines.crane.travelling.runway.checks import CHECKS_OF_RUNWAY
from ptmcalc.machines.crane.travelling.runway.loads import OF_THE_RUNWAY, parts
from ptmcalc.machines.crane.travelling.runway.runway_actions import RUNWAY_ACTIONS

RUNWAY: Topic[Travelling] = Topic(
    loads=OF_THE_RUNWAY,
    parts=parts,
    solvers=(RUNWAY_ACTIONS,),
    checks=CHECKS_OF_RUNWAY,
)
