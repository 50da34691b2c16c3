"""Slewing drive: motor, brake, gearbox, wind, duty."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.crane.slewing.drive.checks import CHECKS_OF_DRIVE
from ptmcalc.machines.crane.slewing.drive.checks_duty import GROUP
from ptmcalc.machines.crane.slewing.drive.checks_wind import CHECKS_OF_WIND
from ptmcalc.machines.crane.slewing.drive.loads import OF_THE_DRIVE, OF_THE_USE
from ptmcalc.machines.crane.slewing.machine.spec import SlewingCrane

DRIVE: Topic[SlewingCrane] = Topic(
    loads=(*OF_THE_DRIVE, *OF_THE_USE),
    checks=(*CHECKS_OF_DRIVE, *CHECKS_OF_WIND, GROUP),
)
