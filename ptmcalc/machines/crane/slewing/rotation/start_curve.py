"""The start of a rigid slewing crane along the curve of its motor: time, angle, and what its torque is worth."""

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ptmcalc.components.motor import ConverterMotor
from ptmcalc.components.motor_stage import Stage
from ptmcalc.machines.crane.slewing.machine import model
from ptmcalc.machines.crane.slewing.machine.spec import SlewingCrane, SlewingScene

FloatArray = NDArray[np.float64]

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(8)
_PANELS = 48
"""Panels between two corners of a curve: with eight nodes each, 1e-12 of a smooth one."""
_BISECTIONS = 80
"""Halvings of the speed range for the end of a timed stage [1]. A numerical choice: 2^-80 of the range is below the
resolution of floating-point numbers. Fewer than 53 leave an error of the speed; more only cost time."""


@dataclass(frozen=True, slots=True)
class Rise:
    """A start from rest to full speed."""

    time: float
    """infinite where the curve falls below the resistance [s]"""
    angle: float
    shares: tuple[tuple[float, float], ...]
    """torque of all motors on their shaft, and the share of the time in which it acts"""

    def mean(self, power: float) -> float:
        """Even torque that is worth as much, by a power of it [N*m]."""
        torques, shares = np.array(self.shares).T
        top = float(np.max(np.abs(torques)))
        return top * float(np.sum(shares * (np.abs(torques) / top) ** power)) ** (1 / power) if top else 0.0


def follows(spec: SlewingCrane) -> bool:
    """Whether the motors start the crane along a curve of their torque over the speed."""
    return spec.motor.curve is not None and not isinstance(spec.motor.curve, ConverterMotor)


def rise_of(spec: SlewingCrane, scene: SlewingScene) -> Rise | None:
    """The start along the motor's curve, stage by stage; None without a curve.

        t = integral of J dw/(M(u w) u eta - M_steady),   beta = integral of w dt

    **Range** a rigid crane; stages that end by speed or by time.
    **Error** that of Gauss's rule between the corners of the curve, some 1e-9.
    **Source** change of angular momentum.
    """
    if not follows(spec):
        return None
    inertia = model.slew_inertia(spec, scene) + model.rotor_at_column(spec)
    steady = model.steady_torque(spec, scene)
    factor = spec.motor.count * spec.gear.ratio * spec.gear.efficiency
    return _rise(spec.motor.curve, spec.motor.count, inertia, steady, factor, spec.gear.ratio, spec.speed)


@lru_cache(maxsize=64)
def _rise(curve: object, count: int, inertia: float, steady: float, factor: float, ratio: float, full: float) -> Rise:
    time = angle = speed = 0.0
    parts: list[tuple[FloatArray, FloatArray]] = []
    for stage in curve.stages:  # type: ignore[attr-defined]
        until = full if stage.until_speed is None else min(stage.until_speed / ratio, full)
        if stage.until_time is not None:
            until = _speed_by(stage, speed, full, stage.until_time - time, inertia, steady, factor, ratio)
        elif until <= speed:
            continue
        for low, high in _between(stage, ratio, speed, until):
            at, weights = _rule(low, high)
            torques = stage.torque(at * ratio)
            surplus = factor * torques - steady
            if float(np.min(surplus)) <= 0:
                return Rise(math.inf, math.inf, ((count * float(np.min(torques)), 1.0),))
            times = weights * inertia / surplus
            time += float(times.sum())
            angle += float((times * at).sum())
            parts.append((count * np.asarray(torques), times))
        speed = until
        if speed >= full:
            break
    torques, times = (np.concatenate(some) for some in zip(*parts, strict=True))
    shares = zip(torques.tolist(), (times / time).tolist(), strict=True)
    return Rise(time, angle, tuple(shares))


def _between(stage: Stage, ratio: float, low: float, high: float) -> Iterator[tuple[float, float]]:
    """Panels of a stretch of speed, the corners of the curve at their ends."""
    corners = [speed / ratio for speed, _ in stage.pieces or () if low < speed / ratio < high]
    ends = [low, *corners, high]
    for one, other in itertools.pairwise(ends):
        edges = np.linspace(one, other, _PANELS + 1)
        yield from itertools.pairwise(edges.tolist())


def _rule(low: float, high: float) -> tuple[FloatArray, FloatArray]:
    half = (high - low) / 2
    return np.asarray((low + high) / 2 + half * _NODES), np.asarray(half * _WEIGHTS)


def _speed_by(
    stage: Stage, low: float, full: float, lasts: float, inertia: float, steady: float, factor: float, ratio: float
) -> float:
    """Speed that a stage comes to in its time; that of the crane at most."""

    def taken(speed: float) -> float:
        total = 0.0
        for one, other in _between(stage, ratio, low, speed):
            at, weights = _rule(one, other)
            surplus = factor * stage.torque(at * ratio) - steady
            if float(np.min(surplus)) <= 0:
                return math.inf
            total += float((weights * inertia / surplus).sum())
        return total

    if lasts <= 0:
        return low
    if taken(full) <= lasts:
        return full
    least, most = low, full
    for _ in range(_BISECTIONS):
        middle = (least + most) / 2
        least, most = (middle, most) if taken(middle) <= lasts else (least, middle)
    return least
