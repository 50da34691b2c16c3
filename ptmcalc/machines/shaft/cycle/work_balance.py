"""The steady cycle from its works alone: the motor's torque held at its mean, the inertia at its mean."""

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.shaft.cycle import bounds, impossible
from ptmcalc.machines.shaft.cycle.loads import OF_CYCLE
from ptmcalc.machines.shaft.machine.cases import machine_in
from ptmcalc.machines.shaft.machine.spec import Shaft, Steady
from ptmcalc.machines.shaft.machine.steady import surely_stalls


def run(spec: Shaft, scene: Steady, carried: frozenset[str], level: int) -> Result:
    """Loads of a cycle with a constant mean drive torque and a constant inertia.

        A_drive = A_useful + A_loss,   dw = Delta_A/(J w_0),   D(w_0) = A_drive/Theta

    A motor stalls if its maximum torque over the cycle does less than the required work: the loss factor is 1.

    **Range** a motor that drives the mean load; the works are exact, the bounds of the effects cover the other loads.
    **Error** no error bar of its own; unbounded if the speed fluctuation exceeds the mean speed.
    **Source** work balance of a cycle (6.10); work fluctuation of the textbook flywheel.
    """
    machine = machine_in(spec, scene)
    cycle = bounds.held(machine)
    if cycle is None:
        return impossible.stalls(spec, scene)
    loads = {name: Estimate.exact(value) for name, value in works(cycle).items()}
    delta = cycle.irregularity
    found = {
        "speed_mean": cycle.speed,
        "irregularity": delta,
        "speed_max": cycle.speed * (1 + delta / 2),
        "speed_min": cycle.speed * (1 - delta / 2),
        "torque_motor_rms": abs(cycle.motor_torque(cycle.speed)),
        "torque_motor_max": abs(cycle.motor_torque(cycle.speed)),
    }
    wanted = spec.checks.irregularity
    if wanted is not None:
        found["flywheel_inertia"] = max(cycle.irregularity / wanted - 1, 0.0) * cycle.inertia
    known = delta < 2
    loads |= {name: Estimate.exact(value) if known else Estimate.unknown(value) for name, value in found.items()}
    return Result({name: Found(estimate) for name, estimate in loads.items()}, work=1)


def works(cycle: bounds.Held) -> dict[str, float]:
    """Works of a cycle and what follows from them."""
    found = bounds.works(cycle.machine, cycle.speed, cycle.speed)
    return {"work_useful": cycle.machine.survey.useful_work} | {name: one.high for name, one in found.items()}


def valid(spec: Shaft, scene: Steady) -> Criterion:
    """Whether the motor carries the mean load, or surely cannot.

    **Range** any machine.
    **Error** none: a yes or no.
    **Source** the torque curve of the motor.
    """
    machine = machine_in(spec, scene)
    decided = bounds.held(machine) is not None or surely_stalls(machine)
    meaning = "0 if the motor drives the mean load, or provably cannot, otherwise 1"
    return Criterion("m", 0.0 if decided else 1.0, 0.5, meaning, "torque curve of the motor")


WORK_BALANCE: Solver[Shaft, Steady] = Solver(
    name="work_balance",
    title="work balance of the cycle at mean torque and inertia",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Steady}),
    represents=frozenset(),
    gives=OF_CYCLE,
    run=run,
    cost=lambda spec, scene, carried, level: 5e-4,
    source="work balance of a cycle; bounds derived in ptmcalc.machines.shaft.cycle.bounds",
    valid=valid,
)
