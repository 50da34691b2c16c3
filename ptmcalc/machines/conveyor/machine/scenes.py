"""Scenes of a belt conveyor: running, starting, stopping, a jam, and holding at standstill."""

from typing import Annotated, Literal

from pydantic import Field

from ptmcalc.components.start import Profile
from ptmcalc.machines.conveyor.machine.keys.loading import MOST_POINTS
from ptmcalc.spec.fields import PositiveSpan, PositiveTime, Time
from ptmcalc.spec.fragment import Fragment
from ptmcalc.spec.optional import Setting
from ptmcalc.spec.scene import Scene, TransientScene


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
