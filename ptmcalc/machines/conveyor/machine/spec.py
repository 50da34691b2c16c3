"""How a designer writes a belt conveyor."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field

from ptmcalc.base.memory import kept_for
from ptmcalc.base.span import KeyPath
from ptmcalc.components.plate_motor import gives_curve
from ptmcalc.laws.sag import DEEPEST
from ptmcalc.machines.conveyor.machine.keys.belt import Belt, Idlers, Load, Transitions
from ptmcalc.machines.conveyor.machine.keys.converter import follows_wrongly, linked
from ptmcalc.machines.conveyor.machine.keys.drives import Backstop, Brake, Drive, PlacedDrive, TailDrum
from ptmcalc.machines.conveyor.machine.keys.loading import misplaced_points
from ptmcalc.machines.conveyor.machine.keys.resistance import Resistance
from ptmcalc.machines.conveyor.machine.keys.route import Route
from ptmcalc.machines.conveyor.machine.keys.takeup import TakeUp
from ptmcalc.machines.conveyor.machine.scenes import AnyScene, ConveyorScene, EmergencyStop, Run, Start
from ptmcalc.spec.fields import (
    FactorFromOne,
    Fraction,
    HourlyRate,
    Length,
    PositiveAcceleration,
    PositiveEnergy,
    PositiveLength,
    PositiveRatio,
    PositiveSpan,
    PositiveSpeed,
    PositiveTime,
    Power,
    RunningTime,
)
from ptmcalc.spec.fragment import Conflict, Fragment, Given, exactly_one, names_of_parts
from ptmcalc.spec.machine import CheckSettings, MachineSpec
from ptmcalc.spec.optional import Assumed, Checked, Limit
from ptmcalc.spec.shape import Also


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
