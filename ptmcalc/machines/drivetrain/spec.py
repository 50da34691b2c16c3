"""How a designer writes a drive train: inertias, links, gears, brakes, what drives and what resists."""

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field

from ptmcalc.base import units
from ptmcalc.base.span import KeyPath
from ptmcalc.base.units import Quantity
from ptmcalc.components.motor import AnyMotor
from ptmcalc.machines.drivetrain.bodies import AnyBody
from ptmcalc.machines.drivetrain.wiring import GROUND, wiring
from ptmcalc.spec.fields import (
    Efficiency,
    FactorFromOne,
    Fraction,
    Inertia,
    Mass,
    Measure,
    PositiveFrequency,
    PositiveLength,
    PositiveTime,
    Ratio,
    ReverseEfficiency,
    Time,
)
from ptmcalc.spec.fragment import Conflict, Fragment, Given, at_most_one, exactly_one, together
from ptmcalc.spec.machine import CheckSettings, MachineSpec
from ptmcalc.spec.optional import Absent, Assumed, Limit, OneOf, Setting
from ptmcalc.spec.scene import Scene, TransientScene
from ptmcalc.spec.shape import Also


def either(rotation: Quantity, translation: Quantity, **limits: float) -> Measure:
    """A quantity of a part that turns, or the like one of a part that travels."""
    return Measure(rotation, or_else=translation, **limits)


Turn = Annotated[float, either(units.ANGLE, units.LENGTH)]
Play = Annotated[float, either(units.ANGLE, units.LENGTH, at_least=0)]
AnySpeed = Annotated[float, either(units.ANGULAR_SPEED, units.SPEED)]
Torque = Annotated[float, either(units.TORQUE, units.FORCE)]
PositiveTorque = Annotated[float, either(units.TORQUE, units.FORCE, above=0)]
TorqueOrNone = Annotated[float, either(units.TORQUE, units.FORCE, at_least=0)]
Stiffness = Annotated[float, either(units.TORSIONAL_STIFFNESS, units.STIFFNESS, above=0)]
Damping = Annotated[float, either(units.TORSIONAL_DAMPING, units.DAMPING, at_least=0)]
AnyImpulse = Annotated[float, either(units.ANGULAR_IMPULSE, units.IMPULSE)]
AngularFrequency = Annotated[float, Measure(units.ANGULAR_FREQUENCY, above=0)]
Exponent = Annotated[float, Measure(units.RATIO, at_least=1, at_most=3)]


class Body(Fragment):
    """An inertia of the train: rotating (`inertia` or `body`) or travelling (`mass`)."""

    inertia: Annotated[Inertia | None, OneOf("mass, body")] = None
    """moment of inertia; 0 is permitted only on a shaft connected to another inertia by a gear"""
    mass: Annotated[Mass | None, OneOf("inertia, body")] = None
    """mass of a travelling part"""
    body: AnyBody | None = None
    """a body whose inertia is computed from its dimensions"""
    position: Annotated[Turn, Absent("positions are relative to it")] = 0.0
    """angle or position at the start"""
    speed: Annotated[AnySpeed | None, Absent("it starts from standstill or with the speed of the scene")] = None
    """speed at the start; default: that of the scene, or standstill"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The inertia is given in one way."""
        yield from exactly_one(given, "inertia", "mass", "body")

    @property
    def turns(self) -> bool:
        """Whether it turns."""
        return self.mass is None

    @property
    def size(self) -> float:
        """Moment of inertia or mass [kg*m^2 or kg]."""
        if self.body is not None:
            return self.body.inertia
        size = self.inertia if self.mass is None else self.mass
        assert size is not None
        return size


