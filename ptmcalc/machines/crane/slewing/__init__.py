"""Slewing crane: a load on a jib that turns about a vertical axis."""

from ptmcalc.contract.example import symbols_in
from ptmcalc.contract.machine import MachineKind, reference_methods_in, template_in
from ptmcalc.contract.topic import of_topics
from ptmcalc.machines.crane.slewing.assumptions import assumptions
from ptmcalc.machines.crane.slewing.drive.topic import DRIVE
from ptmcalc.machines.crane.slewing.figures import FIGURES
from ptmcalc.machines.crane.slewing.inspection import inspect
from ptmcalc.machines.crane.slewing.machine.spec import SlewingCrane
from ptmcalc.machines.crane.slewing.relations import RELATIONS
from ptmcalc.machines.crane.slewing.ring.topic import SLEWING_RING
from ptmcalc.machines.crane.slewing.rotation.topic import ROTATION
from ptmcalc.machines.crane.slewing.sway.topic import SWAY

TOPICS = (ROTATION, DRIVE, SWAY, SLEWING_RING)

SLEWING = MachineKind(
    name="crane",
    type="slewing",
    title="slewing crane: jib, slewing drive, brake, ring",
    spec=SlewingCrane,
    figures=FIGURES,
    starting=template_in(__package__),
    symbols=symbols_in(__package__, TOPICS),
    assumed=assumptions,
    inspect=inspect,
    relations=RELATIONS,
    seconding=reference_methods_in(__package__),
    **of_topics(TOPICS),
)
