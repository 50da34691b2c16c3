"""Hoisting and lowering at an even speed: rope, drum, torques, brake, heat."""

import math
from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.components.duty_motor import DutyMotor
from ptmcalc.contract.result import Finding, Found, Result, of
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import classification, hoisting, reeving, rope_drum, wire_rope
from ptmcalc.machines.hoist import model
from ptmcalc.machines.hoist.drive import torques
from ptmcalc.machines.hoist.drive.loads import OF_THE_CLASS, OF_THE_DRIVE
from ptmcalc.machines.hoist.keys.drive import Duty
from ptmcalc.machines.hoist.model import filled
from ptmcalc.machines.hoist.spec import Hoist, HoistScene, LowerBrake, Run, Start, Stop
from ptmcalc.machines.hoist.statics.loads import OF_THE_DRUM, OF_THE_ROPE

Numbers = dict[str, float]

_ONTO = 1 + 1e-9
"""Height relative to that at which a layer begins [1]: just above it the rope is on the new layer. A numerical choice
above the resolution 2e-16 of the floating point. At 1 the layer below is evaluated."""


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
    return Result(found | _of_the_drive(spec, scene) | _of_the_use(spec), work=1)


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


def _of_the_drive(spec: Hoist, scene: HoistScene) -> dict[str, Found]:
    mass, height = model.hook_mass(spec, scene), scene.hook_height
    loads: Numbers = {}
    if spec.gearbox is not None:
        up, speed = torques.torque_up(spec, mass, height), torques.motor_speed(spec)
        loads |= {
            "motor_speed": speed,
            "torque_motor_static_up": up,
            "torque_motor_static_down": torques.torque_down(spec, mass, height),
            "power_hoisting": up * speed,
        }
        if spec.motor is not None:
            loads |= _of_the_motor(spec, spec.motor, mass, height)
    found = {name: Found(Estimate.exact(value)) for name, value in loads.items()}
    return found | _of_the_start(spec, scene) | _of_the_brake(spec, scene)


def _of_the_start(spec: Hoist, scene: HoistScene) -> dict[str, Found]:
    """What the motor has over the hanging load, and how long it takes upwards."""
    if spec.gearbox is None or spec.motor is None:
        return {}
    mass, height = model.hook_mass(spec, scene), scene.hook_height
    reserve = torques.starting_reserve(spec, spec.motor, mass, height)
    time = torques.start_time(spec, spec.motor, mass, height, up=True) if reserve > 1 else math.inf
    if isinstance(scene, Start):
        time = torques.profiled(spec, spec.motor, scene, mass, time)
    note = "stall: the motor does not lift the suspended load" if math.isinf(time) else ""
    found = {
        "starting_reserve": Found(Estimate.exact(reserve), note=note),
        "start_time": Found(Estimate.exact(time)),
    }
    braking = torques.braking_reserve(spec, spec.motor, mass, height)
    return found if braking is None else found | {"overhauling_reserve": Found(Estimate.exact(braking))}


def _of_the_brake(spec: Hoist, scene: HoistScene) -> dict[str, Found]:
    """What the closed brake holds, and what happens where it does not."""
    speed = 0.0
    if isinstance(scene, LowerBrake) or (isinstance(scene, Stop) and scene.direction == "down"):
        speed = filled(spec.speed.creep) if scene.speed == "creep" else model.hook_speed(spec)
    held = torques.held(spec, model.hook_mass(spec, scene), scene.hook_height, speed)
    if held is None:
        return {}
    note = ""
    if held.drop > 0:
        way, hits = units.show(held.drop, units.SPAN), units.show(held.speed, units.SPEED)
        note = f"the load drops {way} to the ground and hits it at {hits}"
    return {
        "brake_torque_static": Found(Estimate.exact(held.torque)),
        "brake_reserve_static": Found(Estimate.exact(held.reserve), note=note),
        "drop_distance": Found(Estimate.exact(held.drop)),
        "drop_speed": Found(Estimate.exact(held.speed)),
    }


