"""Belt conveyor: running, curves, starting, stopping, traction, take-up and waves of the belt."""

from ptmcalc.contract.example import examples_in, symbols_in
from ptmcalc.contract.machine import MachineKind, reference_methods_in, template_in
from ptmcalc.contract.topic import of_topics
from ptmcalc.machines.conveyor.assumptions import assumptions
from ptmcalc.machines.conveyor.curves.topic import CURVES
from ptmcalc.machines.conveyor.figures import FIGURES
from ptmcalc.machines.conveyor.holding.topic import ROLLBACK
from ptmcalc.machines.conveyor.inspection import inspect
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.relations import RELATIONS
from ptmcalc.machines.conveyor.running.topic import RUNNING
from ptmcalc.machines.conveyor.starting.topic import STARTING
from ptmcalc.machines.conveyor.stopping.topic import STOPPING
from ptmcalc.machines.conveyor.takeup.topic import TAKEUP
from ptmcalc.machines.conveyor.traction.topic import TRACTION
from ptmcalc.machines.conveyor.waves.topic import WAVES

TOPICS = (RUNNING, CURVES, TRACTION, TAKEUP, ROLLBACK, STOPPING, STARTING, WAVES)

KIND = MachineKind(
    name="conveyor",
    title="belt conveyor: slip, belt tension, sag and start",
    spec=Conveyor,
    figures=FIGURES,
    starting=template_in(__package__),
    symbols=symbols_in(__package__, TOPICS),
    examples=examples_in(__package__),
    assumed=assumptions,
    levers=("scenes[*].profile.time", "drive.drum.wrap", "drive.drum.friction", "brake.torque"),
    relations=RELATIONS,
    inspect=inspect,
    seconding=reference_methods_in(__package__),
    **of_topics(TOPICS),
)
