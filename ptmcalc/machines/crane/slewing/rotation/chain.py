"""The chain of a rotation: times, shares, torques of its phases, and what they are worth."""

import math
from collections.abc import Mapping

from ptmcalc.laws import slewing
from ptmcalc.machines.crane.slewing.machine import model
from ptmcalc.machines.crane.slewing.machine.spec import SlewingCrane, SlewingScene
from ptmcalc.machines.crane.slewing.rotation import start_curve
from ptmcalc.machines.crane.slewing.rotation.loads import OF_THE_CHAIN

GIVEN = frozenset(info.name for info in OF_THE_CHAIN)
"""Loads of the chain."""


def worth(spec: SlewingCrane, scene: SlewingScene, power: float) -> float:
    """What the torque of a start along a motor's curve is worth, over its mean; 1 without a curve."""
    rise, mean = start_curve.rise_of(spec, scene), model.motor_torque(spec, scene)
    return 1.0 if rise is None or not mean or mean < 0 or math.isinf(rise.time) else rise.mean(power) / mean


def loads(
    spec: SlewingCrane,
    scene: SlewingScene,
    times: model.Phases,
    at: model.PhaseTorques,
    *,
    rounded: bool,
    even: bool = False,
) -> Mapping[str, float]:
    """All loads of the chain; with `even` the starting torque counts by its mean, as handbooks have it."""
    shares = [time / times.whole for time in (times.start[0], times.steady[0], times.brake[0])]
    if rounded:
        shares = [round(share, 3) for share in shares]
    exponent = spec.cycle.exponent
    more = 1.0 if even else worth(spec, scene, exponent)
    equivalent = slewing.fatigue_torque(shares, [more * at.start, at.steady, at.brake], exponent)
    worm = slewing.fatigue_torque(shares, (more * at.fast[0], *at.fast[1:]), exponent)
    found = {
        "slew_inertia": model.slew_inertia(spec, scene),
        "start_time": times.start[0],
        "start_angle": times.start[1],
        "steady_time": times.steady[0],
        "steady_angle": times.steady[1],
        "brake_time": times.brake[0],
        "brake_angle": times.brake[1],
        "cycle_time": times.whole,
        "share_start": shares[0],
        "share_steady": shares[1],
        "share_brake": shares[2],
        "torque_start": at.start,
        "torque_steady": at.steady,
        "torque_inertia_brake": at.inertia_brake,
        "torque_brake": at.brake,
        "torque_equivalent": equivalent,
        "torque_worm": worm,
        "power_gearbox": worm * spec.gear.ratio * spec.speed,
    }
    if spec.gear.open is not None:
        found["torque_pinion"] = equivalent / (spec.gear.open.ratio * spec.gear.open.efficiency)
    return found
