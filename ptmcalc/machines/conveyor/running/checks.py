"""Checks of the belt: strength, sag, slack, take-up travel."""

import math
from collections.abc import Iterable, Mapping

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, LimitState, Sense, at, blames, needs, no_needs, only
from ptmcalc.contract.limits import fixed, key
from ptmcalc.machines.conveyor.machine.governing_keys import TENSION, blame_tension, takeup_tension
from ptmcalc.machines.conveyor.machine.scenes import ANY_MOTION, IN_MOTION, ConveyorScene, Jam, Run
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.running.belt_safety import safety_limit, safety_needs, strength_key
from ptmcalc.machines.conveyor.running.limits import given
from ptmcalc.machines.conveyor.running.loads import limited_strands

Loads = Mapping[str, Estimate]
Checks = Iterable[AnyCheck]

STRENGTH: Check[Conveyor, ConveyorScene] = Check(
    code="CNV102",
    hazard=True,
    title="belt safety factor",
    question="Is the belt breaking force high enough for the largest belt tension?",
    failure="belt is overloaded",
    limit_state=LimitState("belt breaks", 1),
    scenes=ANY_MOTION,
    loads=("belt_safety_min",),
    sense=Sense.AT_LEAST,
    limit=safety_limit,
    needs=safety_needs,
    blame=lambda spec, scene, loads: strength_key(spec, scene),
    repair=strength_key,
    what="The breaking force of the belt is at least the safety factor times the maximum tension of any section.",
    why="A broken belt runs off the conveyor. Splices fail first, by fatigue.",
    formula="breaking force / S_max >= safety",
    source="DIN 22101:1982-02 as quoted by belt manufacturers: 8.0/5.4 textile, 6.7/4.8 steel cord (running/starting)",
)


_PITCHES = needs(("idlers", "carry", "pitch"), ("idlers", "return", "pitch"))

SAG: Check[Conveyor, Run] = Check(
    code="CNV103",
    title="belt sag between idlers, steady running",
    question="Is the belt sag ratio within its limit in steady running?",
    failure="belt sags too much between the idlers",
    scenes=frozenset({Run}),
    loads=("sag_relative_max",),
    sense=Sense.AT_MOST,
    limit=key(
        "checks.sag",
        meaning="Permissible sag ratio h/a of the file, 1 % by default",
        valid="steady running; larger values are permissible for a short time",
        source="DIN 22101: at most 1 % in steady running",
    ),
    needs=_PITCHES,
    blame=blame_tension,
    repair=takeup_tension,
    what="In steady running, the sag ratio of the belt between any two idlers is at most the limit.",
    why="Excessive sag spills the load, flexes the load at every idler and increases the power demand.",
    formula="w l/(8 S_min) <= limit",
    source="DIN 22101: at most 1 % in steady running",
)


def _strand_limit(spec: Conveyor, scene: Run) -> Estimate:
    """Permissible sag ratio h/a of the strand, of the file.

    **Range** steady running.
    **Error** none: a chosen limit.
    **Source** the file; usual: 0.5 to 1.5 % of the loaded carrying strand, 2 % of the return strand.
    """
    given = [limit for limit in (spec.checks.sag_carry, spec.checks.sag_return) if limit is not None]
    return Estimate.exact(min(given, default=math.inf))


def _strand_checks(spec: Conveyor, scene: Run) -> Checks:
    """One for each strand whose limit the file gives."""
    for strand in limited_strands(spec):
        limit: float = spec.value_at(("checks", f"sag_{strand}"))
        pitch: KeyPath = ("idlers", strand, "pitch")
        yield STRAND_SAG.of(strand, given(limit), TENSION, (pitch,), TENSION)


