"""Check of the slewing ring against its limit curve."""

from ptmcalc.contract.check import Check, Sense, blames, no_repair, only
from ptmcalc.contract.limits import fixed
from ptmcalc.machines.crane.slewing.machine.judging import SLEWING, OneCheck

RING: OneCheck = only(lambda spec, scene: spec.ring.curve is not None)(
    Check(
        code="CRN115",
        hazard=True,
        title="slewing ring utilisation",
        question="Is the tilting moment within the slewing ring limit curve at this axial load?",
        failure="tilting moment exceeds the limit curve of the slewing ring",
        scenes=SLEWING,
        loads=("ring_utilisation",),
        sense=Sense.AT_MOST,
        limit=fixed(
            1.0,
            meaning="Permissible moment of the limiting load curve of the catalogue at this axial force",
            valid="linear between the points of the curve; zero beyond the last point",
            error="none: a given curve",
            source="the manufacturer's catalogue",
        ),
        needs=lambda spec, scene: (
            (("load",),) if spec.inertia is None else (("load",), ("ring", "mass_above"), ("ring", "unbalance"))
        ),
        blame=blames("ring", "curve"),
        repair=no_repair,
        what="The tilting moment is within the limit curve of the slewing ring at the same axial force. It is verified"
        " with the load times its factor and with an empty hook.",
        why="Beyond the limit curve, the raceways of the ring are indented. The bolts fatigue.",
        formula="M(1.25 Q), M(0) <= M_ring(F_a)",
        source="catalogues of slewing rings: limiting load curves",
    )
)
