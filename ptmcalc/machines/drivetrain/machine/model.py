"""From the description to the train in numbers: what moves, what ties it, what acts in a scene."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from ptmcalc.base.memory import remembered
from ptmcalc.components.motor import ConverterMotor
from ptmcalc.components.motor_stage import Stage as MotorStage
from ptmcalc.laws import backlash
from ptmcalc.machines.drivetrain.machine.keys.brakes import Brake
from ptmcalc.machines.drivetrain.machine.keys.links import Link
from ptmcalc.machines.drivetrain.machine.keys.torques import (
    ConstantTorque,
    MotorOn,
    OnInertia,
    OverPosition,
    OverSpeed,
    OverTime,
    RisingTorque,
    SineTorque,
)
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain, Run, Start, Stop, TrainScene
from ptmcalc.machines.drivetrain.machine.wiring import GROUND
from ptmcalc.numerics.train.parts import (
    LINEAR,
    RIGID,
    Body,
    Drive,
    Governed,
    Grip,
    Guide,
    Impulse,
    Law,
    Mesh,
    Smooth,
    Spring,
    Stage,
    Straight,
    Train,
)
from ptmcalc.numerics.train.signals import ONE, Signal, Sine, Trigger
from ptmcalc.numerics.train.statics import link_forces
from ptmcalc.numerics.train.tree import Groups

_SLOPES = 2.5
"""Levels to which the slope of a smooth torque curve is rounded, up to its steepest [1]; each has its own linear
system. A numerical choice. A larger value linearises more closely and computes more systems."""
REACHED = "start over"
"""Name of the event of a start that is over, and what those of other parts begin with; no part can be called so."""


@dataclass(frozen=True, slots=True)
class Part:
    """A body that starts or stops with the scene; `until` is the speed that ends its start."""

    body: int
    until: float | None
    event: str = REACHED
    """name of the event of its target speed"""


@dataclass(frozen=True, slots=True)
class Case:
    """A scene in numbers. `main` is the body the scene is about; `until` the speed that ends a start.

    `others` are bodies of parts that no gear and no link ties to the main one: with motors of their own in a start,
    behind a brake or clutch in a stop.
    """

    train: Train
    bodies: tuple[str, ...]
    main: int
    until: float | None
    stopping: bool
    impulses: tuple[str, ...] = ()
    """names of the impulses"""
    others: tuple[Part, ...] = ()

    @property
    def parts(self) -> tuple[Part, ...]:
        """The main body and the others."""
        return (Part(self.main, self.until), *self.others)

    @property
    def clutches(self) -> tuple[Grip, ...]:
        """The clutches that act in a start."""
        return () if self.stopping else tuple(one for one in self.train.grips if one.second is not None)

    def index(self, name: str) -> int:
        """Index of an inertia."""
        return self.bodies.index(name)


@remembered(256)
def _case(key: "_Key") -> Case:
    return _Builder(key.spec, key.scene, key.backlash).case()


@dataclass(frozen=True, slots=True)
class _Key:
    """What a case depends on; models are compared by identity, as they never change."""

    spec: Drivetrain
    scene: TrainScene
    backlash: bool

    def __hash__(self) -> int:
        return hash((id(self.spec), id(self.scene), self.backlash))

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, _Key)
            and self.spec is other.spec
            and self.scene is other.scene
            and self.backlash is other.backlash
        )


def case_of(spec: Drivetrain, scene: TrainScene, backlash: bool = True) -> Case:
    """The case of a scene, with the play of its links or without."""
    return _case(_Key(spec, scene, backlash))


def play_of(link: Link) -> float:
    """Whole play of a link [rad or m]; that of a rope is twice its slack, as it pulls on one side only."""
    if link.slack is not None:
        return 2 * link.slack
    if link.clearance is None:
        return link.gap or 0.0
    given = link.clearance
    new = given.value
    if new is None:
        assert given.centre_distance is not None
        assert given.accuracy_class is not None
        new = backlash.new_clearance(given.centre_distance, given.accuracy_class)
    if given.module is not None:
        share = backlash.wear_share(given.wear or 0.0, given.module)
        new = backlash.worn_clearance(new, share, given.module, given.both_worn)
    return backlash.clearance_angle(new, given.pitch_radius)


def rigid(case: Case) -> Case:
    """The case with every link between two inertias made rigid: one shaft, as far as nothing else parts it."""
    train = case.train
    joined, meshes, springs = _joined(train), list(train.meshes), []
    for spring in train.springs:
        if spring.second is None or joined(spring.first) == joined(spring.second):
            springs += [spring] if spring.second is None else []
            continue
        meshes.append(Mesh(spring.name, spring.first, spring.second, 1.0))
        joined = _joined(replace(train, meshes=tuple(meshes)))
    return replace(case, train=_with_common_speeds(replace(train, meshes=tuple(meshes), springs=tuple(springs))))


def _joined(train: Train) -> Callable[[int], int]:
    """The rigid part of each body."""
    of = list(range(len(train.bodies)))
    for mesh in train.meshes:
        old, new = of[mesh.outer], of[mesh.inner]
        of = [new if one == old else one for one in of]
    return of.__getitem__


def _with_common_speeds(train: Train) -> Train:
    """Bodies that now move as one keep their common momentum."""
    groups = Groups.among(train)
    inertia = groups.inertias(train)
    momentum = np.zeros(groups.count)
    for body, group, ratio in zip(train.bodies, groups.of, groups.ratio, strict=True):
        momentum[group] += body.inertia * ratio * body.speed
    speeds = momentum / inertia
    bodies = tuple(
        replace(body, speed=float(ratio * speeds[group]))
        for body, group, ratio in zip(train.bodies, groups.of, groups.ratio, strict=True)
    )
    return replace(train, bodies=bodies)


def brake_of(spec: Drivetrain, case: Case, body: int) -> str | None:
    """The first brake or clutch on the part of a body, or for the main part the first one of the file."""
    tied = _tied(spec)
    for name, one in spec.brakes.items():
        sides = [case.index(side) for side in (one.at, one.against) if side != GROUND]
        if body == case.main or tied[body] in {tied[side] for side in sides}:
            return name
    return None


def _tied(spec: Drivetrain) -> list[int]:
    """The part of each body, of those that gears and links tie together."""
    at, part = list(spec.inertias).index, list(range(len(spec.inertias)))
    pairs = [(gear.start, gear.end) for gear in spec.gears.values()]
    pairs += [(one, two) for one, two in (link.between for link in spec.links.values())]
    for one, two in pairs:
        if GROUND not in (one, two):
            old, new = part[at(one)], part[at(two)]
            part = [new if member == old else member for member in part]
    return part


def turning_with(spec: Drivetrain, known: dict[int, float], *, together: bool) -> dict[int, float]:
    """Speeds of inertias by index, with those of all that gears tie to them.

    `together` includes links and clutches that are always closed.
    """
    at = list(spec.inertias).index
    ties = [(at(gear.start), at(gear.end), gear.speed_ratio) for gear in spec.gears.values()]
    if together:
        pairs = [link.between for link in spec.links.values()]
        pairs += [(clutch.at, clutch.against) for clutch in spec.brakes.values() if clutch.applied == "always"]
        ties += [(at(one), at(two), 1.0) for one, two in pairs if GROUND not in (one, two)]
    found = dict(known)
    for _ in spec.inertias:
        for inner, outer, ratio in ties:
            if inner in found:
                found.setdefault(outer, found[inner] / ratio)
            elif outer in found:
                found.setdefault(inner, found[outer] * ratio)
    return found


class _Builder:
    def __init__(self, spec: Drivetrain, scene: TrainScene, backlash: bool) -> None:
        self.spec, self.scene, self.backlash = spec, scene, backlash
        self.names = tuple(spec.inertias)
        self.stopping = isinstance(scene, Stop)
        self.main = self.names.index(spec.main(scene))

    def case(self) -> Case:
        until, bodies = self._until(), self._bodies()
        others = tuple(self._others(bodies))
        train = Train(
            bodies=bodies,
            meshes=tuple(self._meshes()),
            grips=tuple(self._grips()),
            drives=(*self._drives(until), *(_watch(one) for one in others if one.until is not None)),
            guides=tuple(self._guides()),
            impulses=tuple(Impulse(self.at(one.at), one.time, one.size) for one in self.spec.impulses.values()),
        )
        train = replace(train, springs=tuple(self._springs(train)))
        return Case(train, self.names, self.main, until, self.stopping, tuple(self.spec.impulses), others)

    def at(self, name: str) -> int:
        return self.names.index(name)

    # -- what moves -------------------------------------------------------------------------------------------

    def _bodies(self) -> tuple[Body, ...]:
        speeds = self._speeds()
        return tuple(
            Body(name, body.size, body.position, speeds.get(index, 0.0))
            for index, (name, body) in enumerate(self.spec.inertias.items())
        )

    def _speeds(self) -> dict[int, float]:
        """Speeds at the start: those the file writes, and of what turns with it; with the scene's speed, of all."""
        known = {self.at(name): body.speed for name, body in self.spec.inertias.items() if body.speed is not None}
        known |= {self.at(one.at): one.points[0].speed for one in self.spec.motions.values()}
        if self.scene.speed is not None:
            known.setdefault(self.main, self.scene.speed)
        return turning_with(self.spec, known, together=self.scene.speed is not None)

    def _meshes(self) -> Iterator[Mesh]:
        for name, gear in self.spec.gears.items():
            yield Mesh(name, self.at(gear.start), self.at(gear.end), gear.speed_ratio, gear.efficiency, gear.back)

    def _springs(self, train: Train) -> Iterator[Spring]:
        plain = [self._spring(name, link) for name, link in self.spec.links.items()]
        loaded = self.scene.links == "loaded" or (self.scene.links is None and self.stopping)
        forces = link_forces(replace(train, springs=tuple(plain)), self.main) if loaded else [0.0] * len(plain)
        for spring, link, force in zip(plain, self.spec.links.values(), forces, strict=True):
            yield replace(spring, rest=self._rest(spring, link, force, train))

    def _spring(self, name: str, link: Link) -> Spring:
        first, second = link.between
        flipped = first == GROUND
        law = link.contact_law
        play = play_of(link)
        if not self.backlash and link.slack is None and law != RIGID:
            law, play = LINEAR, 0.0
        return Spring(
            name=name,
            first=self.at(second if flipped else first),
            second=None if GROUND in (first, second) else self.at(second),
            stiffness=link.stiffness or 0.0,
            damping=link.damping,
            play=play,
            law=law,
            side=(-1 if flipped else 1) if link.slack is not None else 0,
            restitution=link.restitution or 0.0,
            dissipation=link.dissipation or 0.0,
            exponent=link.exponent,
        )

    def _rest(self, spring: Spring, link: Link, force: float, train: Train) -> float:
        """Where a link is at rest, from where it stands at the start."""
        flip = -1.0 if link.between[0] == GROUND else 1.0
        torque = flip * link.preload if link.preload else force
        apart = train.bodies[spring.first].position
        if spring.second is not None:
            apart -= train.bodies[spring.second].position
        side = math.copysign(1.0, torque) if torque else {"driving": flip, "braking": -flip, "centred": 0.0}[link.start]
        if side == 0:
            return 0.0
        stretch = abs(torque) / spring.stiffness if spring.stiffness else 0.0
        return apart - side * (spring.play / 2 + stretch)

    # -- what acts ---------------------------------------------------------------------------------------------

    def _grips(self) -> Iterator[Grip]:
        for name, brake in self.spec.brakes.items():
            if brake.applied == "always" or (brake.applied == "when_stopping" and self.stopping):
                second = None if brake.against == GROUND else self.at(brake.against)
                yield Grip(name, self.at(brake.at), second, self._applied(brake), brake.static_ratio)
        for name, friction in self.spec.resistances.items():
            if friction.coulomb:
                yield Grip(name, self.at(friction.at), None, Signal.constant(friction.coulomb), friction.static_ratio)

    def _applied(self, brake: Brake) -> Signal:
        """Torque of a brake over the time since its command."""
        trigger = None
        if brake.below is not None:
            backward = self._speeds().get(self.at(brake.at), 0.0) < 0
            trigger = Trigger(self.at(brake.at), "speed", -brake.below if backward else brake.below, rising=backward)
        full, start, rise = brake.torque, brake.delay, brake.rise_time
        times: tuple[float, ...]
        values: tuple[float, ...]
        if brake.rise == "exponential" and rise > 0:
            times, values = ((0.0, start), (0.0, full)) if start > 0 else ((0.0,), (full,))
            return Signal(times, values, (0.0,) * len(times), (), -full, rise, start, trigger)
        if rise == 0 and start == 0:
            return Signal(values=(full,), trigger=trigger)
        times = tuple(dict.fromkeys((0.0, start, start + rise)))
        values = (0.0, full) if rise == 0 else ((0.0, 0.0, full) if start > 0 else (0.0, full))
        slopes = (0.0, 0.0) if rise == 0 else ((0.0, full / rise, 0.0) if start > 0 else (full / rise, 0.0))
        return Signal(times, values, slopes, trigger=trigger)

    def _drives(self, until: float | None) -> Iterator[Drive]:
        for name, one in self.spec.motors.items():
            gate = self._gate(one)
            if gate is not None:
                yield Drive(name, self.at(one.at), tuple(_stages(one)), gate)
        for name, torque in self.spec.torques.items():
            if torque.acts == "always" or not self.stopping:
                yield Drive.of(name, self.at(torque.at), _law(torque))
        for name, friction in self.spec.resistances.items():
            if friction.viscous:
                law = Straight("speed", (0.0, 1.0), (0.0, -friction.viscous), extends=True)
                yield Drive.of(f"{name} (viscous)", self.at(friction.at), law)
        if until is not None:
            yield _watch(Part(self.main, until))

    def _others(self, bodies: tuple[Body, ...]) -> Iterator[Part]:
        """One body of each part beside the main one that has to start or to stop."""
        tied = _tied(self.spec)
        known = {tied[self.main]}
        for body in self._stopped(bodies) if self.stopping else [self.at(one.at) for one in self.spec.motors.values()]:
            if tied[body] in known or isinstance(self.scene, Run):
                continue
            until = None if self.stopping else self._until_of(body)
            if until is not None or self.stopping:
                known.add(tied[body])
                yield Part(body, until, f"{REACHED}, {self.names[body]}")

    def _stopped(self, bodies: tuple[Body, ...]) -> Iterator[int]:
        """Bodies that a brake or clutch acts on, of parts that move or are behind a clutch."""
        tied = _tied(self.spec)
        moving = {tied[index] for index, body in enumerate(bodies) if body.speed}
        for one in self.spec.brakes.values():
            if one.applied == "never":
                continue
            clutch = one.against != GROUND
            sides = [self.at(one.at), *([self.at(one.against)] if clutch else [])]
            yield from (side for side in sides if clutch or tied[side] in moving)

    def _gate(self, one: MotorOn) -> Signal | None:
        """When a motor drives; None where it never does in this scene."""
        end = one.off_after
        if self.stopping:
            end = one.off_delay if end is None else min(end, one.off_delay)
        if end is None:
            return ONE
        return Signal((0.0, end), (1.0, 0.0), (0.0, 0.0)) if end > 0 else None

    def _until(self) -> float | None:
        """Speed of the main inertia that ends a start."""
        if not isinstance(self.scene, Start):
            return None
        return self.scene.until if self.scene.until is not None else self._until_of(self.main)

    def _until_of(self, body: int) -> float | None:
        """95 % of the speed of the slowest motor on a body."""
        speeds = [_rated_speed(one) for one in self.spec.motors.values() if self.at(one.at) == body]
        known = [speed for speed in speeds if speed]
        return 0.95 * min(known, key=abs) if known else None

    def _guides(self) -> Iterator[Guide]:
        for name, one in self.spec.motions.items():
            times = tuple(point.time for point in one.points)
            speeds = [point.speed for point in one.points]
            slopes = tuple(float(s) for s in np.diff(speeds) / np.diff(times)) if len(times) > 1 else ()
            yield Guide(name, self.at(one.at), Signal(times, (*slopes, 0.0), (0.0,) * len(times)))


