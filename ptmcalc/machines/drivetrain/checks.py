"""The checks of a drive train: DRV101 to DRV112."""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from typing import TypeVar

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import Check, LimitState, Sense, no_needs, no_repair
from ptmcalc.contract.result import of
from ptmcalc.machines.drivetrain.model import brake_of, case_of
from ptmcalc.machines.drivetrain.overhauling import overhauled, path_of
from ptmcalc.machines.drivetrain.spec import Drivetrain, Run, SineTorque, Start, Stop, TrainScene
from ptmcalc.spec.scene import Scene

WORN_OUT, WORN_OUT_OPEN = 0.25, 0.40
"""Largest worn part of a tooth [1], lecture notes Kramatorsk 2007 (15 to 25 % and 40 %): in gearboxes and gear
couplings (`WORN_OUT`), and in open gears (`WORN_OUT_OPEN`). A smaller value requires an earlier renewal."""

ALL: frozenset[type[Scene]] = frozenset({Run, Start, Stop})
RUNNING: frozenset[type[Scene]] = frozenset({Run})
DRIVEN: frozenset[type[Scene]] = frozenset({Run, Start})
AnyCheck = Check[Drivetrain, TrainScene]
C = TypeVar("C", bound=TrainScene)


def _exactly(value: float) -> Callable[[Drivetrain, TrainScene], Estimate]:
    """A limit that is the same in every scene."""
    return lambda spec, scene: Estimate.exact(value)


_NO_LIMIT = _exactly(math.inf)


# -- torque ---------------------------------------------------------------------------------------------------------


def torque_limit(spec: Drivetrain, scene: TrainScene) -> Estimate:
    """Permissible torque of a link, given in the file.

    **Range** each link that has a `limit`.
    **Error** none.
    **Source** the manufacturer's data.
    """
    return Estimate.exact(math.inf)


def _torque_checks(spec: Drivetrain, scene: TrainScene) -> Iterator[AnyCheck]:
    """One for each link with a limit; where none has one, the first says so."""
    limited = {name: link.limit for name, link in spec.links.items() if link.limit is not None}
    if not limited and spec.links:
        first = next(iter(spec.links))
        yield TORQUE.of(first, _NO_LIMIT, ("links", first, "limit"), needs=(("links", first, "limit"),))
    for name, limit in limited.items():
        path = ("links", name, "limit")
        yield TORQUE.of(name, _exactly(limit), path, repair=path)


TORQUE: AnyCheck = Check(
    code="DRV101",
    title="peak link torque",
    question="Is the peak torque or force of every rated link within its limit?",
    failure="link is overloaded",
    scenes=ALL,
    loads=("torque_peak",),
    sense=Sense.AT_MOST,
    limit=torque_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: ("links",),
    repair=no_repair,
    each=_torque_checks,
    what="The peak torque (or force) of every link with a `limit` is at most this limit.",
    why="A coupling, shaft or rope breaks at its peak load, not at its mean load.",
    formula="max |T(t)| <= T_limit",
    source="the manufacturer's limit of the part",
)


# -- start and stop -------------------------------------------------------------------------------------------------


def start_limit(spec: Drivetrain, scene: Start) -> Estimate:
    """Maximum starting time given in the file.

    **Range** any start with a target speed.
    **Error** none.
    **Source** a choice of the designer.
    """
    return Estimate.exact(spec.checks.start_time or math.inf)


def _end_of_start(spec: Drivetrain, scene: Start) -> tuple[KeyPath, ...]:
    if case_of(spec, scene).until is not None:
        return ()
    return (("scenes", list(spec.all_scenes).index(scene), "until"),)


def _start_needs(spec: Drivetrain, scene: Start) -> tuple[KeyPath, ...]:
    return (*_end_of_start(spec, scene), ("checks", "start_time"))


def _start_checks(spec: Drivetrain, scene: Start) -> Iterator[Check[Drivetrain, Start]]:
    """The main part, and each other part with a motor of its own, named where there are several."""
    yield from _of_parts(START, spec, scene, lambda part: ("checks", "start_time"))


def _reach_checks(spec: Drivetrain, scene: Start) -> Iterator[Check[Drivetrain, Start]]:
    yield from _of_parts(REACHES, spec, scene, lambda part: _motor_on(spec, part))


