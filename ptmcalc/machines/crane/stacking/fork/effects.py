"""Effects of a snagged fork and of a fork pushed against the rack."""

import math
from collections.abc import Mapping

from ptmcalc.base.estimate import ANYTHING, Estimate, Interval
from ptmcalc.contract.effect import AnyEffect, Criterion, Effect
from ptmcalc.laws import fork
from ptmcalc.machines.crane.stacking.fork.cases import catch_of, push_of
from ptmcalc.machines.crane.stacking.machine.scenes import ForkCaught, ForkPush
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.strength.derived import bounds_of_derived
from ptmcalc.spec.scene import Scene

Loads = Mapping[str, Estimate]
Offsets = Mapping[str, Interval]
CATCHING, RACK, SLOPE, LIMITER = "fork_catching", "rack_elasticity", "hoist_motor_slope", "load_limiter"
PUSHING, YIELDING = "fork_pushing", "column_yield"
CAUGHT: frozenset[type[Scene]] = frozenset({ForkCaught})
PUSHED: frozenset[type[Scene]] = frozenset({ForkPush})
CATCHING_THRESHOLD = 0.05
"""Additional force of a snagged fork, relative to the weight on the rope [1]. An engineering choice
(`laws.fork.catching_number`): below 5 % the snag adds less than 5 % of the weight. Every run simulates the snag, so no
error depends on the value. It affects the list of sensitive effects."""
RACK_THRESHOLD = 0.1
"""Stiffness of the rope relative to that of the rack [1]. An engineering choice: below 10 % the rack changes frequency
and dynamic force by less than 5 %, as springs in series. `rack_bound` covers the neglected rack. A smaller value
requests it in more scenes."""
SLOPE_THRESHOLD = 0.05
"""Damping ratio of the drive by the slope of the motor [1]. An engineering choice: below 0.05 the first peak of the
dynamic force decreases by less than 15 %, 1 - exp(-pi 0.05). `slope_bound` adds the decrease to the error bar. A
smaller value requests the slope in more scenes."""
LIMITER_THRESHOLD = 1.0
"""Upper bound of the rope force relative to the force of the limiter [1]. Derived: below 1 the limiter does not trip
and its neglect has no error. A value above 1 would neglect limiters that trip."""
PUSHING_THRESHOLD = 0.05
"""Shock force of the fork relative to the force of its drive [1]. An engineering choice: below 5 % the shock is less
than 5 % of the drive force. Every run simulates the shock, so no error depends on the value. It affects the list of
sensitive effects."""
YIELDING_THRESHOLD = 0.1
"""Stiffness of the rack relative to that of the mast at the fork [1]. An engineering choice: below 10 % the mast
changes the shock force by less than 5 %, as springs in series. `yield_bound` covers the neglected mast. A smaller value
requests it in more scenes."""


def _anything(loads: Loads) -> Offsets:
    return dict.fromkeys(loads, ANYTHING)


def catching_criterion(spec: Stacker, scene: ForkCaught) -> Criterion:
    """Force that drive inertia and motor can add to the weight on the rope, relative to the weight.

        max( v (K m_1)^(1/2), P - Q )/Q

    **Range** every snagged fork; every run includes this effect.
    **Error** an engineering measure.
    **Source** `laws.fork.catching_number`.
    """
    case = catch_of(spec, scene)
    value = fork.catching_number(case.force, case.weight, case.rope, case.drive_mass, case.speed)
    return Criterion(
        "Π_c", value, CATCHING_THRESHOLD, "additional force of a snagged fork, relative to the weight", "laws.fork"
    )


def catching_bound(spec: Stacker, scene: ForkCaught, loads: Loads) -> Offsets:
    """Without snagging the rope carries the weight; with snagging, the force is between the weight and the bound from
    the energy of drive, carriage and motor.

        Q <= F <= P + ((P - Q)^2 (1 + K/K_r) + K (m_1 + M) v^2)^(1/2)

    **Range** every load of a snagged fork.
    **Error** exact at the lower end, a bound at the upper one.
    **Source** `laws.fork.caught_bound`.
    """
    case = catch_of(spec, scene)
    return _between(spec, scene, loads, case.weight, case.most)


