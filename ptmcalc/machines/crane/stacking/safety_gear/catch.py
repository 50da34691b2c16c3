"""The safety gear: fall, catch, and what column and carriage feel."""

import math

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import safety_gear
from ptmcalc.machines.crane.stacking.machine.loads import OF_THE_SAFETY_GEAR, names
from ptmcalc.machines.crane.stacking.machine.scenes import SafetyGearScene
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.safety_gear.effects import GEAR
from ptmcalc.machines.crane.stacking.safety_gear.fall import Fall, fall_of
from ptmcalc.machines.crane.stacking.strength.derived import with_derived

_SCENES = frozenset({SafetyGearScene})


def run(spec: Stacker, scene: SafetyGearScene, carried: frozenset[str], level: int) -> Result:
    """Free fall until the governor trips and the safety gear acts, then the stop.

        v_c = k v + g t_r;   progressive: s = v_c^2/(2 (F_c/M - g))
        instantaneous: F = M g + ((M g)^2 + K M v_c^2)^(1/2)

    At the mast foot a sudden force counts twice; moments are proportional to the lever arm of the gear.

    **Range** rope failure while the carriage lowers at full speed; no guide friction.
    **Error** exact for a gear of constant force, and for an elastic one.
    **Source** `laws.safety_gear`.
    """
    gear, one = spec.safety_gear, fall_of(spec, scene)
    assert gear is not None, "the scene has a safety gear"
    foot = safety_gear.axial_shock(one.force) if gear.type == "progressive" else one.force
    loads = {
        "safety_gear_force": one.force,
        "safety_gear_distance": one.distance,
        "safety_gear_factor": one.force / (one.mass * spec.gravity),
        "safety_gear_deceleration": one.deceleration,
        "safety_gear_speed": one.speed,
        "safety_gear_drop": one.drop,
        "safety_gear_moment": safety_gear.eccentric_moment(one.force, abs(gear.arm)),
        "safety_gear_shock": foot,
    }
    found = {name: Found(Estimate.exact(value)) for name, value in loads.items()}
    if one.distance > one.stroke:
        found["safety_gear_distance"] = Found(Estimate.exact(one.distance), note=_too_far(one))
    return Result(with_derived(spec, scene, found), work=1)


def _too_far(one: Fall) -> str:
    if math.isinf(one.distance):
        return "the gear does not hold the weight: the carriage accelerates further"
    return f"its stroke ends before standstill: residual speed {units.show(one.left, units.SPEED)}"


GEAR_CATCH: Solver[Stacker, SafetyGearScene] = Solver(
    name="safety_gear_catch",
    title="free fall and safety gear stop",
    fidelity=Fidelity.FORMULA,
    scenes=_SCENES,
    represents=frozenset({GEAR}),
    gives=names(OF_THE_SAFETY_GEAR) | {"combination_force", "column_stress"},
    run=run,
    cost=lambda spec, scene, carried, level: 1e-4,
    source="free fall and energy; ptmcalc.laws.safety_gear",
    always=frozenset({GEAR}),
)
