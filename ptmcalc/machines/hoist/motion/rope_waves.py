"""Drive and load on a rope with mass of its own: waves along it, exact from event to event."""

from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.hoist.machine.spec import Hoist, Lift, LowerBrake, Start, Stop
from ptmcalc.machines.hoist.motion.effects import ALWAYS
from ptmcalc.machines.hoist.motion.loads import MOVING
from ptmcalc.machines.hoist.motion.train import Moving


def run(spec: Hoist, scene: Moving, carried: frozenset[str], level: int) -> Result:
    """Loads of a scene with the rope as a rod between drum and load.

        F = f(t - x/c) + g(t + x/c),   v = (f - g)/Z,   Z = (K m_r)^(1/2),   transit (m_r/K)^(1/2)
        F_top = Z (v_drum - z') + 2 g,   F_load = 2 f - Z v_load;   forces are the maximum and minimum along the rope

    At the start of a lift the rope is at rest and the drum runs, so that the rope end starts the first wave. The solver
    includes the inertia of the rope, not its weight, which the loads of steady motion include.

    **Range** a rigid gear without self-locking; a taut rope of constant length without damping: if it goes slack, a
    finding is reported and the results are not used.
    **Error** waves and corners exact, collocation with a remainder of 1e-12 between them; the error bar is from a run
    with other time steps. Results are accepted only if the energy balance, including waves in the rope, closes to 1e-9.
    **Source** J. d'Alembert's solution; derived in `numerics.rope.march`.
    """
    from ptmcalc.machines.hoist.motion import rope_case, rope_scene  # for the scenes that call for them

    return rope_scene.result(spec, scene, rope_case.rod(spec, scene), level)


def cost(spec: Hoist, scene: Moving, carried: frozenset[str], level: int) -> float:
    """Seconds predicted from the run there will be."""
    from ptmcalc.machines.hoist.motion import rope_case, rope_scene

    return rope_scene.cost(spec, scene, rope_case.rod(spec, scene), level)


def valid(spec: Hoist, scene: Moving) -> Criterion | None:
    """Whether the gear is rigid and the rope undamped, as `rope_case.has_rigid_gear_and_no_damping` says it.

    **Range** any scene of motion.
    **Error** as there.
    **Source** as there.
    """
    from ptmcalc.machines.hoist.motion import rope_case

    return rope_case.has_rigid_gear_and_no_damping(spec, scene)


ROPE_WAVES: Solver[Hoist, Moving] = Solver(
    name="rope_waves",
    title="drive and load on a rope with distributed mass, event-driven",
    fidelity=Fidelity.TRANSIENT,
    scenes=frozenset({Lift, Start, Stop, LowerBrake}),
    represents=ALWAYS | {"structure", "gear_elasticity", "gear_backlash", "rope_mass"},
    gives=MOVING,
    run=run,
    cost=cost,
    source="d'Alembert's waves between drive and load; derived in ptmcalc.numerics.rope",
    valid=valid,
    always=ALWAYS | {"rope_mass"},
)
