"""Mast: deflection, oscillation, settling, second-order effects."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.crane.stacking.machine.loads import OF_MOTION, OF_THE_COLUMN, parts_of
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.mast.beam import MAST_BEAM
from ptmcalc.machines.crane.stacking.mast.checks import CHECKS_OF_MAST
from ptmcalc.machines.crane.stacking.mast.effects import EFFECTS_OF_MAST
from ptmcalc.machines.crane.stacking.mast.handbook import MAST_HANDBOOK
from ptmcalc.machines.crane.stacking.mast.modal import MAST_MODAL, STANDING_MODAL
from ptmcalc.machines.crane.stacking.mast.two_mass_run import MAST_TWO_MASS

MAST: Topic[Stacker] = Topic(
    loads=(*OF_THE_COLUMN, *OF_MOTION),
    parts=lambda spec: parts_of((*OF_THE_COLUMN, *OF_MOTION), spec),
    effects=EFFECTS_OF_MAST,
    solvers=(MAST_HANDBOOK, MAST_BEAM, MAST_TWO_MASS, MAST_MODAL, STANDING_MODAL),
    checks=CHECKS_OF_MAST,
)
