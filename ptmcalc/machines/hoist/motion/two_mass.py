"""Drive and load on an elastic rope, exact from event to event; gear and structure rigid."""

from ptmcalc.contract.result import Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.hoist.machine.spec import Hoist
from ptmcalc.machines.hoist.motion.cases import case_of
from ptmcalc.machines.hoist.motion.effects import ALWAYS, SCENES
from ptmcalc.machines.hoist.motion.loads import MOVING
from ptmcalc.machines.hoist.motion.train import TOLERANCES, Moving


def run(spec: Hoist, scene: Moving, carried: frozenset[str], level: int) -> Result:
    """Loads of a scene with the drive as one mass.

        m_1 x'' = F_m - F,   M y'' = F - Q + N,   F = max(0, K (x - s_0 - y) + b (x' - y'))

    The drive keeps its set speed up to its mean starting torque, or follows its curve; losses of gear and reeving
    depend on the direction of power. The brake has a delay and a rise time and holds at standstill.

    **Range** a rigid gear and structure; a massless rope of constant length.
    **Error** exact between events; error bars from runs with other time steps (`motion.loads`), with a smooth curve by
    its tolerance. Results are accepted only if the energy balance closes to 1e-9.
    **Source** derived in `numerics.piecewise` and `numerics.train`; worked cases of lift-off and braking.
    """
    from ptmcalc.machines.hoist.motion import scene as played

    return played.result(scene, case_of(spec, scene, carried & ALWAYS), level)


def cost(spec: Hoist, scene: Moving, carried: frozenset[str], level: int) -> float:
    """Seconds predicted from the run there will be."""
    from ptmcalc.machines.hoist.motion import course

    return course.cost(case_of(spec, scene, carried & ALWAYS), level)


TWO_MASS: Solver[Hoist, Moving] = Solver(
    name="two_mass",
    title="drive and load on an elastic rope, event-driven",
    fidelity=Fidelity.TRANSIENT,
    scenes=SCENES,
    represents=ALWAYS,
    gives=MOVING,
    run=run,
    cost=cost,
    source="exact propagation of piecewise-linear systems; derived in ptmcalc.numerics.piecewise",
    always=ALWAYS,
    levels=len(TOLERANCES),
    method="exact from event to event",
)
