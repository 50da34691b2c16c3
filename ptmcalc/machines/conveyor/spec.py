"""How a designer writes a belt conveyor."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field

from ptmcalc.base.memory import kept_for
from ptmcalc.base.span import KeyPath
from ptmcalc.components.drive import Gear
from ptmcalc.components.motor import AnyMotor
from ptmcalc.components.motor_starts import StartingMotor
from ptmcalc.components.plate_motor import gives_curve
from ptmcalc.components.run_back import USUAL_RESERVE
from ptmcalc.components.start import Profile
from ptmcalc.components.starting_gear import AnyStarter, FluidCoupling, gear_without_curve
from ptmcalc.laws.sag import DEEPEST
from ptmcalc.machines.conveyor.keys.belt import Belt, Idlers, Load, Transitions
from ptmcalc.machines.conveyor.keys.converter import DriveConverter, follows_wrongly, linked
from ptmcalc.machines.conveyor.keys.loading import MOST_POINTS, misplaced_points
from ptmcalc.machines.conveyor.keys.resistance import Resistance
from ptmcalc.machines.conveyor.keys.route import Route
from ptmcalc.machines.conveyor.keys.takeup import TakeUp
from ptmcalc.spec.fields import (
    FactorFromOne,
    Fraction,
    HourlyRate,
    Inertia,
    Length,
    PositiveAcceleration,
    PositiveAngle,
    PositiveEnergy,
    PositiveLength,
    PositivePower,
    PositiveRatio,
    PositiveSpan,
    PositiveSpeed,
    PositiveTime,
    PositiveTorque,
    Power,
    RunningTime,
    SignedLength,
    Time,
)
from ptmcalc.spec.fragment import Conflict, Fragment, Given, exactly_one, names_of_parts
from ptmcalc.spec.machine import CheckSettings, MachineSpec
from ptmcalc.spec.optional import Absent, Assumed, Checked, Limit, Setting
from ptmcalc.spec.scene import Scene, TransientScene
from ptmcalc.spec.shape import Also

_HOUR = 3600.0
"""Seconds of an hour."""


_MOST_WEAR = 0.1
"""Largest deviation of a diameter, relative to it [1]; an engineering choice. More is another pulley."""


class DriveDrum(Fragment):
    """The drive pulley."""

    diameter: PositiveLength
    """of the pulley with its lagging"""
    tolerance: Annotated[Length | None, Absent("several drives: pulleys of exactly the given diameters")] = None
    """largest deviation of the diameter, by manufacture and wear of the lagging; drives at one belt then share the load
    unequally"""
    deviation: Annotated[SignedLength | None, Assumed()] = None
    """deviation of the diameter from `diameter`; assumed 0 within `tolerance` where that is given"""
    wrap: PositiveAngle
    """wrap angle of the belt"""
    friction: Annotated[PositiveRatio | None, Limit()] = None
    """friction coefficient between belt and pulley; needed to check the traction"""
    inertia: Annotated[Inertia | None, Assumed()] = None
    """of the pulley on its own shaft; assumed 0 when left out"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """A pulley is nearly as large as its diameter says."""
        yield from super().conflicts(given)
        diameter = given.number("diameter")
        for key in ("tolerance", "deviation"):
            value = given.number(key)
            if value is not None and diameter is not None and abs(value) > _MOST_WEAR * diameter:
                hint = f"write `{key}: 2 mm`, or another `diameter`"
                yield Conflict((key,), "it is more than a tenth of the diameter", hint)


class Drive(Fragment):
    """Motors, gear and pulley at the head."""

    motor: StartingMotor
    """the motors"""
    coupling_inertia: Annotated[Inertia | None, Assumed()] = None
    """coupling and brake disc of one motor, on the motor shaft; 15 % of the rotor is assumed when left out"""
    gear: Gear
    """the gear"""
    drum: Annotated[DriveDrum, Also("pulley")]
    """the drive pulley"""
    starter: AnyStarter | None = None
    """starter of a cage motor: `star_delta` or `soft`; switched on directly when left out"""
    fluid_coupling: FluidCoupling | None = None
    """fluid coupling between each motor and the gear"""
    converter: DriveConverter | None = None
    """frequency converter of each motor: droop and torque limit, or the drive whose torque it follows; starts with a
    `profile` of the speed and controlled stops need none without them"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Starter, fluid coupling and converter belong to a cage motor."""
        yield from super().conflicts(given)
        yield from gear_without_curve(given)

    @property
    def turns(self) -> float:
        """Turn of the motor shaft per travel of the belt, i/R with the diameter as it is [rad/m]."""
        return self.gear.ratio / ((self.drum.diameter + (self.drum.deviation or 0.0)) / 2)

    @property
    def running_curve(self) -> AnyMotor | None:
        """Torque on the input shaft of the gear in steady running, of one motor: that of the coupling or converter, if
        there is one."""
        curve, between = self.motor.running_curve, self.fluid_coupling or self.converter
        return curve if curve is None or between is None else between.behind(curve)

    @property
    def start_curve(self) -> AnyMotor | None:
        """The same in starts that follow a curve."""
        return self.running_curve if self.starts_on_curve else None

    @property
    def starts_on_curve(self) -> bool:
        """Whether starts follow a curve."""
        return self.motor.starts_on_curve

    @property
    def mean_torque(self) -> float:
        """Mean starting torque of one motor, on the input shaft of the gear [N*m]."""
        if self.fluid_coupling is not None and (curve := self.start_curve) is not None:
            return self.motor.mean_of(curve)
        if self.converter is not None and (rated := self.motor.rated_torque) is not None:
            return self.converter.largest(rated)
        return self.motor.mean_torque


