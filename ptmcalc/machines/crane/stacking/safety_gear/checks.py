"""Checks of the safety gear."""

from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, Sense, at, blames, no_needs, only
from ptmcalc.contract.limits import fixed, key
from ptmcalc.machines.crane.stacking.machine.judging import OneCheck
from ptmcalc.machines.crane.stacking.machine.scenes import (
    SafetyGearScene,
    StackerScene,
)
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.spec.scene import Scene

FALLS: frozenset[type[Scene]] = frozenset({SafetyGearScene})


def _gear_key(spec: Stacker, scene: StackerScene) -> KeyPath:
    """What says how hard the gear holds."""
    gear = spec.safety_gear
    return ("safety_gear", "stiffness" if gear is not None and gear.type == "instantaneous" else "force")


GEAR_STROKE: OneCheck = Check(
    code="CRN290",
    hazard=True,
    title="safety gear stopping distance",
    question="Does the safety gear stop the carriage within its stroke?",
    failure="safety gear reaches the end of its stroke",
    scenes=FALLS,
    loads=("safety_gear_distance",),
    sense=Sense.AT_MOST,
    limit=key(
        "safety_gear.stroke",
        meaning="Stroke of the safety gear",
        valid="any gear",
        error="none: a limit of the file",
        source="the manufacturer of the gear",
    ),
    needs=no_needs,
    blame=blames("safety_gear", "stroke"),
    repair=at("safety_gear", "stroke"),
    what="The safety gear stops the carriage within its stroke. The initial speed is the speed at the end of the"
    " reaction time of the governor.",
    why="At the end of its stroke, a progressive gear acts as an instantaneous gear. Its force is then ten times the"
    " weight.",
    formula="s = v_c^2/(2 (F_c/M - g)) <= s_max,   v_c = k v + g t_r",
    source="free fall and energy; EN 528, EN 81-20",
)


HOLDS: OneCheck = Check(
    code="CRN291",
    hazard=True,
    title="safety gear holding reserve",
    question="Does the braking force of the safety gear exceed the suspended weight?",
    failure="safety gear does not hold the carriage",
    scenes=FALLS,
    loads=("safety_gear_factor",),
    sense=Sense.AT_LEAST,
    limit=fixed(
        1.0,
        meaning="1: the gear force equals the weight",
        valid="any gear",
        error="none: equilibrium",
        source="equilibrium",
    ),
    needs=no_needs,
    blame=lambda spec, scene, loads: _gear_key(spec, scene),
    repair=_gear_key,
    what="The braking force of the safety gear is at least the weight of carriage, cab and load.",
    why="A gear with a braking force below the weight only slows the fall.",
    formula="F_c/(M g) >= 1",
    source="equilibrium",
)


DECELERATION: OneCheck = only(lambda spec, scene: spec.checks.catch_deceleration is not None)(
    Check(
        code="CRN292",
        hazard=True,
        title="safety gear deceleration",
        question="Is the deceleration of the carriage in the safety gear within its limit?",
        failure="deceleration in the safety gear is too high",
        scenes=FALLS,
        loads=("safety_gear_deceleration",),
        sense=Sense.AT_MOST,
        limit=key(
            "checks.catch_deceleration",
            meaning="Permissible deceleration of the carriage",
            valid="any carriage; 9.81 m/s^2 is usual for a cab with a driver",
            error="none: a limit of the file",
            source="the file; EN 81-20: a mean of 0.2 to 1 g for progressive gears",
        ),
        needs=no_needs,
        blame=lambda spec, scene, loads: _gear_key(spec, scene),
        repair=_gear_key,
        what="The deceleration of the carriage is at most the limit for driver, load and mast.",
        why="An instantaneous gear decelerates the carriage with several g. The stop may break the parts that it saves"
        " from the fall.",
        formula="a = F/M - g",
        source="Newton's law; EN 528, EN 81-20",
    ),
)

CHECKS_OF_THE_SAFETY_GEAR: tuple[AnyCheck, ...] = (GEAR_STROKE, HOLDS, DECELERATION)
