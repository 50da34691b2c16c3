"""Drive and load on a rope that gets shorter or longer as the drum turns."""

from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.hoist.machine.spec import Hoist, Lift, LowerBrake, Start, Stop
from ptmcalc.machines.hoist.motion.effects import ALWAYS
from ptmcalc.machines.hoist.motion.loads import MOVING
from ptmcalc.machines.hoist.motion.train import Moving


def run(spec: Hoist, scene: Moving, carried: frozenset[str], level: int) -> Result:
    """Loads of a scene in which the drum winds or pays out the strained rope.

        F = K l e + b (elongation rate),   e = (D - s)/s,   s' = -w/(1 + e) hauling,   s' = -w/(1 + e_0) paying out

    s is the unstrained rope between drum and load, D their distance, w the speed of the drum at the hook; the rope paid
    out was wound with the static strain e_0 of the load.

    **Range** a rigid gear without self-locking; a massless rope; no slip on the drum, constant layer and number of
    falls.
    **Error** collocation with a remainder of 1e-12; the error bar is from a run with other time steps. Results are
    accepted only if the energy balance, including the strain wound onto the drum, closes to 1e-9.
    **Source** derived in `numerics.rope.march`; its adiabatic limit is `laws.rope_rod.hauling_gain`.
    """
    from ptmcalc.machines.hoist.motion import rope_case, rope_scene  # for the scenes that call for them

    return rope_scene.result(spec, scene, rope_case.hauled(spec, scene), level)


def cost(spec: Hoist, scene: Moving, carried: frozenset[str], level: int) -> float:
    """Seconds predicted from the run there will be."""
    from ptmcalc.machines.hoist.motion import rope_case, rope_scene

    return rope_scene.cost(spec, scene, rope_case.hauled(spec, scene), level)


def valid(spec: Hoist, scene: Moving) -> Criterion | None:
    """Whether the gear is rigid and does not lock itself, as `rope_case.has_rigid_gear` says it.

    **Range** any scene of motion.
    **Error** as there.
    **Source** as there.
    """
    from ptmcalc.machines.hoist.motion import rope_case

    return rope_case.has_rigid_gear(spec, scene)


ROPE_HAULED: Solver[Hoist, Moving] = Solver(
    name="rope_hauled",
    title="drive and load on a rope of varying length",
    fidelity=Fidelity.TRANSIENT,
    scenes=frozenset({Lift, Start, Stop, LowerBrake}),
    represents=ALWAYS | {"structure", "gear_elasticity", "gear_backlash", "rope_shortening"},
    gives=MOVING,
    run=run,
    cost=cost,
    source="strained rope taken in by the drum; derived in ptmcalc.numerics.rope",
    valid=valid,
    always=ALWAYS | {"rope_shortening"},
)
