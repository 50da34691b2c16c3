"""Stresses of column and girders, and what keeps a rack stacker upright: weights and the load of an event together.

The peaks of an event are taken as if they came at the same moment, towards the side where they are worst.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from ptmcalc.laws import overturning
from ptmcalc.machines.crane.stacking.machine import columns, model
from ptmcalc.machines.crane.stacking.machine.overhead import OverheadStacker
from ptmcalc.machines.crane.stacking.machine.rack import RackStacker
from ptmcalc.machines.crane.stacking.machine.scenes import Brake, ForkPush, ObstacleScene, StackerScene, Start
from ptmcalc.machines.crane.stacking.machine.spec import Stacker


@dataclass(frozen=True, slots=True)
class Event:
    """What an event adds to the weights: on the root of the column, and on what holds it."""

    along: float = 0.0
    """moment at the root along the travel of bridge or base [N*m]"""
    across: float = 0.0
    """moment at the root across it [N*m]"""
    axial: float = 0.0
    """pull or push of the column [N]"""
    force: float = 0.0
    """of the column on what holds it, along or across with the moment [N]"""
    hung: float = 0.0
    """more weight on the trolley than stands there [N]"""
    deceleration: float = 0.0
    """of what holds the column, at most [m/s^2]"""


def event(spec: Stacker, scene: StackerScene, loads: Mapping[str, float]) -> Event | None:
    """What the loads of a run add to the weights; None where they do not say."""
    return _OF[scene.type](spec, scene, loads) if scene.type in _OF else None


def _standing(spec: Stacker, scene: StackerScene, loads: Mapping[str, float]) -> Event:
    return Event()


def _swinging(spec: Stacker, scene: StackerScene, loads: Mapping[str, float]) -> Event | None:
    """A column that swings: the moment at its root, the force on it, and how hard its base is stopped by both."""
    moment = loads.get("mast_moment_max")
    force = loads.get("collision_force", loads.get("mast_force_max"))
    if moment is None or force is None or not (math.isfinite(moment) and math.isfinite(force)):
        return None
    moment, force = max(moment, 0.0), max(force, 0.0)  # ends of bars that no largest value reaches
    across = model.direction(spec, scene) == "across"
    hard = _deceleration(spec, scene, force)
    force *= _whole_inertia(spec, scene)
    return Event(0.0 if across else moment, moment if across else 0.0, 0.0, force, 0.0, hard)


def _whole_inertia(spec: Stacker, scene: StackerScene) -> float:
    """Inertia of column and load at the root over the force that bends the far end, of a base that is accelerated."""
    if isinstance(scene, ObstacleScene):
        return 1.0  # the far end is held: less arrives at the root
    _, coupling, tip = columns.swinging(spec, scene).masses
    return (spec.column.mass + model.climbing_mass(spec, scene)) / (coupling + tip)


def _deceleration(spec: Stacker, scene: StackerScene, force: float) -> float:
    """Of the base while brake or drive and the column act on it the same way [m/s^2]."""
    if not isinstance(scene, Start | Brake):
        return force / model.base_mass(spec, scene)
    push = model.stopping(spec, scene) if isinstance(scene, Brake) else model.driving(spec, scene)
    if push.kind == "ramp":
        return push.size
    return (push.size + force) / model.base_mass(spec, scene, push.rotors)


def _pushing(spec: Stacker, scene: StackerScene, loads: Mapping[str, float]) -> Event | None:
    """The rack pushes back at the fork, across the aisle."""
    force = loads.get("fork_push_force")
    return None if force is None else Event(across=force * model.carriage_place(spec, scene), force=force)


def _caught(spec: Stacker, scene: StackerScene, loads: Mapping[str, float]) -> Event | None:
    """The rack holds the fork down where the load lies; of a standing column the ropes pull its head down."""
    force, rack = loads.get("rope_force_caught"), loads.get("rack_force")
    if force is None or rack is None:
        return None
    carriage, weight = spec.carriage, model.weight(spec, scene)
    more = 0.0 if model.hangs(spec) else (force - weight) * _pulls(spec)
    return Event(
        abs(rack * carriage.load_arm), abs(rack * carriage.load_arm_across), axial=more, hung=max(force - weight, 0.0)
    )


def _caught_by_the_gear(spec: Stacker, scene: StackerScene, loads: Mapping[str, float]) -> Event | None:
    """The gear grips the column beside its axis and stops what leans with as many times its weight, without ropes.

    Along, the larger of the two moments counts: the gear's force on its arm, or what leans with its inertia.
    """
    force, gear = loads.get("safety_gear_force"), spec.safety_gear
    if force is None or gear is None:
        return None
    weight = model.weight(spec, scene)
    along, aside = _leaning(spec, scene)
    times = max(force / weight, 1.0)
    return Event(
        max(force * abs(gear.arm), times * along) - along, (times - 1) * aside, axial=force - weight * _pulls(spec)
    )


_OF = {
    "stand": _standing,
    "start": _swinging,
    "brake": _swinging,
    "obstacle": _swinging,
    "buffer": _swinging,
    "rail": _swinging,
    "fork_push": _pushing,
    "fork_caught": _caught,
    "safety_gear": _caught_by_the_gear,
}


def _pulls(spec: Stacker) -> float:
    """Force on the head of a standing column over the weight of what climbs: its falls, and the lead to the drum."""
    rope = spec.hoisting.rope
    return 1 + rope.ropes / rope.falls


def _leaning(spec: Stacker, scene: StackerScene) -> tuple[float, float]:
    """Moments of weights beside the column's axis, along and across, without sign [N*m]."""
    along, across = (model.eccentric_moment(spec, scene, "along"), model.eccentric_moment(spec, scene, "across"))
    return abs(along), abs(across)


