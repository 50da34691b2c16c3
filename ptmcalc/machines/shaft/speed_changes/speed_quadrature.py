"""A run-up with constant inertia and resistance: an integral over the speed."""

import math

import numpy as np

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.shaft.machine.cases import machine_in
from ptmcalc.machines.shaft.machine.model import Machine
from ptmcalc.machines.shaft.machine.spec import RunUp, Shaft
from ptmcalc.machines.shaft.speed_changes import run_up_bounds
from ptmcalc.machines.shaft.speed_changes.cases import target_speed
from ptmcalc.machines.shaft.speed_changes.failures import never_up
from ptmcalc.machines.shaft.speed_changes.loads import OF_RUN_UP


def run(spec: Shaft, scene: RunUp, carried: frozenset[str], level: int) -> Result:
    """Time and angle of a run-up with the mean inertia and the mean torques over the angle.

        t = integral of J dw/(D(w) - b w - R),   phi = integral of w dt

    **Range** a motor with a torque that depends on its speed alone and drives throughout.
    **Error** the load anywhere between its extremes over the angle is the bar; infinite where one of them stalls the
    motor. The quadrature itself is good to ten digits.
    **Source** Newton's law, separated.
    """
    machine, target = machine_in(spec, scene), target_speed(spec, scene)
    starting = {name: Found(Estimate.exact(value)) for name, value in at_rest(machine, scene.start).items()}
    survey, drive = machine.survey, machine.drive
    inertia = survey.inertia_mean + drive.efficiency * drive.ratio**2 * drive.motor_inertia
    values = run_up_bounds.start_integrals(machine, target, inertia, survey.static_mean, 0.0)
    ranges = run_up_bounds.run_up_ranges(machine, target, changing=False)
    stuck = starting["acceleration_starting"].estimate.value <= 0
    loads = {}
    for value, (name, held) in zip(values, ranges.items(), strict=True):
        loads[name] = Estimate.exact(math.inf) if stuck else _between(value, held.low, held.high)
    never = loads["run_up_time"].low == math.inf
    failures = never_up(spec, machine, target) if never else ()
    return Result({name: Found(estimate) for name, estimate in loads.items()} | starting, work=1, failures=failures)


def _between(value: float, low: float, high: float) -> Estimate:
    if not math.isfinite(value):  # infinite less infinite is no number
        return Estimate(value, low, high, 0.0, 0.0 if low == high else math.inf)
    rounding = 1e-9 * value
    return Estimate(value, low - rounding, high + rounding, rounding, max(high - value, value - low))


def at_rest(machine: Machine, angle: float) -> dict[str, float]:
    """Torque of the motor at rest on the main shaft [N*m] and the acceleration it gives there [rad/s^2]."""
    place = np.array([angle % machine.period])
    corners = machine.corners
    cell = int(np.clip(np.searchsorted(corners, place[0] + 1e-12, side="right") - 1, 0, len(corners) - 2))
    drive = machine.drive
    torque = drive.torque(0, np.zeros(1), np.zeros(1))
    inertia, _, resistance = machine.fields(place, corners[cell], corners[cell + 1])
    factor = drive.factor(torque, inertia, resistance)
    net = drive.ratio * factor * torque - resistance
    return {
        "torque_starting": float((drive.ratio * factor * torque)[0]),
        "acceleration_starting": max(float((net / machine.total_inertia(inertia, factor))[0]), 0.0),
    }


def valid(spec: Shaft, scene: RunUp) -> Criterion:
    """Whether the torque depends on the speed alone and drives all the way.

    **Range** any machine.
    **Error** none: a yes or no.
    **Source** the torque curve of the motor.
    """
    machine = machine_in(spec, scene)
    fits = (
        machine.sound
        and not machine.drive.time_dependent
        and run_up_bounds.drives_all_the_way(machine, target_speed(spec, scene), 0.0)
    )
    meaning = "0 for a torque that depends on the speed alone and never brakes, otherwise 1"
    return Criterion("m", 0.0 if fits else 1.0, 0.5, meaning, "torque curve of the motor")


SPEED_QUADRATURE: Solver[Shaft, RunUp] = Solver(
    name="speed_quadrature",
    title="run-up, integration over the speed",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({RunUp}),
    represents=frozenset(),
    gives=OF_RUN_UP,
    run=run,
    cost=lambda spec, scene, carried, level: 2e-3,
    source="Newton's law, separated; bounds derived in ptmcalc.machines.shaft.speed_changes.run_up_bounds",
    valid=valid,
)
