"""Checks of buffers, fork, rail and safety gear."""

import math
from collections.abc import Callable, Mapping

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, Sense, at, blames, no_needs, only
from ptmcalc.machines.crane.stacking import model
from ptmcalc.machines.crane.stacking.events import catch_of, push_of, roll_of
from ptmcalc.machines.crane.stacking.judging import OneCheck, given
from ptmcalc.machines.crane.stacking.rack import RackStacker
from ptmcalc.machines.crane.stacking.rail.rolling import wave_share
from ptmcalc.machines.crane.stacking.scenes import (
    BufferScene,
    ForkCaught,
    ForkPush,
    RailScene,
    SafetyGearScene,
    StackerScene,
)
from ptmcalc.machines.crane.stacking.spec import MECHANISMS, Stacker
from ptmcalc.spec.scene import Scene

Path = Callable[[Stacker, StackerScene], KeyPath]

HITS: frozenset[type[Scene]] = frozenset({BufferScene})
CAUGHT: frozenset[type[Scene]] = frozenset({ForkCaught})
PUSHES: frozenset[type[Scene]] = frozenset({ForkPush})
ROLLS: frozenset[type[Scene]] = frozenset({RailScene})
FALLS: frozenset[type[Scene]] = frozenset({SafetyGearScene})


# -- buffers --------------------------------------------------------------------------------------------------------


def _of_buffers(*rest: str) -> Path:
    """A key of the buffers of what travels."""
    return lambda spec, scene: (MECHANISMS[model.mechanism(spec, scene)], "buffers", *rest)


def _stroke_limit(spec: Stacker, scene: StackerScene) -> Estimate:
    """Way the buffers can be pressed in.

    **Range** any buffer.
    **Error** none: a limit of the file.
    **Source** the maker of the buffer.
    """
    buffers = model.travel(spec, scene).buffers
    return given(buffers.stroke if buffers is not None else None)


STROKE: OneCheck = Check(
    code="CRN281",
    title="stacker buffer stroke",
    question="Do the buffers stop the machine within their stroke?",
    failure="buffer bottoms out",
    scenes=HITS,
    loads=("buffer_stroke",),
    sense=Sense.AT_MOST,
    limit=_stroke_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: _of_buffers("stroke")(spec, scene),
    repair=_of_buffers("stroke"),
    what="The buffers stop the crane with its guided load within their stroke. Otherwise, the report states the"
    " remaining speed.",
    why="The end stop, the mast and persons in the cab absorb the remaining energy within a few millimetres.",
    formula="E(u) = m v^2/2 + P u,   u <= s",
    source="energy; EN 13001-2, FEM 9.311",
)


def _force_limit(spec: Stacker, scene: StackerScene) -> Estimate:
    """Largest force of a buffer, or of what it stands on.

    **Range** any buffer.
    **Error** none: a limit of the file.
    **Source** the maker of the buffer, the end stop's calculation.
    """
    buffers = model.travel(spec, scene).buffers
    return given(buffers.rating if buffers is not None else None)


FORCE: OneCheck = Check(
    code="CRN282",
    title="stacker buffer force",
    question="Is the buffer force within the rating of buffer and end stop?",
    failure="buffer force exceeds its rating",
    scenes=HITS,
    loads=("buffer_force",),
    sense=Sense.AT_MOST,
    limit=_force_limit,
    needs=lambda spec, scene: (_of_buffers("rating")(spec, scene),),
    blame=lambda spec, scene, loads: _of_buffers("rating")(spec, scene),
    repair=_of_buffers("rating"),
    what="The force of each buffer is at most its rating or the rating of the end stop.",
    why="A buffer that is too stiff breaks the parts it protects. It makes the mast oscillate.",
    formula="F = (P + (P^2 + c m v^2)^(1/2))/n <= F_max, by the type of buffer",
    source="energy; EN 13001-2, FEM 9.311",
)


def _largest_speed(spec: Stacker, scene: StackerScene) -> float | None:
    limits = _speed_limits(spec, scene)
    return min(limits.values()) if limits else None


def _speed_limits(spec: Stacker, scene: StackerScene) -> dict[KeyPath, float]:
    """What the file allows, and what the maker of the buffers: neither sets the other aside."""
    buffers = model.travel(spec, scene).buffers
    own: dict[KeyPath, float | None] = {("checks", "collision_speed"): spec.checks.collision_speed}
    own[_of_buffers("largest_speed")(spec, scene)] = buffers.largest_speed if buffers is not None else None
    return {key: speed for key, speed in own.items() if speed is not None}


def _speed_limit(spec: Stacker, scene: StackerScene) -> Estimate:
    """Largest speed at which the buffers may be hit.

    **Range** any buffer.
    **Error** none: a limit of the file or of the buffer's maker.
    **Source** the file.
    """
    return given(_largest_speed(spec, scene))