def _between(spec: Stacker, scene: ForkCaught, loads: Loads, least: float, most: float) -> Offsets:
    """Offsets that widen the bar of the rope's force to an interval, where it is not as wide already [N]."""
    case, force = catch_of(spec, scene), loads.get("rope_force_caught")
    if force is None:
        return {}
    offset = Interval(min(least - force.low, 0.0), max(most - force.high, 0.0))
    bounds = {
        "rope_force_caught": offset,
        "fork_caught_factor": Interval(offset.low / case.weight, offset.high / case.weight),
    }
    if "rack_force" in loads:
        rack = loads["rack_force"]
        bounds["rack_force"] = Interval(min(-rack.low, 0.0), max(case.most_of_rack - rack.high, 0.0))
    return {name: one for name, one in bounds_of_derived(spec, scene, loads, bounds).items() if name in loads}


def rack_criterion(spec: Stacker, scene: ForkCaught) -> Criterion:
    """Ratio of the rope stiffness to the rack stiffness.

        K/K_r

    **Range** 0 for a rigid rack.
    **Error** an engineering measure.
    **Source** springs in series; the threshold of 10 % changes the frequency by 5 %.
    """
    case = catch_of(spec, scene)
    return Criterion(
        "K/K_r", case.rope / case.rack, RACK_THRESHOLD, "rope stiffness / rack stiffness", "series springs"
    )


def rack_bound(spec: Stacker, scene: ForkCaught, loads: Loads) -> Offsets:
    """Bounds of the rope force with an elastic rack that rebounds the carriage; zero change for a rigid rack.

        Q <= F <= P + ((P - Q)^2 (1 + K/K_r) + K (m_1 + M) v^2)^(1/2)

    **Range** every load of a snagged fork.
    **Error** a bound: it includes the energy of the carriage and the motor work along the rack deflection.
    **Source** `laws.fork.caught_bound`: energy.
    """
    case = catch_of(spec, scene)
    return {} if case.rigid else _between(spec, scene, loads, case.weight, case.most)


def slope_criterion(spec: Stacker, scene: ForkCaught) -> Criterion:
    """Damping of the shock by the slope of the motor curve.

        z = h/(2 (K m_1)^(1/2))

    **Range** 0 for a motor of constant force.
    **Error** exact as a damping ratio.
    **Source** `laws.fork.slope_number`.
    """
    case = catch_of(spec, scene)
    value = fork.slope_number(case.slope, case.rope, case.drive_mass)
    return Criterion("z_h", value, SLOPE_THRESHOLD, "damping by the slope of the motor", "laws.fork")


def slope_bound(spec: Stacker, scene: ForkCaught, loads: Loads) -> Offsets:
    """Possible reduction of the rope force by the slope of the motor curve; zero for a constant motor force.

        Q + v (K m_1)^(1/2) <= F,   as P(x') >= Q while the drive is slower than v

    With an elastic rack, the peak may occur at any rebound: it is between the weight and the bound of the rack.

    **Range** every load of a snagged fork.
    **Error** a bound, reached if the slope approaches 0 at a large standstill force.
    **Source** energy of the drive with the minimum and the maximum work of the motor; `laws.fork.caught_bound`.
    """
    case = catch_of(spec, scene)
    if not case.slope:
        return {}
    return _between(spec, scene, loads, case.weight_force if case.rigid else case.weight, case.most)


