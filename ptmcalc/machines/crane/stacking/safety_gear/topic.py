"""Safety gear: fall and catch."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.crane.stacking.machine.loads import OF_THE_SAFETY_GEAR
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.safety_gear.catch import GEAR_CATCH
from ptmcalc.machines.crane.stacking.safety_gear.checks import CHECKS_OF_THE_SAFETY_GEAR
from ptmcalc.machines.crane.stacking.safety_gear.effects import EFFECTS_OF_THE_SAFETY_GEAR

SAFETY_GEAR: Topic[Stacker] = Topic(
    loads=OF_THE_SAFETY_GEAR,
    effects=EFFECTS_OF_THE_SAFETY_GEAR,
    solvers=(GEAR_CATCH,),
    checks=CHECKS_OF_THE_SAFETY_GEAR,
)
