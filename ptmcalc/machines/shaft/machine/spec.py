"""How a designer writes the main shaft of a machine."""

import math
from collections.abc import Iterator, Sequence
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from ptmcalc.base import units
from ptmcalc.components.motor import AnyMotor
from ptmcalc.machines.shaft.machine import wiring
from ptmcalc.spec.fields import (
    Angle,
    Efficiency,
    Force,
    Fraction,
    Inertia,
    Length,
    Mass,
    Measure,
    PositiveAngle,
    PositiveAngularSpeed,
    PositiveInertia,
    PositiveLength,
    PositiveMass,
    PositiveRatio,
    PositiveTime,
    SignedForce,
    SignedTorque,
    Time,
    Torque,
)
from ptmcalc.spec.fragment import Conflict, Fragment, Given
from ptmcalc.spec.machine import CheckSettings, MachineSpec
from ptmcalc.spec.optional import Absent, Assumed, Limit, Setting
from ptmcalc.spec.scene import Scene

SignedInertia = Annotated[float, Measure(units.INERTIA)]
SignedEnergy = Annotated[float, Measure(units.ENERGY)]
Offset = Annotated[float, Measure(units.LENGTH)]
Stiffness = Annotated[float, Measure(units.LINE_FORCE, at_least=0)]
Viscous = Annotated[float, Measure(units.TORQUE_SLOPE, at_least=0)]
ShareAboveNothing = Annotated[float, Measure(units.SHARE, above=0)]
Order = Annotated[int, Field(ge=1, le=200, strict=True)]

FULL_TURN = wiring.FULL_TURN


def _rising(given: Given, key: str, place: str, reason: str) -> Iterator[Conflict]:
    """Points of a list are sorted by their place."""
    places = [point.number(place) if point else None for point in given.blocks(key)]
    for index in range(1, len(places)):
        here, before = places[index], places[index - 1]
        if here is not None and before is not None and here <= before:
            yield Conflict((key, index, place), reason, "sort the points, and give each place once")
            return


# -- inertia --------------------------------------------------------------------------------------------------------


class ConstantInertia(Fragment):
    """The same inertia at every angle."""

    type: Literal["constant"]
    value: PositiveInertia
    """all parts that rotate with the main shaft, reduced to it"""


class Harmonic(Fragment):
    """One term of a Fourier series of the inertia over the angle of the main shaft."""

    order: Order
    """times per turn"""
    cosine: Annotated[SignedInertia, Absent("the term has no such component")] = 0.0
    """factor of cos(order * angle)"""
    sine: Annotated[SignedInertia, Absent("the term has no such component")] = 0.0
    """factor of sin(order * angle)"""


class HarmonicInertia(Fragment):
    """An inertia over the angle as a mean value with harmonics."""

    type: Literal["harmonics"]
    mean: PositiveInertia
    """mean over a turn"""
    terms: Annotated[tuple[Harmonic, ...], Field(min_length=1, max_length=100)]
    """the harmonics"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The inertia stays above 0; between a thousand angles a turn the harmonics cannot dip below unseen by much."""
        mean = given.number("mean")
        terms = [
            (term.raw.get("order"), term.number("cosine"), term.number("sine"))
            for term in given.blocks("terms")
            if term
        ]
        known = [(k, c, s) for k, c, s in terms if isinstance(k, int) and c is not None and s is not None]
        if mean is None or len(known) < len(given.blocks("terms")) or not known:
            return
        swing = sum(math.hypot(c, s) for _, c, s in known)
        if swing < mean:
            return
        lowest = _lowest_sum(mean, known)
        if lowest <= 0:
            reason = f"the inertia decreases to {units.show(lowest, units.INERTIA)} at one angle"
            yield Conflict(("terms",), reason, "an inertia must be above 0 at every angle: check mean and terms")


def _lowest_sum(mean: float, terms: Sequence[tuple[int, float, float]]) -> float:
    """Smallest value of a Fourier series, from samples and what it can do between them."""
    count = 64 * max(k for k, _, _ in terms)
    angles = np.arange(count) * (FULL_TURN / count)
    samples = mean + sum(c * np.cos(k * angles) + s * np.sin(k * angles) for k, c, s in terms)
    curvature = sum(k * k * math.hypot(c, s) for k, c, s in terms)
    return float(np.min(samples)) - curvature * (FULL_TURN / count) ** 2 / 8


class InertiaPoint(Fragment):
    """One point of a table of the inertia."""

    angle: Angle
    """of the main shaft"""
    inertia: PositiveInertia
    """total inertia, reduced to the main shaft at this angle"""


