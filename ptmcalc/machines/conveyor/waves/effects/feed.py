"""Acceleration of the material that comes on a belt during a stop."""

import math
from collections.abc import Iterator
from dataclasses import replace

from ptmcalc.base.estimate import Interval
from ptmcalc.base.memory import kept_for
from ptmcalc.contract.effect import Criterion, Effect
from ptmcalc.contract.result import family
from ptmcalc.machines.conveyor.machine.drives import running
from ptmcalc.machines.conveyor.machine.loading import accelerates, filling_of, load_line_mass, pieces, points_of
from ptmcalc.machines.conveyor.machine.loads import BRAKE_HEAT, OF_BRAKES, OF_STOP, WAYS_OF_STOP
from ptmcalc.machines.conveyor.machine.rigid_stop import rigid_stop
from ptmcalc.machines.conveyor.machine.scenes import Coast, ControlledStop, ConveyorScene, EmergencyStop, Stop
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.waves.effects.shared import Loads, Offsets, moved_by

FEED_THRESHOLD = 0.001
"""Change of the stopping time by the feed [1] from which on it is reported. An engineering choice. Below it the error
bar of the stopping time is at most 0.12 %."""
_WAVES, _MARGIN = 2.0, 1.2
"""Factors of a change of force [1], as of `effects.gear`. `_WAVES`: wave of a force that appears at once, at most twice
its size; derived. `_MARGIN`: change of stopping time and distance relative to the rigid body; an engineering choice.
Larger values widen the error bars."""


def streams(spec: Conveyor, scene: ConveyorScene) -> Iterator[tuple[float, float]]:
    """Mass flow [kg/s] and speed along the belt [m/s] of the material whose acceleration is a force of its own."""
    loaded = list(zip(pieces(spec), filling_of(spec, scene), strict=True))
    for piece, names in loaded:
        for name, share in piece.zones:
            if name in names and accelerates(spec, name):
                point = points_of(spec)[name]
                yield point.capacity * share, point.speed
    flow = load_line_mass(spec) * spec.speed
    for one in spec.resistance.forces.values():
        if one.loading is not None:
            along = sum(piece.length for piece, names in loaded if names) / spec.route.span
            share = along if one.at == "carry" else float(bool(loaded[0][1]))
            yield flow * share, one.loading.speed


def range_of_force(spec: Conveyor, scene: ConveyorScene) -> Interval:
    """Force of the feed in a stop less that of steady running [N].

        F = q Q (v - v_k),   0 <= q <= 1,   0 <= v <= V

    The feed may stop at once (q = 0), continue (q = 1), or run out; the belt slows down from V to 0.
    """
    low = high = 0.0
    for flow, speed in streams(spec, scene):
        before, ends = flow * (spec.speed - speed), (0.0, -flow * speed, flow * (spec.speed - speed))
        low, high = low + min(ends) - before, high + max(ends) - before
    return Interval(low, high)


@kept_for(64)
def _stopped(spec: Conveyor, scene: ConveyorScene) -> tuple[tuple[float, float], ...]:
    """Time and distance of the rigid conveyor with the feed of steady running, and with the ends of its range."""
    line, more = running(spec, scene), range_of_force(spec, scene)
    lines = (line, *(replace(line, tail_force=line.tail_force + force) for force in (more.high, more.low)))
    return tuple(rigid_stop(spec, scene, one) for one in lines)


def feed_criterion(spec: Conveyor, scene: ConveyorScene) -> Criterion:
    """Relative change of the stopping time if the feed stops at once, or continues while the belt slows down.

        max |t_feed - t|/t   of the rigid conveyor

    **Range** any stop with a force that accelerates the feed; 0 without one, and for a belt that does not stop.
    **Error** exact for the rigid conveyor.
    **Source** momentum of the feed.
    """
    (time, _), *ends = _stopped(spec, scene)
    changes = [abs(end / time - 1) if math.isfinite(time) and time > 0 else 0.0 for end, _ in ends]
    change = max(changes) if any(flow for flow, _ in streams(spec, scene)) else 0.0
    return Criterion("dt/t", change, FEED_THRESHOLD, "change of the stopping time by the feed", "momentum of the feed")


def feed_bound(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Offsets:
    """Change of the loads of a stop by the material that comes on the belt meanwhile.

        F = q Q (v - v_k),   0 <= q <= 1,   0 <= v <= V
        dS = 2 dF,   dF = max |F - Q (V - v_k)|
        dt, ds: 1.2 times those of the rigid conveyor with the smallest and the largest F, and what dS adds

    The simulation keeps the force of steady running, Q (V - v_k). The feed may stop with the belt, continue or run out.

    **Range** any stop. The material that continues to come lies more densely, by s/L of the load at most, where the
    belt moves by s on its length L: its mass and weight are neglected.
    **Error** a bound of the waves; the belt at the head follows the rigid body within a fifth of the change.
    **Source** momentum of the feed: force = mass flow times the change of its speed; comparison of v' = -(W + F)/M.
    """
    more = range_of_force(spec, scene)
    change = max(-more.low, more.high)
    if not change:
        return {}
    line = running(spec, scene)
    found = dict(moved_by(spec, scene, line, loads, _WAVES * change))
    (time, way), *ends = _stopped(spec, scene)
    for name, load in loads.items():
        kind = family(name)
        if kind in OF_STOP and math.isfinite(load.value) and not isinstance(scene, ControlledStop):
            index = 0 if kind == "stop_time" else 1
            offsets = [_MARGIN * (end[index] - (time, way)[index]) for end in ends]
            own = found.get(name, Interval(0.0, 0.0))
            found[name] = Interval(min(*offsets, 0.0) + own.low, max(*offsets, 0.0) + own.high)
        elif kind in OF_BRAKES:
            heat = change * max(
                (one.high for other, one in loads.items() if family(other) in WAYS_OF_STOP), default=0.0
            )
            brake = spec.brakes[name.partition("[")[2][:-1]]
            most = heat if kind == BRAKE_HEAT else heat * brake.stop_rate
            own = found.get(name, Interval(0.0, 0.0))
            found[name] = Interval(own.low - most, own.high + most)
    return found


FEED = Effect(
    "feed",
    "material that is fed during a stop",
    frozenset({Stop, EmergencyStop, ControlledStop, Coast}),
    feed_criterion,
    feed_bound,
)
