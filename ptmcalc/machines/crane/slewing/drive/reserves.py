"""Motor, brake and gear of a slewing crane against what they have to do."""

import math

from ptmcalc.components.motor_torque import overhauling_reserve
from ptmcalc.laws import duty
from ptmcalc.machines.crane.slewing.machine import model
from ptmcalc.machines.crane.slewing.machine.model import Phases, PhaseTorques
from ptmcalc.machines.crane.slewing.machine.spec import SlewingCrane, SlewingScene


def ratio_to(value: float, limit: float) -> float:
    """How often a value holds what is asked of it; infinite where nothing is asked."""
    return value / limit if limit > 0 else math.inf


def held_by_brake(spec: SlewingCrane) -> float:
    """What the closed brake holds at the slewing axis, the gear's losses left out: on the safe side [N*m]."""
    if spec.brake is None:
        return 0.0
    return spec.brake.torque * (spec.gear.ratio if spec.brake.shaft == "motor" else 1.0)


def required_brake(spec: SlewingCrane, scene: SlewingScene) -> float:
    """Torque on the motor shaft that stops the crane evenly in the allowed angle, 0 where it stops by itself [N*m]."""
    deceleration = spec.speed**2 / (2 * spec.cycle.brake_angle)
    of_crane = model.slew_inertia(spec, scene) * deceleration + model.driving_wind(spec, scene) - spec.friction
    loss = spec.gear.back if of_crane > 0 else 1 / spec.gear.efficiency
    own = model.rotor_inertia(spec) * spec.gear.ratio * deceleration
    return max(of_crane * loss / spec.gear.ratio + own, 0.0)


def braking_reserve(spec: SlewingCrane, scene: SlewingScene) -> float | None:
    """Largest braking torque of the motors over that with which wind and slope drive them; None where the file gives
    no curve [1].

        reserve = n M_b/((M_w,max - M_fr) eta_r/u)

    **Range** steady slewing; infinite where friction is larger than wind and slope, or the gear locks itself.
    **Error** exact for the curve.
    **Source** balance of torques (`components.motor.overhauling_reserve`).
    """
    gear, motor = spec.gear, spec.motor
    if motor.curve is None:
        return None
    driving = (model.driving_wind(spec, scene) - spec.friction) * gear.back / gear.ratio
    return overhauling_reserve(motor.curve, motor.count, driving if gear.back > 0 else 0.0)


def of_drive(
    spec: SlewingCrane, scene: SlewingScene, times: Phases, at: PhaseTorques, start_heat: float
) -> dict[str, float]:
    """Reserves, heat and whatever the drive is asked; `start_heat` is what the torque of the start is worth for the
    heat, over its mean [1]."""
    gear, motor = spec.gear, spec.motor
    against = spec.friction + model.driving_wind(spec, scene)
    spread = model.torque_range(spec, scene)
    least, start = model.least_torque(spec, scene), at.start
    if least is not None:
        start = model.at_column(spec, least)
    loads = {
        "torque_motor_start": at.fast[0] if spread is None else model.largest_torque(spec),
        "torque_brake_required": required_brake(spec, scene),
        "starting_reserve": ratio_to(start, at.steady),
        "wind_reserve_motor": ratio_to(start, against),
        "rotation_used": (times.start[1] + times.brake[1]) / spec.cycle.rotation,
        "gear_locks": max(-gear.back, 0.0) * model.slew_inertia(spec, scene) / model.rotor_at_axis(spec),
    }
    if least is not None:
        loads["speed_reserve"] = ratio_to(model.at_column(spec, least), at.steady)
    braking = braking_reserve(spec, scene)
    if braking is not None:
        loads["overhauling_reserve"] = braking
    if spec.brake is not None:
        held = held_by_brake(spec) + spec.friction
        loads["wind_reserve_brake"] = ratio_to(held, model.driving_wind(spec, scene))
    if math.isfinite(times.whole):
        pieces = [times.start[0], times.steady[0]]
        heating = duty.rms_torque([start_heat * at.fast[0] / motor.count, at.fast[1] / motor.count], pieces)
        loads["torque_motor_rms"] = heating
        if motor.rated is not None:
            on = sum(pieces) / (times.whole + spec.cycle.pause)
            cooling = duty.REST_COOLING["self_ventilated"]
            loads["heating_utilisation"] = heating / duty.permissible_torque(
                motor.rated, motor.rated_duty, on, rest_cooling=cooling
            )
    return loads