def limiter_criterion(spec: Stacker, scene: ForkCaught) -> Criterion:
    """Ratio of the maximum rope force without the limiter to its trip force; 0 without a limiter.

        F_max/F_l

    **Range** every snagged fork.
    **Error** an upper bound: below 1 it does not trip.
    **Source** `laws.fork.caught_bound`.
    """
    case = catch_of(spec, scene)
    value = case.most / case.limit.force if case.limit is not None else 0.0
    return Criterion("F/F_l", value, LIMITER_THRESHOLD, "rope force / trip force of the limiter", "laws.fork")


def limiter_bound(spec: Stacker, scene: ForkCaught, loads: Loads) -> Offsets:
    """Zero if no limiter trips; otherwise unbounded.

    **Range** every load of a snagged fork.
    **Error** exact if the bound of the force is below the trip force; otherwise unbounded: a brake that stops a
    reversing drive causes a peak of its own.
    **Source** `laws.fork.caught_bound`.
    """
    case = catch_of(spec, scene)
    return {} if case.limit is None or case.most < case.limit.force else _anything(loads)


def pushing_criterion(spec: Stacker, scene: ForkPush) -> Criterion:
    """Force added by the moving fork, relative to its drive force.

        v (K_r m)^(1/2)/P

    **Range** every fork thrust; every run includes this effect.
    **Error** an engineering measure.
    **Source** `laws.fork.clutch_push`.
    """
    case = push_of(spec, scene)
    value = case.speed * math.sqrt(case.rack * case.mass) / case.force
    return Criterion("Π_p", value, PUSHING_THRESHOLD, "impact force of the fork / drive force", "laws.fork")


def pushing_bound(spec: Stacker, scene: ForkPush, loads: Loads) -> Offsets:
    """No bound: the fork thrust cannot be computed without this effect.

    **Range** every load of a fork thrust.
    **Error** unbounded.
    **Source** no run neglects this effect.
    """
    return _anything(loads)


def yield_criterion(spec: Stacker, scene: ForkPush) -> Criterion:
    """Ratio of the rack stiffness to the mast stiffness at the fork.

        K_r/c

    **Range** every fork thrust.
    **Error** an engineering measure.
    **Source** springs in series.
    """
    case = push_of(spec, scene)
    meaning = "rack stiffness / mast stiffness"
    return Criterion("K_r/c", case.rack / case.support, YIELDING_THRESHOLD, meaning, "springs in series")


def yield_bound(spec: Stacker, scene: ForkPush, loads: Loads) -> Offsets:
    """Bounds of the fork thrust with a flexible mast; zero change for a rigid mast.

        F_low <= F <= P + (P^2 (1 + K_r/c) + K_r m v^2)^(1/2)

    F_low is the lower bound with a moving carriage, with a slip clutch P: the drive does not stop before the rack
    reaches this force.

    **Range** the fork thrust, with motor or clutch.
    **Error** a bound; both ends coincide for a rigid mast.
    **Source** `laws.fork.push_least`, `push_bound`.
    """
    case, force = push_of(spec, scene), loads.get("fork_push_force")
    if force is None or math.isinf(case.support):
        return {}
    offset = Interval(min(case.least - force.low, 0.0), max(case.most - force.high, 0.0))
    bounds = bounds_of_derived(spec, scene, loads, {"fork_push_force": offset})
    return {name: one for name, one in bounds.items() if name in loads}


EFFECTS_OF_THE_FORK: tuple[AnyEffect, ...] = (
    Effect(CATCHING, "drive and motor force on a snagged fork", CAUGHT, catching_criterion, catching_bound),
    Effect(RACK, "rack elasticity and rebound of the carriage", CAUGHT, rack_criterion, rack_bound),
    Effect(SLOPE, "torque-speed slope of the hoist motor", CAUGHT, slope_criterion, slope_bound),
    Effect(LIMITER, "load limiter", CAUGHT, limiter_criterion, limiter_bound),
    Effect(PUSHING, "fork thrust against the rack", PUSHED, pushing_criterion, pushing_bound),
    Effect(YIELDING, "mast flexibility under fork thrust", PUSHED, yield_criterion, yield_bound),
)
