"""The loads a hoist can report."""

from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.machines.hoist.loads_motion import MOTION
from ptmcalc.machines.hoist.spec import Hoist

OF_THE_ROPE = (
    LoadInfo("reeving_efficiency", "efficiency of tackle and deflection sheaves", units.RATIO),
    LoadInfo("rope_pull_max", "rope pull at the drum, hoisting", units.FORCE, governing=True),
    LoadInfo("rope_pull_lowering", "rope pull at the drum, lowering", units.FORCE),
    LoadInfo("rope_pull_empty", "smallest pull in the tackle, lowering empty", units.FORCE, headline=False),
    LoadInfo("rope_pull_fall", "pull of a fall at its upper end, hoisting", units.FORCE, headline=False),
    LoadInfo("rope_safety", "rope safety Zp", units.RATIO, governing=True),
    LoadInfo("rope_length", "rope from drum to its end, hook lowest", units.SPAN),
    LoadInfo("rope_speed", "rope speed, first layer", units.SPEED),
    LoadInfo("rope_stiffness", "stiffness of the rope at the hook", units.STIFFNESS),
    LoadInfo("static_stretch", "stretch of the rope at the hook", units.LENGTH),
    LoadInfo("drum_ratio", "D/d of the drum", units.RATIO, governing=True),
    LoadInfo("sheave_ratio", "D/d of the sheaves", units.RATIO),
    LoadInfo("equaliser_ratio", "D/d of the equalising sheave", units.RATIO, headline=False),
)
OF_THE_DRUM = (
    LoadInfo("hook_speed", "hook speed, first layer", units.SPEED),
    LoadInfo("hook_speed_max", "hook speed, last layer", units.SPEED),
    LoadInfo("drum_speed", "speed of the drum", units.ANGULAR_SPEED),
    LoadInfo("drum_turns", "turns on the drum, hook highest", units.RATIO),
    LoadInfo("drum_layers", "layers on the drum", units.RATIO, governing=True),
    LoadInfo("drum_length_required", "length of drum that the rope needs", units.LENGTH, governing=True),
    LoadInfo("drum_capacity_nested", "rope the drum takes, layers nested", units.SPAN, headline=False),
    LoadInfo("drum_capacity_square", "rope the drum takes, layers square", units.SPAN, headline=False),
    LoadInfo("drum_slenderness", "L/D of the drum", units.RATIO),
    LoadInfo("flange_margin", "flange over the last layer, in rope diameters", units.RATIO),
    LoadInfo("dead_wraps", "turns that stay on the drum", units.RATIO, headline=False),
    LoadInfo("fleet_angle", "fleet angle at the drum", units.ANGLE),
    LoadInfo("hoop_stress", "hoop stress of the drum shell", units.STRESS),
    LoadInfo("layer_speed", "hook speed, layer", units.SPEED, headline=False),
    LoadInfo("layer_torque", "torque at the drum as a layer begins, hoisting", units.TORQUE, headline=False),
    LoadInfo("layer_pull", "rope pull on a layer by the torque of the first", units.FORCE, headline=False),
    LoadInfo("torque_drum", "torque at the drum, hoisting", units.TORQUE, governing=True),
)
OF_THE_DRIVE = (
    LoadInfo("motor_speed", "speed of the motor", units.ANGULAR_SPEED),
    LoadInfo("torque_motor_static_up", "motor torque, hoisting evenly", units.TORQUE, governing=True),
    LoadInfo("torque_motor_static_down", "motor torque, lowering evenly", units.TORQUE),
    LoadInfo("power_hoisting", "motor power, hoisting evenly", units.POWER, governing=True),
    LoadInfo("starting_reserve", "mean starting torque over that of the load", units.RATIO, governing=True),
    LoadInfo("start_time", "start time upwards, rigid", units.TIME),
    LoadInfo("torque_motor_rms", "heating motor torque (rms)", units.TORQUE, governing=True),
    LoadInfo("heating_utilisation", "heating torque over what the duty allows", units.SHARE, governing=True),
    LoadInfo("start_heat", "heat of a start in the rotor of one motor", units.ENERGY),
    LoadInfo("starts_per_hour", "starts per hour", units.RATIO, headline=False),
    LoadInfo("brake_torque_static", "torque of the lowering load on the brake shaft", units.TORQUE),
    LoadInfo("brake_reserve_static", "brake torque over that of the load", units.RATIO, governing=True),
    LoadInfo("drop_distance", "way the load drops through the closed brake", units.SPAN, governing=True),
    LoadInfo("drop_speed", "speed at the end of it", units.SPEED),
)
OF_THE_CLASS = (
    LoadInfo(
        "equivalent_load_share", "load that tires as much as the spectrum, over the rated", units.RATIO, headline=False
    ),
    LoadInfo("spectrum_factor", "factor of the load spectrum", units.RATIO, headline=False),
    LoadInfo("mechanism_group", "group of the mechanism that its use asks (M)", units.RATIO, headline=False),
    LoadInfo("crane_group", "group of the crane that its use asks (A)", units.RATIO, headline=False),
)
OF_THE_WINDING = (
    LoadInfo("winding_frequency", "natural frequency of the load on its rope", units.ANGULAR_FREQUENCY, governing=True),
    LoadInfo("winding_displacement_max", "largest dynamic stretch of the rope", units.LENGTH),
    LoadInfo("winding_stress_max", "largest dynamic stress of the rope", units.STRESS, governing=True),
    LoadInfo("winding_stress_ratio", "dynamic over mean stress of the rope", units.RATIO, governing=True),
    LoadInfo("winding_crossover_ratio", "crossovers over natural frequency", units.RATIO),
    LoadInfo("winding_detuning", "least distance of the crossovers from resonance", units.RATIO),
)
OF_THE_PAPER = (
    LoadInfo("winding_displacement_paper", "stretch of the rope by the winding paper", units.LENGTH, headline=False),
    LoadInfo("winding_stress_paper", "stress of the rope by the winding paper", units.STRESS, headline=False),
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