def _motor_on(spec: Drivetrain, body: str) -> KeyPath:
    return next((("motors", name) for name, one in spec.motors.items() if one.at == body), ("motors",))


def _of_parts(
    check: Check[Drivetrain, C], spec: Drivetrain, scene: C, key: Callable[[str], KeyPath], *, repairs: bool = False
) -> Iterator[Check[Drivetrain, C]]:
    """A check of the main part and of the others; `key` governs the verdict of another part."""
    case = case_of(spec, scene)
    if not case.others:
        yield check
        return
    yield replace(check, element=case.bodies[case.main], each=None)
    for part in case.others:
        name = case.bodies[part.body]
        path = key(name)
        made = replace(check, element=name, loads=tuple(of(f"part_{load}", name) for load in check.loads), each=None)
        yield replace(made, blame=lambda *_, path=path: path, repair=lambda *_, path=path: path if repairs else ())


def _motor_blame(spec: Drivetrain, scene: TrainScene, loads: Mapping[str, Estimate]) -> KeyPath:
    return ("motors", next(iter(spec.motors))) if spec.motors else ("inertias",)


START: Check[Drivetrain, Start] = Check(
    code="DRV102",
    title="starting time",
    question="Does the shaft considered reach its speed within the limit?",
    failure="start takes too long",
    limit_state=LimitState("target speed is not reached"),
    scenes=frozenset({Start}),
    loads=("start_time",),
    sense=Sense.AT_MOST,
    limit=start_limit,
    needs=_start_needs,
    blame=lambda spec, scene, loads: ("checks", "start_time"),
    repair=no_repair,
    each=_start_checks,
    what="The inertia considered in the scene reaches its speed within the maximum start time.",
    why="A long start heats the motor.",
    formula="t(w = w_end) <= t_limit",
    source="a choice of the designer",
)


def stop_limit(spec: Drivetrain, scene: Stop) -> Estimate:
    """Maximum stopping time given in the file.

    **Range** any stop.
    **Error** none.
    **Source** a choice of the designer or of a rule for the machine.
    """
    return Estimate.exact(spec.checks.stop_time or math.inf)


def _stop_blame(spec: Drivetrain, scene: TrainScene, loads: Mapping[str, Estimate]) -> KeyPath:
    if spec.brakes:
        return ("brakes", next(iter(spec.brakes)), "torque")
    return ("checks", "stop_time") if spec.checks.stop_time is not None else ("inertias",)


def _brake_torque(spec: Drivetrain, scene: TrainScene) -> KeyPath:
    return ("brakes", next(iter(spec.brakes)), "torque") if spec.brakes else ()


def _from_rest(spec: Drivetrain, scene: TrainScene) -> bool:
    train = case_of(spec, scene).train
    return not train.guides and not any(body.speed for body in train.bodies)


def _speed_before(spec: Drivetrain, scene: Stop) -> tuple[KeyPath, ...]:
    """The key without which a stop begins at standstill."""
    if scene.speed is not None or not _from_rest(spec, scene):
        return ()
    return (("scenes", list(spec.all_scenes).index(scene), "speed"),)


def _stop_checks(spec: Drivetrain, scene: Stop) -> Iterator[Check[Drivetrain, Stop]]:
    """A scene that the file begins at standstill has no stopping time: DRV110 judges whether the brake holds."""
    if scene.speed is None or not _from_rest(spec, scene):
        yield from _of_parts(STOP, spec, scene, lambda part: _brake_on(spec, scene, part), repairs=True)


def _rest_checks(spec: Drivetrain, scene: Stop) -> Iterator[Check[Drivetrain, Stop]]:
    yield from _of_parts(RESTS, spec, scene, lambda part: _brake_on(spec, scene, part), repairs=True)


def _brake_on(spec: Drivetrain, scene: Stop, body: str) -> KeyPath:
    """The torque of the brake or clutch of a part."""
    case = case_of(spec, scene)
    name = brake_of(spec, case, case.index(body))
    return ("brakes", name, "torque") if name is not None else ("inertias",)


