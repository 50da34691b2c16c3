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
    """of the carriage above the floor; default: the farthest position from the mast support"""

    def default_name(self) -> str:
        return "_".join((*self.words, "loaded" if self.load == "full" else self.load))

    @property
    def words(self) -> tuple[str, ...]:
        """What its name begins with."""
        return (self.type,)


class HoistScene(StackerScene):
    """A start of the carriage, or its stop at the end of lowering."""

    type: Literal["hoist"] = "hoist"
    direction: Literal["up", "down"] = "up"
    """of the carriage"""

    @property
    def words(self) -> tuple[str, ...]:
        return (self.type, self.direction)


class Stand(StackerScene):
    """Standstill: weights alone."""

    type: Literal["stand"] = "stand"


class MechanismScene(StackerScene):
    """Base of what happens to a mechanism that travels."""

    mechanism: Mechanism | None = None
    """moving mechanism; default: the bridge of an overhead stacker, the base of a rack stacker"""

    @property
    def words(self) -> tuple[str, ...]:
        return (self.type, self.mechanism) if self.mechanism else (self.type,)


class DrivenScene(StackerScene, TransientScene):
    """Base of starts and stops, of any mechanism."""

    mechanism: Literal["bridge", "trolley", "rotation", "travel"] | None = None
    """moving mechanism; default: the bridge of an overhead stacker, the base of a rack stacker"""

    @property
    def words(self) -> tuple[str, ...]:
        return (self.type, self.mechanism) if self.mechanism else (self.type,)


class Start(DrivenScene):
    """A start of a mechanism to its speed."""

    type: Literal["start"] = "start"


class Brake(DrivenScene):
    """A stop of a mechanism from its speed to permanent standstill."""

    type: Literal["brake"] = "brake"
    speed_share: Annotated[PositiveFraction, Setting("full speed, the worst case")] = 1.0
    """initial speed / full speed: 0.1 for a stop from creep speed"""


class ObstacleScene(MechanismScene, TransientScene):
    """The mast tip of an overhead stacker collides with an obstacle."""

    type: Literal["obstacle"] = "obstacle"
    speed_share: Annotated[PositiveFraction, Setting("full speed, the worst case")] = 1.0
    """of full speed"""
    drive: Literal["off", "on"] = "off"
    """whether the drive still acts during the impact"""
    brake: Literal["on", "off"] = "on"
    """whether the brake acts from first contact; never while the drive is on"""


class BufferScene(MechanismScene):
    """A collision with the buffers."""

    type: Literal["buffer"] = "buffer"
    speed_share: Annotated[PositiveFraction, Setting("full speed, the worst case")] = 1.0
    """impact speed / full speed; 0.7 (EN 13001-2), or 0.5 with limit switches"""
    drive: Literal["off", "on"] = "off"
    """whether the drive still acts during the impact"""


class ForkPush(StackerScene, TransientScene):
    """The fork pushes against the rack."""

    type: Literal["fork_push"] = "fork_push"


class ForkCaught(StackerScene, TransientScene):
    """The fork snags in the rack while the carriage is hoisted."""

    type: Literal["fork_caught"] = "fork_caught"
    speed_share: Annotated[PositiveFraction, Setting("full speed, the worst case")] = 1.0
    """of full hoisting speed"""


class RailScene(StackerScene, TransientScene):
    """A rack stacker travels over uneven rail."""

    type: Literal["rail"] = "rail"
    speed_share: Annotated[PositiveFraction, Setting("full speed, the worst case")] = 1.0
    """of full speed"""


class SafetyGearScene(StackerScene):
    """The ropes fail while the carriage lowers, and the safety gear stops it."""

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