def _of_the_motor(spec: Hoist, motor: DutyMotor, mass: float, height: float | None) -> Numbers:
    loads: Numbers = {}
    field = torques.field_speed(motor)
    if field is not None:
        loads["start_heat"] = torques.start_heat(spec, motor, field, mass, height)
    if spec.duty is not None:
        loads["torque_motor_rms"] = torques.rms_torque(spec, motor)
        allowed = torques.permissible_torque(spec, motor)
        if allowed is not None:
            loads["heating_utilisation"] = loads["torque_motor_rms"] / allowed
    return loads


def _of_the_use(spec: Hoist) -> dict[str, Found]:
    """What the duty of the file asks of the class."""
    return {name: Found(Estimate.exact(value)) for name, value in _use(spec.duty, torques.spectrum(spec)).items()}


def _use(duty: Duty | None, spectrum: list[tuple[float, float]]) -> Numbers:
    if duty is None:
        return {}
    factor = classification.spectrum_factor([share for share, _ in spectrum], [load for _, load in spectrum])
    loads = {"spectrum_factor": factor, "equivalent_load_share": classification.equivalent_load(factor)}
    if duty.starts_per_hour is not None:
        loads["starts_per_hour"] = duty.starts_per_hour
    load = classification.load_class(factor)
    if duty.hours is not None:
        loads["mechanism_group"] = float(classification.group(classification.use_of_hours(duty.hours / 3600), load))
    if duty.cycles is not None:
        loads["crane_group"] = float(classification.group(classification.use_of_cycles(duty.cycles), load))
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


def hold(spec: Hoist, scene: HoistScene, carried: frozenset[str], level: int) -> Result:
    """Holding reserve of the closed brake in a scene that ends with it.

        reserve = M_B/(S R n eta_r/u);   with a reserve below 1 the load drops with a = (M_d eta_r/u - M_B)/J

    **Range** as `hoist_statics`; a constant brake torque without fading.
    **Error** exact for that model.
    **Source** power balance of the gearbox (`laws.hoisting`).
    """
    return Result(_of_the_brake(spec, scene), work=1, findings=tuple(_where_the_brake_lets_go(spec, scene)))


def _where_the_brake_lets_go(spec: Hoist, scene: HoistScene) -> Iterator[Finding]:
    """Of a stop from lowering that names no height: the layer on which the brake first does not hold, if there is one.

    The stop is simulated with the hook at its lowest; the check of the closed brake takes the worst height.
    """
    if scene.hook_height is not None or (isinstance(scene, Stop) and scene.direction == "up"):
        return
    mass = model.hook_mass(spec, scene)
    for layer, height in enumerate(model.layer_heights(spec), 1):
        held = torques.held(spec, mass, height * _ONTO)
        if held is None or held.reserve >= 1:
            continue
        if layer > 1:
            said = units.show(height, units.SPAN)
            message = (
                f"scene `{scene.label}` assumes the lowest hook position, where the brake holds the load; above hook"
                f" height {said}, with the rope on layer {layer}, the brake does not hold it"
            )
            yield Finding("NUM104", message, ("scenes",), f"write a `hook_height` above {said} to assess such a stop")
        return


HOLDING: Solver[Hoist, HoistScene] = Solver(
    name="holding_brake",
    title="brake holding torque",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Stop, LowerBrake}),
    represents=frozenset(),
    gives=frozenset({"brake_torque_static", "brake_reserve_static", "drop_distance", "drop_speed"}),
    run=hold,
    cost=lambda spec, scene, carried, level: 1e-4,
    source="power balance of the gearbox",
)


def start(spec: Hoist, scene: HoistScene, carried: frozenset[str], level: int) -> Result:
    """Torque reserve of the motor over the suspended load in a scene that starts with it.

        reserve = M_mean/(S R n/(u eta));   t = w (J_1 + J_2/(u^2 eta))/(M_mean - M_L/(u eta))
        reserve of braking = M_b/(S R n eta_r/u)

    **Range** as `hoist_statics`.
    **Error** exact for that model.
    **Source** power balance of the gearbox (`laws.hoisting`).
    """
    return Result(_of_the_start(spec, scene), work=1)


STARTING: Solver[Hoist, HoistScene] = Solver(
    name="starting_reserve",
    title="starting torque reserve over the suspended load",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Start}),
    represents=frozenset(),
    gives=frozenset({"starting_reserve", "start_time", "overhauling_reserve"}),
    run=start,
    cost=lambda spec, scene, carried, level: 1e-4,
    source="power balance of the gearbox",
)