STOP: Check[Drivetrain, Stop] = Check(
    code="DRV103",
    title="stopping time",
    question="Does the shaft considered come to rest within the limit, and stay at rest?",
    failure="stop takes too long",
    limit_state=LimitState("shaft does not stay at rest"),
    scenes=frozenset({Stop}),
    loads=("stop_time",),
    sense=Sense.AT_MOST,
    limit=stop_limit,
    needs=lambda spec, scene: (*_speed_before(spec, scene), ("checks", "stop_time")),
    blame=_stop_blame,
    repair=_brake_torque,
    each=_stop_checks,
    what="The inertia considered in the scene stops within the maximum stop time and stays at standstill.",
    why="A drive train that moves on hits people or objects beyond its stopping point.",
    formula="t(w = 0 from then on) <= t_limit",
    source="a choice of the designer or of a rule for the machine",
)


# -- what must end at all -------------------------------------------------------------------------------------------


def _whole(spec: Drivetrain, scene: Start) -> Estimate:
    """1: the full target speed of the start.

    **Range** any start with a target speed.
    **Error** none.
    **Source** definition of a start.
    """
    return Estimate.exact(1.0)


REACHES: Check[Drivetrain, Start] = Check(
    code="DRV109",
    title="speed reached in the start, relative to target",
    question="Does the shaft considered reach its target speed?",
    failure="target speed is not reached",
    scenes=frozenset({Start}),
    loads=("start_share",),
    sense=Sense.AT_LEAST,
    limit=_whole,
    needs=_end_of_start,
    blame=_motor_blame,
    repair=no_repair,
    each=_reach_checks,
    what="The inertia considered in the scene reaches the speed that ends the start, without a time limit.",
    why="A motor that stalls or stays below its speed overheats. The machine never operates.",
    formula="max w/w_end >= 1",
    source="definition of a start; excess motor torque over its speed range",
)


def _nothing(spec: Drivetrain, scene: Stop) -> Estimate:
    """0: standstill.

    **Range** any stop.
    **Error** none.
    **Source** definition of a stop.
    """
    return Estimate.exact(0.0)


RESTS: Check[Drivetrain, Stop] = Check(
    code="DRV110",
    title="speed after the stop",
    question="Does the shaft considered come to rest and stay at rest?",
    failure="shaft does not stay at rest",
    scenes=frozenset({Stop}),
    loads=("stop_speed_share",),
    sense=Sense.AT_MOST,
    limit=_nothing,
    needs=_speed_before,
    blame=_stop_blame,
    repair=_brake_torque,
    each=_rest_checks,
    what="The inertia considered in the scene stops, without a time limit, and stays at standstill.",
    why="A brake that does not hold lets the load run away.",
    formula="|w(end)|/|w(0)| = 0",
    source="definition of a stop; static balance of brake and load",
)


def way_limit(spec: Drivetrain, scene: Stop) -> Estimate:
    """Permissible stopping angle or distance, given in the file.

    **Range** files with this limit.
    **Error** none.
    **Source** a choice of the designer or of a rule for the machine.
    """
    return Estimate.exact(spec.checks.stop_angle or math.inf)


def _way_checks(spec: Drivetrain, scene: Stop) -> Iterator[Check[Drivetrain, Stop]]:
    if spec.checks.stop_angle is not None and (scene.speed is None or not _from_rest(spec, scene)):
        yield WAY


WAY: Check[Drivetrain, Stop] = Check(
    code="DRV104",
    title="stopping angle or distance",
    question="Is the travel from stop command to rest within the limit?",
    failure="stopping travel is too long",
    scenes=frozenset({Stop}),
    loads=("stop_angle",),
    sense=Sense.AT_MOST,
    limit=way_limit,
    needs=_speed_before,
    blame=_stop_blame,
    repair=_brake_torque,
    each=_way_checks,
    what="The angle or distance from the stop command to standstill is at most the limit `checks.stop_angle`.",
    why="A longer stopping distance leads to contact with an end stop, a person or the next machine.",
    formula="|phi(rest) - phi(command)| <= limit",
    source="a choice of the designer",
)


def _clutch_checks(spec: Drivetrain, scene: Start) -> Iterator[Check[Drivetrain, Start]]:
    for grip in case_of(spec, scene).clutches:
        path = ("brakes", grip.name, "torque")
        yield CLUTCH.of(grip.name, _no_slip, path, repair=path)


def _no_slip(spec: Drivetrain, scene: Start) -> Estimate:
    """0: no slip.

    **Range** any clutch that acts in a start.
    **Error** none.
    **Source** definition of a locked clutch.
    """
    return Estimate.exact(0.0)


