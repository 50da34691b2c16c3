"""What the links' elasticity can add to the loads of the rigid train, from its modes and the torques over time alone.

Each mode obeys q'' + w^2 q = p s(t). The rigid train is its quasi-static part p s/w^2; d = q - p s/w^2 is what it
leaves out. From d0 at the start on

    d = d0 cos w t - p/w^2 int cos w(t - x) ds(x)

so a jump of s leaves |p| jump/w^2, and a smooth part its variation, or a corner of slope |p| corner/w^3, whichever is
less. Of a sine s = A sin(W t + f) it leaves, with r = W^2/(w^2 - W^2),

    d = p A/w^2 (r sin(W t + f) - r sin f cos w t - (1 + r) (W/w) cos f sin w t)

and so never more than |p A|/w^2 (|r| + ((r sin f)^2 + ((1 + r) (W/w) cos f)^2)^(1/2)); near resonance its variation in
the window is less. A link torque, a speed, an angle is a weighted sum of modes.

Damping ties the modes together, but it never adds energy. After a step of s the deviation swings freely with the
energy E = 1/2 sum (p s/w)^2 at most; after a corner of s' it does so round the lag b v of the dampers, with
E = 1/2 sum (p s'/w^2)^2 + 1/2 sum (b v)^2/C. A link then carries at most

    |C x + b v| <= (2 E (C + b^2 m))^(1/2),    m = the two inverse inertias of the link
"""

import math
from dataclasses import dataclass

import numpy as np

from ptmcalc.machines.drivetrain.machine.model import REACHED, Case
from ptmcalc.numerics.train.parts import LINEAR, Drive, Train
from ptmcalc.numerics.train.signals import FloatArray, Signal, Sine
from ptmcalc.numerics.train.tree import Groups

_QUIET = 1e-9
"""Stretching speed of a link relative to the speeds at its ends [1] that counts as rounding. A numerical choice above
the resolution 2e-16 of the floating point. A smaller value withdraws the bound for rounding; a larger one ignores an
initial oscillation."""
_TIED = 1e-9
"""Relative tolerance of frequencies [1], above the resolution 2e-16 of the floating point; a numerical choice. Within
it a sine is in resonance, and below it, relative to the highest frequency, a mode has no stiffness. A larger value
omits slow modes; a smaller one takes rounding for a mode."""


@dataclass(frozen=True, slots=True)
class Swings:
    """Bounds of what elasticity changes, each for the whole window: torques of links, torques of gears on their outer
    side, speeds and angles of bodies."""

    links: FloatArray
    meshes: FloatArray
    speeds: FloatArray
    angles: FloatArray


@dataclass(frozen=True, slots=True)
class _Course:
    """What a torque over time does within a window: sums of sizes."""

    first: float
    jumps: float
    variation: float
    corners: float
    reach: float
    """most it departs from its first value"""
    steepest: float
    sines: tuple[tuple[Sine, float], ...] = ()
    """each with its turns in the window [rad]; not in `variation` and `corners`"""

    @property
    def every_variation(self) -> float:
        """Variation with that of the sines."""
        return self.variation + sum(_sine_variation(sine, turned) for sine, turned in self.sines)

    @property
    def every_corner(self) -> float:
        """Corners with those of the sines."""
        return self.corners + sum(_sine_corners(sine, turned) for sine, turned in self.sines)

    def stray(self, frequencies: FloatArray) -> FloatArray:
        """Most that the course leaves of a mode beside its quasi-static part, over that part of a torque of 1."""
        found: FloatArray = self.jumps + np.minimum(self.variation, self.corners / frequencies)
        for sine, turned in self.sines:
            most = np.minimum(_sine_variation(sine, turned), _sine_corners(sine, turned) / frequencies)
            found = found + np.minimum(most, _forced(sine, frequencies))
        return found


def _sine_variation(sine: Sine, turned: float) -> float:
    return abs(sine.size) * (2 + 2 / math.pi * turned)


def _sine_corners(sine: Sine, turned: float) -> float:
    return abs(sine.size) * sine.frequency * (3 + 2 / math.pi * turned)


def _forced(sine: Sine, frequencies: FloatArray) -> FloatArray:
    """The largest swing under a sine, the forced and the free one together; infinite in resonance."""
    apart = frequencies**2 - sine.frequency**2
    in_step = np.abs(apart) <= _TIED * frequencies**2
    share = sine.frequency**2 / np.where(in_step, 1.0, apart)
    quick = sine.frequency / frequencies
    free = np.hypot(share * math.sin(sine.phase), (1 + share) * quick * math.cos(sine.phase))
    found: FloatArray = np.where(in_step, math.inf, abs(sine.size) * (np.abs(share) + free))
    return found


