"""The second method for caught and pushing forks: Runge-Kutta steps from event to event; no plan offers it.

Shared with the solvers: the list of parts of drive, rope, rack and column, the window, and what follows from the force
of an event (`derived`). Equations, contact, friction and events are its own.
"""

import math

from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.crane.stacking.fork.cases import catch_of, push_of
from ptmcalc.machines.crane.stacking.fork.caught import with_factor
from ptmcalc.machines.crane.stacking.fork.effects import CATCHING, LIMITER, PUSHING, SLOPE, YIELDING
from ptmcalc.machines.crane.stacking.fork.effects import RACK as RACK_GIVES
from ptmcalc.machines.crane.stacking.fork.masses import RACK, ROPE
from ptmcalc.machines.crane.stacking.machine.scenes import ForkCaught, ForkPush
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.strength.derived import with_derived
from ptmcalc.numerics.train.parts import Train
from ptmcalc.reference import lumped, lumped_cost, two_runs


def caught(spec: Stacker, scene: ForkCaught, carried: frozenset[str], level: int) -> Result:
    """Maximum forces of rope and rack when the fork snags in the rack.

    **Range** as the exact run: no damping.
    **Error** three times the difference of two runs, the second with a hundredth of the tolerance of the first.
    **Source** Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I, 2nd ed.
    """
    case = catch_of(spec, scene).without(
        slope=SLOPE not in carried, limit=LIMITER not in carried, rack=RACK_GIVES not in carried
    )
    names = {"rope_force_caught": ROPE} | ({} if case.rigid else {"rack_force": RACK})
    found = _largest(case.train(), scene.window_factor * case.window(), level, names)
    return Result(with_derived(spec, scene, with_factor(found.loads, case)), work=found.work, window=found.window)


def pushed(spec: Stacker, scene: ForkPush, carried: frozenset[str], level: int) -> Result:
    """Maximum fork thrust on the rack, with errors as `caught`."""
    case = push_of(spec, scene)
    found = _largest(case.train(), scene.window_factor * case.window(), level, {"fork_push_force": RACK})
    return Result(with_derived(spec, scene, found.loads), work=found.work, window=found.window)


def _largest(train: Train, window: float, level: int, names: dict[str, str]) -> Result:
    """Largest forces of some links, from two runs."""
    runs = lumped.twice(train, window, level)
    links = [spring.name for spring in train.springs]
    found = [{name: run.highest["link", links.index(link)] for name, link in names.items()} for run in runs]
    return Result(two_runs.compared(*found), work=sum(run.steps for run in runs), window=(0.0, window))


def _caught_cost(spec: Stacker, scene: ForkCaught, carried: frozenset[str], level: int) -> float:
    case = catch_of(spec, scene)
    return lumped_cost.seconds(case.train(), scene.window_factor * case.window(), lumped.TOLERANCES[level : level + 2])


def _pushed_cost(spec: Stacker, scene: ForkPush, carried: frozenset[str], level: int) -> float:
    case = push_of(spec, scene)
    return lumped_cost.seconds(case.train(), scene.window_factor * case.window(), lumped.TOLERANCES[level : level + 2])


def yields(spec: Stacker, scene: ForkPush) -> Criterion | None:
    """Whether something gives but the rack.

        1 for a rigid column

    **Range** any stacker.
    **Error** exact.
    **Source** the file.
    """
    if math.isinf(push_of(spec, scene).support):
        return Criterion("column", 1.0, 1.0, "a rigid mast: one spring with a closed-form force", "the file")
    return None


_SOURCE = "Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I; derived in ptmcalc.reference"
CAUGHT: Solver[Stacker, ForkCaught] = Solver(
    name="caught_runge_kutta",
    title="snagged fork, Runge-Kutta (reference)",
    fidelity=Fidelity.TRANSIENT,
    scenes=frozenset({ForkCaught}),
    represents=frozenset({CATCHING, RACK_GIVES, SLOPE, LIMITER}),
    gives=frozenset({"rope_force_caught", "fork_caught_factor", "rack_force"}),
    run=caught,
    cost=_caught_cost,
    source=_SOURCE,
    always=frozenset({CATCHING}),
    levels=2,
)
PUSHED: Solver[Stacker, ForkPush] = Solver(
    name="push_runge_kutta",
    title="fork thrust, Runge-Kutta (reference)",
    fidelity=Fidelity.TRANSIENT,
    scenes=frozenset({ForkPush}),
    represents=frozenset({PUSHING, YIELDING}),
    gives=frozenset({"fork_push_force"}),
    run=pushed,
    cost=_pushed_cost,
    source=_SOURCE,
    valid=yields,
    always=frozenset({PUSHING, YIELDING}),
    levels=2,
)
REFERENCE_METHODS = (CAUGHT, PUSHED)
