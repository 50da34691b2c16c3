"""How a designer writes a crane that travels: what moves on its wheels, what hangs on it, what drives and stops it."""

from collections.abc import Iterator, Sequence
from typing import Annotated, Literal

from pydantic import Field

from ptmcalc.base import units
from ptmcalc.components.buffer import Buffer
from ptmcalc.components.pendulum import Suspension
from ptmcalc.components.travel_drive import TravelDrive
from ptmcalc.machines.crane.travelling.machine.keys.actions import Actions
from ptmcalc.machines.crane.travelling.machine.keys.duty import Classes, Declared, Duty
from ptmcalc.machines.crane.travelling.machine.keys.runway import Guide, Rail, Rolling, Wheels
from ptmcalc.machines.crane.travelling.machine.scenes import (
    AnyScene,
    Brake,
    Collision,
    HoistWhileTravelling,
    RailStep,
    Run,
    Runway,
    Skew,
    Start,
    Storm,
    TravelScene,
)
from ptmcalc.spec.fields import (
    Mass,
    Measure,
    PositiveAngle,
    PositiveForce,
    PositiveLength,
    PositiveMass,
    PositivePressure,
    PositiveRatio,
    PositiveSpan,
    PositiveSpeed,
    PositiveTime,
    SignedSpan,
    Span,
)
from ptmcalc.spec.fragment import Conflict, Fragment, Given
from ptmcalc.spec.machine import CheckSettings, MachineSpec
from ptmcalc.spec.optional import Absent, Assumed, Limit, OneOf

WindArea = Annotated[float, Measure(units.FACE, at_least=0)]
Count = Annotated[int, Field(ge=1, le=16, strict=True)]


class Bridge(Fragment):
    """Travelling parts other than the trolley: girders, end carriages, the legs of a gantry."""

    mass: PositiveMass
    """without the trolley"""
    span: PositiveSpan
    """from rail A to rail B"""
    centre: Annotated[PositiveSpan | None, Absent("a bridge symmetric about its centre")] = None
    """of gravity, from rail A; default: middle"""
    height: Annotated[Span | None, Assumed()] = None
    """of its centre of gravity above the wheels' rails"""
    cantilever_a: Annotated[Span, Absent("without it the hook positions are between the rails")] = 0.0
    """of a gantry, beyond rail A"""
    cantilever_b: Annotated[Span, Absent("without it the hook positions are between the rails")] = 0.0
    """of a gantry, beyond rail B"""


class Trolley(Fragment):
    """The trolley that carries the hoist."""

    mass: PositiveMass
    """with the hoist, without the hook block"""
    gauge: Annotated[PositiveLength | None, OneOf("bridge.span")] = None
    """from its rail A to its rail B; of a travelling trolley"""
    nearest: Annotated[SignedSpan | None, OneOf("hook")] = None
    """minimum distance of the hook from rail A, below 0 on a cantilever; of a trolley on a bridge"""
    farthest: Annotated[SignedSpan | None, Absent("the trolley approaches rail B as closely as rail A")] = None
    """maximum distance of the hook from rail A; default: symmetric to `nearest`"""
    hook: Annotated[
        PositiveLength | None, Absent("the rope suspension point is in the middle, as on most trolleys")
    ] = None
    """distance of the hook of a travelling trolley from its rail A; default: middle"""
    height: Annotated[Span | None, Assumed()] = None
    """of its centre of gravity above the wheels' rails"""