CLUTCH: Check[Drivetrain, Start] = Check(
    code="DRV112",
    title="clutch slip speed after the start",
    question="Is each clutch locked at the end of the start?",
    failure="clutch does not lock",
    scenes=frozenset({Start}),
    loads=("clutch_slip",),
    sense=Sense.AT_MOST,
    limit=_no_slip,
    needs=no_needs,
    blame=lambda spec, scene, loads: ("brakes",),
    repair=no_repair,
    each=_clutch_checks,
    what="Each clutch that acts in the start is locked at its end.",
    why="A clutch that slips permanently converts its power to heat, and the part behind it stays below its speed.",
    formula="|w_1 - w_2|/max(|w_1|, |w_2|) = 0",
    source="static balance of the clutch torque and the load behind it",
)


# -- motors ---------------------------------------------------------------------------------------------------------


def heating_limit(spec: Drivetrain, scene: TrainScene) -> Estimate:
    """Rated torque of all motors of one name.

    **Range** motors whose rated torque is given or follows from power and speed.
    **Error** none.
    **Source** IEC 60034-1: the rms torque of a cycle against the rated one, for motors with losses proportional to the
    square of the torque.
    """
    return Estimate.exact(math.inf)


def _heating_checks(spec: Drivetrain, scene: TrainScene) -> Iterator[AnyCheck]:
    for name, one in spec.motors.items():
        path = ("motors", name, "motor", "rated_torque")
        if one.motor.rated is None:
            yield HEATING.of(name, _NO_LIMIT, ("motors", name, "motor"), needs=(path,))
        else:
            rated = one.count * one.motor.rated
            yield HEATING.of(name, _exactly(rated), ("motors", name, "motor"))


HEATING: AnyCheck = Check(
    code="DRV105",
    title="motor rms torque",
    question="Is the rms torque of the cycle within the rated torque?",
    failure="motor is thermally overloaded",
    scenes=RUNNING,
    loads=("motor_torque_rms",),
    sense=Sense.AT_MOST,
    limit=heating_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: ("motors",),
    repair=no_repair,
    each=_heating_checks,
    what="The rms motor torque over the cycle, which determines the heating, is at most the rated torque.",
    why="The losses are proportional to the square of the torque. The winding insulation ages with its temperature.",
    formula="sqrt(int M^2 dt/T) <= M_N,   T = checks.cycle_time, else the scene",
    source="IEC 60034-1; lecture notes Kramatorsk 2007",
)


def overload_limit(spec: Drivetrain, scene: TrainScene) -> Estimate:
    """Permissible short-time motor torque, given in the file.

    **Range** motors with `largest_torque`.
    **Error** none.
    **Source** the manufacturer's overload limit.
    """
    return Estimate.exact(math.inf)


def _overload_checks(spec: Drivetrain, scene: TrainScene) -> Iterator[AnyCheck]:
    for name, one in spec.motors.items():
        if one.motor.largest_torque is not None:
            most = one.count * one.motor.largest_torque
            path = ("motors", name, "motor", "largest_torque")
            yield OVERLOAD.of(name, _exactly(most), path)


OVERLOAD: AnyCheck = Check(
    code="DRV106",
    title="motor peak torque",
    question="Is the peak motor torque within its overload limit?",
    failure="motor exceeds its overload limit",
    scenes=DRIVEN,
    loads=("motor_torque_peak",),
    sense=Sense.AT_MOST,
    limit=overload_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: ("motors",),
    repair=no_repair,
    each=_overload_checks,
    what="The peak torque of every motor with `largest_torque` is at most this limit.",
    why="Above this limit, a motor stalls or its inverter trips.",
    formula="max |M(t)| <= M_max",
    source="the manufacturer's data",
)


def _at_least_all(spec: Drivetrain, scene: TrainScene) -> Estimate:
    """1: the braking torque of all motors is at least the overhauling torque.

    **Range** motors driven by the load at their no-load speed.
    **Error** none.
    **Source** torque balance at steady speed.
    """
    return Estimate.exact(1.0)


def _braking_checks(spec: Drivetrain, scene: TrainScene) -> Iterator[AnyCheck]:
    """One for each part of the train whose motors a load drives."""
    for one in overhauled(spec, scene):
        path = path_of(spec, one.motor)
        yield BRAKES.of(one.motor, _at_least_all, path, repair=path if len(path) > _MOTOR_PATH else ())


