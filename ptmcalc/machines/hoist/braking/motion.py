"""A drive that the brake stops after the power is lost: speed, travel and heat from piece to piece."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptmcalc.laws import gearing
from ptmcalc.laws.brake import EXPONENTIAL, braking_torque

FloatArray = NDArray[np.float64]

_CHORDS, _LONG = 20_000, 40.0
"""Chords of an exponential rise [1], and time constants that they cover [1]. Numerical choices: chords that lengthen
with time miss 13/20000^2 = 3.3e-8 of the momentum M t_r; after 40 constants e^-40 of the torque is missing. More
chords take longer."""
_JAMMED = 1e12
"""Deceleration that stands for a gear that jams [rad/s^2]. A numerical choice: the drive is then at rest within 1e-9
s. A smaller value lengthens such a stop."""


@dataclass(frozen=True, slots=True)
class Train:
    """Rigid drive with the load on its rope."""

    motor_inertia: float
    """on the motor shaft [kg*m^2]"""
    drum_inertia: float
    """on the drum shaft [kg*m^2]"""
    mass_up: float
    """hoisted mass on the drum shaft, with the losses of the reeving [kg*m^2]"""
    mass_down: float
    """lowered mass on the drum shaft, with the losses of the reeving [kg*m^2]"""
    load_up: float
    """torque of the hoisted load on the drum shaft [N*m]"""
    load_down: float
    """torque of the lowered load on the drum shaft [N*m]"""
    ratio: float
    efficiency: float
    reverse_efficiency: float

    def load_inertia(self, way: float) -> float:
        """Drum and mass on the drum shaft, hoisted (1) or lowered (-1) [kg*m^2]."""
        return self.drum_inertia + (self.mass_up if way > 0 else self.mass_down)

    @property
    def held(self) -> float:
        """Torque on the motor shaft that keeps the load at rest; not above 0 for a gear that locks itself [N*m]."""
        return self.load_down * self.reverse_efficiency / self.ratio


@dataclass(frozen=True, slots=True)
class Brake:
    """Brake on one of the shafts."""

    torque: float
    """[N*m]"""
    delay: float
    rise_time: float
    rise: str
    on_drum: bool


@dataclass(frozen=True, slots=True)
class Emergency:
    """Motion of the motor shaft from the loss of power to rest; infinite where the brake does not stop it."""

    time: float
    """[s]"""
    speed_max: float
    """[rad/s]"""
    up: float
    """angle in the direction of hoisting [rad]"""
    down: float
    """angle in the direction of lowering, after that [rad]"""
    heat: float
    """work of the brake [J]"""
    first_rest: float
    """time of the first rest, at which a load that was hoisted may sink again [s]"""


@dataclass(frozen=True, slots=True)
class _Part:
    """Motion in one direction until the drive is at rest."""

    time: float
    peak: float
    angle: float
    work: float
    """integral of the brake torque over the angle of the motor shaft [J]"""


def emergency_stop(train: Train, brake: Brake, speed: float, lifts: bool, sinking: float = 0.0) -> Emergency:
    """Motion from a speed of the motor shaft [rad/s] until the brake has stopped it.

    A load that is hoisted slows the drive down; it sinks again, at first with `sinking` [rad/s], where the brake does
    not hold it by then.
    """
    parts: list[_Part] = []
    up = down = 0.0
    time = 0.0
    if lifts:
        parts.append(_part(train, brake, speed, 0.0, 1.0))
        time, up, speed = parts[0].time, parts[0].angle, sinking
    if not (lifts and _holds(train, brake, time)):
        parts.append(_part(train, brake, speed, time, -1.0))
        time, down = parts[-1].time, parts[-1].angle
    work = sum(part.work for part in parts) / (train.ratio if brake.on_drum else 1.0)
    return Emergency(time, max(part.peak for part in parts), up, down, work, parts[0].time)


def _holds(train: Train, brake: Brake, time: float) -> bool:
    """Whether the brake keeps the load at rest at a time after the loss of power."""
    torque = float(braking_torque(time, brake.torque, brake.delay, brake.rise_time, brake.rise))
    return (torque >= train.load_down or train.held <= 0) if brake.on_drum else torque >= train.held


def _times(train: Train, brake: Brake, begin: float, way: float) -> FloatArray:
    """Times between which the acceleration is a straight line: delay, rise, change of the loaded side of the gear."""
    after = brake.delay
    if way < 0:
        kink = train.load_down if brake.on_drum else math.inf
    else:
        kink = (
            math.inf if brake.on_drum else train.load_up * train.ratio * train.motor_inertia / train.load_inertia(way)
        )
    share = kink / brake.torque
    found = [np.array([begin, after, after + brake.rise_time])]
    if brake.rise_time > 0 and brake.rise == EXPONENTIAL:
        found.append(after + brake.rise_time * _LONG * np.linspace(0.0, 1.0, _CHORDS + 1) ** 2)
        found.append(np.array([after - brake.rise_time * math.log1p(-share)] if share < 1 else []))
    elif share < 1:
        found.append(np.array([after + brake.rise_time * share]))
    times = np.unique(np.concatenate(found))
    return times[times >= begin]


def _acceleration(train: Train, brake: Brake, torque: FloatArray, way: float) -> FloatArray:
    """Of the motor shaft, in the direction of its motion [rad/s^2]."""
    load = (train.load_up if way > 0 else train.load_down) + (way * torque if brake.on_drum else 0.0)
    found = way * gearing.motor_acceleration(
        np.zeros_like(torque) if brake.on_drum else -way * torque,
        way,
        load,
        train.motor_inertia,
        train.load_inertia(way),
        train.ratio,
        train.efficiency,
        train.reverse_efficiency,
    )
    return np.maximum(found, -_JAMMED)


def _part(train: Train, brake: Brake, speed: float, begin: float, way: float) -> _Part:
    """Motion in one direction: speed a parabola, angle a cubic in time between `_times`.

    A brake that closes at once jumps to its torque at the end of the delay: pieces take the torque at their inner side.
    """
    times = _times(train, brake, begin, way)
    closes = braking_torque(times, brake.torque, brake.delay, brake.rise_time, brake.rise)
    ends = closes[1:].copy()
    if brake.rise_time == 0:
        ends[times[1:] <= brake.delay] = 0.0
    starts, spans = closes[:-1], np.diff(times)
    first, second = (_acceleration(train, brake, torque, way) for torque in (starts, ends))
    speeds = speed + np.concatenate([[0.0], np.cumsum((first + second) / 2 * spans)])
    stopped = np.flatnonzero(speeds[1:] <= 0)
    last = int(stopped[0]) if len(stopped) else len(spans)
    whole = slice(0, last)
    angle, work = _summed(speeds[:last], first[whole], second[whole], starts[whole], ends[whole], spans[whole])
    peak = _peak(speeds[: last + 1], first[whole], second[whole], spans[whole])
    if last < len(spans):
        rate = (second[last] - first[last]) / spans[last]
        left = _time_to_rest(float(speeds[last]), float(first[last]), float(rate))
        end = starts[last] + (ends[last] - starts[last]) * left / spans[last]
        pieces = (speeds[last], first[last], first[last] + rate * left, starts[last], end, left)
        more, worked = _summed(*(np.array([one]) for one in pieces))
        peak = max(
            peak, _peak(np.array([speeds[last], 0.0]), *(np.array([one]) for one in (pieces[1], pieces[2], left)))
        )
        return _Part(float(times[last]) + left, peak, angle + more, work + worked)
    final = float(_acceleration(train, brake, np.array([brake.torque]), way)[0])
    if final >= 0:
        return _Part(math.inf, math.inf, math.inf, math.inf)
    left = float(speeds[-1]) / -final
    more = float(speeds[-1]) * left / 2
    return _Part(float(times[-1]) + left, peak, angle + more, work + brake.torque * more)


def _summed(
    speeds: FloatArray, first: FloatArray, second: FloatArray, starts: FloatArray, ends: FloatArray, spans: FloatArray
) -> tuple[float, float]:
    """Angle and work of pieces: Simpson's rule is exact for the cubics."""
    middle = speeds + (3 * first + second) * spans / 8
    after = speeds + (first + second) * spans / 2
    angle = float(np.sum((speeds + 4 * middle + after) * spans)) / 6
    return angle, float(np.sum((starts * speeds + 2 * (starts + ends) * middle + ends * after) * spans)) / 6


def _peak(speeds: FloatArray, first: FloatArray, second: FloatArray, spans: FloatArray) -> float:
    """Largest speed at the ends of pieces, or where the acceleration changes its sign in one."""
    turns = (first > 0) & (second < 0)
    inside = speeds[:-1][turns] + first[turns] ** 2 * spans[turns] / (2 * (first[turns] - second[turns]))
    return float(max(speeds.max(), inside.max(initial=0.0)))


def _time_to_rest(speed: float, first: float, rate: float) -> float:
    """Positive root of w + a t + j t^2/2 = 0 for a concave course of the speed."""
    root = math.sqrt(max(first**2 - 2 * rate * speed, 0.0))
    if first > 0:
        return (first + root) / -rate
    return 2 * speed / (root - first) if root > first else 0.0
