"""Links: peak torque, dynamic factor, wear."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.drivetrain.links.checks import CHECKS_OF_LINKS
from ptmcalc.machines.drivetrain.links.loads import LOADS_OF_LINKS, parts
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain

LINKS: Topic[Drivetrain] = Topic(
    loads=LOADS_OF_LINKS,
    parts=parts,
    checks=CHECKS_OF_LINKS,
)