_MOTOR_PATH = 2
"""Keys of the path to a motor, without the one that its torques are proportional to. A property of the file format: a
longer path can be changed by one factor."""

BRAKES: AnyCheck = Check(
    code="DRV111",
    title="motor braking torque reserve",
    question="Does the motor hold the overhauling load at its speed?",
    failure="load overcomes the braking torque of the motor",
    scenes=DRIVEN,
    loads=("braking_reserve",),
    sense=Sense.AT_LEAST,
    limit=_at_least_all,
    needs=no_needs,
    blame=lambda spec, scene, loads: ("motors",),
    repair=no_repair,
    each=_braking_checks,
    what="The largest torque with which the motors brake above their no-load speed is at least the overhauling torque.",
    why="Beyond its largest braking torque the motor brakes less and less. The load runs away.",
    formula="M_brake/M_load >= 1",
    source="torque balance at steady speed; curve of the motor",
)


# -- vibration and wear ---------------------------------------------------------------------------------------------


def resonance_limit(spec: Drivetrain, scene: TrainScene) -> Estimate:
    """Minimum separation of an excitation frequency from a natural frequency: 20 % of the natural frequency, or the
    value of the file.

    **Range** harmonic excitations.
    **Error** none: an engineering choice.
    **Source** usual practice; at 20 % an undamped amplitude is 2.3 to 2.8 times the static one.
    """
    return Estimate.exact(spec.checks.resonance_margin)


def _resonance_checks(spec: Drivetrain, scene: TrainScene) -> Iterator[AnyCheck]:
    for name, torque in spec.torques.items():
        if isinstance(torque, SineTorque):
            key = "frequency" if torque.frequency is not None else "angular_frequency"
            path = ("torques", name, key)
            yield RESONANCE.of(name, resonance_limit, path, repair=path)


RESONANCE: AnyCheck = Check(
    code="DRV107",
    title="excitation separation from resonance",
    question="Are all excitation frequencies far enough from the natural frequencies?",
    failure="excitation is close to a natural frequency",
    scenes=RUNNING,
    loads=("resonance_separation",),
    sense=Sense.AT_LEAST,
    limit=resonance_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: ("torques",),
    repair=no_repair,
    each=_resonance_checks,
    what="The frequency of every harmonic torque is separated from each natural frequency of the train by at least the"
    " margin.",
    why="Near resonance, only damping limits the torque. The damping is not known accurately.",
    formula="min_k |W/w_k - 1| >= margin",
    source="usual practice",
)


def wear_limit(spec: Drivetrain, scene: TrainScene) -> Estimate:
    """Permissible tooth wear relative to the tooth thickness: 25 % in gearboxes and couplings, 40 % in open gears.

    **Range** links with a backlash from a `clearance` with a module.
    **Error** none.
    **Source** lecture notes Kramatorsk 2007 (15 to 25 % and 40 % of the tooth thickness).
    """
    return Estimate.exact(WORN_OUT)


def _wear_checks(spec: Drivetrain, scene: TrainScene) -> Iterator[AnyCheck]:
    for name, link in spec.links.items():
        if link.clearance is not None and link.clearance.wear:
            most = WORN_OUT_OPEN if link.clearance.kind == "open_gear" else WORN_OUT
            path = ("links", name, "clearance", "wear")
            yield WEAR.of(name, _exactly(most), path, repair=path)


WEAR: AnyCheck = Check(
    code="DRV108",
    title="gear tooth wear",
    question="Is the tooth wear within the permissible share of the tooth thickness?",
    failure="gear teeth are worn beyond the limit",
    scenes=ALL,
    loads=("wear_share",),
    sense=Sense.AT_MOST,
    limit=wear_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: ("links",),
    repair=no_repair,
    each=_wear_checks,
    what="The wear of gear teeth is at most 25 % of their thickness, and at most 40 % for open gears.",
    why="A worn tooth has a lower strength. Its backlash multiplies the impact torque of every start.",
    formula="w/(pi m/2) <= 0.25 or 0.40",
    source="lecture notes Kramatorsk 2007",
)

CHECKS = (TORQUE, START, STOP, WAY, HEATING, OVERLOAD, RESONANCE, WEAR, REACHES, RESTS, BRAKES, CLUTCH)
