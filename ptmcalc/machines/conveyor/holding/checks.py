"""Checks of the stopped belt: rollback torque, and forward torque on falling sections."""

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.components.run_back import USUAL_RESERVE, held_torque, rollback_check
from ptmcalc.contract.check import Check, LimitState, Sense, no_needs, only
from ptmcalc.machines.conveyor.holding.scenes import asks_for_hold, held_forward
from ptmcalc.machines.conveyor.machine.brakes import braking_at_shaft
from ptmcalc.machines.conveyor.machine.scenes import (
    Coast,
    ControlledStop,
    ConveyorScene,
    EmergencyStop,
    Hold,
    Run,
    Start,
    Stop,
)
from ptmcalc.machines.conveyor.machine.spec import Conveyor


def _closed(spec: Conveyor, *places: str) -> float:
    """Torque of the closed brakes at some places on the shaft of the head pulley, without losses of gears [N*m]."""
    force = sum(braking_at_shaft(spec, brake).force for brake in spec.brakes.values() if brake.at in places)
    return force * spec.main_drive.drum.diameter / 2


def _backstop_limit(spec: Conveyor, scene: ConveyorScene) -> Estimate:
    """Holding torque of backstop and closed brakes at the head pulley, divided by the reserve of the backstop.

        M = (M_backstop + sum F_brake R)/reserve

    The losses of a gear between a brake and the pulley are not counted: at standstill they are not guaranteed.

    **Range** a belt at standstill with its drives off: brakes are closed then. Those at the tail are not counted.
    **Error** none: a chosen reserve.
    **Source** practice: reserve 1.25 to 1.75.
    """
    return held_torque(spec.backstop, _closed(spec, "head"))


def _forward_limit(spec: Conveyor, scene: ConveyorScene) -> Estimate:
    """Holding torque of the closed brakes at head and tail, divided by the usual reserve of 1.25.

        M = sum F_brake R/1.25

    A backstop lets the belt run forward, and the losses of gears are not counted.

    **Range** a belt at standstill with its drives off and its brakes closed.
    **Error** none: a chosen reserve.
    **Source** as for backstops; practice: 1.25 to 1.75.
    """
    return Estimate.exact(_closed(spec, "head", "tail") / USUAL_RESERVE)


def _strongest(spec: Conveyor, *places: str) -> KeyPath:
    """The strongest brake at some places; the brakes where none is there."""
    closed = {name: brake for name, brake in spec.brakes.items() if brake.at in places}
    if not closed:
        return ("brakes",)
    return ("brakes", max(closed, key=lambda name: braking_at_shaft(spec, closed[name]).force), "torque")


def _holding_key(spec: Conveyor) -> KeyPath:
    """The backstop, else the strongest brake at the head."""
    if spec.backstop is not None:
        return ("backstop", "torque")
    found = _strongest(spec, "head")
    return found if len(found) > 1 else ("backstop",)


BACKSTOP = rollback_check(
    "CNV109",
    "belt",
    frozenset({Hold, Stop, EmergencyStop, ControlledStop, Coast, Start, Run}),
    asks_for_hold,
    _backstop_limit,
    _holding_key,
    what="Idler resistance, backstop and closed brakes hold the force of the load on the stopped belt. The rollback"
    " torque is at most the torque of backstop and brakes, divided by the reserve. With `stalled_motor: on`, the"
    " backstop also holds the pull of motors that stall at their largest torque.",
    why="A belt that rolls back buries its tail and drives the motors backward.",
    formula="(slope resistance of the load - idler friction at standstill) D/2 <= (M_backstop + M_brakes)/reserve",
)


FORWARD: Check[Conveyor, ConveyorScene] = only(held_forward)(
    Check(
        code="CNV135",
        hazard=True,
        title="belt forward torque at standstill",
        question="Do the closed brakes hold a stopped belt whose load pulls it forward?",
        failure="forward torque exceeds the permissible torque of the brakes",
        limit_state=LimitState("loaded belt runs forward"),
        scenes=frozenset({Hold}),
        loads=("forward_torque",),
        sense=Sense.AT_MOST,
        limit=_forward_limit,
        needs=no_needs,
        blame=lambda spec, scene, loads: _strongest(spec, "head", "tail"),
        repair=lambda spec, scene: _strongest(spec, "head", "tail") if spec.brakes else (),
        what="Idler resistance and the closed brakes hold the force of the load on falling sections. The forward torque"
        " is at most the torque of all brakes, divided by 1.25. A backstop does not act in this direction.",
        why="A loaded belt that starts to move down by itself overfills the chute below and injures persons at it.",
        formula="(slope force of the load - idler friction at standstill) D/2 <= M_brakes/1.25",
        source="balance of the stopped belt; friction at standstill and reserve as for backstops",
    )
)
