"""What the links' elasticity and their play can change, from the rigid train and the modes alone.

The n-th mode obeys q'' + w^2 q = p s(t). The rigid train is its quasi-static part p s/w^2, so what elasticity adds
obeys d'' + w^2 d = -(p/w^2) s''. A jump of s leaves |p| jump/w^2; a corner, a jump of s', leaves |p| corner/w^3. Hence

    |d| <= |p|/w^2 g,   g = sum |jumps of s| + min(variation of the rest, sum |corners|/w)

and a link torque, a speed, an angle is a weighted sum of modes. Damping only takes from it.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.contract.result import of
from ptmcalc.laws import backlash
from ptmcalc.machines.drivetrain import motion
from ptmcalc.machines.drivetrain.model import REACHED, Case, case_of, rigid
from ptmcalc.machines.drivetrain.spec import Drivetrain, TrainScene
from ptmcalc.numerics.train.parts import LINEAR, RIGID, Drive, Train
from ptmcalc.numerics.train.signals import FloatArray, Signal
from ptmcalc.numerics.train.tree import Groups

_ONE_SIGN = 1e-6
_TOLERANCE = 1e-8


@dataclass(frozen=True, slots=True)
class _Rigid:
    """Largest and smallest torque of every link in the rigid train."""

    high: Mapping[str, float]
    low: Mapping[str, float]

    def largest(self, name: str) -> float:
        return max(abs(self.high.get(name, 0.0)), abs(self.low.get(name, 0.0)))


@lru_cache(maxsize=64)
def _rigid(key: "_Scene") -> _Rigid:
    spec, scene = key.spec, key.scene
    case = case_of(spec, scene)
    course = motion.run(rigid(case_of(spec, scene, backlash=False)), motion.window(scene, case), _TOLERANCE)
    named = {name: course.torque(name) for name in (*spec.links, *spec.gears)}
    high = {name: float(course.record.top.values[i]) for name, i in named.items() if i is not None}
    low = {name: float(course.record.bottom.values[i]) for name, i in named.items() if i is not None}
    return _Rigid(high, low)


@dataclass(frozen=True, slots=True)
class _Scene:
    spec: Drivetrain
    scene: TrainScene

    def __hash__(self) -> int:
        return hash((id(self.spec), id(self.scene)))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Scene) and self.spec is other.spec and self.scene is other.scene


def largest_share(spec: Drivetrain, scene: TrainScene) -> float:
    """Largest bound of a link torque's swing over the rigid train's torque in that link."""
    if not spec.links:
        return 0.0
    found = swings(spec, scene)
    if found is None:
        return math.inf
    torques = _rigid(_Scene(spec, scene))
    shares = [0.0]
    for name in spec.links:
        swing = found[of("torque_peak", name)].high
        if swing > 0:
            largest = torques.largest(name)
            shares.append(swing / largest if largest > 0 else math.inf)
    return max(shares)


def swings(spec: Drivetrain, scene: TrainScene) -> Mapping[str, Interval] | None:
    """Offsets that hold what elasticity changes in each load of the rigid train; None where it is not linear."""
    case = case_of(spec, scene, backlash=spec.effects.get("backlash") != "off")
    train = case.train
    if not _linear(train) or not _starts_quietly(case):
        return None
    end = motion.window(scene, case)
    groups = Groups.among(train)
    inertia = np.sqrt(groups.inertias(train))
    rows = np.array([groups.row(one.first, one.second) for one in train.springs]).reshape(-1, groups.count)
    stiffness = np.sqrt(np.array([one.stiffness for one in train.springs]))
    left, values, right = np.linalg.svd(rows / inertia * stiffness[:, None], full_matrices=False)
    there = values > 1e-9 * values.max(initial=0.0)
    speeds, links, shapes = values[there], left[:, there] * stiffness[:, None], right[there] / inertia
    loaded = scene.links == "loaded" or (scene.links is None and case.stopping)
    stray, level, rate = np.zeros(len(speeds)), np.zeros(len(speeds)), np.zeros(len(speeds))
    for drive in train.drives:
        if drive.name == REACHED:
            continue
        pushed = np.abs(shapes[:, groups.of[drive.body]] * groups.ratio[drive.body]) / speeds**2
        signal = _signal(drive)
        assert signal is not None
        jumps, variation, corners, largest, steepest = _course(signal, end, loaded)
        stray += pushed * (jumps + np.minimum(variation, corners / speeds))
        level += pushed * largest
        rate += pushed * steepest
    torque = np.abs(links) @ (speeds * stray)
    across, faster = np.abs(shapes).T @ (stray + level), np.abs(shapes).T @ (speeds * stray + rate)
    found = {of("torque_peak", one.name): _around(swing) for one, swing in zip(train.springs, torque, strict=True)}
    harder = np.abs(shapes).T @ (speeds**2 * stray)
    for index, mesh in enumerate(train.meshes):
        found[of("torque_peak", mesh.name)] = _around(_through_gear(train, groups, index, harder, torque))
    torques = _rigid(_Scene(spec, scene))
    for name in (*spec.links, *spec.gears):
        swing, largest = found[of("torque_peak", name)].high, torques.largest(name)
        share = swing / largest if largest > 0 else math.inf
        found[of("dynamic_factor", name)] = _around(share) if swing > 0 else Interval(0.0, 0.0)
    for name, group, ratio in zip(case.bodies, groups.of, np.abs(groups.ratio), strict=True):
        for family in ("speed_max", "speed_min", "speed_end"):
            found[of(family, name)] = _around(ratio * faster[group])
        found[of("angle_end", name)] = _around(ratio * across[group])
    for name in spec.motors:
        for family in ("motor_torque_peak", "motor_torque_rms"):
            found[of(family, name)] = Interval(0.0, 0.0)
    return found


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


def _around(size: float) -> Interval:
    return Interval(-float(size), float(size))


def _linear(train: Train) -> bool:
    """Whether torques depend on time alone and nothing in the train slips, locks, opens or loses."""
    return (
        not (train.grips or train.guides or train.impulses)
        and not any(mesh.lossy for mesh in train.meshes)
        and all(spring.law == LINEAR and spring.second is not None for spring in train.springs)
        and all(_signal(drive) is not None for drive in train.drives)
    )


def _signal(drive: Drive) -> Signal | None:
    """The torque of a drive over time; None where it depends on more."""
    law = drive.stages[0].law
    plain = len(drive.stages) == 1 and isinstance(law, Signal) and drive.gate.values == (1.0,) and not law.decay
    if not plain or not isinstance(law, Signal):
        return None
    return law if law.trigger is None or law.values == (0.0,) else None


def _starts_quietly(case: Case) -> bool:
    """Whether all bodies start as one: no oscillation is there before anything acts."""
    train = case.train
    groups = Groups.among(train)
    speeds = np.zeros(groups.count)
    for body, group, ratio in zip(train.bodies, groups.of, groups.ratio, strict=True):
        speeds[group] = body.speed / ratio
    rows = np.array([groups.row(one.first, one.second) for one in train.springs]).reshape(-1, groups.count)
    return bool((np.abs(rows @ speeds) <= 1e-9 * (np.abs(rows) @ np.abs(speeds))).all())


def _course(signal: Signal, end: float, loaded: bool) -> tuple[float, float, float, float, float]:
    """Of a torque over a window: its jumps, the variation of the rest, its corners, largest value and slope."""
    inside = [k for k, time in enumerate(signal.times) if time < end]
    jumps = 0.0 if loaded else abs(signal.values[0])
    corners, variation = abs(signal.slopes[0]), 0.0
    largest, steepest = 0.0, 0.0
    for k in inside:
        until = min(signal.times[k + 1] if k + 1 < len(signal.times) else end, end)
        last = signal.values[k] + signal.slopes[k] * (until - signal.times[k])
        variation += abs(last - signal.values[k])
        largest = max(largest, abs(last), abs(signal.values[k]))
        steepest = max(steepest, abs(signal.slopes[k]))
        if k + 1 in inside:
            jumps += abs(signal.values[k + 1] - last)
            corners += abs(signal.slopes[k + 1] - signal.slopes[k])
    for sine in signal.sines:
        size, turned = abs(sine.size), sine.frequency * end
        jumps += 0.0 if loaded else size
        variation += size * (2 + 2 / math.pi * turned)
        corners += size * sine.frequency * (3 + 2 / math.pi * turned)
        largest, steepest = largest + size, steepest + size * sine.frequency
    return jumps, variation, corners, largest, steepest


def largest_backlash(spec: Drivetrain, scene: TrainScene) -> float:
    """Largest backlash number of a link with play; infinite where its torque changes sign and opens it again."""
    case = case_of(spec, scene)
    played = [one for one in case.train.springs if one.play > 0 and one.side == 0 and one.law != RIGID]
    if not played:
        return 0.0
    torques = _rigid(_Scene(spec, scene))
    numbers = []
    for spring in played:
        high, low = torques.high.get(spring.name, 0.0), torques.low.get(spring.name, 0.0)
        largest = torques.largest(spring.name)
        if largest == 0 or min(high, -low) > _ONE_SIGN * largest:
            return math.inf
        travel = spring.play / 2 + abs(_apart(case, spring.name))
        numbers.append(2 * spring.stiffness * travel / largest)
    return max(numbers)


def _apart(case: Case, name: str) -> float:
    """Extension of a link at the start."""
    bodies, spring = case.train.bodies, next(one for one in case.train.springs if one.name == name)
    second = bodies[spring.second].position if spring.second is not None else 0.0
    return bodies[spring.first].position - second - spring.rest


def two_inertia_play(
    spec: Drivetrain, scene: TrainScene, loads: Mapping[str, Estimate]
) -> Mapping[str, Interval] | None:
    """What play adds to the link torque of two inertias that start from rest under constant torques.

        T <= T_0 (1 + sqrt(1 + Pi_b))/2

    In the play the two part under the very torque T_rigid that the link would carry, and enter it with the energy
    T_rigid D; without damping T = T_rigid (1 + sqrt(1 + 2 C D/T_rigid)).
    """
    number = largest_backlash(spec, scene)
    if number == 0:
        return {name: Interval(0.0, 0.0) for name in loads}
    case = case_of(spec, scene)
    train = case.train
    plain = _closed(train)
    constant = all(
        (signal := _signal(drive)) is not None and len(signal.times) == 1 and not signal.slopes[0] and not signal.sines
        for drive in train.drives
    )
    two = len(train.springs) == 1 and Groups.among(train).count == 2
    if not (two and constant and _linear(plain) and math.isfinite(number)):
        return None
    if any(body.speed for body in train.bodies) or train.springs[0].damping:
        return None
    name = of("torque_peak", train.springs[0].name)
    if name not in loads:
        return None
    ratio = float(backlash.backlash_peak_ratio(number))
    return {name: Interval(0.0, loads[name].high * (ratio - 1))}


def _closed(train: Train) -> Train:
    """The train with its play closed."""
    return replace(train, springs=tuple(replace(one, law=LINEAR, play=0.0) for one in train.springs))
