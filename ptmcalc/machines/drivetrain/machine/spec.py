"""How a designer writes a drive train: inertias, links, gears, brakes, what drives and what resists."""

from collections.abc import Iterator, Sequence
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field

from ptmcalc.base import units
from ptmcalc.base.span import KeyPath
from ptmcalc.base.units import Quantity
from ptmcalc.machines.drivetrain.machine.keys.brakes import Brake, Resistance
from ptmcalc.machines.drivetrain.machine.keys.gears import Gear
from ptmcalc.machines.drivetrain.machine.keys.inertias import Body, Impulse, Motion
from ptmcalc.machines.drivetrain.machine.keys.links import Link
from ptmcalc.machines.drivetrain.machine.keys.quantities import AnySpeed, either
from ptmcalc.machines.drivetrain.machine.keys.torques import AnyTorque, MotorOn
from ptmcalc.machines.drivetrain.machine.wiring import wiring
from ptmcalc.spec.fields import Fraction, Measure, PositiveTime
from ptmcalc.spec.fragment import Conflict, Given
from ptmcalc.spec.machine import CheckSettings, MachineSpec
from ptmcalc.spec.optional import Absent, Assumed, Limit, Setting
from ptmcalc.spec.scene import Scene, TransientScene


class DrivetrainChecks(CheckSettings):
    """Limits of the checks of a drive train."""

    start_time: Annotated[PositiveTime | None, Limit()] = None
    """maximum starting time"""
    stop_time: Annotated[PositiveTime | None, Limit()] = None
    """maximum stopping time"""
    stop_angle: Annotated[Annotated[float, either(units.ANGLE, units.LENGTH, above=0)] | None, Limit()] = None
    """maximum stopping distance"""
    resonance_margin: Annotated[Fraction, Limit()] = 0.2
    """minimum separation of an excitation frequency from a natural frequency, relative to the natural frequency"""
    cycle_time: Annotated[
        PositiveTime | None, Setting("the time of the scene, at most that of a cycle with pauses")
    ] = None
    """cycle time of the rms motor torque; default: the time of the scene"""


class TrainScene(Scene):
    """Base of the scenes of a drive train."""

    duration: Annotated[PositiveTime | None, Setting("the start or stop and ten periods of the lowest frequency")] = (
        None
    )
    """length of the scene; `window_factor` does not change it"""
    of: str | None = None
    """inertia considered in the scene; default: that of the first motor, or the first inertia"""
    speed: Annotated[AnySpeed | None, Absent("it starts from rest")] = None
    """initial speed of that inertia; the other inertias follow"""
    links: Literal["relaxed", "loaded"] | None = None
    """whether links start without torque, or loaded; `loaded` in a `stop`"""


class Run(TrainScene):
    """The train for a given time."""

    type: Literal["run"] = "run"
    duration: PositiveTime
    """simulated time"""


class Start(TrainScene, TransientScene):
    """A start from standstill: brakes released, motors on."""

    type: Literal["start"] = "start"
    until: Annotated[AnySpeed | None, Setting("95 % of the speed of the motor")] = None
    """target speed of the inertia considered; default: 95 % of the motor speed"""


class Stop(TrainScene, TransientScene):
    """A stop: motors off, brakes applied."""

    type: Literal["stop"] = "stop"
    speed: Annotated[AnySpeed | None, Assumed()] = None
    """initial speed of that inertia; the other inertias follow; that of the motor without load when left out"""


AnyScene = Annotated[Run | Start | Stop, Field(discriminator="type")]


class Drivetrain(MachineSpec):
    """Rotating or travelling inertias, connected by gears and elastic links."""

    kind: Literal["drivetrain"]
    inertias: Annotated[dict[str, Body], Field(min_length=1, max_length=40)]
    """inertias, by name"""
    links: dict[str, Link] = Field(default_factory=dict, max_length=100)
    """elastic links, by name"""
    gears: dict[str, Gear] = Field(default_factory=dict, max_length=40)
    """rigid gears and drums, by name"""
    brakes: dict[str, Brake] = Field(default_factory=dict, max_length=40)
    """brakes and clutches, by name"""
    motors: dict[str, MotorOn] = Field(default_factory=dict, max_length=40)
    """motors, by name"""
    torques: dict[str, AnyTorque] = Field(default_factory=dict, max_length=100)
    """torques and forces other than motors: weights, working loads, excitations"""
    resistances: dict[str, Resistance] = Field(default_factory=dict, max_length=100)
    """friction, by name"""
    motions: dict[str, Motion] = Field(default_factory=dict, max_length=40)
    """prescribed motions, by name"""
    impulses: dict[str, Impulse] = Field(default_factory=dict, max_length=40)
    """impulses, by name"""
    checks: DrivetrainChecks = DrivetrainChecks()
    """limits, and checks switched off by code"""
    scenes: Annotated[tuple[AnyScene, ...], Field(min_length=1, max_length=50)] | None = None
    """load cases; default: a start"""

    PARTS: ClassVar[tuple[str, ...]] = (
        "links",
        "gears",
        "brakes",
        "motors",
        "torques",
        "resistances",
        "motions",
        "impulses",
    )

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Every part is tied to inertias that are there, in quantities of their kind."""
        yield from super().conflicts(given)
        yield from wiring(given, cls.PARTS)

    @property
    def all_scenes(self) -> Sequence[TrainScene]:
        """The scenes of the file, or a start."""
        return self.scenes if self.scenes is not None else (Start(),)

    @property
    def settings(self) -> CheckSettings:
        """The limits and switches of the file."""
        return self.checks

    def turns(self, name: str) -> bool:
        """Whether an inertia turns, not travels."""
        return self.inertias[name].turns

    def quantity_at(self, path: KeyPath, measure: Measure) -> Quantity:
        """The quantity of a number: that of the inertia its part acts on."""
        if measure.or_else is None or self._turning_at(path):
            return measure.quantity
        return measure.or_else

    def _turning_at(self, path: KeyPath) -> bool:
        if path[0] == "inertias":
            return self.turns(str(path[1]))
        if path[0] == "scenes" and isinstance(path[1], int):
            return self.turns(self.main(self.all_scenes[path[1]]))
        if path[0] == "checks":
            return self.turns(self.stopped)
        part: Any = getattr(self, str(path[0]))[path[1]]
        return self.turns(part.body if isinstance(part, Link) else part.at)

    @property
    def stopped(self) -> str:
        """The inertia whose way the stops are about."""
        return self.main(next((scene for scene in self.all_scenes if isinstance(scene, Stop)), None))

    def main(self, scene: TrainScene | None = None) -> str:
        """The inertia a scene is about."""
        if scene is not None and scene.of is not None:
            return scene.of
        if self.motors:
            return next(iter(self.motors.values())).at
        return next(iter(self.inertias))