class Clearance(Fragment):
    """The backlash of a gear or toothed coupling from its geometry."""

    centre_distance: Annotated[PositiveLength | None, OneOf("value")] = None
    """with `accuracy_class`: minimum clearance of new spur gears, a*cbrt(A) (reconstructed table)"""
    accuracy_class: Literal[2, 3, 4] | None = None
    """accuracy class of the old standard the table was made for"""
    value: Annotated[PositiveLength | None, OneOf("centre_distance")] = None
    """clearance of the new gear along the pitch circle, instead of the two"""
    pitch_radius: PositiveLength
    """of the wheel on the shaft of the link's first inertia"""
    module: Annotated[PositiveLength | None, Absent("needed with `wear` only")] = None
    """needed with `wear`"""
    wear: Annotated[Annotated[float, Measure(units.LENGTH, at_least=0)] | None, Assumed()] = None
    """thickness lost by a tooth; none to 15 % of the tooth is assumed with a `module` when it is left out"""
    both_worn: bool = True
    """whether both gears have lost it"""
    kind: Literal["gearbox", "coupling", "open_gear"] = "gearbox"
    """wear limit: 25 % of the tooth in gearboxes and couplings, 40 % in open gears"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The clearance is measured, or comes from the table."""
        if "accuracy_class" not in given and "centre_distance" not in given:
            yield from exactly_one(given, "value", "centre_distance")
        else:
            yield from at_most_one(given, "centre_distance", "value")
            for one, other in (("centre_distance", "accuracy_class"), ("accuracy_class", "centre_distance")):
                yield from together(given, one, other, "the table needs centre distance and accuracy class")
        wear = given.number("wear")
        if wear:
            yield from together(given, "wear", "module", "wear is a share of the tooth")


