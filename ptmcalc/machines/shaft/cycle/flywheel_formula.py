"""The textbook flywheel: shown beside the one found on the simulated cycle, never judged."""

import math

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import shaft as law
from ptmcalc.machines.shaft.machine.cases import cycle_of
from ptmcalc.machines.shaft.machine.model import Machine
from ptmcalc.machines.shaft.machine.spec import Shaft, Steady


def run(spec: Shaft, scene: Steady, carried: frozenset[str], level: int) -> Result:
    """Speed fluctuation and additional inertia from the work fluctuation under a constant motor torque.

        delta = Delta_A/(J w^2),   J_f = Delta_A/(delta w^2) - J

    w is the mean speed of the steady cycle, J the minimum inertia over the angle: the variable part is neglected.

    **Range** a motor with a torque independent of the speed within the cycle; small changes of the inertia.
    **Error** no bound: with an active motor slope the inertia is 50 % too large. The formula never decides a verdict.
    **Source** `laws.shaft.flywheel_inertia`.
    """
    cycle = cycle_of(spec, scene.load)
    assert cycle is not None, "valid only if there is a cycle"
    (low, _), (high, _) = cycle.orbit.extremes()
    speed = (math.sqrt(2 * low) + math.sqrt(2 * high)) / 2
    inertia, swing = least_inertia(cycle.machine), cycle.machine.survey.work_swing
    loads = {"irregularity": swing / inertia / speed**2}
    wanted = spec.checks.irregularity
    if wanted is not None:
        loads["flywheel_inertia"] = float(law.flywheel_inertia(swing, wanted, speed, inertia))
    return Result({name: Found(Estimate.unknown(value)) for name, value in loads.items()}, work=1)


def least_inertia(machine: Machine) -> float:
    """Smallest inertia over the angle, the motor's side included, at five hundred angles [kg*m^2]."""
    angles = np.linspace(0.0, machine.period, 500, endpoint=False)
    side = machine.drive.efficiency * machine.drive.ratio**2 * machine.drive.motor_inertia
    return float(machine.mechanism(angles)[0].min()) + side


def valid(spec: Shaft, scene: Steady) -> Criterion:
    """Whether there is a steady cycle with a mean speed.

    **Range** any machine.
    **Error** none: a yes or no.
    **Source** the cycle itself.
    """
    try:
        carries = cycle_of(spec, scene.load) is not None
    except NumericsError:
        carries = False
    return Criterion("m", 0.0 if carries else 1.0, 0.5, "0 if there is a steady cycle, otherwise 1", "the cycle itself")


FLYWHEEL_FORMULA: Solver[Shaft, Steady] = Solver(
    name="flywheel_formula",
    title="textbook flywheel formula",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Steady}),
    represents=frozenset(),
    gives=frozenset({"irregularity", "flywheel_inertia"}),
    run=run,
    cost=lambda spec, scene, carried, level: 3e-4,
    source="F. Wittenbauer, Graphische Dynamik, Berlin 1923",
    valid=valid,
    decides=False,
)
