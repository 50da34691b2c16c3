"""How a designer writes a slewing crane: what turns, what holds it back, what drives and what stops it."""

import itertools
from collections.abc import Iterator, Sequence
from typing import Annotated, Literal

from pydantic import Field

from ptmcalc.base import units
from ptmcalc.components.slewing_drive import SlewBrake, SlewGear, SlewMotor
from ptmcalc.spec.fields import (
    Inertia,
    Mass,
    Measure,
    PositiveAngle,
    PositiveAngularSpeed,
    PositiveArea,
    PositiveForce,
    PositiveInertia,
    PositiveMass,
    PositivePressure,
    PositiveRatio,
    PositiveShare,
    PositiveSpan,
    PositiveTime,
    PositiveTorque,
    Share,
    Span,
    Time,
    Torque,
)
from ptmcalc.spec.fragment import Conflict, Fragment, Given, at_most_one, together
from ptmcalc.spec.machine import CheckSettings, MachineSpec
from ptmcalc.spec.optional import Absent, Assumed, Limit, OneOf
from ptmcalc.spec.scene import TransientScene
from ptmcalc.spec.shape import Also

Slope = Annotated[float, Measure(units.SLOPE, at_least=0, at_most=0.5)]
SwayAngle = Annotated[float, Measure(units.ANGLE, above=0, at_most=1.2)]
BrakeAngle = Annotated[float, Measure(units.ANGLE, above=0, at_most=6.2832)]


class Load(Fragment):
    """The load on the jib."""

    mass: PositiveMass
    """rated load with its grab or sling"""
    hook_block: Annotated[Mass | None, Assumed()] = None
    """hook block and permanent load handling devices"""
    radius: PositiveSpan = Field(examples=["8 m"])
    """from the slewing axis to the jib head"""
    rope_length: Annotated[
        PositiveSpan | None, Absent("the sway checks require it and report `not checked` without it")
    ] = Field(default=None, examples=["6 m"])
    """from the jib head to the load centre; needed for the load sway"""


class Body(Fragment):
    """A part of the slewing structure."""

    mass: Mass
    """of the part"""
    radius: Span
    """from the slewing axis to its centre of mass"""
    inertia: Annotated[Inertia | None, Assumed()] = None
    """about its own centre of mass"""


class Jib(Fragment):
    """The jib as a uniform rod."""

    mass: PositiveMass
    """of the jib"""
    length: PositiveSpan
    """of the jib, as seen from above"""
    foot_radius: Annotated[Span, Absent("the jib starts at the slewing axis")] = 0.0
    """from the slewing axis to the jib foot"""


class Wind(Fragment):
    """The wind torque about the slewing axis: torques, or an area on a lever arm and its pressures."""

    steady: Annotated[Torque | None, Absent("no wind: indoor crane")] = None
    """mean torque of a working day"""
    maximum: Annotated[Torque | None, Assumed()] = None
    """maximum in-service torque, for brake and motor; at least the steady torque plus the gust"""
    gust: Annotated[Torque | None, Absent("gusts are part of the maximum wind of the holding checks")] = None
    """torque of a gust in addition to the steady wind"""
    area: Annotated[PositiveArea | None, OneOf("steady, maximum, gust")] = Field(default=None, examples=["12 m^2"])
    """net wind area of jib and load about the slewing axis, or give the torques"""
    arm: Annotated[PositiveSpan | None, OneOf("steady, maximum, gust")] = Field(default=None, examples=["4 m"])
    """from the slewing axis to the centre of the area"""
    steady_pressure: Annotated[PositivePressure | None, OneOf("steady")] = Field(default=None, examples=["50 Pa"])
    """of the wind of a working day"""
    maximum_pressure: Annotated[PositivePressure | None, OneOf("maximum")] = None
    """maximum in-service pressure; 250 Pa by most standards"""
    gust_pressure: Annotated[PositivePressure | None, OneOf("gust")] = None
    """pressure of a gust, in addition to the steady one"""
    gust_rise: Annotated[PositiveTime | None, Assumed()] = None
    """rise time of a gust"""
    gust_time: Annotated[PositiveTime | None, Assumed()] = None
    """duration of the gust"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Torques, or an area with its arm and pressures; the largest is the largest."""
        for torque in ("steady", "maximum", "gust"):
            pressure = f"{torque}_pressure"
            yield from at_most_one(given, torque, pressure)
            if pressure in given and "area" not in given:
                yield from together(given, pressure, "area", "a pressure acts on an area")
        for key, other in (("area", "arm"), ("arm", "area")):
            yield from together(given, key, other, "the torque of an area depends on its arm")
        if "area" in given and not any(f"{t}_pressure" in given for t in ("steady", "maximum", "gust")):
            yield given.missing("steady_pressure", "the wind on the area has no pressure")
        steady, most = given.number("steady"), given.number("maximum")
        if steady is not None and most is not None and most < steady:
            yield Conflict(("maximum",), "the maximum wind is below the steady wind", "swap them")

    def _torque(self, torque: float | None, pressure: float | None) -> float | None:
        if torque is not None:
            return torque
        if pressure is None or self.area is None or self.arm is None:
            return None
        return pressure * self.area * self.arm

    @property
    def steady_torque(self) -> float:
        """Torque of the steady wind [N*m]."""
        return self._torque(self.steady, self.steady_pressure) or 0.0

    @property
    def maximum_torque(self) -> float:
        """Largest torque in service [N*m]."""
        return max(self._torque(self.maximum, self.maximum_pressure) or 0.0, self.steady_torque + self.gust_torque)

    @property
    def gust_torque(self) -> float:
        """Torque of a gust on top of the steady wind [N*m]."""
        return self._torque(self.gust, self.gust_pressure) or 0.0


