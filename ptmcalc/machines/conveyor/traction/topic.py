"""Traction: belt slip at the drive pulleys, its distance and heat."""

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.contract.topic import Topic
from ptmcalc.machines.conveyor.machine.loads import parts_of
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.traction.checks import HEAT, SLIP

LOADS = (
    LoadInfo("slip_utilisation_max", "traction used (T1/T2)/e^(mu*alpha)", units.SHARE, governing=True),
    LoadInfo("slip_reserve_min", "traction reserve, minimum", units.RATIO, governing=True),
    LoadInfo("slip_distance", "slip distance at drive pulley", units.SPAN),
    LoadInfo("slip_heat", "slip heat at drive pulley", units.ENERGY),
)

TRACTION: Topic[Conveyor] = Topic(
    loads=LOADS,
    parts=lambda spec: parts_of(LOADS, spec),
    checks=(SLIP, HEAT),
)
