"""How a designer writes an overhead stacker: bridge, trolley, and the column that hangs from it."""

from collections.abc import Iterator, Sequence
from typing import Annotated, Literal

from pydantic import Field

from ptmcalc.base import units
from ptmcalc.machines.crane.stacking.machine.keys.drives import Rotation, Travel
from ptmcalc.machines.crane.stacking.machine.keys.hazards import Obstacle
from ptmcalc.machines.crane.stacking.machine.keys.parts import Bridge, Trolley
from ptmcalc.machines.crane.stacking.machine.scenes import (
    BOTH,
    Brake,
    BufferScene,
    ForkCaught,
    HoistScene,
    Mechanism,
    ObstacleScene,
    StackerScene,
    Stand,
    Start,
)
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.spec.fragment import Conflict, Given
from ptmcalc.spec.scene import Scene

AnyScene = Annotated[
    HoistScene | Stand | Start | Brake | ObstacleScene | BufferScene | ForkCaught, Field(discriminator="type")
]

SCENES: frozenset[type[Scene]] = frozenset({HoistScene, Stand, Start, Brake, ObstacleScene, BufferScene, ForkCaught})
"""What may happen to an overhead stacker."""


class OverheadStacker(Stacker):
    """An overhead stacker crane: its mast is suspended from the trolley and rotates about its own axis."""

    type: Literal["overhead_stacker"]
    bridge: Bridge
    """bridge of the trolley"""
    trolley: Trolley
    """trolley of the mast"""
    bridge_travel: Travel | None = None
    """travel of the bridge"""
    trolley_travel: Travel | None = None
    """travel of the trolley"""
    rotation: Rotation | None = None
    """rotation of the mast"""
    obstacle: Obstacle | None = None
    """obstacle in the path of the mast; needed for a scene `obstacle`"""
    scenes: Annotated[tuple[AnyScene, ...], Field(min_length=1, max_length=50)] | None = None
    """load cases; default: hoisting up and down, standstill, a start and a stop of every
    mechanism, and scenes for which the file gives data: obstacle, buffers, snagged fork; each with its
    load and empty if either may be worse"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The trolley stays on the bridge, whose girders are as stiff as the column needs."""
        yield from super().conflicts(given)
        yield from _trolley_beyond_the_bridge(given)
        yield from _girders(given)
        column = given.block("column")
        if column is not None and "top_guide" in column:
            reason = "the mast of an overhead stacker is suspended: its tip is free"
            yield Conflict(("column", "top_guide"), reason, "delete `top_guide`, or write `type: rack_stacker`")

    @property
    def all_scenes(self) -> Sequence[StackerScene]:
        if self.scenes is not None:
            return self.scenes
        scenes: list[StackerScene] = [HoistScene(), HoistScene(direction="down"), Stand()]
        for word, travel in self.travels:
            if travel.starts:
                scenes.append(Start(mechanism=word))
            scenes.append(Brake(mechanism=word))
        if self.rotation is not None:
            scenes += [Start(mechanism="rotation"), Brake(mechanism="rotation")]
        for word, travel in self.travels:
            if self.obstacle is not None:
                scenes.append(ObstacleScene(mechanism=word))
            if travel.buffers is not None:
                scenes.append(BufferScene(mechanism=word))
        scenes += [HoistScene(direction="down", load="empty"), Stand(load="empty")]
        for word, travel in self.travels:
            if travel.starts:
                scenes.append(Start(mechanism=word, load="empty"))
            scenes.append(Brake(mechanism=word, load="empty"))
        if self.hoisting.catches:
            scenes += [ForkCaught(load=load) for load in BOTH]
        return scenes

    @property
    def travels(self) -> list[tuple[Mechanism, Travel]]:
        """The mechanisms that travel, by the word a scene names them with."""
        both: tuple[tuple[Mechanism, Travel | None], ...]
        both = (("bridge", self.bridge_travel), ("trolley", self.trolley_travel))
        return [(word, travel) for word, travel in both if travel is not None]


def _trolley_beyond_the_bridge(given: Given) -> Iterator[Conflict]:
    bridge, trolley = given.block("bridge"), given.block("trolley")
    if bridge is None or trolley is None:
        return
    span, place = bridge.number("span"), trolley.number("position")
    if span is not None and place is not None and not 0 < place < span:
        reason = f"the trolley is beyond the bridge, whose span is {units.show(span, units.SPAN)}"
        hint = f"write `position: {units.show(span / 2, units.SPAN, 4)}` for the middle, or correct the `span`"
        yield Conflict(("trolley", "position"), reason, hint)


def _girders(given: Given) -> Iterator[Conflict]:
    """The column stands on girders that bend, unless the file gives the stiffness of the whole."""
    column, bridge = given.block("column"), given.block("bridge")
    if column is None or bridge is None or "column" not in given or "bridge" not in given:
        return
    for key in ("girder_vertical", "girder_horizontal"):
        if "stiffness" in column and key in bridge:
            reason = "it is part of the `stiffness` of the mast"
            yield Conflict(("bridge", key), reason, f"delete `{key}`, or the `stiffness` of the mast")
        if "stiffness" not in column and key not in bridge:
            example = "120000 cm^4" if key == "girder_vertical" else "16000 cm^4"
            reason = f"the girders bend under the mast: `{key}` of one girder is missing"
            yield Conflict(("bridge",), reason, f"add `{key}: {example}`, or give the `stiffness` of the mast")