class Cycle(Fragment):
    """The working cycle of the crane."""

    rotation: Annotated[
        PositiveAngle, Absent("180 deg is the maximum slewing angle of a crane that slews in both directions")
    ] = 3.141592653589793
    """from pick-up to put-down; 180 deg when left out"""
    brake_angle: BrakeAngle = Field(examples=["15 deg"])
    """permissible stopping angle: 15 deg in light duty"""
    start_time: Annotated[PositiveTime | None, OneOf("start_angle, motor.mean_starting_torque")] = None
    """starting time, if the motor torque does not determine it"""
    start_angle: Annotated[PositiveAngle | None, OneOf("start_time, motor.mean_starting_torque")] = None
    """angle of the start, instead of `start_time`"""
    pause: Annotated[Time, Absent("without a pause, the motor temperature is highest")] = 0.0
    """pause between two slewing motions, in which the motor cools"""
    exponent: Annotated[PositiveRatio, Absent("3: tooth contact, the basis of gearbox ratings")] = 3.0
    """fatigue exponent m of the equivalent torque: 3 for tooth contact, 6 to 9 for tooth bending"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The start is given in one way."""
        yield from at_most_one(given, "start_time", "start_angle")
        whole, stop = given.number("rotation"), given.number("brake_angle")
        if whole is not None and stop is not None and stop >= whole:
            yield Conflict(("brake_angle",), "the stopping angle exceeds the whole slewing angle", "check both angles")


class Handbook(Fragment):
    """Inputs of the handbook formulas only."""

    start_time: Annotated[PositiveTime | None, OneOf("cycle.start_time")] = None
    """starting time of the handbook formulas"""
    start_angle: Annotated[PositiveAngle | None, OneOf("cycle.start_angle")] = None
    """starting angle of the handbook formulas, instead of the time"""
    shares: Literal["rounded", "exact"] = "rounded"
    """shares of the cycle rounded to three digits and not renormalised, as printed course projects do, or exact"""
    rotor_eta_rule: Literal["eta", "one", "inverse"] = "eta"
    """gear efficiency in the reduced rotor inertia: J u^2 eta, J u^2 or J u^2/eta"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The start is given in one way."""
        yield from at_most_one(given, "start_time", "start_angle")


class RingPoint(Fragment):
    """A point of the limiting load curve of a slewing ring."""

    axial: Annotated[float, Measure(units.FORCE, at_least=0)]
    """axial force"""
    moment: PositiveTorque
    """permissible tilting moment with this axial force"""


