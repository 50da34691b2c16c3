"""How a designer writes a hoist: from the load over the tackle and the drum to the motor and its brake."""

from collections.abc import Iterator, Sequence
from typing import Annotated, Literal

from pydantic import Field

from ptmcalc.base import units
from ptmcalc.base.memory import kept_for
from ptmcalc.components.duty_motor import DutyMotor
from ptmcalc.components.start import Profile
from ptmcalc.machines.hoist.keys.drive import Brake, Classes, Duty, Gearbox
from ptmcalc.machines.hoist.keys.tackle import (
    Drum,
    Limiter,
    Reeving,
    Rope,
    Structure,
    Winding,
    layers_that_do_not_fit,
)
from ptmcalc.spec.fields import (
    Fraction,
    Mass,
    Measure,
    PositiveAngle,
    PositiveAngularSpeed,
    PositiveLength,
    PositiveMass,
    PositiveRatio,
    PositiveSpan,
    PositiveSpeed,
    PositiveStress,
    Span,
)
from ptmcalc.spec.fragment import Conflict, Fragment, Given, exactly_one
from ptmcalc.spec.machine import CheckSettings, MachineSpec
from ptmcalc.spec.optional import Absent, Limit, OneOf, Setting
from ptmcalc.spec.scene import Scene, TransientScene


class Speeds(Fragment):
    """How fast the hoist runs."""

    main: Annotated[PositiveSpeed | None, OneOf("drum")] = None
    """of the hook with the rope on the first layer, or give `drum`"""
    drum: Annotated[PositiveAngularSpeed | None, OneOf("main")] = None
    """of the drum"""
    creep: Annotated[PositiveSpeed | None, Absent("the hoist has one speed")] = None
    """slow speed of the hook, on the first layer"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The speed is given in one way; creeping is slower."""
        yield from exactly_one(given, "main", "drum")
        main, creep = given.number("main"), given.number("creep")
        if main is not None and creep is not None and creep >= main:
            yield Conflict(("creep",), "the creep speed is not below the main one", "swap them")


class HoistChecks(CheckSettings):
    """Limits of the checks of a hoist; None stands for the limit of its class."""

    rope_safety: Annotated[PositiveRatio | None, Limit()] = None
    """breaking force over the largest static pull (Zp); by the group of the mechanism when left out"""
    drum_ratio: Annotated[PositiveRatio | None, Limit()] = None
    """drum diameter over rope diameter (h1), to the middle of the rope; by the group when left out"""
    sheave_ratio: Annotated[PositiveRatio | None, Limit()] = None
    """sheave diameter over rope diameter (h2), to the middle of the rope; by the group when left out"""
    equaliser_ratio: Annotated[PositiveRatio | None, Limit()] = None
    """equalising sheave diameter over rope diameter (h3); by the group when left out"""
    drum_slenderness: Annotated[PositiveRatio, Limit()] = 5.0
    """largest length of the wound parts over the diameter of the drum"""
    layers: Annotated[Annotated[int, Field(ge=1, strict=True)] | None, Limit()] = None
    """most layers of rope; those of the drum, in the groups M7 and M8 one, when left out"""
    dead_wraps: Annotated[PositiveRatio, Limit()] = 2.0
    """fewest turns that stay on the drum"""
    flange_margin: Annotated[PositiveRatio, Limit()] = 1.5
    """least height of the flanges over the last layer, in rope diameters"""
    fleet_angle: Annotated[PositiveAngle | None, Limit()] = None
    """largest angle of the rope at the drum; 4 deg, or 2 deg for a rotation-resistant rope, when left out"""
    layer_factor: Annotated[PositiveRatio | None, Limit()] = None
    """hoop stress of all layers over that of the first; 1 for one layer and 1.75 for two when left out"""
    hoop_stress: Annotated[PositiveStress | None, Limit()] = None
    """largest hoop stress of the drum shell; needed to check it"""
    motor_reserve: Annotated[PositiveRatio, Limit()] = 1.4
    """least mean starting torque over the static torque of hoisting"""
    motor_excess: Annotated[PositiveRatio, Limit()] = 4.0
    """largest mean starting torque over the static torque of hoisting"""
    lift_off_factor: Annotated[PositiveRatio | None, Limit()] = None
    """largest rope force over the weight as the load is lifted off; phi2 of the hoisting class when left out"""
    lowering_factor: Annotated[PositiveRatio | None, Limit()] = None
    """largest rope force over the weight in a stop or a start; needed to check it"""
    stop_distance: Annotated[PositiveSpan | None, Limit()] = None
    """maximum stopping distance of a lowered load; only a stop is required when left out"""
    rope_share: Annotated[Fraction, Limit()] = 0.05
    """least rope force over the weight while it hangs: what keeps the rope in its grooves"""
    gear_impact: Annotated[PositiveRatio, Limit()] = 3.0
    """largest torque of the gear over that of the even motion"""
    brake_reserve: Annotated[PositiveRatio | None, Limit()] = None
    """least brake torque over that of the lowering load; by the group when left out"""
    winding_stress_ratio: Annotated[PositiveRatio, Limit()] = 0.1
    """largest dynamic over mean stress of a rope that climbs to the next layer"""
    crossover_detuning: Annotated[PositiveRatio, Limit()] = 0.2
    """least distance of the crossovers of a layer from resonance with the load, as a share of its frequency"""


