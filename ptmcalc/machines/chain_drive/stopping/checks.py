"""Checks of a chain that stops or changes its speed: way, time, brake, slack, strength, what runs back."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import replace

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.components.run_back import held_torque, rollback_check
from ptmcalc.contract.check import AnyCheck, Check, LimitState, Sense, at, blames, no_needs
from ptmcalc.contract.limits import fixed, key
from ptmcalc.machines.chain_drive.holding.scenes import asks_for_hold
from ptmcalc.machines.chain_drive.machine.layout import ConveyorLayout
from ptmcalc.machines.chain_drive.machine.spec import (
    ChainDrive,
    ChainScene,
    Coast,
    EmergencyStop,
    Hold,
    Run,
    SpeedRange,
    Start,
    Stop,
    Stopping,
)
from ptmcalc.machines.chain_drive.stopping.motion import acting_brake, allowed_way, stop_case
from ptmcalc.spec.scene import Scene

Loads = Mapping[str, Estimate]
Checks = Iterable[AnyCheck]

_BRAKED: frozenset[type[Scene]] = frozenset({Stop, EmergencyStop})
_STOPS: frozenset[type[Scene]] = _BRAKED | {Coast}
_HOUR = 3600.0
"""Stopping time [s] that fails where the file states no limit; an engineering choice. A chain that runs on for so long
counts as one that does not stop."""


def _brake_key(spec: ChainDrive, scene: ChainScene) -> KeyPath:
    """The brake's torque, or where a brake would stand."""
    return ("brake", "torque") if acting_brake(spec, scene) is not None else ("brake",)


def _brake_repair(spec: ChainDrive, scene: ChainScene) -> KeyPath:
    return ("brake", "torque") if acting_brake(spec, scene) is not None else ()


def _way_key(spec: ChainDrive, scene: Stopping) -> KeyPath:
    """The brake's delay or rise, where full torque from the first moment would stop the chain in time; else its
    torque."""
    brake, limit = acting_brake(spec, scene), allowed_way(spec, scene)
    if brake is None or limit is None:
        return _brake_key(spec, scene)
    case = stop_case(spec, scene)
    at_once = replace(case, brake=brake.model_copy(update={"delay": 0.0, "rise_time": 0.0}))
    if (brake.delay or brake.rise_time) and at_once.rest()[1] <= limit:
        return ("brake", "delay" if brake.delay >= brake.rise_time / 2 else "rise_time")
    return _brake_key(spec, scene)


# -- way and time ---------------------------------------------------------------------------------------------------


def _way_limit(spec: ChainDrive, scene: Stopping) -> Estimate:
    """Permissible stopping distance given in the file for the type of stop.

    **Range** a stop or an emergency stop with a limit.
    **Error** none: a chosen limit.
    **Source** the plant's safety rules.
    """
    return Estimate.exact(allowed_way(spec, scene) or math.inf)


def _where_limited(spec: ChainDrive, scene: Stopping, check: AnyCheck) -> Checks:
    """Where the file gives the way."""
    return (replace(check, each=None),) if allowed_way(spec, scene) is not None else ()


WAY: Check[ChainDrive, Stopping] = Check(
    code="CHN124",
    hazard=True,
    title="chain stopping distance",
    question="Does the chain stop within the permissible distance?",
    failure="chain stopping distance is too long",
    scenes=_BRAKED,
    loads=("stop_distance",),
    sense=Sense.AT_MOST,
    limit=_way_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: _way_key(spec, scene),
    repair=lambda spec, scene: _way_key(spec, scene) if acting_brake(spec, scene) is not None else (),
    each=lambda spec, scene: _where_limited(spec, scene, WAY),
    what="With the lowest possible resistance, the chain stops within the distance given in the file.",
    why="A long stopping distance endangers persons caught by the chain and overfills the next conveyor.",
    formula="s = integral of v dt until v = 0 <= limit",
    source="the plant's safety rules",
)


