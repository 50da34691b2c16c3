"""Hoisting and lowering at an even speed: rope, drum, torques, brake, heat."""

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, Result, of
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import hoisting, reeving, rope_drum, wire_rope
from ptmcalc.machines.hoist.drive.loads import OF_THE_CLASS, OF_THE_DRIVE
from ptmcalc.machines.hoist.drive.solver import of_the_drive, of_the_use
from ptmcalc.machines.hoist.machine import model
from ptmcalc.machines.hoist.machine.model import filled
from ptmcalc.machines.hoist.machine.spec import Hoist, HoistScene, Run
from ptmcalc.machines.hoist.statics.loads import OF_THE_DRUM, OF_THE_ROPE

Numbers = dict[str, float]


def run(spec: Hoist, scene: HoistScene, carried: frozenset[str], level: int) -> Result:
    """Loads of steady hook motion, at the worst height of the lift if the scene gives none.

        S = (Q + G) g/(m eta_r) with the weight of the rope,   M = S R_k of the layer k,   M_m = M/(u eta), M eta_r/u

    **Range** vertical falls, a rope that runs freely over its sheaves; steady motion.
    **Error** exact for that model; the report lists the assumptions. The rms torque uses the maximum static torque of
    the lift throughout: on the safe side by the increase of the radius over the layers.
    **Source** equilibrium of every sheave (`laws.reeving`), geometry of the drum (`laws.rope_drum`), power balance of
    the gearbox (`laws.gearing`), IEC 60034-1 and ISO 4301-1 (`laws.duty`, `laws.classification`).
    """
    loads = _of_the_rope(spec, scene) | _of_the_drum(spec, scene)
    found = {name: Found(Estimate.exact(value)) for name, value in loads.items()}
    found |= {name: Found(Estimate.exact(value)) for name, value in _part_by_part(spec, scene).items()}
    return Result(found | of_the_drive(spec, scene) | of_the_use(spec), work=1)


def _of_the_rope(spec: Hoist, scene: HoistScene) -> Numbers:
    mass, height = model.hook_mass(spec, scene), model.hook_height(scene)
    given, d = spec.reeving, spec.rope.diameter
    tackle = reeving.tackle_efficiency(model.falls_of_a_rope(spec), filled(given.sheave_efficiency))
    stiffness = model.hook_stiffness(spec, height)
    pull = model.pulls(spec, mass, height, hauling=True).drum
    loads = {
        "reeving_efficiency": tackle * model.deflection_efficiency(spec),
        "rope_pull_max": pull,
        "rope_pull_lowering": model.pulls(spec, mass, height, hauling=False).drum,
        "rope_pull_empty": model.pulls(spec, spec.hook_block, height, hauling=False).least,
        "rope_length": model.rope_length(spec, height),
        "rope_speed": model.drum_speed(spec) * model.layer_radius(spec, 1),
        "rope_stiffness": stiffness,
        "static_stretch": mass * spec.gravity / stiffness,
        "drum_ratio": spec.drum.diameter / d + 1,
    }
    if mass > 0:
        loads["natural_frequency"] = model.load_frequency(spec, mass, height)
    if spec.rope.breaking_force is not None:
        loads["rope_safety"] = wire_rope.rope_safety(spec.rope.breaking_force, pull)
    if given.sheave_diameter is not None:
        loads["sheave_ratio"] = given.sheave_diameter / d + 1
    if given.equaliser_diameter is not None:
        loads["equaliser_ratio"] = given.equaliser_diameter / d + 1
    return loads


def _of_the_drum(spec: Hoist, scene: HoistScene) -> Numbers:
    drum, d, highest = spec.drum, spec.rope.diameter, model.wound(spec, spec.height)
    required = rope_drum.drum_length_required(
        highest.length,
        drum.diameter,
        d,
        model.pitch(spec),
        drum.layers,
        model.layer_step(spec),
        spec.winding.packing,
    )
    loads = {
        "hook_speed": model.hook_speed(spec),
        "hook_speed_max": model.hook_speed(spec, layer=highest.layers),
        "drum_speed": model.drum_speed(spec),
        "drum_turns": highest.turns,
        "drum_layers": float(highest.layers),
        "drum_length_required": required,
        "drum_capacity_nested": model.capacity(spec, drum.layers, rope_drum.NESTED),
        "drum_capacity_square": model.capacity(spec, drum.layers, rope_drum.SQUARE),
        "drum_slenderness": spec.reeving.ropes * drum.length / drum.diameter,
        "dead_wraps": drum.dead_wraps,
        "torque_drum": model.drum_torque(spec, model.hook_mass(spec, scene), scene.hook_height, hauling=True),
    }
    if drum.flange_height is not None:
        last = highest.radius + d / 2 - drum.diameter / 2
        loads["flange_margin"] = (drum.flange_height - last) / d
    angle = model.fleet_angle(spec)
    if angle is not None:
        loads["fleet_angle"] = angle
    factor = model.layer_factor(spec)
    if drum.shell_thickness is not None and factor is not None:
        loads["hoop_stress"] = rope_drum.hoop_stress(
            model.pulls(spec, spec.hook_block + spec.load, 0.0, hauling=True).drum,
            model.pitch(spec),
            drum.shell_thickness,
            factor,
        )
    return loads


def _part_by_part(spec: Hoist, scene: HoistScene) -> Numbers:
    """Pulls of the falls; speed, torque and pull layer by layer."""
    mass = model.hook_mass(spec, scene)
    falls = model.fall_pulls(spec, mass, model.hook_height(scene), hauling=True)
    loads = {of("rope_pull_fall", str(fall)): float(pull) for fall, pull in enumerate(falls, 1)}
    first = model.pulls(spec, mass, 0.0, hauling=True).drum
    for layer, height in enumerate(model.layer_heights(spec)[: spec.drum.layers], 1):
        radius, name = model.layer_radius(spec, layer), str(layer)
        pull = model.pulls(spec, mass, height, hauling=True).drum
        loads[of("layer_speed", name)] = model.hook_speed(spec, layer=layer)
        loads[of("layer_torque", name)] = hoisting.drum_torque(pull, spec.reeving.ropes, radius)
        loads[of("layer_pull", name)] = first * model.layer_radius(spec, 1) / radius
    return loads


HOIST_STATICS: Solver[Hoist, HoistScene] = Solver(
    name="hoist_statics",
    title="steady hoisting: rope, drum, torque, brake, heating",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Run}),
    represents=frozenset(),
    gives=frozenset(info.name for info in (*OF_THE_ROPE, *OF_THE_DRUM, *OF_THE_DRIVE, *OF_THE_CLASS))
    | {"natural_frequency"},
    run=run,
    cost=lambda spec, scene, carried, level: 1e-3,
    source="balance of every sheave; geometry of the drum; power balance of the gearbox; IEC 60034-1; ISO 4301-1",
)
