"""Check of the rollback torque of the stopped belt."""

from collections.abc import Iterable, Mapping
from dataclasses import replace

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, LimitState, Sense, no_needs
from ptmcalc.machines.conveyor.brakes import braking
from ptmcalc.machines.conveyor.holding.scenes import asks_for_hold
from ptmcalc.machines.conveyor.spec import (
    Backstop,
    Coast,
    Conveyor,
    ConveyorScene,
    EmergencyStop,
    Hold,
    Run,
    Start,
    Stop,
)

Loads = Mapping[str, Estimate]
Checks = Iterable[AnyCheck]


def _backstop_limit(spec: Conveyor, scene: ConveyorScene) -> Estimate:
    """Holding torque of backstop and closed brakes at the head pulley, divided by the reserve of the backstop.

        M = (M_backstop + sum F_brake R)/reserve

    **Range** a belt at standstill with its drives off: brakes are closed then. Those at the tail are not counted.
    **Error** none: a chosen reserve.
    **Source** practice: reserve 1.25 to 1.75.
    """
    closed = sum(braking(spec, brake).force for brake in spec.brakes.values() if brake.at == "head")
    held = closed * spec.main_drive.drum.diameter / 2
    if spec.backstop is None:
        return Estimate.exact(held / Backstop.model_fields["reserve"].default)
    return Estimate.exact((held + spec.backstop.torque) / spec.backstop.reserve)


def _holding_key(spec: Conveyor) -> KeyPath:
    """The backstop, else the strongest brake at the head."""
    closed = {name: brake for name, brake in spec.brakes.items() if brake.at == "head"}
    if spec.backstop is None and closed:
        return ("brakes", max(closed, key=lambda name: braking(spec, closed[name]).force), "torque")
    return ("backstop", "torque") if spec.backstop else ("backstop",)


BACKSTOP: Check[Conveyor, ConveyorScene] = Check(
    code="CNV109",
    title="belt rollback torque",
    question="Is the rollback torque of the stopped loaded belt held by friction or the backstop?",
    failure="rollback torque exceeds the permissible backstop torque",
    limit_state=LimitState("loaded belt runs back"),
    scenes=frozenset({Hold, Stop, EmergencyStop, Coast, Start, Run}),
    loads=("backstop_torque",),
    sense=Sense.AT_MOST,
    limit=_backstop_limit,
    needs=no_needs,
    each=lambda spec, scene: (replace(BACKSTOP, each=None),) if asks_for_hold(spec, scene) else (),
    blame=lambda spec, scene, loads: _holding_key(spec),
    repair=lambda spec, scene: _holding_key(spec) if spec.backstop or spec.brakes else (),
    what="Idler resistance, backstop and closed brakes hold the force of the load on the stopped belt. The rollback"
    " torque is at most the torque of backstop and brakes, divided by the reserve.",
    why="A belt that rolls back buries its tail and drives the motors backward.",
    formula="(slope resistance of the load - idler friction at standstill) D/2 <= (M_backstop + M_brakes)/reserve",
    source="lecture notes Kramatorsk 2007",
)