class Link(Fragment):
    """An elastic link between two inertias, or between an inertia and the ground."""

    between: Annotated[tuple[str, ...], Field(min_length=2, max_length=2)]
    """names of two inertias, or of one and `ground`; a positive torque drives the second"""
    stiffness: Annotated[Stiffness | None, OneOf("law: rigid")] = None
    """of the whole link; a `rigid` contact has none"""
    damping: Annotated[Damping, Absent("undamped oscillations are largest")] = 0.0
    """viscous damping of the link"""
    gap: Annotated[Play | None, Absent("a shaft or another part without clearance"), Also("backlash")] = None
    """total backlash, half of it to either side"""
    clearance: Clearance | None = None
    """the backlash from the gear geometry, instead of `gap`"""
    slack: Annotated[Play | None, Absent("no rope or chain")] = None
    """a rope or chain: tension only, after this slack travel"""
    law: Literal["clamped", "no_pull", "kelvin", "hunt_crossley", "rigid"] | None = None
    """contact law; default: `clamped` with a gap, `no_pull` with slack"""
    dissipation: Annotated[
        Annotated[float, Measure(units.RATIO, at_least=0)] | None,
        Absent("a contact without losses has the largest rebound"),
    ] = None
    """c in F = k d^n (1 + 1.5 c d'), in s/rad or s/m (`hunt_crossley`)"""
    exponent: Annotated[Exponent, Absent("a linear contact")] = 1.0
    """n of `hunt_crossley`"""
    restitution: Annotated[Fraction | None, Assumed()] = None
    """of a `rigid` contact; 0 to 0.5 is assumed when it is left out"""
    start: Literal["centred", "driving", "braking"] = "centred"
    """initial position of the link in its backlash: `driving` touches on the side of a positive torque"""
    preload: Annotated[Torque, Absent("no torque at the start")] = 0.0
    """torque in the link at the start; with `slack` and `driving` the rope is taut"""
    limit: Annotated[PositiveTorque | None, Limit()] = None
    """permissible torque of the link"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """What a contact needs."""
        yield from at_most_one(given, "gap", "clearance")
        for key in ("gap", "clearance"):
            yield from at_most_one(given, "slack", key)
        law = given.word("law")
        contact = any(key in given for key in ("gap", "clearance", "slack"))
        if law is not None and not contact:
            yield Conflict(("law",), f"`{law}` is a contact law, and the link has no backlash", "add `gap: 0 deg`")
        if law == "rigid":
            for key in ("stiffness", "damping"):
                if key in given:
                    yield Conflict((key,), "a rigid contact has none", f"delete `{key}`, or write `law: clamped`")
        elif "stiffness" not in given:
            yield given.missing("stiffness", "an elastic link needs its `stiffness`")
        for key, wanted in (("dissipation", "hunt_crossley"), ("exponent", "hunt_crossley"), ("restitution", "rigid")):
            if key in given and law != wanted and (law is not None or "law" not in given):
                yield Conflict((key,), f"it belongs to `law: {wanted}`", f"delete it, or write `law: {wanted}`")
        if law == "hunt_crossley" and "damping" in given:
            yield Conflict(("damping",), "`hunt_crossley` is damped by `dissipation`", "delete `damping`")

    @property
    def body(self) -> str:
        """The first inertia it is tied to."""
        return next(name for name in self.between if name != GROUND)

    @property
    def contact_law(self) -> str:
        """The law of contact, or `linear` without play."""
        if self.law is not None:
            return self.law
        if self.slack is not None:
            return "no_pull"
        return "linear" if self.gap is None and self.clearance is None else "clamped"


class Gear(Fragment):
    """A rigid gear, or a drum that converts rotation into travel."""

    start: str = Field(alias="from")
    """the inertia on the motor's side"""
    end: str = Field(alias="to")
    """the inertia on the load's side"""
    ratio: Annotated[Ratio | None, OneOf("radius")] = None
    """speed of `from` / speed of `to`; negative if it reverses"""
    radius: Annotated[Annotated[float, Measure(units.LENGTH, above=0)] | None, OneOf("ratio")] = None
    """radius of the drum, wheel or pinion that moves `to`, instead of `ratio`"""
    efficiency: Annotated[
        Efficiency,
        Assumed(1.0, 0.94, 1.0, "one to three stages of gears in oil or drums on rolling bearings, 0.98 to 0.99 each"),
    ] = 1.0
    """while power flows from `from` to `to`"""
    reverse_efficiency: Annotated[ReverseEfficiency | None, Assumed()] = None
    """while it flows back; 2 - 1/efficiency when left out, negative for a self-locking gear"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """A ratio or a radius, and not the same inertia twice."""
        yield from exactly_one(given, "ratio", "radius")
        if given.number("ratio") == 0:
            yield Conflict(("ratio",), "a gear with ratio 0 transmits no motion", "write the speed ratio")

    @property
    def speed_ratio(self) -> float:
        """Speed of `from` over speed of `to` [1 or rad/m]."""
        if self.ratio is not None:
            return self.ratio
        assert self.radius is not None
        return 1 / self.radius

    @property
    def back(self) -> float:
        """Efficiency of power that flows back."""
        return self.reverse_efficiency if self.reverse_efficiency is not None else 2 - 1 / self.efficiency


class Brake(Fragment):
    """A brake against the ground, or a clutch between two inertias (Coulomb friction)."""

    at: str
    """the inertia it acts on"""
    against: str = "ground"
    """`ground`, or the inertia on the other side of a clutch"""
    torque: PositiveTorque
    """torque or force while it slips, fully applied"""
    static_ratio: Annotated[FactorFromOne, Absent("equal static and sliding torque is the minimum")] = 1.0
    """static torque / sliding torque"""
    delay: Annotated[Time, Assumed(0.0, 0.0, 0.1, "spring-applied brakes, AC or DC switching: up to 0.1 s")] = 0.0
    """from the command to the start of the braking torque"""
    rise_time: Annotated[
        Time, Assumed(0.0, 0.0, 0.1, "spring-applied brakes: up to 0.1 s from the first to the full torque")
    ] = 0.0
    """from then to full torque; the time constant of an exponential rise"""
    rise: Literal["linear", "exponential"] = "linear"
    """how it rises"""
    applied: Literal["when_stopping", "always", "never"] = "when_stopping"
    """in which scenes the command is given, at their start"""
    below: Annotated[AnySpeed | None, Absent("the brake acts at any speed")] = None
    """speed of `at` at or below which the command is given"""


class Resistance(Fragment):
    """Resistance to the motion of an inertia."""

    at: str
    """the inertia it acts on"""
    coulomb: Annotated[TorqueOrNone, Absent("no dry friction")] = 0.0
    """dry friction, against the motion at any speed"""
    static_ratio: Annotated[
        FactorFromOne,
        Assumed(1.0, 1.0, 1.5, "breakaway of bearings, seals and wheels: up to 1.5 times the value in motion"),
    ] = 1.0
    """breakaway value / sliding value"""
    viscous: Annotated[Damping, Absent("no friction that depends on the speed")] = 0.0
    """per speed"""


class OnInertia(Fragment):
    """What acts on one inertia."""

    at: str
    """the inertia it acts on"""
    acts: Literal["always", "when_running"] = "always"
    """`when_running`: not in scenes of the type `stop`"""


class ConstantTorque(OnInertia):
    """A constant torque or force: a weight, a suspended load."""

    type: Literal["constant"]
    torque: Torque
    """positive in the direction of motion"""
    delay: Annotated[Time, Absent("it acts from the start")] = 0.0
    """start of the torque"""


class RisingTorque(OnInertia):
    """A torque that changes linearly with time."""

    type: Literal["ramp"]
    torque: Torque
    """at the end of the ramp, and after it"""
    first: Annotated[Torque, Absent("it starts from zero")] = 0.0
    """at the start of the scene"""
    time: PositiveTime
    """duration of the ramp"""


class SineTorque(OnInertia):
    """A harmonic torque: mean + amplitude sin(w t + phase)."""

    type: Literal["sine"]
    amplitude: Torque
    """amplitude of the torque"""
    frequency: Annotated[PositiveFrequency | None, OneOf("angular_frequency")] = None
    """cycles per second"""
    angular_frequency: Annotated[AngularFrequency | None, OneOf("frequency")] = None
    """w itself, instead of `frequency`"""
    mean: Annotated[Torque, Absent("it has no mean")] = 0.0
    """mean torque"""
    phase: Annotated[Annotated[float, Measure(units.ANGLE)], Absent("it starts at 0")] = 0.0
    """of the sine at the start of the scene"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The frequency is given in one way."""
        yield from exactly_one(given, "frequency", "angular_frequency")

    @property
    def omega(self) -> float:
        """Angular frequency [rad/s]."""
        return self.angular_frequency or 2 * math.pi * (self.frequency or 0.0)


