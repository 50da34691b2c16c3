"""Checks of a start: strong enough, quick enough, not too hard on the chain, no slack."""

from collections.abc import Iterable, Mapping
from dataclasses import replace

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.components.motor_rating import number_at
from ptmcalc.contract.check import AnyCheck, Check, Sense, at, no_needs
from ptmcalc.contract.limits import fixed, key
from ptmcalc.machines.chain_drive.machine.layout import ConveyorLayout
from ptmcalc.machines.chain_drive.machine.model import drive_of, tension_key
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Start
from ptmcalc.machines.chain_drive.starting.motion import start_case

Loads = Mapping[str, Estimate]


def torque_key(spec: ChainDrive) -> KeyPath:
    """The key of the starting torque the file uses."""
    return ("drive", "motor", drive_of(spec).motor.starting_key)


def _torque_repair(spec: ChainDrive, scene: Start) -> KeyPath:
    return number_at(torque_key(spec), drive_of(spec).motor.start_curve)


def _profile_key(spec: ChainDrive, scene: Start) -> KeyPath:
    """What makes a start quick or slow: the time of its profile, else the torque."""
    if not scene.profile.imposes_speed or spec.scenes is None:
        return torque_key(spec)
    index = [one.label for one in spec.all_scenes].index(scene.label)
    return ("scenes", index, "profile", scene.profile.time_key)


def _profile_repair(spec: ChainDrive, scene: Start) -> KeyPath:
    key = _profile_key(spec, scene)
    return () if key[-1] == "points" else number_at(key, drive_of(spec).motor.start_curve)


# -- strong enough --------------------------------------------------------------------------------------------------


WEAK: Check[ChainDrive, Start] = Check(
    code="CHN120",
    title="starting force reserve",
    question="Can the drive start the loaded chain?",
    failure="starting force is below the required force",
    scenes=frozenset({Start}),
    loads=("starting_reserve",),
    sense=Sense.AT_LEAST,
    limit=fixed(1.0, meaning="1: the drive just moves the chain", valid="any start", source="Newton's law"),
    needs=no_needs,
    blame=lambda spec, scene, loads: torque_key(spec),
    repair=_torque_repair,
    what="The mean starting force at the chain exceeds the resistance at the start, or the force that an imposed speed"
    " requires. With a motor curve, the minimum force up to nine tenths of the rated speed replaces the mean"
    " force.",
    why="A motor that does not move the chain overheats or trips its overload relay.",
    formula="M i eta/R >= W_start                     torque\nM i eta/R >= W_start + (m + m_drive) a    speed",
    source="Newton's law; resistance at the start 1.2 to 1.5 times that in motion by practice",
)

# -- quick enough ---------------------------------------------------------------------------------------------------


def _where_timed(spec: ChainDrive, scene: Start) -> Iterable[AnyCheck]:
    """Where the file gives the limit."""
    return (replace(SLOW, each=None),) if spec.checks.start_time is not None else ()


SLOW: Check[ChainDrive, Start] = Check(
    code="CHN121",
    title="chain starting time",
    question="Does the chain reach full speed within the limit?",
    failure="chain takes too long to start",
    scenes=frozenset({Start}),
    loads=("start_time",),
    sense=Sense.AT_MOST,
    limit=key(
        "checks.start_time",
        meaning="Maximum starting time given in the file",
        valid="starts with a limit",
        source="the motor's data sheet, or the plant's rules",
    ),
    needs=no_needs,
    blame=lambda spec, scene, loads: _profile_key(spec, scene),
    repair=_profile_repair,
    each=_where_timed,
    what="The rigid body reaches the speed of the file within the time limit of the file.",
    why="The motor draws its starting current during the whole start and heats up.",
    formula="J_red w/(M - M_s) <= limit",
    source="lecture notes Kramatorsk 2007; the motor's data sheet",
)

# -- strength -------------------------------------------------------------------------------------------------------


STRENGTH: Check[ChainDrive, Start] = Check(
    code="CHN122",
    hazard=True,
    title="chain safety factor, starting",
    question="Is the breaking load high enough for the peak tension of the start?",
    failure="chain is overloaded during the start",
    scenes=frozenset({Start}),
    loads=("safety_start",),
    sense=Sense.AT_LEAST,
    limit=key(
        "checks.safety_start",
        meaning="Required ratio of breaking load to maximum tension of a start or a stop, from the file or 5",
        valid="starts and stops, which are rare compared with tooth engagements",
        source="manufacturers of conveyor chains: 5 and more for short peaks; handbooks differ",
    ),
    needs=no_needs,
    blame=lambda spec, scene, loads: _hard_start(spec, scene),
    repair=at("chain", "breaking_load"),
    what="The breaking load is at least the safety factor times the maximum tension of the chain entering the sprocket"
    " at the start. This tension includes the static tension and the force that accelerates the chain. It also"
    " includes the oscillation of the elastic chain and the centrifugal tension of full speed.",
    why="The start of a full conveyor after a jam is the highest load in the life of the chain. A torque step produces"
    " twice the force of the rigid body.",
    formula="F_B/(c (S_static + S_dyn,max + m_K V^2)) >= limit",
    source="manufacturers of conveyor chains; the dynamic part derived in ptmcalc.numerics.mode_sum",
)


_HARD = 2.0
"""Starting force relative to the static resistance [1] above which a failed check names the drive as the cause. An
engineering choice: practice ends at 1.8. A smaller value names the drive more often; no verdict depends on it."""


def _hard_start(spec: ChainDrive, scene: Start) -> KeyPath:
    """A motor far too strong, else the chain."""
    case = start_case(spec, scene)
    hard = case.available > _HARD * max(case.line.static_resistance, 0.0) and not case.imposed_speed
    return torque_key(spec) if hard else ("chain", "breaking_load")


# -- slack ----------------------------------------------------------------------------------------------------------


SLACK: Check[ChainDrive, Start] = Check(
    code="CHN123",
    hazard=True,
    title="minimum chain tension, starting",
    question="Does every strand stay taut during the start?",
    failure="chain goes slack during the start",
    scenes=frozenset({Start}),
    loads=("tension_min",),
    sense=Sense.AT_LEAST,
    limit=fixed(
        0.0,
        meaning="0: a chain carries no compression",
        valid="any section of both strands",
        source="a chain has no stiffness in compression",
    ),
    needs=no_needs,
    blame=lambda spec, scene, loads: tension_key(spec),
    repair=lambda spec, scene: tension_key(spec) if isinstance(spec.layout, ConveyorLayout) else (),
    what="Every section of both strands stays in tension at every moment of the start.",
    why="A slack chain leaves its teeth. An impact loads it when it becomes taut again.",
    formula="min over sections and time of S >= 0",
    source="a chain never pushes",
)
