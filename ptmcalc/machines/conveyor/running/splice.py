"""Strength of the belt with its splices by DIN 22101:2011, next to the safety factors of the edition of 1982."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import replace

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, Sense
from ptmcalc.contract.limits import fixed
from ptmcalc.laws import belt_splice
from ptmcalc.machines.conveyor.machine.keys.belt import Splice
from ptmcalc.machines.conveyor.machine.model import belt_stiffness, breaking_force
from ptmcalc.machines.conveyor.machine.resistances import filled
from ptmcalc.machines.conveyor.machine.scenes import ANY_MOTION, ConveyorScene, Run
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.running.belt_safety import strength_key
from ptmcalc.machines.conveyor.running.loads import bent, strains
from ptmcalc.numerics.lanes import value

Loads = Mapping[str, Estimate]
Checks = Iterable[AnyCheck]

_WIDTH: KeyPath = ("belt", "width")
_TROUGH: KeyPath = ("idlers", "carry", "trough")


def _value(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Estimate:
    """Reserve of the belt with its splice; smaller for a larger tension.

    **Range** any state of the belt.
    **Error** that of the tension per width.
    **Source** `laws.belt_splice.splice_reserve`.
    """
    tension, splice = _tension_per_width(spec, scene, loads), spec.belt.splice
    assert splice is not None
    reserve, least, most = (_reserve(spec, splice, one) for one in (tension.value, tension.high, tension.low))
    slope = reserve / tension.value if 0.0 < tension.value < math.inf else 0.0
    return Estimate(reserve, least, most, tension.numerical * slope, tension.model * slope)


def _reserve(spec: Conveyor, splice: Splice, tension: float) -> float:
    strength = filled(breaking_force(spec)) / filled(spec.belt.width)
    return value(
        belt_splice.splice_reserve,
        strength,
        filled(splice.reference_strength),
        tension,
        belt_splice.SPLICE_CONDITIONS[splice.conditions],
        belt_splice.BELT_LIFE[splice.life],
    )


def _tension_per_width(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Estimate:
    """Largest tension per width, edge addition included [N/m].

    In a start or stop the tension at each transition and curve is not a load. It is at most the maximum tension of the
    belt, so the upper limit adds the largest edge addition to that. The lower limit adds the edge addition of the head
    transition to the tension entering a single drive pulley.
    """
    if isinstance(scene, Run):
        return loads["belt_tension_width_max"]
    most, width = loads["tension_max"], filled(spec.belt.width)
    extra = _edge_additions(spec)
    largest = max(extra.values(), default=0.0)
    least = most.low
    if len(spec.all_drives) == 1:
        least = max(least, loads["tension_run_on_max"].low + extra.get("head", 0.0))
    high = most.high + largest
    nominal = min(max(most.value + largest, least), high)
    return Estimate(nominal / width, least / width, high / width, most.numerical / width, most.model / width)


def _edge_additions(spec: Conveyor) -> dict[str, float]:
    """Edge addition of every transition and curve by name, as a tension of the whole belt [N]."""
    if spec.idlers.carry.trough is None or spec.belt.width is None:
        return {}
    return {name: belt_stiffness(spec) * strains(spec, place, name)[0] for name, place in bent(spec).items()}


def _needs(spec: Conveyor) -> tuple[KeyPath, ...]:
    """Width and strength of the belt, and the trough where a transition or a curve is given."""
    strength: KeyPath = ("belt", "breaking_force" if spec.belt.breaking_force is not None else "strength")
    return (_WIDTH, strength, *((_TROUGH,) if bent(spec) else ()))


def _checks(spec: Conveyor, scene: ConveyorScene) -> Checks:
    """Where the file describes the splice."""
    if spec.belt.splice is None:
        return
    steady = ("belt_safety_min", "belt_tension_width_max")  # the first load states the quantity of the value
    yield replace(SPLICE, loads=steady if isinstance(scene, Run) else SPLICE.loads, each=None)


SPLICE: Check[Conveyor, ConveyorScene] = Check(
    code="CNV130",
    hazard=True,
    title="belt strength reserve with splice, DIN 22101:2011",
    question="Is the belt strong enough for the fatigue of its splices?",
    failure="belt is too weak for the fatigue of its splices",
    scenes=ANY_MOTION,
    loads=("belt_safety_min", "tension_max", "tension_run_on_max"),
    sense=Sense.AT_LEAST,
    limit=fixed(
        1.0,
        meaning="1: the safety is in the factors S_0 and S_1 of the value",
        valid="steady running. Starts and stops are verified with the same factors, on the safe side: a higher tension"
        " is permissible for a short time only where the manufacturer states it",
        source="DIN 22101:2011 as quoted by belt manufacturers; to be compared with the edition in force",
    ),
    value=_value,
    needs=lambda spec, scene: _needs(spec),
    blame=lambda spec, scene, loads: strength_key(spec, scene),
    repair=strength_key,
    each=_checks,
    what="The rated strength of the belt, times the relative reference fatigue strength of the splice, is at least the"
    " largest tension per width times S_0 and S_1. The tension per width includes the edge addition in transitions and"
    " curves. CNV102 verifies the safety factors of DIN 22101:1982.",
    why="The splice is the weakest part of a belt. Its fatigue limits the permissible tension.",
    formula="k_N k_t,rel/(k_max S_0 S_1) >= 1,   k_max = max(S/W + (EA/W) eps)\n"
    "S_0 = 1.0 good, 1.1 normal, 1.2 poor splicing conditions;   S_1 = 1.5 short, 1.7 normal, 1.9 long life",
    source="DIN 22101:2011 as quoted by belt manufacturers; k_t,rel by DIN 22110-3",
)
