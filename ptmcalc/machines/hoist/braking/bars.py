"""Error bars of an emergency stop: the load oscillates on its rope, which the rigid train does not know.

With the inertia J_1 of rotors and drum and J_2 of the load, J = J_1 + J_2, both on the motor shaft, the momentum

    J_1 w + J_2 v = L(t) = J w_0 + M_L t - integral of M_B dt

is that of the rigid train. The relative motion u = x - phi of the load is an oscillator of the frequency
W = w_h sqrt(1 + J_2/J_1), w_h that with the drum held. Its excitation has the total variation (M_L + M_B)/J_1: the
motor loses its torque, the brake closes. Hence, without damping,

    |u'| <= (M_L + c M_B)/(J_1 W),   |u| <= 2 (M_L + M_B)/(J_1 W^2),   |w - L/J| <= d = |u'| J_2/J

with c = 2/(W t_r) for a linear and 2/sqrt(1 + W^2 t_r^2) for an exponential rise, at most 1. While a load is lowered
the excitations have opposite signs, and |u| <= 2 max(M_L, M_B)/(J_1 W^2).

The drive is at rest between the rest of rigid trains that begin with w_0 - d and w_0 + d; its angle differs by
d dt + |u| J_2/J, and the heat by the work of the load over that angle and the energy of the oscillation.

With a brake on the drum shaft the losses of the gear change sides with the sign of the acceleration: the angle lies
among those of the two rigid trains. A load that sinks after it was hoisted is treated in the same manner.

The rope stays taut where its force never falls to 0: 1 > 2 J_2/J while a load is lowered, whose brake pulls the rope
taut; M_L > 2 (M_L + M_B) J_2/J while it is hoisted. Otherwise the loads have no bound.
"""

import math
from dataclasses import dataclass, fields, replace

from ptmcalc.base.estimate import Estimate
from ptmcalc.laws.brake import EXPONENTIAL
from ptmcalc.machines.hoist.braking.motion import Brake, Emergency, Train, emergency_stop

_CHORD_ERROR = 1e-6
"""Error of an exponential rise by chords, relative to the value [1]: thirty times the share of the momentum that the
chords miss. A smaller value loses the safety of the error bar; a larger one widens it."""
_SWINGS = 2.0
"""Relative speeds that add up where a load sinks after it was hoisted: that of each direction [1]. Derived: the
momentum of the second motion begins with the relative motion that the first one leaves. A smaller value loses that
rest."""


@dataclass(frozen=True, slots=True)
class Bounded:
    """The motion with error bars, angles and speeds of the motor shaft."""

    time: Estimate
    speed_max: Estimate
    up: Estimate
    down: Estimate
    travel: Estimate
    heat: Estimate


@dataclass(frozen=True, slots=True)
class _Swing:
    """Bounds of the relative motion, on the motor shaft."""

    speed: float
    """d [rad/s]"""
    angle: float
    """|u| J_2/J [rad]"""
    energy: float
    """[J]"""
    taut: bool


def with_bars(train: Train, brake: Brake, speed: float, lifts: bool, frequency: float) -> Bounded:
    """The stop from a speed of the motor shaft [rad/s], and a frequency of the load with the drum held [rad/s]."""
    found = _bounds(train, brake, speed, lifts, frequency)
    if brake.rise != EXPONENTIAL or brake.rise_time == 0:
        return found
    return Bounded(**{one.name: _chords(getattr(found, one.name)) for one in fields(found)})


def _chords(one: Estimate) -> Estimate:
    """With the error of the chords of an exponential rise."""
    room = _CHORD_ERROR * abs(one.value)
    return (
        one
        if math.isinf(one.value)
        else replace(one, low=max(one.low - room, 0.0), high=one.high + room, numerical=room)
    )


