"""Check of the wheel load at steps and gaps of the rail."""

from ptmcalc.contract.check import Check, Sense, at, no_needs
from ptmcalc.contract.limits import fixed
from ptmcalc.machines.crane.travelling.machine.judging import STEPS, OneCheck

CONTACT: OneCheck = Check(
    code="CRN173",
    hazard=True,
    title="wheel load ratio at rail steps and gaps",
    question="Do the wheels keep contact on the largest step and gap of the rail?",
    failure="wheel leaves the rail at a step or gap",
    scenes=STEPS,
    loads=("rail_contact",),
    sense=Sense.AT_LEAST,
    limit=fixed(
        0.0,
        meaning="0: the wheel stays on its rail",
        valid="any wheel",
        error="none: a wheel transmits no tension",
        source="equilibrium",
    ),
    needs=no_needs,
    blame=lambda spec, scene, loads: ("rail", "step" if spec.rail.step else "gap"),
    repair=at("speed"),
    what="The wheel load stays at or above zero at the largest step and gap of the rail, so that the wheels keep"
    " contact.",
    why="The impact of a wheel that lands on the rail is not covered by any factor.",
    formula="1 - (pi/2)^2 v^2/(g r) u_min >= 0",
    source="one vertical mode over a cosine step; `laws.rail`",
)
