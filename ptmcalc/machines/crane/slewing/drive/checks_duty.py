"""Check of the crane group required by the duty."""

import math

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.check import Check, Sense, blames, needs, no_repair, only
from ptmcalc.machines.crane.slewing.machine.judging import SLEWING, OneCheck
from ptmcalc.machines.crane.slewing.machine.spec import SlewingCrane, SlewingScene


def _group(spec: SlewingCrane, scene: SlewingScene) -> Estimate:
    """Declared crane group.

    **Range** A1 to A8.
    **Error** none: a given class.
    **Source** ISO 4301-1.
    """
    group = spec.classes.group
    return Estimate.exact(math.inf if group is None else float(group[1]))


GROUP: OneCheck = only(lambda spec, scene: spec.classes.cycles is not None)(
    Check(
        code="CRN117",
        title="required crane group",
        question="Is the group required by cycles and load spectrum covered by the declared group?",
        failure="duty requires a higher crane group than declared",
        scenes=SLEWING,
        loads=("crane_group",),
        sense=Sense.AT_MOST,
        limit=_group,
        needs=needs(("class", "group")),
        blame=blames("class", "cycles"),
        repair=no_repair,
        what="The crane group required by the cycles and the load spectrum of the service life is at most the declared"
        " group.",
        why="A crane used beyond its group wears out before the end of its service life.",
        formula="A = U + Q - 2 <= declared",
        source="ISO 4301-1",
    )
)
