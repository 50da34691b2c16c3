"""How a designer writes a belt conveyor."""

import math
from collections.abc import Sequence
from typing import Annotated, ClassVar, Literal

from pydantic import Field, model_validator

from ptmcalc.base.units import RATIO
from ptmcalc.laws.sag import DEEPEST
from ptmcalc.spec.fields import (
    Efficiency,
    Force,
    Height,
    Inertia,
    LineMass,
    Mass,
    MassFlow,
    Measure,
    PositiveAngle,
    PositiveAngularSpeed,
    PositiveForce,
    PositiveInertia,
    PositiveLength,
    PositiveLineForce,
    PositiveLineMass,
    PositiveLineStiffness,
    PositiveRatio,
    PositiveSpan,
    PositiveSpeed,
    PositiveTime,
    PositiveTorque,
    problem,
)
from ptmcalc.spec.machine import CheckSettings, MachineSpec
from ptmcalc.spec.scene import Fragment, Scene

RatioFromOne = Annotated[float, Measure(RATIO, at_least=1)]


def exactly_one(part: Fragment, *keys: str) -> None:
    """Refuses a fragment that gives none or more than one of alternative keys."""
    given = [key for key in keys if getattr(part, key) is not None]
    if len(given) == 1:
        return
    choice = " or ".join(f"`{key}`" for key in keys)
    if given:
        raise problem("SPC113", f"give {choice}, not both: they say the same thing", f"delete `{given[-1]}`")
    raise problem("SPC113", f"give {choice}", f"add `{keys[0]}: ...`")


class Route(Fragment):
    """Where the belt runs: from the tail drum to the drive drum at the head."""

    length: PositiveSpan
    """distance between tail and drive drum, along the belt"""
    lift: Height = 0.0
    """height the load is raised by; negative when it is lowered"""
    inclination: Literal["exact", "small_angle"] = "exact"
    """`small_angle` sets the cosine of the slope to 1, as ISO 5048 allows below 18 degrees"""

    @model_validator(mode="after")
    def _lift_fits(self) -> "Route":
        if abs(self.lift) >= self.length:
            raise problem("SPC113", "the lift is not smaller than the length along the belt", "check both values")
        return self


class Belt(Fragment):
    """The belt itself."""

    mass: PositiveLineMass
    """mass per length of the bare belt"""
    width: PositiveLength | None = None
    """belt width; needed with `modulus` or `strength`"""
    stiffness: PositiveForce | None = None
    """tensile stiffness EA of the whole belt, or give `modulus` and `width`"""
    modulus: PositiveLineStiffness | None = None
    """tensile modulus per width, e.g. `72000 N/mm`"""
    breaking_force: PositiveForce | None = None
    """breaking force of the whole belt, or give `strength` and `width`"""
    strength: PositiveLineForce | None = None
    """rated strength per width, e.g. `1600 N/mm` for an ST 1600"""
    carcass: Literal["textile", "steel_cord"] | None = None
    """what carries the tension; chooses the default safety factors"""

    @model_validator(mode="after")
    def _one_of_each(self) -> "Belt":
        exactly_one(self, "stiffness", "modulus")
        if self.breaking_force is not None and self.strength is not None:
            exactly_one(self, "breaking_force", "strength")
        for key in ("modulus", "strength"):
            if getattr(self, key) is not None and self.width is None:
                raise problem("SPC113", f"`{key}` is per width: `width` is missing", "add `width: 1200 mm`")
        return self


class IdlerRow(Fragment):
    """The idlers of one strand."""

    pitch: PositiveLength | None = None
    """distance of the idler sets; needed for sag and with `set_mass`"""
    set_mass: Mass | None = None
    """rotating mass of one idler set, reduced to the rim"""
    line_mass: LineMass | None = None
    """rotating mass per length, or give `set_mass` and `pitch`"""

    @model_validator(mode="after")
    def _one_mass(self) -> "IdlerRow":
        exactly_one(self, "set_mass", "line_mass")
        if self.set_mass is not None and self.pitch is None:
            raise problem("SPC113", "`set_mass` is per idler set: `pitch` is missing", "add `pitch: 1200 mm`")
        return self

    @property
    def rotating_line_mass(self) -> float:
        """Rotating mass per length [kg/m]."""
        if self.line_mass is not None:
            return self.line_mass
        assert self.set_mass is not None
        assert self.pitch is not None
        return self.set_mass / self.pitch


