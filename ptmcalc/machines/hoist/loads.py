"""The loads a hoist can report."""

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo

STATIC = (
    LoadInfo("reeving_efficiency", "efficiency of tackle and deflection sheaves", units.RATIO),
    LoadInfo("rope_pull_max", "rope pull at the drum, hoisting", units.FORCE, governing=True),
    LoadInfo("rope_pull_lowering", "rope pull at the drum, lowering", units.FORCE),
    LoadInfo("rope_length", "rope from drum to its end, hook lowest", units.SPAN),
    LoadInfo("rope_speed", "rope speed, first layer", units.SPEED),
    LoadInfo("hook_speed", "hook speed, first layer", units.SPEED),
    LoadInfo("hook_speed_max", "hook speed, last layer", units.SPEED),
    LoadInfo("rope_stiffness", "stiffness of the rope at the hook", units.STIFFNESS),
    LoadInfo("static_stretch", "stretch of the rope at the hook", units.LENGTH),
    LoadInfo("drum_turns", "turns on the drum, hook highest", units.RATIO),
    LoadInfo("drum_layers", "layers on the drum", units.RATIO, governing=True),
    LoadInfo("drum_length_required", "length of drum that the rope needs", units.LENGTH, governing=True),
    LoadInfo("torque_drum", "torque at the drum, hoisting", units.TORQUE, governing=True),
)

LOADS = STATIC
