"""Slewing ring: forces, tilting moment, limit curve."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.crane.slewing.machine.spec import SlewingCrane
from ptmcalc.machines.crane.slewing.ring.checks import RING
from ptmcalc.machines.crane.slewing.ring.loads import OF_THE_RING

SLEWING_RING: Topic[SlewingCrane] = Topic(
    loads=OF_THE_RING,
    checks=(RING,),
)
