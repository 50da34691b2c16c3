"""What the links' elasticity and their play can change in the loads of the rigid train."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.base.memory import remembered
from ptmcalc.contract.result import of
from ptmcalc.laws import backlash
from ptmcalc.machines.drivetrain.machine.model import case_of, rigid
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain, TrainScene
from ptmcalc.machines.drivetrain.motion import simulation
from ptmcalc.machines.drivetrain.motion import swings as modal_swings
from ptmcalc.numerics.train.parts import CLAMPED, KELVIN, LINEAR, NO_PULL, RIGID, Spring, Train
from ptmcalc.numerics.train.tree import Groups

_ONE_SIGN = 1e-6
"""Torque of the other sign, relative to the largest, that counts as rounding [1]. A numerical choice, 100 times
`_TOLERANCE`. A larger value ignores a small change of sign, which opens the backlash; a smaller one withdraws the bound
for rounding."""
_TOLERANCE = 1e-8
"""Relative tolerance of the rigid run from which the bounds take their torques [1]. A numerical choice: a smaller value
takes longer, a larger one makes the criterion less accurate."""
_TOUCHING = 1e-9
"""Distance of a link beyond its flank, relative to half the backlash [1], that counts as rounding. A numerical choice
above the resolution 2e-16 of the floating point. A smaller value withdraws the bound for rounding."""


@dataclass(frozen=True, slots=True)
class _Rigid:
    """Largest and smallest torque of every link in the rigid train; none where that is not found."""

    high: Mapping[str, float]
    low: Mapping[str, float]

    def largest(self, name: str) -> float:
        """Largest torque, without its sign."""
        return max(abs(self.high.get(name, 0.0)), abs(self.low.get(name, 0.0)))

    def one_sign(self, name: str) -> float:
        """Largest torque with its sign; 0 where it changes."""
        high, low = self.high.get(name, 0.0), self.low.get(name, 0.0)
        if min(high, -low) > _ONE_SIGN * self.largest(name):
            return 0.0
        return high if high >= -low else low


@remembered(64)
def _rigid(key: "_Scene") -> _Rigid:
    spec, scene = key.spec, key.scene
    case, end = rigid(case_of(spec, scene, backlash=False)), simulation.window(scene, case_of(spec, scene))
    if simulation.seconds(case, end) > simulation.BESIDE:
        return _Rigid({}, {})
    try:
        course = simulation.run(case, end, _TOLERANCE, most_work=simulation.MOST_BESIDE)
    except NumericsError:  # a bound cannot rest on it; the solver that meets it says so
        return _Rigid({}, {})
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
    known = modal_swings.swings(case, simulation.window(scene, case))
    if known is None:
        return None
    found: dict[str, Interval] = {}
    torques, train = _rigid(_Scene(spec, scene)), case.train
    peaks = {one.name: swing for one, swing in zip(train.springs, known.links.tolist(), strict=True)}
    peaks |= {one.name: swing for one, swing in zip(train.meshes, known.meshes.tolist(), strict=True)}
    for name, swing in peaks.items():
        largest = torques.largest(name)
        found[of("torque_peak", name)] = _around(swing)
        share = swing / largest if largest > 0 else math.inf
        found[of("dynamic_factor", name)] = _around(share if swing > 0 else 0.0)
    for index, name in enumerate(case.bodies):
        for family in ("speed_max", "speed_min", "speed_end"):
            found[of(family, name)] = _around(known.speeds[index])
        found[of("angle_end", name)] = _around(known.angles[index])
    for name in spec.motors:
        for family in ("motor_torque_peak", "motor_torque_rms"):
            found[of(family, name)] = Interval(0.0, 0.0)
    return found


def _around(size: float) -> Interval:
    return Interval(-float(size), float(size))


def largest_backlash(spec: Drivetrain, scene: TrainScene) -> float:
    """Largest backlash number of a link with play; infinite where its torque changes sign and opens it again."""
    case = case_of(spec, scene)
    torques = _rigid(_Scene(spec, scene))
    numbers = [0.0]
    for spring in case.train.springs:
        if not _plays(spring):
            continue
        torque = torques.one_sign(spring.name)
        if not torque:
            return math.inf
        numbers.append(2 * spring.stiffness * _travel(case.train, spring, torque) / abs(torque))
    return max(numbers)


def _plays(spring: Spring) -> bool:
    """Whether play is left to the effect: a rope's slack and a rigid contact are in every run."""
    return spring.play > 0 and spring.side == 0 and spring.law != RIGID


def _alike(spring: Spring) -> bool:
    """Whether a link does the same without the effect."""
    closed = spring.play == 0 and (spring.law == KELVIN or (spring.law in (CLAMPED, NO_PULL) and not spring.damping))
    return spring.law in (LINEAR, RIGID) or spring.side != 0 or closed


def _travel(train: Train, spring: Spring, torque: float) -> float:
    """How far a link moves through its play under a torque, from where it stands at the start."""
    return max(spring.play / 2 - math.copysign(1.0, torque) * _apart(train, spring), 0.0)


def _apart(train: Train, spring: Spring) -> float:
    """Extension of a link at the start."""
    second = train.bodies[spring.second].position if spring.second is not None else 0.0
    return train.bodies[spring.first].position - second - spring.rest


def two_inertia_play(
    spec: Drivetrain, scene: TrainScene, loads: Mapping[str, Estimate]
) -> Mapping[str, Interval] | None:
    """What play adds to the link torque of two inertias that start from rest under constant torques.

        T <= T_0 (1 + sqrt(1 + Pi_b))/2

    In the play the two part under the very torque T that the link would carry, and enter it with the energy T D;
    without damping the peak is T (1 + sqrt(1 + 2 C D/T)), and that without play T_0 = 2 T. The window must hold both
    peaks: the run through the play, sqrt(2 m D/T), and half a period pi sqrt(m/C), m the reduced inertia.
    """
    case = case_of(spec, scene)
    train = case.train
    if all(_alike(spring) for spring in train.springs):
        return {name: Interval(0.0, 0.0) for name in loads}
    groups = Groups.among(train)
    if len(train.springs) != 1 or groups.count != 2 or not _steady(train):
        return None
    (spring,) = train.springs
    torque, name = _rigid(_Scene(spec, scene)).one_sign(spring.name), of("torque_peak", spring.name)
    if not torque or name not in loads or abs(_apart(train, spring)) > (1 + _TOUCHING) * spring.play / 2:
        return None
    travel = _travel(train, spring, torque)
    inertia = 1 / float(groups.row(spring.first, spring.second) ** 2 @ (1 / groups.inertias(train)))
    until = math.sqrt(2 * inertia * travel / abs(torque)) + math.pi * math.sqrt(inertia / spring.stiffness)
    if simulation.window(scene, case) < until:
        return None
    ratio = float(backlash.backlash_peak_ratio(2 * spring.stiffness * travel / abs(torque)))
    return {name: Interval(0.0, loads[name].high * (ratio - 1))}


def _steady(train: Train) -> bool:
    """Whether undamped inertias start from rest under torques that do not change."""
    plain = replace(train, springs=tuple(replace(one, law=LINEAR, play=0.0) for one in train.springs))
    signals = [modal_swings.signal_of(drive) for drive in train.drives]
    return (
        modal_swings.is_linear(plain)
        and not any(body.speed for body in train.bodies)
        and all(one.law in (CLAMPED, NO_PULL, KELVIN) and not one.damping for one in train.springs)
        and all(one is not None and len(one.times) == 1 and not one.slopes[0] and not one.sines for one in signals)
    )
