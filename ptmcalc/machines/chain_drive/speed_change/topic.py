"""A chain that changes its speed: effects of starts and stops, resonances passed through."""

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.contract.topic import Topic
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive
from ptmcalc.machines.chain_drive.speed_change.effects import EFFECTS_OF_MOTION
from ptmcalc.machines.chain_drive.speed_change.motor_teeth import MOTOR_TEETH
from ptmcalc.machines.chain_drive.speed_change.tooth_passes import RANGE, RANGE_NOTES, START_TEETH

SPEED_CHANGE: Topic[ChainDrive] = Topic(
    loads=(LoadInfo("tension_speed_range", "polygon tension over speed sweep, maximum", units.FORCE, governing=True),),
    effects=EFFECTS_OF_MOTION,
    solvers=(START_TEETH, MOTOR_TEETH, RANGE_NOTES, RANGE),
)