def _watch(part: Part) -> Drive:
    """A torque of 0 that begins when a body has its target speed: its event."""
    assert part.until is not None
    trigger = Trigger(part.body, "speed", part.until, rising=part.until >= 0)
    return Drive.of(part.event, part.body, Signal.constant_from(0.0, trigger))


def _rated_speed(one: MotorOn) -> float | None:
    speed = getattr(one.motor, "speed", None)
    return float(speed) if speed is not None else one.motor.no_load_speed


def _stages(one: MotorOn) -> Iterator[Stage]:
    motor, count = one.motor, one.count
    if isinstance(motor, ConverterMotor):
        ramp = motor.ramp_time
        reference = Signal.through(((0.0, 0.0), (ramp, motor.speed))) if ramp > 0 else Signal.constant(motor.speed)
        yield Stage(Governed(reference, count * motor.stiffness, count * motor.limit))
        return
    stages = motor.stages
    for stage in stages:
        last = stage is stages[-1]
        yield Stage(
            _motor_law(stage, count, motor.no_load_speed),
            None if last else stage.until_speed,
            None if last else stage.until_time,
        )


def _motor_law(stage: MotorStage, count: int, no_load_speed: float | None) -> Law:
    if stage.pieces is not None:
        knots, values = zip(*stage.pieces, strict=True)
        if len(knots) == 1:
            return Signal.constant(count * values[0])
        return Straight("speed", tuple(knots), tuple(count * value for value in values), stage.extends)
    formula, slope = stage.formula, stage.slope
    assert formula is not None
    assert slope is not None
    speeds = np.linspace(0.0, no_load_speed or 1.0, 201)
    size, steepest = float(np.abs(formula(speeds)).max()), float(np.abs(slope(speeds)).max())
    return Smooth(
        "speed",
        lambda speed: count * formula(speed),
        lambda speed: count * float(slope(np.array([speed]))[0]),
        count * size,
        count * steepest / _SLOPES,
    )


def _law(torque: OnInertia) -> Law:
    """The law of a torque that is no motor."""
    if isinstance(torque, ConstantTorque):
        if torque.delay == 0:
            return Signal.constant(torque.torque)
        return Signal((0.0, torque.delay), (0.0, torque.torque), (0.0, 0.0))
    if isinstance(torque, RisingTorque):
        return Signal.through(((0.0, torque.first), (torque.time, torque.torque)))
    if isinstance(torque, SineTorque):
        return Signal(values=(torque.mean,), sines=(Sine(torque.amplitude, torque.omega, torque.phase),))
    if isinstance(torque, OverTime):
        return Signal.through(tuple((point.time, point.torque) for point in torque.points))
    if isinstance(torque, OverSpeed):
        knots = tuple(point.speed for point in torque.points)
        return Straight("speed", knots, tuple(point.torque for point in torque.points))
    assert isinstance(torque, OverPosition)
    knots = tuple(point.position for point in torque.points)
    return Straight("position", knots, tuple(point.torque for point in torque.points), period=torque.period or 0.0)