def _where_timed(spec: ChainDrive, scene: Stopping) -> Checks:
    """Every stop; a run-out with a limit, or one that runs away."""
    held = not isinstance(scene, Coast) or spec.checks.stop_time is not None
    held = held or math.isinf(stop_case(spec, scene).rest()[0])
    return (replace(TIME, each=None),) if held else ()


TIME: Check[ChainDrive, Stopping] = Check(
    code="CHN125",
    title="chain stopping time",
    question="Does the chain come to rest within the limit, or at all?",
    failure="chain takes too long to stop",
    limit_state=LimitState("chain does not stop"),
    scenes=_STOPS,
    loads=("stop_time",),
    sense=Sense.AT_MOST,
    limit=key(
        "checks.stop_time",
        meaning="Permissible stopping time given in the file; one hour without it, after which the chain counts as not"
        " stopping",
        valid="any stop; a coasting stop if the file gives the limit or the chain runs away",
        source="the plant's rules",
        absent=_HOUR,
    ),
    needs=no_needs,
    blame=lambda spec, scene, loads: _brake_key(spec, scene),
    repair=_brake_repair,
    each=_where_timed,
    what="The chain stops within the time given in the file. Without that time, a chain that moves longer than one"
    " hour counts as not stopping.",
    why="When the drive is off, a descending loaded chain runs away if its resistance does not hold it.",
    formula="t(v = 0) <= limit",
    source="the plant's rules; balance of the rigid chain",
)


def _torque_limit(spec: ChainDrive, scene: Stopping) -> Estimate:
    """Torque of the brake on the motor shaft; one on the sprocket shaft through the gear without losses.

        M = M_brake,   M_brake/i on the sprocket shaft

    **Range** a brake at full torque; the stopping distance (CHN124) includes delay and rise.
    **Error** none for a brake on the motor shaft; on the sprocket shaft the gear losses are neglected.
    **Source** the manufacturer's data.
    """
    brake = acting_brake(spec, scene)
    if brake is None:
        return Estimate.exact(0.0)
    return Estimate.exact(brake.torque if brake.shaft == "motor" else brake.torque / stop_case(spec, scene).ratio)


TORQUE: Check[ChainDrive, Stopping] = Check(
    code="CHN126",
    hazard=True,
    title="required brake torque",
    question="Is the brake torque enough to stop within the permissible distance?",
    failure="brake torque is too low for the stopping distance",
    scenes=_BRAKED,
    loads=("brake_torque_required",),
    sense=Sense.AT_MOST,
    limit=_torque_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: _brake_key(spec, scene),
    repair=_brake_repair,
    each=lambda spec, scene: _where_limited(spec, scene, TORQUE),
    what="The brake torque is at least the torque that stops the rigid chain within the distance given in the file.",
    why="A brake sized without the sign of the resistance is too weak downhill and unnecessarily severe uphill.",
    formula="F_b R e/i + J a i/R <= M_brake,   F_b = m a - W,   a = v^2/(2 s)",
    source="lecture notes Kramatorsk 2007, in the signed form",
)

# -- what it does to the chain --------------------------------------------------------------------------------------


_TENSION: KeyPath = ("layout", "takeup", "tension")


def _of_conveyors(spec: ChainDrive, scene: Stopping) -> Checks:
    """Conveyors; between two shafts the other strand takes over where one goes slack."""
    return (replace(SLACK, each=None),) if isinstance(spec.layout, ConveyorLayout) else ()