@dataclass(frozen=True, slots=True)
class _Modes:
    """Elastic modes: frequencies (n,), what each brings to a link's torque per w q (links, n) and to the travel of a
    group (n, groups)."""

    frequencies: FloatArray
    torques: FloatArray
    shapes: FloatArray


def swings(case: Case, end: float) -> Swings | None:
    """What elasticity can change within a time; None where the train is not linear or starts swinging."""
    train, groups = case.train, Groups.among(case.train)
    rows = np.array([groups.row(one.first, one.second) for one in train.springs]).reshape(-1, groups.count)
    if not is_linear(train) or not _quiet(train, groups, rows):
        return None
    modes = _modes(train, groups, rows)
    if len(modes.frequencies) < len(train.springs):
        return None  # links in parallel: how they share a torque is not known to the rigid train
    start = _start(train, modes)
    pushes, courses = [], []
    for drive in train.drives:
        signal = signal_of(drive)
        if not drive.name.startswith(REACHED) and signal is not None:
            course = _course(signal, end)
            push = modes.shapes[:, groups.of[drive.body]] * groups.ratio[drive.body]
            start = start - push * course.first / modes.frequencies**2
            pushes.append(push)
            courses.append(course)
    along = np.array(pushes).reshape(-1, len(start))
    damped = any(one.damping for one in train.springs)
    links, speeds, angles = (_energies if damped else _amplitudes)(train, rows, groups, modes, start, along, courses)
    harder = np.abs(rows).T @ links / groups.inertias(train)
    meshes = [_through_gear(train, groups, index, harder, links) for index in range(len(train.meshes))]
    bodies, ratio = list(groups.of), np.abs(groups.ratio)
    return Swings(links, np.array(meshes), ratio * speeds[bodies], ratio * angles[bodies])


def is_linear(train: Train) -> bool:
    """Whether torques depend on time alone and nothing in the train slips, locks, opens or loses."""
    return (
        not (train.grips or train.guides or train.impulses)
        and not any(mesh.lossy for mesh in train.meshes)
        and all(spring.law == LINEAR and spring.second is not None for spring in train.springs)
        and all(signal_of(drive) is not None for drive in train.drives)
    )


def signal_of(drive: Drive) -> Signal | None:
    """The torque of a drive over time; None where it depends on more."""
    law = drive.stages[0].law
    plain = len(drive.stages) == 1 and isinstance(law, Signal) and drive.gate.values == (1.0,) and not law.decay
    if not plain or not isinstance(law, Signal):
        return None
    return law if law.trigger is None or law.values == (0.0,) else None


def _quiet(train: Train, groups: Groups, rows: FloatArray) -> bool:
    """Whether all bodies start as one: no link is being stretched."""
    speeds = np.zeros(groups.count)
    for body, group, ratio in zip(train.bodies, groups.of, groups.ratio, strict=True):
        speeds[group] = body.speed / ratio
    return bool((np.abs(rows @ speeds) <= _QUIET * (np.abs(rows) @ np.abs(speeds))).all())


def _modes(train: Train, groups: Groups, rows: FloatArray) -> _Modes:
    """Modes from the singular values of K^(1/2) D M^(-1/2): those of no stiffness, the free travel, are left out."""
    inertia = np.sqrt(groups.inertias(train))
    stiffness = np.sqrt(np.array([one.stiffness for one in train.springs]))
    left, values, right = np.linalg.svd(rows / inertia * stiffness[:, None], full_matrices=False)
    joins = all(groups.of[one.first] != groups.of[one.second] for one in train.springs if one.second is not None)
    there = (values > _TIED * values.max(initial=0.0)) & joins
    return _Modes(values[there], left[:, there] * stiffness[:, None], right[there] / inertia)


def _start(train: Train, modes: _Modes) -> FloatArray:
    """Modes' travel at the start, from the extensions of the links."""
    bodies = train.bodies
    apart = [
        bodies[one.first].position - bodies[one.second].position - one.rest
        for one in train.springs
        if one.second is not None
    ]
    found: FloatArray = modes.torques.T @ np.array(apart) / modes.frequencies
    return found


