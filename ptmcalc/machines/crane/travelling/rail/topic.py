"""Rail: steps and gaps."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.crane.travelling.machine.loads import OF_THE_RAIL
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.machines.crane.travelling.rail.checks import CONTACT
from ptmcalc.machines.crane.travelling.rail.effects import RAIL_EFFECT
from ptmcalc.machines.crane.travelling.rail.rail_response import RAIL_RESPONSE, RAIL_STANDARD

RAIL: Topic[Travelling] = Topic(
    loads=OF_THE_RAIL,
    effects=(RAIL_EFFECT,),
    solvers=(RAIL_RESPONSE, RAIL_STANDARD),
    checks=(CONTACT,),
)