class PlacedDrive(Drive):
    """One of several drives, each with its own pulley."""

    at: Literal["head", "tail"] = "head"
    """position of its pulley; head drives in the sequence of the belt, the first on the tight
    side"""
    delay: Annotated[Time, Absent("simultaneous switch-on of all drives results in the maximum tensions")] = 0.0
    """start delay relative to the first drive"""


class Brake(Fragment):
    """A brake on a pulley shaft or on the motor shaft of its drive."""

    at: Literal["head", "tail"] = "head"
    """position of the brake; on the last pulley there"""
    torque: PositiveTorque
    """braking torque when fully applied"""
    shaft: Literal["drum", "motor"] = "drum"
    """shaft of the brake; on the motor shaft, gear ratio and gear losses increase its effect"""
    delay: Annotated[Time, Assumed(0.0, 0.0, 0.4, "brakes released by a thruster close within 0.2 to 0.4 s")] = 0.0
    """from the command to the start of the braking torque; 0 is assumed when it is left out, and 0.4 s"""
    rise_time: Annotated[Time, Absent("the interval of the assumed `delay` includes the rise")] = 0.0
    """from then to full torque, linear rise"""
    stop_heat: Annotated[PositiveEnergy | None, Limit()] = None
    """heat that the brake takes in one stop, of the data sheet"""
    heat_power: Annotated[PositivePower | None, Limit()] = None
    """heat power that the brake dissipates on average, of the data sheet; with `stops_per_hour`"""
    stops_per_hour: Annotated[HourlyRate | None, Limit()] = None
    """stops per hour with this brake"""

    @property
    def stop_rate(self) -> float:
        """Stops per second; 0 where the file gives no number [1/s]."""
        return (self.stops_per_hour or 0.0) / _HOUR


class Backstop(Fragment):
    """Backstop (holdback) of a loaded inclined conveyor."""

    torque: PositiveTorque
    """rated torque, on the shaft of the head pulley"""
    reserve: Annotated[FactorFromOne, Limit()] = USUAL_RESERVE
    """rated torque / rollback torque; 1.25 to 1.75 in practice"""
    stalled_motor: Literal["on", "off"] = "off"
    """whether the backstop must hold what the motors at the head pull when a jammed belt stalls them"""