def _speed_key(spec: Stacker, scene: StackerScene) -> KeyPath:
    limits = _speed_limits(spec, scene)
    return min(limits, key=limits.__getitem__)


SPEED: OneCheck = only(lambda spec, scene: _largest_speed(spec, scene) is not None)(
    Check(
        code="CRN283",
        title="stacker buffer impact speed",
        question="Is the impact speed within the limit of buffer and plant rules?",
        failure="buffer impact speed is too high",
        scenes=HITS,
        loads=("collision_speed",),
        sense=Sense.AT_MOST,
        limit=_speed_limit,
        needs=no_needs,
        blame=lambda spec, scene, loads: _speed_key(spec, scene),
        repair=lambda spec, scene: (MECHANISMS[model.mechanism(spec, scene)], "speed"),
        what="The impact speed of the crane is at most the limit of the buffers or of the plant rules.",
        why="The stiffness of rubber and cellular buffers increases with the compression speed. Load and driver are"
        " not restrained.",
        formula="share of v <= v_max",
        source="the maker of the buffer",
    ),
)

# -- fork -----------------------------------------------------------------------------------------------------------


def _factor_limit(spec: Stacker, scene: StackerScene) -> Estimate:
    """Largest force of the ropes over the weight with which the hoist has been calculated.

    **Range** any hoist.
    **Error** none: a limit of the file.
    **Source** the file.
    """
    return given(spec.checks.fork_caught_factor)


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
    """Force of the ropes over the weight with the rated load, whatever is on the fork: the hoist is built for that.

    **Range** any load on the fork; the weight is that of carriage and rated load.
    **Error** that of the force, over the weight.
    **Source** lecture notes Kramatorsk 2007, tables 11.1 and 11.2.
    """
    one = loads["rope_force_caught"]
    rated = model.weight(spec, scene.model_copy(update={"load": "full"}))
    return Estimate(one.value / rated, one.low / rated, one.high / rated, one.numerical / rated, one.model / rated)


FACTOR: OneCheck = only(lambda spec, scene: spec.checks.fork_caught_factor is not None)(
    Check(
        code="CRN284",
        title="rope force factor, fork snagged",
        question="Is the rope force of a snagged fork within the design factor of the hoist?",
        failure="snagged fork overloads the hoist",
        scenes=CAUGHT,
        loads=("rope_force_caught",),
        value=_of_rated,
        sense=Sense.AT_MOST,
        limit=_factor_limit,
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
    """Breaking force of all falls together.

    **Range** falls that share evenly.
    **Error** none: a limit of the file.
    **Source** the maker of the rope.
    """
    rope = spec.hoisting.rope
    return given(None if rope.breaking_force is None else rope.falls * rope.breaking_force)


ROPE: OneCheck = Check(
    code="CRN285",
    title="total rope force, fork snagged",
    question="Do the rope falls withstand a snagged fork?",
    failure="rope force of a snagged fork exceeds the breaking force",
    scenes=CAUGHT,
    loads=("rope_force_caught",),
    sense=Sense.AT_MOST,
    limit=_rope_limit,
    needs=lambda spec, scene: (("hoisting", "rope", "breaking_force"),),
    blame=blames("hoisting", "rope", "breaking_force"),
    repair=at("hoisting", "rope", "breaking_force"),
    what="The total breaking force of the carriage rope falls is at least the rope force of a fork that snags during"
    " hoisting.",
    why="A rope that breaks drops the carriage into its safety gear. A rope loaded close to its breaking force is"
    " damaged without visible signs.",
    formula="F <= n F_b",
    source="equilibrium of the carriage; the maker of the rope",
)


def _rack_limit(spec: Stacker, scene: StackerScene) -> Estimate:
    """Largest force of the lifting fork on the rack.

    **Range** any rack.
    **Error** none: a limit of the file.
    **Source** the maker of the rack.
    """
    return given(spec.rack.rating_vertical)


RACK: OneCheck = only(
    lambda spec, scene: spec.rack.rating_vertical is not None and spec.rack.stiffness_vertical is not None
)(
    Check(
        code="CRN286",
        title="uplift on the rack, fork snagged",
        question="Does the rack beam withstand the uplift of a snagged fork?",
        failure="snagged fork lifts off or breaks the rack beam",
        scenes=CAUGHT,
        loads=("rack_force",),
        sense=Sense.AT_MOST,
        limit=_rack_limit,
        needs=no_needs,
        blame=blames("rack", "rating_vertical"),
        repair=at("rack", "rating_vertical"),
        what="The uplift force of the snagged fork on the rack beam is at most the rating of the beam.",
        why="Beams are hooked in from above. A lifted beam brings down the shelf and the pallets on it.",
        formula="R = K_r y",
        source="motion of drive, rope and carriage; EN 15512 for the resistance of a beam",
    ),
)


def _push_limit(spec: Stacker, scene: StackerScene) -> Estimate:
    """Largest force of the pushing fork on the rack.

    **Range** any rack.
    **Error** none: a limit of the file.
    **Source** the maker of the rack.
    """
    return given(spec.rack.rating_push)


PUSH: OneCheck = Check(
    code="CRN287",
    title="fork thrust on the rack",
    question="Does the rack withstand the thrust of the extending fork?",
    failure="fork thrust overloads the rack",
    scenes=PUSHES,
    loads=("fork_push_force",),
    sense=Sense.AT_MOST,
    limit=_push_limit,
    needs=lambda spec, scene: (("rack", "rating_push"),),
    blame=blames("rack", "rating_push"),
    repair=at("rack", "rating_push"),
    what="The thrust of the fork that extends against the rack is at most the rating of the rack across the aisle.",
    why="A protruding pallet stops the fork at full force and full speed.",
    formula="F = P + (P^2 + K m v^2)^(1/2),   with a slip clutch P_c + v (K m)^(1/2)",
    source="energy of the fork's drive; lecture notes Kramatorsk 2007, table 11.2, combination 3",
)


def _telescope_limit(spec: Stacker, scene: StackerScene) -> Estimate:
    """Largest force of the telescope.

    **Range** any fork.
    **Error** none: a limit of the file.
    **Source** the maker of the fork.
    """
    return given(spec.fork.rating if spec.fork is not None else None)


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
        title="fork thrust on the telescopic fork",
        question="Is the fork thrust within the rating of the telescopic fork?",
        failure="fork thrust overloads the telescopic fork",
        scenes=PUSHES,
        loads=("fork_push_force",),
        sense=Sense.AT_MOST,
        limit=_telescope_limit,
        needs=no_needs,
        blame=lambda spec, scene, loads: _push_key(spec, scene),
        repair=_push_key,
        what="The thrust of the fork against the rack is at most the rating of the telescopic fork. The slip clutch or"
        " the motor limits the thrust.",
        why="A slip clutch with too high a setting gives no protection. Chains and racks of telescopic forks break"
        " first.",
        formula="F <= F_max",
        source="energy of the fork's drive; the maker of the fork",
    ),
)


