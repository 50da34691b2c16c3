"""Check of the rollback torque of the stopped belt."""

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.components.run_back import held_torque, rollback_check
from ptmcalc.machines.conveyor.holding.scenes import asks_for_hold
from ptmcalc.machines.conveyor.machine.brakes import braking
from ptmcalc.machines.conveyor.machine.scenes import Coast, ConveyorScene, EmergencyStop, Hold, Run, Start, Stop
from ptmcalc.machines.conveyor.machine.spec import Conveyor


def _backstop_limit(spec: Conveyor, scene: ConveyorScene) -> Estimate:
    """Holding torque of backstop and closed brakes at the head pulley, divided by the reserve of the backstop.

        M = (M_backstop + sum F_brake R)/reserve

    **Range** a belt at standstill with its drives off: brakes are closed then. Those at the tail are not counted.
    **Error** none: a chosen reserve.
    **Source** practice: reserve 1.25 to 1.75.
    """
    closed = sum(braking(spec, brake).force for brake in spec.brakes.values() if brake.at == "head")
    held = closed * spec.main_drive.drum.diameter / 2
    return held_torque(spec.backstop, held)


def _holding_key(spec: Conveyor) -> KeyPath:
    """The backstop, else the strongest brake at the head."""
    closed = {name: brake for name, brake in spec.brakes.items() if brake.at == "head"}
    if spec.backstop is None and closed:
        return ("brakes", max(closed, key=lambda name: braking(spec, closed[name]).force), "torque")
    return ("backstop", "torque") if spec.backstop else ("backstop",)


BACKSTOP = rollback_check(
    "CNV109",
    "belt",
    frozenset({Hold, Stop, EmergencyStop, Coast, Start, Run}),
    asks_for_hold,
    _backstop_limit,
    _holding_key,
    what="Idler resistance, backstop and closed brakes hold the force of the load on the stopped belt. The rollback"
    " torque is at most the torque of backstop and brakes, divided by the reserve. With `stalled_motor: on`, the"
    " backstop also holds the pull of motors that stall at their largest torque.",
    why="A belt that rolls back buries its tail and drives the motors backward.",
    formula="(slope resistance of the load - idler friction at standstill) D/2 <= (M_backstop + M_brakes)/reserve",
)