def _amplitudes(
    train: Train,
    rows: FloatArray,
    groups: Groups,
    modes: _Modes,
    start: FloatArray,
    along: FloatArray,
    courses: list[_Course],
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Swings of links' torques, groups' speeds and angles without damping: mode by mode."""
    w, shapes = modes.frequencies, np.abs(modes.shapes)
    stray, reach, rate = np.abs(start), np.abs(start), np.zeros(len(w))
    for push, course in zip(np.abs(along) / w**2, courses, strict=True):
        stray = stray + push * course.stray(w)
        reach, rate = reach + push * course.reach, rate + push * course.steepest
    return np.abs(modes.torques) @ (w * stray), shapes.T @ (w * stray + rate), shapes.T @ (stray + reach)


def _energies(
    train: Train,
    rows: FloatArray,
    groups: Groups,
    modes: _Modes,
    start: FloatArray,
    along: FloatArray,
    courses: list[_Course],
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """The same with damping of any kind: by the energy that no damper adds to."""
    w, shapes = modes.frequencies, np.abs(modes.shapes)
    stiffness = np.array([one.stiffness for one in train.springs])
    damping = np.array([one.damping for one in train.springs])
    lightness = rows**2 @ (1 / groups.inertias(train))
    size = math.sqrt(float((w * start) @ (w * start)))
    reach, rate, lag = np.abs(start), np.zeros(len(w)), np.zeros(len(w))
    for push, course in zip(along, courses, strict=True):
        dampers = damping * (modes.torques @ (push / w)) / stiffness
        step = math.sqrt(float((push / w) @ (push / w)))
        corner = math.sqrt(float((push / w**2) @ (push / w**2) + dampers**2 @ (1 / stiffness)))
        size += step * course.jumps + min(step * course.every_variation, corner * course.every_corner)
        reach, rate = reach + np.abs(push) / w**2 * course.reach, rate + np.abs(push) / w**2 * course.steepest
        lag = lag + np.abs(modes.torques.T @ (dampers / stiffness)) / w * course.steepest
    links = size * np.sqrt(stiffness + damping**2 * lightness)
    speeds = size * np.sqrt((shapes**2).sum(axis=0)) + shapes.T @ rate
    angles = size * np.sqrt(((shapes / w[:, None]) ** 2).sum(axis=0)) + shapes.T @ (reach + lag)
    return links, speeds, angles


def _through_gear(train: Train, groups: Groups, index: int, harder: FloatArray, torque: FloatArray) -> float:
    """Swing of the torque on a gear's outer side: what the inertias behind it and the links tied to them can ask."""
    mesh = train.meshes[index]
    behind = {mesh.outer}
    for _ in train.meshes:
        for other in (one for i, one in enumerate(train.meshes) if i != index):
            if {other.inner, other.outer} & behind:
                behind |= {other.inner, other.outer}
    swing = 0.0
    for body in behind:
        share = abs(groups.ratio[body] / groups.ratio[mesh.outer])
        tied = [torque[i] for i, one in enumerate(train.springs) if body in (one.first, one.second)]
        inertia = train.bodies[body].inertia * abs(groups.ratio[body]) * harder[groups.of[body]]
        swing += share * float(inertia + sum(tied))
    return swing


def _course(signal: Signal, end: float) -> _Course:
    """What a torque does within a window."""
    first = signal.values[0]
    inside = [k for k, time in enumerate(signal.times) if time < end]
    jumps, variation, corners, reach, steepest = 0.0, 0.0, abs(signal.slopes[0]), 0.0, 0.0
    for k in inside:
        until = min(signal.times[k + 1] if k + 1 < len(signal.times) else end, end)
        last = signal.values[k] + signal.slopes[k] * (until - signal.times[k])
        variation += abs(last - signal.values[k])
        reach = max(reach, abs(last - first), abs(signal.values[k] - first))
        steepest = max(steepest, abs(signal.slopes[k]))
        if k + 1 in inside:
            jumps += abs(signal.values[k + 1] - last)
            corners += abs(signal.slopes[k + 1] - signal.slopes[k])
    sines = []
    for sine in signal.sines:
        size, turned = abs(sine.size), sine.frequency * end
        first += sine.size * math.sin(sine.phase)
        sines.append((sine, turned))
        reach, steepest = reach + 2 * size, steepest + size * sine.frequency
    return _Course(first, jumps, variation, corners, reach, steepest, tuple(sines))