STRAND_SAG: Check[Conveyor, Run] = Check(
    code="CNV131",
    title="belt sag of one strand, steady running",
    question="Is the sag ratio of the carrying or return strand within its own limit in steady running?",
    failure="strand sags too much between the idlers",
    scenes=frozenset({Run}),
    loads=("sag_strand_max",),
    sense=Sense.AT_MOST,
    limit=_strand_limit,
    needs=no_needs,
    blame=blame_tension,
    repair=takeup_tension,
    each=_strand_checks,
    what="In steady running, the sag ratio of the strand between any two idlers is at most the limit of that strand."
    " CNV103 compares both strands with one limit.",
    why="The loaded carrying strand spills material at a sag that the empty return strand withstands.",
    formula="w l/(8 S_min) <= limit of the strand",
    source="DIN 22101: at most 1 % in steady running; limits of the file",
)


TRANSIENT_SAG: Check[Conveyor, ConveyorScene] = only(lambda spec, scene: spec.checks.sag_transient is not None)(
    Check(
        code="CNV132",
        title="belt sag between idlers, start or stop",
        question="Is the belt sag ratio within its limit during a start or stop?",
        failure="belt sags too much between the idlers",
        scenes=IN_MOTION - {Jam},
        loads=("sag_relative_max",),
        sense=Sense.AT_MOST,
        limit=key(
            "checks.sag_transient",
            meaning="Permissible sag ratio h/a in a start or stop, of the file",
            valid="starts and stops; larger than in steady running for a short time",
            source="the file; 3 % is usual",
        ),
        needs=_PITCHES,
        blame=blame_tension,
        repair=takeup_tension,
        what="During a start or stop, the sag ratio of the belt between any two idlers is at most the limit.",
        why="A relief wave lets the belt sag and spills the load.",
        formula="w l/(8 S_min) <= limit",
        source="DIN 22101 permits a larger sag in transient states; limit of the file",
    )
)


SLACK: Check[Conveyor, ConveyorScene] = Check(
    code="CNV105",
    hazard=True,
    title="belt tension above slack limit",
    question="Does every belt section stay above the slack limit (10 % sag by default)?",
    failure="belt tension falls below the slack limit",
    scenes=ANY_MOTION,
    loads=("slack_margin_min",),
    sense=Sense.AT_LEAST,
    limit=fixed(
        0.0,
        meaning="0: the tension is at least that of the slack limit",
        valid="with idler pitches given: 10 % sag by default, the end of the range of the parabola; otherwise zero"
        " tension",
        error="none: a chosen limit",
        source="validity of the shallow parabola (`laws.sag.sag_ratio`), an engineering choice",
    ),
    needs=no_needs,
    blame=blame_tension,
    repair=takeup_tension,
    what="At every moment, the tension of every belt section is at least the slack limit.",
    why="A slack belt lifts off its idlers, folds and runs off. An impact loads it when it becomes taut again.",
    formula="S_min - w l/(8 h_slack) >= 0 on either strand   (h_slack 10 %; without idler pitches S_min >= 0)",
    source="shallow parabola; slack as the end of the linear belt, lecture notes Kramatorsk 2007",
)


STROKE: Check[Conveyor, Run] = only(lambda spec, scene: spec.takeup.stroke is not None)(
    Check(
        code="CNV110",
        title="required take-up travel",
        question="Is the take-up travel enough for elastic and permanent belt elongation?",
        failure="take-up travel is too short",
        scenes=frozenset({Run}),
        loads=("takeup_travel",),
        sense=Sense.AT_MOST,
        limit=key(
            "takeup.stroke",
            meaning="Take-up travel given in the file",
            valid="any take-up with a given stroke",
            error="none",
            source="the manufacturer's data",
        ),
        needs=no_needs,
        blame=blames("takeup", "stroke"),
        repair=at("takeup", "stroke"),
        what="The required take-up travel is at most the stroke. It starts from the new belt at standstill, closed with"
        " the take-up tension S_0 all round. It ends at the old belt in steady running. A take-up weight follows the"
        " elastic and the permanent elongation. A take-up screw moves for the permanent elongation only, because its"
        " belt runs with the set mean tension S_0.",
        why="A take-up at the end of its stroke lets the tension fall, and the belt slips.",
        formula="L_loop ((S_mean - S_0)/EA + permanent)/2 <= stroke",
        source="DIN 22101, elongation of the belt",
    )
)
