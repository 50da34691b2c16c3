"""Checks of the take-up over all scenes: travel, and distance of the weight from its stops."""

from collections.abc import Mapping

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import Check, LimitState, Sense, no_needs, only
from ptmcalc.contract.limits import fixed, key
from ptmcalc.machines.conveyor.machine.loads import TAKEUP_CLEARANCES, TAKEUP_TOTAL
from ptmcalc.machines.conveyor.machine.scenes import ANY_MOTION, IN_MOTION, ConveyorScene, Run
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.takeup.loads import LOWER, UPPER

Loads = Mapping[str, Estimate]
_STROKE: KeyPath = ("takeup", "stroke")


TRAVEL_BUDGET: Check[Conveyor, ConveyorScene] = only(
    lambda spec, scene: spec.takeup.budgeted and (isinstance(scene, Run) or spec.takeup.type == "gravity")
)(
    Check(
        code="CNV140",
        title="required take-up travel, all shares",
        question="Is the take-up travel enough for elongation, movement, temperature and a new splice?",
        failure="take-up travel is too short",
        scenes=ANY_MOTION,
        loads=(TAKEUP_TOTAL,),
        sense=Sense.AT_MOST,
        limit=key(
            "takeup.stroke",
            meaning="Take-up travel given in the file",
            valid="any take-up with a given stroke",
            error="none",
            source="the manufacturer's data",
        ),
        needs=no_needs,
        blame=lambda spec, scene, loads: _STROKE,
        repair=lambda spec, scene: _STROKE,
        what="The sum of all shares of the take-up travel is at most the stroke: elastic elongation between the empty"
        " belt at rest and the running belt, largest movement of the scene, thermal and permanent elongation,"
        " installation with the reserve for a splice. A fixed take-up has no elastic share and no movement.",
        why="A weight at its stop no longer keeps the tension. A belt without splice reserve must be lengthened.",
        formula="s_e + s_t + s_p + s_i + s_m <= stroke",
        source="DIN 22101, take-up travel; manuals of belt manufacturers",
    )
)


def _nearest(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Estimate:
    """Distance from the nearer stop.

        min(x_0 + s_min, stroke - x_0 - s_max)

    **Range** a gravity take-up with a given stroke.
    **Error** that of the movement, by the simulation.
    **Source** geometry.
    """
    one, other = (loads[name] for name in TAKEUP_CLEARANCES)
    return Estimate(
        min(one.value, other.value),
        min(one.low, other.low),
        min(one.high, other.high),
        max(one.numerical, other.numerical),
        max(one.model, other.model),
    )


def _blame(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> KeyPath:
    """The stroke, or the position of a weight that rises to its upper stop although there is room below."""
    if UPPER not in loads:
        return _STROKE
    rises = loads[UPPER].value < 0 <= loads[UPPER].value + loads[LOWER].value
    return ("takeup", "position") if rises else _STROKE


STOPS: Check[Conveyor, ConveyorScene] = only(
    lambda spec, scene: spec.takeup.budgeted and spec.takeup.type == "gravity"
)(
    Check(
        code="CNV141",
        hazard=True,
        title="take-up weight distance from its stops",
        question="Does the take-up weight stay clear of its stops while the belt moves?",
        failure="take-up weight reaches its stop",
        limit_state=LimitState("take-up weight is at its stop: the take-up no longer keeps the tension", 0.0),
        scenes=frozenset(IN_MOTION),
        loads=TAKEUP_CLEARANCES,
        sense=Sense.AT_LEAST,
        limit=fixed(
            0.0,
            meaning="0: the weight just reaches its stop",
            valid="a gravity take-up with a given stroke",
            source="geometry",
        ),
        needs=no_needs,
        value=_nearest,
        blame=_blame,
        repair=lambda spec, scene: _STROKE,
        repairs_blame=True,
        what="The take-up weight stays within its travel from its position at the beginning of the scene. The belt"
        " loads of a scene in which it may reach a stop have no bound, because the simulation ends there.",
        why="A weight at its upper stop is a fixed take-up: the tension of a start or a stop rises without limit by it."
        " A weight on its lower stop leaves the belt slack.",
        formula="min(x_0 + s_min, stroke - x_0 - s_max) >= 0",
        source="geometry of the take-up; movement by `numerics.belt`",
    )
)