class HoistScene(Scene):
    """Base of the scenes of a hoist."""

    load: Literal["full", "empty"] = "full"
    """the rated load on the hook, or the hook block alone"""
    hook_height: Annotated[Span | None, Setting("the lowest position, at which loads are lifted and set down")] = None
    """of the hook above its lowest position; at the lowest when left out"""

    def default_name(self) -> str:
        way = "_down" if getattr(self, "direction", "up") == "down" else ""
        return f"{self.type}{way}_{'loaded' if self.load == 'full' else self.load}"


class Run(HoistScene):
    """Hoisting and lowering at an even speed."""

    type: Literal["run"] = "run"


class Lift(HoistScene, TransientScene):
    """A load is lifted off the ground."""

    type: Literal["lift"] = "lift"
    rope: Literal["slack", "taut"] = "slack"
    """whether the drive must take up slack rope first, or the rope is taut without force"""
    slack: Annotated[PositiveLength | None, Setting("slack sufficient for full drive speed: the worst case")] = None
    """travel of the hook before the rope is taut; enough for the drive to come to its speed when left out"""
    speed: Literal["main", "creep"] = "main"
    """of the hoist"""
    profile: Profile = Profile()
    """how the drive starts; a torque step when left out"""


class Start(HoistScene, TransientScene):
    """A hanging load is set in motion."""

    type: Literal["start"] = "start"
    direction: Literal["up", "down"] = "up"
    """of the load"""
    profile: Profile = Profile()
    """how the drive starts; a torque step when left out"""


class Stop(HoistScene, TransientScene):
    """A load in motion is stopped by the brake."""

    type: Literal["stop"] = "stop"
    direction: Literal["up", "down"] = "up"
    """of the load"""
    speed: Literal["main", "creep"] = "main"
    """before the stop"""


class LowerBrake(HoistScene, TransientScene):
    """A load that is lowered is braked to a halt."""

    type: Literal["lower_brake"] = "lower_brake"
    speed: Literal["main", "creep"] = "main"
    """before the stop"""


class Release(HoistScene, TransientScene):
    """A part of the hanging load comes off at once: a grab, a magnet, a cut sling."""

    type: Literal["release"] = "release"
    share: Annotated[Fraction, Setting("the full load: the worst case")] = 1.0
    """part of the rated load that comes off"""
    manner: Literal["quick", "slow"] = "quick"
    """how it comes off: by a magnet, or by a grab"""


class WindUp(HoistScene, TransientScene):
    """The rope climbs from a layer to the next one while the drum turns at constant speed."""

    type: Literal["winding"] = "winding"
    layer: Annotated[
        int, Field(ge=2, le=20, strict=True), Setting("the first layer change, the largest relative step")
    ] = 2
    """the layer it climbs to"""


AnyScene = Annotated[Run | Lift | Start | Stop | LowerBrake | Release | WindUp, Field(discriminator="type")]


CREEPING = ("HD2", "HD3")
"""Drive classes whose load is lifted off the ground at the creep speed (EN 13001-2, regular loads)."""


class Hoist(MachineSpec):
    """A rope hoist: a load on a hook block, a tackle, a drum, a gearbox, a motor and a brake."""

    kind: Literal["hoist"]
    load: PositiveMass
    """rated load on the hook"""
    hook_block: Annotated[Mass, Absent("included in the rated load, or stated here")] = 0.0
    """hook block and whatever stays on the hook"""
    height: PositiveSpan
    """lifting height"""
    least_fall: Annotated[float, Measure(units.SPAN, at_least=0), Absent("the shortest rope is the stiffest")] = 0.0
    """length of a fall with the hook at its highest"""
    speed: Speeds
    """of hook or drum"""
    reeving: Reeving
    """how the rope runs"""
    rope: Rope
    """the wire rope"""
    drum: Drum
    """the drum"""
    winding: Winding = Winding()
    """arrangement of the rope on the drum in several layers"""
    gearbox: Gearbox | None = None
    """between motor and drum; with `motor` needed for starts and stops"""
    motor: DutyMotor | None = None
    """the hoisting motors"""
    brake: Brake | None = None
    """the holding brake"""
    limiter: Limiter | None = None
    """the rated capacity limiter"""
    structure: Structure | None = None
    """what the hoist stands on; rigid when left out"""
    classes: Classes = Field(default=Classes(), alias="class")
    """what the hoist is classed as"""
    duty: Duty | None = None
    """what the hoist does all day; needed to check the motor's heating and starts"""
    checks: HoistChecks = HoistChecks()
    """limits, and checks switched off by code"""
    scenes: Annotated[tuple[AnyScene, ...], Field(min_length=1, max_length=50)] | None = None
    """what happens to the machine; a loaded run when left out, with a whole drive also a lift-off and a lowered load
    that is braked"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The rope fits the drum; scenes have what they need."""
        yield from super().conflicts(given)
        drum, rope, winding = (given.block(key) for key in ("drum", "rope", "winding"))
        if drum is not None and rope is not None:
            nested = winding is None or winding.word("packing") != "square"
            yield from layers_that_do_not_fit(drum, rope, nested)
        yield from _scenes_that_lack(given)

    @property
    def all_scenes(self) -> Sequence[HoistScene]:
        if self.scenes is not None:
            return _followed(self, self.scenes)
        if self.motor is None or self.gearbox is None or self.brake is None:
            return (Run(),)
        creeps = self.speed.creep is not None and self.classes.drive in CREEPING
        return _followed(self, (Run(), Lift(speed="creep" if creeps else "main"), LowerBrake()))

    @property
    def settings(self) -> HoistChecks:
        return self.checks