class TailDrum(Fragment):
    """The tail pulley."""

    inertia: Annotated[Inertia | None, Assumed()] = None
    """on its own shaft; assumed 0 when left out"""
    diameter: Annotated[PositiveLength | None, Assumed()] = None
    """default: that of the drive pulley"""


class SlipLimit(Fragment):
    """Required traction reserve at the pulley."""

    reserve: Annotated[FactorFromOne, Limit()] = 1.2
    """reserve of friction force k_T; 1.1 to 1.5 in practice"""
    definition: Literal["force", "ratio"] = "force"
    """reserve of the friction force (`force`) or of the tension ratio (`ratio`, stricter)"""


class ConveyorChecks(CheckSettings):
    """Limits of the checks of a conveyor."""

    slip: SlipLimit = SlipLimit()
    """traction at the drive pulley"""
    belt_safety_running: Annotated[PositiveRatio | None, Limit()] = None
    """breaking force / maximum tension in steady running"""
    belt_safety_starting: Annotated[PositiveRatio | None, Limit()] = None
    """breaking force / maximum tension during a start"""
    sag: Annotated[PositiveRatio, Limit()] = 0.01
    """maximum sag ratio h/a of the belt, in steady running"""
    sag_carry: Annotated[PositiveRatio | None, Limit()] = None
    """maximum sag ratio h/a of the carrying strand, in steady running; 0.5 to 1.5 % is usual"""
    sag_return: Annotated[PositiveRatio | None, Limit()] = None
    """maximum sag ratio h/a of the return strand, in steady running; 2 % is usual"""
    sag_transient: Annotated[PositiveRatio | None, Limit()] = None
    """maximum sag ratio h/a of the belt during starts and stops; 3 % is usual"""
    idler_life: Annotated[RunningTime | None, Limit()] = None
    """required rating life L10h of the idler bearings; 30000 h to 60000 h is usual"""
    slack_sag: Annotated[PositiveRatio, Limit()] = DEEPEST
    """sag ratio at which the belt counts as slack, in every scene"""
    stop_distance: Annotated[PositiveSpan | None, Limit()] = None
    """maximum stopping distance of the belt in a `stop` or `controlled_stop`"""
    emergency_stop_distance: Annotated[PositiveSpan | None, Limit()] = None
    """maximum stopping distance of the belt in an `emergency_stop`; default: `stop_distance`"""
    stop_time: Annotated[PositiveTime | None, Limit()] = None
    """maximum stopping time of any stop"""
    section_fill: Annotated[PositiveRatio, Limit()] = 1.0
    """maximum filling ratio (mass flow / capacity of the cross-section)"""
    edge_overload: Annotated[FactorFromOne, Limit()] = 1.15
    """maximum fibre tension per width at a transition or in a vertical curve, relative to that of the steadily running
    belt with its safety factor"""
    belt_drift: Annotated[PositiveLength | None, Assumed()] = None
    """permissible drift of the belt in horizontal curves: distance from its edge to the end of the wing roll; assumed
    0.05 B + 25 mm when left out"""
    start_acceleration: Annotated[PositiveAcceleration | None, Limit()] = None
    """maximum starting acceleration of the belt; 0.1 to 0.3 m/s^2 is usual"""
    start_margins: Literal["on", "off"] = "off"
    """whether the start acceleration is checked against traction and slack limits; CNV101 and CNV105 are more exact"""
    start_residual: Annotated[PositiveRatio | None, Limit()] = None
    """maximum residual oscillation of the first belt mode after the start profile, relative to a step"""
    resonance_band: Annotated[Fraction, Limit()] = 0.15
    """required separation of the `ripple` of a drive from the natural frequencies of the belt"""
    braking_power: Annotated[Power | None, Assumed()] = None
    """power that the converters of all drives together take back in a `controlled_stop`: brake resistors or feedback
    to the mains; 3 % of the power of the motors is assumed when left out"""
    run_back: Annotated[Length, Limit()] = 0.1
    """permissible run-back distance of the belt in an aborted start; an engineering choice"""
    slip_heat: Annotated[PositiveEnergy | None, Limit()] = None
    """maximum slip heat of a pulley in one scene"""