class Wind(Fragment):
    """The wind along the rails."""

    area: WindArea
    """wind area of the travelling parts, without the load"""
    load_area: Annotated[WindArea | None, Assumed()] = None
    """of the load"""
    shape: Annotated[
        PositiveRatio, Assumed(1.6, 1.2, 2.0, "EN 13001-2: 1.2 for tubes, 1.6 to 2 for plate and box girders")
    ] = 1.6
    """force coefficient of the area"""
    load_shape: Annotated[PositiveRatio, Assumed(1.2, 1.1, 2.4, "EN 13001-2: 1.2 for loads, 2.4 when unknown")] = 1.2
    """force coefficient of the load"""
    height: Annotated[Span | None, Absent("the wind acts at the centre of gravity, near the centre of the area")] = None
    """height of the centre of the wind area above the rails; default: that of the centre of gravity"""
    pressure: PositivePressure
    """in-service pressure for starts, travel and stops"""
    pressure_max: Annotated[PositivePressure | None, Assumed()] = None
    """maximum in-service pressure; `pressure` when left out"""
    pressure_storm: Annotated[PositivePressure | None, Absent("without it there is no scene `storm`")] = None
    """out-of-service pressure; needed for a `storm`"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The pressures rise."""
        steady, most, storm = (given.number(key) for key in ("pressure", "pressure_max", "pressure_storm"))
        if steady is not None and most is not None and most < steady:
            yield Conflict(("pressure_max",), "it is below the in-service `pressure`", "swap them")
        if most is not None and storm is not None and storm < most:
            yield Conflict(("pressure_storm",), "it is below the maximum in-service pressure", "swap them")


class Parking(Fragment):
    """Holding devices other than the brakes, out of service."""

    force: PositiveForce
    """of rail clamps, pins or storm anchors"""


class TravelChecks(CheckSettings):
    """Limits of the checks of a travelling crane."""

    start_time: Annotated[PositiveTime, Limit()] = 15.0
    """maximum starting time"""
    brake_time: Annotated[PositiveTime, Limit()] = 15.0
    """maximum stopping time"""
    brake_distance: Annotated[PositiveSpan | None, Limit()] = None
    """maximum stopping distance; needed to check it"""
    sway_angle: Annotated[PositiveAngle, Limit()] = 0.174532925199433
    """maximum sway angle of the load, 10 deg when left out"""
    residual_sway: Annotated[PositiveAngle | None, Limit()] = None
    """maximum residual sway angle after the start or stop; needed to check it"""
    skid_reserve: Annotated[PositiveRatio, Limit()] = 1.2
    """minimum adhesion of a driven or braked wheel / required force"""
    motor_reserve: Annotated[PositiveRatio, Limit()] = 1.1
    """minimum starting torque / steady travel torque against the wind"""
    wind_reserve: Annotated[PositiveRatio, Limit()] = 1.1
    """minimum holding force / out-of-service wind force"""
    stability: Annotated[PositiveRatio, Limit()] = 1.0
    """minimum stabilising moment / tipping moment, both with partial factors"""
    collision_speed: Annotated[PositiveSpeed | None, Limit()] = None
    """maximum buffer impact speed; default: that of the buffer"""