def _limiter_limit(spec: Stacker, scene: StackerScene) -> Estimate:
    """The limiter trips above what normal hoisting asks.

    **Range** any limiter.
    **Error** none: statics.
    **Source** equilibrium of the carriage with its inertia.
    """
    return Estimate.exact(1.0)


LIMITER: OneCheck = only(lambda spec, scene: spec.hoisting.limiter is not None)(
    Check(
        code="CRN289",
        title="load limiter trip reserve",
        question="Is the limiter set above the force of normal hoisting?",
        failure="limiter trips during normal hoisting",
        scenes=CAUGHT,
        loads=("limiter_reserve",),
        sense=Sense.AT_LEAST,
        limit=_limiter_limit,
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

# -- safety gear ----------------------------------------------------------------------------------------------------


def _gear_stroke_limit(spec: Stacker, scene: StackerScene) -> Estimate:
    """Way the safety gear has.

    **Range** any gear.
    **Error** none: a limit of the file.
    **Source** the maker of the gear.
    """
    return given(spec.safety_gear.stroke if spec.safety_gear is not None else None)


def _gear_key(spec: Stacker, scene: StackerScene) -> KeyPath:
    """What says how hard the gear holds."""
    gear = spec.safety_gear
    return ("safety_gear", "stiffness" if gear is not None and gear.type == "instantaneous" else "force")


GEAR_STROKE: OneCheck = Check(
    code="CRN290",
    title="safety gear stopping distance",
    question="Does the safety gear stop the carriage within its stroke?",
    failure="safety gear reaches the end of its stroke",
    scenes=FALLS,
    loads=("safety_gear_distance",),
    sense=Sense.AT_MOST,
    limit=_gear_stroke_limit,
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


def _holding_limit(spec: Stacker, scene: StackerScene) -> Estimate:
    """A gear holds more than the weight.

    **Range** any gear.
    **Error** none: equilibrium.
    **Source** equilibrium.
    """
    return Estimate.exact(1.0)


HOLDS: OneCheck = Check(
    code="CRN291",
    title="safety gear holding reserve",
    question="Does the braking force of the safety gear exceed the suspended weight?",
    failure="safety gear does not hold the carriage",
    scenes=FALLS,
    loads=("safety_gear_factor",),
    sense=Sense.AT_LEAST,
    limit=_holding_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: _gear_key(spec, scene),
    repair=_gear_key,
    what="The braking force of the safety gear is at least the weight of carriage, cab and load.",
    why="A gear with a braking force below the weight only slows the fall.",
    formula="F_c/(M g) >= 1",
    source="equilibrium",
)


def _deceleration_limit(spec: Stacker, scene: StackerScene) -> Estimate:
    """Largest deceleration of the carriage.

    **Range** any carriage; 9.81 m/s^2 is usual for a cab with a driver.
    **Error** none: a limit of the file.
    **Source** the file; EN 81-20: a mean of 0.2 to 1 g for progressive gears.
    """
    return given(spec.checks.catch_deceleration)


DECELERATION: OneCheck = only(lambda spec, scene: spec.checks.catch_deceleration is not None)(
    Check(
        code="CRN292",
        title="safety gear deceleration",
        question="Is the deceleration of the carriage in the safety gear within its limit?",
        failure="safety gear stops the carriage too hard",
        scenes=FALLS,
        loads=("safety_gear_deceleration",),
        sense=Sense.AT_MOST,
        limit=_deceleration_limit,
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

# -- rail -----------------------------------------------------------------------------------------------------------


def _contact_limit(spec: Stacker, scene: StackerScene) -> Estimate:
    """A wheel stays on its rail.

    **Range** any wheel.
    **Error** none: a wheel does not pull.
    **Source** equilibrium.
    """
    return Estimate.exact(0.0)


def _rail_key(spec: Stacker, scene: StackerScene) -> KeyPath:
    """What takes most of the wheel's load off."""
    assert isinstance(spec, RackStacker)
    assert isinstance(scene, RailScene)
    roll = roll_of(spec, scene)
    keys: list[KeyPath] = [*([("rail", "step")] if roll.step else []), *([("rail", "gap")] if roll.gap else [])]
    less = {
        key: roll.acceleration / roll.gravity * down
        for key, (_, down) in zip(keys, roll.pulses(roll.frequency), strict=True)
    }
    if roll.wave_length:
        less["rail", "waviness", "height"] = wave_share(roll)
    return max(less, key=less.__getitem__)


CONTACT: OneCheck = Check(
    code="CRN293",
    title="wheel load ratio on uneven rail",
    question="Do the wheels keep contact on steps, gaps and waves of the rail?",
    failure="wheel leaves the uneven rail",
    scenes=ROLLS,
    loads=("rail_contact",),
    sense=Sense.AT_LEAST,
    limit=_contact_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: _rail_key(spec, scene),
    repair=at("travel", "speed"),
    what="The wheel load stays at or above zero on steps, gaps and waves of the rail, so that the wheels keep contact.",
    why="A wheel that leaves the rail lands with an impact. The impact makes the mast oscillate.",
    formula="1 - (pi/2)^2 v^2/(g r) max(-u) >= 0,   1 - T (h/2) (2 pi v/lambda)^2/g >= 0",
    source="one vertical mode over a cosine step; `laws.rail`",
)


def _detuning_limit(spec: Stacker, scene: StackerScene) -> Estimate:
    """Least distance from resonance, 0.2 by default.

    **Range** even waves.
    **Error** none: an engineering rule.
    **Source** handbooks: keep 20 to 30 % away from a natural frequency.
    """
    return Estimate.exact(spec.checks.rail_detuning)


RESONANCE: OneCheck = only(lambda spec, scene: isinstance(spec, RackStacker) and spec.rail.waviness is not None)(
    Check(
        code="CRN294",
        title="rail wave separation from resonance",
        question="Is the passing frequency of the rail waves away from the natural frequencies?",
        failure="rail waves excite a resonance of the machine",
        scenes=ROLLS,
        loads=("rail_detuning",),
        sense=Sense.AT_LEAST,
        limit=_detuning_limit,
        needs=no_needs,
        blame=blames("rail", "waviness", "length"),
        repair=at("travel", "speed"),
        what="The relative separation of the rail wave frequency from each natural frequency is at least the limit."
        " The natural frequencies are those of the mast and of the machine on its wheels.",
        why="A rail ground in uniform waves excites the mast at one speed: v = f lambda.",
        formula="|v/(lambda f) - 1| >= 0.2 for wheels and column",
        source="resonance; `laws.rail.resonance_speed`",
    ),
)

CHECKS_OF_EVENTS: tuple[AnyCheck, ...] = (
    STROKE,
    FORCE,
    SPEED,
    FACTOR,
    ROPE,
    RACK,
    PUSH,
    TELESCOPE,
    LIMITER,
    GEAR_STROKE,
    HOLDS,
    DECELERATION,
    CONTACT,
    RESONANCE,
)