class TableInertia(Fragment):
    """An inertia over the angle by a closed cubic spline through points."""

    type: Literal["table"]
    points: Annotated[tuple[InertiaPoint, ...], Field(min_length=3, max_length=500)]
    """points within one cycle, in ascending angle"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The points are sorted."""
        yield from _rising(given, "points", "angle", "the angle is not above that of the point before")


class SliderCrank(Fragment):
    """A crank with rod and slider; angle 0 is the slider position farthest from the crank axis (no offset)."""

    type: Literal["slider_crank"]
    crank_radius: PositiveLength
    """of the crank or eccentric"""
    rod_length: PositiveLength
    """between its two eyes"""
    offset: Annotated[Offset, Absent("the slider axis intersects the crank axis")] = 0.0
    """distance of the slider axis from the crank axis"""
    crank_inertia: PositiveInertia
    """all parts that rotate with the main shaft"""
    slider_mass: PositiveMass
    """slider with tool"""
    rod_mass: Annotated[
        Mass,
        Absent("the rod mass is included in `crank_inertia` and `slider_mass` (two-mass substitution)"),
    ] = 0.0
    """of the connecting rod"""
    rod_centre: Annotated[Fraction | None, Assumed()] = None
    """distance of the rod centre of mass from the crank pin / rod length; 0.3 is assumed when it is left out"""
    rod_inertia: Annotated[Inertia | None, Assumed()] = None
    """of the rod about its centre of mass; that of a uniform bar is assumed when it is left out"""
    inclination: Annotated[Angle | None, Absent("slider and rod are balanced; their weights do no work in a cycle")] = (
        None
    )
    """of the slide below the horizontal, from the crank to the slider: 90 deg for a press with the slide below;
    without it the weights of slider and rod are neglected (balanced)"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The crank can turn round."""
        radius, rod, offset = (given.number(key) for key in ("crank_radius", "rod_length", "offset"))
        if radius is not None and rod is not None and offset is not None and rod <= radius + abs(offset):
            reason = "the crank cannot rotate fully: the rod is not longer than crank radius plus offset"
            yield Conflict(("rod_length",), reason, "check the three lengths")


AnyInertia = Annotated[
    ConstantInertia | HarmonicInertia | TableInertia | SliderCrank,
    Field(discriminator="type"),
]

# -- load -----------------------------------------------------------------------------------------------------------


class Sector(Fragment):
    """A part of the cycle with a constant useful torque."""

    start: Angle = Field(alias="from")
    """angle at which it begins"""
    to: Angle
    """angle at which it ends; it may be after the end of the cycle"""
    torque: SignedTorque
    """useful torque on the main shaft; negative if the load drives"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """A sector begins before it ends."""
        start, to = given.number("from"), given.number("to")
        if start is not None and to is not None and to <= start:
            hint = f"write e.g. `to: {units.show(to + FULL_TURN, units.ANGLE)}` for a sector past the end of the cycle"
            yield Conflict(("to",), "the sector ends at or before its start", hint)


class SectorLoad(Fragment):
    """Useful torque in sectors of the cycle; where they overlap, it adds up."""

    type: Literal["sectors"]
    sectors: Annotated[tuple[Sector, ...], Field(min_length=1, max_length=100)]
    """the sectors; outside of them there is no useful torque"""


class TorquePoint(Fragment):
    """One point of a table of the useful torque."""

    angle: Angle
    """of the main shaft"""
    torque: SignedTorque
    """useful torque there"""


class TableLoad(Fragment):
    """Useful torque over the angle, linear between points and from the last point to the first of the next cycle."""

    type: Literal["table"]
    points: Annotated[tuple[TorquePoint, ...], Field(min_length=2, max_length=500)]
    """points within one cycle, in ascending angle"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The points are sorted."""
        yield from _rising(given, "points", "angle", "the angle is not above that of the point before")


class ForcePoint(Fragment):
    """One point of the force over the stroke."""

    distance: Length
    """of the slider from its dead centre"""
    force: Force
    """on the tool there"""


class ToolLoad(Fragment):
    """Force on the tool of a slider-crank over the distance from a dead centre."""

    type: Literal["tool_force"]
    points: Annotated[tuple[ForcePoint, ...], Field(min_length=2, max_length=200)]
    """points in ascending distance, linear between them; no force outside"""
    stroke: Literal["approach", "return", "both"] = "approach"
    """towards the dead centre, away from it, or both"""
    dead_centre: Literal["far", "near"] = "far"
    """dead centre far from the crank axis, or near to it"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The points are sorted."""
        yield from _rising(given, "points", "distance", "the distance is not above that of the point before")