SLACK: Check[ChainDrive, Stopping] = Check(
    code="CHN127",
    hazard=True,
    title="minimum chain tension, stopping",
    question="Does every strand stay taut until the chain is at rest?",
    failure="chain goes slack during the stop",
    scenes=_STOPS,
    loads=("tension_min",),
    sense=Sense.AT_LEAST,
    limit=fixed(
        0.0,
        meaning="0: a chain carries no compression",
        valid="any section of both strands",
        source="a chain has no stiffness in compression",
    ),
    needs=no_needs,
    blame=lambda spec, scene, loads: _TENSION,
    repair=lambda spec, scene: _TENSION,
    each=_of_conveyors,
    what="Every section of both strands stays in tension from the switch-off of the motors until the chain is at"
    " standstill.",
    why="A slack chain leaves its teeth and folds where it is pushed. An impact loads it in the next start.",
    formula="min over sections and time of S >= 0",
    source="a chain never pushes",
)


STRENGTH: Check[ChainDrive, ChainScene] = Check(
    code="CHN128",
    hazard=True,
    title="chain safety factor, stop or speed change",
    question="Is the breaking load high enough for the peak tension of a stop or a speed sweep?",
    failure="chain is overloaded during the stop or speed change",
    scenes=_STOPS | {SpeedRange},
    loads=("safety_start",),
    sense=Sense.AT_LEAST,
    limit=key(
        "checks.safety_start",
        meaning="Required ratio of breaking load to maximum tension of a stop or a speed change, from the file or 5",
        valid="stops and speed changes, which are rare compared with tooth engagements",
        source="manufacturers of conveyor chains: 5 and more for short peaks; handbooks differ",
    ),
    needs=no_needs,
    blame=blames("chain", "breaking_load"),
    repair=at("chain", "breaking_load"),
    what="The breaking load is at least the safety factor times the maximum tension of a stop or a speed sweep. The"
    " sweep includes the resonances in its range of speeds. The tension includes the centrifugal tension of full"
    " speed.",
    why="A brake at the upper end of a descent stops the whole load through the strand below it. Teeth that pass at a"
    " natural frequency excite large chain oscillations within a few revolutions.",
    formula="F_B/(c (S_static + S_dyn,max + m_K V^2)) >= limit",
    source="manufacturers of conveyor chains; tensions derived in ptmcalc.numerics.mode_sum and run_through",
)

# -- standstill -----------------------------------------------------------------------------------------------------


def _hold_limit(spec: ChainDrive, scene: ChainScene) -> Estimate:
    """Holding torque of backstop and closed brake on the sprocket shaft, divided by the reserve of the backstop.

        (M_backstop + M_brake i)/reserve,   i = 1 for a brake on the sprocket shaft

    **Range** a chain at standstill with the drive off and the brake closed.
    **Error** none: a chosen reserve; the gear losses, which help to hold, are neglected.
    **Source** practice: reserve 1.25 to 1.75.
    """
    return held_torque(spec.backstop, _closed(spec))


def _closed(spec: ChainDrive) -> float:
    """Torque of the closed brake on the sprocket shaft [N*m]; none on a motor without its gear in the file."""
    if spec.brake is None:
        return 0.0
    if spec.brake.shaft == "sprocket":
        return spec.brake.torque
    return spec.brake.torque * spec.drive.gear.ratio if spec.drive is not None else 0.0


def _hold_key(spec: ChainDrive) -> KeyPath:
    """The torque of the backstop, else of the closed brake, else where a backstop would stand."""
    if spec.backstop is not None:
        return ("backstop", "torque")
    return ("brake", "torque") if _closed(spec) > 0 else ("backstop",)


HELD = rollback_check(
    "CHN129",
    "chain",
    _STOPS | {Hold, Start, Run},
    asks_for_hold,
    _hold_limit,
    _hold_key,
    what="Friction, the backstop and the closed brake hold the rollback torque of the loaded chain with the reserve of"
    " the backstop, 1.25 by default.",
    why="A conveyor that rolls back buries its tail, drives the motors backward and breaks off its flights.",
    formula="(q_G g H - W_friction at its lowest) R <= (M_backstop + M_brake i)/reserve",
)

CHECKS_OF_STOPS: tuple[AnyCheck, ...] = (WAY, TIME, TORQUE, SLACK, STRENGTH, HELD)