@kept_for(64)
def _followed(spec: Hoist, scenes: tuple[HoistScene, ...]) -> tuple[HoistScene, ...]:
    """Scenes whose lifts and starts follow the curve of the motor, where the file gives one."""
    curve = spec.motor is not None and spec.motor.curve is not None
    return tuple(
        one.model_copy(update={"profile": one.profile.followed(curve)}) if isinstance(one, Lift | Start) else one
        for one in scenes
    )


_DRIVEN = ("lift", "start", "stop", "lower_brake")
_BRAKED = ("stop", "lower_brake")


def _scenes_that_lack(given: Given) -> Iterator[Conflict]:
    """What moves the load needs motor and gearbox, what stops it a brake; the hook stays between its ends."""
    speeds, drum, motor = given.block("speed"), given.block("drum"), given.block("motor")
    height = given.number("height")
    for index, scene in enumerate(given.blocks("scenes")):
        what = scene.raw.get("type") if scene else None
        if scene is None or not isinstance(what, str):
            continue
        for key, wanted in (("motor", _DRIVEN), ("gearbox", _DRIVEN), ("brake", _BRAKED)):
            if what in wanted and key not in given:
                yield Conflict(("scenes", index), f"a `{what}` needs the `{key}`", _ADD[key])
        if "speed" in scene and scene.raw.get("speed") == "creep" and speeds is not None and "creep" not in speeds:
            hint = "add `creep: 0.02 m/s` to `speed`"
            yield Conflict(("scenes", index, what, "speed"), "the hoist has no creep speed", hint)
        hook = scene.number("hook_height")
        if hook is not None and height is not None and hook > height:
            reason = f"the lifting height is only {units.show(height, units.SPAN)}"
            yield Conflict(("scenes", index, what, "hook_height"), reason, "write less, or correct the `height`")
        if what == "winding" and drum is not None:
            layers, wanted = drum.raw.get("layers", 1), scene.raw.get("layer", 2)
            if isinstance(layers, int) and isinstance(wanted, int) and wanted > layers:
                reason = f"the rope never reaches layer {wanted}: the drum has {layers}"
                yield Conflict(("scenes", index), reason, f"write `layers: {wanted}` under `drum`")
        yield from _nothing_that_hangs(given, index, scene, what)
        profile = scene.raw.get("profile")
        if isinstance(profile, dict) and profile.get("shape") == "curve" and motor is not None and "curve" not in motor:
            hint = "add `curve: {type: induction, ...}` to the motor, or write `shape: step`"
            yield Conflict(("scenes", index, what, "profile", "shape"), "the motor has no `curve` to follow", hint)


def _nothing_that_hangs(given: Given, index: int, scene: Given, what: str) -> Iterator[Conflict]:
    """What moves on its rope has a mass, and rope to hang on."""
    if what != "run" and scene.word("load") == "empty" and not given.number("hook_block"):
        reason = "an empty hook without a mass cannot be simulated"
        yield Conflict(("scenes", index, what, "load"), reason, "add `hook_block: 90 kg`, or write `load: full`")
    reeving = given.block("reeving")
    hook, height = scene.number("hook_height"), given.number("height")
    spare = (given.number("least_fall") or 0.0) + ((reeving.number("lead_length") or 0.0) if reeving else 0.0)
    if hook is not None and hook == height and spare <= 0:
        reason = "the free rope length is zero at this hook height"
        yield Conflict(("scenes", index, what, "hook_height"), reason, "write less, or add `least_fall: 1 m`")


_ADD = {
    "motor": "add `motor: {inertia: 0.35 kg*m^2, speed: 965 rpm, mean_starting_torque: 300 N*m}`",
    "gearbox": "add `gearbox: {ratio: 40, efficiency: 0.94}`",
    "brake": "add `brake: {torque: 400 N*m, delay: 0.2 s}`",
}
