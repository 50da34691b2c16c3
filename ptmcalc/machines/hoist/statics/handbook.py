"""The handbook beside the balance of every sheave: a rope without weight, and one efficiency both ways."""

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import brake, hoisting, reeving, wire_rope
from ptmcalc.machines.hoist.drive import torques
from ptmcalc.machines.hoist.machine import model
from ptmcalc.machines.hoist.machine.model import filled
from ptmcalc.machines.hoist.machine.spec import Hoist, HoistScene, Run


def run(spec: Hoist, scene: HoistScene, carried: frozenset[str], level: int) -> Result:
    """Loads of steady motion by handbook formulas.

        S = (Q + G) g/(m eta_r),   M_d = n S R_last,   M_up = M_d/(u eta),   M_down = M_d eta_r^2 eta/u

    **Range** falls with a rope weight negligible relative to the load; gears of high efficiency.
    **Error** no bound: the rope force is too small by the neglected rope weight; 2 - 1/eta is below eta by (1 -
    eta)^2/eta, so that the computed load on the brake is too large.
    **Source** lecture notes Kramatorsk 2007 and handbooks of lifting machines.
    """
    falls = model.falls_of_a_rope(spec)
    tackle = reeving.tackle_efficiency(falls, filled(spec.reeving.sheave_efficiency)) * model.deflection_efficiency(
        spec
    )
    free = model.hook_mass(spec, scene) * spec.gravity / spec.reeving.falls
    layers = model.wound(spec, spec.height if scene.hook_height is None else scene.hook_height)
    on_drum = hoisting.drum_torque(free / tackle, spec.reeving.ropes, layers.radius)
    loads = {"rope_pull_max": free / tackle, "rope_pull_lowering": free * tackle, "torque_drum": on_drum}
    if spec.rope.breaking_force is not None:
        loads["rope_safety"] = wire_rope.rope_safety(spec.rope.breaking_force, free / tackle)
    if spec.gearbox is not None:
        efficiency, ratio = model.efficiency(spec), spec.gearbox.ratio
        down = hoisting.lowering_torque(on_drum * tackle**2, ratio, efficiency)
        loads["torque_motor_static_up"] = hoisting.hoisting_torque(on_drum, ratio, efficiency)
        loads["torque_motor_static_down"] = down
        if spec.brake is not None and spec.brake.shaft == torques.MOTOR_SHAFT:
            loads["brake_reserve_static"] = brake.brake_reserve(spec.brake.torque, down)
    return Result({name: Found(Estimate.unknown(value)) for name, value in loads.items()}, work=1)


HOIST_HANDBOOK: Solver[Hoist, HoistScene] = Solver(
    name="hoist_handbook",
    title="handbook rope pull and torques",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Run}),
    represents=frozenset(),
    gives=frozenset(
        {
            "rope_pull_max",
            "rope_pull_lowering",
            "rope_safety",
            "torque_drum",
            "torque_motor_static_up",
            "torque_motor_static_down",
            "brake_reserve_static",
        }
    ),
    run=run,
    cost=lambda spec, scene, carried, level: 5e-5,
    source="lecture notes Kramatorsk 2007; handbooks of lifting machines",
    decides=False,
)