class ConveyorScene(Scene):
    """Base of the scenes of a conveyor."""

    load: Literal["full", "empty", "uphill", "downhill"] = "full"
    """load of the carrying strand: full, empty, or only on rising or on falling sections"""
    loading_points: Annotated[tuple[str, ...], Field(min_length=1, max_length=MOST_POINTS)] | None = None
    """loading points in operation; all of them when left out"""

    def default_name(self) -> str:
        if self.loading_points is None:
            return f"{self.type}_{'loaded' if self.load == 'full' else self.load}"
        return "_".join((self.type, *self.loading_points, *([] if self.load == "full" else [self.load])))


class Run(ConveyorScene):
    """Steady running at rated speed."""

    type: Literal["run"] = "run"


def steady(scene: ConveyorScene) -> Run:
    """Steady running in the load state of a scene."""
    return Run(load=scene.load, loading_points=scene.loading_points)


class Aborted(Fragment):
    """A start that is aborted before the final start."""

    run: PositiveTime
    """driving time of the aborted start"""
    pause: Annotated[Time, Setting("part of the scene: 0 is an immediate restart")] = 0.0
    """time between switch-off and restart"""


class Start(ConveyorScene, TransientScene):
    """A start from standstill."""

    type: Literal["start"] = "start"
    profile: Profile = Profile()
    """how the drive starts; a torque step when left out"""
    belt: Literal["frozen", "relaxed"] = "frozen"
    """initial state of the belt: with the tensions of steady running, or relaxed after a long standstill"""
    aborted: Aborted | None = None
    """a start aborted before the final start"""


class Stopping(ConveyorScene, TransientScene):
    """Base of the scenes in which a running belt comes to rest."""


class Stop(Stopping):
    """The drives are switched off at full speed; the belt coasts or is braked."""

    type: Literal["stop"] = "stop"
    brakes: Literal["on", "off"] = "on"
    """whether the brakes of the file act"""


class EmergencyStop(Stopping):
    """The drives are switched off at full speed and all brakes are applied."""

    type: Literal["emergency_stop"] = "emergency_stop"


class ControlledStop(Stopping):
    """Converters lower the speed of all drives to standstill, where the brakes close."""

    type: Literal["controlled_stop"] = "controlled_stop"
    time: PositiveTime
    """from full speed to standstill"""
    shape: Literal["ramp", "cosine", "parabolic"] = "ramp"
    """how the speed falls: `ramp` linear, `cosine` as (1 + cos)/2, `parabolic` as two parabolas"""


class Coast(Stopping):
    """The drives are switched off and no brake acts; the resistance is computed from a measured distance."""

    type: Literal["coast"] = "coast"
    measured_distance: Annotated[PositiveSpan | None, Setting("a measured value without influence on the checks")] = (
        None
    )
    """measured coasting distance from rated speed, from which the friction factor f is computed"""


class Jam(ConveyorScene, TransientScene):
    """A pulley is blocked at full speed."""

    type: Literal["jam"] = "jam"
    at: Literal["head", "tail"] = "head"
    """the blocked pulley; the drives at the other end continue"""
    time: Annotated[Time, Setting("part of the scene: an instantaneous jam is the worst case")] = 0.0
    """in which the pulley comes to rest at a constant rate; 0 for an instantaneous stop"""
    duration: Annotated[PositiveTime | None, Setting("the report states the window with the loads")] = None
    """simulated time; default: two wave circuits of the belt"""