class TimePoint(Fragment):
    """A torque at a time."""

    time: Time
    """since the start of the scene"""
    torque: Torque
    """at that point"""


class SpeedPoint(Fragment):
    """A torque at a speed."""

    speed: AnySpeed
    """of the inertia"""
    torque: Torque
    """at that point"""


class PositionPoint(Fragment):
    """A torque at an angle or position."""

    position: Turn
    """of the inertia"""
    torque: Torque
    """at that point"""


class OverTime(OnInertia):
    """A torque over time, linear between points; the last value remains constant."""

    type: Literal["over_time"]
    points: Annotated[tuple[TimePoint, ...], Field(min_length=2, max_length=2000)]
    """in ascending order"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Times increase."""
        yield from rising(given, "time")


class OverSpeed(OnInertia):
    """A torque over the speed of its inertia; the end values apply outside."""

    type: Literal["over_speed"]
    points: Annotated[tuple[SpeedPoint, ...], Field(min_length=2, max_length=500)]
    """in ascending order"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Speeds increase."""
        yield from rising(given, "speed")


class OverPosition(OnInertia):
    """A torque over the angle or position of its inertia."""

    type: Literal["over_position"]
    points: Annotated[tuple[PositionPoint, ...], Field(min_length=2, max_length=500)]
    """in ascending order"""
    period: Annotated[
        Annotated[float, either(units.ANGLE, units.LENGTH, above=0)] | None, Absent("it is not periodic")
    ] = None
    """period of the table; its last point is one period after the first"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Positions increase; a table that repeats spans its period."""
        yield from rising(given, "position")
        period = given.number("period")
        points = given.blocks("points")
        places = [point.number("position") if point else None for point in points]
        known = [place for place in places if place is not None]
        if period is not None and 1 < len(known) == len(places) and abs(known[-1] - known[0] - period) > 1e-9 * period:
            yield Conflict(("period",), "the points do not span one period", "give the first point again at the end")


