"""The train as it is: elastic links, play, friction, propagated exactly from event to event."""

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, Result, of
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.drivetrain.machine.model import case_of, rigid
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain, Run, Start, Stop, TrainScene
from ptmcalc.machines.drivetrain.motion import bars, ending, simulation
from ptmcalc.machines.drivetrain.motion.loads import MOVING

TOLERANCES = (1e-6, 1e-8, 1e-10)
"""Largest remainder of a nonlinear torque by level, relative to its size [1]. A numerical choice: a smaller value
narrows the error bar and takes more steps."""


def run(spec: Drivetrain, scene: TrainScene, carried: frozenset[str], level: int) -> Result:
    """Loads of a scene with all links elastic; without the effect `backlash` the links have no backlash.

        J_i w_i' = sum of torques,   link torque by its law of contact,   friction set-valued

    Between two events the system is linear and propagated by the matrix exponential; smooth torque curves are iterated
    as polynomials of time. Contacts, sticking and slipping change at roots of the exact solution.

    **Range** any train; a chattering contact ends the run after 20 000 events.
    **Error** error bars from runs with other time steps (`bars.loads`); results are accepted only if the energy balance
    closes to 1e-9, with a nonlinear torque to ten times the tolerance.
    **Source** derived in `numerics.piecewise` and `numerics.train`; verified by independent integrations.
    """
    case = case_of(spec, scene, "backlash" in carried)
    tolerance = TOLERANCES[level]
    runs, beyond, state = ending.steady_runs(spec, scene, case, simulation.window(scene, case), tolerance)
    fine, loads = runs[0], bars.loads(spec, *runs)
    end = fine.record.time
    findings = list(simulation.remarks(scene, fine))
    broken = simulation.untrusted(spec, scene, fine, tolerance)
    if broken is not None:
        findings.append(broken)
        loads = {name: Found(Estimate.unknown(found.estimate.value), found.at) for name, found in loads.items()}
    loads |= _against_rigid(spec, scene, loads, end)
    result = Result(
        loads,
        work=sum(course.record.steps for course in runs),
        window=(0.0, fine.record.time),
        health={"energy_residual": fine.ledger.residual, "steps": float(fine.record.steps)},
        findings=tuple(findings),
        events=simulation.events(fine),
        histories=lambda: simulation.histories(spec, case, end, tolerance),
        beyond=beyond,
        open_end=state,
    )
    return ending.completed(result, spec, scene, fine, tolerance)


def _against_rigid(spec: Drivetrain, scene: TrainScene, loads: dict[str, Found], end: float) -> dict[str, Found]:
    """Largest torques over those of the rigid train, and its torque at the end; none where that would take long, as
    with a stiff undamped link to the ground."""
    case = rigid(case_of(spec, scene, False))
    if simulation.seconds(case, end) > simulation.BESIDE:
        return {}
    runs = bars.played(case, end, TOLERANCES[0])
    of_rigid = bars.loads(spec, *runs)
    found = {}
    for name in (*spec.links, *spec.gears):
        peak, whole = loads.get(of("torque_peak", name)), of_rigid.get(of("torque_peak", name))
        if peak is None or whole is None:
            continue
        found[of("torque_steady", name)] = Found(bars.at_end(spec, name, *runs))
        one, part = peak.estimate, whole.estimate
        if part.low > 0:
            low, high = one.low / (part.high if one.low > 0 else part.low), one.high / part.low
            factor = Estimate(one.value / part.value, low, high, one.numerical / part.low)
            found[of("dynamic_factor", name)] = Found(factor, peak.at)
    return found


def cost(spec: Drivetrain, scene: TrainScene, carried: frozenset[str], level: int) -> float:
    """Seconds predicted: panels of the vibrations as long as they must be resolved, and a few events for every play.

    A component fades with its damping, so a stiff link that is damped costs no more than a soft one.
    """
    case = case_of(spec, scene, "backlash" in carried)
    return 4e-3 + simulation.seconds(case, simulation.window(scene, case)) * (1 + level / 2)


ELASTIC: Solver[Drivetrain, TrainScene] = Solver(
    name="elastic",
    title="elastic train with backlash, event-driven exact solution",
    fidelity=Fidelity.TRANSIENT,
    scenes=frozenset({Run, Start, Stop}),
    represents=frozenset({"elasticity", "backlash"}),
    gives=MOVING,
    run=run,
    cost=cost,
    source="exact propagation of piecewise-linear systems; derived in ptmcalc.numerics.piecewise",
    always=frozenset({"elasticity"}),
    levels=len(TOLERANCES),
    method="exact from event to event",
)
