"""Buffers: collision, and the crane that yaws in it."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.crane.travelling.buffers.buffer_collision import BUFFER_COLLISION
from ptmcalc.machines.crane.travelling.buffers.checks import CHECKS_OF_BUFFERS
from ptmcalc.machines.crane.travelling.machine.loads import OF_THE_BUFFERS
from ptmcalc.machines.crane.travelling.machine.spec import Travelling

BUFFERS: Topic[Travelling] = Topic(
    loads=OF_THE_BUFFERS,
    solvers=(BUFFER_COLLISION,),
    checks=CHECKS_OF_BUFFERS,
)
