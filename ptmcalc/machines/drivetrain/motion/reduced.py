"""The whole train as one rigid shaft, losses by the sign of the torque through each gear."""

from dataclasses import replace

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, Result, of
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.drivetrain.machine.model import case_of, rigid
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain, Run, Start, Stop, TrainScene
from ptmcalc.machines.drivetrain.motion import bars, ending, simulation
from ptmcalc.machines.drivetrain.motion.effects import elasticity_criterion
from ptmcalc.machines.drivetrain.motion.elastic import TOLERANCES
from ptmcalc.machines.drivetrain.motion.loads import MOVING


def run(spec: Drivetrain, scene: TrainScene, carried: frozenset[str], level: int) -> Result:
    """Loads of a scene with rigid links without backlash.

        (sum J_i u_i^2, with efficiencies) e = sum of reduced torques

    The efficiency of a gear depends on the direction of the power of static and inertial torque together. Remaining
    degrees of freedom, such as a clutch or a link to the ground, are included.

    **Range** any train.
    **Error** error bars from runs with other time steps (`bars.loads`); the bound of the effect `elasticity` covers the
    elasticity of the links.
    **Source** lecture notes Kramatorsk 2007 (reduction of masses); efficiency by the total torque, derived in
    `laws.gearing`.
    """
    case = rigid(case_of(spec, scene, backlash=False))
    end = simulation.window(scene, case_of(spec, scene))
    # what elasticity changes is known over the window only
    doublings = ending.DOUBLINGS if spec.effects.get("elasticity") == "off" or not spec.links else 0
    runs, beyond, state = ending.steady_runs(spec, scene, case, end, TOLERANCES[1], doublings)
    end = runs[0].record.time
    fine, loads = runs[0], bars.loads(spec, *runs)
    for name in (*spec.links, *spec.gears):
        index = fine.torque(name)
        if index is not None:
            loads[of("torque_steady", name)] = Found(bars.at_end(spec, name, *runs))
            loads[of("dynamic_factor", name)] = Found(Estimate.exact(1.0))
    broken = simulation.untrusted(spec, scene, fine, TOLERANCES[1])
    if broken is not None:
        loads = {name: Found(Estimate.unknown(found.estimate.value), found.at) for name, found in loads.items()}
    result = Result(
        loads,
        work=sum(course.record.steps for course in runs),
        window=(0.0, fine.record.time),
        health={"energy_residual": fine.ledger.residual, "steps": float(fine.record.steps)},
        findings=(broken,) if broken else (),
        events=simulation.events(fine),
        histories=lambda: simulation.histories(spec, case, end, TOLERANCES[1]),
        beyond=beyond,
        open_end=state,
    )
    return ending.completed(result, spec, scene, fine, TOLERANCES[1])


def cost(spec: Drivetrain, scene: TrainScene, carried: frozenset[str], level: int) -> float:
    """Seconds predicted: what still rings against the ground."""
    case = rigid(case_of(spec, scene, backlash=False))
    return simulation.seconds(case, simulation.window(scene, case_of(spec, scene)))


def valid(spec: Drivetrain, scene: TrainScene) -> Criterion:
    """Whether the links' elasticity is small enough to be left to its bound.

        E < 0.05, the criterion of the effect `elasticity`

    **Range** any train; one whose file leaves elasticity out is rigid whatever E.
    **Error** none: the threshold of the effect.
    **Source** `machines.drivetrain.motion.bounds`.
    """
    number = elasticity_criterion(spec, scene)
    return replace(number, value=0.0) if spec.effects.get("elasticity") == "off" else number


REDUCED: Solver[Drivetrain, TrainScene] = Solver(
    name="reduced",
    title="rigid-train model with bounds for link oscillation",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Run, Start, Stop}),
    represents=frozenset(),
    gives=MOVING,
    run=run,
    cost=cost,
    source="lecture notes Kramatorsk 2007; efficiency by the total torque, ptmcalc.laws.gearing",
    valid=valid,
    method="exact from event to event",
)


def _elastic(spec: Drivetrain, scene: TrainScene) -> Criterion:
    """Whether a richer run decides, beside which the one shaft is shown, if it takes no longer to find than that.

        E >= 0.05

    **Range** any train.
    **Error** none.
    **Source** as `valid`.
    """
    if valid(spec, scene).exceeded and cost(spec, scene, frozenset(), 0) > simulation.BESIDE:
        return Criterion("-", 1.0, 1.0, "the one-shaft model would take too long", "")
    return Criterion(
        "-", 1.0 if not valid(spec, scene).exceeded else 0.0, 1.0, "the one-shaft model decides itself", ""
    )


ONE_SHAFT: Solver[Drivetrain, TrainScene] = replace(
    REDUCED,
    name="one_shaft",
    title="textbook reduction to one shaft",
    valid=_elastic,
    decides=False,
)
