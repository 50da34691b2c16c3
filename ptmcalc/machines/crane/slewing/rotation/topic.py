"""Rotation of the rigid crane: start, steady slewing, stop."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.crane.slewing.machine.spec import SlewingCrane
from ptmcalc.machines.crane.slewing.rotation.checks import CHECKS_OF_ROTATION
from ptmcalc.machines.crane.slewing.rotation.consistent import CONSISTENT, CURVED, GEARED
from ptmcalc.machines.crane.slewing.rotation.effects import EFFECTS_OF_ROTATION
from ptmcalc.machines.crane.slewing.rotation.handbook import HANDBOOK
from ptmcalc.machines.crane.slewing.rotation.loads import OF_THE_CHAIN

ROTATION: Topic[SlewingCrane] = Topic(
    loads=OF_THE_CHAIN,
    effects=EFFECTS_OF_ROTATION,
    solvers=(HANDBOOK, CONSISTENT, GEARED, CURVED),
    checks=CHECKS_OF_ROTATION,
)