class Ring(Fragment):
    """The slewing ring bearing, or the bearings of a fixed column."""

    mass_above: Annotated[Mass | None, Absent("the sum of the parts given in the file")] = None
    """mass above the ring without the load; default: sum of the parts"""
    unbalance: Annotated[
        Annotated[float, Measure(units.TORQUE)] | None, Absent("the value of the parts given in the file")
    ] = None
    """tilting moment of the crane without load, towards the load; default: that of the parts"""
    head_height: Annotated[Span | None, Assumed()] = None
    """height of the jib head above the ring"""
    wind_height: Annotated[Span | None, Assumed()] = None
    """height of the centre of the wind area above the ring"""
    wind_force: Annotated[PositiveForce | None, Absent("no wind along the jib: indoor crane")] = None
    """force of the maximum in-service wind along the jib"""
    load_factor: Annotated[Annotated[float, Measure(units.FACTOR, at_least=1, at_most=5)], Limit()] = 1.25
    """factor on the load weight for hoisting and test loads; catalogues require 1.25"""
    curve: Annotated[tuple[RingPoint, ...], Field(min_length=1, max_length=50)] | None = None
    """limiting load curve of the catalogue, in ascending axial force; needed to check the ring"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The points of the curve go by their axial forces."""
        forces = [point.number("axial") if point else None for point in given.blocks("curve")]
        for index, (one, other) in enumerate(itertools.pairwise(forces), 1):
            if one is not None and other is not None and other <= one:
                reason = "the axial force is not above that of the point before"
                yield Conflict(("curve", index, "axial"), reason, "sort the points by axial force, each once")


class SpectrumPoint(Fragment):
    """A part of the load spectrum."""

    share: PositiveShare
    """of all cycles"""
    load: Share
    """relative to the rated load"""


class Classes(Fragment):
    """Classification and use of the crane."""

    group: Literal["A1", "A2", "A3", "A4", "A5", "A6", "A7", "A8"] | None = None
    """declared crane group; compared with the required group"""
    cycles: Annotated[
        Annotated[float, Measure(units.FACTOR, above=0)] | None, Absent("the group is checked only if it is given")
    ] = None
    """working cycles in the service life; with the spectrum they determine the required group"""
    load_spectrum: Annotated[tuple[SpectrumPoint, ...], Field(min_length=1, max_length=20)] | None = None
    """load spectrum of the service life; default: always the rated load"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The shares of a spectrum are a whole."""
        points = given.blocks("load_spectrum")
        shares = [point.number("share") if point else None for point in points]
        known = [share for share in shares if share is not None]
        if known and len(known) == len(shares) and abs(sum(known) - 1) > 1e-6:
            reason = f"the shares add up to {sum(known):.3g}"
            yield Conflict(("load_spectrum",), reason, "correct them to a sum of 1, so that every cycle has a load")


class SlewingChecks(CheckSettings):
    """Limits of the checks of a slewing crane."""

    starting_reserve: Annotated[PositiveRatio, Limit()] = 1.1
    """minimum starting torque / steady slewing torque"""
    start_time: Annotated[PositiveTime, Limit()] = 10.0
    """maximum starting time"""
    least_start_time: Annotated[PositiveTime, Limit()] = 1.0
    """minimum starting time, to limit the load sway"""
    brake_time: Annotated[PositiveTime, Limit()] = 10.0
    """maximum stopping time"""
    least_brake_time: Annotated[PositiveTime, Limit()] = 1.0
    """minimum stopping time, to limit the load sway"""
    holding_reserve: Annotated[PositiveRatio, Limit()] = 1.0
    """minimum ratio of starting torque, and of brake torque, to the torque of the maximum wind"""
    sway: Annotated[SwayAngle, Limit()] = 0.174532925199433
    """maximum hoist rope angle, radial or tangential; 10 deg when left out"""


class SlewingScene(TransientScene):
    """Base of the scenes of a slewing crane."""

    load: Literal["full", "empty"] = "full"
    """the rated load on the hook, or the hook block alone"""

    def default_name(self) -> str:
        return f"{self.type}_{'loaded' if self.load == 'full' else self.load}"


class Slew(SlewingScene):
    """A complete slewing motion: start, steady slewing, stop."""

    type: Literal["slew"] = "slew"


AnyScene = Slew


