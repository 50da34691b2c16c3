"""Safety gear: fall and catch."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.crane.stacking.loads import OF_THE_SAFETY_GEAR
from ptmcalc.machines.crane.stacking.safety_gear.catch import GEAR_CATCH
from ptmcalc.machines.crane.stacking.safety_gear.checks import CHECKS_OF_THE_SAFETY_GEAR
from ptmcalc.machines.crane.stacking.safety_gear.effects import EFFECTS_OF_THE_SAFETY_GEAR
from ptmcalc.machines.crane.stacking.spec import Stacker

SAFETY_GEAR: Topic[Stacker] = Topic(
    loads=OF_THE_SAFETY_GEAR,
    effects=EFFECTS_OF_THE_SAFETY_GEAR,
    solvers=(GEAR_CATCH,),
    checks=CHECKS_OF_THE_SAFETY_GEAR,
)
