"""How a designer writes a belt conveyor."""

from collections.abc import Iterator, Sequence
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from ptmcalc.base.units import FACTOR
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
)
from ptmcalc.spec.fragment import Conflict, Fragment, Given, at_most_one, exactly_one, together
from ptmcalc.spec.machine import CheckSettings, MachineSpec
from ptmcalc.spec.scene import Scene

RatioFromOne = Annotated[float, Measure(FACTOR, at_least=1)]


class Route(Fragment):
    """Where the belt runs: from the tail drum to the drive drum at the head."""

    length: PositiveSpan
    """distance between tail and drive drum, along the belt"""
    lift: Height = 0.0
    """height the load is raised by; negative when it is lowered"""
    inclination: Literal["exact", "small_angle"] = "exact"
    """`small_angle` sets the cosine of the slope to 1, as ISO 5048 allows below 18 degrees"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The belt cannot rise further than it is long."""
        lift, length = given.number("lift"), given.number("length")
        if lift is not None and length is not None and abs(lift) >= length:
            yield Conflict(("lift",), "the lift is not smaller than the length along the belt", "check both values")


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

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Stiffness and strength are of the whole belt, or per width with the width."""
        yield from exactly_one(given, "stiffness", "modulus")
        yield from at_most_one(given, "breaking_force", "strength")
        per_width = " and ".join(f"`{key}`" for key in ("modulus", "strength") if key in given)
        if per_width and "width" not in given:
            yield given.missing("width", f"{per_width} per width: `width` is missing")


class IdlerRow(Fragment):
    """The idlers of one strand."""

    pitch: PositiveLength | None = None
    """distance of the idler sets; needed for sag and with `set_mass`"""
    set_mass: Mass | None = None
    """rotating mass of one idler set, reduced to the rim"""
    line_mass: LineMass | None = None
    """rotating mass per length, or give `set_mass` and `pitch`"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The mass is per length, or per set with the pitch."""
        yield from exactly_one(given, "set_mass", "line_mass")
        yield from together(given, "set_mass", "pitch", "`set_mass` is per idler set")

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

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The load is given in one way."""
        yield from exactly_one(given, "mass", "capacity")


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

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The secondary resistances are given in one way."""
        yield from at_most_one(given, "secondary", "secondary_force")


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

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The starting torque is a mean one, or swings between a largest and a smallest."""
        mean, largest, smallest = (f"{size}_starting_torque" for size in ("mean", "largest", "smallest"))
        if largest not in given and smallest not in given:
            yield from exactly_one(given, mean, largest)
        elif mean in given:
            for key in (largest, smallest):
                yield from at_most_one(given, mean, key)
        else:
            yield from together(given, largest, smallest, "the largest and the smallest starting torque go together")
            yield from together(given, smallest, largest, "the largest and the smallest starting torque go together")
            high, low = given.number(largest), given.number(smallest)
            if high is not None and low is not None and low > high:
                yield Conflict((smallest,), "the smallest starting torque is above the largest", "swap them")


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

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """A step is at once and of torque; anything else takes its time."""
        shape = given.word("shape")
        if shape == "step":
            if "time" in given:
                yield Conflict(("time",), "a `step` has no `time`", "delete `time`, or write `shape: ramp`")
            if given.word("control") == "speed":
                reason = "a step of speed needs an infinite force"
                yield Conflict(("control",), reason, "write `shape: ramp` and a `time`")
        elif shape is not None and "time" not in given:
            yield given.missing("time", f"a `{shape}` needs its `time`")

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

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The secondary resistances of a short conveyor are not in the table."""
        yield from super().conflicts(given)
        route, resistance = given.block("route"), given.block("resistance")
        length = route.number("length") if route else None
        if length is None or length >= 80 or resistance is None:
            return
        if "secondary" not in resistance and "secondary_force" not in resistance:
            reason = "below 80 m the table of C(L) does not apply: the secondary resistances must be given"
            hint = "add `secondary_force: 1 kN` or `secondary: 2.5` under `resistance`"
            yield Conflict(("resistance",), reason, hint)

    @property
    def all_scenes(self) -> Sequence[Run | Start]:
        return self.scenes or self.DEFAULT_SCENES

    @property
    def settings(self) -> ConveyorChecks:
        return self.checks
