"""How a designer writes a chain drive: a chain conveyor, or two shafts with a chain between them."""

from collections.abc import Iterator, Sequence
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from ptmcalc.base import units
from ptmcalc.base.memory import kept_for
from ptmcalc.components.drive import Gear
from ptmcalc.components.motor import AnyMotor
from ptmcalc.components.motor_stage import FloatArray
from ptmcalc.components.motor_starts import StartingMotor
from ptmcalc.components.plate_motor import gives_curve
from ptmcalc.components.run_back import USUAL_RESERVE
from ptmcalc.components.start import Profile
from ptmcalc.components.starting_gear import STAR, AnyStarter, StarDelta, UnratedCoupling, gear_without_curve
from ptmcalc.laws import chain_selection, sprocket
from ptmcalc.machines.chain_drive.machine.chain_data import (
    ChainData,
    Sprocket,
    Wear,
    even,
    pitch_of,
    teeth_of,
    wrong_size,
)
from ptmcalc.machines.chain_drive.machine.layout import Layout, TwoShafts
from ptmcalc.spec.fields import (
    FactorFromOne,
    Force,
    Fraction,
    HourlyRate,
    Inertia,
    PositiveAngle,
    PositivePressure,
    PositiveRatio,
    PositiveShare,
    PositiveSpan,
    PositiveSpeed,
    PositiveTime,
    PositiveTorque,
    RunningTime,
    Time,
)
from ptmcalc.spec.fragment import Conflict, Fragment, Given
from ptmcalc.spec.machine import CheckSettings, MachineSpec
from ptmcalc.spec.optional import Absent, Assumed, Checked, Limit, Setting
from ptmcalc.spec.scene import Scene, TransientScene
from ptmcalc.spec.shape import Also

_MEAN_OF = 401
"""Speeds of a mean starting torque; a numerical choice. More reduce its error and take longer."""


class Drive(Fragment):
    """Motors and gear on the shaft of the driving sprocket."""

    motor: StartingMotor
    """the motors"""
    coupling_inertia: Annotated[Inertia | None, Assumed()] = None
    """coupling and brake disc of one motor, on the motor shaft; 15 % of the rotor is assumed when left out"""
    gear: Gear
    """the gear; `{ratio: 1, efficiency: 1}` without one"""
    starter: AnyStarter | None = None
    """starter of a cage motor: `star_delta` or `soft`; switched on directly when left out"""
    fluid_coupling: UnratedCoupling | None = None
    """fluid coupling between each motor and the gear"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Starter and fluid coupling belong to a cage motor whose curve the start follows."""
        yield from super().conflicts(given)
        yield from gear_without_curve(given)
        motor = given.raw.get("motor")
        motor = motor if isinstance(motor, dict) else {}
        mean = next((key for key in motor if "starting_torque" in key), None)
        for key in ("starter", "fluid_coupling"):
            if key in given and mean is not None and "power" in motor and "curve" not in motor:
                yield Conflict((key,), f"a start by `{mean}` does not follow it", f"delete `{mean}`")

    @property
    def running_curve(self) -> AnyMotor | None:
        """Torque on the input shaft of the gear in steady running, of one motor: that of the coupling, if there is
        one."""
        curve = self.motor.running_curve
        return curve if curve is None or self.fluid_coupling is None else self.fluid_coupling.behind(curve)

    @property
    def start_curve(self) -> AnyMotor | None:
        """The same in starts that follow a curve, in delta connection and at full voltage."""
        return self.running_curve if self.motor.starts_on_curve else None

    @property
    def mean_torque(self) -> float:
        """Mean starting torque of one motor, on the input shaft of the gear [N*m]: of its curve with its starter."""
        curve = self.start_curve
        if curve is None or (self.starter is None and self.fluid_coupling is None):
            return self.motor.mean_torque
        speeds = np.linspace(0.0, self.motor.speed or curve.no_load_speed or 1.0, _MEAN_OF)
        return float(np.mean(self.torques(speeds)))

    def torques(self, speeds: FloatArray) -> FloatArray:
        """Torque of one motor on its curve at speeds of its shaft [rad/s], once a rise over time is over [N*m]."""
        curve = self.start_curve
        assert curve is not None
        torques = curve.torque(speeds, np.inf)
        return np.where(speeds < self.switch_over, STAR, 1.0) * torques

    @property
    def switch_over(self) -> float:
        """Speed at which a star-delta starter switches to delta [rad/s]; 0 without one."""
        motor = self.motor.running_curve
        if not isinstance(self.starter, StarDelta) or motor is None or self.fluid_coupling is not None:
            return 0.0
        return self.starter.switch_over * (motor.no_load_speed or 0.0)


