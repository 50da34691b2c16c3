"""A fork that pushes against the rack: the formula, the closed form with a rigid column, the run."""

import math

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.crane.stacking.fork.cases import push_of
from ptmcalc.machines.crane.stacking.fork.effects import PUSHING, YIELDING
from ptmcalc.machines.crane.stacking.machine.marching import MOST_SPREAD, course, spread
from ptmcalc.machines.crane.stacking.machine.scenes import ForkPush
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.strength.derived import with_derived

_SCENES = frozenset({ForkPush})
_GIVES = frozenset({"fork_push_force", "combination_force", "column_stress", "stability_reserve"})


def handbook(spec: Stacker, scene: ForkPush, carried: frozenset[str], level: int) -> Result:
    """Formula with rack and mast as springs in series.

        F = P + (P^2 + K m v^2)^(1/2),   1/K = 1/K_r + 1/c;   with a slip clutch P_c + v (K m)^(1/2)

    **Range** as `laws.fork.push_force`.
    **Error** no bound: the carriage mass delays the deflection of the mast.
    **Source** energy of the fork drive.
    """
    case = push_of(spec, scene)
    return Result({"fork_push_force": Found(Estimate.unknown(case.formula(case.series)))}, work=1)


def rigid(spec: Stacker, scene: ForkPush, carried: frozenset[str], level: int) -> Result:
    """Fork thrust against the rack with a rigid mast.

        F = P + (P^2 + K_r m v^2)^(1/2);   with a slip clutch P_c + v (K_r m)^(1/2)

    **Range** every fork thrust; the effect `column_yield` bounds the influence of the mast.
    **Error** exact for a rigid mast.
    **Source** energy of the fork drive, `laws.fork`.
    """
    case = push_of(spec, scene)
    found = {"fork_push_force": Found(Estimate.exact(case.formula(case.rack)))}
    return Result(with_derived(spec, scene, found), work=1)


def run(spec: Stacker, scene: ForkPush, carried: frozenset[str], level: int) -> Result:
    """Drive, rack and carriage on its mast, exact between events.

        m s'' = P - F,   M w'' = F - c w,   F = max(0, K_r (s - w)),   P of the motor, or of the clutch while it slips

    s is the travel of the fork out of the carriage, w the backward displacement of the carriage. Simulated for six
    periods of the slowest vibration.

    **Range** the mass of fork and drive reduced to the fork travel; a massless mast.
    **Error** exact between events; error bars from runs with other time steps, accepted only if the energy balance
    closes.
    **Source** `numerics.train`.
    """
    if YIELDING not in carried:
        return rigid(spec, scene, carried, level)
    case = push_of(spec, scene)
    if math.isinf(case.support):
        return rigid(spec, scene, carried, level)
    one = course(scene.label, case.train(), scene.window_factor * case.window(), case.readings)
    return one.result(with_derived(spec, scene, one.found))


def not_too_stiff(spec: Stacker, scene: ForkPush) -> Criterion:
    """A column that is not much stiffer, beside what it carries, than the rack beside the fork, nor much softer.

    **Range** every fork thrust.
    **Error** a limit of what a run without damping says of a machine.
    **Source** the losses of the fast vibration decide then, which the file does not have.
    """
    case = push_of(spec, scene)
    value = spread(case.train()) if math.isfinite(case.support) else 1.0
    return Criterion("w_2/w_1", value, MOST_SPREAD, "highest / lowest natural frequency", "limit of the run")


PUSH_HANDBOOK: Solver[Stacker, ForkPush] = Solver(
    name="push_handbook",
    title="handbook fork thrust, rack and mast in series",
    fidelity=Fidelity.FORMULA,
    scenes=_SCENES,
    represents=frozenset(),
    gives=frozenset({"fork_push_force"}),
    run=handbook,
    cost=lambda spec, scene, carried, level: 5e-5,
    source="energy of the fork's drive",
    decides=False,
)
PUSH_RIGID: Solver[Stacker, ForkPush] = Solver(
    name="push_rigid",
    title="fork thrust, closed form with rigid mast",
    fidelity=Fidelity.FORMULA,
    scenes=_SCENES,
    represents=frozenset({PUSHING}),
    gives=_GIVES,
    run=rigid,
    cost=lambda spec, scene, carried, level: 1e-4,
    source="energy of the fork's drive; bounds of `laws.fork`",
    always=frozenset({PUSHING}),
)
PUSH_TRAIN: Solver[Stacker, ForkPush] = Solver(
    name="push_train",
    title="fork thrust, event-driven drive, rack and mast",
    fidelity=Fidelity.TRANSIENT,
    scenes=_SCENES,
    represents=frozenset({PUSHING, YIELDING}),
    gives=_GIVES,
    run=run,
    cost=lambda spec, scene, carried, level: 2e-2,
    source="exact propagation of piecewise-linear systems; derived in ptmcalc.numerics.piecewise",
    valid=not_too_stiff,
    always=frozenset({PUSHING}),
)
