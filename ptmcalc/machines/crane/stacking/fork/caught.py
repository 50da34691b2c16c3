"""A fork caught by the rack while the carriage is hoisted: the formula, the closed form with bounds, the run."""

from collections.abc import Mapping

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Finding, Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import fork
from ptmcalc.machines.crane.stacking.fork.cases import catch_of
from ptmcalc.machines.crane.stacking.fork.effects import CATCHING, LIMITER, RACK, SLOPE
from ptmcalc.machines.crane.stacking.fork.masses import MOTOR, Catch
from ptmcalc.machines.crane.stacking.machine.marching import MOST_SPREAD, course, spread
from ptmcalc.machines.crane.stacking.machine.scenes import ForkCaught
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.strength.derived import with_derived

_SCENES = frozenset({ForkCaught})
_ROPE = frozenset({"rope_force_caught", "fork_caught_factor"})
_MARKS = frozenset({"combination_force"})


def handbook(spec: Stacker, scene: ForkCaught, carried: frozenset[str], level: int) -> Result:
    """Formula for a motor force equal to the weight.

        F = Q + v (K m_1)^(1/2)

    **Range** a carriage that the rack stops at once.
    **Error** no bound: a motor at its maximum torque pulls more; an elastic rack rebounds the carriage.
    **Source** energy of the drive; lecture notes Kramatorsk 2007 name the event, not the formula.
    """
    case = catch_of(spec, scene)
    force = fork.caught_force(case.weight, case.weight, case.rope, case.drive_mass, case.speed)
    loads = {"rope_force_caught": force, "fork_caught_factor": force / case.weight}
    return Result({name: Found(Estimate.unknown(value)) for name, value in loads.items()}, work=1)


def stopped(spec: Stacker, scene: ForkCaught, carried: frozenset[str], level: int) -> Result:
    """Maximum motor force throughout, on a carriage that the rack stops at once.

        F = P + ((P - Q)^2 + K m_1 v^2)^(1/2)

    **Range** every snagged fork; the effects bound the influence of motor slope, limiter and rack elasticity.
    **Error** exact for that motor and rack.
    **Source** energy of the drive, `laws.fork.caught_force`.
    """
    case = catch_of(spec, scene)
    loads = {"rope_force_caught": Found(Estimate.exact(case.stopped_force))} | reserve(spec, case)
    return Result(with_derived(spec, scene, with_factor(loads, case)), work=1, findings=too_weak(spec, scene, case))


def too_weak(spec: Stacker, scene: ForkCaught, case: Catch) -> tuple[Finding, ...]:
    """What has to be said of a motor that would not lift its load."""
    drive = spec.hoisting.drive
    if drive is None or drive.largest_force is None or drive.largest_force >= case.weight:
        return ()
    message = (
        f"scene `{scene.label}`: the maximum motor force is below the weight, {units.show(case.weight, units.FORCE)};"
        " the weight is used instead"
    )
    return (Finding("NUM110", message, ("hoisting", "drive", "largest_force"), "correct the force, or the load"),)


def run(spec: Stacker, scene: ForkCaught, carried: frozenset[str], level: int) -> Result:
    """Drive, rope, carriage and rack, exact between events.

        m_1 x'' = P(x') - F,   M y'' = F - Q - R,   F = max(0, Q + K (x - y)),   R = max(0, K_r y),
        P = min(P_max, Q + h (v - x')); after the limiter has tripped and reacted P = 0 and a brake holds

    Simulated for six periods of the slowest vibration: the rope may go slack, and the rack may rebound the carriage.

    **Range** a rope and a rack without mass or damping; a brake that acts at once and holds.
    **Error** exact between events; error bars from runs with other time steps, accepted only if the energy balance
    closes.
    **Source** `numerics.train`; the equations of theory and case C20.
    """
    whole = catch_of(spec, scene)
    case = whole.without(slope=SLOPE not in carried, limit=LIMITER not in carried, rack=RACK not in carried)
    one = course(scene.label, case.train(), scene.window_factor * case.window(), case.readings)
    found = dict(one.found)
    tripped = one.played.first(MOTOR, "started")
    if tripped < one.played.record.time:
        rope, note = (
            found["rope_force_caught"],
            f"the limiter trips {units.show(tripped, units.TIME)} after the fork snags",
        )
        found["rope_force_caught"] = Found(rope.estimate, rope.at, note)
    said = too_weak(spec, scene, whole)
    return one.result(with_derived(spec, scene, with_factor(found | reserve(spec, whole), case)), said)


def reserve(spec: Stacker, case: Catch) -> dict[str, Found]:
    """Force of the limiter over what a start upward asks, where there is one."""
    if case.limit is None:
        return {}
    asked = case.weight * (1 + spec.hoisting.acceleration / spec.gravity)
    return {"limiter_reserve": Found(Estimate.exact(case.limit.force / asked))}


def with_factor(loads: Mapping[str, Found], case: Catch) -> dict[str, Found]:
    """Loads, with the force of the rope over the weight."""
    rope = loads["rope_force_caught"]
    one, weight = rope.estimate, case.weight
    share = Estimate(
        one.value / weight, one.low / weight, one.high / weight, one.numerical / weight, one.model / weight
    )
    return {**loads, "fork_caught_factor": Found(share, rope.at)}


def not_too_stiff(spec: Stacker, scene: ForkCaught) -> Criterion:
    """A rack that is not much stiffer, beside what it stops, than the rope.

    **Range** every snagged fork.
    **Error** a limit of what a run without damping says of a machine.
    **Source** the fast vibration of the carriage on the rack: its losses decide then, which the file does not have.
    """
    value = spread(catch_of(spec, scene).train())
    return Criterion("w_2/w_1", value, MOST_SPREAD, "highest / lowest natural frequency", "limit of the run")


CAUGHT_HANDBOOK: Solver[Stacker, ForkCaught] = Solver(
    name="caught_handbook",
    title="handbook snagged-fork force, motor force equal to weight",
    fidelity=Fidelity.FORMULA,
    scenes=_SCENES,
    represents=frozenset(),
    gives=_ROPE,
    run=handbook,
    cost=lambda spec, scene, carried, level: 5e-5,
    source="energy of the drive",
    decides=False,
)
CAUGHT_STOPPED: Solver[Stacker, ForkCaught] = Solver(
    name="caught_stopped",
    title="snagged fork, closed form with rigid rack and full motor force",
    fidelity=Fidelity.FORMULA,
    scenes=_SCENES,
    represents=frozenset({CATCHING}),
    gives=_ROPE | _MARKS | {"limiter_reserve"},
    run=stopped,
    cost=lambda spec, scene, carried, level: 1e-4,
    source="energy of the drive; bounds of `laws.fork`",
    always=frozenset({CATCHING}),
)
CAUGHT_TRAIN: Solver[Stacker, ForkCaught] = Solver(
    name="caught_train",
    title="snagged fork, event-driven drive, rope, carriage and rack",
    fidelity=Fidelity.TRANSIENT,
    scenes=_SCENES,
    represents=frozenset({CATCHING, RACK, SLOPE, LIMITER}),
    gives=_ROPE | _MARKS | {"limiter_reserve", "rack_force", "column_stress", "bridge_stress"},
    run=run,
    cost=lambda spec, scene, carried, level: 3e-2,
    source="exact propagation of piecewise-linear systems; derived in ptmcalc.numerics.piecewise",
    valid=not_too_stiff,
    always=frozenset({CATCHING}),
)