class Travelling(MachineSpec):
    """A travelling crane: a bridge or gantry with its trolley on a runway, or a trolley on its bridge."""

    kind: Literal["crane"]
    type: Literal["travelling"]
    travels: Literal["bridge", "gantry", "trolley"] = "bridge"
    """travelling part described by the file"""
    load: PositiveMass
    """rated load on the hook"""
    hook_block: Annotated[Mass | None, Assumed()] = None
    """hook block and permanent load handling devices"""
    bridge: Bridge | None = None
    """travelling parts other than the trolley; of a bridge or gantry"""
    trolley: Trolley
    """the trolley"""
    wheels: Wheels
    """travel wheels"""
    rolling: Rolling
    """rolling resistance of the wheels"""
    rail: Rail = Rail()
    """runway rail"""
    guide: Guide | None = None
    """lateral guides; needed for a `skew`"""
    runway: Actions | None = None
    """actions on the runway beams; needed for a `runway`"""
    wind: Wind | None = None
    """wind, for outdoor cranes"""
    speed: PositiveSpeed
    """of travel"""
    drive: TravelDrive
    """motors, gear, brakes"""
    suspension: Suspension
    """suspension of the load"""
    buffers: Buffer | None = None
    """at the ends; needed for a `collision`"""
    parking: Parking | None = None
    """holding devices other than the brakes, out of service"""
    classes: Classes = Field(default=Classes(), alias="class")
    """classification of the crane"""
    declared: Declared = Declared()
    """declared dynamic factors of the structure"""
    duty: Duty | None = None
    """duty; needed to check the motor heating and the class"""
    checks: TravelChecks = TravelChecks()
    """limits, and checks switched off by code"""
    scenes: Annotated[tuple[AnyScene, ...], Field(min_length=1, max_length=50)] | None = None
    """load cases; default: steady travel, a start and a stop, loaded and empty, and scenes for which the
    file gives data: hoisting while travelling, a collision with the buffers, a step of the rail, skewing,
    a storm, actions on the runway"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The bridge is there where it travels; the trolley stays on it; scenes have what they need."""
        yield from super().conflicts(given)
        yield from _parts(given)
        yield from _reach(given)
        yield from _scenes_that_lack(given)

    @property
    def all_scenes(self) -> Sequence[TravelScene]:
        if self.scenes is not None:
            return self.scenes
        scenes: list[TravelScene] = [Run(), Start(), Start(load="empty"), Brake(), Brake(load="empty")]
        if self.suspension.hoist_speed is not None:
            scenes.append(HoistWhileTravelling())
        if self.buffers is not None:
            scenes.append(Collision())
        if self.rail.step or self.rail.gap:
            scenes.append(RailStep())
        if self.guide is not None and self.bridge is not None:
            scenes.append(Skew())
        if self.wind is not None and self.wind.pressure_storm is not None:
            scenes.append(Storm())
        if self.runway is not None:
            scenes.append(Runway())
        return scenes

    @property
    def settings(self) -> TravelChecks:
        return self.checks

    @property
    def gauge(self) -> float:
        """From rail A to rail B of what travels [m]."""
        width = self.bridge.span if self.bridge is not None else self.trolley.gauge
        assert width is not None
        return width


def _parts(given: Given) -> Iterator[Conflict]:
    """A bridge or gantry has a bridge, and a trolley with a reach on it; a trolley alone has a gauge."""
    what, trolley = given.word("travels"), given.block("trolley")
    if what is None:
        return
    if what == "trolley":
        if "bridge" in given:
            yield Conflict(("bridge",), "the trolley travels and the bridge is stationary", "delete `bridge`")
        if "runway" in given:
            reason = "the actions on a runway are those of a bridge or gantry"
            yield Conflict(("runway",), reason, "delete `runway`, or describe the bridge and write `travels: bridge`")
        if trolley is not None and trolley.raw:
            if "gauge" not in trolley:
                yield Conflict(("trolley",), "a travelling trolley needs its `gauge`", "add `gauge: 2 m`")
            for key in ("nearest", "farthest"):
                if key in trolley:
                    reason = "it is a key of a trolley on a travelling bridge"
                    yield Conflict(("trolley", key), reason, f"delete `{key}`, or write `travels: bridge`")
        return
    if "bridge" not in given:
        yield given.missing("bridge", f"a travelling {what} needs its `bridge`")
    if trolley is not None and trolley.raw:
        if "nearest" not in trolley:
            reason = "the minimum hook distance from rail A is missing"
            yield Conflict(("trolley",), reason, "add `nearest: 1 m`")
        if "hook" in trolley:
            reason = "the hook position is that of the trolley on its bridge"
            yield Conflict(("trolley", "hook"), reason, "delete `hook`")