class Idlers(Fragment):
    """Idlers of both strands."""

    carry: IdlerRow
    """under the carry strand"""
    back: IdlerRow = Field(alias="return")
    """under the return strand"""


class Load(Fragment):
    """What is conveyed."""

    mass: PositiveLineMass | None = None
    """load per length of the carry strand, or give `capacity`"""
    capacity: MassFlow | None = None
    """mass flow; the load per length is capacity over belt speed"""

    @model_validator(mode="after")
    def _one_mass(self) -> "Load":
        exactly_one(self, "mass", "capacity")
        return self


class Resistance(Fragment):
    """Resistance to motion (ISO 5048, DIN 22101)."""

    coefficient: PositiveRatio | None = None
    """fictitious friction coefficient f of the whole conveyor; 0.020 is assumed when it is left out"""
    secondary: RatioFromOne | None = None
    """length factor C: all resistances over the main ones; from the table C(L) when left out, from 80 m on"""
    secondary_force: Force | None = None
    """secondary resistances as a force at the loading point, instead of `secondary`"""
    start_factor: RatioFromOne | None = None
    """resistance at the start over resistance in motion; 1.2 is assumed when it is left out"""

    @model_validator(mode="after")
    def _one_secondary(self) -> "Resistance":
        if self.secondary is not None and self.secondary_force is not None:
            exactly_one(self, "secondary", "secondary_force")
        return self


class Motor(Fragment):
    """The drive motors, one of several equal ones."""

    count: Annotated[int, Field(ge=1, le=64, strict=True)] = 1
    """number of equal motors on the drive drum"""
    inertia: PositiveInertia
    """rotor of one motor"""
    speed: PositiveAngularSpeed | None = None
    """rated speed; compared with belt speed, ratio and drum"""
    mean_starting_torque: PositiveTorque | None = None
    """mean starting torque of one motor, or give the largest and the smallest"""
    largest_starting_torque: PositiveTorque | None = None
    """torque after each step of a rheostat start, one motor"""
    smallest_starting_torque: PositiveTorque | None = None
    """torque before each step of a rheostat start, one motor"""

    @model_validator(mode="after")
    def _torque(self) -> "Motor":
        exactly_one(self, "mean_starting_torque", "largest_starting_torque")
        if (self.largest_starting_torque is None) != (self.smallest_starting_torque is None):
            raise problem(
                "SPC113",
                "`largest_starting_torque` and `smallest_starting_torque` go together",
                "give both, or `mean_starting_torque` alone",
            )
        if (self.smallest_starting_torque or 0.0) > (self.largest_starting_torque or math.inf):
            raise problem("SPC113", "the smallest starting torque is above the largest", "swap them")
        return self


class Gear(Fragment):
    """The gear between motor and drum."""

    ratio: PositiveRatio
    """motor speed over drum speed"""
    efficiency: Efficiency | None = None
    """from motor to drum; 0.94 is assumed when it is left out"""


class DriveDrum(Fragment):
    """The driven drum."""

    diameter: PositiveLength
    """of the drum with its lagging"""
    wrap: PositiveAngle
    """wrap angle of the belt"""
    friction: PositiveRatio | None = None
    """friction coefficient between belt and drum; without it slip cannot be checked"""
    inertia: Inertia | None = None
    """of the drum on its own shaft; assumed 0 when left out"""


class Drive(Fragment):
    """Motors, gear and drum at the head."""

    motor: Motor
    """the motors"""
    coupling_inertia: Inertia | None = None
    """coupling and brake disc of one motor, on the motor shaft; 15 % of the rotor is assumed when left out"""
    gear: Gear
    """the gear"""
    drum: DriveDrum
    """the drive drum"""


class TakeUp(Fragment):
    """What keeps the belt taut."""

    type: Literal["gravity", "rigid"]
    """`gravity`: a weight beside the drive keeps the run-off tension; `rigid`: a screw or locked winch"""
    tension: PositiveForce
    """belt tension: at the run-off (gravity), or the mean round the loop when it was set (rigid)"""


class TailDrum(Fragment):
    """The drum at the tail."""

    inertia: Inertia | None = None
    """on its own shaft; assumed 0 when left out"""
    diameter: PositiveLength | None = None
    """the drive drum's when left out"""


