"""Checks of a stop: distance, time, brake torque."""

import math
from collections.abc import Iterable, Mapping

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, LimitState, Sense, no_needs, only
from ptmcalc.contract.limits import key
from ptmcalc.machines.conveyor.machine.brakes import brakes_of, braking
from ptmcalc.machines.conveyor.machine.drives import moving_mass, running
from ptmcalc.machines.conveyor.machine.scenes import Coast, ControlledStop, ConveyorScene, EmergencyStop, Stop
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.stopping.controlled import time_key

Loads = Mapping[str, Estimate]
Checks = Iterable[AnyCheck]

_HOUR = 3600.0
"""Stopping time [s] that fails where the file states no limit; an engineering choice. A belt that runs on for so long
counts as one that does not stop."""


def _stop_limit(spec: Conveyor, scene: ConveyorScene) -> Estimate:
    """Permissible stopping distance given in the file for the type of stop.

    **Range** a stop or an emergency stop with a limit.
    **Error** none: a chosen limit.
    **Source** the plant's safety rules.
    """
    return Estimate.exact(spec.stop_distance_limit(scene) or math.inf)


def _limited(spec: Conveyor, scene: ConveyorScene) -> bool:
    return spec.stop_distance_limit(scene) is not None


def _brake_key(spec: Conveyor, scene: ConveyorScene) -> KeyPath:
    acting = brakes_of(spec, scene)
    if not acting:
        return ("brakes",)
    return ("brakes", max(acting, key=lambda name: braking(spec, acting[name]).force), "torque")


def _brake_repair(spec: Conveyor, scene: ConveyorScene) -> KeyPath:
    if isinstance(scene, ControlledStop):
        return time_key(spec, scene)
    return _brake_key(spec, scene) if brakes_of(spec, scene) else ()


def _time_key(spec: Conveyor, scene: ConveyorScene) -> KeyPath:
    """What must hold the belt: its strongest brake; without one the limit that no brake was asked to keep; in a
    controlled stop its duration."""
    if isinstance(scene, ControlledStop):
        return time_key(spec, scene)
    if brakes_of(spec, scene) or spec.checks.stop_time is None:
        return _brake_key(spec, scene)
    return ("checks", "stop_time")


def _stop_key(spec: Conveyor, scene: ConveyorScene) -> KeyPath:
    """The latest brake's delay or rise, where full torque from the first moment would stop the rigid body in time; else
    the strongest brake's torque; in a controlled stop its duration."""
    if isinstance(scene, ControlledStop):
        return time_key(spec, scene)
    acting, limit = brakes_of(spec, scene), spec.stop_distance_limit(scene)
    line = running(spec, scene)
    force = line.static_resistance + line.tail_pull + sum(braking(spec, brake).force for brake in acting.values())
    if acting and limit is not None and moving_mass(line) * line.speed**2 <= 2 * force * limit:
        name = max(acting, key=lambda name: acting[name].delay + acting[name].rise_time / 2)
        late = acting[name]
        if late.delay or late.rise_time:
            return ("brakes", name, "delay" if late.delay >= late.rise_time / 2 else "rise_time")
    return _brake_key(spec, scene)


def _stop_repair(spec: Conveyor, scene: ConveyorScene) -> KeyPath:
    held = brakes_of(spec, scene) or isinstance(scene, ControlledStop)
    return _stop_key(spec, scene) if held else ()


STOP: Check[Conveyor, ConveyorScene] = only(_limited)(
    Check(
        code="CNV106",
        hazard=True,
        title="belt stopping distance",
        question="Does the belt at the head stop within the permissible distance?",
        failure="belt stopping distance is too long",
        scenes=frozenset({Stop, EmergencyStop, ControlledStop}),
        loads=("stop_distance_max",),
        sense=Sense.AT_MOST,
        limit=_stop_limit,
        needs=no_needs,
        blame=lambda spec, scene, loads: _stop_key(spec, scene),
        repair=_stop_repair,
        what="Every point of the belt stops within the distance given in the file. The criterion applies at the head,"
        " at the tail and between them.",
        why="A long stopping distance overfills the chute below and endangers persons caught by the belt. The tail of a"
        " long belt continues at full speed until the wave of the brake arrives.",
        formula="max over the belt of the integral of v dt until v = 0 <= limit",
        source="the plant's safety rules",
    )
)


def _where_timed(spec: Conveyor, scene: ConveyorScene) -> Checks:
    """Every stop; a run-out only with a limit."""
    held = not isinstance(scene, Coast) or spec.checks.stop_time is not None
    return (STOP_TIME,) if held else ()


STOP_TIME: Check[Conveyor, ConveyorScene] = Check(
    code="CNV107",
    title="belt stopping time",
    question="Does the belt at the head come to rest within the limit, or at all?",
    failure="belt takes too long to stop",
    limit_state=LimitState("belt does not stop"),
    scenes=frozenset({Stop, EmergencyStop, ControlledStop, Coast}),
    loads=("stop_time",),
    sense=Sense.AT_MOST,
    limit=key(
        "checks.stop_time",
        meaning="Permissible stopping time given in the file; one hour without it, after which the belt counts as not"
        " stopping",
        valid="any stop; a coasting stop only if the file gives the limit",
        source="the plant's rules",
        absent=_HOUR,
    ),
    needs=no_needs,
    blame=lambda spec, scene, loads: _time_key(spec, scene),
    repair=_brake_repair,
    each=_where_timed,
    what="The belt at the head stops within the time given in the file. Without that time, a belt that moves longer"
    " than one hour counts as not stopping.",
    why="Conveyors that feed one another must stop in sequence; otherwise the transfer points block. A load that"
    " lowers itself against too weak brakes runs away.",
    formula="t(v = 0) <= limit",
    source="the plant's rules; balance of the whole belt",
)


def _brake_limit(spec: Conveyor, scene: ConveyorScene) -> Estimate:
    """Torque of all acting brakes on the shaft of the head pulley.

        M = sum F_brake R

    **Range** brakes at full torque; the simulated stopping distance (CNV106) includes delay and rise.
    **Error** that of the gear's efficiency, which is an input.
    **Source** `motion.braking`.
    """
    forces = sum(braking(spec, brake).force for brake in brakes_of(spec, scene).values())
    return Estimate.exact(forces * spec.main_drive.drum.diameter / 2)


BRAKE: Check[Conveyor, ConveyorScene] = only(_limited)(
    Check(
        code="CNV108",
        hazard=True,
        title="required brake torque",
        question="Is the total brake torque enough to stop within the permissible distance?",
        failure="brake torque is too low for the stopping distance",
        scenes=frozenset({Stop, EmergencyStop}),
        loads=("brake_torque_required",),
        sense=Sense.AT_MOST,
        limit=_brake_limit,
        needs=no_needs,
        blame=lambda spec, scene, loads: _brake_key(spec, scene),
        repair=_brake_repair,
        what="The total brake torque is at least the torque that stops the rigid body within the distance given in the"
        " file.",
        why="A brake sized without the sign of the resistance is too weak downhill and unnecessarily severe uphill.",
        formula="(m v^2/(2 s) - W) R <= sum M_brake on the drum shaft",
        source="lecture notes Kramatorsk 2007, in the signed form",
    )
)