def rising(given: Given, key: str) -> Iterator[Conflict]:
    """Points of a table in order."""
    numbers = [point.number(key) if point else None for point in given.blocks("points")]
    for index, (one, other) in enumerate(pairwise(numbers), 1):
        if one is not None and other is not None and not other > one:
            reason = f"the `{key}` of a point is not above that of the point before"
            yield Conflict(("points", index, key), reason, "sort the points")
            return


AnyTorque = Annotated[
    ConstantTorque | RisingTorque | SineTorque | OverTime | OverSpeed | OverPosition, Field(discriminator="type")
]


class MotorOn(Fragment):
    """A motor on an inertia; it is off in scenes of the type `stop`."""

    at: str
    """the inertia it acts on"""
    motor: AnyMotor
    """torque of the motor"""
    count: Annotated[Annotated[int, Field(ge=1, le=64, strict=True)], Absent("one motor drives the inertia")] = 1
    """number of equal motors"""
    off_after: Annotated[PositiveTime | None, Absent("it stays on")] = None
    """time of the switch-off"""
    off_delay: Annotated[Time, Absent("it is off at the start of a stop")] = 0.0
    """in a `stop`: delay of the switch-off"""


class MotionPoint(Fragment):
    """A speed at a time."""

    time: Time
    """since the start of the scene"""
    speed: AnySpeed
    """of the inertia"""


class Motion(Fragment):
    """A prescribed motion of an inertia, linear between the points of its speed."""

    at: str
    """the inertia it acts on"""
    points: Annotated[tuple[MotionPoint, ...], Field(min_length=1, max_length=500)]
    """in ascending order"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Times increase, from 0 on."""
        yield from rising(given, "time")
        first = next(iter(given.blocks("points")), None)
        if first is not None and first.number("time") not in (None, 0.0):
            yield Conflict(("points", 0, "time"), "the motion is known from time 0 on", "write `0 s`")


class Impulse(Fragment):
    """An impact: a sudden change of momentum."""

    at: str
    """the inertia it acts on"""
    time: PositiveTime
    """time of the impulse"""
    size: AnyImpulse
    """impulse: torque times time, or force times time"""


class DrivetrainChecks(CheckSettings):
    """Limits of the checks of a drive train."""

    start_time: Annotated[PositiveTime | None, Limit()] = None
    """maximum starting time"""
    stop_time: Annotated[PositiveTime | None, Limit()] = None
    """maximum stopping time"""
    stop_angle: Annotated[Annotated[float, either(units.ANGLE, units.LENGTH, above=0)] | None, Limit()] = None
    """maximum stopping distance"""
    resonance_margin: Annotated[Fraction, Limit()] = 0.2
    """minimum separation of an excitation frequency from a natural frequency, relative to the natural frequency"""
    cycle_time: Annotated[
        PositiveTime | None, Setting("the time of the scene, at most that of a cycle with pauses")
    ] = None
    """cycle time of the rms motor torque; default: the time of the scene"""


class TrainScene(Scene):
    """Base of the scenes of a drive train."""

    duration: Annotated[PositiveTime | None, Setting("the start or stop and ten periods of the lowest frequency")] = (
        None
    )
    """length of the scene; `window_factor` does not change it"""
    of: str | None = None
    """inertia considered in the scene; default: that of the first motor, or the first inertia"""
    speed: Annotated[AnySpeed | None, Absent("it starts from rest")] = None
    """initial speed of that inertia; the other inertias follow"""
    links: Literal["relaxed", "loaded"] | None = None
    """whether links start without torque, or loaded; `loaded` in a `stop`"""


class Run(TrainScene):
    """The train for a given time."""

    type: Literal["run"] = "run"
    duration: PositiveTime
    """simulated time"""


