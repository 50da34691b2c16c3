"""Lifting, lowering, stopping, release: oscillation of load, rope, drive and structure."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.hoist.machine.spec import Hoist
from ptmcalc.machines.hoist.motion.checks import CHECKS_OF_MOTION
from ptmcalc.machines.hoist.motion.effects import EFFECTS_OF_MOTION
from ptmcalc.machines.hoist.motion.hoist_train import TRAIN
from ptmcalc.machines.hoist.motion.lifting_formulas import FORMULAS
from ptmcalc.machines.hoist.motion.loads import LOADS_OF_MOTION
from ptmcalc.machines.hoist.motion.rope_hauled import ROPE_HAULED
from ptmcalc.machines.hoist.motion.rope_waves import ROPE_WAVES
from ptmcalc.machines.hoist.motion.two_mass import TWO_MASS

MOTION: Topic[Hoist] = Topic(
    loads=LOADS_OF_MOTION,
    effects=EFFECTS_OF_MOTION,
    solvers=(*FORMULAS, TWO_MASS, TRAIN, ROPE_HAULED, ROPE_WAVES),
    checks=CHECKS_OF_MOTION,
)