class Brake(Fragment):
    """A brake."""

    torque: PositiveTorque
    """braking torque when fully applied"""
    shaft: Literal["sprocket", "motor"] = "motor"
    """shaft of the brake; on the motor shaft, gear ratio and gear losses increase its effect"""
    delay: Annotated[Time, Assumed(0.0, 0.0, 0.4, "brakes released by a thruster close within 0.2 to 0.4 s")] = 0.0
    """from the command to the start of the braking torque"""
    rise_time: Annotated[Time, Absent("the interval of the assumed `delay` includes the rise")] = 0.0
    """from then to full torque, linear rise"""


class Backstop(Fragment):
    """Backstop (holdback) of a loaded inclined conveyor."""

    torque: PositiveTorque
    """rated torque, on the sprocket shaft"""
    reserve: Annotated[FactorFromOne, Limit()] = USUAL_RESERVE
    """rated torque / rollback torque; 1.25 to 1.75 in practice"""


class TorqueLimiter(Fragment):
    """Torque limiter between the gear and the driving sprocket."""

    torque: PositiveTorque
    """setting: torque on the sprocket shaft at which it slips or breaks"""
    tolerance: Annotated[
        PositiveShare,
        Assumed(0.1, 0.05, 0.2, "manufacturers set torque limiters within 10 %; 5 % at best, 20 % after wear"),
    ] = 0.1
    """deviation of the actual trip torque from the setting, to either side; 10 % is assumed, 5 % to 20 %"""
    type: Literal["slip_clutch", "shear_pin"] = "slip_clutch"
    """`slip_clutch` slips and keeps its torque, `shear_pin` breaks and disconnects the drive"""
    reserve: Annotated[FactorFromOne, Limit()] = 1.25
    """setting / torque of steady running; 1.25, or 1.5 with severe shocks, by manufacturers"""

    @property
    def least(self) -> float:
        """Lowest trip torque [N*m]."""
        return self.torque * (1 - self.tolerance)

    @property
    def most(self) -> float:
        """Highest trip torque [N*m]."""
        return self.torque * (1 + self.tolerance)


class Equalising(Fragment):
    """A drive that varies the sprocket speed to keep the chain speed constant."""

    residual: Annotated[
        Fraction, Assumed(0.0, 0.0, 0.1, "equalising sprockets: up to 10 % of the fluctuation remains")
    ] = 0.0
    """residual share of the polygon effect due to an imperfect drive law"""


class Operating(Fragment):
    """Speed range of the drive."""

    lowest: PositiveSpeed
    """minimum chain speed"""
    highest: PositiveSpeed
    """maximum chain speed"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The range is not empty."""
        low, high = given.number("lowest"), given.number("highest")
        if low is not None and high is not None and low >= high:
            yield Conflict(("highest",), "it is not above the lowest speed", "swap them")


class ResonanceLimit(Fragment):
    """Limits of the resonance check."""

    band: Annotated[PositiveShare, Limit()] = 0.15
    """minimum separation from a resonance speed, relative to it; at least twice the damping ratio"""
    weight: Annotated[PositiveRatio, Limit()] = 0.5
    """minimum force of a relevant tooth harmonic in resonance, relative to m a_max"""


