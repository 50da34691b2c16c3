"""How a designer writes a rack stacker: a base on one or two rails, and the column that stands on it."""

from collections.abc import Iterator, Sequence
from typing import Annotated, Literal

from pydantic import Field

from ptmcalc.base import units
from ptmcalc.machines.crane.stacking.machine.keys.drives import Travel
from ptmcalc.machines.crane.stacking.machine.keys.hazards import Rail
from ptmcalc.machines.crane.stacking.machine.keys.parts import Base
from ptmcalc.machines.crane.stacking.machine.scenes import (
    BOTH,
    Brake,
    BufferScene,
    ForkCaught,
    ForkPush,
    HoistScene,
    RailScene,
    SafetyGearScene,
    StackerScene,
    Stand,
    Start,
)
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.spec.fragment import Conflict, Given
from ptmcalc.spec.scene import Scene

AnyScene = Annotated[
    HoistScene | Stand | Start | Brake | BufferScene | ForkPush | ForkCaught | RailScene | SafetyGearScene,
    Field(discriminator="type"),
]

SCENES: frozenset[type[Scene]] = frozenset(
    {HoistScene, Stand, Start, Brake, BufferScene, ForkPush, ForkCaught, RailScene, SafetyGearScene}
)
"""What may happen to a rack stacker."""


class RackStacker(Stacker):
    """A rack stacker crane (storage/retrieval machine): its mast is mounted on a base and guided at its head."""

    type: Literal["rack_stacker"]
    base: Base
    """the base (bottom frame)"""
    travel: Travel
    """travel along the aisle"""
    rail: Rail = Rail()
    """rail of the aisle"""
    scenes: Annotated[tuple[AnyScene, ...], Field(min_length=1, max_length=50)] | None = None
    """load cases; default: hoisting up and down, standstill, a start and a stop, and scenes for which the file
    gives data: buffers, fork thrust, snagged fork, uneven rail, safety gear; each with its load and
    empty if either may be worse"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Column and centre of mass stand between the wheels."""
        yield from super().conflicts(given)
        base, rail = given.block("base"), given.block("rail")
        if base is None:
            return
        wheel = base.number("wheel_diameter")
        if rail is not None and wheel is not None:
            for key, most in (("step", wheel / 2), ("gap", wheel)):
                size = rail.number(key)
                if size is not None and size >= most:
                    reason = f"a wheel of {units.show(wheel, units.LENGTH)} cannot roll over it"
                    yield Conflict(("rail", key), reason, f"write `{key}: 1 mm`, or the value of the rail")
        wheels = base.number("wheel_base")
        for key in ("column", "centre"):
            place = base.number(key)
            if wheels is not None and place is not None and place > wheels:
                reason = f"it is beyond the wheels, which are {units.show(wheels, units.SPAN)} apart"
                yield Conflict(("base", key), reason, f"write `{key}: {units.show(wheels / 2, units.SPAN, 4)}`")

    @property
    def all_scenes(self) -> Sequence[StackerScene]:
        if self.scenes is not None:
            return self.scenes
        scenes: list[StackerScene] = [HoistScene(), HoistScene(direction="down"), Stand()]
        if self.travel.starts:
            scenes.append(Start())
        scenes.append(Brake())
        if self.travel.buffers is not None:
            scenes.append(BufferScene())
        scenes += [HoistScene(direction="down", load="empty"), Stand(load="empty")]
        if self.travel.starts:
            scenes.append(Start(load="empty"))
        scenes.append(Brake(load="empty"))
        for load in BOTH:
            if self.fork is not None:
                scenes.append(ForkPush(load=load))
            if self.hoisting.catches:
                scenes.append(ForkCaught(load=load))
            if self.rail.uneven:
                scenes.append(RailScene(load=load))
            if self.safety_gear is not None:
                scenes.append(SafetyGearScene(load=load))
        return scenes
