"""What happens to a stacker crane."""

from typing import Annotated, Literal

from ptmcalc.spec.fields import (
    PositiveFraction,
    Span,
)
from ptmcalc.spec.optional import Setting
from ptmcalc.spec.scene import Scene, TransientScene

Mechanism = Literal["bridge", "trolley", "travel"]
"""What travels: the bridge or the trolley of an overhead stacker, the base of a rack stacker."""

BOTH: tuple[Literal["full"], Literal["empty"]] = ("full", "empty")
"""Load states, of events in which either may be worse."""


class StackerScene(Scene):
    """Base of the scenes of a stacker crane."""

    load: Literal["full", "empty"] = "full"
    """the rated load on the fork, or nothing"""
    height: Annotated[Span | None, Setting("the farthest position from the mast support, with the largest bending")] = (
        None
    )
    """of the carriage above the floor; as far from where the column is held as it comes when left out"""

    def default_name(self) -> str:
        return "_".join((*self.words, "loaded" if self.load == "full" else self.load))

    @property
    def words(self) -> tuple[str, ...]:
        """What its name begins with."""
        return (self.type,)


class HoistScene(StackerScene):
    """The carriage is set in motion, or comes to rest at the end of lowering."""

    type: Literal["hoist"] = "hoist"
    direction: Literal["up", "down"] = "up"
    """of the carriage"""

    @property
    def words(self) -> tuple[str, ...]:
        return (self.type, self.direction)


class Stand(StackerScene):
    """It stands: weights alone."""

    type: Literal["stand"] = "stand"


class MechanismScene(StackerScene):
    """Base of what happens to a mechanism that travels."""

    mechanism: Mechanism | None = None
    """what moves; the bridge of an overhead stacker when left out, the base of a rack stacker always"""

    @property
    def words(self) -> tuple[str, ...]:
        return (self.type, self.mechanism) if self.mechanism else (self.type,)


class DrivenScene(StackerScene, TransientScene):
    """Base of starts and stops, of any mechanism."""

    mechanism: Literal["bridge", "trolley", "rotation", "travel"] | None = None
    """what moves; the bridge of an overhead stacker when left out, the base of a rack stacker always"""

    @property
    def words(self) -> tuple[str, ...]:
        return (self.type, self.mechanism) if self.mechanism else (self.type,)


class Start(DrivenScene):
    """A mechanism is brought to its speed."""

    type: Literal["start"] = "start"


class Brake(DrivenScene):
    """A mechanism is brought to rest from its speed, and held."""

    type: Literal["brake"] = "brake"
    speed_share: Annotated[PositiveFraction, Setting("full speed, the worst case")] = 1.0
    """of full speed before the stop: 0.1 for one from creep speed"""


class ObstacleScene(MechanismScene, TransientScene):
    """The free end of the column of an overhead stacker runs into an obstacle."""

    type: Literal["obstacle"] = "obstacle"
    speed_share: Annotated[PositiveFraction, Setting("full speed, the worst case")] = 1.0
    """of full speed"""
    drive: Literal["off", "on"] = "off"
    """whether the drive still pushes"""
    brake: Literal["on", "off"] = "on"
    """whether the brake acts from the first touch; never while the drive is on"""


class BufferScene(MechanismScene):
    """It runs onto its buffers."""

    type: Literal["buffer"] = "buffer"
    speed_share: Annotated[PositiveFraction, Setting("full speed, the worst case")] = 1.0
    """of full speed at which they are hit; 0.7 (EN 13001-2) or 0.5 with limit switches that have been passed"""
    drive: Literal["off", "on"] = "off"
    """whether the drive still pushes"""


class ForkPush(StackerScene, TransientScene):
    """The fork pushes against the rack."""

    type: Literal["fork_push"] = "fork_push"


class ForkCaught(StackerScene, TransientScene):
    """The fork is caught by the rack while the carriage is hoisted."""

    type: Literal["fork_caught"] = "fork_caught"
    speed_share: Annotated[PositiveFraction, Setting("full speed, the worst case")] = 1.0
    """of full hoisting speed"""


class RailScene(StackerScene, TransientScene):
    """A rack stacker runs over what is uneven in its rail."""

    type: Literal["rail"] = "rail"
    speed_share: Annotated[PositiveFraction, Setting("full speed, the worst case")] = 1.0
    """of full speed"""


class SafetyGearScene(StackerScene):
    """The ropes fail while the carriage sinks, and the safety gear catches it."""

    type: Literal["safety_gear"] = "safety_gear"


Braked = Start | Brake
AnyStackerScene = (
    HoistScene
    | Stand
    | Start
    | Brake
    | ObstacleScene
    | BufferScene
    | ForkPush
    | ForkCaught
    | RailScene
    | SafetyGearScene
)
