"""Slewing crane: a load on a jib that turns about a vertical axis."""

from ptmcalc.contract.example import symbols_in
from ptmcalc.contract.machine import MachineKind, template_in, witnesses_in
from ptmcalc.machines.crane.slewing.assumptions import assumptions
from ptmcalc.machines.crane.slewing.checks import CHECKS_OF_DRIVE
from ptmcalc.machines.crane.slewing.checks_swing import CHECKS_OF_SWING
from ptmcalc.machines.crane.slewing.effects import EFFECTS
from ptmcalc.machines.crane.slewing.figures import FIGURES
from ptmcalc.machines.crane.slewing.inspection import inspect
from ptmcalc.machines.crane.slewing.loads import LOADS
from ptmcalc.machines.crane.slewing.relations import RELATIONS
from ptmcalc.machines.crane.slewing.solvers import SOLVERS
from ptmcalc.machines.crane.slewing.spec import SlewingCrane

SLEWING = MachineKind(
    name="crane",
    type="slewing",
    title="slewing crane: jib, slewing drive, brake, ring",
    spec=SlewingCrane,
    loads=LOADS,
    effects=EFFECTS,
    figures=FIGURES,
    solvers=SOLVERS,
    checks=(*CHECKS_OF_DRIVE, *CHECKS_OF_SWING),
    starting=template_in(__package__),
    symbols=symbols_in(__package__),
    assumed=assumptions,
    inspect=inspect,
    relations=RELATIONS,
    seconding=witnesses_in(__package__),
)
