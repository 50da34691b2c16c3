"""Motion of the train: start and stop, speeds, stopping distance, clutches, elasticity and backlash of the links."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain
from ptmcalc.machines.drivetrain.motion.checks import CHECKS_OF_MOTION
from ptmcalc.machines.drivetrain.motion.effects import EFFECTS_OF_MOTION
from ptmcalc.machines.drivetrain.motion.elastic import ELASTIC
from ptmcalc.machines.drivetrain.motion.loads import LOADS_OF_MOTION, parts
from ptmcalc.machines.drivetrain.motion.reduced import ONE_SHAFT, REDUCED

MOTION: Topic[Drivetrain] = Topic(
    loads=LOADS_OF_MOTION,
    parts=parts,
    effects=EFFECTS_OF_MOTION,
    solvers=(REDUCED, ONE_SHAFT, ELASTIC),
    checks=CHECKS_OF_MOTION,
)
