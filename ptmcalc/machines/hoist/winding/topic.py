"""Multilayer winding: the rope climbs to its next layer."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.hoist.machine.spec import Hoist
from ptmcalc.machines.hoist.winding.checks import CHECKS_OF_WINDING
from ptmcalc.machines.hoist.winding.corrected import WINDING_CORRECTED
from ptmcalc.machines.hoist.winding.effects import LAYER_MAP
from ptmcalc.machines.hoist.winding.loads import OF_THE_PAPER, OF_THE_WINDING
from ptmcalc.machines.hoist.winding.map import WINDING_MAP
from ptmcalc.machines.hoist.winding.paper import WINDING_PAPER

WINDING: Topic[Hoist] = Topic(
    loads=(*OF_THE_WINDING, *OF_THE_PAPER),
    effects=(LAYER_MAP,),
    solvers=(WINDING_PAPER, WINDING_CORRECTED, WINDING_MAP),
    checks=CHECKS_OF_WINDING,
)
