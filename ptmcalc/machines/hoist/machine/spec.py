"""How a designer writes a hoist: from the load over the tackle and the drum to the motor and its brake."""

from collections.abc import Iterator, Sequence
from typing import Annotated, Literal

from pydantic import Field

from ptmcalc.base import units
from ptmcalc.base.memory import kept_for
from ptmcalc.components.duty_motor import DutyMotor
from ptmcalc.components.start import Profile
from ptmcalc.machines.hoist.machine.keys.drive import Brake, Classes, Duty, Gearbox
from ptmcalc.machines.hoist.machine.keys.rope import Fleet, RopeLife, RopeProof
from ptmcalc.machines.hoist.machine.keys.tackle import (
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
    """Speeds of the hoist."""

    main: Annotated[PositiveSpeed | None, OneOf("drum")] = None
    """of the hook with the rope on the first layer, or give `drum`"""
    drum: Annotated[PositiveAngularSpeed | None, OneOf("main")] = None
    """of the drum"""
    creep: Annotated[PositiveSpeed | None, Absent("the hoist has one speed")] = None
    """creep speed of the hook, on the first layer"""

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
    """breaking force / maximum static rope force (Zp); default: by the mechanism group"""
    drum_ratio: Annotated[PositiveRatio | None, Limit()] = None
    """drum ratio (D + d)/d (h1), to the rope centre; default: by the group"""
    sheave_ratio: Annotated[PositiveRatio | None, Limit()] = None
    """sheave ratio (D + d)/d (h2), to the rope centre; default: by the group"""
    equaliser_ratio: Annotated[PositiveRatio | None, Limit()] = None
    """equalising sheave ratio (D + d)/d (h3); default: by the group"""
    drum_slenderness: Annotated[PositiveRatio, Limit()] = 5.0
    """maximum wound length / drum diameter"""
    layers: Annotated[Annotated[int, Field(ge=1, strict=True)] | None, Limit()] = None
    """maximum number of rope layers; default: those of the drum, one in the groups M7 and M8"""
    dead_wraps: Annotated[PositiveRatio, Limit()] = 2.0
    """minimum number of dead wraps"""
    flange_margin: Annotated[PositiveRatio, Limit()] = 1.5
    """minimum flange height above the top layer, in rope diameters"""
    fleet_angle: Annotated[PositiveAngle | None, Limit()] = None
    """maximum fleet angle at the drum; default: 4 deg, or 2 deg for a rotation-resistant rope"""
    layer_factor: Annotated[PositiveRatio | None, Limit()] = None
    """hoop stress of all layers / hoop stress of the first layer; default: 1 for one layer, 1.75 for two"""
    hoop_stress: Annotated[PositiveStress | None, Limit()] = None
    """permissible hoop stress of the drum shell; needed to check it"""
    motor_reserve: Annotated[PositiveRatio, Limit()] = 1.4
    """minimum mean starting torque / static hoisting torque"""
    motor_excess: Annotated[PositiveRatio, Limit()] = 4.0
    """maximum mean starting torque / static hoisting torque"""
    lift_off_factor: Annotated[PositiveRatio | None, Limit()] = None
    """maximum rope force / weight at lift-off; default: phi2 of the hoisting class"""
    lowering_factor: Annotated[PositiveRatio | None, Limit()] = None
    """maximum rope force / weight in a stop or a start; needed to check it"""
    stop_distance: Annotated[PositiveSpan | None, Limit()] = None
    """maximum stopping distance of a lowered load; only a stop is required when left out"""
    rope_share: Annotated[Fraction, Limit()] = 0.05
    """minimum rope force / weight of a suspended load, to keep the rope in its grooves"""
    gear_impact: Annotated[PositiveRatio, Limit()] = 3.0
    """maximum gear torque / gear torque of steady motion"""
    brake_reserve: Annotated[PositiveRatio | None, Limit()] = None
    """minimum brake torque / torque of the lowered load; default: by the group"""
    overspeed: Annotated[PositiveRatio, Limit()] = 1.2
    """maximum motor speed / rated speed, lowering on the curve or in an emergency stop (IEC 60034-1: 1.2 for 2 min, to
    be compared with the standard and the data sheet)"""
    winding_stress_ratio: Annotated[PositiveRatio, Limit()] = 0.1
    """maximum dynamic / mean rope stress of a layer change"""
    crossover_detuning: Annotated[PositiveRatio, Limit()] = 0.2
    """minimum separation of the crossover frequency from resonance with the load, relative to its frequency"""


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
    """Hoisting and lowering at constant speed."""

    type: Literal["run"] = "run"


class Lift(HoistScene, TransientScene):
    """Lift-off of a grounded load."""

    type: Literal["lift"] = "lift"
    rope: Literal["slack", "taut"] = "slack"
    """initial state: slack rope, or taut rope without force"""
    slack: Annotated[PositiveLength | None, Setting("slack sufficient for full drive speed: the worst case")] = None
    """slack travel of the hook; default: sufficient for full drive speed"""
    speed: Literal["main", "creep"] = "main"
    """of the hoist"""
    profile: Profile = Profile()
    """how the drive starts; a torque step when left out"""


class Start(HoistScene, TransientScene):
    """A start of a suspended load."""

    type: Literal["start"] = "start"
    direction: Literal["up", "down"] = "up"
    """of the load"""
    profile: Profile = Profile()
    """how the drive starts; a torque step when left out"""


class Stop(HoistScene, TransientScene):
    """A stop of a moving load by the brake."""

    type: Literal["stop"] = "stop"
    direction: Literal["up", "down"] = "up"
    """of the load"""
    speed: Literal["main", "creep"] = "main"
    """before the stop"""


class LowerBrake(HoistScene, TransientScene):
    """A lowered load is braked to standstill."""

    type: Literal["lower_brake"] = "lower_brake"
    speed: Literal["main", "creep"] = "main"
    """before the stop"""


class EmergencyStop(HoistScene):
    """The motor loses its power or is switched off while the hook moves, and the brake stops the drive."""

    type: Literal["emergency_stop"] = "emergency_stop"
    direction: Literal["up", "down"] = "down"
    """of the load"""
    speed: Literal["main", "creep"] = "main"
    """before the stop"""
    motor_speed: Annotated[PositiveAngularSpeed | None, Setting("the speed of the steady motion before the stop")] = (
        None
    )
    """of the motor shaft when the power is lost, such as the trip speed of an overspeed switch; default: that of
    the motor on its `curve`, without one that of `speed`"""


class Release(HoistScene, TransientScene):
    """Sudden release of a part of the suspended load: grab, magnet, cut sling."""

    type: Literal["release"] = "release"
    share: Annotated[Fraction, Setting("the full load: the worst case")] = 1.0
    """released part of the rated load"""
    manner: Literal["quick", "slow"] = "quick"
    """type of release: by a magnet, or by a grab"""


class WindUp(HoistScene, TransientScene):
    """A layer change of the rope at constant drum speed."""

    type: Literal["winding"] = "winding"
    layer: Annotated[
        int, Field(ge=2, le=20, strict=True), Setting("the first layer change, the largest relative step")
    ] = 2
    """the layer after the change"""


AnyScene = Annotated[
    Run | Lift | Start | Stop | LowerBrake | EmergencyStop | Release | WindUp, Field(discriminator="type")
]


CREEPING = ("HD2", "HD3")
"""Drive classes whose load is lifted off the ground at the creep speed (EN 13001-2, regular loads)."""


class Hoist(MachineSpec):
    """A rope hoist: hook block, reeving, drum, gearbox, motor and brake."""

    kind: Literal["hoist"]
    load: PositiveMass
    """rated load on the hook"""
    hook_block: Annotated[Mass, Absent("included in the rated load, or stated here")] = 0.0
    """hook block and permanent load handling devices"""
    height: PositiveSpan
    """lifting height"""
    least_fall: Annotated[float, Measure(units.SPAN, at_least=0), Absent("the shortest rope is the stiffest")] = 0.0
    """length of a fall with the hook at its highest"""
    speed: Speeds
    """of hook or drum"""
    reeving: Reeving
    """reeving"""
    rope: Rope
    """the wire rope"""
    rope_life: RopeLife | None = None
    """number of bendings of the rope until discard; needed to check its life"""
    rope_proof: RopeProof | None = None
    """proof of competence of the rope by EN 13001-3-2"""
    fleet: Fleet | None = None
    """limits of the fleet angles at the top hook position and at the flanges"""
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
    """supporting structure; rigid when left out"""
    classes: Classes = Field(default=Classes(), alias="class")
    """classification of the hoist"""
    duty: Duty | None = None
    """duty; needed to check the motor heating and starts"""
    checks: HoistChecks = HoistChecks()
    """limits, and checks switched off by code"""
    scenes: Annotated[tuple[AnyScene, ...], Field(min_length=1, max_length=50)] | None = None
    """load cases; default: a loaded run, with a complete drive also a lift-off and a stop of a lowered load; with data
    of the heat of the brake also an emergency stop of a lowered load"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The rope fits the drum; scenes have what they need."""
        yield from super().conflicts(given)
        drum, rope, winding = (given.block(key) for key in ("drum", "rope", "winding"))
        if drum is not None and rope is not None:
            nested = winding is None or winding.word("packing") != "square"
            yield from layers_that_do_not_fit(drum, rope, nested)
        yield from _rope_too_thin(given, rope)
        yield from _scenes_that_lack(given)

    @property
    def all_scenes(self) -> Sequence[HoistScene]:
        if self.scenes is not None:
            return _followed(self, self.scenes)
        if self.motor is None or self.gearbox is None or self.brake is None:
            return (Run(),)
        creeps = self.speed.creep is not None and self.classes.drive in CREEPING
        usual = (Run(), Lift(speed="creep" if creeps else "main"), LowerBrake())
        return _followed(self, (*usual, EmergencyStop()) if self.brake.heats else usual)

    @property
    def settings(self) -> HoistChecks:
        return self.checks


_THINNEST = 3e-3
"""Diameter of the thinnest rope with a number of bendings [m]. An engineering choice: the factor of the diameter grows
without limit towards 1.4 mm."""


def _rope_too_thin(given: Given, rope: Given | None) -> Iterator[Conflict]:
    """The number of bendings is that of ropes, not of single wires."""
    d = rope.number("diameter") if rope is not None else None
    if "rope_life" in given and d is not None and d < _THINNEST:
        reason = f"the number of bendings is valid from {units.show(_THINNEST, units.LENGTH)}"
        yield Conflict(("rope", "diameter"), reason, "correct the diameter, or delete `rope_life`")


@kept_for(64)
def _followed(spec: Hoist, scenes: tuple[HoistScene, ...]) -> tuple[HoistScene, ...]:
    """Scenes whose lifts and starts follow the curve of the motor, where the file gives one."""
    curve = spec.motor is not None and spec.motor.curve is not None
    return tuple(
        one.model_copy(update={"profile": one.profile.followed(curve)}) if isinstance(one, Lift | Start) else one
        for one in scenes
    )


_DRIVEN = ("lift", "start", "stop", "lower_brake", "emergency_stop")
_BRAKED = ("stop", "lower_brake", "emergency_stop")


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
