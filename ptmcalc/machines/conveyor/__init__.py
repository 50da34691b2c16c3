"""Belt conveyor: running, starting, stopping, traction, take-up and waves of the belt."""

from itertools import chain

from ptmcalc.contract.example import examples_in, symbols_in
from ptmcalc.contract.machine import MachineKind, template_in, witnesses_in
from ptmcalc.machines.conveyor.assumptions import assumptions
from ptmcalc.machines.conveyor.checks import CHECKS
from ptmcalc.machines.conveyor.effects import EFFECTS
from ptmcalc.machines.conveyor.figures import FIGURES
from ptmcalc.machines.conveyor.inspection import inspect
from ptmcalc.machines.conveyor.loads import LOADS, parts
from ptmcalc.machines.conveyor.relations import RELATIONS
from ptmcalc.machines.conveyor.running.loads import STATIC_LOADS, static_parts
from ptmcalc.machines.conveyor.solvers import SOLVERS
from ptmcalc.machines.conveyor.spec import Conveyor
from ptmcalc.machines.conveyor.starting.loads import START_LOADS, start_parts

KIND = MachineKind(
    name="conveyor",
    title="belt conveyor: slip, belt tension, sag and start",
    spec=Conveyor,
    loads=(*LOADS, *STATIC_LOADS, *START_LOADS),
    effects=EFFECTS,
    figures=FIGURES,
    solvers=SOLVERS,
    checks=CHECKS,
    starting=template_in(__package__),
    symbols=symbols_in(__package__),
    examples=examples_in(__package__),
    assumed=assumptions,
    relations=RELATIONS,
    parts=lambda spec: chain(parts(spec), static_parts(spec), start_parts(spec)),
    inspect=inspect,
    seconding=witnesses_in(__package__),
)
