"""Checks of start and stop: times, speeds, stopping distance, clutches."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from typing import TypeVar

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import Check, LimitState, Sense, blames, no_needs, no_repair
from ptmcalc.contract.limits import fixed, key
from ptmcalc.contract.result import of
from ptmcalc.machines.drivetrain.machine.model import brake_of, case_of
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain, Start, Stop, TrainScene

C = TypeVar("C", bound=TrainScene)


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
    limit=key(
        "checks.start_time",
        meaning="Maximum starting time given in the file",
        valid="any start with a target speed",
        error="none",
        source="a choice of the designer",
    ),
    needs=_start_needs,
    blame=blames("checks", "start_time"),
    repair=no_repair,
    each=_start_checks,
    what="The inertia considered in the scene reaches its speed within the maximum start time.",
    why="A long start heats the motor.",
    formula="t(w = w_end) <= t_limit",
    source="a choice of the designer",
)


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
    limit=key(
        "checks.stop_time",
        meaning="Maximum stopping time given in the file",
        valid="any stop",
        error="none",
        source="a choice of the designer or of a rule for the machine",
    ),
    needs=lambda spec, scene: (*_speed_before(spec, scene), ("checks", "stop_time")),
    blame=_stop_blame,
    repair=_brake_torque,
    each=_stop_checks,
    what="The inertia considered in the scene stops within the maximum stop time and stays at standstill.",
    why="A drive train that moves on hits people or objects beyond its stopping point.",
    formula="t(w = 0 from then on) <= t_limit",
    source="a choice of the designer or of a rule for the machine",
)


REACHES: Check[Drivetrain, Start] = Check(
    code="DRV109",
    title="speed reached in the start, relative to target",
    question="Does the shaft considered reach its target speed?",
    failure="target speed is not reached",
    scenes=frozenset({Start}),
    loads=("start_share",),
    sense=Sense.AT_LEAST,
    limit=fixed(
        1.0,
        meaning="1: the full target speed of the start",
        valid="any start with a target speed",
        source="definition of a start",
    ),
    needs=_end_of_start,
    blame=_motor_blame,
    repair=no_repair,
    each=_reach_checks,
    what="The inertia considered in the scene reaches the speed that ends the start, without a time limit.",
    why="A motor that stalls or stays below its speed overheats. The machine never operates.",
    formula="max w/w_end >= 1",
    source="definition of a start; excess motor torque over its speed range",
)


RESTS: Check[Drivetrain, Stop] = Check(
    code="DRV110",
    hazard=True,
    title="speed after the stop",
    question="Does the shaft considered come to rest and stay at rest?",
    failure="shaft does not stay at rest",
    scenes=frozenset({Stop}),
    loads=("stop_speed_share",),
    sense=Sense.AT_MOST,
    limit=fixed(0.0, meaning="0: standstill", valid="any stop", source="definition of a stop"),
    needs=_speed_before,
    blame=_stop_blame,
    repair=_brake_torque,
    each=_rest_checks,
    what="The inertia considered in the scene stops, without a time limit, and stays at standstill.",
    why="A brake that does not hold lets the load run away.",
    formula="|w(end)|/|w(0)| = 0",
    source="definition of a stop; static balance of brake and load",
)


def _way_checks(spec: Drivetrain, scene: Stop) -> Iterator[Check[Drivetrain, Stop]]:
    if spec.checks.stop_angle is not None and (scene.speed is None or not _from_rest(spec, scene)):
        yield WAY


WAY: Check[Drivetrain, Stop] = Check(
    code="DRV104",
    hazard=True,
    title="stopping angle or distance",
    question="Is the travel from stop command to rest within the limit?",
    failure="stopping travel is too long",
    scenes=frozenset({Stop}),
    loads=("stop_angle",),
    sense=Sense.AT_MOST,
    limit=key(
        "checks.stop_angle",
        meaning="Permissible stopping angle or distance, given in the file",
        valid="files with this limit",
        error="none",
        source="a choice of the designer or of a rule for the machine",
    ),
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
        yield CLUTCH.of(grip.name, _NO_SLIP, path, repair=path)


_NO_SLIP = fixed(
    0.0, meaning="0: no slip", valid="any clutch that acts in a start", source="definition of a locked clutch"
)


CLUTCH: Check[Drivetrain, Start] = Check(
    code="DRV112",
    title="clutch slip speed after the start",
    question="Is each clutch locked at the end of the start?",
    failure="clutch does not lock",
    scenes=frozenset({Start}),
    loads=("clutch_slip",),
    sense=Sense.AT_MOST,
    limit=_NO_SLIP,
    needs=no_needs,
    blame=blames("brakes"),
    repair=no_repair,
    each=_clutch_checks,
    what="Each clutch that acts in the start is locked at its end.",
    why="A clutch that slips permanently converts its power to heat, and the part behind it stays below its speed.",
    formula="|w_1 - w_2|/max(|w_1|, |w_2|) = 0",
    source="static balance of the clutch torque and the load behind it",
)

CHECKS_OF_MOTION = (START, STOP, WAY, REACHES, RESTS, CLUTCH)