AnyLoad = Annotated[SectorLoad | TableLoad | ToolLoad, Field(discriminator="type")]


class Losses(Fragment):
    """Losses of the mechanism, on the main shaft."""

    torque: Annotated[Torque, Absent("the useful load, or `share`, contains the friction")] = 0.0
    """constant friction torque"""
    viscous: Annotated[Viscous, Absent("friction does not depend on the speed")] = 0.0
    """friction torque per speed of the main shaft"""
    share: Annotated[
        Annotated[float, Measure(units.SHARE, at_least=0, at_most=1)],
        Absent("the useful load, or `torque`, contains the friction"),
    ] = 0.0
    """friction torque / useful torque, while it acts"""


# -- weights and springs --------------------------------------------------------------------------------------------


class Unbalance(Fragment):
    """The weight of an eccentric mass on the main shaft."""

    type: Literal["unbalance"]
    mass: PositiveMass
    """the mass"""
    radius: PositiveLength
    """of its centre of mass from the axis"""
    top: Annotated[Angle, Absent("angles start at the top position of the mass")] = 0.0
    """angle of the main shaft with the mass at the top"""


class PotentialHarmonic(Fragment):
    """A torque over the angle with zero mean: zero work per cycle."""

    type: Literal["harmonic"]
    order: Order
    """times per turn"""
    cosine: Annotated[SignedTorque, Absent("the term has no such component")] = 0.0
    """factor of cos(order * angle) in the torque against the motion"""
    sine: Annotated[SignedTorque, Absent("the term has no such component")] = 0.0
    """factor of sin(order * angle) in the torque against the motion"""


class EnergyPoint(Fragment):
    """One point of a table of stored energy."""

    angle: Angle
    """of the main shaft"""
    energy: SignedEnergy
    """stored in weights and springs there"""


class EnergyTable(Fragment):
    """Energy stored in weights and springs over the angle; its slope is the torque, with zero work per cycle."""

    type: Literal["energy"]
    points: Annotated[tuple[EnergyPoint, ...], Field(min_length=3, max_length=500)]
    """points within one cycle, in ascending angle, connected by one closed cubic spline"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The points are sorted."""
        yield from _rising(given, "points", "angle", "the angle is not above that of the point before")


class ToolSpring(Fragment):
    """A spring or balancing cylinder that pulls the slider of a slider-crank towards the crank."""

    type: Literal["tool_spring"]
    force: SignedForce
    """with the slider farthest from the crank axis; negative if it pushes away"""
    stiffness: Annotated[Stiffness, Absent("the force stays the same over the stroke")] = 0.0
    """decrease of the force per distance towards the crank"""


AnyPotential = Annotated[Unbalance | PotentialHarmonic | EnergyTable | ToolSpring, Field(discriminator="type")]

# -- drive and brake ------------------------------------------------------------------------------------------------


