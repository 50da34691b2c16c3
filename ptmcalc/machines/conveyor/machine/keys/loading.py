"""Loading points as a designer writes them: where material comes on the belt, and how much."""

import difflib
from collections.abc import Iterator
from typing import Annotated, Any

from ptmcalc.base import units
from ptmcalc.machines.conveyor.machine.keys.resistance import Skirt
from ptmcalc.spec.fields import MassFlow, SignedSpeed, Span
from ptmcalc.spec.fragment import Conflict, Fragment, Given
from ptmcalc.spec.optional import Absent
from ptmcalc.spec.shape import keys_of, meant_key

MOST_POINTS = 6
"""Loading points of a file [1]. An engineering choice: each doubles the number of loads that a place can carry, which
horizontal curves and skirt plates try one by one. A larger value takes longer."""
_KEY = "loading_points"
NEAR = 1e-3
"""Distance of two places along the route below which they are one [m]. A numerical choice: a smaller value leaves
lengths of belt by rounding; a larger one moves the change of a load."""


class LoadingPoint(Fragment):
    """A hopper, a chute or a transfer from another conveyor."""

    at: Span
    """distance from the tail pulley along the route"""
    capacity: MassFlow
    """mass flow of this point"""
    speed: Annotated[SignedSpeed, Absent("material without speed along the belt requires the largest force")] = 0.0
    """speed component of the material along the belt at loading"""
    skirt: Skirt | None = None
    """skirt plates from this point on; with `density`"""


def contradictory_points(given: Given) -> Iterator[Conflict]:
    """Points have capacities and places of their own; skirt plates feel how high the load stands."""
    points = _points(given)
    for key in ("capacity", "mass"):
        if key in given and points:
            reason = "the `loading_points` have capacities of their own"
            yield Conflict((key,), reason, f"delete `{key}`, or `loading_points`")
    places: dict[str, float] = {}
    for name, place in sorted(_places(points).items(), key=lambda one: one[1]):
        same = next((other for other, at in places.items() if abs(place - at) < NEAR), None)
        if same is not None:
            reason = f"it is at the place of `{same}`"
            hint = "write another `at`, or one point with the sum of both capacities"
            yield Conflict(("loading_points", name, "at"), reason, hint)
        places[name] = place
    if "density" in given or "surcharge_angle" in given:  # that it is missing is said already
        return
    for name, point in points.items():
        if isinstance(point, dict) and "skirt" in point:
            reason = "`skirt` plates require the bulk density: it is missing"
            yield Conflict(("loading_points", name, "skirt"), reason, "add `density: 1600 kg/m^3` under `load`")


def misplaced_points(given: Given, length: float | None) -> Iterator[Conflict]:
    """Points stand on the route, scenes name those that there are, and forces of the load stand at the points."""
    load, resistance = given.block("load"), given.block("resistance")
    points = _points(load) if load else {}
    for name, place in _places(points).items():
        if length is not None and place > length - NEAR:
            reason = f"the route ends at {units.show(length, units.SPAN)}: no belt is left for the material"
            hint = f"write a smaller distance from the tail pulley, as `at: {units.show(length / 2, units.SPAN)}`"
            yield Conflict(("load", "loading_points", name, "at"), reason, hint)
    forces = resistance.raw.get("forces") if resistance else None
    for name, force in forces.items() if points and isinstance(forces, dict) else ():
        for key in ("skirt", "loading"):
            if isinstance(force, dict) and key in force:
                hint = (
                    "write `skirt` under a loading point" if key == "skirt" else "write `speed` under a loading point"
                )
                reason = f"with `loading_points` the force of `{key}` is at each of them"
                yield Conflict(("resistance", "forces", name, key), reason, f"delete it, and {hint}")
    for index, scene in enumerate(given.blocks("scenes")):
        if scene is not None and "loading_points" in scene:
            yield from _named(scene, ("scenes", index, str(scene.raw.get("type"))), list(map(str, points)))


def _named(scene: Given, path: tuple[str | int, ...], points: list[str]) -> Iterator[Conflict]:
    """Faults of the names in a scene."""
    named = scene.raw.get("loading_points")
    named = named if isinstance(named, list) else []
    if not points:
        reason = "the `load` of the file has no `loading_points`"
        yield Conflict((*path, "loading_points"), reason, "write `load: full`, or add `loading_points` under `load`")
        return
    if scene.word("load") == "empty":
        reason = "an empty belt has no loading point in operation"
        yield Conflict((*path, "loading_points"), reason, "delete it, or write `load: full`")
    for place, name in enumerate(named):
        if str(name) not in points:
            close = (difflib.get_close_matches(str(name), points, 1, 0.0) or points)[0]
            reason = f"the load has no loading point `{name}`"
            yield Conflict((*path, "loading_points", place), reason, f"write `{close}`")
        elif name in named[:place]:
            yield Conflict((*path, "loading_points", place), f"`{name}` is named twice", "delete one of both")


def _points(load: Given) -> dict[str, Any]:
    """The points of a file as it gives them, by name; a misspelt key counts as the intended one."""
    written = [key for key in load.raw if key == _KEY or (key not in keys_of(load.model) and _means_points(load, key))]
    points = load.raw[written[0]] if written else None
    return {str(name): point for name, point in points.items()} if isinstance(points, dict) else {}


def _means_points(load: Given, key: str) -> bool:
    return meant_key(str(key), load.model) == _KEY


def _places(points: dict[str, Any]) -> dict[str, float]:
    """Places of the points as far as they are given [m]."""
    found = {name: Given(LoadingPoint, point).number("at") for name, point in points.items() if isinstance(point, dict)}
    return {name: place for name, place in found.items() if place is not None}
