"""Steady travel: resistance, power, wheel loads, stability, duty, standard factors."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.crane.travelling.machine.loads import FACTORS as FACTORS_OF_STANDARDS
from ptmcalc.machines.crane.travelling.machine.loads import OF_THE_CLASS, OF_THE_WHEELS, OF_TRAVEL, parts_of
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.machines.crane.travelling.statics.checks_drive import CHECKS_OF_DRIVE
from ptmcalc.machines.crane.travelling.statics.checks_factors import FACTORS
from ptmcalc.machines.crane.travelling.statics.checks_wheels import CHECKS_OF_WHEELS
from ptmcalc.machines.crane.travelling.statics.travel_statics import STARTING, TRAVEL_STATICS

STATICS: Topic[Travelling] = Topic(
    loads=(*OF_THE_WHEELS, *OF_TRAVEL, *OF_THE_CLASS, *FACTORS_OF_STANDARDS),
    parts=lambda spec: parts_of((*OF_THE_WHEELS, *OF_TRAVEL, *OF_THE_CLASS, *FACTORS_OF_STANDARDS), spec),
    solvers=(TRAVEL_STATICS, STARTING),
    checks=(*CHECKS_OF_WHEELS, *CHECKS_OF_DRIVE, *FACTORS),
)
