"""What must hold between the blocks of a main shaft.

A path into a block that there are several types of names its type, as pydantic does.
"""

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from ptmcalc.base import units
from ptmcalc.numerics import spline
from ptmcalc.spec.fragment import Conflict, Given

FULL_TURN = units.unit_of("rev")[0]
_SAME = 1e-9
"""Share [1] of the cycle angle up to which two angles are equal. A numerical choice: it is above the rounding of
converted units, about 1e-15. A larger value rejects valid tables; a smaller one accepts a repeated first point."""


def _type_of(block: Given | None) -> object:
    return block.raw.get("type") if block else None


def needing_a_crank(given: Given) -> Iterator[Conflict]:
    """A tool belongs to a slider-crank."""
    if _type_of(given.block("inertia")) in (None, "slider_crank"):
        return
    hint = "write `inertia: {type: slider_crank, ...}`, or give the load over the angle"
    if "load" in given and _type_of(given.block("load")) == "tool_force":
        yield Conflict(("load", "tool_force", "type"), "only a slider-crank has a tool for a force", hint)
    for index, one in enumerate(given.blocks("potential")):
        if _type_of(one) == "tool_spring":
            path = ("potential", index, "tool_spring", "type")
            yield Conflict(path, "only a slider-crank has a tool for a spring", hint)


def not_repeated(given: Given) -> Iterator[Conflict]:
    """Everything comes again after the angle of a cycle."""
    period = given.number("cycle_angle")
    if period is None:
        return
    shown = units.show(period, units.ANGLE)
    hint = "write the period of the whole machine, usually `360 deg`"
    inertia = given.block("inertia")
    for place, block in _tables(given, inertia):
        angles = [point.number("angle") if point else None for point in block.blocks("points")]
        known = [angle for angle in angles if angle is not None]
        if known and max(known) - min(known) >= period * (1 - _SAME):
            reason = f"the points span a cycle of {shown} or more: the first point repeats at the end"
            yield Conflict((*place, "points"), reason, "delete the point at the end of the cycle")
    load = given.block("load") if "load" in given else None
    for index, sector in enumerate(load.blocks("sectors") if load and _type_of(load) == "sectors" else ()):
        ends = (sector.number("from"), sector.number("to")) if sector else (None, None)
        if None not in ends and ends[1] - ends[0] > period * (1 + _SAME):  # type: ignore[operator]
            yield Conflict(("load", "sectors", "sectors", index), f"the sector is wider than a cycle of {shown}", hint)
    for what, order in _orders(given, inertia):
        if not _whole(order * period / FULL_TURN):
            yield Conflict(("cycle_angle",), f"{what} has no period of {shown}", hint)
            return


def _tables(given: Given, inertia: Given | None) -> Iterator[tuple[tuple[str | int, ...], Given]]:
    """Tables over the angle with their paths."""
    if inertia and _type_of(inertia) == "table":
        yield ("inertia", "table"), inertia
    load = given.block("load") if "load" in given else None
    if load and _type_of(load) == "table":
        yield ("load", "table"), load
    for index, one in enumerate(given.blocks("potential")):
        if one and _type_of(one) == "energy":
            yield ("potential", index, "energy"), one


def _orders(given: Given, inertia: Given | None) -> Iterator[tuple[str, int]]:
    """What repeats itself so many times per turn."""
    if inertia and _type_of(inertia) == "slider_crank":
        yield "the slider-crank", 1
    if inertia and _type_of(inertia) == "harmonics":
        for term in inertia.blocks("terms"):
            if term and isinstance(order := term.raw.get("order"), int):
                yield f"the harmonic of order {order}", order
    for one in given.blocks("potential"):
        if one and _type_of(one) == "unbalance":
            yield "the unbalance", 1
        if one and _type_of(one) == "harmonic" and isinstance(order := one.raw.get("order"), int):
            yield f"the harmonic of order {order}", order


def _whole(value: float) -> bool:
    return abs(value - round(value)) <= 1e-6 * max(value, 1.0) and round(value) >= 1


def falling_below_zero(given: Given) -> Iterator[Conflict]:
    """The curve through the points of an inertia may fall below them."""
    inertia, period = given.block("inertia"), given.number("cycle_angle")
    if inertia is None or _type_of(inertia) != "table" or period is None:
        return
    points = [(p.number("angle"), p.number("inertia")) if p else (None, None) for p in inertia.blocks("points")]
    angles, values = ([point[k] for point in points] for k in (0, 1))
    if len(points) < 3 or len(points) > 500 or any(one is None for one in (*angles, *values)):
        return
    places = np.array(angles, float)
    if np.any(np.diff(places) <= 0) or places[-1] - places[0] >= period * (1 - _SAME):
        return
    lowest, _ = spline.through(places, np.array(values, float), period).range
    if lowest <= 0:
        reason = f"the smooth curve through the points decreases to {units.show(lowest, units.INERTIA)} between them"
        hint = "add points where the inertia changes fast: an inertia must be above 0 at every angle"
        yield Conflict(("inertia", "table", "points"), reason, hint)


def scenes_that_lack(given: Given) -> Iterator[Conflict]:
    """A run-up needs a speed to end at, a braked run-out a brake."""
    drive = given.block("drive")
    motor = drive.block("motor") if drive else None
    endless = motor is not None and "drive" in given and _gives_torque_always(motor)
    scenes = given.blocks("scenes")
    reason = "the motor gives torque at every speed: the final speed of the run-up is not defined"
    for index, scene in enumerate(scenes):
        if endless and _type_of(scene) == "run_up" and scene and "to" not in scene:
            yield Conflict(("scenes", index), reason, "add `to: 60 rpm`, a speed of the main shaft")
        if _type_of(scene) == "run_out" and scene and scene.raw.get("brake") == "on" and "brake" not in given:
            path = ("scenes", index, "run_out", "brake")
            yield Conflict(path, "the machine has no brake", "add a `brake:` block, or write `off`")
    if endless and "scenes" not in given:
        hint = "add `scenes: [{type: run_up, to: 60 rpm}, {type: steady}, {type: run_out}]`"
        yield Conflict((), reason, hint)


def _gives_torque_always(motor: Given) -> bool:
    """Whether there is no speed at which the torque falls to 0."""
    if _type_of(motor) == "constant":
        return True
    if _type_of(motor) != "table":
        return False
    torques = [point.number("torque") if point else None for point in motor.blocks("points")]
    if any(torque is None for torque in torques) or len(torques) < 2:
        return False
    return not any(before > 0 >= after for before, after in pairwise(torques))  # type: ignore[operator]
