"""Inertia of the mechanism: what its change with the angle adds to cycle, run-up and run-out."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.shaft.inertia.effects import VARYING_INERTIA
from ptmcalc.machines.shaft.machine.spec import Shaft

INERTIA: Topic[Shaft] = Topic(effects=(VARYING_INERTIA,))
