"""The column that runs into an obstacle: the energy formula of the notes, and the bound that holds for any contact."""

import math

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import buffer, obstacle
from ptmcalc.machines.crane.stacking.machine import model
from ptmcalc.machines.crane.stacking.machine.columns import Swinging, swinging
from ptmcalc.machines.crane.stacking.machine.overhead import OverheadStacker
from ptmcalc.machines.crane.stacking.machine.scenes import ObstacleScene
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.mast.names import CONTACT, FLEXIBLE, MASS
from ptmcalc.machines.crane.stacking.strength.derived import DERIVED, with_derived

SCENES = frozenset({ObstacleScene})
ALWAYS = frozenset({FLEXIBLE, MASS, CONTACT})
GIVES = DERIVED | frozenset({"collision_force", "collision_deflection", "collision_speed", "contact_force"})


def striking(spec: Stacker, scene: ObstacleScene) -> Swinging:
    """What runs into the obstacle."""
    push = model.driving(spec, scene) if scene.drive == "on" else model.stopping(spec, scene)
    return swinging(spec, scene, push.rotors)


def energy(spec: Stacker, scene: ObstacleScene, carried: frozenset[str], level: int) -> Result:
    """Maximum mast force from the full kinetic energy, less the work of the brake.

        F = -W + (W^2 + c (m_1 + m_2) v^2)^(1/2),   x = F/c;   contact: v (k m_2)^(1/2)

    **Range** two masses, a rigid obstacle.
    **Error** no bound: a tip that rebounds shortens the braking distance.
    **Source** N. Yu. Dorokhov, lecture notes, Kramatorsk 2007; `laws.buffer.collision_force`.
    """
    one = striking(spec, scene)
    return _read(spec, scene, one, buffer.WHOLE, _contact(spec, one, model.speed(spec, scene)))


def dead(spec: Stacker, scene: ObstacleScene, carried: frozenset[str], level: int) -> Result:
    """Second reading of the notes: the tip stops at once, and only the masses behind it bend the mast.

        F = -W + (W^2 + c m_1 v^2)^(1/2),   x = F/c

    **Range** two masses, a rigid obstacle; the energy of m_2 is lost in the contact.
    **Error** no bound: a tip that rebounds keeps its energy.
    **Source** N. Yu. Dorokhov, lecture notes, Kramatorsk 2007; `laws.buffer.collision_force`.
    """
    return _read(spec, scene, striking(spec, scene), buffer.TIP_STOPPED, {})


def _read(spec: Stacker, scene: ObstacleScene, one: Swinging, reading: str, more: dict[str, float]) -> Result:
    push, v = model.pushed(spec, scene), model.speed(spec, scene)
    loads = {"collision_speed": v, **more}
    if math.isfinite(push):
        m11, m12, m22 = one.masses
        force = buffer.collision_force(m11 + m12, m12 + m22, one.stiffness, v, -push, reading)
        loads |= {"collision_force": force, "collision_deflection": force / one.stiffness}
    found = {name: Found(Estimate.unknown(value)) for name, value in loads.items()}
    return Result(with_derived(spec, scene, found), work=1)


def _contact(spec: Stacker, one: Swinging, speed: float) -> dict[str, float]:
    assert isinstance(spec, OverheadStacker)
    met = spec.obstacle
    if met is None or met.stiffness is None:
        return {}
    return {"contact_force": obstacle.elastic_contact_force(speed, met.stiffness, one.masses[2])}


def bound(spec: Stacker, scene: ObstacleScene, carried: frozenset[str], level: int) -> Result:
    """Upper bound of the mast force for any contact: all kinetic energy and all work of the drive bend the mast.

        0 <= F <= P + (P^2 + c (m v^2 + 2 E_c))^(1/2),   m of all that travels

    **Range** a brake or a drive of constant force; a drive that follows a ramp has an unlimited force.
    **Error** a bound, reported as an interval from 0. Weights on a suspended mast absorb a part of the energy and never
    add any.
    **Source** derived; `laws.obstacle.column_force_bound`.
    """
    assert isinstance(spec, OverheadStacker)
    one, push, v = striking(spec, scene), model.pushed(spec, scene), model.speed(spec, scene)
    loads = {"collision_speed": Estimate.exact(v)}
    if push < math.inf:
        met = spec.obstacle
        give = 1.0 if met is not None and met.stiffness is not None else 0.0  # a spring: its force over a metre
        contact = met.stiffness if met is not None and met.stiffness is not None else 1.0
        most = obstacle.column_force_bound(one.total, one.stiffness, v, max(push, 0.0), contact, give, 1.0)
        loads["collision_force"] = _below(most)
        loads["collision_deflection"] = _below(most / one.stiffness)
    found = {name: Found(estimate) for name, estimate in loads.items()}
    return Result(with_derived(spec, scene, found), work=1)


def _below(most: float) -> Estimate:
    return Estimate(most, 0.0, most, model=most)


OBSTACLE_ENERGY: Solver[Stacker, ObstacleScene] = Solver(
    name="obstacle_energy",
    title="textbook collision, full kinetic energy less brake work",
    fidelity=Fidelity.FORMULA,
    scenes=SCENES,
    represents=frozenset(),
    gives=GIVES,
    run=energy,
    cost=lambda spec, scene, carried, level: 1e-4,
    source="N. Yu. Dorokhov, lecture notes, Kramatorsk 2007",
    decides=False,
)
OBSTACLE_TIP_STOPPED: Solver[Stacker, ObstacleScene] = Solver(
    name="obstacle_tip_stopped",
    title="textbook collision, mast tip stopped at once",
    fidelity=Fidelity.FORMULA,
    scenes=SCENES,
    represents=frozenset(),
    gives=GIVES - {"contact_force"},
    run=dead,
    cost=lambda spec, scene, carried, level: 1e-4,
    source="N. Yu. Dorokhov, lecture notes, Kramatorsk 2007",
    decides=False,
)
OBSTACLE_BOUND: Solver[Stacker, ObstacleScene] = Solver(
    name="obstacle_bound",
    title="upper bound of the mast force in a collision",
    fidelity=Fidelity.FORMULA,
    scenes=SCENES,
    represents=ALWAYS,
    gives=GIVES - {"contact_force"},
    run=bound,
    cost=lambda spec, scene, carried, level: 1e-4,
    source="derived: energy",
    always=ALWAYS,
)
