"""Strength: weights, load combinations, stresses, stability."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.crane.stacking.machine.loads import OF_STRENGTH, OF_THE_TABLES, parts_of
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.strength.checks import CHECKS_OF_STRENGTH
from ptmcalc.machines.crane.stacking.strength.weights import WEIGHTS

STRENGTH: Topic[Stacker] = Topic(
    loads=(*OF_STRENGTH, *OF_THE_TABLES),
    parts=lambda spec: parts_of((*OF_STRENGTH, *OF_THE_TABLES), spec),
    solvers=(WEIGHTS,),
    checks=CHECKS_OF_STRENGTH,
)