class Start(TrainScene, TransientScene):
    """A start from standstill: brakes released, motors on."""

    type: Literal["start"] = "start"
    until: Annotated[AnySpeed | None, Setting("95 % of the speed of the motor")] = None
    """target speed of the inertia considered; default: 95 % of the motor speed"""


class Stop(TrainScene, TransientScene):
    """A stop: motors off, brakes applied."""

    type: Literal["stop"] = "stop"
    speed: Annotated[AnySpeed | None, Assumed()] = None
    """initial speed of that inertia; the other inertias follow; that of the motor without load when left out"""


AnyScene = Annotated[Run | Start | Stop, Field(discriminator="type")]


class Drivetrain(MachineSpec):
    """Rotating or travelling inertias, connected by gears and elastic links."""

    kind: Literal["drivetrain"]
    inertias: Annotated[dict[str, Body], Field(min_length=1, max_length=40)]
    """inertias, by name"""
    links: dict[str, Link] = Field(default_factory=dict, max_length=100)
    """elastic links, by name"""
    gears: dict[str, Gear] = Field(default_factory=dict, max_length=40)
    """rigid gears and drums, by name"""
    brakes: dict[str, Brake] = Field(default_factory=dict, max_length=40)
    """brakes and clutches, by name"""
    motors: dict[str, MotorOn] = Field(default_factory=dict, max_length=40)
    """motors, by name"""
    torques: dict[str, AnyTorque] = Field(default_factory=dict, max_length=100)
    """torques and forces other than motors: weights, working loads, excitations"""
    resistances: dict[str, Resistance] = Field(default_factory=dict, max_length=100)
    """friction, by name"""
    motions: dict[str, Motion] = Field(default_factory=dict, max_length=40)
    """prescribed motions, by name"""
    impulses: dict[str, Impulse] = Field(default_factory=dict, max_length=40)
    """impulses, by name"""
    checks: DrivetrainChecks = DrivetrainChecks()
    """limits, and checks switched off by code"""
    scenes: Annotated[tuple[AnyScene, ...], Field(min_length=1, max_length=50)] | None = None
    """load cases; default: a start"""

    PARTS: ClassVar[tuple[str, ...]] = (
        "links",
        "gears",
        "brakes",
        "motors",
        "torques",
        "resistances",
        "motions",
        "impulses",
    )

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Every part is tied to inertias that are there, in quantities of their kind."""
        yield from super().conflicts(given)
        yield from wiring(given, cls.PARTS)

    @property
    def all_scenes(self) -> Sequence[TrainScene]:
        """The scenes of the file, or a start."""
        return self.scenes if self.scenes is not None else (Start(),)

    @property
    def settings(self) -> CheckSettings:
        """The limits and switches of the file."""
        return self.checks

    def turns(self, name: str) -> bool:
        """Whether an inertia turns, not travels."""
        return self.inertias[name].turns

    def quantity_at(self, path: KeyPath, measure: Measure) -> Quantity:
        """The quantity of a number: that of the inertia its part acts on."""
        if measure.or_else is None or self._turning_at(path):
            return measure.quantity
        return measure.or_else

    def _turning_at(self, path: KeyPath) -> bool:
        if path[0] == "inertias":
            return self.turns(str(path[1]))
        if path[0] == "scenes" and isinstance(path[1], int):
            return self.turns(self.main(self.all_scenes[path[1]]))
        if path[0] == "checks":
            return self.turns(self.stopped)
        part: Any = getattr(self, str(path[0]))[path[1]]
        return self.turns(part.body if isinstance(part, Link) else part.at)

    @property
    def stopped(self) -> str:
        """The inertia whose way the stops are about."""
        return self.main(next((scene for scene in self.all_scenes if isinstance(scene, Stop)), None))

    def main(self, scene: TrainScene | None = None) -> str:
        """The inertia a scene is about."""
        if scene is not None and scene.of is not None:
            return scene.of
        if self.motors:
            return next(iter(self.motors.values())).at
        return next(iter(self.inertias))
