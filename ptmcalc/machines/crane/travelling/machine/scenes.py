"""What happens to a crane that travels."""

from typing import Annotated, Literal

from pydantic import Field

from ptmcalc.base import units
from ptmcalc.spec.fields import (
    Measure,
    PositiveFraction,
    PositiveMass,
    PositiveSpan,
    PositiveTime,
)
from ptmcalc.spec.optional import Absent
from ptmcalc.spec.scene import Scene, TransientScene


class TravelScene(Scene):
    """Base of the scenes of a crane that travels."""

    load: Literal["full", "empty"] = "full"
    """the rated load on the hook, or the hook block alone"""
    trolley: Literal["worst", "near", "middle", "far"] = "worst"
    """trolley position: worst position, nearest to rail A, middle, farthest from rail A"""

    def default_name(self) -> str:
        return f"{self.type}_{'loaded' if self.load == 'full' else self.load}"


class Run(TravelScene):
    """Steady travel."""

    type: Literal["run"] = "run"


class MovingScene(TravelScene, TransientScene):
    """What starts or stops, with a load that swings."""

    wind: Literal["against", "with", "none"] | None = None
    """the wind of the file; against a start and with a stop when left out"""
    slope: Literal["against", "with", "none"] | None = None
    """the slope of the file; against a start and with a stop when left out"""
    length: Annotated[PositiveSpan | None, Absent("the length of the `suspension`")] = None
    """rope length from suspension point to load centre; default: that of the `suspension`"""


class Start(MovingScene):
    """A start to full speed."""

    type: Literal["start"] = "start"


class Brake(MovingScene):
    """A stop from full speed."""

    type: Literal["brake"] = "brake"
    by: Literal["ramp", "brake"] | None = None
    """type of stop: `deceleration` of the drive, or brakes; default: the ramp if the file gives one"""


class HoistWhileTravelling(MovingScene):
    """The load is hoisted or lowered while the drive starts."""

    type: Literal["hoist_while_travelling"] = "hoist_while_travelling"
    hoist: Literal["up", "down"] = "up"
    """direction"""
    time: Annotated[PositiveTime | None, Absent("hoisting continues during the start of the crane")] = None
    """hoisting time from the beginning of the start; default: the starting time"""


class Collision(TravelScene):
    """A collision with the buffers."""

    type: Literal["collision"] = "collision"
    speed_share: Annotated[PositiveFraction, Absent("full speed: the worst case")] = 1.0
    """impact speed / full speed; 0.7 (EN 13001-2), or 0.5 with limit switches"""
    suspension: Literal["swinging", "guided"] = "swinging"
    """suspended load, or guided load that moves with the crane"""
    drive: Literal["off", "on"] = "off"
    """whether the motors drive with their mean starting torque during the impact"""
    other_mass: Annotated[PositiveMass | None, Absent("impact on a rigid end stop")] = None
    """mass of a second crane on the same rails with the same buffers, instead of an end stop"""
    other_speed: Annotated[
        Annotated[float, Measure(units.SPEED, at_least=0)],
        Absent("the other crane is at standstill, as this scene states"),
    ] = 0.0
    """speed of the second crane, towards this one"""


class RailStep(TravelScene):
    """A wheel travels over the maximum step and the maximum gap of the rail."""

    type: Literal["rail_step"] = "rail_step"
    speed_share: Annotated[PositiveFraction, Absent("full travel speed")] = 1.0
    """of full speed"""


class Skew(TravelScene):
    """Skewed travel, guided by the front guide."""

    type: Literal["skew"] = "skew"


class Storm(TravelScene):
    """The parked crane in the out-of-service wind."""

    type: Literal["storm"] = "storm"
    load: Literal["full", "empty"] = "empty"
    """load on the hook: none out of service"""


class Runway(TravelScene):
    """Actions on the runway: the loaded and the unloaded crane, in the worst trolley positions."""

    type: Literal["runway"] = "runway"

    def default_name(self) -> str:
        return self.type


AnyScene = Annotated[
    Run | Start | Brake | HoistWhileTravelling | Collision | RailStep | Skew | Storm | Runway,
    Field(discriminator="type"),
]

MOVING = (Start, Brake, HoistWhileTravelling)
Moving = Start | Brake | HoistWhileTravelling
