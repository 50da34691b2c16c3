"""Checks of a snagged fork and of a fork pushed against the rack."""

import math
from collections.abc import Mapping

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, Sense, at, blames, needs, no_needs, only
from ptmcalc.contract.limits import fixed, key
from ptmcalc.machines.crane.stacking.fork.cases import catch_of, push_of
from ptmcalc.machines.crane.stacking.machine import model
from ptmcalc.machines.crane.stacking.machine.judging import OneCheck, given
from ptmcalc.machines.crane.stacking.machine.scenes import (
    ForkCaught,
    ForkPush,
    StackerScene,
)
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.spec.scene import Scene

CAUGHT: frozenset[type[Scene]] = frozenset({ForkCaught})
PUSHES: frozenset[type[Scene]] = frozenset({ForkPush})


def _hoist_key(spec: Stacker, scene: StackerScene) -> KeyPath:
    """What lets the force of a caught fork grow: the limiter, by its force or its reaction, or the motor."""
    assert isinstance(scene, ForkCaught)
    case = catch_of(spec, scene)
    if case.limit is not None:
        stiffness = 1 / (1 / case.rope + 1 / case.rack)
        late = stiffness * case.speed * case.limit.reaction > max(case.limit.force - case.weight, 0.0)
        return ("hoisting", "limiter", "reaction" if late else "force")
    drive = spec.hoisting.drive
    return (
        ("hoisting", "drive", "largest_force") if drive and drive.largest_force is not None else ("hoisting", "speed")
    )


def _of_rated(spec: Stacker, scene: StackerScene, loads: Mapping[str, Estimate]) -> Estimate:
    """Ratio of the rope force to the weight of carriage and rated load, for any load on the fork.

    **Range** any load on the fork; the weight is that of carriage and rated load.
    **Error** that of the force, relative to the weight.
    **Source** lecture notes Kramatorsk 2007, tables 11.1 and 11.2.
    """
    one = loads["rope_force_caught"]
    rated = model.weight(spec, scene.model_copy(update={"load": "full"}))
    return Estimate(one.value / rated, one.low / rated, one.high / rated, one.numerical / rated, one.model / rated)


FACTOR: OneCheck = only(lambda spec, scene: spec.checks.fork_caught_factor is not None)(
    Check(
        code="CRN284",
        hazard=True,
        title="rope force factor, fork snagged",
        question="Is the rope force of a snagged fork within the design factor of the hoist?",
        failure="snagged fork overloads the hoist",
        scenes=CAUGHT,
        loads=("rope_force_caught",),
        value=_of_rated,
        sense=Sense.AT_MOST,
        limit=key(
            "checks.fork_caught_factor",
            meaning="Design factor of the hoist: permissible ratio of rope force to weight",
            valid="any hoist",
            error="none: a limit of the file",
        ),
        needs=no_needs,
        blame=lambda spec, scene, loads: _hoist_key(spec, scene),
        repair=_hoist_key,
        what="The rope force of a hoist with a fork snagged in the rack is at most the design factor times the rated"
        " weight. The force is evaluated until the limiter has switched off the hoist. The elements of the hoist are"
        " designed for this factor.",
        why="A larger force overloads the hoist. This event is combination 5 of overhead stackers and combination 4 of"
        " rack stackers. With a strong motor, the force is several times the weight at any speed.",
        formula="F/Q_0,   m_1 x'' = P(x') - F,   F = Q + K (x - y)",
        source="energy and motion of drive and carriage; lecture notes Kramatorsk 2007, tables 11.1 and 11.2",
    ),
)


def _rope_limit(spec: Stacker, scene: StackerScene) -> Estimate:
    """Breaking force of all rope falls together.

    **Range** falls with equal shares of the load.
    **Error** none: a limit of the file.
    **Source** the manufacturer of the rope.
    """
    rope = spec.hoisting.rope
    return given(None if rope.breaking_force is None else rope.falls * rope.breaking_force)


ROPE: OneCheck = Check(
    code="CRN285",
    hazard=True,
    title="total rope force, fork snagged",
    question="Do the rope falls withstand a snagged fork?",
    failure="rope force of a snagged fork exceeds the breaking force",
    scenes=CAUGHT,
    loads=("rope_force_caught",),
    sense=Sense.AT_MOST,
    limit=_rope_limit,
    needs=needs(("hoisting", "rope", "breaking_force")),
    blame=blames("hoisting", "rope", "breaking_force"),
    repair=at("hoisting", "rope", "breaking_force"),
    what="The total breaking force of the carriage rope falls is at least the rope force of a fork that snags during"
    " hoisting.",
    why="A rope that breaks drops the carriage into its safety gear. A rope loaded close to its breaking force is"
    " damaged without visible signs.",
    formula="F <= n F_b",
    source="equilibrium of the carriage; the manufacturer of the rope",
)


