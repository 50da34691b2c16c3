"""Rollback torque of the stopped belt."""

from collections.abc import Iterator
from dataclasses import replace

from ptmcalc.base.estimate import Estimate
from ptmcalc.components.motor_torque import torques_up_to
from ptmcalc.components.run_back import runs_back
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import stopping
from ptmcalc.machines.conveyor.holding.scenes import elsewhere, rest_factor
from ptmcalc.machines.conveyor.machine.model import (
    belt_line,
    special_resistance,
    turns,
)
from ptmcalc.machines.conveyor.machine.resistances import filled
from ptmcalc.machines.conveyor.machine.scenes import Coast, ConveyorScene, EmergencyStop, Hold, Run, Start, Stop
from ptmcalc.machines.conveyor.machine.spec import Conveyor


def hold(spec: Conveyor, scene: ConveyorScene, carried: frozenset[str], level: int) -> Result:
    """Rollback torque of the stopped belt on the head pulley shaft.

        M = (H - r W_idlers) D/2,  not below 0;   r = `rest_factor`

        M = sum n M_max i eta D/(2 R)   for `stalled_motor: on`, if that is larger

    Only rising sections are loaded (worst case), by the loading points of the scene; without a `backstop` scene, those
    of every scene are tried. Only the idler resistance counts at standstill: resistance of loading points, skirt plates
    and cleaners is not guaranteed. The motors of a jammed belt stretch it with their largest torque; once they are
    switched off, the backstop holds that pull.

    **Range** standstill; without the impact of a backstop that engages with backlash.
    **Error** exact except for the friction coefficient.
    **Source** lecture notes Kramatorsk 2007; only rising sections loaded is the worst case of ISO 5048 practice.
    Stalled motors: practice of backstop manufacturers; derived: all of the pull acts on the backstop, no friction
    relieves it.
    """
    force = max(-_rest(spec, one) for one in _standing(spec, scene))
    diameter = spec.main_drive.drum.diameter
    torque = float(stopping.backstop_torque(force, diameter, 1.0))
    if spec.backstop is not None and spec.backstop.stalled_motor == "on":
        torque = max(torque, _stalled_force(spec) * diameter / 2)
    found = Result({"backstop_torque": Found(Estimate.exact(torque))}, work=1)
    if torque <= 0 or spec.backstop is not None or any(brake.at == "head" for brake in spec.brakes.values()):
        return found
    return replace(found, failures=(runs_back("CNV109", "belt", torque),))


def _standing(spec: Conveyor, scene: ConveyorScene) -> Iterator[Hold]:
    """States of the stopped belt that count: as in the scene, and only rising sections loaded."""
    scenes = [scene] if isinstance(scene, Hold) or spec.load.loading_points is None else spec.all_scenes
    for named in dict.fromkeys(one.loading_points for one in scenes if one.load != "empty" or one is scene):
        for load in dict.fromkeys((scene.load, "uphill" if scene.load == "full" else scene.load)):
            yield Hold(load=load, loading_points=named)


def _stalled_force(spec: Conveyor) -> float:
    """Pull of the motors at the head at their largest torque [N]."""
    found = 0.0
    for drive in spec.all_drives.values():
        curve = drive.running_curve
        if drive.at == "head" and curve is not None:
            most = float(torques_up_to(curve, filled(curve.no_load_speed)).max())
            found += drive.motor.count * most * turns(drive) * filled(drive.gear.efficiency)
    return found


def _rest(spec: Conveyor, scene: Hold) -> float:
    """What friction holds beyond what gravity pulls [N]; negative where the belt runs back."""
    line = belt_line(spec, scene)
    friction = line.back.friction[-1] + line.carry.friction[-1] - special_resistance(spec, scene)
    return rest_factor(spec) * friction - line.back.climb[-1] - line.carry.climb[-1]


HOLDING: Solver[Conveyor, ConveyorScene] = Solver(
    name="holding",
    title="rollback torque of the stopped belt",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Hold, Stop, EmergencyStop, Coast, Start, Run}),
    represents=frozenset(),
    gives=frozenset({"backstop_torque"}),
    run=hold,
    cost=lambda spec, scene, carried, level: 2e-4,
    source="lecture notes Kramatorsk 2007",
    valid=elsewhere,
)
