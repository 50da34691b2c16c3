"""What every stacker crane is described by, and what must hold between its parts."""

from collections.abc import Iterator
from typing import Annotated, Literal

from ptmcalc.base import units
from ptmcalc.machines.crane.stacking.machine.keys.drives import Hoisting
from ptmcalc.machines.crane.stacking.machine.keys.hazards import Fork, Rack, SafetyGear, Settling
from ptmcalc.machines.crane.stacking.machine.keys.limits import StackerChecks
from ptmcalc.machines.crane.stacking.machine.keys.parts import Cab, Carriage, Column
from ptmcalc.spec.fields import PositiveMass
from ptmcalc.spec.fragment import Conflict, Given
from ptmcalc.spec.machine import MachineSpec
from ptmcalc.spec.shape import Also


class Stacker(MachineSpec):
    """Base of both stacker cranes: a column, a carriage that climbs it, a hoist."""

    kind: Literal["crane"]
    type: str
    load: PositiveMass
    """rated load with its pallet"""
    column: Annotated[Column, Also("mast")]
    """mast, guide of the carriage"""
    carriage: Carriage
    """with the fork"""
    cab: Cab | None = None
    """cab on the carriage; none when left out"""
    hoisting: Hoisting
    """hoist of the carriage"""
    fork: Fork | None = None
    """the telescopic fork; needed for a `fork_push`"""
    rack: Rack = Rack()
    """the rack at the fork; rigid when left out"""
    safety_gear: SafetyGear | None = None
    """safety gear of the carriage; needed for a scene `safety_gear`"""
    settling: Settling = Settling()
    """positioning tolerance of the mast before the fork extends"""
    checks: StackerChecks = StackerChecks()
    """limits, and checks switched off by code"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The carriage stays on its column, in every scene; scenes have what they need."""
        yield from super().conflicts(given)
        yield from carriage_off_the_column(given)
        yield from fork_without_a_rack(given)
        yield from scenes_that_lack(given)

    @property
    def settings(self) -> StackerChecks:
        return self.checks


def fork_without_a_rack(given: Given) -> Iterator[Conflict]:
    """What a fork runs against has to give a little: the force on a rigid rack has no limit."""
    rack = given.block("rack")
    if "fork" in given and rack is not None and "stiffness_push" not in rack:
        where: tuple[str, ...] = ("rack",) if "rack" in given else ()
        hint = "add `stiffness_push: 500 kN/m` to `rack`" if where else "add `rack: {stiffness_push: 500 kN/m}`"
        yield Conflict(where, "a `fork` pushes against a rack: its `stiffness_push` is missing", hint)


def ends_of_column(given: Given) -> tuple[float, float] | None:
    """Heights of the lower and the upper end above the floor, where the file says them [m]."""
    column = given.block("column")
    if column is None or "column" not in given:
        return None
    foot, length = column.number("foot") if "foot" in column else 0.0, column.number("length")
    return None if foot is None or length is None else (foot, foot + length)


def carriage_off_the_column(given: Given) -> Iterator[Conflict]:
    """Neither its ends of way nor a scene's height are below the floor, below the column's foot or above its head."""
    ends, carriage = ends_of_column(given), given.block("carriage")
    if ends is None or carriage is None:
        return
    foot, head = ends
    for key in ("lowest", "highest"):
        yield from _off(("carriage", key), carriage.number(key) if key in carriage else None, foot, head)
    low = carriage.number("lowest") if "lowest" in carriage else foot
    high = carriage.number("highest") if "highest" in carriage else head
    least, most = (foot if low is None else max(low, foot)), (head if high is None else min(high, head))
    for index, scene in enumerate(given.blocks("scenes")):
        if scene is None or "height" not in scene:
            continue
        height = scene.number("height")
        path = ("scenes", index, str(scene.raw.get("type")), "height")
        wrong = list(_off(path, height, foot, head))
        yield from wrong
        if height is not None and not wrong and least < most and not least <= height <= most:
            reason = f"the carriage cannot reach this height: its path is from {_m(least)} to {_m(most)}"
            yield Conflict(path, reason, f"write `height: {_m(most if height > most else least)}`")


def _m(length: float) -> str:
    return units.show(length, units.SPAN, 4)


def _off(path: tuple[str | int, ...], height: float | None, foot: float, head: float) -> Iterator[Conflict]:
    if height is None or foot <= height <= head:
        return
    key = path[-1]
    if height < foot:
        below = "floor" if foot == 0 else "mast"
        reason = f"the carriage is below the {below}: the mast starts at {_m(foot)}"
        yield Conflict(path, reason, f"write `{key}: {_m(foot)}` or more")
    else:
        reason = f"the carriage is above the mast head at {_m(head)}"
        yield Conflict(path, reason, f"write `{key}: {_m(head)}` or less")