class SlewingCrane(MachineSpec):
    """A crane that slews about a vertical axis: on a column, a ring or a portal."""

    kind: Literal["crane"]
    type: Literal["slewing"]
    """of the crane"""
    load: Load | None = None
    """load on the jib; optional with `inertia`, but needed for the sway"""
    slewing_part: Body | None = None
    """platform, column or portal with its equipment"""
    counterweight: Body | None = None
    """the counterweight"""
    jib: Jib | None = None
    """the jib"""
    inertia: Annotated[PositiveInertia | None, OneOf("slewing_part, counterweight, jib")] = Field(
        default=None, examples=["60000 kg*m^2"]
    )
    """of all slewing parts, the load at its radius included, instead of the parts"""
    speed: PositiveAngularSpeed = Field(examples=["2 rpm"])
    """of slewing"""
    friction: Torque
    """torque of all bearings about the slewing axis"""
    wind: Wind = Wind()
    """about the slewing axis; none when left out"""
    slope: Annotated[Slope, Absent("vertical axis; `friction` contains the resistance of a level crane")] = 0.0
    """of the slewing axis from the vertical; needs the masses"""
    motor: SlewMotor
    """the slewing motors"""
    gear: SlewGear
    """from motor to slewing axis"""
    brake: SlewBrake | None = None
    """the slewing brake; needed to check stops"""
    cycle: Cycle
    """working cycle"""
    handbook: Handbook = Handbook()
    """inputs of the handbook formulas only"""
    ring: Annotated[Ring, Also("slewing_ring")] = Ring()
    """the slewing ring"""
    classes: Classes = Field(default=Classes(), alias="class")
    """classification of the crane"""
    checks: SlewingChecks = SlewingChecks()
    """limits, and checks switched off by code"""
    scenes: Annotated[tuple[AnyScene, ...], Field(min_length=1, max_length=50)] | None = None
    """load cases; default: a rotation with the rated load, and one with the hook block alone, when left out"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The inertia is given in one way; the start is given by torque or time."""
        yield from super().conflicts(given)
        parts = [key for key in ("slewing_part", "counterweight", "jib") if key in given]
        if "inertia" in given:
            for key in parts:
                reason = "give `inertia` or the parts, not both: they state the same quantity"
                yield Conflict((key,), reason, f"delete `{key}`")
            if given.number("slope"):
                reason = "an inertia does not determine the weights on a slope"
                yield Conflict(("slope",), reason, "give `load`, `slewing_part`, `counterweight` and `jib` instead")
        elif not parts:
            yield given.missing("inertia", "give `inertia`, or the slewing parts: `slewing_part`, `jib` ...")
        elif "load" not in given:
            yield given.missing("load", "the load is one of the slewing parts")
        yield from _nothing_turns(given)
        yield from _load_too_heavy(given)
        yield from _nothing_starts(given)

    @property
    def all_scenes(self) -> Sequence[SlewingScene]:
        if self.scenes is not None:
            return self.scenes
        return (Slew(),) if self.load is None else (Slew(), Slew(load="empty"))

    @property
    def settings(self) -> SlewingChecks:
        return self.checks


def _load_too_heavy(given: Given) -> Iterator[Conflict]:
    """The load at its radius is a part of the whole inertia."""
    load, whole = given.block("load"), given.number("inertia")
    if "load" not in given or load is None or whole is None:
        return
    mass, block, radius = load.number("mass"), load.number("hook_block"), load.number("radius")
    if mass is None or radius is None:
        return
    own = (mass + (block or 0.0)) * radius**2
    if own >= whole:
        reason = f"the load alone has {units.show(own, units.INERTIA)} about the axis and is part of the total inertia"
        yield Conflict(
            ("inertia",), reason, f"write more than `{units.show(1.01 * own, units.INERTIA)}`, structure included"
        )


def _nothing_turns(given: Given) -> Iterator[Conflict]:
    """Parts whose centres all lie on the axis have to say their own inertia: a crane without any cannot be computed."""
    parts = [key for key in ("slewing_part", "counterweight") if key in given]
    if "inertia" in given or "jib" in given or not parts:
        return
    for key in parts:
        part = given.block(key)
        if part is None:
            return
        mass, radius, own = (part.number(name) for name in ("mass", "radius", "inertia"))
        if mass is None or radius is None or own or mass * radius > 0 or ("inertia" in part and own is None):
            return
    reason = (
        "the parts have no inertia about the slewing axis: their centres of mass are on the axis, or their masses are 0"
    )
    yield Conflict((parts[0],), reason, "add its `inertia: 5000 kg*m^2`, or the `jib`")


def _nothing_starts(given: Given) -> Iterator[Conflict]:
    """Either the motor says how it starts, or the cycle in which time."""
    motor, cycle = given.block("motor"), given.block("cycle")
    if motor is None or cycle is None or "motor" not in given or "cycle" not in given:
        return
    by_torque = any(key in motor for key in ("mean_starting_torque", "largest_starting_torque", "curve"))
    if not by_torque and "start_time" not in cycle and "start_angle" not in cycle:
        reason = "the start is not defined: the motor has no starting torque, and `cycle` has no `start_time`"
        yield Conflict(("motor",), reason, "add `mean_starting_torque: 37 N*m`, or `start_time: 8 s` to `cycle`")
