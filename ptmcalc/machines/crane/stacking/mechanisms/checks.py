"""Checks of the carriage, the ropes, and the times of the drives."""

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, LimitState, Sense, at, blames, needs, no_needs, only
from ptmcalc.contract.limits import fixed, key
from ptmcalc.laws import hoist_class
from ptmcalc.machines.crane.stacking.machine import model
from ptmcalc.machines.crane.stacking.machine.judging import OneCheck, block, given
from ptmcalc.machines.crane.stacking.machine.keys.drives import Rotation
from ptmcalc.machines.crane.stacking.machine.scenes import Brake, Braked, HoistScene, Start
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.mechanisms import starts
from ptmcalc.spec.scene import Scene

ROLLERS: OneCheck = Check(
    code="CRN201",
    hazard=True,
    title="guide roller load",
    question="Is the load of each guide roller within its rating?",
    failure="guide roller is overloaded",
    scenes=frozenset({HoistScene}),
    loads=("roller_load",),
    sense=Sense.AT_MOST,
    limit=key(
        "carriage.rollers.rating",
        meaning="Permissible load of a guide roller",
        valid="any roller",
        error="none: a limit of the file",
        source="the manufacturer of the roller",
    ),
    needs=needs(("carriage", "rollers", "rating")),
    blame=blames("carriage", "rollers", "rating"),
    repair=at("carriage", "rollers", "distance"),
    what="The load of each guide roller on the mast is at most its rating. The load results from the eccentric weights"
    " of load, carriage and cab and from the acceleration of the carriage.",
    why="The reaction is proportional to the lever arm divided by the roller distance. Short carriages with long forks"
    " wear roller and rail.",
    formula="(1 + a/g) |Q e + G b|/h <= n R_0",
    source="N. Yu. Dorokhov, lecture notes, Kramatorsk 2007; the manufacturer of the roller",
)


JAMMING: OneCheck = only(lambda spec, scene: scene.direction == "down")(
    Check(
        code="CRN202",
        hazard=True,
        title="carriage guide friction ratio",
        question="Does the weight overcome the guide friction while lowering?",
        failure="guide friction is too large for the weight",
        limit_state=LimitState("carriage jams on its guides", 1),
        scenes=frozenset({HoistScene}),
        loads=("jamming",),
        sense=Sense.AT_MOST,
        limit=key(
            "checks.self_jamming",
            meaning="1: a guide resistance equal to the weight holds the carriage",
            valid="any guide",
            error="none: an equilibrium; a file may require more than 1",
            source="balance of the carriage",
        ),
        needs=no_needs,
        blame=blames("carriage", "rollers", "distance"),
        repair=at("carriage", "rollers", "distance"),
        what="The ratio of the guide resistance to the weight that overcomes it while lowering is at most the limit.",
        why="A carriage that jams on its guides stays up while its ropes go slack. It falls when it comes free.",
        formula="2 w |Q e + G b|/(h (Q + G)) <= 1,   w = (mu d + 2 f)/D",
        source="balance of the carriage",
    )
)


def _rope_limit(spec: Stacker, scene: HoistScene) -> Estimate:
    """Safety factor required by the file, or by the mechanism group for a rope on one layer.

    **Range** running wire ropes.
    **Error** none: a table.
    **Source** ISO 4308-1:2003 by the group (`laws.hoist_class`); or the file.
    """
    asked, group = spec.checks.rope_safety, spec.hoisting.group
    if asked is None and group is not None:
        asked = hoist_class.rope_safety_of_group(group, 1)
    return given(asked)


def _rope_needs(spec: Stacker, scene: HoistScene) -> tuple[KeyPath, ...]:
    limited = spec.checks.rope_safety is not None or spec.hoisting.group is not None
    return (("hoisting", "rope", "breaking_force"), *(() if limited else (("hoisting", "group"),)))


ROPE: OneCheck = Check(
    code="CRN203",
    hazard=True,
    title="carriage rope safety factor",
    question="Is the rope breaking force high enough for its largest pull?",
    failure="carriage rope is overloaded",
    scenes=frozenset({HoistScene}),
    loads=("rope_safety",),
    sense=Sense.AT_LEAST,
    limit=_rope_limit,
    needs=_rope_needs,
    blame=blames("hoisting", "rope", "breaking_force"),
    repair=at("hoisting", "rope", "breaking_force"),
    what="The ratio of the rope breaking force to the maximum rope force is at least the value required by the group."
    " The rope force includes the carriage acceleration, the guide resistance and the sheave losses.",
    why="An overloaded rope may break. This load is combination 1 of both tables of the notes. The formula of the"
    " notes includes inertia, their combination does not.",
    formula="F_min/S >= Z_p,   S = ((Q + G)(1 + a/g) + W)/(m eta_r)",
    source="ISO 4308-1:2003; N. Yu. Dorokhov, lecture notes, Kramatorsk 2007",
)