class Gear(Fragment):
    """The gear between motor and main shaft."""

    ratio: Annotated[PositiveRatio, Absent("the motor is on the main shaft")] = 1.0
    """motor speed / main shaft speed"""
    efficiency: Annotated[Efficiency | None, Assumed()] = None
    """from motor to main shaft; 0.94 is assumed when it is left out and the ratio is not 1"""
    reverse_efficiency: Annotated[Efficiency | None, Assumed()] = None
    """from main shaft to motor, while the motor brakes; the same when left out"""
    braking: Literal["divides", "multiplies"] = "divides"
    """effect of the efficiency on the motor torque during braking: `divides` by it, as the power then flows
    back through the gear, or `multiplies` as while driving, as in hand calculation"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """A gear that takes the same factor both ways has no efficiency of its own for the way back."""
        if "reverse_efficiency" in given and given.word("braking") == "multiplies":
            reason = "it is unused: `braking: multiplies` uses `efficiency` in both directions"
            yield Conflict(("reverse_efficiency",), reason, "delete `reverse_efficiency`, or write `braking: divides`")


class Drive(Fragment):
    """Motor and gear."""

    motor: AnyMotor
    """the motor"""
    motor_inertia: Annotated[Inertia, Absent("`inertia` includes all rotating parts and the rotor")] = 0.0
    """of rotor, coupling and all other parts on the motor shaft; omit it if `inertia` already includes it"""
    gear: Gear = Gear()
    """the gear; without it the motor is on the main shaft"""


class Brake(Fragment):
    """The brake, on the main shaft."""

    torque: Torque
    """full torque"""
    delay: Time
    """from the command to the first torque"""
    rise: Annotated[
        Time,
        Assumed(0.0, 0.0, 0.1, "spring-applied and pneumatic brakes: up to 0.1 s from the first to the full torque"),
    ] = 0.0
    """from first to full torque, linear rise"""


# -- scenes, limits, machine ----------------------------------------------------------------------------------------


class ShaftChecks(CheckSettings):
    """Limits of the checks of a main shaft."""

    irregularity: Annotated[ShareAboveNothing | None, Limit()] = None
    """maximum speed fluctuation (w_max - w_min)/w_mean of the steady cycle; 5 % for presses, 1 % for a generator"""
    run_up_time: Annotated[PositiveTime | None, Limit()] = None
    """maximum run-up time"""
    stop_angle: Annotated[PositiveAngle | None, Limit()] = None
    """maximum stopping angle with brake"""
    stop_time: Annotated[PositiveTime | None, Limit()] = None
    """maximum stopping time with brake"""
    breakdown_share: Annotated[ShareAboveNothing, Limit()] = 0.81
    """maximum motor torque / breakdown torque; 0.9^2 at a voltage of 90 %"""


class ShaftScene(Scene):
    """Base of the scenes of a main shaft."""


class RunUp(ShaftScene):
    """The run-up of the shaft from standstill to speed."""

    type: Literal["run_up"] = "run_up"
    start: Annotated[Angle, Setting("from the angle 0; the angle of the dead centre for a slider-crank")] = Field(
        default=0.0, alias="from"
    )
    """angle of the main shaft at standstill"""
    to: Annotated[PositiveAngularSpeed | None, Setting("95 % of the speed without load")] = None
    """speed of the main shaft at which the run-up ends; 95 % of that without load when left out"""
    load: Literal["idle", "full"] = "idle"
    """whether the useful load acts"""


class Steady(ShaftScene):
    """The steady periodic cycle."""

    type: Literal["steady"] = "steady"
    load: Literal["full", "idle"] = "full"
    """whether the useful load acts"""


class RunOut(ShaftScene):
    """The drive is switched off in the steady cycle, and the shaft is braked or coasts."""

    type: Literal["run_out"] = "run_out"
    start: Annotated[Angle | None, Setting("the worst angle of the cycle is found")] = Field(default=None, alias="from")
    """angle of the main shaft at switch-off; the worst angle when left out"""
    brake: Literal["on", "off"] | None = None
    """whether the brake is applied; default: on if the machine has a brake"""
    load: Literal["idle", "full"] = "idle"
    """whether the useful load acts during the stop"""
    after: Literal["full", "idle"] = "full"
    """load of the preceding steady cycle"""


AnyScene = Annotated[RunUp | Steady | RunOut, Field(discriminator="type")]


class Shaft(MachineSpec):
    """The main shaft of a cyclic machine, with all masses reduced to it."""

    kind: Literal["shaft"]
    speed: Annotated[
        PositiveAngularSpeed | None, Absent("a nominal speed, used only for comparison with motor and gear")
    ] = None
    """nominal speed of the main shaft; compared with motor and gear"""
    cycle_angle: Annotated[
        PositiveAngle, Absent("one revolution is the period of the machine; parts with another period are rejected")
    ] = FULL_TURN
    """period of the machine as an angle"""
    inertia: AnyInertia
    """inertia reduced to the main shaft"""
    drive: Drive
    """motor and gear"""
    load: AnyLoad | None = None
    """the useful load; without it the machine idles"""
    losses: Losses = Losses()
    """friction"""
    potential: Annotated[tuple[AnyPotential, ...], Field(max_length=50)] = ()
    """weights and springs"""
    brake: Brake | None = None
    """the brake"""
    checks: ShaftChecks = ShaftChecks()
    """limits, and checks switched off by code"""
    scenes: Annotated[tuple[AnyScene, ...], Field(min_length=1, max_length=50)] | None = None
    """load cases; default: run-up, steady cycle and stop"""

    DEFAULT_SCENES: ClassVar[tuple[RunUp | Steady | RunOut, ...]] = (RunUp(), Steady(), RunOut())

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Blocks that need each other, and a cycle that repeats all of them."""
        yield from super().conflicts(given)
        yield from wiring.needing_a_crank(given)
        yield from wiring.not_repeated(given)
        yield from wiring.falling_below_zero(given)
        yield from wiring.scenes_that_lack(given)

    @property
    def all_scenes(self) -> Sequence[RunUp | Steady | RunOut]:
        return self.scenes or self.DEFAULT_SCENES

    @property
    def settings(self) -> ShaftChecks:
        return self.checks
