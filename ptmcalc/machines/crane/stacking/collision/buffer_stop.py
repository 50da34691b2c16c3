"""A stacker crane that runs onto its buffers."""

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.components.buffer import stopped
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import buffer
from ptmcalc.machines.crane.stacking.machine import model
from ptmcalc.machines.crane.stacking.machine.loads import OF_THE_BUFFERS, names
from ptmcalc.machines.crane.stacking.machine.scenes import BufferScene
from ptmcalc.machines.crane.stacking.machine.spec import MECHANISMS, Stacker


def run(spec: Stacker, scene: BufferScene, carried: frozenset[str], level: int) -> Result:
    """Force and stroke of the buffers from the energy of the travelling masses, guided load included.

        m v^2/2 + P u = E(u):   linear F = P + (P^2 + c m v^2)^(1/2),  constant u = m v^2/(2 (F - P)),  orifice
        v^2 = v_0^2 q + (P/k)(1 - q), q = exp(-2 k u/m);   phi_7 by the energy share xi of the curve

    **Range** every buffer of `components.buffer`.
    **Error** exact for a rigid crane; an oscillating mast stores part of the energy, so that force and stroke of
    springs are upper bounds.
    **Source** energy; EN 13001-2, ISO 8686-1 (`laws.buffer`).
    """
    given = model.travel(spec, scene).buffers
    assert given is not None, "the scene has buffers"
    mass, speed, push = _struck(spec, scene)
    hit = stopped(given, mass, speed, push)
    loads = {
        "collision_speed": speed,
        "buffer_force": hit.force / given.count,
        "buffer_stroke": hit.stroke,
        "buffer_speed_left": hit.left,
        "buffer_deceleration": (hit.force - push) / mass,
        "phi7": buffer.buffer_factor(hit.energy_share),
    }
    found = {name: Found(Estimate.exact(value)) for name, value in loads.items()}
    for name in ("buffer_force", "buffer_deceleration"):
        found[name] = Found(hit.at_least(loads[name]))
    if hit.left:
        note = f"the buffers bottom out: residual speed {units.show(hit.left, units.SPEED)} at the end of their stroke"
        found["buffer_stroke"] = Found(Estimate.exact(hit.stroke), note=note)
    key = MECHANISMS[model.mechanism(spec, scene)]
    return Result(
        found,
        work=1,
        findings=hit.findings((key, "buffers")),
        failures=hit.failures("CRN282", given, (key, "buffers")),
    )


def _struck(spec: Stacker, scene: BufferScene) -> tuple[float, float, float]:
    """(mass [kg], speed [m/s], push of the drive [N]) of what runs onto the buffers, the guided load with it."""
    block = model.travel(spec, scene)
    crane = model.carrying_mass(spec, scene) + spec.column.mass + model.climbing_mass(spec, scene)
    crane += model.rotors(block, braking=False) - model.payload(spec, scene)
    mass = buffer.collision_mass(crane, model.payload(spec, scene), 1.0)
    push = 0.0
    if scene.drive == "on":
        drives = model.driving(spec, scene)
        push = drives.size if drives.kind == "force" else drives.size * mass
    return mass, model.speed(spec, scene), push


BUFFER_STOP: Solver[Stacker, BufferScene] = Solver(
    name="buffer_stop",
    title="stacker buffer impact, energy balance",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({BufferScene}),
    represents=frozenset(),
    gives=names(OF_THE_BUFFERS) | {"collision_speed"},
    run=run,
    cost=lambda spec, scene, carried, level: 1e-4,
    source="energy of what moves; EN 13001-2, ISO 8686-1",
)