# -- stresses -------------------------------------------------------------------------------------------------------


def column_stress(spec: Stacker, scene: StackerScene, happens: Event) -> float | None:
    """At the root: bending both ways, pull or push; None without a section modulus [Pa]."""
    parts = column_stresses(spec, scene, happens)
    return sum(parts.values()) if parts else None


def column_stresses(spec: Stacker, scene: StackerScene, happens: Event) -> dict[str, float]:
    """The same by the key of the column that each share goes by; nothing without a section modulus [Pa]."""
    column = spec.column
    if column.section_modulus is None:
        return {}
    leans, leans_across = _leaning(spec, scene)
    along, aside = leans + happens.along, leans_across + happens.across
    if column.section_modulus_across is None:
        parts = {"section_modulus": (along + aside) / column.section_modulus / column.count}
    else:
        parts = {
            "section_modulus": along / column.section_modulus / column.count,
            "section_modulus_across": aside / column.section_modulus_across / column.count,
        }
    if column.area is not None:
        own = column.mass * spec.gravity
        standing = 0.0 if model.hangs(spec) else model.weight(spec, scene) * _pulls(spec)
        parts["area"] = abs(own + standing + happens.axial) / (column.area * column.count)
    return parts


def bridge_stress(spec: Stacker, scene: StackerScene, happens: Event) -> float | None:
    """Of the girder that bears more, under the trolley: as girders whose ends turn, which clamped ones never exceed;
    None without section moduli [Pa]."""
    parts = bridge_stresses(spec, scene, happens)
    return sum(parts.values()) if parts else None


def bridge_stresses(spec: Stacker, scene: StackerScene, happens: Event) -> dict[str, float]:
    """The same by the key of the bridge that each share goes by; nothing without section moduli [Pa]."""
    if not isinstance(spec, OverheadStacker):
        return {}
    bridge, x = spec.bridge, model.trolley_place(spec)
    vertical, horizontal = bridge.section_modulus_vertical, bridge.section_modulus_horizontal
    if vertical is None or horizontal is None:
        return {}
    sag = x * (bridge.span - x) / bridge.span
    hung = (spec.trolley.mass + spec.column.mass) * spec.gravity + model.weight(spec, scene) + happens.hung
    leans, leans_across = _leaning(spec, scene)
    couple, along_girders = leans + happens.along, leans_across + happens.across
    own = bridge.mass / 2 * spec.gravity * sag / 2
    down = (hung / 2 + couple / spec.trolley.gauge) * sag + own + along_girders / 2 * (1 - x / bridge.span)
    aside = 0.0
    if model.direction(spec, scene) == "along":
        pushed = happens.force + spec.trolley.mass * happens.deceleration
        aside = (pushed / 2 + bridge.mass / 2 * happens.deceleration / 2) * sag
    return {"section_modulus_vertical": down / vertical, "section_modulus_horizontal": aside / horizontal}


# -- upright --------------------------------------------------------------------------------------------------------


def stability(spec: Stacker, scene: StackerScene, happens: Event) -> dict[str, float]:
    """Of a rack stacker: what holds over what tips, along the rail and across the aisle, where anything tips."""
    if not isinstance(spec, RackStacker) or scene.type not in ("stand", "start", "brake", "fork_push"):
        return {}
    tips = isinstance(scene, Start | Brake) or model.eccentric_moment(spec, scene, "along") != 0
    leans = isinstance(scene, ForkPush) or model.eccentric_moment(spec, scene, "across") != 0
    sides = {
        "along": _along(spec, scene, happens) if tips else None,
        "across": _across(spec, scene, happens) if leans else None,
    }
    return {side: reserve for side, reserve in sides.items() if reserve is not None}


def _along(spec: RackStacker, scene: StackerScene, happens: Event) -> float:
    base, g = spec.base, spec.gravity
    column = base.column if base.column is not None else base.wheel_base / 2
    centre = base.centre if base.centre is not None else base.wheel_base / 2
    weights = [base.mass * g, spec.column.mass * g, model.weight(spec, scene)]
    places = [centre, column, column]
    leans = model.eccentric_moment(spec, scene, "along")
    dynamic = float(
        overturning.tipping_moment(
            happens.along,
            happens.force if happens.along else 0.0,
            spec.column.foot or 0.0,
            base.mass * happens.deceleration,
            base.height,
        )
    )
    front = overturning.holding_moment(weights, [base.wheel_base - place for place in places])
    rear = overturning.holding_moment(weights, places)
    return min(
        float(overturning.stability_reserve(front, max(leans, 0.0) + dynamic)),
        float(overturning.stability_reserve(rear, max(-leans, 0.0) + dynamic)),
    )


def _across(spec: RackStacker, scene: StackerScene, happens: Event) -> float | None:
    """Two rails, or the guide at the head, keep it from tipping into a rack."""
    guide = spec.column.top_guide
    held = 0.0
    if spec.base.gauge is not None:
        held += model.total_mass(spec, scene) * spec.gravity * spec.base.gauge / 2
    if guide is not None and guide.rating is not None:
        held += guide.rating * model.ends(spec)[1]
    if held == 0:
        return None
    tips = abs(model.eccentric_moment(spec, scene, "across"))
    tips += happens.across + (happens.force * model.ends(spec)[0] if happens.across else 0.0)
    return float(overturning.stability_reserve(held, tips))
