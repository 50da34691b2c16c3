"""Steady hoisting and lowering: rope, sheaves, drum, classification."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.hoist.machine.spec import Hoist
from ptmcalc.machines.hoist.statics.checks_drum import CHECKS_OF_DRUM
from ptmcalc.machines.hoist.statics.checks_rope import CHECKS_OF_ROPE
from ptmcalc.machines.hoist.statics.handbook import HOIST_HANDBOOK
from ptmcalc.machines.hoist.statics.loads import OF_THE_DRUM, OF_THE_ROPE, parts
from ptmcalc.machines.hoist.statics.solver import HOIST_STATICS

STATICS: Topic[Hoist] = Topic(
    loads=(*OF_THE_ROPE, *OF_THE_DRUM),
    parts=parts,
    solvers=(HOIST_STATICS, HOIST_HANDBOOK),
    checks=(*CHECKS_OF_ROPE, *CHECKS_OF_DRUM),
)
