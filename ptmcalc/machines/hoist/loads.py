"""The loads a hoist can report."""

from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.machines.hoist.motion.loads import MOTION
from ptmcalc.machines.hoist.spec import Hoist

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
OF_THE_DRIVE = (
    LoadInfo("motor_speed", "motor speed", units.ANGULAR_SPEED),
    LoadInfo("torque_motor_static_up", "motor torque, steady hoisting", units.TORQUE, governing=True),
    LoadInfo("torque_motor_static_down", "motor torque, steady lowering", units.TORQUE),
    LoadInfo("power_hoisting", "motor power, steady hoisting", units.POWER, governing=True),
    LoadInfo("starting_reserve", "starting torque reserve", units.RATIO, governing=True),
    LoadInfo("overhauling_reserve", "motor braking torque reserve", units.RATIO),
    LoadInfo("start_time", "hoisting start time, rigid model", units.TIME),
    LoadInfo("torque_motor_rms", "motor torque, rms", units.TORQUE, governing=True),
    LoadInfo("heating_utilisation", "thermal utilisation (rms torque)", units.SHARE, governing=True),
    LoadInfo("start_heat", "rotor heat per start, one motor", units.ENERGY),
    LoadInfo("starts_per_hour", "starts per hour", units.RATIO, headline=False),
    LoadInfo("brake_torque_static", "load torque at brake shaft, lowering", units.TORQUE),
    LoadInfo("brake_reserve_static", "brake holding torque reserve", units.RATIO, governing=True),
    LoadInfo("drop_distance", "load drop with brake applied", units.SPAN, governing=True),
    LoadInfo("drop_speed", "load speed at end of drop", units.SPEED),
)
OF_THE_CLASS = (
    LoadInfo("equivalent_load_share", "equivalent / rated load", units.RATIO, headline=False),
    LoadInfo("spectrum_factor", "load spectrum factor", units.RATIO, headline=False),
    LoadInfo("mechanism_group", "required mechanism group, M", units.RATIO, headline=False),
    LoadInfo("crane_group", "required crane group, A", units.RATIO, headline=False),
)
OF_THE_WINDING = (
    LoadInfo("winding_frequency", "natural frequency of load on rope", units.ANGULAR_FREQUENCY, governing=True),
    LoadInfo("winding_displacement_max", "dynamic rope elongation, maximum", units.LENGTH),
    LoadInfo("winding_stress_max", "dynamic rope stress, maximum", units.STRESS, governing=True),
    LoadInfo("winding_stress_ratio", "dynamic / mean rope stress", units.RATIO, governing=True),
    LoadInfo("winding_crossover_ratio", "crossover / natural frequency", units.RATIO),
    LoadInfo("winding_detuning", "crossover separation, minimum", units.RATIO),
)
OF_THE_PAPER = (
    LoadInfo("winding_displacement_paper", "rope elongation, published formula", units.LENGTH, headline=False),
    LoadInfo("winding_stress_paper", "rope stress, published formula", units.STRESS, headline=False),
)
STATIC = (*OF_THE_ROPE, *OF_THE_DRUM, *OF_THE_DRIVE, *OF_THE_CLASS)

LOADS = (*STATIC, *MOTION, *OF_THE_WINDING, *OF_THE_PAPER)

LAYERED = frozenset({"layer_speed", "layer_torque", "layer_pull"})


def parts(spec: Hoist) -> Iterator[LoadInfo]:
    """The loads of one hoist: fall by fall of a rope, the drum's first; layer by layer of the drum."""
    for info in LOADS:
        if info.name == "rope_pull_fall":
            yield from (info.of(str(fall)) for fall in range(1, spec.reeving.falls // spec.reeving.ropes + 1))
        elif info.name in LAYERED:
            yield from (info.of(str(layer)) for layer in range(1, spec.drum.layers + 1))
        else:
            yield info
