"""The steady cycle in steps of the angle: the energy method of the textbook, the motor's torque held at its mean."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import shaft as law
from ptmcalc.machines.shaft.cycle import bounds, impossible, work_balance
from ptmcalc.machines.shaft.cycle.loads import OF_CYCLE
from ptmcalc.machines.shaft.machine.cases import machine_in
from ptmcalc.machines.shaft.machine.model import Machine, split
from ptmcalc.machines.shaft.machine.spec import Shaft, Steady
from ptmcalc.numerics.steps import energy_steps

FloatArray = NDArray[np.float64]

_STEPS = 90
"""Angle steps of a cycle at the first level [1], 4 deg for a full turn; each level doubles them. A numerical choice:
the error decreases with the square of the number, the time grows in proportion."""
_MARGIN = 1.0
"""Factor [1] on the difference of two step sizes in the error bar. Derived: the method is of second order, so the error
of the finer steps is one third of the difference (Richardson). The value 1 leaves a margin of 3; a larger one widens
the bar."""


@dataclass(frozen=True)
class Steps:
    """Inertia and work at the edges of the angle steps of a cycle."""

    inertia: FloatArray
    work: FloatArray
    speed: float

    def speeds(self, added: float) -> FloatArray | None:
        """Speeds at the edges with a flywheel, such that the mean of the largest and the smallest is w_0."""
        inertia = self.inertia + added
        low, high = -float(self.work.min()), float(inertia.max()) * 2 * self.speed**2 - float(self.work.min())
        if self._middle(inertia, low) >= self.speed:
            return None
        for _ in range(200):
            middle = (low + high) / 2
            if not low < middle < high:
                break
            low, high = (middle, high) if self._middle(inertia, middle) < self.speed else (low, middle)
        return energy_steps(inertia, self.work, high)

    def _middle(self, inertia: FloatArray, energy: float) -> float:
        speeds = energy_steps(inertia, self.work, energy)
        return float(speeds.max() + speeds.min()) / 2

    def irregularity(self, added: float) -> float:
        """Irregularity with a flywheel; 2 where the shaft would come to rest."""
        speeds = self.speeds(added)
        return 2.0 if speeds is None else float(law.irregularity(speeds.max(), speeds.min()))

    def flywheel(self, wanted: float) -> float:
        """Inertia to be added for an irregularity, by bisection."""
        if self.irregularity(0.0) <= wanted:
            return 0.0
        low, high = 0.0, float(self.inertia.mean())
        while self.irregularity(high) > wanted:
            low, high = high, 4 * high
        for _ in range(100):
            middle = (low + high) / 2
            if high - low <= 1e-12 * high:
                break
            low, high = (middle, high) if self.irregularity(middle) > wanted else (low, middle)
        return high


def steps_of(machine: Machine, cycle: bounds.Held, count: int) -> Steps:
    """The angle steps of a cycle, about so many, none of them over a break of the load.

    Works by the trapezoidal rule from the torques at both ends of a step.
    """
    edges = split(machine.corners, machine.period / count)
    low, high = edges[:-1], edges[1:]
    ends = (machine.static(side, low, high) for side in (low, high))
    mean = machine.survey.static_mean
    gained = (mean - sum(ends) / 2) * (high - low)
    work = np.concatenate([[0.0], np.cumsum(gained)])
    work = work - work[-1] * (edges - edges[0]) / (edges[-1] - edges[0])  # the mean of the steps closes the cycle
    drive = machine.drive
    inertia = machine.mechanism(edges)[0] + drive.efficiency * drive.ratio**2 * drive.motor_inertia
    return Steps(inertia, work, cycle.speed)


def run(spec: Shaft, scene: Steady, carried: frozenset[str], level: int) -> Result:
    """Speeds at the ends of angle steps from the work of the mean motor torque and of the load.

        w_i = sqrt((J_(i-1) w_(i-1)^2 + 2 A_i)/J_i)   (6.9)

    `level` halves the steps. The mean of maximum and minimum speed is w_0, at which the motor torque equals the mean
    load torque.

    **Range** a motor that drives the mean load, with constant mean torque.
    **Error** second order: the difference to steps of twice the length, and the curvature of the speed between the
    steps.
    **Source** lecture notes Kramatorsk, chapter 6; Richardson's extrapolation for the error.
    """
    machine = machine_in(spec, scene)
    cycle = bounds.held(machine)
    if cycle is None:
        return impossible.stalls(spec, scene)
    count = _STEPS << level
    coarse, fine = (steps_of(machine, cycle, n) for n in (count, 2 * count))
    speeds, rough = fine.speeds(0.0), coarse.speeds(0.0)
    if speeds is None or rough is None:
        return Result({}, work=3 * count)  # held at its mean the motor would let the shaft stop
    bend = float(np.abs(np.diff(speeds, 2)).max()) / 8
    error = [_MARGIN * abs(float(pick(speeds) - pick(rough))) + bend for pick in (np.max, np.min)]
    high, low = float(speeds.max()), float(speeds.min())
    delta = float(law.irregularity(high, low))
    off = sum(error) / cycle.speed
    found = {
        "speed_mean": Estimate.exact(cycle.speed),
        "speed_max": Estimate.within(high, error[0]),
        "speed_min": Estimate.within(low, error[1]),
        "irregularity": Estimate.within(delta, off),
    }
    torque = abs(cycle.motor_torque(cycle.speed))
    found |= {name: Estimate.exact(torque) for name in ("torque_motor_rms", "torque_motor_max")}
    found |= {name: Estimate.exact(value) for name, value in work_balance.works(cycle).items()}
    wanted = spec.checks.irregularity
    if wanted is not None:
        found["flywheel_inertia"] = _flywheel(fine, coarse, wanted, off, delta)
    return Result({name: Found(one) for name, one in found.items()}, work=3 * count)


def _flywheel(fine: Steps, coarse: Steps, wanted: float, off: float, delta: float) -> Estimate:
    """With the error of the irregularity carried over: it falls at least as 1/(J + J_f) does in proportion."""
    if delta + off <= wanted:
        return Estimate.exact(0.0)
    value, rough = fine.flywheel(wanted), coarse.flywheel(wanted)
    whole = value + float(fine.inertia.max())
    error = abs(value - rough) + whole * min(off / delta, 1.0) if delta > 0 else 0.0
    return Estimate(value, max(value - error, 0.0), value + error, numerical=error)


def valid(spec: Shaft, scene: Steady) -> Criterion:
    """Whether the motor carries the mean load.

    **Range** any machine.
    **Error** none: a yes or no.
    **Source** the torque curve of the motor.
    """
    carries = bounds.held(machine_in(spec, scene)) is not None
    return Criterion(
        "m", 0.0 if carries else 1.0, 0.5, "0 if the motor drives the mean load, otherwise 1", "laws.motor"
    )


ENERGY_STEP: Solver[Shaft, Steady] = Solver(
    name="energy_step",
    title="energy method in angle steps, mean motor torque",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Steady}),
    represents=frozenset({"varying_inertia"}),
    gives=OF_CYCLE,
    run=run,
    cost=lambda spec, scene, carried, level: 2e-3 * (1 << level),
    source="lecture notes Kramatorsk, chapter 6",
    valid=valid,
    always=frozenset({"varying_inertia"}),
    levels=3,
)
