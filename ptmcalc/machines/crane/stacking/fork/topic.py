"""Fork: snagged by the rack, or pushed against it."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.crane.stacking.fork.caught import CAUGHT_HANDBOOK, CAUGHT_STOPPED, CAUGHT_TRAIN
from ptmcalc.machines.crane.stacking.fork.checks import CHECKS_OF_THE_FORK
from ptmcalc.machines.crane.stacking.fork.effects import EFFECTS_OF_THE_FORK
from ptmcalc.machines.crane.stacking.fork.pushed import PUSH_HANDBOOK, PUSH_RIGID, PUSH_TRAIN
from ptmcalc.machines.crane.stacking.machine.loads import OF_THE_FORK
from ptmcalc.machines.crane.stacking.machine.spec import Stacker

FORK: Topic[Stacker] = Topic(
    loads=OF_THE_FORK,
    effects=EFFECTS_OF_THE_FORK,
    solvers=(CAUGHT_HANDBOOK, CAUGHT_STOPPED, CAUGHT_TRAIN, PUSH_HANDBOOK, PUSH_RIGID, PUSH_TRAIN),
    checks=CHECKS_OF_THE_FORK,
)
