"""Stopping: brakes, stopping distance and time."""

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.contract.topic import Topic
from ptmcalc.machines.conveyor.machine.loads import BRAKING_FORCE, BRAKING_POWER, BRAKING_RESERVE
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.stopping.brake_heat import HEAT, RIGID_HEAT, brake_parts
from ptmcalc.machines.conveyor.stopping.brake_heat import LOADS as HEAT_LOADS
from ptmcalc.machines.conveyor.stopping.brake_heat import POWER as HEAT_POWER
from ptmcalc.machines.conveyor.stopping.checks import BRAKE, STOP, STOP_TIME
from ptmcalc.machines.conveyor.stopping.controlled import FORCE, POWER, RIGID_BRAKING
from ptmcalc.machines.conveyor.stopping.formulas import BRAKING, BRAKING_NOTES, IDENTIFY, RIGID_STOP
from ptmcalc.machines.conveyor.stopping.stiff import STIFF_STOP

LOADS = (
    LoadInfo("stop_time", "stopping time", units.TIME, governing=True),
    LoadInfo("stop_distance", "stopping distance", units.SPAN, governing=True),
    LoadInfo("stop_distance_max", "stopping distance, maximum of all points", units.SPAN, governing=True),
    LoadInfo("coast_distance", "coasting distance, no brakes", units.SPAN, governing=True),
    LoadInfo("brake_torque_required", "required brake torque, pulley shaft", units.TORQUE, governing=True),
    LoadInfo(BRAKING_FORCE, "required braking force of the drives at pulley", units.FORCE),
    LoadInfo(BRAKING_RESERVE, "braking force reserve", units.RATIO, governing=True),
    LoadInfo(BRAKING_POWER, "power from the braking motors, maximum", units.POWER, governing=True),
    LoadInfo("tension_overload_braking", "belt tension added by braking", units.FORCE),
    LoadInfo("resistance_coefficient_identified", "friction factor f from coasting test", units.RATIO, governing=True),
)

STOPPING: Topic[Conveyor] = Topic(
    loads=(*LOADS, *HEAT_LOADS),
    parts=lambda spec: (*LOADS, *brake_parts(spec)),
    solvers=(BRAKING, BRAKING_NOTES, IDENTIFY, RIGID_STOP, RIGID_BRAKING, RIGID_HEAT, STIFF_STOP),
    checks=(STOP, STOP_TIME, BRAKE, FORCE, POWER, HEAT, HEAT_POWER),
)
