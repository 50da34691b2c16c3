"""Checks of a hoist in motion: lift-off, stall, ways of lowering, slack rope, blow of the backlash."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import replace

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, LimitState, Sense, blames, no_needs, no_repair
from ptmcalc.contract.limits import fixed, key
from ptmcalc.machines.hoist.drive import torques
from ptmcalc.machines.hoist.drive.checks import curve_number
from ptmcalc.machines.hoist.machine import model
from ptmcalc.machines.hoist.machine.spec import Hoist, Lift, LowerBrake, Release, Start, Stop
from ptmcalc.machines.hoist.motion.cases import case_of
from ptmcalc.machines.hoist.motion.train import Moving
from ptmcalc.spec.scene import Scene

Loads = Mapping[str, Estimate]
_LIFT: frozenset[type[Scene]] = frozenset({Lift})
_BRAKED: frozenset[type[Scene]] = frozenset({LowerBrake, Stop})
_HANGING: frozenset[type[Scene]] = frozenset({Start, Stop, LowerBrake})
_HOUR = 3600.0
"""Lift-off time [s] that fails; an engineering choice. A stalled motor overheats within minutes, so that any larger
time is no lift."""

# -- lift-off -------------------------------------------------------------------------------------------------------


def _factor_limit(spec: Hoist, scene: Lift) -> Estimate:
    """Factor of the file, otherwise phi_2 of the hoisting class for the edition and load combination of the file.

        phi_2 = phi_2,min + beta_2 v_h

    **Range** a file that gives one of them.
    **Error** none: a chosen limit.
    **Source** EN 13001-2 and ISO 8686-1; `laws.lift_off_standard` for the differences between editions.
    """
    given = spec.checks.lift_off_factor
    return Estimate.exact(given if given is not None else model.class_factor(spec) or math.inf)


def _factor_needs(spec: Hoist, scene: Lift) -> tuple[KeyPath, ...]:
    known = spec.checks.lift_off_factor is not None or spec.classes.hoisting is not None
    return () if known else (("class", "hoisting"),)


def _factor_blame(spec: Hoist, scene: Lift, loads: Loads) -> KeyPath:
    """The speed at lift-off."""
    if scene.speed == "creep":
        return ("speed", "creep")
    return ("speed", "main") if spec.speed.main is not None else ("speed", "drum")


def _where_lifted(spec: Hoist, scene: Lift) -> Iterable[AnyCheck]:
    """The factor is one on the rated load; a drive too weak for it stalls, and HST121 says so."""
    lifted = scene.load == "full" and not case_of(spec, scene, frozenset()).weak
    return (replace(LIFT_OFF, each=None),) if lifted else ()


LIFT_OFF: Check[Hoist, Lift] = Check(
    code="HST120",
    title="lift-off dynamic factor",
    question="Is the dynamic factor of lifting off the ground within phi2 or the given limit?",
    failure="dynamic factor at lift-off is too high",
    scenes=_LIFT,
    loads=("lift_off_factor",),
    sense=Sense.AT_MOST,
    limit=_factor_limit,
    needs=_factor_needs,
    blame=_factor_blame,
    repair=lambda spec, scene: _factor_blame(spec, scene, {}),
    each=_where_lifted,
    what="The maximum rope force at lift-off of the rated load, relative to its weight, is at most the factor. The"
    " factor is that of the hoisting class or of the file. The criterion does not apply to an empty hook. It does"
    " not apply to a drive that stalls; HST121 reports a stall.",
    why="Structure and rope are designed with this factor. A stiff hoist at full speed exceeds it.",
    formula="max F/Q <= phi_2",
    source="EN 13001-2, ISO 8686-1; the force derived in ptmcalc.numerics.train",
)


def _stall_repair(spec: Hoist, scene: Lift) -> KeyPath:
    """The torque that lifts, where one number says it."""
    if spec.motor is None:
        return ()
    if scene.profile.shape == "curve":
        return curve_number(spec, ("motor", "curve"))
    return ("motor", "mean_starting_torque") if spec.motor.mean_starting_torque is not None else ()


def _where_to_lift(spec: Hoist, scene: Lift) -> Iterable[AnyCheck]:
    """A load that the limiter is made to stop need not be lifted."""
    stopped = spec.limiter is not None and spec.limiter.factor < 1 and scene.load == "full"
    return () if stopped else (replace(STALL, each=None),)


STALL: Check[Hoist, Lift] = Check(
    code="HST121",
    title="time to load lift-off",
    question="Does the drive lift the load off the ground at all?",
    failure="motor stalls and the load stays on the ground",
    scenes=_LIFT,
    loads=("lift_off_time",),
    sense=Sense.AT_MOST,
    limit=fixed(
        _HOUR,
        meaning="One hour: a load not lifted within it counts as never lifted",
        valid="any lift",
        source="a stalled motor overheats within minutes",
    ),
    needs=no_needs,
    blame=blames("motor"),
    repair=_stall_repair,
    each=_where_to_lift,
    what="The drive raises the rope force to the weight, and the load leaves the ground. A lift-off time above one"
    " hour counts as a stall.",
    why="A motor that stalls with a taut rope overheats, and the load stays on the ground.",
    formula="t(F = Q) finite",
    source="motion of drive and load; the findings state the phase of a stall",
)

# -- stops ----------------------------------------------------------------------------------------------------------


def _brake_key(spec: Hoist, scene: Moving) -> KeyPath:
    return ("brake", "torque")


def _lowers(scene: Moving) -> bool:
    return isinstance(scene, LowerBrake) or (isinstance(scene, Stop) and scene.direction == "down")


def _way_limit(spec: Hoist, scene: Stop) -> Estimate:
    """Stopping distance of the file, at most the height of the hook above the ground: of the scene, or the whole
    lifting height.

    **Range** a load that is lowered.
    **Error** none: a chosen limit.
    **Source** the plant's rules; the ground.
    """
    ground = scene.hook_height or spec.height
    given = spec.checks.stop_distance
    return Estimate.exact(ground if given is None else min(given, ground))


def _way_repair(spec: Hoist, scene: Moving) -> KeyPath:
    """A brake that does not hold is told so, and what it lacks, by HST118: near that limit a stop takes for ever."""
    held = torques.held(spec, model.hook_mass(spec, scene), scene.hook_height)
    return () if held is None or held.reserve < 1 else ("brake", "torque")


def _where_lowering(spec: Hoist, scene: Moving) -> Iterable[AnyCheck]:
    return (replace(WAY, each=None),) if _lowers(scene) else ()


WAY: Check[Hoist, Stop] = Check(
    code="HST122",
    hazard=True,
    title="lowering stopping distance",
    question="Does the brake stop the lowered load within the permissible distance, above the ground?",
    failure="load drops too far before it stops",
    limit_state=LimitState("brake does not stop the load"),
    scenes=_BRAKED,
    loads=("stop_distance_lowering",),
    sense=Sense.AT_MOST,
    limit=_way_limit,
    needs=no_needs,
    blame=blames("brake", "torque"),
    repair=_way_repair,
    each=_where_lowering,
    what="The brake stops the lowered load within the distance given in the file and above the ground. A brake that"
    " does not stop the load at all fails.",
    why="During the brake delay the load descends with the drive. A brake weaker than the load never stops it.",
    formula="s = max drop of the load until it rests <= limit",
    source="motion of drive and load with delay and rise of the brake",
)


def _where_hard(spec: Hoist, scene: Moving) -> Iterable[AnyCheck]:
    if spec.checks.lowering_factor is None:
        return ()
    name = "start_factor" if isinstance(scene, Start) else "lowering_brake_factor" if _lowers(scene) else "stop_factor"
    return (replace(HARD, each=None, loads=(name,)),)


HARD: Check[Hoist, Moving] = Check(
    code="HST123",
    title="dynamic factor, start or stop",
    question="Is the dynamic factor of starting or stopping the suspended load within its limit?",
    failure="dynamic factor of the start or stop is too high",
    scenes=_HANGING,
    loads=("lowering_brake_factor",),
    sense=Sense.AT_MOST,
    limit=key(
        "checks.lowering_factor",
        meaning="Factor of the file",
        valid="a file that states it",
        source="design of the structure",
    ),
    needs=no_needs,
    blame=lambda spec, scene, loads: ("motor",) if isinstance(scene, Start) else ("brake", "torque"),
    repair=lambda spec, scene: () if isinstance(scene, Start) else ("brake", "torque"),
    each=_where_hard,
    what="The maximum rope force of a start or a stop, relative to the weight, is at most the factor of the file.",
    why="A delayed brake acts on an oscillating load. The rope force can reach that of an instantaneous stop.",
    formula="max F/Q <= limit",
    source="motion of drive and load; phase plane of two masses",
)


SLACK: Check[Hoist, Moving] = Check(
    code="HST124",
    hazard=True,
    title="minimum rope force ratio",
    question="Does the rope stay taut while the suspended load starts or stops?",
    failure="rope force falls below its minimum",
    limit_state=LimitState("rope goes slack", 0),
    scenes=_HANGING,
    loads=("rope_force_share",),
    sense=Sense.AT_LEAST,
    limit=key(
        "checks.rope_share",
        meaning="Minimum ratio of rope force to weight, from the file or 0.05",
        valid="a load that is suspended throughout",
        source="practice: a slack rope leaves its groove and is loaded by an impact",
    ),
    needs=no_needs,
    blame=lambda spec, scene, loads: ("motor",) if isinstance(scene, Start) else ("brake", "torque"),
    repair=lambda spec, scene: () if isinstance(scene, Start) else ("brake", "torque"),
    what="While the suspended load starts or stops, the minimum rope force, relative to the weight, is at least the"
    " limit.",
    why="A slack rope jumps out of its groove, and the load falls back into the rope.",
    formula="min F/Q >= limit",
    source="a rope never pushes",
)


def _share_key(spec: Hoist, scene: Release) -> KeyPath:
    places = (place for place, one in enumerate(spec.all_scenes) if one.label == scene.label)
    place = next(places, None)
    return ("scenes",) if place is None else ("scenes", place, "share")


SLACK_AFTER_RELEASE: Check[Hoist, Release] = Check(
    code="HST126",
    hazard=True,
    title="minimum rope force after load release",
    question="Does the rope stay taut when part of the load is released?",
    failure="rope force after the release falls below its limit",
    limit_state=LimitState("rope goes slack", 0),
    scenes=frozenset({Release}),
    loads=("rope_force_min",),
    sense=Sense.AT_LEAST,
    limit=fixed(
        0.0,
        meaning="0: below zero the rope is slack",
        valid="any release",
        error="none: a definition",
        source="a rope carries no compression",
    ),
    needs=no_needs,
    blame=lambda spec, scene, loads: _share_key(spec, scene),
    repair=no_repair,
    what="The rope stays taut while the remaining load oscillates after the release of a part of the load.",
    why="A slack rope leaves its groove, and the remaining load falls back into the rope.",
    formula="min F > 0; F = (m - dm) g - dm g for a release at once",
    source="EN 13001-2, factor phi_3: negative where the rope goes slack; motion of drive and load",
)


def _where_play(spec: Hoist, scene: Moving) -> Iterable[AnyCheck]:
    gear = spec.gearbox
    return (replace(IMPACT, each=None),) if gear is not None and gear.stiffness is not None else ()


IMPACT: Check[Hoist, Moving] = Check(
    code="HST125",
    hazard=True,
    title="gear dynamic torque factor",
    question="Is the peak gear torque, backlash impacts included, within its factor on the steady torque?",
    failure="gear torque peak is too high",
    scenes=_LIFT | _HANGING,
    loads=("gear_impact_factor",),
    sense=Sense.AT_MOST,
    limit=key(
        "checks.gear_impact",
        meaning="Permissible ratio of gear torque to steady gear torque, from the file or 3",
        valid="gears with or without backlash",
        source="factor phi_5 of EN 13001-2 for drives with considerable backlash: 3",
    ),
    needs=no_needs,
    blame=lambda spec, scene, loads: ("gearbox", "backlash") if spec.gearbox and spec.gearbox.backlash else ("motor",),
    repair=no_repair,
    each=_where_play,
    what="The maximum gear torque, backlash impacts included, is at most the limit times the torque of steady motion.",
    why="A motor that accelerates through the backlash strikes the teeth with the energy gained there.",
    formula="max |M_gear|/M_even <= limit",
    source="EN 13001-2, factor of drive forces; motion of the train with backlash",
)

CHECKS_OF_MOTION: tuple[AnyCheck, ...] = (LIFT_OFF, STALL, WAY, HARD, SLACK, SLACK_AFTER_RELEASE, IMPACT)