class Hold(ConveyorScene):
    """A loaded belt at standstill with its drives off."""

    type: Literal["backstop"] = "backstop"


IN_MOTION: frozenset[type[Scene]] = frozenset({Start, Stop, EmergencyStop, ControlledStop, Coast, Jam})
"""Scenes in which the belt does not run evenly."""

ANY_MOTION = IN_MOTION | {Run}
"""Scenes in which the belt moves."""

AnyScene = Annotated[
    Run | Start | Stop | EmergencyStop | ControlledStop | Coast | Jam | Hold,
    Field(discriminator="type"),
]


class Conveyor(MachineSpec):
    """A belt conveyor with drive pulleys at the head, at the tail or at both."""

    kind: Literal["conveyor"]
    route: Route
    """route of the belt"""
    belt: Belt
    """the belt"""
    idlers: Idlers
    """the idlers"""
    load: Load
    """conveyed material"""
    transitions: Transitions = Transitions()
    """transitions before the head pulley and after the tail pulley"""
    resistance: Resistance = Resistance()
    """resistance to motion"""
    speed: PositiveSpeed
    """belt speed"""
    drive: Drive | None = None
    """motors, gear and pulley at the head; or give `drives`"""
    drives: Annotated[dict[str, PlacedDrive], Field(min_length=1, max_length=8)] | None = None
    """several drives by name, instead of `drive`"""
    starts_per_hour: Annotated[HourlyRate | None, Checked()] = None
    """starts per hour of the conveyor; compared with the permitted starts of the motors"""
    brakes: dict[str, Brake] = Field(default_factory=dict, max_length=50)
    """brakes by name"""
    backstop: Annotated[Backstop | None, Also("holdback")] = None
    """backstop (holdback)"""
    takeup: TakeUp
    """the take-up"""
    tail_drum: Annotated[TailDrum, Also("tail_pulley")] = TailDrum()
    """the tail pulley"""
    checks: ConveyorChecks = ConveyorChecks()
    """limits, and checks switched off by code"""
    scenes: Annotated[tuple[AnyScene, ...], Field(min_length=1, max_length=50)] | None = None
    """load cases; default: a loaded run, a loaded start and an empty start when left out"""

    DEFAULT_SCENES: ClassVar[tuple[Run | Start, ...]] = (Run(), Start(), Start(load="empty"))

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The machine has one drive or several, one of them at the head; the secondary resistances of a short conveyor
        are not in the table."""
        yield from super().conflicts(given)
        yield from exactly_one(given, "drive", "drives")
        yield from names_of_parts(given, "drives", "brakes")
        yield from follows_wrongly(given)
        yield from _without_curves(given)
        yield from _stalled_without_curves(given)
        drives = given.raw.get("drives")
        if (
            isinstance(drives, dict)
            and drives
            and all(isinstance(drive, dict) and drive.get("at") == "tail" for drive in drives.values())
        ):
            reason = "no drive is at the head, the reference point of take-up and tension"
            yield Conflict(("drives",), reason, "reverse the route, so that a drive is at its head")
        yield from _no_motor_there(given)
        yield from _moving_tail(given)
        yield from _without_density(given)
        route, resistance = given.block("route"), given.block("resistance")
        length = _whole_length(route) if route else None
        yield from misplaced_points(given, length)
        if resistance is None:
            return
        if "cema" in resistance:
            yield from _without_spacing(given)
            return
        if length is None or length >= 80:
            return
        if "secondary" not in resistance and "secondary_force" not in resistance:
            reason = "below 80 m the table of C(L) does not apply: the secondary resistances must be given"
            hint = "add `secondary_force: 1 kN` or `secondary: 2.5` under `resistance`"
            yield Conflict(("resistance",), reason, hint)

    @property
    def all_scenes(self) -> Sequence[ConveyorScene]:
        return _followed(self, self.scenes or self.DEFAULT_SCENES)

    @property
    def all_drives(self) -> dict[str, PlacedDrive]:
        """Every drive by its name; a single one is called `head`."""
        if self.drives is not None:
            return _with_leaders(self.drives)
        assert self.drive is not None
        return _at_the_head(self.drive)

    @property
    def main_drive(self) -> PlacedDrive:
        """The first drive at the head."""
        return next(drive for drive in self.all_drives.values() if drive.at == "head")

    def drive_path(self, name: str) -> KeyPath:
        """Where a drive stands in the file."""
        return ("drive",) if self.drives is None else ("drives", name)

    @property
    def main_path(self) -> KeyPath:
        """Where the first drive at the head stands in the file."""
        return self.drive_path(next(name for name, drive in self.all_drives.items() if drive.at == "head"))

    @property
    def settings(self) -> ConveyorChecks:
        return self.checks

    @property
    def takeup_weight(self) -> float:
        """Mass of the take-up weight [kg]; 0 of a winch or screw, and where the file leaves its inertia out."""
        return 0.0 if self.effects.get("takeup_mass") == "off" else self.takeup.mass or 0.0

    def stop_distance_key(self, scene: ConveyorScene) -> KeyPath:
        """The key that limits the stopping distance of a scene: `stop_distance` holds for an emergency stop too where
        that has no limit of its own."""
        own = isinstance(scene, EmergencyStop) and (
            self.checks.emergency_stop_distance is not None or self.checks.stop_distance is None
        )
        return ("checks", "emergency_stop_distance" if own else "stop_distance")

    def stop_distance_limit(self, scene: ConveyorScene) -> float | None:
        """Longest stopping distance of a scene [m], where the file limits it."""
        limit: float | None = self.value_at(self.stop_distance_key(scene))
        return limit


@kept_for(64)
def _followed(spec: Conveyor, scenes: tuple[ConveyorScene, ...]) -> tuple[ConveyorScene, ...]:
    """Scenes whose starts follow the curves of the motors, where every motor has one."""
    curves = all(drive.starts_on_curve for drive in spec.all_drives.values())
    return tuple(
        one.model_copy(update={"profile": one.profile.followed(curves)}) if isinstance(one, Start) else one
        for one in scenes
    )


def _no_motor_there(given: Given) -> Iterator[Conflict]:
    """A brake on a motor's shaft needs a motor where it stands."""
    drives, brakes = given.raw.get("drives"), given.raw.get("brakes")
    placed = list(drives.values()) if isinstance(drives, dict) else []
    if not isinstance(brakes, dict) or not all(isinstance(drive, dict) for drive in placed):
        return
    if any(drive.get("at", "head") != "head" for drive in placed):
        return
    for name, brake in brakes.items():
        if isinstance(brake, dict) and (brake.get("at"), brake.get("shaft")) == ("tail", "motor"):
            reason = "no drive is at the tail, and so no motor shaft"
            yield Conflict(("brakes", name, "shaft"), reason, "write `shaft: drum`, or `at: head`")


