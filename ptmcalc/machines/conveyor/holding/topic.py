"""Holding the stopped belt: rollback torque, forward torque."""

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.contract.topic import Topic
from ptmcalc.machines.conveyor.holding.checks import BACKSTOP, FORWARD
from ptmcalc.machines.conveyor.holding.solver import HOLDING
from ptmcalc.machines.conveyor.machine.spec import Conveyor

LOADS = (
    LoadInfo("backstop_torque", "rollback torque, drive pulley shaft", units.TORQUE, governing=True),
    LoadInfo("forward_torque", "forward torque at standstill, drive pulley shaft", units.TORQUE, governing=True),
)

ROLLBACK: Topic[Conveyor] = Topic(
    loads=LOADS,
    solvers=(HOLDING,),
    checks=(BACKSTOP, FORWARD),
)
