"""Hoisting and lowering at an even speed: rope, drum, torques."""

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import reeving, rope_drum
from ptmcalc.machines.hoist import model
from ptmcalc.machines.hoist.loads import STATIC
from ptmcalc.machines.hoist.model import filled
from ptmcalc.machines.hoist.spec import Hoist, HoistScene, Run


def run(spec: Hoist, scene: HoistScene, carried: frozenset[str], level: int) -> Result:
    """Loads of a hook that moves evenly.

        S = (Q + G) g/(m eta_r) with the rope's own weight,   M = S R_k of the layer k

    **Range** vertical falls, a rope that runs freely over its sheaves.
    **Error** exact for that model: what is not known of it stands among the assumptions.
    **Source** balance of every sheave (`laws.reeving`), geometry of the drum (`laws.rope_drum`).
    """
    loads = _of_the_rope(spec, scene) | _of_the_drum(spec, scene)
    return Result({name: Found(Estimate.exact(value)) for name, value in loads.items()}, work=1)


def _of_the_rope(spec: Hoist, scene: HoistScene) -> dict[str, float]:
    mass, height = model.hook_mass(spec, scene), model.hook_height(scene)
    falls = model.falls_of_a_rope(spec)
    tackle = reeving.tackle_efficiency(falls, filled(spec.reeving.sheave_efficiency))
    stiffness = model.hook_stiffness(spec, height)
    return {
        "reeving_efficiency": tackle * model.deflection_efficiency(spec),
        "rope_pull_max": model.pulls(spec, mass, height, hauling=True).drum,
        "rope_pull_lowering": model.pulls(spec, mass, height, hauling=False).drum,
        "rope_length": model.rope_length(spec, height),
        "rope_speed": model.drum_speed(spec) * model.layer_radius(spec, 1),
        "hook_speed": model.hook_speed(spec),
        "rope_stiffness": stiffness,
        "static_stretch": mass * spec.gravity / stiffness,
    }


def _of_the_drum(spec: Hoist, scene: HoistScene) -> dict[str, float]:
    highest = model.wound(spec, spec.height)
    required = rope_drum.drum_length_required(
        highest.length,
        spec.drum.diameter,
        spec.rope.diameter,
        model.pitch(spec),
        spec.drum.layers,
        model.layer_step(spec),
        spec.winding.packing,
    )
    return {
        "drum_turns": highest.turns,
        "drum_layers": float(highest.layers),
        "drum_length_required": required,
        "hook_speed_max": model.hook_speed(spec, layer=highest.layers),
        "torque_drum": model.drum_torque(spec, model.hook_mass(spec, scene), hauling=True),
    }


HOIST_STATICS: Solver[Hoist, HoistScene] = Solver(
    name="hoist_statics",
    title="rope, drum and torques of a hoist that runs evenly",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Run}),
    represents=frozenset(),
    gives=frozenset(info.name for info in STATIC),
    run=run,
    cost=lambda spec, scene, carried, level: 1e-4,
    source="balance of every sheave; geometry of the drum",
)
