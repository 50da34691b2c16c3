"""The chain of a rotation: times, shares, torques of its phases, and what they are worth."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from ptmcalc.laws import brake, slewing
from ptmcalc.machines.crane.slewing import model
from ptmcalc.machines.crane.slewing.rotation import start_curve
from ptmcalc.machines.crane.slewing.rotation.loads import OF_THE_CHAIN
from ptmcalc.machines.crane.slewing.spec import SlewingCrane, SlewingScene

GIVEN = frozenset(info.name for info in OF_THE_CHAIN)
"""Loads of the chain."""


@dataclass(frozen=True, slots=True)
class Phases:
    """Times [s] and angles [rad] of start, steady slewing and stop."""

    start: tuple[float, float]
    steady: tuple[float, float]
    brake: tuple[float, float]

    @property
    def whole(self) -> float:
        """Time of the rotation [s]."""
        return self.start[0] + self.steady[0] + self.brake[0]


@dataclass(frozen=True, slots=True)
class Torques:
    """At the slewing axis, and on the fast shaft of the gearbox [N*m]."""

    start: float
    steady: float
    inertia_brake: float
    brake: float
    fast: tuple[float, float, float]
    """of start, steady slewing and stop"""


def start_time(spec: SlewingCrane, scene: SlewingScene, rule: str = "eta") -> float:
    """Time of a start with the motor's mean torque; infinite where it stalls [s]."""
    torque = model.motor_torque(spec, scene)
    assert torque is not None
    total = model.slew_inertia(spec, scene) + model.rotor_at_column(spec, rule)
    at_column, resistance = model.at_column(spec, torque), model.steady_torque(spec, scene)
    return float(slewing.uniform_start_time(total, spec.speed, at_column, resistance))


def start_torque(spec: SlewingCrane, scene: SlewingScene, time: float, rule: str = "eta") -> float:
    """Torque at the column that a start of a given time takes [N*m]."""
    total = model.slew_inertia(spec, scene) + model.rotor_at_column(spec, rule)
    return float(slewing.torque_for_start(total, spec.speed, time, model.steady_torque(spec, scene)))


def phases(spec: SlewingCrane, start: tuple[float, float], stop: tuple[float, float]) -> Phases:
    """A rotation whose start and stop are known: steady slewing fills what is left of the angle."""
    steady = max(spec.cycle.rotation - start[1] - stop[1], 0.0)
    return Phases(start, (steady / spec.speed, steady), stop)


def allowed_stop(spec: SlewingCrane) -> tuple[float, float]:
    """An even stop over the allowed angle: time [s] and angle [rad]."""
    return brake.uniform_stop_time(spec.cycle.brake_angle, spec.speed), spec.cycle.brake_angle


def torques(
    spec: SlewingCrane, scene: SlewingScene, torque_start: float, rule: str = "eta", *, by_direction: bool
) -> Torques:
    """Torques of the phases: as the handbook carries rotor and losses, or `by_direction` of the power in the gear.

    In an even stop over the allowed angle a brake on the motor shaft holds the rotor, so that the gear carries what the
    crane alone needs, and its losses help the brake; one on the slewing axis has the rotor driving through the gear.
    """
    gear, steady = spec.gear, model.steady_torque(spec, scene)
    braked = model.slew_inertia(spec, scene)
    on_axis = spec.brake is not None and spec.brake.shaft == "crane"
    if on_axis or not by_direction:
        braked += model.rotor_at_column(spec, rule)
    inertia = float(slewing.torque_for_start(braked, spec.speed, allowed_stop(spec)[0], 0.0))
    stop = inertia + model.driving_wind(spec, scene) - spec.friction
    forward = gear.ratio * gear.efficiency
    fast = stop / forward
    if by_direction and on_axis:
        fast = model.rotor_at_column(spec, rule) * spec.speed / allowed_stop(spec)[0] / forward
    elif by_direction and stop > 0:
        fast = stop * gear.back / gear.ratio
    return Torques(torque_start, steady, inertia, stop, (torque_start / forward, steady / forward, fast))


def worth(spec: SlewingCrane, scene: SlewingScene, power: float) -> float:
    """What the torque of a start along a motor's curve is worth, over its mean; 1 without a curve."""
    rise, mean = start_curve.rise_of(spec, scene), model.motor_torque(spec, scene)
    return 1.0 if rise is None or not mean or mean < 0 or math.isinf(rise.time) else rise.mean(power) / mean


def loads(
    spec: SlewingCrane, scene: SlewingScene, times: Phases, at: Torques, *, rounded: bool, even: bool = False
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
