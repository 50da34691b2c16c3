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
    """where the trolley stands: the worst of all places, nearest to rail A, in the middle, farthest from rail A"""

    def default_name(self) -> str:
        return f"{self.type}_{'loaded' if self.load == 'full' else self.load}"


class Run(TravelScene):
    """Even travel."""

    type: Literal["run"] = "run"


class MovingScene(TravelScene, TransientScene):
    """What starts or stops, with a load that swings."""

    wind: Literal["against", "with", "none"] | None = None
    """the wind of the file; against a start and with a stop when left out"""
    slope: Literal["against", "with", "none"] | None = None
    """the slope of the file; against a start and with a stop when left out"""
    length: Annotated[PositiveSpan | None, Absent("the length of the `suspension`")] = None
    """of the ropes, from where they are held to the middle of the load; that of the `suspension` when left out"""


class Start(MovingScene):
    """The drive brings it to speed."""

    type: Literal["start"] = "start"


class Brake(MovingScene):
    """It is brought to rest from full speed."""

    type: Literal["brake"] = "brake"
    by: Literal["ramp", "brake"] | None = None
    """what stops it: the `deceleration` of the drive, or its brakes; the ramp where the file has one"""


class HoistWhileTravelling(MovingScene):
    """The load is hoisted or lowered while the drive starts."""

    type: Literal["hoist_while_travelling"] = "hoist_while_travelling"
    hoist: Literal["up", "down"] = "up"
    """direction"""
    time: Annotated[PositiveTime | None, Absent("hoisting continues during the start of the crane")] = None
    """how long from the beginning of the start; as long as the start when left out"""


class Collision(TravelScene):
    """It runs onto its buffers."""

    type: Literal["collision"] = "collision"
    speed_share: Annotated[PositiveFraction, Absent("full speed: the worst case")] = 1.0
    """of full speed at which the buffers are hit; 0.7 (EN 13001-2) or 0.5 with limit switches that have been passed"""
    suspension: Literal["swinging", "guided"] = "swinging"
    """whether the load swings on, or is guided and hits with the crane"""
    drive: Literal["off", "on"] = "off"
    """whether the motors still push with their mean starting torque"""
    other_mass: Annotated[PositiveMass | None, Absent("impact on a rigid end stop")] = None
    """of a crane on the same rails, with the same buffers, that it runs into instead of a stop"""
    other_speed: Annotated[
        Annotated[float, Measure(units.SPEED, at_least=0)],
        Absent("the other crane is at standstill, as this scene states"),
    ] = 0.0
    """of that crane, towards this one"""


class RailStep(TravelScene):
    """A wheel runs over the largest step and the largest gap of the rail."""

    type: Literal["rail_step"] = "rail_step"
    speed_share: Annotated[PositiveFraction, Absent("full travel speed")] = 1.0
    """of full speed"""


class Skew(TravelScene):
    """It travels skewed, guided by its foremost guide."""

    type: Literal["skew"] = "skew"


class Storm(TravelScene):
    """It stands in the wind out of service."""

    type: Literal["storm"] = "storm"
    load: Literal["full", "empty"] = "empty"
    """what hangs on the hook: nothing out of service"""


AnyScene = Annotated[
    Run | Start | Brake | HoistWhileTravelling | Collision | RailStep | Skew | Storm, Field(discriminator="type")
]

MOVING = (Start, Brake, HoistWhileTravelling)
Moving = Start | Brake | HoistWhileTravelling
