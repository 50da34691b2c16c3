"""Skewing of the crane on its rails."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.crane.travelling.machine.loads import OF_SKEWING
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.machines.crane.travelling.skewing.checks import GUIDE
from ptmcalc.machines.crane.travelling.skewing.skewing import SKEWING

SKEW: Topic[Travelling] = Topic(
    loads=OF_SKEWING,
    solvers=(SKEWING,),
    checks=(GUIDE,),
)
