"""Skewing of the crane on its rails."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.crane.travelling.loads import OF_SKEWING
from ptmcalc.machines.crane.travelling.skewing.checks import GUIDE
from ptmcalc.machines.crane.travelling.skewing.skewing import SKEWING
from ptmcalc.machines.crane.travelling.spec import Travelling

SKEW: Topic[Travelling] = Topic(
    loads=OF_SKEWING,
    solvers=(SKEWING,),
    checks=(GUIDE,),
)