_BUFFERS = "buffers: {type: linear, count: 2, stiffness: 200 kN/m, stroke: 200 mm}"
_NEEDED = {
    "obstacle": ("obstacle", "obstacle: {contact: elastic, stiffness: 30 MN/m}"),
    "fork_push": (
        "fork",
        "fork: {mass: 400 kg, speed: 0.3 m/s, motor_force: 3 kN}",
    ),
    "safety_gear": ("safety_gear", "safety_gear: {type: progressive, force: 30 kN, stroke: 300 mm}"),
    "rail": ("rail", "rail: {step: 1 mm}"),
}
_OF_THE_OTHER = {"overhead_stacker": ("fork_push", "rail", "safety_gear"), "rack_stacker": ("obstacle",)}
"""Scenes that only the other type has."""
MECHANISMS = {"bridge": "bridge_travel", "trolley": "trolley_travel", "rotation": "rotation", "travel": "travel"}
"""The key of a file that a mechanism is described by."""

_MECHANISM_EXAMPLE = {
    "bridge_travel": "bridge_travel: {speed: 1 m/s, driving_force: 8 kN, braking_force: 9 kN}",
    "trolley_travel": "trolley_travel: {speed: 0.5 m/s, driving_force: 3 kN, braking_force: 3 kN}",
    "rotation": "rotation: {speed: 4 rpm, inertia: 4000 kg*m^2, driving_torque: 1500 N*m, braking_torque: 1500 N*m}",
    "travel": "travel: {speed: 2 m/s, acceleration: 0.4 m/s^2, deceleration: 0.4 m/s^2}",
}


def scenes_that_lack(given: Given) -> Iterator[Conflict]:
    """A scene has the block it is about; the mechanism that moves is there, and so is what starts it or stops it."""
    for index, scene in enumerate(given.blocks("scenes")):
        what = scene.raw.get("type") if scene else None
        if scene is None or not isinstance(what, str):
            continue
        here = ("scenes", index)
        if what in _OF_THE_OTHER.get(str(given.raw.get("type")), ()):
            continue  # its word is refused already
        if what in _NEEDED:
            key, example = _NEEDED[what]
            if key not in given:
                yield Conflict(here, f"the scene `{what}` needs the block `{key}`", f"add `{example}`")
        if what == "rail":
            yield from _even_rail(given, here)
        if what == "fork_caught":
            yield from _hoist_without_drive(given, here)
        if what in ("start", "brake", "obstacle", "buffer"):
            yield from _mechanism(given, scene, what, here)


def _even_rail(given: Given, here: tuple[str | int, ...]) -> Iterator[Conflict]:
    rail = given.block("rail")
    if rail is None or "rail" not in given or "waviness" in rail:
        return
    if not rail.number("step") and not rail.number("gap"):
        yield Conflict(here, "the rail has neither `step` nor `gap` nor `waviness`", "add `rail: {step: 1 mm}`")


def _hoist_without_drive(given: Given, here: tuple[str | int, ...]) -> Iterator[Conflict]:
    hoisting = given.block("hoisting")
    if hoisting is None or "hoisting" not in given:
        return
    if "drive" not in hoisting:
        yield Conflict(
            here, "the scene `fork_caught` needs the `hoisting.drive`", "add `drive: {reduced_mass: 9 t}` to `hoisting`"
        )
    rope = hoisting.block("rope")
    if rope is not None and "rope" in hoisting and "stiffness" not in rope and "area" not in rope:
        hint = "add `stiffness: 900 kN/m` to `hoisting.rope`"
        yield Conflict(here, "the scene `fork_caught` needs the stiffness of the `hoisting.rope`", hint)


def _mechanism(given: Given, scene: Given, what: str, here: tuple[str | int, ...]) -> Iterator[Conflict]:
    rack = given.raw.get("type") == "rack_stacker"
    word = scene.raw.get("mechanism") or ("travel" if rack else "bridge")
    if not isinstance(word, str) or word not in MECHANISMS:
        return  # its form is refused already
    path = (*here, what, "mechanism")
    own = ("travel",) if rack else ("bridge", "trolley", "rotation")
    if word not in own:
        name = "a rack stacker" if rack else "an overhead stacker"
        yield Conflict(path, f"{name} has no mechanism `{word}`", f"write `mechanism: {own[0]}`")
        return
    if word == "rotation" and what in ("obstacle", "buffer"):
        return  # the scene's own list of words says so
    key = MECHANISMS[word]
    block = given.block(key)
    if key not in given:
        yield Conflict(
            here, f"the scene `{what}` of the {word} needs the block `{key}`", f"add `{_MECHANISM_EXAMPLE[key]}`"
        )
        return
    if block is None or word == "rotation":
        return
    if what == "buffer" and "buffers" not in block:
        yield Conflict(here, f"the scene `buffer` needs the `buffers` of `{key}`", f"add `{_BUFFERS}` to `{key}`")
    pushes = what == "start" or (what in ("obstacle", "buffer") and scene.word("drive") == "on")
    if pushes and not any(name in block for name in ("acceleration", "driving_force", "drive")):
        hint = f"add `driving_force: 8 kN` to `{key}`, or its `acceleration`"
        yield Conflict(here, f"the {word} has no drive", hint)
