"""Sway of the load in start, steady slewing and stop."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.crane.slewing.machine.spec import SlewingCrane
from ptmcalc.machines.crane.slewing.sway.checks import CHECKS_OF_SWAY
from ptmcalc.machines.crane.slewing.sway.effects import EFFECTS_OF_SWAY
from ptmcalc.machines.crane.slewing.sway.leans import LEANS
from ptmcalc.machines.crane.slewing.sway.loads import OF_THE_SWING
from ptmcalc.machines.crane.slewing.sway.slew import SLEW

SWAY: Topic[SlewingCrane] = Topic(
    loads=OF_THE_SWING,
    effects=EFFECTS_OF_SWAY,
    solvers=(LEANS, SLEW),
    checks=CHECKS_OF_SWAY,
)
