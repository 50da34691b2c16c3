"""Rail: steps, gaps and waviness, wheels that lift off."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.crane.stacking.machine.loads import OF_THE_RAIL
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.rail.checks import CHECKS_OF_THE_RAIL
from ptmcalc.machines.crane.stacking.rail.effects import EFFECTS_OF_THE_RAIL
from ptmcalc.machines.crane.stacking.rail.roll import RAIL_JUMP, RAIL_RESPONSE, RAIL_STANDARD

RAIL: Topic[Stacker] = Topic(
    loads=OF_THE_RAIL,
    effects=EFFECTS_OF_THE_RAIL,
    solvers=(RAIL_STANDARD, RAIL_RESPONSE, RAIL_JUMP),
    checks=CHECKS_OF_THE_RAIL,
)
