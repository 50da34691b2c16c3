"""Starting and stopping: sway of the load, wheel loads, adhesion."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.crane.travelling.machine.loads import OF_MOTION, parts_of
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.machines.crane.travelling.sway.checks import CHECKS_OF_SWAY
from ptmcalc.machines.crane.travelling.sway.effects import EFFECTS_OF_TRAVEL
from ptmcalc.machines.crane.travelling.sway.sway_exact import SWAY_EXACT
from ptmcalc.machines.crane.travelling.sway.sway_linear import SWAY_LINEAR
from ptmcalc.machines.crane.travelling.sway.sway_simulated import SWAY_SIMULATED
from ptmcalc.machines.crane.travelling.sway.travel_handbook import TRAVEL_HANDBOOK

TRAVEL: Topic[Travelling] = Topic(
    loads=OF_MOTION,
    parts=lambda spec: parts_of(OF_MOTION, spec),
    effects=EFFECTS_OF_TRAVEL,
    solvers=(TRAVEL_HANDBOOK, SWAY_LINEAR, SWAY_EXACT, SWAY_SIMULATED),
    checks=CHECKS_OF_SWAY,
)
