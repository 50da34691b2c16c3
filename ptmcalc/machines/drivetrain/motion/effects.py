"""The effects a scene of a drive train may call for."""

from collections.abc import Mapping

from ptmcalc.base.estimate import ANYTHING, Estimate, Interval
from ptmcalc.contract.effect import Criterion, Effect
from ptmcalc.contract.result import family
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain, Run, Start, Stop, TrainScene
from ptmcalc.machines.drivetrain.motion import bounds
from ptmcalc.machines.drivetrain.motion.loads import MOVING

Loads = Mapping[str, Estimate]

ELASTICITY_THRESHOLD = 0.05
"""Bound of the torque that elasticity adds to a link, relative to the torque of the rigid train [1], from which on it
is simulated. An engineering choice. Below it the error bar of a link torque is at most 5 %."""
BACKLASH_THRESHOLD = 0.1
"""Energy gained in the backlash relative to that of the link [1] from which on backlash is simulated. An engineering
choice. Below it backlash adds at most 2.4 % to the torque of two inertias, which the error bar includes; other trains
without backlash have no error bar."""
CHANGED = MOVING - {"torque_steady", "energy_residual", "braking_reserve"}
"""Loads that the links' elasticity or play can change."""


def elasticity_criterion(spec: Drivetrain, scene: TrainScene) -> Criterion:
    """Maximum oscillation that link elasticity adds to a link torque, relative to the maximum torque of the rigid
    train.

        E = max over links of  sum_n |c_n| g_n / T_rigid

    c_n is the response of the n-th mode in the link to a step of the external torques, g_n the share that remains with
    their rise time (`bounds.swings`).

    **Range** any train; infinite if it is not linear: motor curves, brakes, friction, backlash, gear losses.
    **Error** an upper bound of the ratio, for an undamped train.
    **Source** derived in `machines.drivetrain.motion.bounds`; the threshold of 5 % is an engineering choice.
    """
    value = bounds.largest_share(spec, scene)
    meaning = "oscillation added by the links / torque of the rigid train"
    return Criterion("E", value, ELASTICITY_THRESHOLD, meaning, "machines.drivetrain.motion.bounds")


def elasticity_bound(spec: Drivetrain, scene: TrainScene, loads: Loads) -> Mapping[str, Interval]:
    """Interval of every load of the rigid train that contains the load of the elastic train.

        |T - T_rigid| <= sum_n |c_n| g_n,    |w - w_rigid| <= sum_n |d_n| g_n/w_n,    |phi - phi_rigid| <= ...

    **Range** linear trains with links initially at rest; otherwise unbounded.
    **Error** a bound for the undamped train; damping only reduces the load.
    **Source** derived in `machines.drivetrain.motion.bounds`.
    """
    if not spec.links:
        return {}
    found = bounds.swings(spec, scene)
    offsets = {}
    for name in loads:
        if family(name) not in CHANGED:
            continue
        offsets[name] = found.get(name, ANYTHING) if found is not None else ANYTHING
    return offsets


def backlash_criterion(spec: Drivetrain, scene: TrainScene) -> Criterion:
    """Torque added to a link by the passage through its backlash.

        Pi_b = (2 C D/M) (J1 + J2)/J2,   peak relative to that without backlash (1 + sqrt(1 + Pi_b))/2

    M is the torque that closes the backlash, J1 the inertia on its side, J2 the inertia on the other side, all at the
    shaft of the link.

    **Range** a start through the backlash; infinite if a torque changes its sign and opens it again.
    **Error** exact for two inertias under a constant torque.
    **Source** `laws.backlash`; the threshold of 0.1 adds 2.4 %.
    """
    value = bounds.largest_backlash(spec, scene)
    return Criterion(
        "Π_b", value, BACKLASH_THRESHOLD, "energy gained in the backlash, relative to that of the link", "laws.backlash"
    )


def backlash_bound(spec: Drivetrain, scene: TrainScene, loads: Loads) -> Mapping[str, Interval]:
    """Bound for a train of two inertias that closes its backlash once; otherwise unbounded.

        T <= T_0 (1 + sqrt(1 + Pi_b))/2     two inertias, constant torque, from rest

    **Range** that train; otherwise unbounded.
    **Error** exact for that train: backlash only increases the torque.
    **Source** `laws.backlash.backlash_peak_ratio`.
    """
    found = bounds.two_inertia_play(spec, scene, loads)
    return {
        name: found.get(name, ANYTHING) if found is not None else ANYTHING for name in loads if family(name) in CHANGED
    }


ELASTICITY: Effect[Drivetrain, TrainScene] = Effect(
    name="elasticity",
    title="elasticity of the links",
    scenes=frozenset({Run, Start, Stop}),
    criterion=elasticity_criterion,
    bound=elasticity_bound,
)
BACKLASH: Effect[Drivetrain, TrainScene] = Effect(
    name="backlash",
    title="backlash in gears and couplings",
    scenes=frozenset({Run, Start, Stop}),
    criterion=backlash_criterion,
    bound=backlash_bound,
    part_of="elasticity",
)
EFFECTS_OF_MOTION = (ELASTICITY, BACKLASH)