def _moving_tail(given: Given) -> Iterator[Conflict]:
    """A tail pulley on the carriage of a take-up has no drive, and its weight follows the waves of the belt."""
    takeup, drives = given.block("takeup"), given.raw.get("drives")
    if takeup is None or (takeup.word("type"), takeup.word("at")) != ("gravity", "tail"):
        return
    placed = list(drives.values()) if isinstance(drives, dict) else []
    if any(isinstance(drive, dict) and drive.get("at") == "tail" for drive in placed):
        yield Conflict(("takeup", "at"), "a driven tail pulley is no take-up pulley", "write `at: head`")
    effects = given.raw.get("effects")
    if isinstance(effects, dict) and effects.get("belt_wave") in ("off", False):
        reason = "a take-up at the tail is only computed with the waves of the belt"
        yield Conflict(("effects", "belt_wave"), reason, "delete `belt_wave`, or write `at: head` under `takeup`")


def _without_curves(given: Given) -> Iterator[Conflict]:
    """A start along the motors' curves needs the curve of every motor, and so does an aborted one of converters."""
    several, one = given.raw.get("drives"), given.raw.get("drive")
    drives = list(several.values()) if isinstance(several, dict) else [one]
    motors = [drive.get("motor") for drive in drives if isinstance(drive, dict)]
    if all(isinstance(motor, dict) and gives_curve(motor) for motor in motors):
        return
    for index, scene in enumerate(given.blocks("scenes")):
        profile = scene.raw.get("profile") if scene else None
        if isinstance(profile, dict) and profile.get("shape") == "curve":
            reason = "a motor has no `curve` to follow"
            hint = "add `curve: {type: induction, ...}` to the motor, or write `shape: step`"
            yield Conflict(("scenes", index, "start", "profile", "shape"), reason, hint)
        elif isinstance(profile, dict) and scene is not None and "aborted" in scene.raw and _of_speed(profile):
            reason = "an aborted start at imposed speed requires the curves of all motors"
            hint = "add `power: 90 kW` and `poles: 4` to the motor, or write `control: torque`"
            yield Conflict(("scenes", index, "start", "aborted"), reason, hint)


