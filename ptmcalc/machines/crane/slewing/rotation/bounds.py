"""How far a start time or a stop known to an interval moves the loads of a rotation."""

import itertools
import math
from collections.abc import Iterable, Mapping

from ptmcalc.base.estimate import ANYTHING, Estimate, Interval
from ptmcalc.laws import duty, slewing
from ptmcalc.machines.crane.slewing.machine import model
from ptmcalc.machines.crane.slewing.machine.spec import SlewingCrane, SlewingScene
from ptmcalc.machines.crane.slewing.ring.loads import RING_LOADS
from ptmcalc.machines.crane.slewing.rotation import chain

Loads = Mapping[str, Estimate]
Offsets = Mapping[str, Interval]
_OF_TIMES = (
    "start_time", "start_angle", "steady_time", "steady_angle", "brake_time", "brake_angle", "cycle_time",
    "share_start", "share_steady", "share_brake", "torque_equivalent", "torque_pinion", "torque_worm", "power_gearbox",
    "rotation_used", "torque_motor_rms", "heating_utilisation",
)  # fmt: skip
OF_SWAY = frozenset({"sway_radial_max", "sway_tangential_max", "sway_max", "sway_residual"})
"""Loads of a run with load sway: each depends on the time of the start."""


def unknown(loads: Loads, names: Iterable[str] = ()) -> dict[str, Interval]:
    """Nothing is known of start, stop and ring, nor of some loads more."""
    return {name: ANYTHING for name in (*_OF_TIMES, *RING_LOADS, *names) if name in loads}


def _beyond(known: Estimate, low: float, high: float) -> Interval:
    """The offset that takes a bar to an interval, as far as that is wider."""
    if math.isnan(low) or math.isnan(high):
        return ANYTHING
    below = -math.inf if low == -math.inf else min(low - known.low, 0.0)
    above = math.inf if high == math.inf else max(high - known.high, 0.0)
    return Interval(below, above)


def of_times(
    spec: SlewingCrane,
    scene: SlewingScene,
    loads: Loads,
    start: Interval,
    stop: tuple[Interval, Interval] | None,
    start_angle: Interval | None = None,
) -> dict[str, Interval]:
    """What a start time known to an interval, and a stop known by time and angle, leave of everything that follows."""
    if "start_time" not in loads or "cycle_time" not in loads:
        return {}
    speed, rotation = spec.speed, spec.cycle.rotation
    planned = (model.stop(spec, scene) or model.allowed_stop(spec))[1]
    if not (math.isfinite(start.low) and math.isfinite(start.high)):
        return {name: ANYTHING for name in _OF_TIMES if name in loads}
    turned = start_angle or Interval(0.0, speed * start.high)
    steady = Interval(max(rotation - turned.high - planned, 0.0), max(rotation - turned.low - planned, 0.0))
    steady_time = Interval(steady.low / speed, steady.high / speed)
    time, angle = stop or (bar(loads["brake_time"]), bar(loads["brake_angle"]))
    times = (start, steady_time, time)
    found = {
        "start_time": start,
        "start_angle": turned,
        "steady_angle": steady,
        "steady_time": steady_time,
        "brake_time": time,
        "brake_angle": angle,
        "cycle_time": Interval(sum(one.low for one in times), sum(one.high for one in times)),
        "rotation_used": Interval((turned.low + angle.low) / rotation, (turned.high + angle.high) / rotation),
    }
    for index, name in enumerate(("share_start", "share_steady", "share_brake")):
        found[name] = _share(times, index)
    found |= _torques(spec, scene, times, found["cycle_time"], steady_time)
    return {name: _beyond(loads[name], one.low, one.high) for name, one in found.items() if name in loads}


def bar(known: Estimate) -> Interval:
    return Interval(known.low, known.high)


def _share(times: tuple[Interval, ...], index: int) -> Interval:
    """Share of one phase, each phase anywhere in its interval."""
    own = times[index]
    others = [one for k, one in enumerate(times) if k != index]
    most, least = sum(one.high for one in others), sum(one.low for one in others)
    low = own.low / (own.low + most) if own.low > 0 else 0.0
    high = own.high / (own.high + least) if math.isfinite(own.high) and own.high > 0 else 1.0 if own.high > 0 else 0.0
    return Interval(low, high)


def _torques(
    spec: SlewingCrane, scene: SlewingScene, times: tuple[Interval, ...], whole: Interval, steady: Interval
) -> dict[str, Interval]:
    """Means of torques over the phases: a ratio of linear functions of each time, largest and smallest at corners."""
    at_column = model.start_of(spec, scene)[1]
    found: dict[str, Interval] = {}
    for by in (False, True):
        at = model.phase_torques(spec, scene, at_column, by_direction=by)
        more = chain.worth(spec, scene, spec.cycle.exponent)
        equivalent = _mean(times, (more * at.start, at.steady, at.brake), spec.cycle.exponent)
        worm = _mean(times, (more * at.fast[0], *at.fast[1:]), spec.cycle.exponent)
        one = {
            "torque_equivalent": equivalent,
            "torque_worm": worm,
            "power_gearbox": _times(worm, spec.gear.ratio * spec.speed),
        }
        if spec.gear.open is not None:
            one["torque_pinion"] = _times(equivalent, 1 / (spec.gear.open.ratio * spec.gear.open.efficiency))
        found = {
            name: one[name] if name not in found
            else Interval(min(found[name].low, one[name].low), max(found[name].high, one[name].high))
            for name in one
        }  # fmt: skip
    motors = spec.motor.count
    hot = chain.worth(spec, scene, 2.0) * at.fast[0]
    heating = _mean(times[:2], (hot / motors, at.fast[1] / motors), 2.0)
    found["torque_motor_rms"] = heating
    if spec.motor.rated is not None:
        on = (times[0].low + steady.low, times[0].high + steady.high)
        off = (times[2].low + spec.cycle.pause, times[2].high + spec.cycle.pause)
        most = _allowed(spec, on[0] / (on[0] + off[1]) if on[0] > 0 else 0.0)
        least = _allowed(spec, on[1] / (on[1] + off[0]))
        found["heating_utilisation"] = Interval(heating.low / most, heating.high / least)
    return found


def _allowed(spec: SlewingCrane, share: float) -> float:
    """Torque that a motor bears which is on for so much of the time; any where it is never on [N*m]."""
    motor, cooling = spec.motor, duty.REST_COOLING["self_ventilated"]
    assert motor.rated is not None
    if share == 0:
        return math.inf
    return duty.permissible_torque(motor.rated, motor.rated_duty, share, rest_cooling=cooling)


def _times(one: Interval, factor: float) -> Interval:
    return Interval(one.low * factor, one.high * factor)


def _mean(times: tuple[Interval, ...], torques: tuple[float, ...], exponent: float) -> Interval:
    sizes = [abs(torque) for torque in torques]
    if not all(math.isfinite(one.high) for one in times):
        return Interval(min(sizes), max(sizes))
    values = []
    for corner in itertools.product(*((one.low, one.high) for one in times)):
        whole = sum(corner)
        if whole > 0:
            values.append(slewing.fatigue_torque([time / whole for time in corner], sizes, exponent))
    return Interval(min(values, default=min(sizes)), max(values, default=max(sizes)))