class SpanResonance(Fragment):
    """Limits of the transverse resonance of the free spans between two shafts."""

    band: Annotated[PositiveShare, Limit()] = 0.15
    """minimum separation of the excitation from a natural frequency of a span, relative to it"""
    modes: Annotated[int, Field(ge=1, le=6, strict=True), Setting("higher modes are damped by the link joints")] = 3
    """number of transverse modes of each span"""


class ChainChecks(CheckSettings):
    """Limits of the checks of a chain drive; None stands for the default of the layout."""

    resonance: ResonanceLimit = ResonanceLimit()
    """required separation of the speed from resonances"""
    span_resonance: SpanResonance | None = None
    """required separation of tooth and shaft frequencies from the transverse natural frequencies of the free spans"""
    safety_static: Annotated[PositiveRatio | None, Limit()] = None
    """breaking load / (static + centrifugal tension); 10 for conveyors, 7 for drives when left out"""
    safety_dynamic: Annotated[PositiveRatio | None, Limit()] = None
    """breaking load / maximum tension of steady running; 7 for conveyors, 5 for drives when left out"""
    safety_start: Annotated[PositiveRatio, Limit()] = 5.0
    """breaking load / maximum tension of a start or stop"""
    safety_jam: Annotated[PositiveRatio, Limit()] = 3.3
    """breaking load / maximum tension when a jam trips the torque limiter; chains are preloaded with 30 % of it"""
    joint_pressure: Annotated[PositivePressure | None, Limit()] = None
    """maximum pin/bush bearing pressure; 20 to 30 MPa is usual"""
    wrap: Annotated[PositiveAngle, Limit()] = 2.0943951023931953
    """minimum wrap angle of a sprocket; 120 deg by handbooks"""
    teeth: Annotated[Annotated[int, Field(ge=1, strict=True)] | None, Limit()] = None
    """minimum number of teeth; 6 for conveyors, 17 for drives when left out"""
    ratio: Annotated[PositiveRatio, Limit()] = 6.0
    """maximum transmission ratio of a drive"""
    centre_distance_least: Annotated[PositiveRatio, Limit()] = 30.0
    """minimum centre distance of a drive, in pitches"""
    centre_distance_most: Annotated[PositiveRatio, Limit()] = 80.0
    """maximum centre distance of a drive with unsupported strands, in pitches"""
    least_tension: Annotated[Force, Limit()] = 0.0
    """minimum tension of a strand in steady running"""
    life: Annotated[RunningTime | None, Limit()] = None
    """required life; needed to check wear and fatigue"""
    fatigue: Annotated[PositiveRatio, Limit()] = 1.0
    """maximum utilisation of the permissible stress amplitude"""
    start_time: Annotated[PositiveTime | None, Limit()] = None
    """maximum starting time"""
    stop_distance: Annotated[PositiveSpan | None, Limit()] = None
    """maximum stopping distance of the chain in a `stop`"""
    emergency_stop_distance: Annotated[PositiveSpan | None, Limit()] = None
    """maximum stopping distance of the chain in an `emergency_stop`; default: `stop_distance`"""
    stop_time: Annotated[PositiveTime | None, Limit()] = None
    """maximum stopping time of any stop"""


class ChainScene(Scene):
    """Base of the scenes of a chain drive."""

    load: Literal["full", "empty"] = "full"
    """with load or power, or without"""

    def default_name(self) -> str:
        return f"{self.type}_{'loaded' if self.load == 'full' else self.load}"


class Run(ChainScene):
    """Steady running at the speed of the file."""

    type: Literal["run"] = "run"


class Start(ChainScene, TransientScene):
    """A start from standstill."""

    type: Literal["start"] = "start"
    profile: Profile = Profile()
    """how the drive starts; a torque step when left out"""
    chain: Literal["frozen", "relaxed"] = "frozen"
    """initial state: with the tensions of steady running, or only the take-up tension after a long standstill"""


class Stopping(ChainScene, TransientScene):
    """Base of the scenes in which a running chain comes to rest."""