RACK: OneCheck = only(
    lambda spec, scene: spec.rack.rating_vertical is not None and spec.rack.stiffness_vertical is not None
)(
    Check(
        code="CRN286",
        hazard=True,
        title="uplift on the rack, fork snagged",
        question="Does the rack beam withstand the uplift of a snagged fork?",
        failure="snagged fork lifts off or breaks the rack beam",
        scenes=CAUGHT,
        loads=("rack_force",),
        sense=Sense.AT_MOST,
        limit=key(
            "rack.rating_vertical",
            meaning="Permissible uplift of the fork on the rack",
            valid="any rack",
            error="none: a limit of the file",
            source="the manufacturer of the rack",
        ),
        needs=no_needs,
        blame=blames("rack", "rating_vertical"),
        repair=at("rack", "rating_vertical"),
        what="The uplift force of the snagged fork on the rack beam is at most the rating of the beam.",
        why="Beams are hooked in from above. A lifted beam brings down the shelf and the pallets on it.",
        formula="R = K_r y",
        source="motion of drive, rope and carriage; EN 15512 for the resistance of a beam",
    ),
)


PUSH: OneCheck = Check(
    code="CRN287",
    hazard=True,
    title="fork thrust on the rack",
    question="Does the rack withstand the thrust of the extending fork?",
    failure="fork thrust overloads the rack",
    scenes=PUSHES,
    loads=("fork_push_force",),
    sense=Sense.AT_MOST,
    limit=key(
        "rack.rating_push",
        meaning="Permissible thrust of the fork on the rack",
        valid="any rack",
        error="none: a limit of the file",
        source="the manufacturer of the rack",
    ),
    needs=needs(("rack", "rating_push")),
    blame=blames("rack", "rating_push"),
    repair=at("rack", "rating_push"),
    what="The thrust of the fork that extends against the rack is at most the rating of the rack across the aisle.",
    why="A protruding pallet stops the fork at full force and full speed.",
    formula="F = P + (P^2 + K m v^2)^(1/2),   with a slip clutch P_c + v (K m)^(1/2)",
    source="energy of the fork's drive; lecture notes Kramatorsk 2007, table 11.2, combination 3",
)


def _push_key(spec: Stacker, scene: StackerScene) -> KeyPath:
    """What lets the force of a pushing fork grow: its clutch or its motor, or its speed where that does by itself."""
    assert isinstance(scene, ForkPush)
    case = push_of(spec, scene)
    blow = case.speed * math.sqrt(case.series * case.mass)
    if spec.fork is not None and spec.fork.rating is not None and blow >= spec.fork.rating:
        return ("fork", "speed")
    return ("fork", "clutch_force" if case.clutch else "motor_force")


TELESCOPE: OneCheck = only(lambda spec, scene: spec.fork is not None and spec.fork.rating is not None)(
    Check(
        code="CRN288",
        hazard=True,
        title="telescopic fork thrust",
        question="Is the fork thrust within the rating of the telescopic fork?",
        failure="fork thrust overloads the telescopic fork",
        scenes=PUSHES,
        loads=("fork_push_force",),
        sense=Sense.AT_MOST,
        limit=key(
            "fork.rating",
            meaning="Permissible thrust of the telescopic fork",
            valid="any fork",
            error="none: a limit of the file",
            source="the manufacturer of the fork",
        ),
        needs=no_needs,
        blame=lambda spec, scene, loads: _push_key(spec, scene),
        repair=_push_key,
        what="The thrust of the fork against the rack is at most the rating of the telescopic fork. The slip clutch or"
        " the motor limits the thrust.",
        why="A slip clutch with too high a setting gives no protection. Chains and racks of telescopic forks break"
        " first.",
        formula="F <= F_max",
        source="energy of the fork drive; the manufacturer of the fork",
    ),
)


LIMITER: OneCheck = only(lambda spec, scene: spec.hoisting.limiter is not None)(
    Check(
        code="CRN289",
        title="load limiter trip reserve",
        question="Is the limiter set above the force of normal hoisting?",
        failure="limiter trips during normal hoisting",
        scenes=CAUGHT,
        loads=("limiter_reserve",),
        sense=Sense.AT_LEAST,
        limit=fixed(
            1.0,
            meaning="1: the limiter trips above the force of normal hoisting",
            valid="any limiter",
            error="none: statics",
            source="equilibrium of the carriage with its inertia",
        ),
        needs=no_needs,
        blame=blames("hoisting", "limiter", "force"),
        repair=at("hoisting", "limiter", "force"),
        what="The trip force of the limiter is at least the force of carriage and load during the start of the hoist.",
        why="A limiter that trips during normal hoisting is soon disabled by the operators. It then does not detect a"
        " snagged fork.",
        formula="F_l/(Q (1 + a/g)) >= 1",
        source="equilibrium of the carriage with its inertia",
    ),
)

CHECKS_OF_THE_FORK: tuple[AnyCheck, ...] = (FACTOR, ROPE, RACK, PUSH, TELESCOPE, LIMITER)
