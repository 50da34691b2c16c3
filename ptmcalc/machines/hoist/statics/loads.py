"""Loads of steady hoisting and lowering: rope and drum."""

from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.machines.hoist.machine.spec import Hoist

OF_THE_ROPE = (
    LoadInfo("reeving_efficiency", "reeving efficiency", units.RATIO),
    LoadInfo("rope_pull_max", "rope pull at drum, hoisting", units.FORCE, governing=True),
    LoadInfo("rope_pull_lowering", "rope pull at drum, lowering", units.FORCE),
    LoadInfo("rope_pull_empty", "minimum fall tension, lowering empty hook", units.FORCE, headline=False),
    LoadInfo("rope_pull_fall", "fall tension at upper end, hoisting", units.FORCE, headline=False),
    LoadInfo("rope_safety", "rope safety factor Z_p", units.RATIO, governing=True),
    LoadInfo("rope_length", "rope length, hook at lowest", units.SPAN),
    LoadInfo("rope_speed", "rope speed, first layer", units.SPEED),
    LoadInfo("rope_stiffness", "rope stiffness at hook", units.STIFFNESS),
    LoadInfo("static_stretch", "static rope elongation at hook", units.LENGTH),
    LoadInfo("drum_ratio", "drum ratio D/d (h1)", units.RATIO, governing=True),
    LoadInfo("sheave_ratio", "sheave ratio D/d (h2)", units.RATIO),
    LoadInfo("equaliser_ratio", "equalising sheave ratio D/d (h3)", units.RATIO, headline=False),
)
OF_THE_DRUM = (
    LoadInfo("hook_speed", "hook speed, first layer", units.SPEED),
    LoadInfo("hook_speed_max", "hook speed, last layer", units.SPEED),
    LoadInfo("drum_speed", "drum speed", units.ANGULAR_SPEED),
    LoadInfo("drum_turns", "wraps on drum, hook at highest", units.RATIO),
    LoadInfo("drum_layers", "number of rope layers", units.RATIO, governing=True),
    LoadInfo("drum_length_required", "required drum length", units.LENGTH, governing=True),
    LoadInfo("drum_capacity_nested", "drum rope capacity, nested layers", units.SPAN, headline=False),
    LoadInfo("drum_capacity_square", "drum rope capacity, square layers", units.SPAN, headline=False),
    LoadInfo("drum_slenderness", "drum slenderness L/D", units.RATIO),
    LoadInfo("flange_margin", "flange height above top layer / d", units.RATIO),
    LoadInfo("dead_wraps", "dead wraps", units.RATIO, headline=False),
    LoadInfo("fleet_angle", "fleet angle at drum", units.ANGLE),
    LoadInfo("hoop_stress", "drum shell hoop stress", units.STRESS),
    LoadInfo("layer_speed", "hook speed on layer", units.SPEED, headline=False),
    LoadInfo("layer_torque", "drum torque at start of layer, hoisting", units.TORQUE, headline=False),
    LoadInfo("layer_pull", "rope pull on layer at first-layer torque", units.FORCE, headline=False),
    LoadInfo("torque_drum", "drum torque, hoisting", units.TORQUE, governing=True),
)

LAYERED = frozenset({"layer_speed", "layer_torque", "layer_pull"})


def parts(spec: Hoist) -> Iterator[LoadInfo]:
    """Those of one hoist: fall by fall of a rope, the drum's first; layer by layer of the drum."""
    for info in (*OF_THE_ROPE, *OF_THE_DRUM):
        if info.name == "rope_pull_fall":
            yield from (info.of(str(fall)) for fall in range(1, spec.reeving.falls // spec.reeving.ropes + 1))
        elif info.name in LAYERED:
            yield from (info.of(str(layer)) for layer in range(1, spec.drum.layers + 1))
        else:
            yield info
