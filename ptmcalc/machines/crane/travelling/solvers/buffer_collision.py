"""A crane that runs onto its buffers."""

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.components.buffer import Stopped, stopped
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import buffer
from ptmcalc.machines.crane.travelling import model
from ptmcalc.machines.crane.travelling.loads import OF_THE_BUFFERS, names
from ptmcalc.machines.crane.travelling.scenes import Collision
from ptmcalc.machines.crane.travelling.spec import Travelling


def run(spec: Travelling, scene: Collision, carried: frozenset[str], level: int) -> Result:
    """Forces, strokes and what speed is left.

        m v^2/2 + P u = E(u):   linear F = P + (P^2 + c m v^2)^(1/2),  constant u = m v^2/(2 (F - P)),  orifice
        v^2 = v_0^2 q + (P/k)(1 - q), q = exp(-2 k u/m);   phi_7 by the energy share xi of the curve

    A load that hangs swings on and does not count, a guided one does. Two cranes that meet with equal buffers are, by
    their motion relative to each other, one of twice the reduced mass and half the speed of both on one of them.

    **Range** a stroke much shorter than a period of the pendulum; wheels that roll, without resistance.
    **Error** exact for those buffers; the rolling resistance is left out, on the safe side.
    **Source** energy; EN 13001-2, ISO 8686-1, SNiP 2.01.07-85 (`laws.buffer`).
    """
    given = spec.buffers
    assert given is not None
    guided = 1.0 if scene.suspension == "guided" else 0.0
    rotor = model.rotor_mass(spec, braking=False)
    mass = buffer.collision_mass(model.travelling_mass(spec) + rotor, model.hanging(spec, scene), guided)
    speed = scene.speed_share * spec.speed
    push = model.driving_force(spec, spec.drive.torque) if scene.drive == "on" else 0.0
    struck, closing, behind = mass, speed, push
    if scene.other_mass is not None:
        reduced, both, pushes = buffer.meeting(mass, scene.other_mass, speed, scene.other_speed, push, push)
        struck, closing, behind = 2 * reduced, both / 2, pushes  # each of two equal buffers in a row takes its half
    hit = stopped(given, struck, closing, behind)
    count = given.count
    loads = {
        "collision_speed": closing,
        "collision_energy": struck * closing**2 / 2,
        "buffer_force": hit.force / count,
        "buffer_stroke": hit.stroke,
        "buffer_speed_left": hit.left,
        "buffer_deceleration": (hit.force - push) / mass,
        "phi7": buffer.buffer_factor(hit.energy_share, spec.classes.buffer_edition),
    }
    found = {name: Found(Estimate.exact(value)) for name, value in loads.items()}
    for name in ("buffer_force", "buffer_deceleration"):
        found[name] = Found(hit.at_least(loads[name]))
    if hit.left:
        found["buffer_stroke"] = Found(Estimate.exact(hit.stroke), note=_bottoms_out(hit))
    return Result(found, work=1, findings=hit.findings(("buffers",)))


def _bottoms_out(hit: Stopped) -> str:
    return f"the buffers bottom out: {units.show(hit.left, units.SPEED)} is left at the end of their stroke"


BUFFER_COLLISION: Solver[Travelling, Collision] = Solver(
    name="buffer_collision",
    title="buffers by the energy of what hits them",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Collision}),
    represents=frozenset(),
    gives=names(OF_THE_BUFFERS) | {"phi7"},
    run=run,
    cost=lambda spec, scene, carried, level: 1e-4,
    source="energy of what moves; EN 13001-2, ISO 8686-1",
)
