"""The force of a drive that follows the torque curves of its motors, as plain numbers that C and Python read alike."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

SHAPES = "ramp", "cosine", "parabolic"
"""Rises of the reference of a converter that have a formula, in the order in which C knows them."""
Shape = str | tuple[tuple[float, float], ...]
"""One of them, or points (share of the rise time, share of the reference) with straight lines between them."""
_BELOW = 1 - 1e-9
"""Speed at the end of a stage relative to that at which the next one begins [1]; a numerical choice near 1."""


@dataclass(frozen=True, slots=True)
class Kloss:
    """Torque of an induction motor, M = 2 M_k (1 + q) x/(1 + 2 q x + x^2) with x = s/s_k or its inverse.

    `torque` M_k [N*m], `slip` s_k, `stator` q = a s_k, `synchronous` w_0 [rad/s].
    """

    torque: float
    slip: float
    stator: float
    synchronous: float

    def at(self, speed: float) -> tuple[float, float]:
        """Torque [N*m] and its slope over the speed [N*m*s/rad]."""
        slip = (self.synchronous - speed) / self.synchronous
        inside = abs(slip) <= self.slip
        x = slip / self.slip if inside else self.slip / slip
        below = (1 + x) * (1 + x) - 2 * x * (1 - self.stator)
        most = 2 * self.torque * (1 + self.stator)
        rise = (1 - x) * (1 + x) * (1.0 if inside else -x * x) / (below * below)
        return most * x / below, -most / self.slip * rise / self.synchronous


@dataclass(frozen=True, slots=True)
class CurveStage:
    """Torque over the speed of the motor shaft until the next stage: straight lines between knots (speed, torque) up to
    the last of them, and beyond it the formula of Kloss; one of the two may be left out."""

    knots: tuple[tuple[float, float], ...] = ()
    extends: bool = False
    """whether the first and the last line go on; else the end values hold outside"""
    kloss: Kloss | None = None
    until_speed: float = math.inf
    until_time: float = math.inf

    def at(self, speed: float) -> tuple[float, float]:
        """Torque [N*m] and its slope over the speed [N*m*s/rad]."""
        knots = self.knots
        if not knots or (self.kloss is not None and speed > knots[-1][0]):
            assert self.kloss is not None
            return self.kloss.at(speed)
        if len(knots) == 1:
            return knots[0][1], 0.0
        if not self.extends and not knots[0][0] <= speed <= knots[-1][0]:
            return knots[0 if speed < knots[0][0] else -1][1], 0.0
        index = 1
        while index < len(knots) - 1 and speed > knots[index][0]:
            index += 1
        (left, low), (right, high) = knots[index - 1], knots[index]
        rise = (high - low) / (right - left)
        return low + rise * (speed - left), rise


@dataclass(frozen=True, slots=True)
class MotorForce:
    """Force at the rim of the motors of a drive on their curve, and its slope over the rim speed, by time and speed.

        F = drives M(w, t) (M > 0),   brakes M(w, t) (M < 0),   w = turns v

    `drives` = n i eta/R and `brakes` = n i/(eta R) [1/m], `turns` [rad/m]. The motors are on from `delay` to `off`, and
    again from `again` [s]. A frequency converter moves the curve along the speed by what its reference is short of
    `reference`, to which it rises along `shape` in the time `ramp`; of a stop it falls from the share `falls_from` of
    `reference` to 0. A fluid coupling that fills with the time constant
    `fill` passes on 1 - exp(-t/fill) of the torque. A soft starter raises the voltage from `soft_from` of the rated one
    in the time `soft_time`, and the torque with its square.
    """

    stages: Sequence[CurveStage]
    turns: float
    drives: float
    brakes: float
    delay: float = 0.0
    off: float = -math.inf
    again: float = 0.0
    reference: float = 0.0
    ramp: float = 0.0
    shape: Shape = "ramp"
    falls_from: float = 0.0
    fill: float = 0.0
    soft_from: float = 1.0
    soft_time: float = 0.0

    def __call__(self, time: float, speed: float) -> tuple[float, float]:
        since = time - (self.delay if time < self.off else self.again)
        if since < 0:
            return 0.0, 0.0
        turning = speed * self.turns
        late = 0
        while late < len(self.stages) - 1:
            stage = self.stages[late]
            if turning < stage.until_speed and since < stage.until_time:
                break
            late += 1
        return self.in_stage(late, since, speed)

    def in_stage(self, late: int, since: float, speed: float) -> tuple[float, float]:
        """Force in a stage so long after switching on, and its slope over the rim speed."""
        turning = speed * self.turns
        if self.ramp > 0:
            share = self._reference_at(since / self.ramp)
            turning += self.reference * (1 - (self.falls_from * (1 - share) if self.falls_from > 0 else share))
        torque, rise = self.stages[late].at(turning)
        factor = (self.drives if torque > 0 else self.brakes) * self._rises(since)
        return factor * torque, factor * rise * self.turns

    @property
    def marks(self) -> list[float]:
        """Speeds of the rim at which lines of the curve meet or a stage ends, and just below those [m/s]."""
        at = [speed for stage in self.stages for speed in (*(knot for knot, _ in stage.knots), stage.until_speed)]
        return [
            mark for speed in at if 0 < speed < math.inf for mark in (speed / self.turns, speed / self.turns * _BELOW)
        ]

    def _reference_at(self, part: float) -> float:
        """Share of the reference at a share of its rise time: u, sin^2(pi u/2), two parabolas, or between points."""
        if part >= 1:
            return 1.0
        if not isinstance(self.shape, str):
            (before, low), (after, high) = next(pair for pair in pairwise(self.shape) if part <= pair[1][0])
            return low + (high - low) * (part - before) / (after - before)
        if self.shape == "cosine":
            return math.sin(math.pi / 2 * part) ** 2
        if self.shape == "parabolic":
            return 2 * part**2 if part < 0.5 else 1 - 2 * (1 - part) ** 2
        return part

    def _rises(self, since: float) -> float:
        """Part of the torque that acts so long after switching on [1]."""
        part = -math.expm1(-since / self.fill) if self.fill > 0 else 1.0
        if self.soft_time > 0:
            part *= (self.soft_from + (1 - self.soft_from) * min(since / self.soft_time, 1.0)) ** 2
        return part