class SlipLimit(Fragment):
    """How much grip must be left at the drum."""

    reserve: RatioFromOne = 1.2
    """reserve of friction force k_T; 1.1 to 1.5 in practice"""
    definition: Literal["force", "ratio"] = "force"
    """`force` puts the reserve on the friction force, `ratio` on the ratio of the tensions (stricter)"""


class ConveyorChecks(CheckSettings):
    """Limits of the checks of a conveyor."""

    slip: SlipLimit = SlipLimit()
    """grip at the drive drum"""
    belt_safety_running: PositiveRatio | None = None
    """breaking force over largest tension in steady running"""
    belt_safety_starting: PositiveRatio | None = None
    """breaking force over largest tension during a start"""
    sag: PositiveRatio = 0.01
    """largest sag of the belt over the idler pitch, in steady running"""
    slack_sag: PositiveRatio = DEEPEST
    """sag over idler pitch at which the belt counts as slack, in every scene"""


class Profile(Fragment):
    """How the drive comes up."""

    shape: Literal["step", "ramp", "cosine"] = "step"
    """`step` at once, `ramp` linear, `cosine` as (1 - cos)/2"""
    time: PositiveTime | None = None
    """duration of a ramp or cosine"""
    control: Literal["torque", "speed"] | None = None
    """what follows the profile; a step is of torque, ramp and cosine are of speed unless this says `torque`"""

    @model_validator(mode="after")
    def _complete(self) -> "Profile":
        if self.shape == "step":
            if self.time is not None:
                raise problem("SPC113", "a `step` has no `time`", "delete `time`, or write `shape: ramp`")
            if self.control == "speed":
                raise problem("SPC113", "a step of speed needs an infinite force", "write `shape: ramp` and a `time`")
        elif self.time is None:
            raise problem("SPC113", f"a `{self.shape}` needs its `time`", "add `time: 20 s`")
        return self

    @property
    def imposes_speed(self) -> bool:
        """Whether the speed follows the profile, not the torque."""
        return self.shape != "step" and self.control != "torque"


class ConveyorScene(Scene):
    """Base of the scenes of a conveyor."""

    load: Literal["full", "empty"] = "full"
    """whether the carry strand is loaded"""

    def default_name(self) -> str:
        return f"{self.type}_{'loaded' if self.load == 'full' else 'empty'}"


class Run(ConveyorScene):
    """Steady running at rated speed."""

    type: Literal["run"] = "run"


class Start(ConveyorScene):
    """A start from rest, with the friction of the running belt frozen in it."""

    type: Literal["start"] = "start"
    profile: Profile = Profile()
    """how the drive comes up; a torque step when left out"""


AnyScene = Annotated[Run | Start, Field(discriminator="type")]


class Conveyor(MachineSpec):
    """A belt conveyor with one drive drum at the head."""

    kind: Literal["conveyor"]
    route: Route
    """where the belt runs"""
    belt: Belt
    """the belt"""
    idlers: Idlers
    """the idlers"""
    load: Load
    """what is conveyed"""
    resistance: Resistance = Resistance()
    """resistance to motion"""
    speed: PositiveSpeed
    """belt speed"""
    drive: Drive
    """motors, gear and drum"""
    takeup: TakeUp
    """the take-up"""
    tail_drum: TailDrum = TailDrum()
    """the tail drum"""
    checks: ConveyorChecks = ConveyorChecks()
    """limits, and checks switched off by code"""
    scenes: Annotated[tuple[AnyScene, ...], Field(min_length=1, max_length=50)] | None = None
    """what happens to the machine; a loaded run, a loaded start and an empty start when left out"""

    DEFAULT_SCENES: ClassVar[tuple[Run | Start, ...]] = (Run(), Start(), Start(load="empty"))

    @property
    def all_scenes(self) -> Sequence[Run | Start]:
        return self.scenes or self.DEFAULT_SCENES

    @property
    def settings(self) -> ConveyorChecks:
        return self.checks

    @model_validator(mode="after")
    def _secondary_resistance_known(self) -> "Conveyor":
        if self.route.length < 80 and self.resistance.secondary is None and self.resistance.secondary_force is None:
            raise problem(
                "SPC113",
                "below 80 m the table of C(L) does not apply: the secondary resistances must be given",
                "add `secondary_force: 1 kN` or `secondary: 2.5` under `resistance`",
            )
        return self
