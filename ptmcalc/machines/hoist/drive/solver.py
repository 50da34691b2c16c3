"""The drive in steady motion: gearbox, motor, start over the hanging load, closed brake, duty."""

import math
from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.components.duty_motor import DutyMotor
from ptmcalc.contract.result import Finding, Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import classification
from ptmcalc.machines.hoist.drive import torques
from ptmcalc.machines.hoist.machine import model
from ptmcalc.machines.hoist.machine.keys.drive import Duty
from ptmcalc.machines.hoist.machine.model import filled
from ptmcalc.machines.hoist.machine.spec import EmergencyStop, Hoist, HoistScene, LowerBrake, Start, Stop

Numbers = dict[str, float]

_ONTO = 1 + 1e-9
"""Height relative to that at which a layer begins [1]: just above it the rope is on the new layer. A numerical choice
above the resolution 2e-16 of the floating point. At 1 the layer below is evaluated."""


def of_the_drive(spec: Hoist, scene: HoistScene) -> dict[str, Found]:
    """Loads of gearbox, motor, start and brake in steady motion."""
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
    found |= _of_lowering(spec, mass, height)
    return found | _of_the_start(spec, scene) | _of_the_brake(spec, scene)


def overspeed_note(spec: Hoist) -> str:
    """Where the limit of the motor speed comes from, if the file does not give it."""
    given = "overspeed" in spec.checks.model_fields_set
    return "" if given else "limit 1.2 times the rated speed (IEC 60034-1), to be compared with the standard"


def _of_lowering(spec: Hoist, mass: float, height: float | None) -> dict[str, Found]:
    """Speed at which the motors hold the lowered load on their curve."""
    speed = torques.curve_speed(spec, mass, height, up=False) if spec.gearbox is not None else None
    field = torques.field_speed(spec.motor) if spec.motor is not None else None
    if speed is None or field is None:
        return {}
    note = "the load overcomes the braking torque and drives the motor without limit" if math.isinf(speed) else ""
    return {
        "lowering_speed": Found(Estimate.exact(speed), note=note or overspeed_note(spec)),
        "lowering_speed_ratio": Found(Estimate.exact(speed / field)),
    }


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
    if isinstance(scene, LowerBrake) or (isinstance(scene, Stop | EmergencyStop) and scene.direction == "down"):
        speed = filled(spec.speed.creep) if scene.speed == "creep" else model.hook_speed(spec)
        if isinstance(scene, EmergencyStop) and scene.motor_speed is not None:
            speed = model.hook_speed(spec) * scene.motor_speed / torques.motor_speed(spec)
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


def of_the_use(spec: Hoist) -> dict[str, Found]:
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
    if scene.hook_height is not None or (isinstance(scene, Stop | EmergencyStop) and scene.direction == "up"):
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
    scenes=frozenset({Stop, LowerBrake, EmergencyStop}),
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
