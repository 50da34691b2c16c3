"""Effects of a snagged fork and of a fork pushed against the rack."""

import math
from collections.abc import Mapping

from ptmcalc.base.estimate import ANYTHING, Estimate, Interval
from ptmcalc.contract.effect import AnyEffect, Criterion, Effect
from ptmcalc.laws import fork
from ptmcalc.machines.crane.stacking.events import catch_of, push_of
from ptmcalc.machines.crane.stacking.scenes import ForkCaught, ForkPush
from ptmcalc.machines.crane.stacking.spec import Stacker
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
    """What drive and motor can add to the weight on the rope.

        max( v (K m_1)^(1/2), P - Q )/Q

    **Range** every caught fork; it is in every run.
    **Error** an engineering measure.
    **Source** `laws.fork.catching_number`.
    """
    case = catch_of(spec, scene)
    value = fork.catching_number(case.force, case.weight, case.rope, case.drive_mass, case.speed)
    return Criterion(
        "Π_c", value, CATCHING_THRESHOLD, "additional force of a snagged fork, relative to the weight", "laws.fork"
    )


def catching_bound(spec: Stacker, scene: ForkCaught, loads: Loads) -> Offsets:
    """Without the catch the rope bears the weight; with it between that and the energy of drive, carriage and motor.

        Q <= F <= P + ((P - Q)^2 (1 + K/K_r) + K (m_1 + M) v^2)^(1/2)

    **Range** every load of a caught fork.
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
    """Stiffness of the rope over that of the rack.

        K/K_r

    **Range** 0 for a rigid rack.
    **Error** an engineering measure.
    **Source** springs in series; the threshold of 10 % changes the frequency by 5 %.
    """
    case = catch_of(spec, scene)
    return Criterion("K/K_r", case.rope / case.rack, RACK_THRESHOLD, "rope stiffness over the rack's", "series springs")


def rack_bound(spec: Stacker, scene: ForkCaught, loads: Loads) -> Offsets:
    """What a rack that gives, and throws the carriage back, can make of the rope's force; nothing for a rigid one.

        Q <= F <= P + ((P - Q)^2 (1 + K/K_r) + K (m_1 + M) v^2)^(1/2)

    **Range** every load of a caught fork.
    **Error** a bound: the carriage brings its own energy, and the motor works along the way of the rack.
    **Source** `laws.fork.caught_bound`: energy.
    """
    case = catch_of(spec, scene)
    return {} if case.rigid else _between(spec, scene, loads, case.weight, case.most)


def slope_criterion(spec: Stacker, scene: ForkCaught) -> Criterion:
    """How far the motor's slope damps the shock.

        z = h/(2 (K m_1)^(1/2))

    **Range** 0 for a motor of constant force.
    **Error** exact as a damping ratio.
    **Source** `laws.fork.slope_number`.
    """
    case = catch_of(spec, scene)
    value = fork.slope_number(case.slope, case.rope, case.drive_mass)
    return Criterion("z_h", value, SLOPE_THRESHOLD, "damping by the slope of the motor", "laws.fork")


def slope_bound(spec: Stacker, scene: ForkCaught, loads: Loads) -> Offsets:
    """What a motor that pulls less the faster it runs can take off the force of one at its largest; nothing without.

        Q + v (K m_1)^(1/2) <= F,   as P(x') >= Q while the drive is slower than v

    Behind a rack that gives, the peak may come at any bounce: it lies between the weight and the bound of that rack.

    **Range** every load of a caught fork.
    **Error** a bound, reached as the slope falls to 0 under a large standstill force.
    **Source** energy of the drive with the least and the largest work of the motor; `laws.fork.caught_bound`.
    """
    case = catch_of(spec, scene)
    if not case.slope:
        return {}
    return _between(spec, scene, loads, case.weight_force if case.rigid else case.weight, case.most)


def limiter_criterion(spec: Stacker, scene: ForkCaught) -> Criterion:
    """Most that the rope can get without the limiter, over the force at which it trips; 0 without one.

        F_max/F_l

    **Range** every caught fork.
    **Error** an upper bound: below 1 it does not trip.
    **Source** `laws.fork.caught_bound`.
    """
    case = catch_of(spec, scene)
    value = case.most / case.limit.force if case.limit is not None else 0.0
    return Criterion("F/F_l", value, LIMITER_THRESHOLD, "rope force over that of the limiter", "laws.fork")


def limiter_bound(spec: Stacker, scene: ForkCaught, loads: Loads) -> Offsets:
    """Nothing where no limiter trips; else nothing is known without it.

    **Range** every load of a caught fork.
    **Error** exact where the bound of the force is below the limiter's; else unbounded: a brake that catches a drive
    that runs back has a peak of its own.
    **Source** `laws.fork.caught_bound`.
    """
    case = catch_of(spec, scene)
    return {} if case.limit is None or case.most < case.limit.force else _anything(loads)


def pushing_criterion(spec: Stacker, scene: ForkPush) -> Criterion:
    """What the moving fork adds to the force of its drive.

        v (K_r m)^(1/2)/P

    **Range** every pushing fork; it is in every run.
    **Error** an engineering measure.
    **Source** `laws.fork.clutch_push`.
    """
    case = push_of(spec, scene)
    value = case.speed * math.sqrt(case.rack * case.mass) / case.force
    return Criterion("Π_p", value, PUSHING_THRESHOLD, "shock of the fork over the force of its drive", "laws.fork")


def pushing_bound(spec: Stacker, scene: ForkPush, loads: Loads) -> Offsets:
    """Nothing is known of a push without it.

    **Range** every load of a pushing fork.
    **Error** unbounded.
    **Source** there is no run that leaves it out.
    """
    return _anything(loads)


def yield_criterion(spec: Stacker, scene: ForkPush) -> Criterion:
    """Stiffness of the rack over that of the column at the fork.

        K_r/c

    **Range** every pushing fork.
    **Error** an engineering measure.
    **Source** springs in series.
    """
    case = push_of(spec, scene)
    meaning = "stiffness of the rack over that of the column"
    return Criterion("K_r/c", case.rack / case.support, YIELDING_THRESHOLD, meaning, "springs in series")


def yield_bound(spec: Stacker, scene: ForkPush, loads: Loads) -> Offsets:
    """What a column that gives way can change; nothing for a rigid one.

        F_low <= F <= P + (P^2 (1 + K_r/c) + K_r m v^2)^(1/2)

    F_low is what the carriage leaves of it at most, of a clutch P: the drive does not stop before the rack brings it.

    **Range** the force of a pushing fork, with motor or clutch.
    **Error** a bound; both ends meet on a rigid column.
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