def _stalled_without_curves(given: Given) -> Iterator[Conflict]:
    """The largest torque of a motor is that of its curve."""
    backstop = given.block("backstop")
    if backstop is None or backstop.word("stalled_motor") != "on":
        return
    several, one = given.raw.get("drives"), given.raw.get("drive")
    drives = several if isinstance(several, dict) else {"": one}
    for name, drive in drives.items():
        if not isinstance(drive, dict) or drive.get("at", "head") != "head":
            continue
        motor = drive.get("motor")
        if isinstance(motor, dict) and not gives_curve(motor):
            path = ("drives", name, "motor") if name else ("drive", "motor")
            reason = "`stalled_motor` requires the curve of the motor"
            yield Conflict(path, reason, "add `power: 90 kW` and `poles: 4`, or write `stalled_motor: off`")


def _of_speed(profile: Mapping[Any, Any]) -> bool:
    """Whether a profile as the file gives it is one of the speed."""
    return profile.get("shape") not in (None, "step", "curve") and profile.get("control") != "torque"


def _without_spacing(given: Given) -> Iterator[Conflict]:
    """CEMA's drag is that of an idler set."""
    idlers = given.block("idlers")
    carry = idlers.block("carry") if idlers else None
    if carry is not None and "pitch" not in carry:
        reason = "`cema` counts idler sets: their `pitch` is missing"
        yield Conflict(("idlers", "carry"), reason, "add `pitch: 1200 mm`")


def _without_density(given: Given) -> Iterator[Conflict]:
    """Skirt plates feel how high the load stands."""
    load, resistance = given.block("load"), given.block("resistance")
    forces = resistance.raw.get("forces") if resistance else None
    if load is None or "density" in load or not isinstance(forces, dict):
        return
    if "surcharge_angle" in load:
        return  # that it is missing is said already
    if any(isinstance(force, dict) and "skirt" in force for force in forces.values()):
        yield Conflict(
            ("load",), "`skirt` plates require the bulk density: it is missing", "add `density: 1600 kg/m^3`"
        )


def _whole_length(route: Given) -> float | None:
    """Length of a route as far as it is given."""
    if "sections" not in route:
        return route.number("length")
    parts = [part.number("length") if part else None for part in route.blocks("sections")]
    return sum(part for part in parts if part is not None) if None not in parts else None


_with_leaders = kept_for(64)(linked)


@kept_for(64)
def _at_the_head(drive: Drive) -> dict[str, PlacedDrive]:
    """The drives of a conveyor that has one."""
    given = {name: getattr(drive, name) for name in Drive.model_fields}
    return {"head": PlacedDrive.model_construct(at="head", delay=0.0, **given)}