class Stop(Stopping):
    """The drive is switched off at full speed; the chain coasts or is braked."""

    type: Literal["stop"] = "stop"
    brake: Literal["on", "off"] = "on"
    """whether the brake of the file acts"""


class EmergencyStop(Stopping):
    """The drive is switched off at full speed and the brake is applied."""

    type: Literal["emergency_stop"] = "emergency_stop"


class Coast(Stopping):
    """The drive is switched off and no brake acts; the resistance is computed from a measured distance."""

    type: Literal["coast"] = "coast"
    measured_distance: Annotated[PositiveSpan | None, Setting("a measured value without influence on the checks")] = (
        None
    )
    """measured coasting distance from the speed of the file"""


class Hold(ChainScene):
    """A loaded conveyor at standstill with its drive off."""

    type: Literal["backstop"] = "backstop"


class SpeedRange(ChainScene):
    """Speed sweep at a constant rate through a range, resonances included."""

    type: Literal["speed_range"] = "speed_range"
    start: PositiveSpeed = Field(alias="from")
    """chain speed at the beginning"""
    end: PositiveSpeed = Field(alias="to")
    """chain speed at the end"""
    time: PositiveTime
    """duration of the sweep"""


AnyScene = Annotated[Run | Start | Stop | EmergencyStop | Coast | Hold | SpeedRange, Field(discriminator="type")]

IN_MOTION: frozenset[type[Scene]] = frozenset({Start, Stop, EmergencyStop, Coast, SpeedRange})
"""Scenes in which the chain does not run evenly."""


class ChainDrive(MachineSpec):
    """A chain conveyor, or a drive by chain between two shafts."""

    kind: Literal["chain_drive"]
    layout: Layout
    """layout of the conveyor or drive: `type: conveyor` or `type: drive`"""
    chain: ChainData
    """the chain"""
    sprocket: Annotated[Sprocket, Also("drive_sprocket")]
    """the driving sprocket"""
    speed: PositiveSpeed
    """mean speed of the chain"""
    operating: Operating | None = None
    """range of speeds of a drive with variable speed; half to one and a half of `speed` when left out"""
    drive: Drive | None = None
    """motors and gear; needed for starts and stops"""
    starts_per_hour: Annotated[HourlyRate | None, Checked()] = None
    """starts per hour of the chain; compared with the permitted starts of the motors"""
    equalising: Equalising | None = None
    """an equalising drive"""
    brake: Brake | None = None
    """the brake"""
    backstop: Annotated[Backstop | None, Also("holdback")] = None
    """backstop (holdback) of an inclined conveyor"""
    torque_limiter: TorqueLimiter | None = None
    """torque limiter on the shaft of the driving sprocket: slip clutch or shear pin"""
    wear: Wear | None = None
    """wear of the link joints; needed for the life"""
    checks: ChainChecks = ChainChecks()
    """limits, and checks switched off by code"""
    scenes: Annotated[tuple[AnyScene, ...], Field(min_length=1, max_length=50)] | None = None
    """load cases; default: a run, and a start if the drive is given, for conveyors loaded and
    empty"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Sprockets fit the chain; a start needs its motors, a stop its gear."""
        yield from super().conflicts(given)
        chain, driver, layout = (given.block(key) for key in ("chain", "sprocket", "layout"))
        pitch = pitch_of(chain)
        if driver is not None:
            yield from wrong_size(driver, pitch, ("sprocket",))
        if layout is not None and "type" in layout.raw:
            yield from _of_layout(layout, driver, pitch)
        yield from _scenes_that_lack(given)
        yield from _no_free_spans(given)

    @property
    def all_scenes(self) -> Sequence[ChainScene]:
        if self.scenes is not None:
            return _followed(self, self.scenes)
        loads: tuple[Literal["full", "empty"], ...] = (
            ("full",) if isinstance(self.layout, TwoShafts) else ("full", "empty")
        )
        runs = tuple(Run(load=load) for load in loads)
        return _followed(self, (*runs, *(Start(load=load) for load in loads)) if self.drive is not None else runs)

    @property
    def settings(self) -> ChainChecks:
        return self.checks


