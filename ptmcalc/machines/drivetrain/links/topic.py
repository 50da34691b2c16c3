"""Links: peak torque, what elasticity and backlash add to it, wear."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.drivetrain.links.checks import CHECKS_OF_LINKS
from ptmcalc.machines.drivetrain.links.effects import EFFECTS_OF_LINKS
from ptmcalc.machines.drivetrain.links.loads import LOADS_OF_LINKS, parts
from ptmcalc.machines.drivetrain.spec import Drivetrain

LINKS: Topic[Drivetrain] = Topic(
    loads=LOADS_OF_LINKS,
    parts=parts,
    effects=EFFECTS_OF_LINKS,
    checks=CHECKS_OF_LINKS,
)