def _bounds(train: Train, brake: Brake, speed: float, lifts: bool, frequency: float) -> Bounded:
    value = emergency_stop(train, brake, speed, lifts)
    swing = _swing(train, brake, lifts, frequency)
    if not swing.taut:
        return Bounded(
            *(
                Estimate.exact(one) if math.isinf(one) else Estimate.unknown(one)
                for one in (value.time, value.speed_max, value.up, value.down, value.up + value.down, value.heat)
            )
        )
    d = swing.speed
    others = [emergency_stop(train, brake, max(speed + way * d, 0.0), lifts) for way in (-1.0, 1.0)]
    if lifts:
        others.append(emergency_stop(train, brake, max(speed - d, 0.0), lifts, _SWINGS * d))
    times = [one.time for one in (value, *others)] + [others[0].first_rest]
    late = max(max(times) - value.time, value.time - min(times)) if math.isfinite(max(times)) else math.inf
    room = d * late + swing.angle
    hull = [_hull(value, others, way, room) for way in ("up", "down")]
    if not brake.on_drum:
        turned = getattr(value, "up" if lifts else "down")
        hull[0 if lifts else 1] = _between(turned, max(turned - room, 0.0), turned + swing.angle)
    up, down = hull
    moved = _torque(train, lifts) * (up.high - up.low + down.high - down.low)
    return Bounded(
        _between(value.time, min(times), max(times)),
        _between(value.speed_max, value.speed_max - d, value.speed_max + d),
        up,
        down,
        _between(value.up + value.down, up.low + down.low, up.high + down.high),
        _between(value.heat, max(value.heat - moved - swing.energy, 0.0), value.heat + moved),
    )


def _hull(value: Emergency, others: list[Emergency], way: str, room: float) -> Estimate:
    """Angle in one direction among those of several rigid trains."""
    angles = [getattr(one, way) for one in (value, *others)]
    return (
        _between(angles[0], max(min(angles) - room, 0.0), max(angles) + room)
        if max(angles) > 0
        else Estimate.exact(0.0)
    )


def _torque(train: Train, lifts: bool) -> float:
    """Largest torque of the load on the motor shaft [N*m]."""
    return max(train.held, train.load_up / train.ratio / train.efficiency if lifts else 0.0)


def _swing(train: Train, brake: Brake, lifts: bool, frequency: float) -> _Swing:
    """Bounds of the relative motion, for the losses of the gear in either direction where they may change."""
    found = [_of_losses(train, brake, lifts, frequency, passed) for passed in _losses(train, brake, lifts)]
    return _Swing(
        max(one.speed for one in found),
        max(one.angle for one in found),
        max(one.energy for one in found),
        all(one.taut for one in found),
    )


def _losses(train: Train, brake: Brake, lifts: bool) -> tuple[float, ...]:
    """Torque on the motor shaft over that on the drum shaft times the ratio."""
    forward, back = 1 / train.efficiency, train.reverse_efficiency
    return (forward, back) if lifts or brake.on_drum else (back,)


def _of_losses(train: Train, brake: Brake, lifts: bool, frequency: float, passed: float) -> _Swing:
    if passed <= 0:
        return _Swing(0.0, 0.0, 0.0, taut=False)
    part = passed / train.ratio**2
    near, far = train.motor_inertia + train.drum_inertia * part, (train.mass_up if lifts else train.mass_down) * part
    load = (train.load_up if lifts else train.load_down) * passed / train.ratio
    braking = brake.torque * (passed / train.ratio if brake.on_drum else 1.0)
    share = far / (near + far)
    w = frequency * math.sqrt(1 + far / near)
    speed = (load + _softened(brake, w) * braking) / near / w
    angle = 2 * (load + braking if lifts else max(load, braking)) / near / w**2
    taut = load > 2 * (load + braking) * share if lifts else share < 1 / 2
    energy = far * (speed**2 + (frequency * angle) ** 2) / 2
    return _Swing(speed * share, angle * share, energy, taut)


def _softened(brake: Brake, w: float) -> float:
    """Relative speed that the brake excites, over that of a brake that closes at once [1]."""
    rise = w * brake.rise_time
    return min(1.0, 2 / math.hypot(1.0, rise) if brake.rise == EXPONENTIAL else 2 / rise if rise > 0 else 1.0)


def _between(value: float, low: float, high: float) -> Estimate:
    """A value between two others, or infinite."""
    if math.isinf(value):
        return Estimate.exact(value)
    if not math.isfinite(high) or math.isnan(low):
        return Estimate.unknown(value)
    return Estimate(value, min(low, value), max(high, value), model=max(high - value, value - low, 0.0))
