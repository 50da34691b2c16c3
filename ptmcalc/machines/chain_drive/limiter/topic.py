"""Torque limiter: torque in operation, chain tension in a jam, margin of the setting."""

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.contract.topic import Topic
from ptmcalc.machines.chain_drive.limiter.checks import JAM, MARGIN, TRIP
from ptmcalc.machines.chain_drive.limiter.effects import LIMITER_TRIP
from ptmcalc.machines.chain_drive.limiter.running import LIMITER_JAM, LIMITER_RUN
from ptmcalc.machines.chain_drive.limiter.starts import LIMITER_START, LIMITER_TEETH
from ptmcalc.machines.chain_drive.limiter.stops import LIMITER_STOP
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive

LIMITER: Topic[ChainDrive] = Topic(
    loads=(
        LoadInfo("limiter_torque", "torque of the torque limiter, maximum", units.TORQUE, governing=True),
        LoadInfo("tension_jam", "chain tension when a jam trips the limiter, maximum", units.FORCE, governing=True),
        LoadInfo("safety_jam", "safety factor, jam", units.RATIO, governing=True),
        LoadInfo("limiter_reserve", "torque limiter setting / running torque", units.RATIO),
    ),
    effects=(LIMITER_TRIP,),
    solvers=(LIMITER_JAM, LIMITER_RUN, LIMITER_START, LIMITER_TEETH, LIMITER_STOP),
    checks=(TRIP, JAM, MARGIN),
)
