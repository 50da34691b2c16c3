"""Motor, elastic gear with play, drum, rope, load and structure, exact from event to event."""

from ptmcalc.contract.result import Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.hoist.machine.spec import Hoist
from ptmcalc.machines.hoist.motion.cases import case_of
from ptmcalc.machines.hoist.motion.effects import ALWAYS, SCENES
from ptmcalc.machines.hoist.motion.loads import MOVING
from ptmcalc.machines.hoist.motion.train import TOLERANCES, Moving


def run(spec: Hoist, scene: Moving, carried: frozenset[str], level: int) -> Result:
    """Loads of a scene with all moving parts.

        J_1 w_1' = M_m - M_g/(u eta),   J_d w_d' = M_g - F R/eta_r,   M y'' = F - Q + N,   m_b z'' = F - K_b z - b_b z'
        M_g = C dz(phi_1/u - phi_d) + damping,   F = max(0, K (R phi_d - s_0 - y - z) + damping)

    **Range** a massless rope of constant length; the structure one mode.
    **Error** as `two_mass`.
    **Source** as `two_mass`; the bridge with mass verified by an independent integration.
    """
    from ptmcalc.machines.hoist.motion import scene as played

    return played.result(scene, case_of(spec, scene, carried), level)


def cost(spec: Hoist, scene: Moving, carried: frozenset[str], level: int) -> float:
    """Seconds predicted from the run there will be."""
    from ptmcalc.machines.hoist.motion import course

    return 1e-3 + course.cost(case_of(spec, scene, carried), level)


TRAIN: Solver[Hoist, Moving] = Solver(
    name="hoist_train",
    title="full hoist train with backlash and structure, event-driven",
    fidelity=Fidelity.TRANSIENT,
    scenes=SCENES,
    represents=ALWAYS | {"structure", "gear_elasticity", "gear_backlash"},
    gives=MOVING,
    run=run,
    cost=cost,
    source="exact propagation of piecewise-linear systems; derived in ptmcalc.numerics.piecewise",
    always=ALWAYS,
    levels=len(TOLERANCES),
    method="exact from event to event",
)