def _reach(given: Given) -> Iterator[Conflict]:
    """The hook stays between the rails unless a gantry has a cantilever; a centre of gravity too."""
    bridge, trolley = given.block("bridge"), given.block("trolley")
    if trolley is None:
        return
    near, far = trolley.number("nearest"), trolley.number("farthest")
    if near is not None and far is not None and far < near:
        yield Conflict(("trolley", "farthest"), "it is closer to rail A than `nearest`", "swap them")
    if bridge is not None and (span := bridge.number("span")) is not None:
        least, most = -(bridge.number("cantilever_a") or 0.0), span + (bridge.number("cantilever_b") or 0.0)
        for key, place in (("nearest", near), ("farthest", far)):
            if place is not None and key in trolley and not least <= place <= most:
                reason = f"the trolley is beyond the bridge, whose span is {units.show(span, units.SPAN)}"
                end = f"`{key}: {units.show(0.95 * span, units.SPAN, 3)}` or less" if place > most else f"`{key}: 1 m`"
                hint = f"write {end}, or correct the `span` (of a gantry, give its cantilevers)"
                yield Conflict(("trolley", key), reason, hint)
        if near is not None and "farthest" not in trolley and span / 2 < near <= span:
            reason = "it is beyond the middle of the bridge: the trolley limit on the other side is missing"
            far_hint = units.show(span - 0.05 * span, units.SPAN, 3)
            yield Conflict(("trolley", "nearest"), reason, f"write less, or add `farthest: {far_hint}`")
        centre = bridge.number("centre")
        if centre is not None and centre > span:
            reason = "the centre of gravity is beyond the bridge"
            yield Conflict(("bridge", "centre"), reason, "write less than the `span`, or correct that")
    hook, gauge = trolley.number("hook"), trolley.number("gauge")
    if hook is not None and gauge is not None and hook > gauge:
        yield Conflict(("trolley", "hook"), "the hook is beyond the rails", "write less than the `gauge`")


_NEEDED = {
    "collision": (("buffers",), "buffers: {type: linear, count: 2, stiffness: 400 kN/m, stroke: 150 mm}"),
    "storm": (("wind", "pressure_storm"), "wind: {area: 60 m^2, pressure: 150 Pa, pressure_storm: 800 Pa}"),
    "hoist_while_travelling": (("suspension", "hoist_speed"), "hoist_speed: 0.1 m/s"),
    "skew": (("guide",), "guide: {type: flanges, clearance: 20 mm}"),
    "runway": (("runway",), "runway: {edition: EN 1991-3:2006}"),
}


def _scenes_that_lack(given: Given) -> Iterator[Conflict]:
    """What runs onto buffers has some, what is hoisted has a speed and a rope left; a brake that is used is there."""
    drive, suspension = given.block("drive"), given.block("suspension")
    rail = given.block("rail")
    for index, scene in enumerate(given.blocks("scenes")):
        what = scene.raw.get("type") if scene else None
        if scene is None or not isinstance(what, str):
            continue
        if what in _NEEDED:
            path, example = _NEEDED[what]
            block = given.block(path[0])
            there = path[0] in given and (len(path) == 1 or (block is not None and path[1] in block))
            if not there:
                yield Conflict(("scenes", index), f"a `{what}` needs `{'.'.join(path)}`", f"add `{example}`")
        if what == "skew" and given.word("travels") == "trolley":
            yield Conflict(("scenes", index), "skewing of a trolley is not computed", "delete this scene")
        for key in ("load", "trolley"):
            if what == "runway" and key in scene:
                reason = "the actions are those of the loaded and the unloaded crane in the worst trolley positions"
                yield Conflict(("scenes", index, what, key), reason, f"delete `{key}`")
        if what == "rail_step" and rail is not None and not rail.number("step") and not rail.number("gap"):
            yield Conflict(("scenes", index), "the rail has neither `step` nor `gap`", "add `rail: {step: 1 mm}`")
        by_brake = what == "brake" and (scene.word("by") == "brake")
        if by_brake and drive is not None and drive.raw and "brake" not in drive:
            yield Conflict(("scenes", index), "the drive has no `brake`", "add `brake: {torque: 60 N*m}` to `drive`")
        if what == "hoist_while_travelling" and suspension is not None:
            speed, own = suspension.number("hoist_speed"), scene.number("length")
            length = own if own is not None else suspension.number("length")
            lasts = scene.number("time")
            if speed is None or length is None or lasts is None or scene.word("hoist") != "up":
                continue
            if speed * lasts >= length:
                reason = "the hook would be above the rope suspension point"
                longest = units.show(0.9 * length / speed, units.TIME, 2)
                yield Conflict(("scenes", index, what, "time"), reason, f"write `time: {longest}` or less")