def _drive_key(spec: Stacker, scene: Braked) -> KeyPath:
    """What governs how long a mechanism starts or stops."""
    mechanism, stops = model.moving(spec, scene), isinstance(scene, Brake)
    here = block(spec, scene)
    if isinstance(mechanism, Rotation):
        return here, "braking_torque" if stops else "driving_torque"
    if mechanism.drive is not None:
        ramp, torque = ("deceleration", ("brake", "torque")) if stops else ("acceleration", ("motor",))
        return (here, "drive", ramp) if getattr(mechanism.drive, ramp) is not None else (here, "drive", *torque)
    ramp, force = ("deceleration", "braking_force") if stops else ("acceleration", "driving_force")
    return here, ramp if getattr(mechanism, ramp) is not None else force


def _drive_repair(spec: Stacker, scene: Braked) -> KeyPath:
    key = _drive_key(spec, scene)
    return () if key[-1] == "motor" else key


START_TIME: OneCheck = Check(
    code="CRN204",
    title="mechanism start time",
    question="Does the mechanism reach its speed within the limit?",
    failure="mechanism takes too long to start",
    limit_state=LimitState("mechanism drive stalls"),
    scenes=frozenset({Start}),
    loads=("start_time",),
    sense=Sense.AT_MOST,
    limit=key(
        "checks.start_time",
        meaning="Maximum starting time, 10 s by default",
        valid="any mechanism",
        error="none: an engineering rule",
        source="handbooks of lifting machines: 8 to 10 s for travel",
    ),
    needs=no_needs,
    blame=lambda spec, scene, loads: _drive_key(spec, scene),
    repair=_drive_repair,
    what="Bridge, trolley, mast or base reach their speed within the maximum start time. A drive with a torque below"
    " its resistance never reaches the speed.",
    why="A slow start delays the cycle. This load is combination 1 of the tables of the notes: weights alone, for the"
    " drives of all mechanisms.",
    formula="integral P dt = (m_1 + m_c + m_2) v,   t <= t_0",
    source="momentum; handbooks of lifting machines",
)
BRAKE_TIME: OneCheck = Check(
    code="CRN205",
    title="mechanism stop time",
    question="Does the mechanism stop within the limit?",
    failure="mechanism takes too long to stop",
    scenes=frozenset({Brake}),
    loads=("brake_time",),
    sense=Sense.AT_MOST,
    limit=key(
        "checks.brake_time",
        meaning="Maximum stopping time, 10 s by default",
        valid="any mechanism",
        error="none: an engineering rule",
        source="handbooks of lifting machines: 8 to 10 s for travel",
    ),
    needs=no_needs,
    blame=lambda spec, scene, loads: _drive_key(spec, scene),
    repair=_drive_repair,
    what="Bridge, trolley, mast or base stop permanently within the maximum stop time. An oscillating mast may pull"
    " its base through the brake again.",
    why="A weak brake reduces the mast load but uses up the distance to the next buffer.",
    formula="integral P dt = (m_1 + m_c + m_2) v,   t <= t_0",
    source="momentum; handbooks of lifting machines",
)


def _counts(spec: Stacker, scene: Braked | HoistScene) -> bool:
    if isinstance(scene, HoistScene):
        return scene.direction == "up" and spec.hoisting.starts_per_hour is not None
    return model.moving(spec, scene).starts_per_hour is not None


def _starts_block(spec: Stacker, scene: Braked | HoistScene) -> str:
    return "hoisting" if isinstance(scene, HoistScene) else block(spec, scene)


def _starts_needs(spec: Stacker, scene: Braked | HoistScene) -> tuple[KeyPath, ...]:
    known = isinstance(scene, Start) and starts.permitted(model.moving(spec, scene)) is not None
    return () if known else ((_starts_block(spec, scene), "permitted_starts_per_hour"),)


_STARTING: frozenset[type[Scene]] = frozenset((Start, HoistScene))
STARTS: OneCheck = only(_counts)(
    Check(
        code="CRN206",
        title="starts per hour, share of rating",
        question="Is the number of starts per hour within the rating of motor and brake?",
        failure="mechanism starts too often",
        scenes=_STARTING,
        loads=("starts_ratio",),
        sense=Sense.AT_MOST,
        limit=fixed(
            1.0,
            meaning="1: the permitted starts of motor and brake",
            valid="any mechanism",
            error="none: a limit of the file",
            source="the manufacturer of motor and brake",
        ),
        needs=_starts_needs,
        blame=lambda spec, scene, loads: (_starts_block(spec, scene), "starts_per_hour"),
        repair=lambda spec, scene: (_starts_block(spec, scene), "starts_per_hour"),
        what="The number of starts per hour of the mechanism is at most the rating of motor and brake.",
        why="Each start dissipates in rotor and brake an energy equal to the kinetic energy of all moving masses.",
        formula="z <= z_0",
        source="the manufacturer of motor and brake; combination 1 of the notes' tables",
    )
)

CHECKS_OF_STATICS: tuple[AnyCheck, ...] = (ROLLERS, JAMMING, ROPE, START_TIME, BRAKE_TIME, STARTS)