def _of_layout(layout: Given, driver: Given | None, pitch: float | None) -> Iterator[Conflict]:
    """The other sprocket fits the chain, and the chain goes round both; paths hold the type of the layout."""
    named, key = ("drive", "driven") if layout.model is TwoShafts else ("conveyor", "tail")
    other = layout.block(key)
    if other is None:
        return
    yield from wrong_size(other, pitch, ("layout", named, key))
    if driver is None or pitch is None:
        return
    teeth = [teeth_of(one) for one in (driver, other)]
    if None in teeth:
        return
    one, two = (z or 0 for z in teeth)
    least = sprocket.pitch_radius(pitch, one) + sprocket.pitch_radius(pitch, two)
    apart = "centre_distance" if layout.model is TwoShafts else "length"
    distance, pitches = layout.number(apart), layout.raw.get("pitches")
    if distance is not None and distance <= least:
        room = units.show(least, units.LENGTH)
        reason = f"the sprockets touch: the sum of their pitch radii is {room}"
        yield Conflict(("layout", named, apart), reason, "write about 40 pitches, or correct the pitch of the chain")
    elif isinstance(pitches, int):
        needed = chain_selection.chain_pitches(least, pitch, one, two)
        if pitches <= needed:
            reason = f"{pitches} pitches are too few for both sprockets, which touch at {needed:.1f}"
            hint = f"write `pitches: {even(2 * needed)}`"
            yield Conflict(("layout", named, "pitches"), reason, hint)


_MOVED_BY_DRIVE = ("start", "stop", "emergency_stop", "coast")


def _scenes_that_lack(given: Given) -> Iterator[Conflict]:
    """A start needs motors, a backstop scene a conveyor."""
    layout = given.block("layout")
    between_shafts = layout is not None and layout.model is TwoShafts and "type" in layout.raw
    for index, scene in enumerate(given.blocks("scenes")):
        what = scene.raw.get("type") if scene else None
        if what in _MOVED_BY_DRIVE and "drive" not in given:
            reason = f"a `{what}` needs the motors and the gear: there is no `drive`"
            hint = "add `drive: {motor: {inertia: 0.35 kg*m^2, mean_starting_torque: 160 N*m}, gear: {ratio: 40}}`"
            yield Conflict(("scenes", index), reason, hint)
        if what == "backstop" and between_shafts:
            yield Conflict(("scenes", index), "a two-shaft drive does not roll back", "delete the scene")
        profile = scene.raw.get("profile") if scene and what == "start" else None
        if isinstance(profile, dict) and profile.get("shape") == "curve" and not _has_curve(given):
            hint = "add `curve: {type: induction, ...}` to the motor, or write `shape: step`"
            yield Conflict(("scenes", index, "start", "profile", "shape"), "the motor has no `curve` to follow", hint)


def _no_free_spans(given: Given) -> Iterator[Conflict]:
    """The strands of a conveyor lie on their guides."""
    layout, checks = given.block("layout"), given.block("checks")
    conveyor = layout is not None and layout.model is not TwoShafts and "type" in layout.raw
    if conveyor and checks is not None and "span_resonance" in checks:
        reason = "the strands of a conveyor are supported and do not vibrate as free spans"
        yield Conflict(("checks", "span_resonance"), reason, "delete `span_resonance`")


@kept_for(64)
def _followed(spec: ChainDrive, scenes: tuple[ChainScene, ...]) -> tuple[ChainScene, ...]:
    """Scenes whose starts follow the curve of the motors, where the file gives one."""
    curve = spec.drive is not None and spec.drive.motor.starts_on_curve
    return tuple(
        one.model_copy(update={"profile": one.profile.followed(curve)}) if isinstance(one, Start) else one
        for one in scenes
    )


def _has_curve(given: Given) -> bool:
    drive = given.raw.get("drive")
    motor = drive.get("motor") if isinstance(drive, dict) else None
    return isinstance(motor, dict) and gives_curve(motor)
